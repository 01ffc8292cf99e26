//! Runs the cells of a grid: one press serves all slip rates of an interference, the largest
//! interferences first.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard};
use std::time::Instant;

use rayon::prelude::*;

use super::cell::Finished;
use super::cost::Forecast;
use super::journal::{CellResult, Index, Journal, JournalError, Known};
use super::layout::Layout;
use super::{CellProgress, Simulator, TableWatch};
use crate::simulate::{SimulationError, Watch};

/// The cells to be run, and what runs them.
pub struct Grid<'a, S> {
    simulator: &'a S,
    work: &'a Work<'a>,
    watch: &'a dyn TableWatch,
    clock: Instant,
    ledger: Mutex<Ledger<'a>>,
    /// The journal failed: results would be lost.
    stopped: AtomicBool,
}

struct Ledger<'a> {
    known: &'a mut Known,
    journal: &'a mut Journal,
    forecast: Forecast,
    done: usize,
    /// Being run by probes.
    taken: Vec<Index>,
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
    pub jobs: usize,
}

/// Runs every wanted cell that is not known yet.
pub fn run<S: Simulator>(
    simulator: &S,
    work: &Work<'_>,
    (known, journal): (&mut Known, &mut Journal),
    pool: &rayon::ThreadPool,
    watch: &dyn TableWatch,
) -> Result<(), JournalError> {
    let layout = work.layout;
    let cases = layout.cases();
    let mut model = layout.cost_model();
    let (mut finished, mut done) = (Vec::new(), 0);
    for (k, case) in cases.iter().enumerate() {
        match known.get(&layout.point(layout.index(k)).key()) {
            Some(result) => {
                if let Ok(result) = result {
                    model.learn(*case, result.cell.wall_time);
                }
                finished.push(k);
                done += usize::from(work.wanted[k]);
            }
            None if !work.wanted[k] => finished.push(k),
            None => {}
        }
    }
    journal.reserve(cases.len() - finished.len())?;
    let mut forecast = Forecast::new(model, cases, work.jobs);
    finished.into_iter().for_each(|k| forecast.finished(k, 0.0));
    let grid = &Grid {
        simulator,
        work,
        watch,
        clock: Instant::now(),
        ledger: Mutex::new(Ledger { known, journal, forecast, done, taken: Vec::new(), error: None }),
        stopped: AtomicBool::new(false),
    };
    pool.in_place_scope_fifo(|scope| {
        // One cell of an interference, at a slip rate in the middle.
        let middle = |pending: Vec<usize>| pending.get(pending.len() / 2).copied().into_iter().collect();
        for i in layout.probes() {
            scope.spawn_fifo(move |_| grid.run_row(i, middle));
        }
        // The largest take longest: started last, they would run alone at the end. Idle
        // threads help with the slides of a press before they start another press, which
        // keeps few pressed states in memory.
        for i in layout.order() {
            scope.spawn_fifo(move |_| grid.run_row(i, |pending| pending));
        }
    });
    grid.lock().error.take().map_or(Ok(()), Err)
}

impl<'a, S: Simulator> Grid<'a, S> {
    /// Press once, then slide at those slip rates that are `chosen` of the ones wanted and not done.
    fn run_row(&self, i: usize, chosen: impl FnOnce(Vec<usize>) -> Vec<usize>) {
        if self.cancelled() {
            return;
        }
        let pending = self.take(i, chosen);
        if pending.is_empty() {
            return;
        }
        match self.press(i) {
            Ok(pressed) => pending.par_iter().with_max_len(1).for_each(|&j| self.run_cell(&pressed, (i, j))),
            Err(Some(reason)) => {
                for j in pending {
                    self.finish((i, j), Err(reason.clone()));
                }
            }
            Err(None) => {}
        }
    }

    /// Those that are `chosen` of the cells of an interference that are neither done nor taken, taken at once: another thread
    /// may begin the same interference.
    fn take(&self, i: usize, chosen: impl FnOnce(Vec<usize>) -> Vec<usize>) -> Vec<usize> {
        let mut ledger = self.lock();
        let is_pending = |j: &usize| {
            self.work.wanted[self.work.layout.position((i, *j))]
                && !ledger.taken.contains(&(i, *j))
                && !ledger.known.contains_key(&self.work.layout.point((i, *j)).key())
        };
        let chosen = chosen((0..self.work.layout.axes.slip_rate.len()).filter(is_pending).collect());
        ledger.taken.extend(chosen.iter().map(|&j| (i, j)));
        chosen
    }

    fn press(&self, i: usize) -> Result<S::Pressed, Option<String>> {
        let scene = self.work.layout.scene((i, 0));
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
        self.clock.elapsed().as_secs_f64()
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
