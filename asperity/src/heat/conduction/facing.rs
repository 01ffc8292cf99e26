//! A conducting counterface in a step: it takes up a flux F that is uniform over the contact and makes the mean rises of
//! both surfaces differ by what the resistance of the contact needs,
//!
//! ```text
//! θ̄ = θ̄₂(F) + r (F − (1 − f_h) q̄),
//! ```
//!
//! q̄ the mean flux of frictional heat, of which 1 − f_h is released on the side of the counterface. θ̄ falls with F in
//! proportion but for the softening of friction, so that a secant finds F in two or three solutions of the stage.

use std::cell::Cell;

use super::step::{GAMMA, Stage, StageSolver, Step};
use super::{ContactHeat, HeatError};
use crate::heat::counterface::{HalfSpace, StepResponse};

const ITERATIONS: usize = 30;
/// Tolerance of the balance of the mean rises, relative to its largest term.
const TOLERANCE: f64 = 1e-8;

/// The counterface in a step.
pub(super) struct Facing {
    pub(super) response: StepResponse,
    /// r = 1/h_c.
    resistance: f64,
    /// 1 − f_h.
    released: f64,
    /// Of the contact points, as far as they are in contact.
    areas: Vec<f64>,
    /// Their sum: half of the contact.
    pub(super) total: f64,
    /// Fluxes of the stages to start from.
    expected: [f64; 2],
    /// Estimate of d(θ̄ − θ̄₂ − …)/dF, negative.
    slope: Cell<f64>,
}

impl Facing {
    /// In a step `dt` of a body of effusivity `effusivity` in which the counterface moves by `slip`.
    pub(super) fn new(
        half_space: &HalfSpace,
        areas: Vec<f64>,
        effusivity: f64,
        (dt, slip): (f64, f64),
    ) -> Self {
        let total: f64 = areas.iter().sum();
        let response = half_space.step(dt, slip, (2.0 * total / std::f64::consts::PI).sqrt());
        // The rise of a half-space under a uniform flux of duration γΔt.
        let body = 2.0 * (GAMMA * dt / std::f64::consts::PI).sqrt() / effusivity;
        let resistance = half_space.resistance;
        Self {
            response,
            resistance,
            released: 1.0 - half_space.share,
            areas,
            total,
            expected: half_space.expected_fluxes(),
            slope: Cell::new(-(body + response.own() + resistance)),
        }
    }

    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        (0..self.areas.len()).map(|point| self.areas[point] * value(point)).sum::<f64>() / self.total
    }
}

/// Heat flow at the contact less a uniform flux.
struct Drawn<'a> {
    heat: &'a dyn ContactHeat,
    areas: &'a [f64],
    flux: f64,
}

impl ContactHeat for Drawn<'_> {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let (flow, slope) = self.heat.flow(point, rise);
        (flow - self.flux * self.areas[point], slope)
    }
}

impl Step<'_> {
    /// Solves the stage `stage` (0, 1) with the flux into the counterface, which is entered into `fluxes`.
    pub(super) fn solve(
        &self,
        solver: &mut impl StageSolver,
        (rhs, guess): (&[f64], &[f64]),
        stage: usize,
        fluxes: &mut [f64; 2],
    ) -> Result<Stage, HeatError> {
        let Some(facing) = self.facing.filter(|facing| facing.total > 0.0) else {
            return solver.solve(self, rhs, guess);
        };
        let mut flux = facing.expected[stage];
        let mut before: Option<(f64, f64, Stage)> = None;
        let mut residual = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let heat = Drawn { heat: self.heat, areas: &facing.areas, flux };
            let start = before.as_ref().map_or(guess, |(.., stage)| &stage.rise);
            let solved = solver.solve(&Step { heat: &heat, ..*self }, rhs, start)?;
            let rise = |point: usize| solved.rise[self.conduction.contact_places[point]];
            let mean = facing.mean(rise);
            let opposite = facing.response.free(stage, fluxes[0]) + facing.response.own() * flux;
            let generated: f64 =
                (0..facing.areas.len()).map(|point| self.heat.flow(point, rise(point)).0).sum();
            let released = facing.released * generated / facing.total;
            let difference = mean - opposite - facing.resistance * (flux - released);
            let largest = facing.resistance * flux.abs().max(released.abs());
            fluxes[stage] = flux;
            residual = difference.abs() / mean.abs().max(opposite.abs()).max(largest).max(f64::MIN_POSITIVE);
            if residual <= TOLERANCE {
                return Ok(solved);
            }
            if let Some((other, its_difference, _)) = before {
                let slope = (difference - its_difference) / (flux - other);
                if slope < 0.0 {
                    facing.slope.set(slope);
                }
            }
            before = Some((flux, difference, solved));
            flux -= difference / facing.slope.get();
        }
        Err(HeatError::NotConverged { residual })
    }
}
