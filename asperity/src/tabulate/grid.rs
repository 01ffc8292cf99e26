//! Runs the cells of a grid: one quasi-static press serves all slip rates of an interference, the largest
//! interferences first.
//!
//! Each thread has one press or slide at a time. In a common pool of threads one that waits for a part of its run would begin
//! another cell, which then ends first: run times and the time left would be those of both.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Instant;

use rayon::ThreadPool;

use super::cell::Finished;
use super::forecast::Forecast;
use super::journal::{CellResult, Index, Journal, JournalError, Known};
use super::layout::Layout;
use super::queue::{Queue, Task};
use super::{CellProgress, Simulator, TableWatch};
use crate::simulate::{SimulationError, Watch};

/// The cells to be run, and what runs them.
pub struct Grid<'a, S: Simulator> {
    simulator: &'a S,
    work: &'a Work<'a>,
    queue: Queue<S::Pressed>,
    watch: &'a dyn TableWatch,
    started: Instant,
    ledger: Mutex<Ledger<'a>>,
    /// The journal failed: results would be lost.
    stopped: AtomicBool,
}

struct Ledger<'a> {
    known: &'a mut Known,
    journal: &'a mut Journal,
    forecast: Forecast,
    done: usize,
    error: Option<JournalError>,
}

impl<S: Simulator> Watch for Grid<'_, S> {
    fn cancelled(&self) -> bool {
        self.stopped.load(Ordering::Relaxed) || self.watch.cancelled()
    }
}

/// The work of [`run`].
pub struct Work<'a> {
    pub layout: Layout<'a>,
    /// Row-major, like all data of the cells.
    pub wanted: &'a [bool],
    /// Expected times, s.
    pub expected: &'a [f64],
}

impl Work<'_> {
    /// Cells that are wanted and not known yet.
    pub fn pending(&self, known: &Known) -> impl Iterator<Item = Index> {
        let is_pending = |&at: &Index| {
            self.wanted[self.layout.position(at)] && !known.contains_key(&self.layout.point(at).key())
        };
        self.layout.cells().filter(is_pending)
    }
}

/// Runs every wanted cell that is not known yet, in each of the `pools` one at a time.
pub fn run<S: Simulator>(
    simulator: &S,
    work: &Work<'_>,
    (known, journal): (&mut Known, &mut Journal),
    pools: &[ThreadPool],
    watch: &dyn TableWatch,
) -> Result<(), JournalError> {
    let layout = work.layout;
    let mut forecast = Forecast::new(work.expected, pools.len());
    let mut done = 0;
    for (at, &wanted) in layout.cells().zip(work.wanted) {
        let result = known.get(&layout.point(at).key());
        if result.is_some() || !wanted {
            let wall_time = result.and_then(|result| Some(result.as_ref().ok()?.cell.wall_time));
            forecast.took(layout.position(at), wall_time.unwrap_or(f64::NAN));
        }
        done += usize::from(wanted && result.is_some());
    }
    journal.reserve(work.pending(known).count())?;
    let grid = &Grid {
        simulator,
        work,
        // The largest take longest: started last, they would run alone at the end.
        queue: Queue::new(layout.order()),
        watch,
        started: Instant::now(),
        ledger: Mutex::new(Ledger { known, journal, forecast, done, error: None }),
        stopped: AtomicBool::new(false),
    };
    std::thread::scope(|scope| {
        for pool in pools {
            scope.spawn(|| pool.install(|| grid.run_tasks()));
        }
    });
    grid.lock().error.take().map_or(Ok(()), Err)
}

impl<'a, S: Simulator> Grid<'a, S> {
    fn run_tasks(&self) {
        while let Some(task) = self.queue.next(|| self.cancelled()) {
            match task {
                Task::Press { row } => self.press_row(row),
                Task::Slide { pressed, index } => self.run_cell(&pressed, index),
            }
        }
    }

    /// Presses for those slip rates that are wanted and not done: once, unless the press depends on the slip rate.
    fn press_row(&self, i: usize) {
        let pending = self.pending(i);
        let served = match self.work.layout.template(i).loading.press_slip_distance {
            Some(_) => 1,
            None => pending.len().max(1),
        };
        let slides = pending.chunks(served).flat_map(|rates| match self.press((i, rates[0])) {
            Ok(pressed) => {
                let pressed = Arc::new(pressed);
                rates.iter().map(|&j| (pressed.clone(), (i, j))).collect()
            }
            Err(reason) => {
                let failed =
                    reason.into_iter().flat_map(|reason| rates.iter().map(move |&j| (j, reason.clone())));
                failed.for_each(|(j, reason)| self.finish((i, j), Err(reason)));
                Vec::new()
            }
        });
        self.queue.pressed(slides.collect::<Vec<_>>());
    }

    /// Slip rates at which the cells of an interference are wanted and not done.
    fn pending(&self, i: usize) -> Vec<usize> {
        self.work.pending(self.lock().known).filter(|at| at.0 == i).map(|at| at.1).collect()
    }

    fn press(&self, index: Index) -> Result<S::Pressed, Option<String>> {
        let scene = self.work.layout.scene(index);
        guard(|| self.simulator.press(&scene, self))
    }

    fn run_cell(&self, pressed: &S::Pressed, (i, j): Index) {
        if self.cancelled() {
            return;
        }
        let temperature = self.work.layout.template(i).loading.temperature;
        let position = self.work.layout.position((i, j));
        self.lock().forecast.started(position, self.now());
        match guard(|| self.simulator.slide(pressed, self.work.layout.axes.slip_rate[j], self)) {
            Ok(outcome) => {
                let finished = Finished::new(&outcome, &self.work.layout.axes.slip, temperature);
                self.finish((i, j), Ok(finished));
            }
            Err(Some(reason)) => self.finish((i, j), Err(reason)),
            Err(None) => {}
        }
    }

    fn finish(&self, index: Index, result: CellResult) {
        let position = self.work.layout.position(index);
        let mut ledger = self.lock();
        if let Err(error) = ledger.journal.record(self.work.layout.point(index), &result) {
            self.stopped.store(true, Ordering::Relaxed);
            ledger.error.get_or_insert(error);
            return;
        }
        ledger.done += 1;
        let now = self.now();
        ledger.forecast.finished(position, now);
        let progress = CellProgress {
            done: ledger.done,
            total: self.work.wanted.iter().filter(|wanted| **wanted).count(),
            remaining: ledger.forecast.remaining(now),
        };
        self.watch.finished(index, &result, &progress);
        ledger.known.insert(self.work.layout.point(index).key(), result);
    }

    fn now(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn lock(&self) -> MutexGuard<'_, Ledger<'a>> {
        self.ledger.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

/// Result of `work`, or why it failed; `None` if it was stopped on request.
fn guard<T>(work: impl FnOnce() -> Result<T, SimulationError>) -> Result<T, Option<String>> {
    // A panic in one cell must not lose the results of the others.
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
