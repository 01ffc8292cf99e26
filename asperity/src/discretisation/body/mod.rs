//! The elastic–plastic body: history at the Gauss points, internal forces, consistent tangent
//! and mechanical energies. Small strain here, finite strain in [`finite`] with the same history.
//!
//! Stress at a Gauss point: deviator s = 2G(e − ε_p), mean stress p = K(ε̄_v − 3∫α dθ̄), where the
//! dilatation ε̄_v and the temperature rise θ̄ are means over the element (B̄), and G and K those
//! of the element at θ̄. All moduli are f = E(T)/E(T₀) times those at T₀, so that the stresses over
//! f are those of the moduli at T₀ with a yield strength over f. How stress and plastic strain go on over a step is
//! the material's: [`Solid::flow`]. Its derivative is not symmetric where the stress turns; the tangent here is symmetric,
//! a few per cent off in long steps and exact in short ones and along proportional paths, where it is the consistent one of
//! the radial return (de Souza Neto, Perić & Owen, Computational Methods for Plasticity (2008), eq. (7.120)).

use crate::discretisation::collocation::VECTOR_PARITY;
use crate::discretisation::element::{
    CORNERS, POINTS, RevolvedMesh, deviators_and_dilatation, shape_at_points, stress_force,
};
use crate::material::lanes::{Lanes, Pack, lanes_of};
use crate::material::{Solid, StrainPath};
use wide::{f64x4, f64x8};

mod energies;
mod heat;
mod mises;
mod nodal;
mod state;
mod surface;
mod tangent;

use heat::PointTemperature;
pub use mises::LargestMises;
pub use nodal::NODAL;
pub use state::BodyState;
pub use tangent::InelasticZone;

/// Tangent at points that flow: 2G·across·dev + radial·(n:e)n.
#[derive(Clone, Debug)]
struct Tangent {
    /// Per element and group of lanes: whether any point flows. Where none does, the plastic strains of the
    /// trial state are those of the committed one.
    flows: Vec<bool>,
    /// (2G-factor, radial factor, n) per point, 8 values; relative to E(T)/E(T₀). Where nothing flows
    /// the first two are 2G and 0, and n is stale or zero.
    coefficients: Vec<f64>,
    /// E(T)/E(T₀) per element; empty if constant.
    stiffness: Vec<f64>,
}

#[derive(Clone, Debug)]
pub struct Body {
    pub mesh: RevolvedMesh,
    pub solid: Solid,
    pub committed: BodyState,
    pub trial: BodyState,
    tangent: Tangent,
    /// At finite strain its tangent, at small strain nothing.
    finite: Option<finite::FiniteTangent>,
    shapes: [[f64; CORNERS]; POINTS],
    /// Scratch: ∂u/∂θ, and the forces that work on it.
    slope: Vec<f64>,
    on_slope: Vec<f64>,
}

const TENSOR: usize = 6;
const COEFFICIENTS: usize = 8;

/// Runs the body with so many angles at a time, and the pack that they fill.
macro_rules! by_lanes {
    ($self:ident . $method:ident ( $($argument:expr),* )) => {
        match $self.mesh.sectors.columns() {
            1 => $self.$method::<1, f64>($($argument),*),
            n if n % 8 == 0 => $self.$method::<8, f64x8>($($argument),*),
            _ => $self.$method::<4, f64x4>($($argument),*),
        }
    };
}

mod finite;

impl Body {
    /// Virgin body.
    pub fn new(mesh: RevolvedMesh, solid: Solid) -> Self {
        let (elements, lanes) = (mesh.elements.len(), mesh.sectors.columns());
        let state = BodyState::new(elements, lanes);
        let mut coefficients = vec![0.0; elements * POINTS * COEFFICIENTS * lanes];
        for point in coefficients.chunks_exact_mut(COEFFICIENTS * lanes) {
            point[..lanes].fill(2.0 * solid.moduli.shear);
        }
        let tangent = Tangent {
            flows: vec![false; elements * lanes],
            coefficients,
            stiffness: vec![1.0; if solid.stiffness_varies() { elements * lanes } else { 0 }],
        };
        Self {
            solid,
            committed: state.clone(),
            trial: state,
            tangent,
            finite: None,
            shapes: shape_at_points(),
            slope: vec![0.0; mesh.field_length(3)],
            on_slope: vec![0.0; mesh.field_length(3)],
            mesh,
        }
    }

