//! Contact fraction of each node: the part of its area inside the contact edge, 1 but at the edge.

use super::{Contact, ContactState, Status};
use crate::interface::contact_edge::FITTED;
use crate::scene::fitted_constants::contact_edge::LARGEST_FRACTION;

impl Contact {
    /// Contact fractions of the trial state.
    pub fn update_contact_fraction(&mut self) {
        let edges = self.trial_edges();
        self.set_edges(&edges);
    }

    /// Place of the edge of the trial state at each angle (see `interface::contact_edge`), in cells of the rings from the axis
    /// on; the cell of a ring extends half a spacing to both sides.
    pub fn trial_edges(&self) -> Vec<f64> {
        (0..self.columns).map(|j| self.trial_edge(j)).collect()
    }

    fn trial_edge(&self, j: usize) -> f64 {
        let at = |ring: usize| ring * self.columns + j;
        let rings = self.radii.len();
        let Some(last) = self.last_ring(j) else { return rings as f64 };
        if last == 0 || last + 2 >= rings {
            return (last + 1) as f64;
        }
        let (gap, beyond) = (self.trial.gap[at(last + 1)], self.trial.gap[at(last + 2)]);
        let widths =
            (self.radii[last + 2] - self.radii[last + 1]) / (self.radii[last + 1] - self.radii[last]);
        let closing = if beyond > gap { (gap / (beyond - gap) * widths).clamp(0.0, 1.0) } else { 1.0 };
        let inner = self.trial.pressure[at(last - 1)];
        let load = if inner > 0.0 { (self.trial.pressure[at(last)] / inner).min(1.0) } else { 1.0 };
        last as f64 + (0.5 + FITTED.place(load, closing)).max(0.0)
    }

    /// Outermost ring that touches at an angle in the trial state.
    fn last_ring(&self, j: usize) -> Option<usize> {
        (0..self.radii.len()).rev().find(|&k| self.trial.status[k * self.columns + j] != Status::Open)
    }

    /// Place of the edge at each angle: the sum of the contact fractions.
    pub fn edges(&self) -> Vec<f64> {
        (0..self.columns).map(|j| self.contact_fraction.iter().skip(j).step_by(self.columns).sum()).collect()
    }

    /// Contact fractions from the places of the edge: the last ring in contact has the part of its cell inside the
    /// edge, and slightly more than 1 just before the next ring touches.
    pub fn set_edges(&mut self, edges: &[f64]) {
        for (j, &edge) in edges.iter().enumerate() {
            let last = self.last_ring(j);
            for ring in 0..self.radii.len() {
                self.contact_fraction[ring * self.columns + j] = match last {
                    Some(last) if ring == last => (edge - ring as f64).clamp(0.0, LARGEST_FRACTION),
                    // A ring that touches before the edge is evaluated again has no contact fraction yet.
                    Some(last) if ring > last => 0.0,
                    _ => 1.0,
                };
            }
        }
    }

    /// Whether the contact has come so near the rim of the mesh that its edge cannot be located.
    pub fn at_rim(&self, state: &ContactState) -> bool {
        let touching = |i: &usize| state.status[*i] != Status::Open;
        let outermost = (0..self.len()).rev().find(touching).map_or(0, |i| i / self.columns);
        outermost + 2 >= self.radii.len()
    }
}
