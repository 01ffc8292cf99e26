//! The runs of one slip rate from coarse to fine, and the decision on a finer one.

use super::SimulationError;
use super::messages::Note;
use super::run::Run;
use crate::loading::slide::SlideFailure;
use crate::scene::Numerics;
use crate::simulate::accuracy::error_budget::ErrorBudget;
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::expected_time::{EXPECTED_TIME_FACTOR, SHORT, time_ratio};
use crate::simulate::steady::SteadyState;

/// Share of the error that a refinement leaves at which it has gained nothing; with twice the elements it leaves half or
/// less.
const STAGNATION: f64 = 0.8;
/// Refinement of the mesh from which on its gain shows: half of the gain of 10 to 12 elements is the scatter of the estimate.
const MEANINGFUL: f64 = 1.5;

/// The main run and the auxiliary runs of the resolution `start`.
pub(super) struct Ladder {
    pub start: Resolution,
    /// Auxiliary runs on the coarse mesh: unchanged, with another N_θ, with longer increments and a looser solver, and where
    /// their effect matters with the looser solver alone.
    pub auxiliary: Vec<Run>,
    /// Main runs, each finer than the one before.
    pub main: Vec<Run>,
    /// Run on the coarse mesh of the finest main run, where that is not the first: errors depend on the final resolution and
    /// not on those before.
    pub coarse: Option<Run>,
    /// A finer run, and that on its coarse mesh, of which one did not finish.
    pub abandoned: Vec<Run>,
    /// Why the runs that had to follow could not begin; the result is then the best of those before.
    pub obstacle: Option<SimulationError>,
    /// Time of runs that were begun and given up, or repeated on wider meshes, s.
    pub given_up: f64,
    /// Largest relative error of the quantities controlled by the accuracy, over its allowance, of each main run.
    errors: Vec<f64>,
    pub notes: Vec<Note>,
}

impl Ladder {
    pub fn new(start: Resolution, main: Run, auxiliary: Vec<Run>) -> Self {
        Self {
            start,
            auxiliary,
            main: vec![main],
            coarse: None,
            abandoned: Vec::new(),
            obstacle: None,
            given_up: 0.0,
            errors: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The first auxiliary run replaces the main run.
    pub fn of_auxiliary(
        start: Resolution,
        mut auxiliary: Vec<Run>,
        obstacle: Option<SimulationError>,
    ) -> Self {
        let coarse = auxiliary.swap_remove(0);
        Self { obstacle, ..Self::new(start, coarse, auxiliary) }
    }

    /// Takes the steady friction of each run by its ratio to that at the end of the slide.
    pub fn set_steady_friction(&mut self, steady: SteadyState) {
        self.notes.push(Note::WentOn(steady.slip));
        for run in self.auxiliary.iter_mut().chain(&mut self.main).chain(&mut self.coarse) {
            run.values.set_steady_friction(steady.ratio);
        }
    }

    /// Keeps a finer run and that on its coarse mesh, of which one did not finish, for the account.
    pub fn abandon(&mut self, runs: [Run; 2]) {
        let failed = runs.iter().find(|run| run.failure.is_some() && !run.is_cancelled());
        if let Some(Run { resolution, failure: Some(cause), .. }) = failed {
            let (elements, sectors) = (resolution.elements_per_radius, resolution.sectors);
            let cause = match cause {
                SlideFailure::Discontinuous { failures, last } => {
                    format!("{failures} times an increment failed, the last time: {last}")
                }
                cause => cause.to_string(),
            };
            self.notes.push(Note::RefinementFailed { elements, sectors, cause });
        }
        self.abandoned.extend(runs);
    }

    /// Time of all slides, s.
    pub fn time_of_slides(&self) -> f64 {
        let slides = self.auxiliary.iter().chain(&self.main).chain(&self.coarse).chain(&self.abandoned);
        slides.map(Run::slide_time).sum::<f64>() + self.given_up
    }

    /// Resolutions of the last two main runs.
    fn last_two(&self) -> [&Resolution; 2] {
        [2, 1].map(|back| &self.main[self.main.len() - back].resolution)
    }

    /// The finest main run.
    pub fn result(&self) -> &Run {
        self.main.last().expect("there is a main run")
    }

    /// Whether the result is not an auxiliary run in the place of the main one.
    pub fn has_main_run(&self) -> bool {
        self.result().resolution.elements_per_radius != self.start.coarse().elements_per_radius
    }

    /// The next finer resolution, if the accuracy requires one, the last refinement, if any, reduced the error, and the
    /// time with it is short, or within the factor of the time `expected` (s) of all runs.
    pub fn finer(&mut self, budget: &ErrorBudget, numerics: &Numerics, expected: f64) -> Option<Resolution> {
        let (quantity, parts) = budget.worst(&self.result().values);
        if parts.solver_exceeds(numerics.accuracy) {
            let [solver, accuracy] =
                [parts.solver, numerics.accuracy].map(|part| quantity.allowance() * part);
            self.notes.push(Note::AccuracyOutOfReach { quantity, solver, accuracy });
            return None;
        }
        let finer = self.result().resolution.refine(numerics, &parts)?;
        let after = parts.total();
        if let Some(&before) = self.errors.last()
            && let [coarse, fine] = self.last_two()
            && fine.is_refined_likewise(coarse, &finer)
            && has_stagnated(
                [before, after],
                numerics.accuracy,
                [coarse, fine].map(|run| run.elements_per_radius),
            )
        {
            let [before, after] = [before, after].map(|error| error / numerics.accuracy);
            self.notes.push(Note::RefinementStopped { before, after });
            return None;
        }
        let spent: f64 = self.main.iter().map(Run::expected_time).sum();
        let next = self.result().expected_time() * time_ratio(&finer, &self.result().resolution);
        if spent + next > SHORT.max(EXPECTED_TIME_FACTOR * expected) {
            let (elements, sectors) = (finer.elements_per_radius, finer.sectors);
            self.notes.push(Note::RefinementTooLong { next, expected, elements, sectors });
            return None;
        }
        self.errors.push(after);
        Some(finer)
    }
}

/// Whether a refinement between meshes of these `elements` has gained nothing: neither of the error itself nor of what it
/// exceeds the accuracy by.
fn has_stagnated([before, after]: [f64; 2], accuracy: f64, elements: [usize; 2]) -> bool {
    let [coarse, fine] = elements.map(|elements| elements as f64);
    let shows = fine == coarse || fine >= MEANINGFUL * coarse;
    shows && after > (STAGNATION * before).max(0.5 * (before + accuracy))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refinement_that_gains_nothing_is_the_last() {
        let stagnated = |errors: [f64; 2], elements| has_stagnated(errors, 0.02, elements);
        // Of first order, and of none.
        assert!(!stagnated([0.06, 0.03], [10, 20]));
        assert!(stagnated([0.06, 0.05], [10, 20]) && !stagnated([0.06, 0.045], [10, 20]));
        // More angles or shorter increments: half of what was missing is enough.
        assert!(!stagnated([0.022, 0.0209], [10, 10]));
        assert!(stagnated([0.022, 0.0211], [10, 10]));
        // By a few elements no gain shows.
        assert!(!stagnated([0.022, 0.023], [10, 14]) && stagnated([0.022, 0.023], [10, 15]));
    }
}