    /// The same body at finite strain.
    pub fn at_finite_strain(mut self) -> Self {
        let (elements, lanes) = (self.mesh.elements.len(), self.mesh.sectors.columns());
        self.finite = Some(finite::FiniteTangent::new(elements, lanes));
        self
    }

    /// Body of revolution with the history of an axisymmetric one on the same meridian.
    pub fn revolve(axisymmetric: &Body, mesh: RevolvedMesh) -> Self {
        let lanes = mesh.sectors.columns();
        let mut body = Self::new(mesh, axisymmetric.solid.clone());
        if axisymmetric.finite.is_some() {
            body = body.at_finite_strain();
        }
        body.committed = axisymmetric.committed.spread(lanes);
        body.trial = body.committed.clone();
        body
    }

    /// Takes the trial state as the new history.
    pub fn commit(&mut self) {
        self.committed.copy_from(&self.trial);
    }

    /// Back to the history, after a step that failed.
    pub fn restore(&mut self) {
        self.trial.copy_from(&self.committed);
    }

    /// Internal nodal forces at displacement `u` and temperature rise `rise` (zero if absent);
    /// sets the trial state and the tangent.
    pub fn internal_force(&mut self, u: &[f64], rise: Option<&[f64]>, force: &mut [f64]) {
        if self.finite.is_some() {
            self.finite_force(u, rise, force);
        } else if self.solid.stiffness_varies() {
            by_lanes!(self.internal_force_varying(u, rise, force));
        } else {
            by_lanes!(self.internal_force_constant(u, rise, force));
        }
    }

    fn internal_force_varying<const W: usize, V: Pack>(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
        force: &mut [f64],
    ) {
        self.internal_force_lanes::<W, V, true>(u, rise, force);
    }

    fn internal_force_constant<const W: usize, V: Pack>(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
        force: &mut [f64],
    ) {
        self.internal_force_lanes::<W, V, false>(u, rise, force);
    }

    /// VARYING: whether the moduli depend on temperature.
    #[inline(always)]
    fn internal_force_lanes<const W: usize, V: Pack, const VARYING: bool>(
        &mut self,
        u: &[f64],
        rise: Option<&[f64]>,
        force: &mut [f64],
    ) {
        force.fill(0.0);
        self.on_slope.fill(0.0);
        self.mesh.sectors.differentiate(&VECTOR_PARITY, u, &mut self.slope);
        let lanes = self.mesh.sectors.columns();
        for e in 0..self.mesh.elements.len() {
            for first in (0..lanes).step_by(W) {
                let heat = self.element_heat::<W>(e, first, rise, VARYING);
                let element = &self.mesh.elements[e];
                let displacement = self.mesh.gather_vector::<V>(u, &self.slope, element, first);
                let (deviators, dilatation) = deviators_and_dilatation(element, &displacement);
                let dilatation: Lanes<W> = lanes_of(dilatation);
                let mut mean_stress = [0.0; W];
                for l in 0..W {
                    mean_stress[l] = self.solid.moduli.bulk * (dilatation[l] - heat.thermal[l]);
                }
                let at = e * lanes + first;
                if let Some(stiffness) = &heat.stiffness {
                    (0..W).for_each(|l| mean_stress[l] *= stiffness[l]);
                    self.tangent.stiffness[at..at + W].copy_from_slice(stiffness);
                }
                self.trial.mean_stress[at..at + W].copy_from_slice(&mean_stress);
                self.trial.rise[at..at + W].copy_from_slice(&heat.mean_rise);
                let mean_stress = V::load(&mean_stress);
                let mut stresses = [[mean_stress; TENSOR]; POINTS];
                let (stale, mut flows) = (self.tangent.flows[at], false);
                for q in 0..POINTS {
                    let (stress, flowing) =
                        self.point_stress::<W, V>(e, q, first, &deviators[q], heat.at_point(q), stale);
                    flows |= flowing;
                    let weight = V::splat(self.mesh.elements[e].weight[q]);
                    for (i, (joined, &deviatoric)) in stresses[q].iter_mut().zip(&stress).enumerate() {
                        *joined = weight * if i < 3 { deviatoric + mean_stress } else { deviatoric };
                    }
                }
                self.tangent.flows[at] = flows;
                let nodal_force = stress_force(&self.mesh.elements[e], &stresses);
                self.mesh.scatter_vector(
                    &nodal_force,
                    &self.mesh.elements[e],
                    first,
                    force,
                    &mut self.on_slope,
                );
            }
        }
        self.mesh.sectors.add_transposed(&VECTOR_PARITY, &self.on_slope, force);
    }

