//! Products with the consistent tangent at small strain.

use super::{Body, TENSOR};
use crate::element::{CORNERS, POINTS, VALUES, deviators_and_dilatation, stress_force};
use crate::lanes::Lanes;
use crate::sectors::VECTOR_PARITY;

impl Body {
    pub(super) fn tangent_product_lanes<const W: usize>(&mut self, u: &[f64], force: &mut [f64]) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        let lanes = self.mesh.sectors.columns();
        for (e, element) in self.mesh.elements.iter().enumerate() {
            for first in (0..lanes).step_by(W) {
                let displacement = self.mesh.gather_vector::<W>(u, &self.slope, element, first);
                let nodal_force = self.small_tangent_force(e, first, &displacement);
                self.mesh.scatter_vector(&nodal_force, element, first, force, &mut self.on_slope);
            }
        }
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }

    /// Product of an element's tangent at small strain.
    #[inline(always)]
    pub(super) fn small_tangent_force<const W: usize>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[Lanes<W>; VALUES]; CORNERS],
    ) -> [[Lanes<W>; VALUES]; CORNERS] {
        let at = e * self.mesh.sectors.columns() + first;
        let mut force = if self.tangent.flows[at] {
            self.plastic_element_force(e, first, displacement)
        } else {
            crate::elastic::element_force(&self.mesh.elements[e], self.solid.moduli, displacement)
        };
        if !self.tangent.stiffness.is_empty() {
            let stiffness = &self.tangent.stiffness[at..][..W];
            for component in force.iter_mut().flatten() {
                (0..W).for_each(|l| component[l] *= stiffness[l]);
            }
        }
        force
    }

    #[inline(always)]
    fn plastic_element_force<const W: usize>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[Lanes<W>; VALUES]; CORNERS],
    ) -> [[Lanes<W>; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let (mut stresses, dilatation) = deviators_and_dilatation(element, displacement);
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
                    let mean = if i < 3 { self.solid.moduli.bulk * dilatation[l] } else { 0.0 };
                    component[l] =
                        weight * (shear[l] * component[l] + radial[l] * projection[l] * direction[l] + mean);
                }
            }
        }
        stress_force(element, &stresses)
    }
}
