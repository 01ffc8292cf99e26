//! Contact chattering: points that touch and lift off in turn.
//!
//! The limit of the shear traction does not vanish with the pressure, so the traction jumps when a point lifts off, and
//! Newton's method can alternate over the jump indefinitely. Such a point is at the contact edge and has almost no
//! pressure. Its friction is set to zero for the rest of the step.

use super::StepFailure;
use crate::interface::contact::{Contact, ContactState, FlatPosition, Status};

/// Number of changes of status in one step after which the friction of a point is set to zero.
const STATUS_CHANGES: u8 = 2;
/// Largest share of the friction removed from points of a stagnant step: that of a point at the edge of a fine mesh.
/// Ordinary slides stay below it.
const LARGEST_RELEASED: f64 = 0.02;
/// Share of removed friction above which a step fails: that of the outermost ring of the coarsest mesh. Ordinary slides
/// stay below 0.02.
const LARGEST_SHARE: f64 = 0.2;

/// Points that chatter in a step.
pub struct Chattering {
    open: Vec<bool>,
    changes: Vec<u8>,
    /// Shear limits of the points whose friction is set to zero.
    taken: Vec<f64>,
}

impl Chattering {
    pub fn new(points: usize) -> Self {
        Self { open: Vec::new(), changes: vec![0; points], taken: vec![0.0; points] }
    }

    /// Records the present state, and sets the friction of points that chatter to zero.
    pub fn damp(&mut self, contact: &Contact, limit: &mut [f64]) -> bool {
        let open: Vec<bool> = contact.trial.status.iter().map(|&s| s == Status::Open).collect();
        let mut damped = false;
        for i in 0..self.open.len() {
            if open[i] != self.open[i] {
                self.changes[i] = self.changes[i].saturating_add(1);
            }
            if self.changes[i] > STATUS_CHANGES && limit[i] > 0.0 {
                self.taken[i] = largest_traction(contact, limit, i);
                limit[i] = 0.0;
                damped = true;
            }
        }
        self.open = open;
        damped
    }

    /// In a stagnant step, sets the friction to zero of points that touch here but not further along: with friction
    /// they lift off, without it they touch. Returns whether the removed share is acceptable; otherwise a shorter
    /// increment is better.
    pub fn release(
        &mut self,
        contact: &mut Contact,
        further: impl Fn(usize) -> f64,
        flat: FlatPosition,
        limit: &[f64],
    ) -> bool {
        let here = contact.trial.clone();
        contact.evaluate(further, flat, limit);
        let there = std::mem::replace(&mut contact.trial, here);
        let touches = |state: &ContactState, i: usize| state.status[i] != Status::Open;
        let alternating: Vec<usize> = (0..limit.len())
            .filter(|&i| touches(&contact.trial, i) != touches(&there, i))
            .filter(|&i| limit[i] > 0.0)
            .collect();
        let (taken, left) = self.friction(contact, limit);
        let released =
            alternating.iter().map(|&i| contact.areas[i] * largest_traction(contact, limit, i)).sum::<f64>();
        let may_help = !alternating.is_empty() && taken + released <= LARGEST_RELEASED * (taken + left);
        if may_help {
            alternating.into_iter().for_each(|i| self.changes[i] = STATUS_CHANGES + 1);
        }
        may_help
    }

    /// Fails if too large a share of the friction is removed.
    pub fn check(&self, contact: &Contact, limit: &[f64]) -> Result<(), StepFailure> {
        let (taken, left) = self.friction(contact, limit);
        let share = if taken > 0.0 { taken / (taken + left) } else { 0.0 };
        if share > LARGEST_SHARE { Err(StepFailure::Chattering { share }) } else { Ok(()) }
    }

    /// Largest friction of the points in contact: removed, and remaining.
    fn friction(&self, contact: &Contact, limit: &[f64]) -> (f64, f64) {
        (0..limit.len()).filter(|&i| contact.trial.status[i] != Status::Open).fold(
            (0.0, 0.0),
            |(taken, left), i| {
                let area = contact.areas[i];
                (taken + area * self.taken[i], left + area * largest_traction(contact, limit, i))
            },
        )
    }
}

/// Largest shear traction of a point: its limit, or without one the traction that it begins the step with.
fn largest_traction(contact: &Contact, limit: &[f64], point: usize) -> f64 {
    let [radial, hoop] = contact.committed.traction[point];
    if limit[point].is_finite() { limit[point] } else { radial.hypot(hoop) }
}
