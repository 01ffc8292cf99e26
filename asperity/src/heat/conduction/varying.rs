//! Conduction with specific heat and conductivity that depend on temperature.
//!
//! In terms of the potential Θ = ∫k/k₀ dθ (Kirchhoff) conduction is linear, ∇·(k∇θ) = k₀∇²Θ, and
//! the enthalpy H = ∫c/c₀ dθ is a function of Θ at each node: ρc₀Ḣ(Θ) = k₀∇²Θ + sources. What is
//! advanced is the enthalpy, so the heat balance closes whatever peaks and jumps c has.
//!
//! A stage of the time integration minimises a convex function of Θ, as H rises and the contact's
//! heat falls with it: Newton's method with a line search cannot miss it. Its linear systems are
//! solved by conjugate gradients with the matrix of the initial properties as preconditioner.

use faer::MatMut;
use faer::linalg::solvers::{Llt, SolveCore};

use super::{Conduction, ContactHeat, GAMMA, HeatBalance, HeatError, StepMatrix, element_matrix};
use crate::discretisation::collocation::Parity;
use crate::discretisation::element::{CORNERS, RevolvedMesh};
use crate::scene::curve::Curve;
use crate::solver::newton::dot;

const NEWTON_LIMIT: usize = 60;
const KRYLOV_LIMIT: usize = 200;
/// Residual that counts as none, in the energy norm, relative to that of the temperature.
const TOLERANCE: f64 = 1e-13;
/// What is accepted once rounding keeps the residual from falling further.
const ROUNDING: f64 = 1e-11;

/// Properties over the temperature rise, relative to those at the initial temperature; positive.
#[derive(Clone, Debug)]
pub struct ThermalProperties {
    /// c/c₀.
    pub specific_heat: Curve,
    /// k/k₀.
    pub conductivity: Curve,
}

impl ThermalProperties {
    /// Those at the initial temperature throughout.
    pub fn constant() -> Self {
        Self { specific_heat: Curve::constant(1.0), conductivity: Curve::constant(1.0) }
    }

    /// H at a rise, in kelvin at c₀.
    fn enthalpy(&self, rise: f64) -> f64 {
        self.specific_heat.integral(rise)
    }
}

/// What conduction with varying properties needs besides the factors.
pub(super) struct Varying {
    properties: ThermalProperties,
    /// Conduction matrices of the elements at k₀, 4 × 4: in the meridian, and along θ.
    elements: Vec<[Vec<f64>; 2]>,
}

/// A stage's unknowns and what follows from them.
struct Stage {
    potential: Vec<f64>,
    rise: Vec<f64>,
    residual: Vec<f64>,
}

impl Varying {
    pub fn new(mesh: &RevolvedMesh, conductivity: f64, properties: ThermalProperties) -> Self {
        let elements = (0..mesh.elements.len())
            .map(|e| {
                let [mean, first] = [0, 1].map(|m| element_matrix(mesh, e, 0.0, conductivity, m));
                let along: Vec<f64> = first.iter().zip(&mean).map(|(a, b)| a - b).collect();
                [mean, along]
            })
            .collect();
        Self { properties, elements }
    }
}

/// What is solved in a stage: M H(Θ) + γΔt·KΘ = rhs + γΔt·q(θ).
struct Problem<'a> {
    conduction: &'a Conduction,
    varying: &'a Varying,
    matrix: &'a StepMatrix,
    rhs: &'a [f64],
    /// γΔt.
    scale: f64,
    heat: &'a dyn ContactHeat,
}

impl Conduction {
    /// As [`Conduction::advance`], with varying properties.
    pub(super) fn advance_varying(
        &self,
        varying: &Varying,
        matrix: &StepMatrix,
        dt: f64,
        body: &[f64],
        heat: &dyn ContactHeat,
    ) -> Result<(Vec<f64>, HeatBalance), HeatError> {
        let n = self.committed.len();
        let enthalpy = |rise: &[f64]| -> Vec<f64> {
            rise.iter().map(|&theta| varying.properties.enthalpy(theta)).collect()
        };
        let start = enthalpy(&self.committed);
        let solve = |content: &dyn Fn(usize) -> f64, guess: &[f64]| {
            let rhs: Vec<f64> = (0..n).map(|i| self.mass[i] * content(i) + GAMMA * body[i]).collect();
            let problem = Problem { conduction: self, varying, matrix, rhs: &rhs, scale: GAMMA * dt, heat };
            let potential =
                guess.iter().map(|&theta| varying.properties.conductivity.integral(theta)).collect();
            problem.solve(potential)
        };
        let first = solve(&|i| start[i], &self.committed)?;
        let reached = enthalpy(&first.rise);
        let ratio = (1.0 - GAMMA) / GAMMA;
        let last = solve(&|i| start[i] + ratio * (reached[i] - start[i]), &first.rise)?;
        let flows = |stage: &Stage| {
            self.contact_places.iter().enumerate().fold((0.0, 0.0), |(net, lost), (i, &place)| {
                let rise = stage.rise[place];
                (net + heat.flow(i, rise).0, lost + heat.loss(i, rise))
            })
        };
        let (in_first, in_last) = (flows(&first), flows(&last));
        let weighted = |a: f64, b: f64| dt * ((1.0 - GAMMA) * a + GAMMA * b);
        let balance = HeatBalance {
            contact: weighted(in_first.0 + in_first.1, in_last.0 + in_last.1),
            gap: weighted(in_first.1, in_last.1),
            body: (0..n).filter(|&i| !self.on_base(i)).map(|i| body[i]).sum(),
            // In terms of Θ the flow through the base is that of the initial conductivity.
            base: weighted(self.base_flow(&first.potential), self.base_flow(&last.potential)),
        };
        Ok((last.rise, balance))
    }