    /// Stress at one point: its deviator and whether any lane flows; `stale`: whether any point of
    /// the element did the time before.
    #[inline(always)]
    fn point_stress<const W: usize, V: Pack>(
        &mut self,
        e: usize,
        q: usize,
        first: usize,
        deviator: &[V; TENSOR],
        heat: PointTemperature<'_, W>,
        stale: bool,
    ) -> ([V; TENSOR], bool) {
        let lanes = self.mesh.sectors.columns();
        let point = e * POINTS + q;
        let tensor = |i: usize| (point * TENSOR + i) * lanes + first;
        let scalar = point * lanes + first;
        let two_shear = 2.0 * self.solid.moduli.shear;

        let mut squared = V::splat(0.0);
        let mut stress: [V; TENSOR] = std::array::from_fn(|i| {
            let plastic = V::load(&self.committed.plastic_strain[tensor(i)..]);
            let component = V::splat(two_shear) * (deviator[i] - plastic);
            squared = (V::splat(if i < 3 { 1.5 } else { 3.0 }) * component).mul_add(component, squared);
            component
        });
        let squared: Lanes<W> = lanes_of(squared);
        let over_stiffness =
            |factor: f64, l: usize| heat.stiffness.map_or(factor, |[now, _]| factor / now[l]);
        // No softening factor need be evaluated where the lowest one in the element keeps the
        // points elastic.
        let strength = &self.committed.strength[scalar..scalar + W];
        let mut near = false;
        for l in 0..W {
            let least = over_stiffness(heat.weakest, l) * strength[l];
            near |= squared[l] > least * least;
        }
        let mut flowing = [false; W];
        let mut softening = [1.0; W];
        let mut any = false;
        if near {
            softening = self.solid.softening_factors(heat.rise);
            for l in 0..W {
                softening[l] = over_stiffness(softening[l], l);
                let limit = strength[l] * softening[l];
                flowing[l] = squared[l] > limit * limit;
                any |= flowing[l];
            }
        }
        let coefficient = |i: usize| (point * COEFFICIENTS + i) * lanes + first;
        // The return mapping of the iteration before is a good first guess.
        let mut guess = [0.0; W];
        if any || stale {
            for i in 0..TENSOR {
                let at = tensor(i)..tensor(i) + W;
                self.trial.plastic_strain[at.clone()].copy_from_slice(&self.committed.plastic_strain[at]);
            }
            for l in 0..W {
                guess[l] = self.trial.accumulated[scalar + l] - self.committed.accumulated[scalar + l];
                self.trial.accumulated[scalar + l] = self.committed.accumulated[scalar + l];
                self.trial.strength[scalar + l] = self.committed.strength[scalar + l];
            }
        }
        if stale && !any {
            self.tangent.coefficients[coefficient(0)..coefficient(0) + W].fill(two_shear);
            self.tangent.coefficients[coefficient(1)..coefficient(1) + W].fill(0.0);
        }
        if any {
            let at_start = |values: &[f64]| -> Lanes<W> { std::array::from_fn(|l| values[scalar + l]) };
            let mut start = [[0.0; W]; TENSOR];
            for (i, start) in start.iter_mut().enumerate() {
                start.copy_from_slice(&self.committed.deviator[tensor(i)..tensor(i) + W]);
                if let Some([_, before]) = heat.stiffness {
                    (0..W).for_each(|l| start[l] /= before[l]);
                }
            }
            let elastic: [Lanes<W>; TENSOR] = stress.map(lanes_of);
            let path = StrainPath {
                flowing,
                start: &start,
                elastic: &elastic,
                strain: at_start(&self.committed.accumulated),
                strength: at_start(&self.committed.strength),
                softening,
                guess,
            };
            let end = self.solid.flow(&path);
            let stiffness = 3.0 * self.solid.moduli.shear;
            // Elastic where nothing flows: what follows is for all lanes at once.
            let (mut across, mut radial) = ([two_shear; W], [0.0; W]);
            for l in (0..W).filter(|&l| flowing[l]) {
                self.trial.accumulated[scalar + l] = path.strain[l] + end.increment[l];
                self.trial.strength[scalar + l] = end.strength[l];
                // Along the stress the tangent is 2GH/(3G + H). A strength that falls counts as constant, so that
                // it stays definite; and nowhere is it stiffer along the stress than across.
                let slope = end.slope[l].max(0.0);
                across[l] = two_shear * end.across[l];
                radial[l] = (two_shear * (1.0 - stiffness / (stiffness + slope)) - across[l]).min(0.0);
            }
            let at = coefficient(0);
            self.tangent.coefficients[at..at + W].copy_from_slice(&across);
            let at = coefficient(1);
            self.tangent.coefficients[at..at + W].copy_from_slice(&radial);
            for i in 0..TENSOR {
                let (direction, plastic) = (coefficient(2 + i), tensor(i));
                let direction = &mut self.tangent.coefficients[direction..direction + W];
                let plastic = &mut self.trial.plastic_strain[plastic..plastic + W];
                let mut at_end = elastic[i];
                for l in 0..W {
                    let flows = flowing[l];
                    let flown = end.radius[l] * end.direction[i][l];
                    direction[l] = if flows { end.direction[i][l] } else { 0.0 };
                    at_end[l] = if flows { flown } else { at_end[l] };
                    // What of the strain is not elastic.
                    plastic[l] += (elastic[i][l] - at_end[l]) / two_shear;
                }
                stress[i] = V::load(&at_end);
            }
        }
        for (i, component) in stress.iter_mut().enumerate() {
            if let Some([now, _]) = heat.stiffness {
                *component = *component * V::load(now);
            }
            component.store(&mut self.trial.deviator[tensor(i)..]);
        }
        (stress, any)
    }

