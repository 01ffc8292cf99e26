//! Contact fraction of each node: the part of its area inside the contact edge.

use super::{Contact, PointState, Status};
use crate::interface::contact_edge::EdgeRatios;
use crate::scene::fitted_constants::contact_edge::FITTED;

impl Contact {
    /// Position of the edge of the trial state at each angle (see `interface::contact_edge`), in cells of the rings from the axis
    /// on; the cell of a ring extends half a spacing to both sides.
    pub fn trial_edges(&self) -> Vec<f64> {
        (0..self.columns).map(|j| self.trial_edge(j)).collect()
    }

    fn trial_edge(&self, j: usize) -> f64 {
        let Some(last) = self.last_ring(j) else { return self.radii.len() as f64 };
        // The pressure of a ring that has just touched is arbitrary: its spring was not in the stiffness that gave the penetration.
        let position = match self.edge_ratios(j) {
            None => 0.5,
            Some(_) if self.has_touched_at(j) => FITTED.first_position,
            Some(ratios) => FITTED.position(&ratios),
        };
        last as f64 + (0.5 + position).max(0.0)
    }

    /// Whether a ring has touched since the last iterate of Newton's method.
    pub fn has_just_touched(&self) -> bool {
        (0..self.columns).any(|j| self.has_touched_at(j))
    }

    fn has_touched_at(&self, j: usize) -> bool {
        self.rings_before[j].is_some_and(|before| self.last_ring(j) > Some(before))
    }

    /// The trial state is an iterate of Newton's method: rings that touch later have just touched.
    pub fn begin_iteration(&mut self) {
        self.rings_before = (0..self.columns).map(|j| self.last_ring(j)).collect();
    }

    /// The ratios that locate the edge of the trial state at an angle; none where the contact has no inner ring, or none beyond
    /// it.
    pub fn edge_ratios(&self, j: usize) -> Option<EdgeRatios> {
        let at = |ring: usize| ring * self.columns + j;
        let last = self.last_ring(j)?;
        if last == 0 || last + 2 >= self.radii.len() {
            return None;
        }
        let (gap, beyond) = (self.trial[at(last + 1)].gap, self.trial[at(last + 2)].gap);
        let (rise, spacing) = (beyond - gap, self.radii[last + 2] - self.radii[last + 1]);
        let inner = at(last - 1);
        let pressure = self.trial[inner].pressure;
        let slips = self.trial[inner].status == Status::Slip;
        // c_ν τ_r.
        let inclination = if slips { self.shear_slope * self.trial[inner].traction[0] } else { 0.0 };
        let opens = rise > 0.0;
        Some(EdgeRatios {
            pressure: if pressure > 0.0 { (self.trial[at(last)].pressure / pressure).min(1.0) } else { 1.0 },
            gap: if opens {
                (gap / rise * spacing / (self.radii[last + 1] - self.radii[last])).clamp(0.0, 1.0)
            } else {
                1.0
            },
            shear_slope: if opens { inclination * spacing / rise } else { 0.0 },
        })
    }

    /// Outermost ring that touches at an angle in the trial state.
    pub fn last_ring(&self, j: usize) -> Option<usize> {
        (0..self.radii.len()).rev().find(|&k| self.trial[k * self.columns + j].pressure > 0.0)
    }

    /// Position of the edge at each angle, in cells of the rings: the sum of the contact fractions.
    pub fn edges(&self) -> Vec<f64> {
        (0..self.columns).map(|j| self.contact_fraction.iter().skip(j).step_by(self.columns).sum()).collect()
    }

    /// Contact fractions from the positions of the edge, which lies in the cell of the last ring that touches or of the next
    /// one.
    pub fn set_edges(&mut self, edges: &[f64]) {
        for (j, &edge) in edges.iter().enumerate() {
            let last = self.last_ring(j);
            for ring in 0..self.radii.len() {
                self.contact_fraction[ring * self.columns + j] = match last {
                    Some(last) if ring < last => 1.0,
                    Some(last) if ring <= last + 1 => (edge - ring as f64).clamp(0.0, 1.0),
                    _ => 0.0,
                };
            }
        }
    }

    /// χ_i A_i: area of a point inside the edge, in the given state; none where the surface has lifted off within the contact.
    pub fn covered_area(&self, state: &[PointState], point: usize) -> f64 {
        let fraction = self.contact_fraction[point];
        let in_contact = state[point].status != Status::Open || fraction < 1.0;
        if in_contact { self.areas[point] * fraction } else { 0.0 }
    }

    /// Whether the contact has come so near the rim of the mesh that its edge cannot be located.
    pub fn at_rim(&self, state: &[PointState]) -> bool {
        let touching = |i: &usize| state[*i].pressure > 0.0;
        let outermost = (0..self.len()).rev().find(touching).map_or(0, |i| i / self.columns);
        outermost + 2 >= self.radii.len()
    }
}
