//! A stage with properties that depend on temperature.
//!
//! H increases and the heat flow at the contact decreases with Θ, so a stage is the minimum of a convex function of Θ,
//! and Newton's method with a line search converges from any start. Its linear systems are solved by conjugate
//! gradients with the matrix of the initial properties as preconditioner.

use faer::linalg::solvers::Llt;

use super::step::{Stage, StageSolver, Step, solve_contact};
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

    /// H at a rise, in kelvin at c₀.
    pub(super) fn enthalpy(&self, rise: f64) -> f64 {
        self.properties.specific_heat.integral(rise)
    }
}

impl StageSolver for &Kirchhoff {
    fn enthalpy(&self, rise: f64) -> f64 {
        Kirchhoff::enthalpy(self, rise)
    }

    fn solve(
        &mut self,
        step: &Step<'_>,
        rhs: &[f64],
        guess: &[f64],
        reduction: f64,
    ) -> Result<Stage, HeatError> {
        let potential = guess.iter().map(|&rise| self.properties.conductivity.integral(rise)).collect();
        StageProblem { step, kirchhoff: self, rhs }.solve(potential, reduction)
    }
}

/// Iterate of a stage.
struct Iterate {
    stage: Stage,
    /// γΔt K Θ.
    conducted: Vec<f64>,
    residual: Vec<f64>,
}

/// A stage: M H(Θ) + γΔt K Θ = rhs + γΔt q(θ).
struct StageProblem<'a> {
    step: &'a Step<'a>,
    kirchhoff: &'a Kirchhoff,
    rhs: &'a [f64],
}

impl StageProblem<'_> {
    /// Ends where the residual has its tolerance, or `reduction` times its first value.
    fn solve(&self, potential: Vec<f64>, reduction: f64) -> Result<Stage, HeatError> {
        let n = potential.len();
        let mut now = self.iterate(potential);
        let mut direction = vec![0.0; n];
        let (mut first, mut last) = (None, f64::INFINITY);
        for _ in 0..NEWTON_LIMIT {
            let slopes = self.slopes(&now.stage);
            let factor = self.factor(&now.stage)?;
            self.precondition(&factor, &now.residual, &mut direction);
            let squared = dot(&now.residual, &direction);
            // Before `max`, which takes a number for NaN.
            if !squared.is_finite() {
                break;
            }
            let norm = squared.max(0.0).sqrt();
            let first = *first.get_or_insert(norm);
            let reference = self.energy_norm(&now, &slopes).max(first);
            let tolerance = (TOLERANCE * reference).max(reduction * first);
            if norm <= tolerance || (norm <= ROUNDING * reference && norm > 0.5 * last) {
                return Ok(now.stage);
            }
            last = norm;
            // Forcing term: no more accuracy than the next Newton step can use.
            let forcing = (0.1 * tolerance / norm).max((norm / reference).clamp(1e-6, 1e-2));
            self.conjugate_gradients(&factor, (&now.residual, &slopes), &mut direction, forcing);
            now = self.line_search(&now, &direction);
        }
        Err(HeatError::NotConverged { residual: last / first.unwrap_or(1.0) })
    }

    /// Rises and residual of a potential.
    fn iterate(&self, potential: Vec<f64>) -> Iterate {
        let (conduction, properties, scale) =
            (self.step.conduction, &self.kirchhoff.properties, self.step.scale());
        let rise: Vec<f64> =
            potential.iter().map(|&theta| properties.conductivity.inverse_integral(theta)).collect();
        let mut conducted = vec![0.0; rise.len()];
        self.conduct(&potential, &mut conducted);
        conducted.iter_mut().for_each(|flow| *flow *= scale);
        let mut residual = vec![0.0; rise.len()];
        for i in 0..rise.len() {
            let stored = conduction.mass[i] * self.kirchhoff.enthalpy(rise[i]);
            residual[i] = if conduction.on_base(i) { 0.0 } else { self.rhs[i] - stored - conducted[i] };
        }
        for (point, &place) in conduction.contact_places.iter().enumerate() {
            residual[place] += scale * self.step.heat.flow(point, rise[place]).0;
        }
        Iterate { stage: Stage { potential, rise }, conducted, residual }
    }

    /// −∂residual/∂Θ without conduction: diagonal, positive.
    fn slopes(&self, stage: &Stage) -> Vec<f64> {
        let (conduction, properties) = (self.step.conduction, &self.kirchhoff.properties);
        let conductivity = |rise: f64| properties.conductivity.value(rise);
        let mut slopes: Vec<f64> = (stage.rise.iter().zip(&conduction.mass))
            .map(|(&rise, mass)| mass * properties.specific_heat.value(rise) / conductivity(rise))
            .collect();
        for (point, &place) in conduction.contact_places.iter().enumerate() {
            let rise = stage.rise[place];
            slopes[place] -=
                self.step.scale() * self.step.heat.flow(point, rise).1.min(0.0) / conductivity(rise);
        }
        slopes
    }

    /// √(ΘJΘ), the norm in which the residual is measured.
    fn energy_norm(&self, now: &Iterate, slopes: &[f64]) -> f64 {
        (now.stage.potential.iter().zip(slopes).zip(&now.conducted))
            .map(|((x, slope), conducted)| x * (slope * x + conducted))
            .sum::<f64>()
            .max(0.0)
            .sqrt()
    }

    /// The contact's share of the preconditioner: heat exchange linearised.
    fn factor(&self, stage: &Stage) -> Result<Llt<f64>, HeatError> {
        let conductivity = &self.kirchhoff.properties.conductivity;
        self.step.contact_factor(|point| {
            let rise = stage.rise[self.step.conduction.contact_places[point]];
            self.step.heat.flow(point, rise).1.min(0.0) / conductivity.value(rise)
        })
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

    /// Solves for the Newton step; `direction` holds the preconditioned residual on entry.
    fn conjugate_gradients(
        &self,
        factor: &Llt<f64>,
        (residual, slopes): (&[f64], &[f64]),
        direction: &mut [f64],
        tolerance: f64,
    ) {
        let (n, scale) = (direction.len(), self.step.scale());
        let mut r = residual.to_vec();
        let mut z = direction.to_vec();
        let mut p = z.clone();
        let mut product = vec![0.0; n];
        direction.fill(0.0);
        let mut rho = dot(&r, &z);
        let target = rho * tolerance * tolerance;
        for _ in 0..KRYLOV_LIMIT {
            self.conduct(&p, &mut product);
            for i in 0..n {
                product[i] = slopes[i] * p[i] + scale * product[i];
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
    fn line_search(&self, now: &Iterate, direction: &[f64]) -> Iterate {
        let initial = dot(&now.residual, direction);
        let (mut low, mut low_slope) = (0.0, initial);
        let mut high: Option<(f64, f64)> = None;
        let mut step = 1.0;
        let mut attempt = 0;
        loop {
            let potential = now.stage.potential.iter().zip(direction).map(|(x, d)| x + step * d).collect();
            let next = self.iterate(potential);
            let slope = dot(&next.residual, direction);
            attempt += 1;
            if slope.abs() <= 0.5 * initial.abs() || attempt == 30 {
                return next;
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
        let sectors = &self.step.conduction.mesh.sectors;
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
