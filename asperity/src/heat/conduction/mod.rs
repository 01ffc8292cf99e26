//! Transient heat conduction in the body, heated at the contact and by plastic work.
//!
//! ρcθ̇ = ∇·(k∇θ) + sources for the rise θ above the initial temperature, which the base and the
//! flat keep. Lumped heat capacity; properties that depend on temperature are in `varying`. Time: the
//! two-stage L-stable SDIRK of second order (Alexander 1977, SIAM J. Numer. Anal. 14, 1006), whose
//! stages share one matrix. Heat that depends on the contact's own temperature (softening friction,
//! gap conductance) is implicit: a small dense problem on the contact's Schur complement.

use std::sync::Arc;

use faer::linalg::solvers::{Llt, SolveCore};
use faer::{Mat, MatMut, Side};

use crate::discretisation::collocation::Parity;
use crate::discretisation::element::{CORNERS, POINTS, RevolvedMesh, shape_at_points};
use crate::solver::harmonic::{FactorError, FieldKind, HarmonicFactors, HarmonicPattern};

mod varying;

pub use varying::ThermalProperties;
use varying::Varying;

/// 1 − 1/√2.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
const CONTACT_ITERATIONS: usize = 40;
/// Reduction of the change in one iteration at the contact that is too little for slopes of before.
const SLOW: f64 = 0.1;

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

    /// The part of the flow that goes out, into the flat; positive.
    fn loss(&self, _point: usize, _rise: f64) -> f64 {
        0.0
    }
}

/// Heat that passed in one step, half body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeatBalance {
    /// In through the contact.
    pub contact: f64,
    /// Out into the flat.
    pub gap: f64,
    /// Given to the body directly.
    pub body: f64,
    /// Out through the base.
    pub base: f64,
}

pub struct Conduction {
    mesh: RevolvedMesh,
    /// ρc per kelvin (κ = 1, so also k).
    capacity: f64,
    pattern: HarmonicPattern,
    /// Of M and K in the pattern.
    entries: [Vec<f64>; 2],
    mass: Vec<f64>,
    /// Factors for the last step sizes used.
    cache: Vec<(f64, Arc<StepMatrix>)>,
    contact_places: Vec<usize>,
    /// None where specific heat and conductivity are constant.
    varying: Option<Varying>,
    pub committed: Vec<f64>,
}

/// The contact's Schur complement with slopes of the heat flows, factorised.
struct Chord {
    slopes: Vec<f64>,
    factor: Llt<f64>,
}

/// What the stages of a step share.
struct Stages<'a> {
    matrix: &'a StepMatrix,
    /// γΔt.
    scale: f64,
    chord: Option<Chord>,
}

/// M + γΔt·K.
struct StepMatrix {
    factors: HarmonicFactors,
    /// Schur complement of the contact, dense over (ring, harmonic).
    contact: Mat<f64>,
}

impl Conduction {
    pub fn new(mesh: &RevolvedMesh, capacity: f64) -> Result<Self, FactorError> {
        let columns = mesh.sectors.columns();
        let mass = mesh.nodal_volumes().iter().map(|v| capacity * v).collect();
        let contact_places = mesh
            .meridian
            .contact
            .iter()
            .flat_map(|&n| (0..columns).map(move |j| n as usize * columns + j))
            .collect();
        let pattern = HarmonicPattern::new(mesh, FieldKind::Scalar)?;
        let entries = [(capacity, 0.0), (0.0, capacity)].map(|(mass, conductivity)| {
            pattern.assemble(mesh, |e, m| element_matrix(mesh, e, mass, conductivity, m))
        });
        Ok(Self {
            pattern,
            entries,
            capacity,
            mass,
            cache: Vec::new(),
            contact_places,
            varying: None,
            committed: vec![0.0; mesh.field_length(1)],
            mesh: mesh.clone(),
        })
    }

    /// The same with properties that depend on temperature, if there are any.
    pub fn with_properties(mut self, properties: Option<ThermalProperties>) -> Self {
        self.varying = properties.map(|properties| Varying::new(&self.mesh, self.capacity, properties));
        self
    }

    fn step_matrix(&mut self, dt: f64) -> Result<Arc<StepMatrix>, FactorError> {
        if let Some((_, matrix)) = self.cache.iter().find(|(cached, _)| *cached == dt) {
            return Ok(matrix.clone());
        }
        let [mass, conduction] = &self.entries;
        let values: Vec<f64> = mass.iter().zip(conduction).map(|(m, k)| m + GAMMA * dt * k).collect();
        let factors = self.pattern.factorise_assembled(&self.mesh, &values)?;
        let (rings, harmonics) = (factors.contact_unknowns(), factors.harmonics());
        let mut contact = Mat::zeros(rings * harmonics, rings * harmonics);
        for m in 0..harmonics {
            let schur = factors.contact_stiffness(m);
            for i in 0..rings {
                for j in 0..rings {
                    contact[(i * harmonics + m, j * harmonics + m)] = schur[i * rings + j];
                }
            }
        }
        let matrix = Arc::new(StepMatrix { factors, contact });
        if self.cache.len() >= 3 {
            self.cache.remove(0);
        }
        self.cache.push((dt, matrix.clone()));
        Ok(matrix)
    }

