//! Products with the consistent tangent, as what it is short of the elastic stiffness.
//!
//! The preconditioner inverts the elastic stiffness at T₀. So in conjugate gradients its product with a
//! direction of search is a sum of residuals that are known, and only the elements whose tangent is another
//! need be gone through: those that flow, three to four in ten in a slide at 20 ω_c.

use super::{Body, TENSOR};
#[cfg(test)]
use crate::elastic;
use crate::element::{CORNERS, POINTS, VALUES, deviators_and_dilatation, stress_force};
use crate::lanes::Pack;
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
                let displacement = self.mesh.gather_vector::<V>(u, &self.slope, element, first);
                let loss = if large {
                    self.finite_loss::<V>(e, first, &displacement)
                } else {
                    self.small_loss::<W, V>(e, first, &displacement)
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
    fn small_loss<const W: usize, V: Pack>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[V; VALUES]; CORNERS],
    ) -> [[V; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let at = e * self.mesh.sectors.columns() + first;
        let one = V::splat(1.0);
        let stiffness =
            if self.tangent.stiffness.is_empty() { one } else { V::load(&self.tangent.stiffness[at..]) };
        let two_shear = V::splat(2.0 * self.solid.moduli.shear);
        let (mut stresses, dilatation) = deviators_and_dilatation(element, displacement);
        let mean = (one - stiffness) * V::splat(self.solid.moduli.bulk) * dilatation;
        for q in 0..POINTS {
            let coefficient = |i: usize| V::load(self.coefficient::<W>(e, q, i, first));
            let stress = &mut stresses[q];
            // n is stale where nothing flows, and its factor zero.
            let mut projection = V::splat(0.0);
            for i in 0..TENSOR {
                let twice = if i < 3 { stress[i] } else { stress[i] + stress[i] };
                projection = coefficient(2 + i).mul_add(twice, projection);
            }
            let weight = V::splat(element.weight[q]);
            let shear = weight * (two_shear - stiffness * coefficient(0));
            let radial = weight * (stiffness * coefficient(1) * projection);
            for (i, component) in stress.iter_mut().enumerate() {
                let of_flow = radial * coefficient(2 + i);
                let rest = if i < 3 { weight.mul_add(mean, -of_flow) } else { -of_flow };
                *component = shear.mul_add(*component, rest);
            }
        }
        stress_force(element, &stresses)
    }

    /// Product of the elastic stiffness at T₀.
    #[cfg(test)]
    pub(super) fn elastic_product_lanes<const W: usize, V: Pack>(&mut self, u: &[f64], force: &mut [f64]) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        for element in &self.mesh.elements {
            for first in (0..self.mesh.sectors.columns()).step_by(W) {
                let displacement = self.mesh.gather_vector::<V>(u, &self.slope, element, first);
                let nodal_force = elastic::element_force(element, self.solid.moduli, &displacement);
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }
}
