//! The elastic-plastic body: history at the Gauss points, internal forces, consistent tangent and mechanical energies.
//!
//! The strain measure is a property of the element kernel: [`small_strain`] or [`finite_strain`], with the same
//! history. Stress and plastic strain at the end of a step follow from the material, [`Solid::flow`], called in
//! [`point_stress`]. Moduli are f = E(T)/E(T₀) times those at T₀, f at the mean temperature of the element; stresses
//! over f are those of the moduli at T₀ with a yield strength over f.
//!
//! The derivative of the stress is not symmetric where the stress turns; the tangent is symmetric. It is exact in short
//! steps and along proportional paths, where it is the consistent tangent of the radial return (de Souza Neto, Perić &
//! Owen, Computational Methods for Plasticity (2008), eq. (7.120)), while its error in long steps is a few per cent.
//!
//! Depends on `element`, `collocation` and `crate::material`. Chapters "Mesh and elements" and "Integration of plastic
//! flow" of the book.

use crate::discretisation::collocation::VECTOR_PARITY;
use crate::discretisation::element::{CORNERS, POINTS, RevolvedMesh, shape_at_points};
use crate::material::Solid;
use crate::material::instruction_set::dispatch;
use crate::material::lanes::Pack;
use wide::f64x4;

mod energies;
mod finite_strain;
mod mises;
mod nodal;
mod packing;
mod point_stress;
mod small_strain;
mod state;
mod surface;
mod tangent;
mod temperature;

pub use mises::{MeanStress, mises};
pub use nodal::NODAL;
pub use state::BodyState;
pub use tangent::InelasticZone;

/// Tangent at points that flow: 2G·across·dev + radial·(n:e)n.
#[derive(Clone, Debug)]
struct Tangent {
    /// Per element and group of lanes: whether any point flows. Where none does, trial and committed plastic strains
    /// are equal.
    flows: Vec<bool>,
    /// (2G-factor, radial factor, n): 8 values of each point, see [`state::place_of`]; relative to E(T)/E(T₀). At
    /// elastic points the first two are 2G and 0, and n is not updated.
    coefficients: Vec<f64>,
    /// E(T)/E(T₀) per element; empty if constant.
    stiffness: Vec<f64>,
}

#[derive(Clone, Debug)]
pub struct Body {
    pub mesh: RevolvedMesh,
    pub solid: Solid,
    /// Length of the present step, s; infinite at the reference strain rate, as in the press.
    pub time_step: f64,
    pub committed: BodyState,
    pub trial: BodyState,
    tangent: Tangent,
    /// Tangent of the kernel of finite strain; none at small strain.
    finite_strain: Option<finite_strain::FiniteTangent>,
    shapes: [[f64; CORNERS]; POINTS],
    /// Scratch: ∂u/∂θ, and the forces that work on it.
    slope: Vec<f64>,
    on_slope: Vec<f64>,
}

const TENSOR: usize = 6;
const COEFFICIENTS: usize = 8;

impl Body {
    /// Virgin body.
    pub fn new(mesh: RevolvedMesh, solid: Solid) -> Self {
        let (elements, lanes) = (mesh.elements.len(), mesh.sectors.columns());
        let state = BodyState::new(elements, lanes);
        let mut coefficients = vec![0.0; elements * POINTS * COEFFICIENTS * lanes];
        for element in coefficients.chunks_exact_mut(COEFFICIENTS * POINTS * lanes) {
            element[..POINTS * lanes].fill(2.0 * solid.moduli.shear);
        }
        let tangent = Tangent {
            flows: vec![false; elements * lanes],
            coefficients,
            stiffness: vec![1.0; if solid.stiffness_varies() { elements * lanes } else { 0 }],
        };
        Self {
            solid,
            time_step: f64::INFINITY,
            committed: state.clone(),
            trial: state,
            tangent,
            finite_strain: None,
            shapes: shape_at_points(),
            slope: vec![0.0; mesh.field_length(3)],
            on_slope: vec![0.0; mesh.field_length(3)],
            mesh,
        }
    }

    /// The same body at finite strain.
    pub fn at_finite_strain(mut self) -> Self {
        let (elements, lanes) = (self.mesh.elements.len(), self.mesh.sectors.columns());
        self.finite_strain = Some(finite_strain::FiniteTangent::new(elements, lanes));
        self
    }

    /// Body of revolution with the history of an axisymmetric one on the same meridian.
    pub fn revolve(axisymmetric: &Body, mesh: RevolvedMesh) -> Self {
        let lanes = mesh.sectors.columns();
        let mut body = Self::new(mesh, axisymmetric.solid.clone());
        if axisymmetric.finite_strain.is_some() {
            body = body.at_finite_strain();
        }
        body.committed = axisymmetric.committed.spread(lanes);
        body.trial = body.committed.clone();
        body
    }

    /// Takes the trial state as the committed one.
    pub fn commit(&mut self) {
        self.committed.copy_from(&self.trial);
    }

    /// Resets the trial state to the committed one, after a failed step.
    pub fn restore(&mut self) {
        self.trial.copy_from(&self.committed);
    }

