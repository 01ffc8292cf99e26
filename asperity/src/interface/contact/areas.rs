//! Areas of the contact points on the flat as the surface stretches.
//!
//! In contact the surface is plane: areas grow by det ∂x/∂X of its in-plane deformation, taken midway between two
//! rings.

use super::{Contact, PointState};
use crate::discretisation::collocation::Parity;

impl Contact {
    /// Areas of the deformed surface: of the committed state at the start of a step (a failed step may have left
    /// others), of the trial state later. Returns the largest relative change.
    ///
    /// Within a Newton iteration they are constant, which keeps the tangent symmetric; like the edge they converge over
    /// the iterations.
    pub fn update_areas(&mut self, of_committed: bool) -> f64 {
        let areas = self.deformed_areas(if of_committed { &self.committed } else { &self.trial });
        let change = |(new, old): (&f64, &f64)| (new / old - 1.0).abs();
        let largest = areas.iter().zip(&self.areas).map(change).fold(0.0, f64::max);
        self.areas = areas;
        largest
    }

    fn deformed_areas(&self, state: &[PointState]) -> Vec<f64> {
        let columns = self.columns;
        // (r, θ) components of the displacement. The part of the flat in the relative displacement is a translation.
        let displacement: Vec<f64> = (0..self.radii.len())
            .flat_map(|ring| (0..2).map(move |c| (ring, c)))
            .flat_map(|(ring, c)| (0..columns).map(move |j| -state[ring * columns + j].relative[c]))
            .collect();
        let mut slope = vec![0.0; displacement.len()];
        self.sectors.differentiate(&[Parity::Even, Parity::Odd], &displacement, &mut slope);
        let mut areas = vec![0.0; self.len()];
        for inner in 0..self.radii.len() - 1 {
            let (r0, r1) = (self.radii[inner], self.radii[inner + 1]);
            let (width, middle) = (r1 - r0, 0.5 * (r0 + r1));
            for j in 0..columns {
                let at = |field: &[f64], ring: usize, c: usize| field[(2 * ring + c) * columns + j];
                let mean = |field: &[f64], c: usize| 0.5 * (at(field, inner, c) + at(field, inner + 1, c));
                let across =
                    |c: usize| (at(&displacement, inner + 1, c) - at(&displacement, inner, c)) / width;
                let around = [
                    (mean(&slope, 0) - mean(&displacement, 1)) / middle,
                    (mean(&slope, 1) + mean(&displacement, 0)) / middle,
                ];
                let stretch = (1.0 + across(0)) * (1.0 + around[1]) - across(1) * around[0];
                // ∫N r dr of the two linear functions.
                let weight = self.sectors.weight() * stretch * width / 6.0;
                areas[inner * columns + j] += weight * (2.0 * r0 + r1);
                areas[(inner + 1) * columns + j] += weight * (r0 + 2.0 * r1);
            }
        }
        areas
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::contact;

    /// A plane affine map, symmetric about y = 0, multiplies all areas by its determinant, wherever
    /// the flat is; without displacement they are those of the mesh.
    #[test]
    fn affine_maps_multiply_areas_by_their_determinant() {
        let (mesh, mut contact) = contact();
        assert!(contact.update_areas(true) < 1e-14);
        let (stretch_x, stretch_y, shift) = (1.3, 0.8, 0.02);
        for i in 0..contact.len() {
            let r = contact.radii[i / contact.columns];
            let (sin, cos) = contact.angles[i % contact.columns].sin_cos();
            let (x, y) = ((stretch_x - 1.0) * r * cos + shift, (stretch_y - 1.0) * r * sin);
            // The flat has gone 0.5.
            contact.trial[i].relative = [0.5 * cos - (x * cos + y * sin), -0.5 * sin - (y * cos - x * sin)];
        }
        let change = contact.update_areas(false);
        assert!((change - (1.0 - stretch_x * stretch_y).abs()).abs() < 1e-12, "{change}");
        for (area, before) in contact.areas.iter().zip(mesh.contact_areas()) {
            assert!((area / before - stretch_x * stretch_y).abs() < 1e-12);
        }
        // A failed step leaves the areas unchanged.
        contact.update_areas(true);
        for (area, before) in contact.areas.iter().zip(mesh.contact_areas()) {
            assert!((area / before - 1.0).abs() < 1e-14);
        }
    }
}
