//! The elastic-plastic body: history at the Gauss points, internal forces, consistent tangent and mechanical energies.
//!
//! The internal force is computed by parts of the body ([`part`], [`partition`]), which threads share.
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

use rayon::prelude::*;

use crate::discretisation::element::{CORNERS, POINTS, RevolvedMesh, shape_at_points};
use crate::discretisation::threads::least_share;
use crate::material::Solid;
use partition::{Partition, differentiate};

mod energies;
mod finite_strain;
mod finite_tangent;
mod mises;
mod nodal;
mod packing;
mod part;
mod partition;
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
    /// (2G-factor, radial factor, n): 8 values of each point, see [`state::value_index`]; relative to E(T)/E(T₀). At
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
    finite_strain: Option<finite_tangent::FiniteTangent>,
    shapes: [[f64; CORNERS]; POINTS],
    partition: Partition,
    /// All nodes.
    nodes: Vec<usize>,
    /// Scratch: ∂u/∂θ.
    slope: Vec<f64>,
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
            partition: Partition::new(&mesh),
            nodes: (0..mesh.node_count()).collect(),
            slope: vec![0.0; mesh.field_length(3)],
            mesh,
        }
    }

    /// This body at finite strain.
    pub fn at_finite_strain(mut self) -> Self {
        let (elements, lanes) = (self.mesh.elements.len(), self.mesh.sectors.columns());
        self.finite_strain = Some(finite_tangent::FiniteTangent::new(elements, lanes));
        self
    }

    /// Body of revolution with the history of an axisymmetric one on the same meridian.
    pub fn revolve(axisymmetric: &Body, mesh: RevolvedMesh) -> Self {
        let committed = axisymmetric.committed.spread(&mesh.sectors);
        let mut body = Self::new(mesh, axisymmetric.solid.clone());
        if axisymmetric.finite_strain.is_some() {
            body = body.at_finite_strain();
        }
        body.trial = committed.clone();
        body.committed = committed;
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
        let sectors = &self.mesh.sectors;
        differentiate(sectors, &self.nodes, u, &mut self.slope);
        let parts = self.parts().into_par_iter().with_min_len(least_share());
        parts.for_each(|mut part| part.internal_force(u, rise));
        self.partition.forces_on(&self.mesh.sectors, &self.nodes, &self.partition.all(), force);
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
        differentiate(&self.mesh.sectors, &zone.nodes, u, &mut self.slope);
        let mut partition = std::mem::take(&mut self.partition);
        let parts = partition.parts(self.mesh.sectors.columns()).into_par_iter().zip(&zone.ranges);
        parts
            .with_min_len(least_share())
            .for_each(|(part, elements)| self.stiffness_loss_of(part, &zone.elements[elements.clone()], u));
        partition.forces_on(&self.mesh.sectors, &zone.nodes, &zone.active, force);
        self.partition = partition;
    }

    /// Product with the consistent tangent itself.
    #[cfg(test)]
    pub fn tangent_product(&mut self, u: &[f64], force: &mut [f64]) {
        let mut loss = vec![0.0; force.len()];
        let zone = self.inelastic_zone();
        self.stiffness_loss(&zone, u, &mut loss);
        self.elastic_product(u, force);
        force.iter_mut().zip(&loss).for_each(|(force, loss)| *force -= loss);
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) use tests::test_solid;
