//! Products with the stiffness loss: elastic stiffness at T₀ minus consistent tangent.
//!
//! The preconditioner inverts the elastic stiffness at T₀. So in conjugate gradients its product with a search
//! direction is a sum of known residuals, and only the elements with another tangent contribute: those that flow, 30
//! to 40 % of them in a slide at 20 ω_c.

use std::ops::Range;

use wide::f64x4;

use super::partition::PartForces;
#[cfg(test)]
use super::partition::differentiate;
use super::point_stress::Points;
use super::{Body, TENSOR};
#[cfg(test)]
use crate::discretisation::elastic;
use crate::discretisation::element::{
    CORNERS, POINTS, VALUES, deviators_and_dilatation, scatter_vector, stress_force,
};
use crate::discretisation::runs::Runs;
use crate::material::instruction_set::dispatch;
use crate::material::lanes::Pack;

/// Inelastic zone: where the tangent at the last internal force is not the elastic stiffness at T₀, i.e. elements that
/// flow, have other moduli or large displacement gradients.
pub struct InelasticZone {
    pub(super) elements: Vec<u32>,
    /// For each part of the body, its range in `elements`.
    pub(super) ranges: Vec<Range<usize>>,
    /// For each part, whether that range is not empty.
    pub(super) active: Vec<bool>,
    /// Nodes of these elements and of the contact.
    pub nodes: Vec<usize>,
    /// Displacements of these nodes.
    pub entries: Runs,
}

impl Body {
    /// The zone at the last internal force.
    pub fn inelastic_zone(&self) -> InelasticZone {
        let lanes = self.mesh.sectors.columns();
        let elements: Vec<u32> = (0..self.mesh.elements.len())
            .filter(|e| (0..lanes).step_by(self.group()).any(|first| self.is_inelastic(e * lanes + first)))
            .map(|e| e as u32)
            .collect();
        let mut touched = vec![false; self.mesh.node_count()];
        let of_elements = elements.iter().flat_map(|&e| &self.mesh.elements[e as usize].nodes);
        of_elements.chain(&self.mesh.meridian.contact).for_each(|&node| touched[node as usize] = true);
        let nodes: Vec<usize> = (0..touched.len()).filter(|&node| touched[node]).collect();
        let entries = Runs::of_blocks(nodes.iter().copied(), 3 * lanes);
        let ranges = self.partition.ranges_of(&elements);
        let active = ranges.iter().map(|range| !range.is_empty()).collect();
        InelasticZone { elements, ranges, active, nodes, entries }
    }

    /// Whether the tangent of a group of angles of an element differs from the elastic one.
    fn is_inelastic(&self, at: usize) -> bool {
        let moduli = &self.tangent.stiffness;
        self.is_large(at)
            || self.tangent.flows[at]
            || !moduli.is_empty() && moduli[at..at + self.group()].iter().any(|&factor| factor != 1.0)
    }

    /// Whether the moduli of small strain are not accurate enough.
    fn is_large(&self, at: usize) -> bool {
        self.finite_strain.as_ref().is_some_and(|tangent| !tangent.small[at])
    }

    /// Sum over elements of the zone in one part.
    pub(super) fn stiffness_loss_of(&self, part: PartForces<'_>, elements: &[u32], u: &[f64]) {
        if elements.is_empty() {
            return;
        }
        dispatch! { <E> fn(
            body: &Body = self,
            part: PartForces<'_> = part,
            elements: &[u32] = elements,
            u: &[f64] = u,
        ) {
            part.forces.fill(0.0);
            match body.mesh.sectors.columns() {
                1 => body.stiffness_loss_lanes::<1, 4, f64, f64x4>(part, elements, u),
                n if n.is_multiple_of(8) => body.stiffness_loss_lanes::<8, 1, E, E>(part, elements, u),
                _ => body.stiffness_loss_lanes::<4, 1, f64x4, f64x4>(part, elements, u),
            }
        }}
    }

    /// W angles at a time, which fill A, and P points of them, which fill V.
    #[inline(always)]
    fn stiffness_loss_lanes<const W: usize, const P: usize, A: Pack, V: Pack>(
        &self,
        part: PartForces<'_>,
        elements: &[u32],
        u: &[f64],
    ) {
        let lanes = self.mesh.sectors.columns();
        for e in elements.iter().map(|&e| e as usize) {
            let element = &self.mesh.elements[e];
            for first in (0..lanes).step_by(W) {
                let at = e * lanes + first;
                if !self.is_inelastic(at) {
                    continue;
                }
                let displacement = self.mesh.gather_vector::<A>(u, &self.slope, element, first);
                let loss = if self.is_large(at) {
                    self.finite_loss::<W, P, A, V>(e, first, &displacement)
                } else {
                    self.small_loss::<A>(e, first, &displacement)
                };
                scatter_vector(&loss, &part.corners[e - part.elements.start], (first, lanes), part.forces);
            }
        }
    }

    /// Contribution of an element at small strain.
    #[inline(always)]
    fn small_loss<V: Pack>(
        &self,
        e: usize,
        first: usize,
        displacement: &[[V; VALUES]; CORNERS],
    ) -> [[V; VALUES]; CORNERS] {
        let element = &self.mesh.elements[e];
        let lanes = self.mesh.sectors.columns();
        let at = e * lanes + first;
        let one = V::splat(1.0);
        let stiffness =
            if self.tangent.stiffness.is_empty() { one } else { V::load(&self.tangent.stiffness[at..]) };
        let two_shear = V::splat(2.0 * self.solid.moduli.shear);
        let (mut stresses, dilatation) = deviators_and_dilatation(element, displacement);
        let mean = (one - stiffness) * V::splat(self.solid.moduli.bulk) * dilatation;
        for q in 0..POINTS {
            let point = Points { e, chunk: q, first, lanes };
            let coefficient = |i: usize| V::load(&self.tangent.coefficients[point.coefficient(i)..]);
            let stress = &mut stresses[q];
            // n is not updated at elastic points, where its factor is zero.
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
    pub(super) fn elastic_product(&mut self, u: &[f64], force: &mut [f64]) {
        differentiate(&self.mesh.sectors, &self.nodes, u, &mut self.slope);
        let columns = self.mesh.sectors.columns();
        for part in self.partition.parts(columns) {
            part.forces.fill(0.0);
            for (e, corners) in part.elements.zip(part.corners) {
                let element = &self.mesh.elements[e];
                for first in 0..columns {
                    let displacement = self.mesh.gather_vector::<f64>(u, &self.slope, element, first);
                    let nodal_force = elastic::element_force(element, self.solid.moduli, &displacement);
                    scatter_vector(&nodal_force, corners, (first, columns), part.forces);
                }
            }
        }
        self.partition.forces_on(&self.mesh.sectors, &self.nodes, &self.partition.all(), force);
    }
}
