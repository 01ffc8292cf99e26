//! A grid of runs over interference and slip rate.
//!
//! One press serves all slip rates of an interference. Every finished cell goes to a journal
//! at once; an interrupted tabulation continues from there and ends with the same table. A
//! cell's result does not depend on the other cells, nor on the number of threads.

mod cell;
mod journal;
mod table;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

pub use cell::{Finished, slip_grid};
pub use journal::{CellResult, Index, Journal, JournalError};

use crate::outcome::Outcome;
use crate::scene::Scene;
use crate::scene_file::{Request, write_request};
use crate::simulate::{self, Pressed, SimulationError, Watch};

/// Follows a tabulation and can stop it.
pub trait TableWatch: Sync {
    /// A cell is finished; `done` of `total` are.
    fn finished(&self, _index: Index, _result: &CellResult, _done: usize, _total: usize) {}
    /// True once the tabulation shall stop.
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
}

/// Why a tabulation could not run at all; a cell that fails is not such a reason.
#[derive(Debug, thiserror::Error)]
pub enum TabulateError {
    /// The journal cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
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
    /// Slips s/a₀ of the histories.
    pub slips: Vec<f64>,
    /// Over interference and slip rate; `None` where the cell was not run.
    pub cells: Vec<Vec<Option<CellResult>>>,
    /// Cells taken from the journal.
    pub resumed: usize,
}

impl Tabulation {
    /// Whether every cell was run, with or without success.
    pub fn finished(&self) -> bool {
        self.cells.iter().flatten().all(Option::is_some)
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

    fn each(&self) -> impl Iterator<Item = (Index, &Option<CellResult>)> {
        self.cells
            .iter()
            .enumerate()
            .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, cell)| ((i, j), cell)))
    }
}

/// What presses and slides; separate from [`simulate`] for the sake of tests.
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

/// Run every cell of `request` that the journal does not hold yet.
///
/// The journal remains; remove it once the table is written.
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
    let (journal, found) = Journal::open(options.journal, &write_request(request), options.resume)?;
    let columns = request.slip_rates.len();
    let mut cells = vec![vec![None; columns]; request.interferences.len()];
    for ((i, j), result) in found {
        if let Some(cell) = cells.get_mut(i).and_then(|row: &mut Vec<_>| row.get_mut(j)) {
            *cell = Some(result);
        }
    }
    let resumed = cells.iter().flatten().filter(|cell| cell.is_some()).count();
    let grid = Grid {
        simulator,
        request,
        slips: slip_grid(request.template.loading.slip_distance),
        ledger: Mutex::new(Ledger { cells, journal, done: resumed, error: None }),
        stopped: AtomicBool::new(false),
        watch,
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.jobs)
        // As a thread waits for a slide it may start another on top of it.
        .stack_size(32 << 20)
        .build()
        .map_err(|error| TabulateError::Threads { jobs: options.jobs, reason: error.to_string() })?;
    pool.in_place_scope_fifo(|scope| {
        // The largest take longest: started last, they would run alone at the end. Idle
        // threads help with the slides of a press before they start another press, which
        // keeps few pressed states in memory.
        for i in (0..request.interferences.len()).rev() {
            let grid = &grid;
            scope.spawn_fifo(move |_| grid.run_row(i));
        }
    });
    let ledger = grid.ledger.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    if let Some(error) = ledger.error {
        return Err(error.into());
    }
    let tabulation = Tabulation { request: request.clone(), slips: grid.slips, cells: ledger.cells, resumed };
    Ok((tabulation, ledger.journal))
}

struct Ledger {
    cells: Vec<Vec<Option<CellResult>>>,
    journal: Journal,
    done: usize,
    error: Option<JournalError>,
}

struct Grid<'a, S> {
    simulator: &'a S,
    request: &'a Request,
    slips: Vec<f64>,
    ledger: Mutex<Ledger>,
    /// The journal failed: results would be lost.
    stopped: AtomicBool,
    watch: &'a dyn TableWatch,
}

impl<S: Simulator> Watch for Grid<'_, S> {
    fn cancelled(&self) -> bool {
        self.stopped.load(Ordering::Relaxed) || self.watch.cancelled()
    }
}

impl<S: Simulator> Grid<'_, S> {
    /// Press once, then slide at every slip rate that is not done.
    fn run_row(&self, i: usize) {
        let pending: Vec<usize> = {
            let ledger = self.lock();
            let row = ledger.cells[i].iter().enumerate();
            row.filter(|(_, cell)| cell.is_none()).map(|(j, _)| j).collect()
        };
        if pending.is_empty() || self.cancelled() {
            return;
        }
        let scene = self.request.scene(i, 0);
        match self.guard(|| self.simulator.press(&scene, self)) {
            Ok(pressed) => pending.par_iter().with_max_len(1).for_each(|&j| self.run_cell(&pressed, (i, j))),
            Err(Some(reason)) => {
                for j in pending {
                    self.finish((i, j), Err(reason.clone()));
                }
            }
            Err(None) => {}
        }
    }

    fn run_cell(&self, pressed: &S::Pressed, (i, j): Index) {
        if self.cancelled() {
            return;
        }
        let slip_rate = self.request.slip_rates[j];
        let temperature = self.request.template.loading.temperature;
        match self.guard(|| self.simulator.slide(pressed, slip_rate, self)) {
            Ok(outcome) => {
                let finished = Finished::new(&outcome, &self.slips, temperature);
                self.finish((i, j), Ok(finished));
            }
            Err(Some(reason)) => self.finish((i, j), Err(reason)),
            Err(None) => {}
        }
    }

    /// Result of `work`, or why it failed; `None` if it was stopped on request.
    fn guard<T>(&self, work: impl FnOnce() -> Result<T, SimulationError>) -> Result<T, Option<String>> {
        // One cell that breaks must not take hours of others with it.
        match catch_unwind(AssertUnwindSafe(work)) {
            Ok(Ok(value)) => Ok(value),
            Ok(Err(SimulationError::Cancelled { .. })) => Err(None),
            Ok(Err(error)) => Err(Some(error.to_string())),
            Err(panic) => {
                let text = panic
                    .downcast_ref::<&str>()
                    .map(|text| (*text).to_owned())
                    .or_else(|| panic.downcast_ref::<String>().cloned());
                let text = text.unwrap_or_else(|| "unknown".into());
                Err(Some(format!("internal error: {text}")))
            }
        }
    }

    fn finish(&self, (i, j): Index, result: CellResult) {
        let mut ledger = self.lock();
        if let Err(error) = ledger.journal.record((i, j), &result) {
            self.stopped.store(true, Ordering::Relaxed);
            ledger.error.get_or_insert(error);
            return;
        }
        ledger.done += 1;
        let total = self.request.interferences.len() * self.request.slip_rates.len();
        self.watch.finished((i, j), &result, ledger.done, total);
        ledger.cells[i][j] = Some(result);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Ledger> {
        self.ledger.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

#[cfg(test)]
mod tests;