    /// Temperature rise after a step of `dt` from the committed one, with `body` the heat given
    /// to each node over the step and `heat` the flow at the contact.
    pub fn advance(
        &mut self,
        dt: f64,
        body: &[f64],
        heat: &dyn ContactHeat,
    ) -> Result<(Vec<f64>, HeatBalance), HeatError> {
        let matrix = self.step_matrix(dt)?;
        if let Some(varying) = &self.varying {
            return self.advance_varying(varying, &matrix, dt, body, heat);
        }
        match self.advance_constant(&matrix, dt, body, heat) {
            // Kinks of the heat flow may send Newton's method back and forth; the other way, with its
            // line search, is slower but cannot be.
            Err(HeatError::NotConverged { .. }) => {
                let varying = Varying::new(&self.mesh, self.capacity, ThermalProperties::constant());
                self.advance_varying(&varying, &matrix, dt, body, heat)
            }
            done => done,
        }
    }

    fn advance_constant(
        &self,
        matrix: &StepMatrix,
        dt: f64,
        body: &[f64],
        heat: &dyn ContactHeat,
    ) -> Result<(Vec<f64>, HeatBalance), HeatError> {
        let n = self.committed.len();
        let mut rhs = vec![0.0; n];
        for i in 0..n {
            rhs[i] = self.mass[i] * self.committed[i] + GAMMA * body[i];
        }
        let mut first = vec![0.0; n];
        let mut stages = Stages { matrix, scale: GAMMA * dt, chord: None };
        let flow_first = self.stage(&mut stages, &rhs, heat, &self.committed, &mut first)?;
        let ratio = (1.0 - GAMMA) / GAMMA;
        for i in 0..n {
            let start = self.committed[i] + ratio * (first[i] - self.committed[i]);
            rhs[i] = self.mass[i] * start + GAMMA * body[i];
        }
        let mut last = vec![0.0; n];
        let flow_last = self.stage(&mut stages, &rhs, heat, &first, &mut last)?;
        let weighted = |a: f64, b: f64| dt * ((1.0 - GAMMA) * a + GAMMA * b);
        let balance = HeatBalance {
            contact: weighted(flow_first.0 + flow_first.1, flow_last.0 + flow_last.1),
            gap: weighted(flow_first.1, flow_last.1),
            body: (0..n).filter(|&i| !self.on_base(i)).map(|i| body[i]).sum(),
            base: weighted(self.base_flow(&first), self.base_flow(&last)),
        };
        Ok((last, balance))
    }

    /// Solves (M + γΔtK)θ = rhs + γΔt·q(θ) with q at the contact; returns the net flow and the loss.
    ///
    /// The dense system takes most of the time, so its factor is kept from iteration to iteration and from
    /// stage to stage until its slopes are too far off.
    fn stage(
        &self,
        stages: &mut Stages<'_>,
        rhs: &[f64],
        heat: &dyn ContactHeat,
        guess: &[f64],
        solution: &mut [f64],
    ) -> Result<(f64, f64), HeatError> {
        let Stages { matrix, scale, chord } = stages;
        let scale = *scale;
        let factors = &matrix.factors;
        let mut modal = vec![0.0; factors.modal_length()];
        factors.to_modal(rhs, &mut modal);
        factors.forward(&mut modal);
        let contact = &mut modal[factors.contact_offset()..];
        let size = contact.len();
        let columns = factors.harmonics();
        let table = factors.transform.of(Parity::Even);
        let free = contact.to_vec();
        let mut rise: Vec<f64> = self.contact_places.iter().map(|&p| guess[p]).collect();
        let mut residual = f64::INFINITY;
        for _ in 0..CONTACT_ITERATIONS {
            // (S − γΔt q₁′)θ = f + γΔt(q − q₁′θ), with slopes q₁′ of now or of before.
            let flows: Vec<(f64, f64)> = (0..rise.len()).map(|i| heat.flow(i, rise[i])).collect();
            let Chord { slopes, factor } = match &mut *chord {
                Some(chord) => chord,
                none => {
                    let slopes: Vec<f64> = flows.iter().map(|flow| flow.1).collect();
                    let factor = self.contact_factor(matrix, scale, |point| slopes[point])?;
                    none.insert(Chord { slopes, factor })
                }
            };
            contact.copy_from_slice(&free);
            for ring in 0..size / columns {
                let load: Vec<f64> = (ring * columns..(ring + 1) * columns)
                    .map(|point| scale * (flows[point].0 - slopes[point] * rise[point]))
                    .collect();
                // The apex has the mean alone.
                let harmonics = if self.is_apex(ring) { 1 } else { columns };
                for m in 0..harmonics {
                    for j in 0..columns {
                        contact[ring * columns + m] += table[m * columns + j] * load[j];
                    }
                }
            }
            factor.solve_in_place_with_conj(
                faer::Conj::No,
                MatMut::from_column_major_slice_mut(contact, size, 1),
            );
            let mut change = 0.0f64;
            let mut largest = 1e-300f64;
            for ring in 0..size / columns {
                let harmonics = if self.is_apex(ring) { 1 } else { columns };
                for j in 0..columns {
                    let value: f64 =
                        (0..harmonics).map(|m| table[m * columns + j] * contact[ring * columns + m]).sum();
                    change = change.max((value - rise[ring * columns + j]).abs());
                    largest = largest.max(value.abs());
                    rise[ring * columns + j] = value;
                }
            }
            let before = std::mem::replace(&mut residual, change / largest);
            if residual <= 1e-11 {
                break;
            }
            if residual > SLOW * before {
                *chord = None;
            }
        }
        // Rounding may keep the last digits from settling.
        if residual.is_nan() || residual > 1e-9 {
            return Err(HeatError::NotConverged { residual });
        }
        factors.backward(&mut modal);
        factors.to_nodal(&modal, solution);
        Ok(rise.iter().enumerate().fold((0.0, 0.0), |(net, lost), (i, &theta)| {
            (net + heat.flow(i, theta).0, lost + heat.loss(i, theta))
        }))
    }

