//! One slide at one resolution.

use std::sync::Arc;

use super::pressed::PressedMesh;
use crate::heat::counterface::HalfSpace;
use crate::interface::contact::Contact;
use crate::loading::body_fields::BodyFields;
use crate::loading::recording::Snapshot;
use crate::loading::slide::SlideFailure;
use crate::loading::state::SlideState;
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::expected_time::time_of;
use crate::simulate::steady::SteadyState;
use crate::simulate::values::Values;
use crate::solver::newton::Effort;
use crate::solver::timings::{Kernel, Timings};

/// One slide at one resolution, up to its end or failure, and the press that it started from.
pub(super) struct Run {
    pub resolution: Resolution,
    pub press: Arc<PressedMesh>,
    pub history: Vec<SlideState>,
    pub values: Values,
    /// Steady state of a run that went on beyond its end.
    pub steady: Option<SteadyState>,
    pub snapshots: Vec<Snapshot>,
    pub body: Option<BodyFields>,
    /// Contact at the end of the slide.
    pub contact: Contact,
    /// Counterface with its heat at the end of the slide, if it conducts.
    pub counterface: Option<HalfSpace>,
    pub unknowns: usize,
    pub effort: Effort,
    pub timings: Timings,
    pub cutbacks: usize,
    pub failure: Option<SlideFailure>,
}

impl Run {
    pub fn is_cancelled(&self) -> bool {
        matches!(self.failure, Some(SlideFailure::Cancelled))
    }

    /// Whether it has come further than `other`: it has ended, or neither has and it has more states, which both take by
    /// the same rule.
    pub fn is_ahead_of(&self, other: &Self) -> bool {
        self.failure.is_none() || other.failure.is_some() && self.history.len() > other.history.len()
    }

    /// Largest plastic strain.
    pub fn plastic_strain(&self) -> f64 {
        self.history.last().map_or(0.0, |state| state.plastic_strain_max)
    }

    /// Largest plastic strain in the last state before sliding inception; 0 without a slide.
    pub fn plastic_strain_in_stick(&self) -> f64 {
        let sticking = self.history.iter().take_while(|state| !state.slides());
        let strain = sticking.last().map_or(0.0, |state| state.plastic_strain_max);
        if self.history.len() > 1 { strain } else { 0.0 }
    }

    /// Largest mean shear traction |Q|/A, over the initial yield strength.
    pub fn largest_traction(&self) -> f64 {
        self.history.iter().map(|state| (state.friction / state.area).abs()).fold(0.0, f64::max)
    }

    /// d ln Q/d ln s over the displacement of the last step, of a contact that has not slid; 0 of one that has.
    pub fn friction_exponent(&self) -> f64 {
        let [.., before, last] = &self.history[..] else { return 0.0 };
        if self.history.iter().any(SlideState::slides) {
            return 0.0;
        }
        let start = self.history.iter().rev().find(|state| state.step != last.step);
        let displacement = last.slip - start.unwrap_or(&self.history[0]).slip;
        let slope = (last.friction - before.friction) / (last.slip - before.slip);
        let exponent = (slope * displacement / last.friction).abs();
        if exponent.is_finite() { exponent } else { 0.0 }
    }

    /// Processor time of the slide by its counts, s.
    pub fn expected_time(&self) -> f64 {
        time_of(self.effort.newton, self.unknowns)
    }

    /// Time of the slide without the press, s.
    pub fn slide_time(&self) -> f64 {
        self.timings.total() - self.timings.of(Kernel::Press)
    }

    /// Contact radius over that after the press at which the contact left the fine mesh.
    pub fn outgrown(&self) -> Option<f64> {
        match self.failure {
            Some(SlideFailure::OutgrewMesh { radius_ratio }) => Some(radius_ratio),
            _ => None,
        }
    }

    /// Whether its contact, or that of a slide that went on, has outgrown its mesh.
    pub fn lacks_room(&self) -> bool {
        self.outgrown().is_some() || self.steady.is_some_and(|steady| steady.lacks_room())
    }
}