    /// Heat in the body, half body, with varying properties.
    pub(super) fn stored_varying(&self, varying: &Varying, rise: &[f64]) -> f64 {
        rise.iter().zip(&self.mass).map(|(&t, m)| m * varying.properties.enthalpy(t)).sum()
    }
}

impl Problem<'_> {
    fn solve(&self, potential: Vec<f64>) -> Result<Stage, HeatError> {
        let n = potential.len();
        let mut now = self.stage(potential);
        let mut direction = vec![0.0; n];
        let (mut first, mut last) = (None, f64::INFINITY);
        for _ in 0..NEWTON_LIMIT {
            let factor = self.factor(&now)?;
            self.precondition(&factor, &now.residual, &mut direction);
            let norm = dot(&now.residual, &direction).max(0.0).sqrt();
            let reference = self.energy_norm(&now).max(*first.get_or_insert(norm));
            if norm <= TOLERANCE * reference || (norm <= ROUNDING * reference && norm > 0.5 * last) {
                return Ok(now);
            }
            if !norm.is_finite() {
                break;
            }
            last = norm;
            // No more accuracy than the next Newton step can use.
            let forcing = (0.1 * TOLERANCE * reference / norm).max((norm / reference).clamp(1e-6, 1e-2));
            self.conjugate_gradients(&factor, &now, &mut direction, forcing);
            now = self.line_search(&now, &direction);
        }
        Err(HeatError::NotConverged { residual: last / first.unwrap_or(1.0) })
    }

    /// Rises and residual of a potential.
    fn stage(&self, potential: Vec<f64>) -> Stage {
        let (conduction, properties) = (self.conduction, &self.varying.properties);
        let rise: Vec<f64> =
            potential.iter().map(|&theta| properties.conductivity.inverse_integral(theta)).collect();
        let mut residual = vec![0.0; rise.len()];
        self.conduct(&potential, &mut residual);
        for i in 0..rise.len() {
            let stored = conduction.mass[i] * properties.enthalpy(rise[i]);
            residual[i] =
                if conduction.on_base(i) { 0.0 } else { self.rhs[i] - stored - self.scale * residual[i] };
        }
        for (point, &place) in conduction.contact_places.iter().enumerate() {
            residual[place] += self.scale * self.heat.flow(point, rise[place]).0;
        }
        Stage { potential, rise, residual }
    }

    /// −∂residual/∂Θ without conduction: diagonal, positive.
    fn slopes(&self, stage: &Stage) -> Vec<f64> {
        let (conduction, properties) = (self.conduction, &self.varying.properties);
        let conductivity = |rise: f64| properties.conductivity.value(rise);
        let mut slopes: Vec<f64> = (stage.rise.iter().zip(&conduction.mass))
            .map(|(&rise, mass)| mass * properties.specific_heat.value(rise) / conductivity(rise))
            .collect();
        for (point, &place) in conduction.contact_places.iter().enumerate() {
            let rise = stage.rise[place];
            slopes[place] -= self.scale * self.heat.flow(point, rise).1.min(0.0) / conductivity(rise);
        }
        slopes
    }

    /// √(ΘJΘ), the norm in which the residual is measured.
    fn energy_norm(&self, stage: &Stage) -> f64 {
        let mut product = vec![0.0; stage.potential.len()];
        self.conduct(&stage.potential, &mut product);
        let diagonal = self.slopes(stage);
        (stage.potential.iter().zip(&diagonal).zip(&product))
            .map(|((x, d), k)| x * (d * x + self.scale * k))
            .sum::<f64>()
            .max(0.0)
            .sqrt()
    }

    /// The contact's share of the preconditioner: heat exchange linearised.
    fn factor(&self, stage: &Stage) -> Result<Llt<f64>, HeatError> {
        let conduction = self.conduction;
        let slope = |point: usize| {
            let rise = stage.rise[conduction.contact_places[point]];
            self.heat.flow(point, rise).1.min(0.0) / self.varying.properties.conductivity.value(rise)
        };
        conduction.contact_factor(self.matrix, self.scale, slope)
    }

    /// Divides by the matrix of the initial properties.
    fn precondition(&self, factor: &Llt<f64>, residual: &[f64], solution: &mut [f64]) {
        let factors = &self.matrix.factors;
        let mut modal = vec![0.0; factors.modal_length()];
        factors.to_modal(residual, &mut modal);
        factors.forward(&mut modal);
        let contact = &mut modal[factors.contact_offset()..];
        let size = contact.len();
        factor
            .solve_in_place_with_conj(faer::Conj::No, MatMut::from_column_major_slice_mut(contact, size, 1));
        factors.backward(&mut modal);
        factors.to_nodal(&modal, solution);
    }

    /// Solves for the Newton step; `direction` holds the preconditioned residual on entry.
    fn conjugate_gradients(&self, factor: &Llt<f64>, now: &Stage, direction: &mut [f64], tolerance: f64) {
        let n = direction.len();
        let slopes = self.slopes(now);
        let mut r = now.residual.clone();
        let mut z = direction.to_vec();
        let mut p = z.clone();
        let mut product = vec![0.0; n];
        direction.fill(0.0);
        let mut rho = dot(&r, &z);
        let target = rho * tolerance * tolerance;
        for _ in 0..KRYLOV_LIMIT {
            self.conduct(&p, &mut product);
            for i in 0..n {
                product[i] = slopes[i] * p[i] + self.scale * product[i];
            }
            let step = rho / dot(&p, &product);
            if !step.is_finite() {
                break;
            }
            for i in 0..n {
                direction[i] += step * p[i];
                r[i] -= step * product[i];
            }
            self.precondition(factor, &r, &mut z);
            let next = dot(&r, &z);
            if next <= target {
                break;
            }
            let beta = next / rho;
            (0..n).for_each(|i| p[i] = z[i] + beta * p[i]);
            rho = next;
        }
    }

    /// Goes along `direction` until the slope of the convex function has fallen by half.
    fn line_search(&self, now: &Stage, direction: &[f64]) -> Stage {
        let initial = dot(&now.residual, direction);
        let (mut low, mut low_slope) = (0.0, initial);
        let mut high: Option<(f64, f64)> = None;
        let mut step = 1.0;
        let mut attempt = 0;
        loop {
            let potential = now.potential.iter().zip(direction).map(|(x, d)| x + step * d).collect();
            let stage = self.stage(potential);
            let slope = dot(&stage.residual, direction);
            attempt += 1;
            if slope.abs() <= 0.5 * initial.abs() || attempt == 30 {
                return stage;
            }
            if slope < 0.0 {
                high = Some((step, slope));
            } else {
                (low, low_slope) = (step, slope);
            }
            step = match high {
                None => 2.0 * step,
                Some((top, top_slope)) => {
                    let guess = low + low_slope * (top - low) / (low_slope - top_slope);
                    guess.clamp(low + 0.05 * (top - low), low + 0.95 * (top - low))
                }
            };
        }
    }

    /// K·Θ at k₀.
    fn conduct(&self, potential: &[f64], flow: &mut [f64]) {
        let sectors = &self.conduction.mesh.sectors;
        let mut slope = vec![0.0; potential.len()];
        let mut on_slope = vec![0.0; potential.len()];
        sectors.differentiate(&[Parity::Even], potential, &mut slope);
        flow.fill(0.0);
        match sectors.columns() {
            1 => self.conduct_lanes::<1>(potential, &slope, flow, &mut on_slope),
            n if n % 8 == 0 => self.conduct_lanes::<8>(potential, &slope, flow, &mut on_slope),
            _ => self.conduct_lanes::<4>(potential, &slope, flow, &mut on_slope),
        }
        sectors.add_transposed(&[Parity::Even], &on_slope, flow);
    }

    fn conduct_lanes<const W: usize>(
        &self,
        potential: &[f64],
        slope: &[f64],
        flow: &mut [f64],
        on_slope: &mut [f64],
    ) {
        let mesh = &self.conduction.mesh;
        for (element, [mean, along]) in mesh.elements.iter().zip(&self.varying.elements) {
            for first in (0..mesh.sectors.columns()).step_by(W) {
                for (matrix, from, to) in [(mean, potential, &mut *flow), (along, slope, &mut *on_slope)] {
                    let nodal = mesh.gather_scalar::<W>(from, element, first);
                    let mut out = [[0.0; W]; CORNERS];
                    for (out, row) in out.iter_mut().zip(matrix.chunks_exact(CORNERS)) {
                        for (factor, value) in row.iter().zip(&nodal) {
                            crate::material::lanes::add_scaled(out, *factor, value);
                        }
                    }
                    mesh.scatter_scalar::<W>(&out, element, first, to);
                }
            }
        }
    }
}
