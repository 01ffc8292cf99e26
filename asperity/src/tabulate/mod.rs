//! A grid of runs over interference and slip rate, at one or at several initial temperatures.
//!
//! One press serves all slip rates of an interference. Every finished cell goes to a journal
//! at once; an interrupted tabulation continues from there and ends with the same table. A
//! cell's result does not depend on the other cells, nor on the number of threads.

mod cell;
mod cost;
mod grid;
mod journal;
mod known;
mod layout;
mod shard;
mod table;

use std::path::Path;

use tables::refinement::{Goal, refine};
use tables::table::{Axes, Slice, TableError};

pub use cell::{Finished, slip_grid};
pub use journal::{CellResult, Index, Journal, JournalError, Point};
pub use shard::Shard;

use crate::scene::Scene;
use crate::scene::file::{Request, write_request};
use crate::simulate::outcome::Outcome;
use crate::simulate::{self, Pressed, SimulationError, Watch};
use crate::solver::timings::Timings;
use cost::CostModel;
use grid::Work;
use known::Known;
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
pub trait TableWatch: Sync {
    /// A cell is finished.
    fn finished(&self, _index: Index, _result: &CellResult, _progress: &CellProgress) {}
    /// Whether the tabulation is to stop.
    fn cancelled(&self) -> bool {
        false
    }
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
    /// The threads could not be started.
    #[error("cannot start {jobs} threads: {reason}")]
    Threads {
        /// As asked.
        jobs: usize,
        /// What the system said.
        reason: String,
    },
}

/// Results of a grid of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabulation {
    /// What was asked.
    pub request: Request,
    /// The part of it that was to be run.
    pub shard: Option<Shard>,
    /// ω₀/ω_c, rising: those asked for and those added.
    pub interferences: Vec<f64>,
    /// V, m/s, rising: those asked for and those added.
    pub slip_rates: Vec<f64>,
    /// Slips s/a₀ of the histories.
    pub slips: Vec<f64>,
    /// Over interference (at several initial temperatures those of the first, then those of the next)
    /// and slip rate; `None` where the cell was not run.
    pub cells: Vec<Vec<Option<CellResult>>>,
    /// Cells that were to be run.
    pub wanted: Vec<Vec<bool>>,
    /// Cells taken from the journal.
    pub resumed: usize,
}

impl Tabulation {
    /// Whether every cell that was to be run was, with or without success.
    pub fn finished(&self) -> bool {
        self.each().all(|((i, j), cell)| cell.is_some() || !self.wanted[i][j])
    }

    /// Cells that failed, with the reason.
    pub fn failures(&self) -> impl Iterator<Item = (Index, &str)> {
        self.each().filter_map(|(index, cell)| match cell {
            Some(Err(reason)) => Some((index, reason.as_str())),
            _ => None,
        })
    }

    /// Cells with a result.
    pub fn done(&self) -> impl Iterator<Item = (Index, &Finished)> {
        self.each().filter_map(|(index, cell)| match cell {
            Some(Ok(cell)) => Some((index, cell)),
            _ => None,
        })
    }

    /// Where the time of the cells that were run went, all together. A press that served several
    /// slip rates counts in each.
    pub fn timings(&self) -> Timings {
        let mut sum = Timings::default();
        self.done().for_each(|(_, finished)| sum.include(&finished.timings));
        sum
    }

    /// Initial temperature of a row, K, if they are several; and its interference.
    pub fn row(&self, i: usize) -> (Option<f64>, f64) {
        let count = self.interferences.len();
        (self.request.temperatures.get(i / count).copied(), self.interferences[i % count])
    }

    fn layout<'a>(&'a self, templates: &'a [Scene]) -> Layout<'a> {
        Layout {
            templates,
            series: !self.request.temperatures.is_empty(),
            interferences: &self.interferences,
            slip_rates: &self.slip_rates,
        }
    }

    fn each(&self) -> impl Iterator<Item = (Index, &Option<CellResult>)> {
        self.cells
            .iter()
            .enumerate()
            .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, cell)| ((i, j), cell)))
    }
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

pub(crate) fn tabulate_with<S: Simulator>(
    simulator: &S,
    request: &Request,
    options: &Options<'_>,
    watch: &dyn TableWatch,
) -> Result<(Tabulation, Journal), TabulateError> {
    if let (Some(shard), Some(_)) = (options.shard, request.goal) {
        return Err(TabulateError::Shard(shard));
    }
    let (mut journal, found) =
        Journal::open(options.journal, &write_request(request), options.shard, options.resume)?;
    let mut known = Known::default();
    found.iter().for_each(|(point, result)| known.insert(*point, result.clone()));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.jobs)
        // As a thread waits for a slide it may start another on top of it.
        .stack_size(32 << 20)
        .build()
        .map_err(|error| TabulateError::Threads { jobs: options.jobs, reason: error.to_string() })?;
    let slips = slip_grid(request.template.loading.slip_distance);
    let mut last = Tabulation {
        request: request.clone(),
        shard: options.shard,
        interferences: request.interferences.clone(),
        slip_rates: request.slip_rates.clone(),
        slips: slips.clone(),
        cells: Vec::new(),
        wanted: Vec::new(),
        resumed: found.len(),
    };
    let start = last.first()?;
    let templates = request.templates();
    let evaluate = |table: Slice| -> Result<Slice, Stop> {
        let Axes { interference, slip_rate, .. } = table.axes();
        last.interferences.clone_from(interference);
        last.slip_rates.clone_from(slip_rate);
        let layout = last.layout(&templates);
        let costs = expected_costs(&layout);
        let wanted = options.shard.map_or(vec![true; costs.len()], |shard| shard.members(&costs));
        let work = Work { layout, slips: &slips, wanted: &wanted, jobs: options.jobs };
        grid::run(simulator, &work, (&mut known, &mut journal), &pool, watch)?;
        let cell = |at: Index| known.get(layout.point(at)).cloned();
        let row = |i: usize| (0..slip_rate.len()).map(|j| cell((i, j))).collect();
        last.cells = (0..layout.rows()).map(row).collect();
        last.wanted = wanted.chunks(slip_rate.len()).map(<[bool]>::to_vec).collect();
        match last.finished() {
            true => Ok(last.first()?),
            false => Err(Stop::Asked),
        }
    };
    // Without a tolerance there is one round.
    let goal = request.goal.unwrap_or(Goal { tolerance: f64::INFINITY, most_cells: 0 });
    match refine(start, &goal, evaluate) {
        Ok(_) | Err(Stop::Asked) => Ok((last, journal)),
        Err(Stop::Journal(error)) => Err(error.into()),
        Err(Stop::Table(error)) => Err(error.into()),
    }
}

/// Why rounds of runs ended before their goal.
enum Stop {
    Asked,
    Journal(JournalError),
    Table(TableError),
}

impl From<JournalError> for Stop {
    fn from(error: JournalError) -> Self {
        Self::Journal(error)
    }
}

impl From<TableError> for Stop {
    fn from(error: TableError) -> Self {
        Self::Table(error)
    }
}

/// Of each cell, row-major, before anything is run: only ratios mean something.
fn expected_costs(layout: &Layout<'_>) -> Vec<f64> {
    let largest = layout.interferences[layout.interferences.len() - 1];
    let model = CostModel::new(largest, layout.slip_rates.len());
    layout.cases().into_iter().map(|case| model.seconds(case)).collect()
}

#[cfg(test)]
mod series_tests;
#[cfg(test)]
mod tests;
