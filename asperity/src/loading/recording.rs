//! States of a slide recorded as fields: over the contact and, if chosen, in the body.
//!
//! An increment of the slide ends at each slip that is to be recorded; nothing else is influenced by recording.

use crate::heat::conduction::Conduction;
use crate::interface::contact::{Contact, Status};
use crate::loading::body_fields::BodySnapshot;
use crate::loading::problem::Units;
use crate::loading::state::SlideState;
use crate::solver::newton::Mechanics;

/// States of a run recorded as fields. Always recorded: the start of the slide, slip of half of the
/// contact, full slip and the end; in a programme the end of each step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Slips in units of a₀, summed over the steps of a programme, at each of which an increment ends.
    pub slips: Vec<f64>,
    /// Whether displacement, stress, plastic strain and temperature of the body are recorded as well.
    pub body: bool,
}

/// Fields over the contact plane in one state, over (theta, r) in row-major order. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    pub slip: f64,
    pub time: f64,
    pub status: Vec<Status>,
    pub pressure: Vec<f64>,
    pub shear: Vec<f64>,
    pub temperature: Vec<f64>,
    pub slip_distance: Vec<f64>,
}

impl Snapshot {
    fn of(now: &SlideState, contact: &Contact, conduction: Option<&Conduction>, units: &Units) -> Self {
        let state = &contact.committed;
        let (rings, columns) = (contact.radii.len(), contact.angles.len());
        // The state is stored ring by ring.
        let points = || (0..columns).flat_map(|j| (0..rings).map(move |k| k * columns + j));
        let shear = |at: usize| state[at].traction[0].hypot(state[at].traction[1]);
        let rise = |at: usize| conduction.map_or(0.0, |c| c.committed.rise[contact.scalar_index(at)]);
        Self {
            slip: now.slip * units.length,
            time: now.time * units.time,
            status: points().map(|at| state[at].status).collect(),
            pressure: points().map(|at| units.stress * state[at].pressure).collect(),
            shear: points().map(|at| units.stress * shear(at)).collect(),
            temperature: points().map(|at| units.temperature + rise(at)).collect(),
            slip_distance: points().map(|at| units.length * state[at].slip).collect(),
        }
    }
}

/// Records states of one slide.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    /// Slips not yet reached, over R, in descending order.
    slips: Vec<f64>,
    /// Stick area fractions not yet reached, in ascending order.
    stick_fractions: Vec<f64>,
    body: bool,
    /// Recorded last.
    last: Option<SlideState>,
    pub contact: Vec<Snapshot>,
    pub bodies: Vec<BodySnapshot>,
}

impl Recorder {
    /// Recorder for a slide of an asperity of contact radius `radius` (over R) that starts in `start`.
    pub fn new(recording: &Recording, radius: f64, start: &SlideState) -> Self {
        let mut slips: Vec<f64> = recording.slips.iter().map(|slip| slip * radius).collect();
        slips.sort_by(|a, b| b.total_cmp(a));
        let stick_fractions = [0.0, 0.5].into_iter().filter(|&share| share < start.stick_fraction).collect();
        Self { slips, stick_fractions, body: recording.body, ..Self::default() }
    }

    /// Smallest slip not yet reached, over R.
    pub fn next_slip(&self) -> Option<f64> {
        self.slips.last().copied()
    }

    /// Whether the state `now` is to be recorded, after slip along `path` (over R).
    pub fn is_due(&mut self, path: f64, now: &SlideState) -> bool {
        let before = (self.slips.len(), self.stick_fractions.len());
        let slipped = path * (1.0 + 1e-12);
        while self.slips.pop_if(|next| *next <= slipped).is_some() {}
        while self.stick_fractions.pop_if(|next| now.stick_fraction <= *next).is_some() {}
        before != (self.slips.len(), self.stick_fractions.len())
    }

    /// Records the committed state, unless it is already recorded.
    pub fn keep(
        &mut self,
        now: &SlideState,
        mechanics: &Mechanics,
        conduction: Option<&Conduction>,
        units: &Units,
    ) {
        if self.last.replace(*now) == Some(*now) {
            return;
        }
        self.contact.push(Snapshot::of(now, &mechanics.contact, conduction, units));
        if self.body {
            self.bodies.push(BodySnapshot::of(now, mechanics, conduction, units));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(slip: f64, stick_fraction: f64) -> SlideState {
        SlideState { slip, stick_fraction, ..SlideState::default() }
    }

    #[test]
    fn due_are_half_slip_full_slip_and_the_slips_asked_for_each_once() {
        let recording = Recording { slips: vec![30.0, 5.0], body: false };
        let mut recorder = Recorder::new(&recording, 0.1, &at(0.0, 1.0));
        let states = [
            (0.1, 0.9, false),
            (0.2, 0.5, true),
            (0.3, 0.4, false),
            (0.51, 0.3, true),
            (0.6, 0.0, true),
            (0.7, 0.2, false),
            (0.8, 0.0, false),
            (3.0, 0.0, true),
            (4.0, 0.0, false),
        ];
        for (slip, stick, due) in states {
            assert_eq!(recorder.is_due(slip, &at(slip, stick)), due, "{slip}");
        }
    }

    #[test]
    fn a_contact_that_never_sticks_has_no_full_slip_to_wait_for() {
        let mut recorder = Recorder::new(&Recording::default(), 0.1, &at(0.0, 0.0));
        assert!(!recorder.is_due(0.1, &at(0.1, 0.0)));
    }
}
