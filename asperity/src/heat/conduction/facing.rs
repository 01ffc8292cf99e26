//! A conducting counterface in a step: it takes up a mean flux F that makes the mean rises of both surfaces differ by what the
//! resistance of the contact needs,
//!
//! ```text
//! θ̄ = θ̄₂(F) + r (F − (1 − f_h) q̄),
//! ```
//!
//! q̄ the mean flux of frictional heat, of which 1 − f_h is released on the side of the counterface. θ̄ falls with F in
//! proportion but for the softening of friction, so that a secant finds F in two or three solutions of the stage
//! ([`super::step`]).
//!
//! Between 0 and q̄, F is taken at each point as the same share of the heat that friction generates there: points that do not
//! slip give no heat to a counterface that is heated at others. What exceeds q̄, or enters the asperity, is uniform.

use std::cell::Cell;

use super::{ContactHeat, GAMMA};
use crate::heat::counterface::{HalfSpace, StepResponse};

/// The counterface in a step.
pub(super) struct Facing {
    pub(super) response: StepResponse,
    /// r = 1/h_c.
    pub(super) resistance: f64,
    /// 1 − f_h.
    pub(super) released: f64,
    /// Of the contact points, as far as they are in contact.
    pub(super) areas: Vec<f64>,
    /// Their sum: half of the contact.
    pub(super) total: f64,
    /// Fluxes of the stages to start from.
    pub(super) expected: [f64; 2],
    /// Estimate of d(θ̄ − θ̄₂ − …)/dF, negative.
    pub(super) slope: Cell<f64>,
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

    /// Mean over the contact.
    pub(super) fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        (0..self.areas.len()).map(|point| self.areas[point] * value(point)).sum::<f64>() / self.total
    }
}

/// Heat flow at the contact less that into the counterface.
pub(super) struct Drawn<'a> {
    pub(super) heat: &'a dyn ContactHeat,
    pub(super) areas: &'a [f64],
    /// Share of the frictional heat that the counterface takes up at each point.
    pub(super) share: f64,
    /// Flux that it takes up beside, at all points.
    pub(super) uniform: f64,
}

impl<'a> Drawn<'a> {
    /// With the mean flux `flux` into the counterface while friction generates the mean flux `frictional`.
    pub(super) fn new(heat: &'a dyn ContactHeat, facing: &'a Facing, flux: f64, frictional: f64) -> Self {
        let share = if frictional > 0.0 { (flux / frictional).clamp(0.0, 1.0) } else { 0.0 };
        Self { heat, areas: &facing.areas, share, uniform: flux - share * frictional }
    }
}

impl ContactHeat for Drawn<'_> {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let (flow, slope) = self.heat.flow(point, rise);
        let left = 1.0 - self.share;
        (left * flow - self.uniform * self.areas[point], left * slope)
    }
}
