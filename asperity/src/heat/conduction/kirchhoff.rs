//! A stage with properties that depend on temperature.
//!
//! H increases and the heat flow at the contact decreases with Θ, so a stage is the minimum of a convex function of Θ,
//! and Newton's method with a line search converges from any start. Its linear systems are solved by conjugate
//! gradients with the matrix of the initial properties as preconditioner.

use faer::linalg::solvers::Llt;

use super::step::{HeatState, StageSolver, Step, solve_contact};
use super::{HeatError, element_matrix};
use crate::discretisation::collocation::Parity;
use crate::discretisation::element::{CORNERS, RevolvedMesh};
use crate::heat::properties::ThermalProperties;
use crate::material::lanes::{add_scaled, dot};

const NEWTON_LIMIT: usize = 60;
const KRYLOV_LIMIT: usize = 200;
/// Tolerance of the residual in the energy norm, relative to the norm of the temperature.
const TOLERANCE: f64 = 1e-12;
/// Residual accepted at stagnation by rounding.
const ROUNDING: f64 = 1e-11;

/// Properties, and the conduction matrices of the elements at k₀, 4 × 4: in the meridian, and along θ.
pub(super) struct Kirchhoff {
    properties: ThermalProperties,
    elements: Vec<[Vec<f64>; 2]>,
}

impl Kirchhoff {
    pub(super) fn new(mesh: &RevolvedMesh, conductivity: f64, properties: ThermalProperties) -> Self {
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

impl StageSolver for &Kirchhoff {
    fn solve(
        &mut self,
        step: &Step<'_>,
        rhs: &[f64],
        guess: &HeatState,
        reduction: f64,
    ) -> Result<HeatState, HeatError> {
        StageProblem { step, kirchhoff: self, rhs }.solve(guess.potential.clone(), reduction)
    }
}

/// Iterate of a stage.
struct Iterate {
    state: HeatState,
    /// γΔt K_T Θ.
    conducted: Vec<f64>,
    residual: Vec<f64>,
    /// C_T dH/dΘ.
    capacities: Vec<f64>,
    /// dq/dΘ of the contact points, not positive.
    contact_slopes: Vec<f64>,
}

/// Change of the potential, and of γΔt K_T Θ.
struct Direction {
    potential: Vec<f64>,
    conducted: Vec<f64>,
}

/// A stage: C_T H(Θ) + γΔt K_T Θ = rhs + γΔt q(θ).
struct StageProblem<'a> {
    step: &'a Step<'a>,
    kirchhoff: &'a Kirchhoff,
    rhs: &'a [f64],
}

impl StageProblem<'_> {
    /// Ends where the residual has its tolerance, or `reduction` times its first value.
    fn solve(&self, potential: Vec<f64>, reduction: f64) -> Result<HeatState, HeatError> {
        let mut preconditioned = vec![0.0; potential.len()];
        let conducted = self.conduct(&potential);
        let mut now = self.iterate(potential, conducted);
        let (mut first, mut last) = (None, f64::INFINITY);
        for _ in 0..NEWTON_LIMIT {
            // The contact's share of the preconditioner: heat exchange linearised.
            let factor = self.step.contact_factor(|point| now.contact_slopes[point])?;
            self.precondition(&factor, &now.residual, &mut preconditioned);
            let squared = dot(&now.residual, &preconditioned);
            // Before `max`, which takes a number for NaN.
            if !squared.is_finite() {
                break;
            }
            let norm = squared.max(0.0).sqrt();
            let first = *first.get_or_insert(norm);
            let reference = self.energy_norm(&now).max(first);
            let tolerance = (TOLERANCE * reference).max(reduction * first);
            if norm <= tolerance || (norm <= ROUNDING * reference && norm > 0.5 * last) {
                return Ok(now.state);
            }
            last = norm;
            // Forcing term: no more accuracy than the next Newton step can use.
            let forcing = (0.1 * tolerance / norm).max((norm / reference).clamp(1e-6, 1e-2));
            let direction = self.conjugate_gradients(&factor, &now, &preconditioned, forcing);
            let (next, left) = self.line_search(&now, &direction);
            // The step leaves `forcing` of the residual of a linear stage; what it leaves along itself is not linear.
            if left.max(forcing) <= reduction {
                return Ok(next.state);
            }
            now = next;
        }
        Err(HeatError::NotConverged { residual: last / first.unwrap_or(1.0) })
    }

