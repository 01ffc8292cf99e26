//! Tables: a grid of runs over initial temperature, interference and slip rate.
//!
//! - `grid`: runs the cells; one press serves all slip rates of an interference. A result does not depend
//!   on the other cells, nor on the number of threads.
//! - `journal`: every finished cell is written at once; an interrupted tabulation continues from the journal and
//!   results in the same table.
//! - `queue`: what each thread does next. `forecast`: the remaining time.
//! - `shard`: parts for separate machines.
//! - `cell`, `tabulation`: results as cells of a [`tables::table::Table`]. Points are added to a grid
//!   by [`tables::refinement`].
//!
//! Depends on `crate::output` (provenance) and the rooms below it. Chapter "Tables" of the book.

mod cell;
#[cfg(test)]
mod fake;
mod forecast;
mod grid;
mod journal;
mod layout;
mod queue;
mod shard;
mod tabulation;

use std::path::Path;

use tables::netcdf::DatasetError;
use tables::numbers::{digits, plain};
use tables::table::{Axes, Table, TableError};

pub use cell::{Finished, slip_grid};
pub use journal::{CellResult, Index, Journal, JournalError, Point};
pub use shard::Shard;
pub use tabulation::Tabulation;

use crate::output::provenance::FINGERPRINT;
use crate::scene::Scene;
use crate::scene::file::{Request, write_request};
use crate::simulate::largest_interference;
use crate::simulate::outcome::Outcome;
use crate::simulate::{self, Pressed, SimulationError, Watch, pools};
use grid::Work;
use journal::Known;
use layout::Layout;

/// Progress of a tabulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellProgress {
    /// Cells with a result.
    pub done: usize,
    /// Cells to be run; those that refinement will add are not known yet.
    pub total: usize,
    /// Estimated time until these are done, s, from the run times of finished cells.
    pub remaining: f64,
}

/// Observes a tabulation and can stop it.
pub trait TableWatch: Watch {
    /// A round of cells begins, of this processor time in all, s, within
    /// [`EXPECTED_TIME_FACTOR`](crate::simulate::expected_time::EXPECTED_TIME_FACTOR).
    fn expects(&self, _seconds: f64) {}
    /// A cell is finished.
    fn finished(&self, _index: Index, _result: &CellResult, _progress: &CellProgress) {}
}

impl TableWatch for simulate::Unwatched {}

/// How to run a tabulation.
pub struct Options<'a> {
    /// Threads.
    pub jobs: usize,
    /// Path of the journal.
    pub journal: &'a Path,
    /// Continue the journal that is there.
    pub resume: bool,
    /// Only a part of the cells.
    pub shard: Option<Shard>,
}

/// Why a tabulation could not run at all. A failed cell is part of the result.
#[derive(Debug, thiserror::Error)]
pub enum TabulateError {
    /// The journal cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// The axes are not valid.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Points are added where results of the whole grid need them.
    #[error(
        "--shard {0}: table.tolerance adds points where the whole table needs them; leave one of the two out"
    )]
    Shard(Shard),
    #[error(
        "{0}: holds a table of another request, or another shard, which --resume would replace; to replace it leave out \
         --resume"
    )]
    OtherTable(String),
    #[error(
        "{0}: lacks cells, and those that it has are of another build of the program, which may give other numbers; to make the whole \
         table anew leave out --resume"
    )]
    OtherBuild(String),
    /// The file that the table would be written to is no table.
    #[error("{0}; --resume would replace the file: delete it, or choose another name with --output")]
    NoTable(DatasetError),
    #[error(
        "table.interference = {asked}: must be at most about {most} (omega_0/omega_c){at}: the model needs a contact that \
         is small beside the asperity"
    )]
    TooDeep {
        /// ω₀/ω_c, as requested.
        asked: String,
        /// ω₀/ω_c.
        most: String,
        /// Initial temperature, where there are several.
        at: String,
    },
    #[error("cannot start {jobs} threads: {reason}")]
    Threads { jobs: usize, reason: String },
}

/// Presses and slides; a trait so that tests can replace the simulation.
pub(crate) trait Simulator: Sync {
    /// State after the press.
    type Pressed: Send + Sync;
    fn press(&self, scene: &Scene, watch: &dyn Watch) -> Result<Self::Pressed, SimulationError>;
    fn slide(
        &self,
        pressed: &Self::Pressed,
        slip_rate: f64,
        watch: &dyn Watch,
    ) -> Result<Outcome, SimulationError>;
}

struct FiniteElements;

impl Simulator for FiniteElements {
    type Pressed = Pressed;

    fn press(&self, scene: &Scene, watch: &dyn Watch) -> Result<Pressed, SimulationError> {
        simulate::press(scene, watch)
    }

    fn slide(
        &self,
        pressed: &Pressed,
        slip_rate: f64,
        watch: &dyn Watch,
    ) -> Result<Outcome, SimulationError> {
        simulate::slide(pressed, slip_rate, watch)
    }
}

