//! Effectivity of the error estimates: scenes are run at the default accuracy and far more finely, and the true errors
//! compared with the reported ones (book, "Effectivity of the error estimates"). Uses simulate as any caller, and the
//! rooms below it for single runs.
//!
//! The reference value is that of a base run without auxiliary runs, corrected by the effect of each source of error:
//! three times the elements, and from these the limit at order 1.5; a quarter of the increments, and from these the limit
//! at order 1; four times the angles. The interaction of the sources is of second order. The solver's part is a hundredth
//! of the others and left out.

mod document;
mod record;
mod report;
pub mod scenes;

use std::io;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use serde::{Deserialize, Serialize};

pub use document::markdown;
pub use record::{Record, Reported};
pub use report::{Judged, QuantityReport, Report};

use crate::output::journal_file::{JournalFile, decode};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::{Watch, pools, run_history, simulate};

/// What a run of the study is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
pub enum Role {
    /// The scene as a user runs it: the values and errors that are judged.
    Reported,
    /// The base of the reference value: the first resolution at the default accuracy.
    Base,
    MoreElements,
    MoreSectors,
    ShorterSteps,
}

/// Elements, angles and increments of the runs of the reference value, over those of the base.
pub const ELEMENTS: usize = 3;
pub const SECTORS: usize = 4;
pub const STEPS: usize = 4;

impl Role {
    /// Runs of a scene; the long ones first.
    pub const ALL: [Role; 5] =
        [Role::MoreElements, Role::MoreSectors, Role::ShorterSteps, Role::Reported, Role::Base];

    /// Resolution of a single run; none for a run with error estimates.
    fn resolution(self, base: &Resolution) -> Option<Resolution> {
        match self {
            Role::Reported => None,
            Role::Base => Some(*base),
            Role::MoreElements => Some(base.finer_mesh(ELEMENTS)),
            Role::MoreSectors => Some(Resolution { sectors: SECTORS * base.sectors, ..*base }),
            Role::ShorterSteps => Some(base.shorter_steps(STEPS)),
        }
    }

    fn run(self, scene: usize, watch: &dyn Watch) -> Record {
        let begun = Instant::now();
        let study = scenes::study_scene(scene);
        let definition = study.scene();
        let mut record = Record::new(scene, self);
        let failure = match self.resolution(&Resolution::choose(&definition.numerics)) {
            None => {
                let reported = |outcome| Reported::of(&outcome, study.judged());
                simulate(&definition, watch).map(|outcome| record.reported = Some(reported(outcome)))
            }
            // Each presses for itself, so that no run waits for the mesh of another.
            Some(resolution) => run_history(&definition, definition.loading.slip_rate, &resolution, watch)
                .map(|history| record.run_history = Some(history)),
        };
        record.failure = failure.err().map(|error| error.to_string());
        record.wall_time = begun.elapsed().as_secs_f64();
        record
    }
}

/// Runs the missing runs of the given scenes (positions, see [`scenes::study_scene`]); `done` is
/// called after each run. Ends early, without error, if cancelled by the watch.
///
/// A scene takes minutes; `asperity effectivity` runs them all.
///
/// ```no_run
/// use asperity::Unwatched;
/// use asperity::studies::effectivity::{Report, run};
/// use tables::quantity::Quantity;
///
/// // The first scene, on as many threads as there are; started again, it runs what is missing.
/// let records = run("effectivity.jsonl".as_ref(), &[0], &Unwatched, &|_| ())?;
/// println!("{:.0} % of the errors of mu are covered", 100.0 * Report::new(&records).of(Quantity::Mu).covered);
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
/// assert_eq!(report.missing.len(), scenes::COUNT);
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
    let (journal, text) = JournalFile::open(path)?;
    let mut records: Vec<Record> = text.lines().filter_map(decode).collect();
    let lacking: Vec<(usize, Role)> = which
        .iter()
        .flat_map(|&scene| Role::ALL.map(|role| (scene, role)))
        .filter(|&(scene, role)| !records.iter().any(|r| r.scene == scene && r.role == role))
        .collect();
    let pools = pools(rayon::current_num_threads(), lacking.len()).map_err(io::Error::other)?;
    // One after the other to whichever thread is free: scenes are complete in their order.
    let waiting = Mutex::new(lacking.into_iter());
    let written = Mutex::new((journal, Vec::new()));
    let next = || lock(&waiting).next().filter(|_| !watch.cancelled());
    let run_waiting = || -> io::Result<()> {
        while let Some((scene, role)) = next() {
            let record = role.run(scene, watch);
            if watch.cancelled() {
                break;
            }
            let (journal, new) = &mut *lock(&written);
            journal.append(&record)?;
            done(&record);
            new.push(record);
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = pools.iter().map(|pool| scope.spawn(|| pool.install(run_waiting))).collect();
        workers.into_iter().try_for_each(|worker| worker.join().expect("no run panics"))
    })?;
    records.extend(written.into_inner().unwrap_or_else(PoisonError::into_inner).1);
    Ok(records)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
