//! Products with the consistent tangent, as what it is short of the elastic stiffness.
//!
//! The preconditioner inverts the elastic stiffness at T₀. So in conjugate gradients its product with a
//! direction of search is a sum of residuals that are known, and only the elements whose tangent is another
//! need be gone through: those that flow, three to four in ten in a slide at 20 ω_c.

use super::{Body, TENSOR};
#[cfg(test)]
use crate::elastic;
use crate::element::{CORNERS, POINTS, VALUES, deviators_and_dilatation, stress_force};
use crate::lanes::{Lanes, Pack};
use crate::sectors::VECTOR_PARITY;

impl Body {
    /// V has room for W angles.
    pub(super) fn stiffness_loss_lanes<const W: usize, V: Pack>(&mut self, u: &[f64], force: &mut [f64]) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        let lanes = self.mesh.sectors.columns();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for first in (0..lanes).step_by(W) {
                let at = e * lanes + first;
                let large = self.finite.as_ref().is_some_and(|tangent| !tangent.is_small(at));
                if !large && !self.tangent.flows[at] && self.at_first_stiffness::<W>(at) {
                    continue;
                }
                let displacement = self.mesh.gather_vector::<W>(u, &self.slope, element, first);
                let loss = if large {
                    self.finite_loss::<W, V>(e, first, &displacement)
                } else {
                    self.small_loss(e, first, &displacement)
                };
                self.mesh.scatter_vector(&loss, element, first, force, &mut self.on_slope);
            }
        }
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }

    /// Whether the moduli are those at T₀.
    fn at_first_stiffness<const W: usize>(&self, at: usize) -> bool {
        self.tangent.stiffness.is_empty() || self.tangent.stiffness[at..][..W] == [1.0; W]
    }

    /// Share of an element at small strain.
    #[inline(always)]
    fn small_loss<const W: usize>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[Lanes<W>; VALUES]; CORNERS],
    ) -> [[Lanes<W>; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let at = e * self.mesh.sectors.columns() + first;
        let mut stiffness = [1.0; W];
        if !self.tangent.stiffness.is_empty() {
            stiffness.copy_from_slice(&self.tangent.stiffness[at..][..W]);
        }
        let two_shear = 2.0 * self.solid.moduli.shear;
        let (mut stresses, dilatation) = deviators_and_dilatation(element, displacement);
        let mut mean = [0.0; W];
        for l in 0..W {
            mean[l] = (1.0 - stiffness[l]) * self.solid.moduli.bulk * dilatation[l];
        }
        for q in 0..POINTS {
            let coefficient = |i: usize| self.coefficient::<W>(e, q, i, first);
            let (shear, radial) = (coefficient(0), coefficient(1));
            let stress = &mut stresses[q];
            // n is stale where nothing flows, and its factor zero.
            let mut projection = [0.0; W];
            for i in 0..TENSOR {
                let direction = coefficient(2 + i);
                let factor = if i < 3 { 1.0 } else { 2.0 };
                for l in 0..W {
                    projection[l] += factor * direction[l] * stress[i][l];
                }
            }
            let weight = element.weight[q];
            for (i, component) in stress.iter_mut().enumerate() {
                let direction = coefficient(2 + i);
                for l in 0..W {
                    let mean = if i < 3 { mean[l] } else { 0.0 };
                    let shear = two_shear - stiffness[l] * shear[l];
                    let radial = stiffness[l] * radial[l] * projection[l];
                    component[l] = weight * (shear * component[l] - radial * direction[l] + mean);
                }
            }
        }
        stress_force(element, &stresses)
    }

    /// Product of the elastic stiffness at T₀.
    #[cfg(test)]
    pub(super) fn elastic_product_lanes<const W: usize>(&mut self, u: &[f64], force: &mut [f64]) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        for element in &self.mesh.elements {
            for first in (0..self.mesh.sectors.columns()).step_by(W) {
                let displacement = self.mesh.gather_vector::<W>(u, &self.slope, element, first);
                let nodal_force = elastic::element_force(element, self.solid.moduli, &displacement);
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }
}
