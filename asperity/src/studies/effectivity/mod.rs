//! Effectivity of the error estimates: scenes are run as usual and far more finely, and the true errors compared with
//! the estimates (book, "Effectivity of the error estimates"). Uses simulate as any caller, and the rooms below it for
//! single runs.
//!
//! The sources of error are taken one at a time, each against a run in which it alone is several
//! times smaller: four times the elements, and from these the limit at order 1.5; a quarter of the
//! increments, and from these the limit at order 1; twice the angles. The true error is the sum of these
//! effects; their interaction is of second order. The solver's part is a hundredth of the others and left out.

mod document;
mod record;
mod report;
pub mod scenes;

use std::io;
use std::path::Path;
use std::time::Instant;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use document::markdown;
use record::Journal;
pub use record::Record;
pub use report::{Judged, QuantityReport, Report};

use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::{Watch, sample};

/// n_c of the runs whose estimates are judged; the finest have four times as many.
pub const WORKING_ELEMENTS: usize = 8;

/// What a run of the study is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
pub enum Role {
    /// The run that is judged.
    Working,
    /// Its auxiliary runs, from which its errors are estimated.
    Coarse,
    CoarseSectors,
    CoarseSteps,
    CoarseSolver,
    /// Runs for its true errors.
    FourTimesElements,
    MoreSectors,
    QuarterSteps,
}

impl Role {
    /// Runs of a scene; the long ones first.
    pub const ALL: [Role; 8] = [
        Role::FourTimesElements,
        Role::MoreSectors,
        Role::QuarterSteps,
        Role::Working,
        Role::Coarse,
        Role::CoarseSectors,
        Role::CoarseSteps,
        Role::CoarseSolver,
    ];

    fn resolution(self, working: &Resolution) -> Resolution {
        let coarse = working.coarse();
        match self {
            Role::Working => *working,
            Role::Coarse => coarse,
            Role::CoarseSectors => coarse.other_sectors(),
            Role::CoarseSteps => coarse.longer_steps(),
            Role::CoarseSolver => coarse.looser_solver(),
            Role::FourTimesElements => working.finer_mesh(4),
            Role::MoreSectors => Resolution { sectors: 2 * working.sectors, ..*working },
            Role::QuarterSteps => working.shorter_steps(4),
        }
    }
}

/// Runs the missing runs of the given scenes (positions in [`scenes::SCENES`]); `done` is
/// called after each run. Ends early, without error, if cancelled by the watch.
///
/// A scene takes minutes; `asperity effectivity` runs them all.
///
/// ```no_run
/// use asperity::Unwatched;
/// use asperity::studies::effectivity::{Report, run};
///
/// // The first scene, on as many threads as there are; started again, it runs what is missing.
/// let records = run("effectivity.jsonl".as_ref(), &[0], &Unwatched, &|_| ())?;
/// println!("{:.0} % of the estimates are effective", 100.0 * Report::new(&records).share());
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// A journal that is there already is judged without running anything:
///
/// ```
/// use asperity::Unwatched;
/// use asperity::studies::effectivity::{Report, markdown, run, scenes};
///
/// let path = std::env::temp_dir().join(format!("effectivity-example-{}.jsonl", std::process::id()));
/// let report = Report::new(&run(&path, &[], &Unwatched, &|_| ())?);
/// // Without runs no scene is evaluated, and each has a reason.
/// assert!(report.scenes.is_empty());
/// assert_eq!(report.missing.len(), scenes::SCENES.len());
/// assert!(report.missing[0].1.contains("not run"));
/// assert!(markdown(&report).starts_with("# Effectivity of the error estimates"));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn run(
    path: &Path,
    which: &[usize],
    watch: &dyn Watch,
    done: &(dyn Fn(&Record) + Sync),
) -> io::Result<Vec<Record>> {
    let (journal, mut records) = Journal::open(path)?;
    let lacking: Vec<(usize, Role)> = which
        .iter()
        .flat_map(|&scene| Role::ALL.map(|role| (scene, role)))
        .filter(|&(scene, role)| !records.iter().any(|r| r.scene == scene && r.role == role))
        .collect();
    // One after the other to whichever thread is free: scenes are complete in their order.
    let new: Vec<io::Result<Option<Record>>> = lacking
        .par_iter()
        .with_max_len(1)
        .by_uniform_blocks(2 * rayon::current_num_threads())
        .map(|&(scene, role)| {
            if watch.cancelled() {
                return Ok(None);
            }
            let begun = Instant::now();
            let (preset, interference, slip_rate) = scenes::SCENES[scene];
            let definition = scenes::scene(preset, interference, slip_rate, WORKING_ELEMENTS);
            let resolution = role.resolution(&Resolution::choose(&definition.numerics));
            // Each presses for itself, so that no run waits for the mesh of another.
            let result =
                sample(&definition, slip_rate, &resolution, watch).map_err(|error| error.to_string());
            if watch.cancelled() {
                return Ok(None);
            }
            let record = Record::new(scene, role, begun.elapsed().as_secs_f64(), result);
            journal.append(&record)?;
            done(&record);
            Ok(Some(record))
        })
        .collect();
    for record in new {
        records.extend(record?);
    }
    Ok(records)
}