    /// Internal nodal forces at displacement `u` and temperature rise `rise` (zero if absent);
    /// sets the trial state and the tangent. The force of an inverted element is NaN.
    pub fn internal_force(&mut self, u: &[f64], rise: Option<&[f64]>, force: &mut [f64]) {
        dispatch! { <E> fn(
            body: &mut Body = self,
            u: &[f64] = u,
            rise: Option<&[f64]> = rise,
            force: &mut [f64] = force,
        ) {
            force.fill(0.0);
            body.on_slope.fill(0.0);
            body.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut body.slope);
            // Several points share a vector register where the angles alone do not fill it.
            match body.mesh.sectors.columns() {
                1 => body.force_by_lanes::<1, 4, 4, f64, f64x4>(u, rise, force),
                4 => body.force_by_lanes::<4, 2, 8, f64x4, E>(u, rise, force),
                n if n.is_multiple_of(8) => body.force_by_lanes::<8, 1, 8, E, E>(u, rise, force),
                _ => body.force_by_lanes::<4, 1, 4, f64x4, f64x4>(u, rise, force),
            }
            body.mesh.sectors.add_transposed(&VECTOR_PARITY, &body.on_slope, force);
        }}
    }

    /// W angles at a time, which fill A, and P points of them, which fill the N lanes of V.
    #[inline(always)]
    fn force_by_lanes<const W: usize, const P: usize, const N: usize, A: Pack, V: Pack>(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
        force: &mut [f64],
    ) {
        match (self.finite_strain.is_some(), self.solid.stiffness_varies()) {
            (true, _) => self.assemble::<W, P, N, A, V, true, false>(u, rise, force),
            (false, true) => self.assemble::<W, P, N, A, V, false, true>(u, rise, force),
            (false, false) => self.assemble::<W, P, N, A, V, false, false>(u, rise, force),
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
        force: &mut [f64],
    ) {
        let mut finite_strain = self.finite_strain.take();
        for e in 0..self.mesh.elements.len() {
            for first in (0..self.mesh.sectors.columns()).step_by(W) {
                let displacement =
                    self.mesh.gather_vector::<A>(u, &self.slope, &self.mesh.elements[e], first);
                let of_element = match &mut finite_strain {
                    Some(tangent) if FINITE => {
                        self.finite_strain_force::<W, P, N, A, V>(e, first, &displacement, rise, tangent)
                    }
                    _ => self.small_strain_force::<W, P, N, A, V, VARYING>(e, first, &displacement, rise),
                };
                let element = &self.mesh.elements[e];
                self.mesh.scatter_vector(&of_element, element, first, force, &mut self.on_slope);
            }
        }
        self.finite_strain = finite_strain;
    }

    /// Angles that are computed together.
    fn group(&self) -> usize {
        match self.mesh.sectors.columns() {
            1 => 1,
            n if n.is_multiple_of(8) => 8,
            _ => 4,
        }
    }

    /// Whether any point flows of element e and the group of angles that l belongs to.
    fn group_flows(&self, e: usize, l: usize) -> bool {
        self.tangent.flows[e * self.mesh.sectors.columns() + l - l % self.group()]
    }

    /// Share of the elements, angle by angle in groups of lanes, with a point that flows.
    pub fn flowing_share(&self) -> f64 {
        let groups = self.tangent.flows.iter().step_by(self.group());
        groups.clone().filter(|flows| **flows).count() as f64 / groups.len() as f64
    }

    /// Product of the stiffness loss, elastic stiffness at T₀ minus consistent tangent at the last internal force, with
    /// a displacement. Reads and writes the entries of the zone alone: elsewhere the product is zero.
    pub fn stiffness_loss(&mut self, zone: &InelasticZone, u: &[f64], force: &mut [f64]) {
        dispatch! { <E> fn(
            body: &mut Body = self,
            zone: &InelasticZone = zone,
            u: &[f64] = u,
            force: &mut [f64] = force,
        ) {
            for run in zone.entries.iter() {
                force[run.clone()].fill(0.0);
                body.on_slope[run.clone()].fill(0.0);
                body.mesh.sectors.differentiate(&VECTOR_PARITY, &u[run.clone()], &mut body.slope[run]);
            }
            match body.mesh.sectors.columns() {
                1 => body.stiffness_loss_lanes::<1, 4, f64, f64x4>(zone, u, force),
                n if n.is_multiple_of(8) => body.stiffness_loss_lanes::<8, 1, E, E>(zone, u, force),
                _ => body.stiffness_loss_lanes::<4, 1, f64x4, f64x4>(zone, u, force),
            }
            for run in zone.entries.iter() {
                let (on_slope, force) = (&body.on_slope[run.clone()], &mut force[run]);
                body.mesh.sectors.add_transposed(&VECTOR_PARITY, on_slope, force);
            }
        }}
    }

    /// Product with the consistent tangent itself.
    #[cfg(test)]
    pub fn tangent_product(&mut self, u: &[f64], force: &mut [f64]) {
        let mut loss = vec![0.0; force.len()];
        let zone = self.inelastic_zone();
        self.stiffness_loss(&zone, u, &mut loss);
        self.elastic_product_lanes::<1, f64>(u, force);
        force.iter_mut().zip(&loss).for_each(|(force, loss)| *force -= loss);
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) use tests::test_solid;
