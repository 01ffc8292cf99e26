//! Contact chattering: points that touch and lift off in turn.
//!
//! The limit of the shear traction does not vanish with the pressure, so the traction jumps when a point lifts off, and
//! Newton's method can alternate over the jump indefinitely. Such a point is at the contact edge and has almost no
//! pressure. Its friction is set to zero for the rest of the step.

use super::StepFailure;
use crate::interface::contact::{Contact, Status};

/// Number of changes of status in one step after which the friction of a point is set to zero.
const STATUS_CHANGES: u8 = 2;
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
        let open: Vec<bool> = contact.trial.iter().map(|state| state.status == Status::Open).collect();
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

    /// Fails if too large a share of the friction is removed.
    pub fn check(&self, contact: &Contact, limit: &[f64]) -> Result<(), StepFailure> {
        let (taken, left) = self.friction(contact, limit);
        let share = if taken > 0.0 { taken / (taken + left) } else { 0.0 };
        if share > LARGEST_SHARE { Err(StepFailure::Chattering { share }) } else { Ok(()) }
    }

    /// Largest friction of the points in contact: removed, and remaining.
    fn friction(&self, contact: &Contact, limit: &[f64]) -> (f64, f64) {
        (0..limit.len()).filter(|&i| contact.trial[i].status != Status::Open).fold(
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
    let [radial, hoop] = contact.committed[point].traction;
    if limit[point].is_finite() { limit[point] } else { radial.hypot(hoop) }
}