    /// Iterate of a potential and its γΔt K_T Θ.
    fn iterate(&self, potential: Vec<f64>, conducted: Vec<f64>) -> Iterate {
        let (conduction, scale) = (self.step.conduction, self.step.scale());
        let n = potential.len();
        let [mut rise, mut enthalpy, mut residual, mut capacities] = [(); 4].map(|()| vec![0.0; n]);
        for i in 0..n {
            let state = self.kirchhoff.properties.state(potential[i]);
            rise[i] = state.rise;
            capacities[i] = conduction.heat_capacities[i] * state.capacity;
            enthalpy[i] = state.enthalpy;
            let stored = conduction.heat_capacities[i] * state.enthalpy;
            residual[i] = if conduction.on_base(i) { 0.0 } else { self.rhs[i] - stored - conducted[i] };
        }
        let indices = conduction.contact_indices.iter().enumerate();
        let contact_slopes = indices.map(|(point, &index)| {
            let (flow, slope) = self.step.heat.flow(point, rise[index]);
            residual[index] += scale * flow;
            slope.min(0.0) / self.kirchhoff.properties.conductivity().value(rise[index])
        });
        let contact_slopes = contact_slopes.collect();
        let state = HeatState { potential, rise, enthalpy };
        Iterate { state, conducted, residual, capacities, contact_slopes }
    }

    /// √(ΘJΘ), the norm in which the residual is measured.
    fn energy_norm(&self, now: &Iterate) -> f64 {
        let potential = &now.state.potential;
        let body: f64 = (potential.iter().zip(&now.capacities).zip(&now.conducted))
            .map(|((x, capacity), conducted)| x * (capacity * x + conducted))
            .sum();
        let indices = self.step.conduction.contact_indices.iter();
        let contact: f64 =
            indices.zip(&now.contact_slopes).map(|(&index, slope)| slope * potential[index].powi(2)).sum();
        (body - self.step.scale() * contact).max(0.0).sqrt()
    }

    /// Applies the inverse of the matrix of the initial properties.
    fn precondition(&self, factor: &Llt<f64>, residual: &[f64], solution: &mut [f64]) {
        let factors = &self.step.matrix.factors;
        let mut modal = vec![0.0; factors.modal_length()];
        factors.to_modal(residual, &mut modal);
        factors.forward(&mut modal);
        solve_contact(factor, &mut modal[factors.contact_offset()..]);
        factors.backward(&mut modal);
        factors.to_nodal(&modal, solution);
    }

