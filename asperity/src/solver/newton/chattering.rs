//! Points that touch and lift off in turn.

use crate::interface::contact::{Contact, ContactState, FlatPosition, Status};

/// Times that a point may touch and lift off in one step before it goes without friction there.
const FLUTTER_LIMIT: u8 = 2;
/// Share of the friction up to which points at which no step leads on go without: that of a point at the edge of a
/// fine mesh. Ordinary slides lose less.
const MOST_WAVERING: f64 = 0.02;

/// Points that touch and lift off in turn.
///
/// The shear traction at the limit does not fall to nothing with the pressure, so it jumps when a
/// point lifts off, and Newton's method can go to and fro over the jump for ever. Such a point
/// bears next to no pressure, at the very edge.
pub struct Chattering {
    open: Vec<bool>,
    changes: Vec<u8>,
    /// Shear limits that points would have that go without.
    taken: Vec<f64>,
}

impl Chattering {
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

    /// Where no step leads on, points that touch here but would not further along: the body pushes them off by their
    /// friction and back without it, so Newton's method stays at the jump between. Counts them as having changed too
    /// often; answers whether that may help: a shorter increment is better than much of the friction gone.
    pub fn waver(
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
        let wavering: Vec<usize> = (0..limit.len())
            .filter(|&i| touches(&contact.trial, i) != touches(&there, i))
            .filter(|&i| limit[i].is_finite() && limit[i] > 0.0)
            .collect();
        let (taken, left) = self.friction(contact, limit);
        let of_wavering = wavering.iter().map(|&i| contact.areas[i] * limit[i]).sum::<f64>();
        let may_help = !wavering.is_empty() && taken + of_wavering <= MOST_WAVERING * (taken + left);
        if may_help {
            wavering.into_iter().for_each(|i| self.changes[i] = FLUTTER_LIMIT + 1);
        }
        may_help
    }

    /// Of the friction that the points in contact could have, what was taken from them.
    pub fn share(&self, contact: &Contact, limit: &[f64]) -> f64 {
        let (taken, left) = self.friction(contact, limit);
        if taken > 0.0 { taken / (taken + left) } else { 0.0 }
    }

    /// Of the points in contact, taken from them and left to them.
    fn friction(&self, contact: &Contact, limit: &[f64]) -> (f64, f64) {
        (0..limit.len()).filter(|&i| contact.trial.status[i] != Status::Open).fold(
            (0.0, 0.0),
            |(taken, left), i| {
                let area = contact.areas[i];
                (taken + area * self.taken[i], left + area * limit[i])
            },
        )
    }
}
