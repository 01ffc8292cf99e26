//! The internal force of a part of the body: the loop over its elements, which sets their trial state and tangent.

use super::finite_tangent::FiniteTangentPart;
use super::partition::PartForces;
use super::state::{BodyState, take};
use super::{Body, COEFFICIENTS};
use crate::discretisation::element::{CORNERS, Element, POINTS, RevolvedMesh, scatter_vector};
use crate::material::Solid;
use crate::material::instruction_set::dispatch;
use crate::material::lanes::Pack;
use wide::f64x4;

/// Elements of the body with their history and tangent; element numbers are those in the part.
pub(super) struct Part<'a> {
    pub mesh: &'a RevolvedMesh,
    pub elements: &'a [Element],
    pub solid: &'a Solid,
    pub time_step: f64,
    pub shapes: &'a [[f64; CORNERS]; POINTS],
    /// ∂u/∂θ at all nodes.
    slope: &'a [f64],
    pub committed: BodyState<&'a [f64]>,
    pub trial: BodyState<&'a mut [f64]>,
    pub tangent: TangentPart<'a>,
    finite_strain: Option<FiniteTangentPart<'a>>,
    corners: &'a [[u32; CORNERS]],
    forces: &'a mut [f64],
}

/// The [`super::Tangent`] of the elements of a part.
pub(super) struct TangentPart<'a> {
    pub flows: &'a mut [bool],
    pub coefficients: &'a mut [f64],
    pub stiffness: &'a mut [f64],
}

impl Body {
    /// The parts of the body, at displacements with these slopes ∂u/∂θ.
    pub(super) fn parts(&mut self) -> Vec<Part<'_>> {
        let (mesh, solid, shapes, slope) = (&self.mesh, &self.solid, &self.shapes, &self.slope[..]);
        let (time_step, committed) = (self.time_step, &self.committed);
        let lanes = mesh.sectors.columns();
        let mut trial = self.trial.slices_mut();
        let mut rest = TangentPart {
            flows: &mut self.tangent.flows,
            coefficients: &mut self.tangent.coefficients,
            stiffness: &mut self.tangent.stiffness,
        };
        let mut finite_strain = self.finite_strain.as_mut().map(FiniteTangentPart::whole);
        let parts = self.partition.parts(lanes).into_iter();
        parts
            .map(|PartForces { elements, corners, forces }| {
                let groups = elements.len() * lanes;
                Part {
                    mesh,
                    elements: &mesh.elements[elements.clone()],
                    solid,
                    time_step,
                    shapes,
                    slope,
                    committed: committed.of_elements(elements, lanes),
                    trial: trial.take(groups),
                    tangent: TangentPart {
                        flows: take(&mut rest.flows, groups),
                        coefficients: take(&mut rest.coefficients, groups * POINTS * COEFFICIENTS),
                        stiffness: take(&mut rest.stiffness, groups),
                    },
                    finite_strain: finite_strain.as_mut().map(|tangent| tangent.take(groups)),
                    corners,
                    forces,
                }
            })
            .collect()
    }
}

impl Part<'_> {
    /// Forces on the nodes of the part at displacement `u` and temperature rise `rise` of the body.
    pub fn internal_force(&mut self, u: &[f64], rise: Option<&[f64]>) {
        dispatch! { <E> fn(part: &mut Part<'_> = self, u: &[f64] = u, rise: Option<&[f64]> = rise) {
            part.forces.fill(0.0);
            // Several points share a vector register where the angles alone do not fill it.
            match part.mesh.sectors.columns() {
                1 => part.force_by_lanes::<1, 4, 4, f64, f64x4>(u, rise),
                4 => part.force_by_lanes::<4, 2, 8, f64x4, E>(u, rise),
                n if n.is_multiple_of(8) => part.force_by_lanes::<8, 1, 8, E, E>(u, rise),
                _ => part.force_by_lanes::<4, 1, 4, f64x4, f64x4>(u, rise),
            }
        }}
    }

    /// W angles at a time, which fill A, and P points of them, which fill the N lanes of V.
    #[inline(always)]
    fn force_by_lanes<const W: usize, const P: usize, const N: usize, A: Pack, V: Pack>(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
    ) {
        match (self.finite_strain.is_some(), self.solid.stiffness_varies()) {
            (true, _) => self.assemble::<W, P, N, A, V, true, false>(u, rise),
            (false, true) => self.assemble::<W, P, N, A, V, false, true>(u, rise),
            (false, false) => self.assemble::<W, P, N, A, V, false, false>(u, rise),
        }
    }

    /// Sum over the elements of the forces on their corners. FINITE: strain measure; VARYING: whether the moduli depend
    /// on temperature, at small strain.
    #[inline(always)]
    fn assemble<
        const W: usize,
        const P: usize,
        const N: usize,
        A: Pack,
        V: Pack,
        const FINITE: bool,
        const VARYING: bool,
    >(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
    ) {
        let columns = self.mesh.sectors.columns();
        let mut finite_strain = self.finite_strain.take();
        for e in 0..self.elements.len() {
            for first in (0..columns).step_by(W) {
                let displacement = self.mesh.gather_vector::<A>(u, self.slope, &self.elements[e], first);
                let of_element = match &mut finite_strain {
                    Some(tangent) if FINITE => {
                        self.finite_strain_force::<W, P, N, A, V>(e, first, &displacement, rise, tangent)
                    }
                    _ => self.small_strain_force::<W, P, N, A, V, VARYING>(e, first, &displacement, rise),
                };
                scatter_vector(&of_element, &self.corners[e], (first, columns), self.forces);
            }
        }
        self.finite_strain = finite_strain;
    }
}
