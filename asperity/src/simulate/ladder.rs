//! The runs of one slip rate from coarse to fine, and the decision on a finer one.

use super::SimulationError;
use super::messages::Note;
use super::run::Run;
use crate::scene::Numerics;
use crate::simulate::accuracy::error_budget::ErrorBudget;
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::expected_time::{EXPECTED_TIME_FACTOR, time_ratio};

/// Share of the error that a refinement leaves at which it has gained nothing; with twice the elements it leaves half or less.
const STAGNATION: f64 = 0.8;

/// The main run and the auxiliary runs of the resolution `start`.
pub(super) struct Ladder {
    pub start: Resolution,
    /// On the coarse mesh: unchanged, with another N_θ, with longer increments, with a looser solver.
    pub auxiliary: Vec<Run>,
    /// Each finer than the one before.
    pub main: Vec<Run>,
    /// On the coarse mesh of the finest of them, where that is not the first: errors depend on the final resolution and
    /// not on those before.
    pub coarse: Option<Run>,
    /// A finer run that did not finish.
    pub abandoned: Option<Run>,
    /// Why the runs that had to follow could not begin; the result is then the best of those before.
    pub obstacle: Option<SimulationError>,
    /// Time of a main run that was begun and given up, s.
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
            abandoned: None,
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

    /// The finest main run.
    pub fn result(&self) -> &Run {
        self.main.last().expect("there is a main run")
    }

    /// The next finer resolution, if the accuracy requires one, the last refinement, if any, reduced the error, and the
    /// time with it is within the factor of the time `expected` (s) of all runs.
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
            && after > STAGNATION * before
        {
            let [before, after] = [before, after].map(|error| error / numerics.accuracy);
            self.notes.push(Note::RefinementStopped { before, after });
            return None;
        }
        let spent: f64 = self.main.iter().map(Run::expected_time).sum();
        let next = self.result().expected_time() * time_ratio(&finer, &self.result().resolution);
        if spent + next > EXPECTED_TIME_FACTOR * expected {
            let (elements, sectors) = (finer.elements_per_radius, finer.sectors);
            self.notes.push(Note::RefinementTooLong { next, expected, elements, sectors });
            return None;
        }
        self.errors.push(after);
        Some(finer)
    }
}