    /// Solves for the Newton step from the `preconditioned` residual.
    ///
    /// The Jacobian differs from the matrix P of the preconditioner in the heat capacities alone. The directions are
    /// p = z + βp with z = P⁻¹r, so that Pp = r + βPp, and no other product with a matrix is needed.
    fn conjugate_gradients(
        &self,
        factor: &Llt<f64>,
        now: &Iterate,
        preconditioned: &[f64],
        tolerance: f64,
    ) -> Direction {
        let (conduction, n) = (self.step.conduction, preconditioned.len());
        let (mut r, mut z) = (now.residual.clone(), preconditioned.to_vec());
        let (mut p, mut on_p) = (z.clone(), r.clone());
        let [mut potential, mut product] = [(); 2].map(|()| vec![0.0; n]);
        let mut rho = dot(&r, &z);
        let target = rho * tolerance * tolerance;
        for _ in 0..KRYLOV_LIMIT {
            for i in 0..n {
                product[i] = on_p[i] + (now.capacities[i] - conduction.heat_capacities[i]) * p[i];
            }
            let step = rho / dot(&p, &product);
            if !step.is_finite() {
                break;
            }
            for i in 0..n {
                potential[i] += step * p[i];
                r[i] -= step * product[i];
            }
            self.precondition(factor, &r, &mut z);
            let next = dot(&r, &z);
            if next <= target {
                break;
            }
            let beta = next / rho;
            for i in 0..n {
                p[i] = z[i] + beta * p[i];
                on_p[i] = r[i] + beta * on_p[i];
            }
            rho = next;
        }
        // The Jacobian times the step is the part of the residual that is gone.
        let mut conducted: Vec<f64> =
            (0..n).map(|i| now.residual[i] - r[i] - now.capacities[i] * potential[i]).collect();
        for (&index, slope) in conduction.contact_indices.iter().zip(&now.contact_slopes) {
            conducted[index] += self.step.scale() * slope * potential[index];
        }
        Direction { potential, conducted }
    }

    /// Goes along `direction` until the slope of the convex function has fallen by half; also returns the share of it that is left.
    fn line_search(&self, now: &Iterate, direction: &Direction) -> (Iterate, f64) {
        let initial = dot(&now.residual, &direction.potential);
        let (mut low, mut low_slope) = (0.0, initial);
        let mut high: Option<(f64, f64)> = None;
        let mut step = 1.0;
        let mut attempt = 0;
        loop {
            let along = |from: &[f64], change: &[f64]| -> Vec<f64> {
                from.iter().zip(change).map(|(x, d)| x + step * d).collect()
            };
            let potential = along(&now.state.potential, &direction.potential);
            let next = self.iterate(potential, along(&now.conducted, &direction.conducted));
            let slope = dot(&next.residual, &direction.potential);
            attempt += 1;
            if slope.abs() <= 0.5 * initial.abs() || attempt == 30 {
                return (next, (slope / initial).abs());
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

    /// γΔt K_T Θ, K at k₀.
    fn conduct(&self, potential: &[f64]) -> Vec<f64> {
        let sectors = &self.step.conduction.mesh.sectors;
        let [mut flow, mut slope, mut on_slope] = [(); 3].map(|()| vec![0.0; potential.len()]);
        sectors.differentiate(&[Parity::Even], potential, &mut slope);
        match sectors.columns() {
            1 => self.conduct_lanes::<1>(potential, &slope, &mut flow, &mut on_slope),
            n if n % 8 == 0 => self.conduct_lanes::<8>(potential, &slope, &mut flow, &mut on_slope),
            _ => self.conduct_lanes::<4>(potential, &slope, &mut flow, &mut on_slope),
        }
        sectors.add_transposed(&[Parity::Even], &on_slope, &mut flow);
        flow.iter_mut().for_each(|flow| *flow *= self.step.scale());
        flow
    }

    fn conduct_lanes<const W: usize>(
        &self,
        potential: &[f64],
        slope: &[f64],
        flow: &mut [f64],
        on_slope: &mut [f64],
    ) {
        let mesh = &self.step.conduction.mesh;
        for (element, [mean, along]) in mesh.elements.iter().zip(&self.kirchhoff.elements) {
            for first in (0..mesh.sectors.columns()).step_by(W) {
                for (matrix, from, to) in [(mean, potential, &mut *flow), (along, slope, &mut *on_slope)] {
                    let nodal = mesh.gather_scalar::<W>(from, element, first);
                    let mut out = [[0.0; W]; CORNERS];
                    for (out, row) in out.iter_mut().zip(matrix.chunks_exact(CORNERS)) {
                        for (factor, value) in row.iter().zip(&nodal) {
                            add_scaled(out, *factor, value);
                        }
                    }
                    mesh.scatter_scalar::<W>(&out, element, first, to);
                }
            }
        }
    }
}
