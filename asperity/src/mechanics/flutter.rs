//! Points that touch and lift off in turn.

use crate::contact::{Contact, Status};

/// Times that a point may touch and lift off in one step before it goes without friction there.
const FLUTTER_LIMIT: u8 = 2;

/// Points that touch and lift off in turn.
///
/// The shear traction at the limit does not fall to nothing with the pressure, so it jumps when a
/// point lifts off, and Newton's method can go to and fro over the jump for ever. Such a point
/// bears next to no pressure, at the very edge.
pub struct Flutter {
    open: Vec<bool>,
    changes: Vec<u8>,
    /// Shear limits that points would have that go without.
    taken: Vec<f64>,
}

impl Flutter {
    pub fn new(points: usize) -> Self {
        Self { open: Vec::new(), changes: vec![0; points], taken: vec![0.0; points] }
    }

    /// Notes the present state, and takes the friction from points that have changed too often.
    pub fn damp(&mut self, contact: &Contact, limit: &mut [f64]) -> bool {
        let open: Vec<bool> = contact.trial.status.iter().map(|&s| s == Status::Open).collect();
        let mut damped = false;
        for i in 0..self.open.len() {
            if open[i] != self.open[i] {
                self.changes[i] = self.changes[i].saturating_add(1);
            }
            if self.changes[i] > FLUTTER_LIMIT && limit[i].is_finite() && limit[i] > 0.0 {
                self.taken[i] = std::mem::take(&mut limit[i]);
                damped = true;
            }
        }
        self.open = open;
        damped
    }

    /// Of the friction that the points in contact could have, what was taken from them.
    pub fn share(&self, contact: &Contact, limit: &[f64]) -> f64 {
        let (mut taken, mut left) = (0.0, 0.0);
        for i in (0..limit.len()).filter(|&i| contact.trial.status[i] != Status::Open) {
            taken += contact.areas[i] * self.taken[i];
            left += contact.areas[i] * limit[i];
        }
        if taken > 0.0 { taken / (taken + left) } else { 0.0 }
    }
}
