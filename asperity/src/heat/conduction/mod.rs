//! Transient heat conduction in the body, heated at the contact and by plastic work.
//!
//! ρcθ̇ = ∇·(k∇θ) + sources for the rise θ above the initial temperature, at which base and flat are held. In terms
//! of the enthalpy H = ∫c/c₀ dθ and the potential Θ = ∫k/k₀ dθ (Kirchhoff) that is
//!
//! ```text
//! ρc₀ Ḣ = k₀ ∇²Θ + sources,      discretised  C_T Ḣ + K_T Θ = q(θ) + body heat,
//! ```
//!
//! with the lumped heat capacity C_T, on the mesh of the body with its upper layers divided ([`sublayers`]). The enthalpy is
//! advanced, so the heat balance closes whatever peaks and jumps c has. With constant properties H = Θ = θ.
//!
//! Time: the two-stage L-stable SDIRK of second order (Alexander 1977, SIAM J. Numer. Anal. 14, 1006,
//! doi:10.1137/0714068), whose stages share the matrix C_T + γΔt K_T. Heat that depends on the temperature of the contact
//! (softening friction, gap conductance) is implicit. A stage is solved by one of two methods: at constant properties
//! only the contact is nonlinear, and its Schur complement is iterated ([`contact_iteration`]); otherwise, and where
//! that fails to converge, a convex function of Θ is minimised ([`kirchhoff`]). Chapter "Conduction" of the book.

use std::sync::Arc;

use nalgebra::Matrix3;

use crate::discretisation::element::{CORNERS, HOURGLASS, POINTS, RevolvedMesh, shape_at_points};
use crate::heat::counterface::HalfSpace;
use crate::heat::properties::ThermalProperties;
use crate::solver::harmonic::{FactorError, FieldKind, HarmonicPattern};
use contact_iteration::ContactIteration;
use counterface_step::{ContactDisc, CounterfaceStep};
use kirchhoff::Kirchhoff;
use step::{HeatState, Integrated, Step, StepMatrix};
use sublayers::Sublayers;

mod contact_iteration;
mod counterface_step;
mod kirchhoff;
mod step;
pub mod sublayers;

/// γ = 1 − 1/√2.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Number of step sizes whose factors are stored.
const KEPT_FACTORS: usize = 3;

/// Why a step of conduction was not solved.
#[derive(Debug, thiserror::Error)]
pub enum HeatError {
    #[error(transparent)]
    Factor(#[from] FactorError),
    #[error("conduction did not converge (residual {residual:.1e})")]
    NotConverged { residual: f64 },
}

/// Heat flow into each contact point as a function of its temperature rise: value and slope.
pub trait ContactHeat {
    /// Heat per time into contact point `point` at rise `rise`, and its derivative (never positive).
    fn flow(&self, point: usize, rise: f64) -> (f64, f64);

    /// The part of the flow that leaves into the flat; positive.
    fn loss(&self, _point: usize, _rise: f64) -> f64 {
        0.0
    }

    /// Area of contact point `point` that is in contact: there a conducting counterface takes up heat.
    fn area(&self, _point: usize) -> f64 {
        0.0
    }

    /// Displacement of the counterface in the step.
    fn slip(&self) -> f64 {
        0.0
    }
}

/// Heat exchanged in one step, half body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeatBalance {
    /// Heat in through the contact; what a conducting counterface takes up is not included.
    pub contact: f64,
    /// Heat out into the flat.
    pub gap: f64,
    /// Heat into a conducting counterface.
    pub counterface: f64,
    /// Heat given to the body directly.
    pub body: f64,
    /// Heat out through the base.
    pub base: f64,
}

/// Solution of a step, from which the next one of the same length starts.
struct Tried {
    dt: f64,
    stages: [HeatState; 2],
    /// Jacobian of the balance with a conducting counterface, see [`CounterfaceStep`].
    jacobian: Option<Matrix3<f64>>,
}

pub struct Conduction {
    /// Mesh of the body with its upper layers divided.
    mesh: RevolvedMesh,
    sublayers: Sublayers,
    /// ρc₀ per kelvin (κ = 1, so also k₀).
    capacity: f64,
    pattern: HarmonicPattern,
    /// Entries of C_T and K_T in the pattern.
    entries: [Vec<f64>; 2],
    /// C_T at the nodes.
    heat_capacities: Vec<f64>,
    /// Factors for the last step sizes used.
    cache: Vec<(f64, Arc<StepMatrix>)>,
    contact_indices: Vec<usize>,
    /// Properties that depend on temperature; none where specific heat and conductivity are constant.
    varying: Option<Kirchhoff>,
    /// The body that faces the contact, if it conducts.
    pub(crate) counterface: Option<HalfSpace>,
    /// The step advanced last since the last commit.
    tried: Option<Tried>,
    /// Committed temperatures at the nodes, those of the body first.
    pub committed: HeatState,
}