    /// Angles that are computed together, see `by_lanes`.
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

    /// Coefficient i of the tangent at a point.
    #[inline(always)]
    fn coefficient<const W: usize>(&self, e: usize, q: usize, i: usize, first: usize) -> &[f64] {
        let at = ((e * POINTS + q) * COEFFICIENTS + i) * self.mesh.sectors.columns() + first;
        &self.tangent.coefficients[at..at + W]
    }

    /// Product with a displacement of what the elastic stiffness at T₀ has more than the consistent tangent
    /// at the last internal force. Reads and writes the entries of the zone alone: elsewhere the product is zero.
    pub fn stiffness_loss(&mut self, zone: &InelasticZone, u: &[f64], force: &mut [f64]) {
        by_lanes!(self.stiffness_loss_lanes(zone, u, force));
    }

    /// Product with the consistent tangent itself.
    #[cfg(test)]
    pub fn tangent_product(&mut self, u: &[f64], force: &mut [f64]) {
        let mut loss = vec![0.0; force.len()];
        let zone = self.inelastic_zone();
        self.stiffness_loss(&zone, u, &mut loss);
        by_lanes!(self.elastic_product_lanes(u, force));
        force.iter_mut().zip(&loss).for_each(|(force, loss)| *force -= loss);
    }
}

#[cfg(test)]
mod tests;