    /// Factor of [`Conduction::contact_jacobian`]. It is positive definite as heat flows fall with temperature, but
    /// not on a contact that is turned inside out, which a step may come by that is too long.
    fn contact_factor(
        &self,
        matrix: &StepMatrix,
        scale: f64,
        slope: impl Fn(usize) -> f64,
    ) -> Result<Llt<f64>, HeatError> {
        let jacobian = self.contact_jacobian(matrix, scale, slope);
        jacobian.llt(Side::Lower).map_err(|_| HeatError::NotConverged { residual: f64::NAN })
    }

    /// Schur complement of the contact less `scale` times the slopes of the heat flows.
    fn contact_jacobian(&self, matrix: &StepMatrix, scale: f64, slope: impl Fn(usize) -> f64) -> Mat<f64> {
        let columns = matrix.factors.harmonics();
        let table = matrix.factors.transform.of(Parity::Even);
        let mut jacobian = matrix.contact.clone();
        for ring in 0..self.mesh.meridian.contact.len() {
            let slopes: Vec<f64> = (0..columns).map(|j| slope(ring * columns + j)).collect();
            // The apex has the mean alone.
            let harmonics = if self.is_apex(ring) { 1 } else { columns };
            for m in 0..harmonics {
                for k in 0..harmonics {
                    let slope: f64 = (0..columns)
                        .map(|j| table[m * columns + j] * slopes[j] * table[k * columns + j])
                        .sum();
                    jacobian[(ring * columns + m, ring * columns + k)] -= scale * slope;
                }
            }
        }
        jacobian
    }

    fn is_apex(&self, ring: usize) -> bool {
        self.mesh.meridian.on_axis(self.mesh.meridian.contact[ring] as usize)
    }

    fn on_base(&self, place: usize) -> bool {
        self.mesh.meridian.is_base[place / self.mesh.sectors.columns()]
    }

    /// Heat per time that leaves through the base; the sum over θ has the mean harmonic alone.
    fn base_flow(&self, rise: &[f64]) -> f64 {
        let mesh = &self.mesh;
        let columns = mesh.sectors.columns();
        let sum = |node: u32| rise[node as usize * columns..][..columns].iter().sum::<f64>();
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

    /// Heat in the body at a temperature rise, half body.
    pub fn stored(&self, rise: &[f64]) -> f64 {
        match &self.varying {
            Some(varying) => self.stored_varying(varying, rise),
            None => rise.iter().zip(&self.mass).map(|(t, m)| t * m).sum(),
        }
    }
}

/// Lumped mass plus `conductivity` times conduction of one element for harmonic m, 4 × 4.
fn element_matrix(mesh: &RevolvedMesh, e: usize, capacity: f64, conductivity: f64, m: usize) -> Vec<f64> {
    let shapes = shape_at_points();
    let element = &mesh.elements[e];
    let squared = (m * m) as f64;
    let mut matrix = vec![0.0; CORNERS * CORNERS];
    for q in 0..POINTS {
        let weight = element.weight[q];
        for (i, a) in element.shape[q].iter().enumerate() {
            matrix[i * (CORNERS + 1)] += capacity * weight * shapes[q][i];
            for (j, b) in element.shape[q].iter().enumerate() {
                let product = a.dr * b.dr + a.dz * b.dz + squared * a.over_r * b.over_r;
                matrix[i * CORNERS + j] += conductivity * weight * product;
            }
        }
    }
    matrix
}

#[cfg(test)]
mod tests;