impl Conduction {
    /// Conduction on the mesh of a body, with its first layer divided into `sublayers` parts and the next ones halved; with one
    /// part on the mesh of the body itself.
    pub fn new(body: &RevolvedMesh, capacity: f64, sublayers: u32) -> Result<Self, FactorError> {
        let (mesh, sublayers) = Sublayers::divide(body, sublayers);
        let columns = mesh.sectors.columns();
        let heat_capacities = mesh.nodal_volumes().iter().map(|v| capacity * v).collect();
        let contact = mesh.meridian.contact.iter();
        let contact_indices =
            contact.flat_map(|&n| (0..columns).map(move |j| n as usize * columns + j)).collect();
        let pattern = HarmonicPattern::new(&mesh, FieldKind::Scalar)?;
        let entries = [(capacity, 0.0), (0.0, capacity)].map(|(capacity, conductivity)| {
            pattern.assemble(&mesh, |e, m| element_matrix(&mesh, e, capacity, conductivity, m))
        });
        Ok(Self {
            pattern,
            entries,
            capacity,
            heat_capacities,
            cache: Vec::new(),
            contact_indices,
            varying: None,
            counterface: None,
            tried: None,
            committed: HeatState::linear(vec![0.0; mesh.field_length(1)]),
            sublayers,
            mesh,
        })
    }

    /// Sets properties that depend on temperature, if there are any.
    pub fn with_properties(mut self, properties: Option<ThermalProperties>) -> Self {
        self.varying = properties.map(|properties| Kirchhoff::new(&self.mesh, self.capacity, properties));
        self
    }

    /// Sets the conducting counterface, if there is one.
    pub fn with_counterface(mut self, counterface: Option<HalfSpace>) -> Self {
        self.counterface = counterface;
        self
    }

    /// Makes the temperatures after the step that was advanced last the committed ones.
    pub fn commit(&mut self) {
        if let Some(Tried { stages: [_, last], .. }) = self.tried.take() {
            self.committed = last;
        }
        if let Some(counterface) = &mut self.counterface {
            counterface.commit();
        }
    }

    /// Height of the surface of a counterface that expands after the step that was advanced last, and its derivative along +x,
    /// at each contact point, with the area of each that is in contact; nothing without one, or without contact.
    pub fn elevation(&self, area: impl Fn(usize) -> f64) -> Option<Vec<[f64; 2]>> {
        let disc = Some(self.contact_disc(area)).filter(|disc| disc.total > 0.0)?;
        let profile = self.counterface.as_ref()?.height_tried()?;
        Some((0..self.contact_indices.len()).map(|point| disc.elevation(point, profile)).collect())
    }

    fn contact_disc(&self, area: impl Fn(usize) -> f64) -> ContactDisc {
        let areas = (0..self.contact_indices.len()).map(area).collect();
        let (radii, angles) = (self.mesh.meridian.contact_radii(), self.mesh.sectors.angles());
        ContactDisc::new(areas, |point| {
            let (sin, cos) = angles[point % angles.len()].sin_cos();
            [cos, sin].map(|share| radii[point / angles.len()] * share)
        })
    }

    /// C_T + γΔt K_T, factorised.
    fn step_matrix(&mut self, dt: f64) -> Result<Arc<StepMatrix>, FactorError> {
        if let Some((_, matrix)) = self.cache.iter().find(|(cached, _)| *cached == dt) {
            return Ok(matrix.clone());
        }
        let [capacity, conduction] = &self.entries;
        let values: Vec<f64> = capacity.iter().zip(conduction).map(|(c, k)| c + GAMMA * dt * k).collect();
        let matrix = Arc::new(StepMatrix::new(self.pattern.factorise(&self.mesh, &values, &|| false)?));
        if self.cache.len() >= KEPT_FACTORS {
            self.cache.remove(0);
        }
        self.cache.push((dt, matrix.clone()));
        Ok(matrix)
    }

    /// Length of a scalar field of the body.
    pub fn body_length(&self) -> usize {
        self.sublayers.body_length()
    }

    /// Temperature rise at the nodes of the body as its elements need it, see [`sublayers`].
    pub fn of_body(&self, rise: &[f64]) -> Vec<f64> {
        self.sublayers.of_body(rise)
    }