/// Run every cell of `request` that the journal does not hold yet, and where the request has a
/// tolerance, those that have to be added for it.
///
/// The journal remains; remove it once the table is written.
///
/// ```
/// use asperity::scene::file::parse_request;
/// use asperity::simulate::Unwatched;
/// use asperity::tabulate::{Options, tabulate};
/// use tables::law::AsperityLaw;
///
/// let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
///             [loading]\nslip_distance = 0.02\n[table]\ninterference = [2, 4]\nslip_rate = [0]\n\
///             [numerics]\nelements_per_radius = 4\nsectors = 4\n";
/// let request = parse_request(text, "this example", &[])?;
/// let journal = std::env::temp_dir().join(format!("asperity-example-{}.part", std::process::id()));
/// let options = Options { jobs: 1, journal: &journal, resume: false, shard: None };
/// let (tabulation, journal) = tabulate(&request, &options, &Unwatched)?;
/// let table = tabulation.table("an example".to_owned())?.at(None)?;
/// journal.remove()?;
/// // Read at another radius, between the cells, after 1 nm of slip.
/// let response = table.response(1e-4, 3.0, 0.0, 1e-9)?;
/// assert!(response.load.value > 0.0 && response.friction.value > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn tabulate(
    request: &Request,
    options: &Options<'_>,
    watch: &dyn TableWatch,
) -> Result<(Tabulation, Journal), TabulateError> {
    tabulate_with(&FiniteElements, request, options, watch)
}

/// The table at `output`, if it is the complete one of this `request` (or of its `shard`), of whatever build of the program. The
/// cells of one that lacks some, a partly merged one or a shard of the request, are written to the journal, which resuming
/// continues. An error if there is another file, which resuming would replace. Nothing where there is a journal already.
pub fn completed(
    request: &Request,
    shard: Option<Shard>,
    output: &Path,
) -> Result<Option<Table>, TabulateError> {
    let journal = Journal::beside(output);
    if journal.exists() {
        return Ok(None);
    }
    let Some(table) = existing(request, shard, output)? else { return Ok(None) };
    // A shard is written only when its cells are done.
    if shard.is_some() || table.missing().is_empty() {
        return Ok(Some(table));
    }
    if !is_of_this_build(&table) {
        return Err(TabulateError::OtherBuild(output.display().to_string()));
    }
    Journal::of_table(&journal, &write_request(request), &table)?;
    Ok(None)
}

/// Whether this build of the program made a table: another may give other numbers.
pub fn is_of_this_build(table: &Table) -> bool {
    table.metadata().fingerprint == FINGERPRINT
}

/// The table at `output`, if there is a file that is not empty; an error if it is no table, or one of another request or shard.
pub fn existing(
    request: &Request,
    shard: Option<Shard>,
    output: &Path,
) -> Result<Option<Table>, TabulateError> {
    if std::fs::metadata(output).map_or(true, |file| file.len() == 0) {
        return Ok(None);
    }
    let table = Table::read(output).map_err(TabulateError::NoTable)?;
    let metadata = table.metadata();
    let other_shard = shard.is_some_and(|shard| shard.to_string() != metadata.shard);
    match metadata.scene != write_request(request) || other_shard {
        true => Err(TabulateError::OtherTable(output.display().to_string())),
        false => Ok(Some(table)),
    }
}

pub(crate) fn tabulate_with<S: Simulator>(
    simulator: &S,
    request: &Request,
    options: &Options<'_>,
    watch: &dyn TableWatch,
) -> Result<(Tabulation, Journal), TabulateError> {
    if let (Some(shard), Some(_)) = (options.shard, request.goal) {
        return Err(TabulateError::Shard(shard));
    }
    check_depth(request)?;
    let (mut journal, found) =
        Journal::open(options.journal, &write_request(request), options.shard, options.resume)?;
    let resumed = found.len();
    let mut known: Known = found.into_iter().map(|(point, result)| (point.key(), result)).collect();
    let templates = request.templates();
    let mut axes = Axes {
        interference: request.interferences.clone(),
        slip_rate: request.slip_rates.clone(),
        slip: slip_grid(request.template.loading.slip_distance),
    };
    loop {
        let layout = Layout { templates: &templates, axes: &axes };
        let expected = layout.expected_times();
        let wanted = options.shard.map_or(vec![true; expected.len()], |shard| shard.members(&expected));
        let work = Work { layout, wanted: &wanted, expected: &expected };
        watch.expects(work.pending(&known).map(|at| expected[layout.position(at)]).sum());
        let jobs = options.jobs;
        let pools = pools(jobs, work.pending(&known).count())
            .map_err(|error| TabulateError::Threads { jobs, reason: error.to_string() })?;
        grid::run(simulator, &work, (&mut known, &mut journal), &pools, watch)?;
        let result = |at| Some((at, known.get(&layout.point(at).key())?.clone()));
        let tabulation = Tabulation {
            request: request.clone(),
            shard: options.shard,
            cells: layout.cells().filter_map(result).collect(),
            wanted: layout.cells().filter(|at| wanted[layout.position(*at)]).collect(),
            axes: axes.clone(),
            resumed,
        };
        // Refined tables have one initial temperature.
        let next = match request.goal {
            Some(goal) if tabulation.finished() => goal.next_axes(&tabulation.slice(0, &templates[0])?),
            _ => None,
        };
        match next {
            Some(finer) => axes = finer,
            None => return Ok((tabulation, journal)),
        }
    }
}

/// Whether the model goes as deep as the largest interference, at every initial temperature.
fn check_depth(request: &Request) -> Result<(), TabulateError> {
    let deepest = request.interferences[request.interferences.len() - 1];
    let limits = request.templates().into_iter().filter_map(|mut scene| {
        scene.loading.interference = deepest;
        Some((largest_interference(&scene)?, scene.loading.temperature))
    });
    match limits.min_by(|a, b| a.0.total_cmp(&b.0)) {
        None => Ok(()),
        Some((most, temperature)) => Err(TabulateError::TooDeep {
            asked: plain(deepest),
            most: digits(most, 2),
            at: match request.temperatures.is_empty() {
                true => String::new(),
                false => format!(" at {} K", plain(temperature)),
            },
        }),
    }
}

#[cfg(test)]
mod tests;