    /// Temperature rise after a step of `dt` from the committed one, with `body` the heat given
    /// to each node of the body over the step and `heat` the flow at the contact.
    pub fn advance(
        &mut self,
        dt: f64,
        body: &[f64],
        heat: &dyn ContactHeat,
    ) -> Result<(Vec<f64>, HeatBalance), HeatError> {
        let matrix = self.step_matrix(dt)?;
        let body = &self.sublayers.spread(body)[..];
        let tried = self.tried.take().filter(|tried| tried.dt == dt);
        let counterface = self.counterface.as_ref().map(|half_space| {
            let disc = self.contact_disc(|point| heat.area(point));
            let known = tried.as_ref().and_then(|tried| tried.jacobian);
            // κ = 1: the effusivity is the capacity.
            CounterfaceStep::new(half_space, disc, (self.capacity, known), (dt, heat.slip()))
        });
        let step =
            Step { conduction: self, matrix: &matrix, dt, body, heat, counterface: counterface.as_ref() };
        let solved = match &self.varying {
            Some(varying) => step.integrate(&mut &*varying, tried.as_ref().map(|tried| &tried.stages)),
            None => match step.integrate(&mut ContactIteration::default(), None) {
                // At kinks of the heat flow Newton's method may cycle; minimisation is slower and does not cycle.
                Err(HeatError::NotConverged { .. }) => {
                    let constant = Kirchhoff::new(&self.mesh, self.capacity, ThermalProperties::constant());
                    step.integrate(&mut &constant, None)
                }
                done => done,
            },
        };
        let Integrated { stages, balance, fluxes } = solved?;
        let rise = stages[1].rise.clone();
        let (response, jacobian) =
            counterface.map(|counterface| (counterface.response, counterface.jacobian.get())).unzip();
        self.tried = Some(Tried { dt, stages, jacobian });
        if let Some((half_space, response)) = self.counterface.as_mut().zip(response) {
            half_space.try_fluxes(response, fluxes);
        }
        Ok((rise, balance))
    }

    fn on_base(&self, index: usize) -> bool {
        self.mesh.meridian.is_base[index / self.mesh.sectors.columns()]
    }

    /// Heat per time that leaves through the base at a potential Θ; the sum over θ has the mean harmonic alone.
    fn base_flow(&self, potential: &[f64]) -> f64 {
        let mesh = &self.mesh;
        let columns = mesh.sectors.columns();
        let sum = |node: u32| potential[node as usize * columns..][..columns].iter().sum::<f64>();
        let is_base = |node: u32| mesh.meridian.is_base[node as usize];
        let mut flow = 0.0;
        for (e, element) in mesh.elements.iter().enumerate() {
            if element.nodes.iter().any(|&n| is_base(n)) {
                let matrix = element_matrix(mesh, e, 0.0, self.capacity, 0);
                for (a, _) in element.nodes.iter().enumerate().filter(|(_, n)| is_base(**n)) {
                    flow -=
                        (0..CORNERS).map(|b| matrix[a * CORNERS + b] * sum(element.nodes[b])).sum::<f64>();
                }
            }
        }
        flow
    }

    /// Heat in the body after the step that was advanced last, half body: ∫ρc₀H dV.
    pub fn stored(&self) -> f64 {
        let state = self.tried.as_ref().map_or(&self.committed, |tried| &tried.stages[1]);
        state.enthalpy.iter().zip(&self.heat_capacities).map(|(enthalpy, capacity)| enthalpy * capacity).sum()
    }
}

/// Lumped heat capacity plus `conductivity` times conduction of one element for harmonic m, 4 × 4.
///
/// In the products of derivatives along one side of the reference square, the shape functions along the other are lumped
/// as well: this adds (|∇ξ|² + |∇η|²) hhᵀ/24 with h the hourglass mode. On rectangles it gives the five-point difference,
/// which with a lumped capacity has no temperatures outside those around, however thin the elements; without it the rise
/// beside a jump of the flux over thin elements is wrong by a tenth, with either sign.
fn element_matrix(mesh: &RevolvedMesh, e: usize, capacity: f64, conductivity: f64, m: usize) -> Vec<f64> {
    let shapes = shape_at_points();
    let element = &mesh.elements[e];
    let squared = (m * m) as f64;
    let mut matrix = vec![0.0; CORNERS * CORNERS];
    for q in 0..POINTS {
        let weight = element.weight[q];
        let gradients = element.reference_gradients(q);
        for (i, a) in element.shape[q].iter().enumerate() {
            matrix[i * (CORNERS + 1)] += capacity * weight * shapes[q][i];
            for (j, b) in element.shape[q].iter().enumerate() {
                let product = a.dr * b.dr + a.dz * b.dz + squared * a.over_r * b.over_r;
                let product = product + gradients / 24.0 * HOURGLASS[i] * HOURGLASS[j];
                matrix[i * CORNERS + j] += conductivity * weight * product;
            }
        }
    }
    matrix
}

#[cfg(test)]
mod tests;
