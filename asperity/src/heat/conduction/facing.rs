//! A conducting counterface in a step: it takes up the flux F for which the rises of both surfaces differ by the drop over the
//! resistance of the contact,
//!
//! ```text
//! θ = θ₂(F) + r (F − (1 − f_h) q),
//! ```
//!
//! q the flux of frictional heat, of which 1 − f_h is released on the side of the counterface. Fluxes and rises are those of
//! their [`Profile`], mean and slope along the motion: a counterface that moves is hotter downstream. θ falls with F in
//! proportion but for the softening of friction, so that Broyden's method finds F in a few solutions of the stage
//! ([`super::step`]); C. G. Broyden, Math. Comp. 19, 577 (1965), doi 10.1090/S0025-5718-1965-0198670-6.
//!
//! F is a share of the heat that friction generates at each point plus a linear part, the mean of which is zero while that of F is
//! between 0 and that of q: points that do not slip give no heat to a counterface that is heated at others.

use std::cell::Cell;

use nalgebra::Matrix2;

use super::ContactHeat;
use crate::heat::counterface::{HalfSpace, Profile, StepResponse};

/// The counterface in a step.
pub(super) struct Facing {
    pub(super) response: StepResponse,
    pub(super) disc: ContactDisc,
    /// r = 1/h_c.
    pub(super) resistance: f64,
    /// 1 − f_h.
    pub(super) released: f64,
    /// Fluxes of the stages to start from.
    pub(super) expected: [Profile; 2],
    /// Estimate of d(θ − θ₂ − r(F − (1 − f_h) q))/dF.
    pub(super) slope: Cell<Matrix2<f64>>,
}

impl Facing {
    /// In a step `dt` of a body of effusivity `effusivity` in which the counterface moves by `slip`.
    pub(super) fn new(
        half_space: &HalfSpace,
        disc: ContactDisc,
        effusivity: f64,
        (dt, slip): (f64, f64),
    ) -> Self {
        let response = half_space.step(dt, slip, disc.radius());
        // Of the asperity as of a half-space at rest, κ = 1.
        let body = HalfSpace::new(1.0, effusivity).step(dt, 0.0, disc.radius()).own();
        let resistance = half_space.resistance;
        Self {
            response,
            disc,
            resistance,
            released: 1.0 - half_space.share,
            expected: half_space.expected_fluxes(),
            slope: Cell::new(-(body + response.own() + Matrix2::identity() * resistance)),
        }
    }

    /// Improves the estimate of the slope by the change of the difference with the flux.
    pub(super) fn learn(&self, flux: Profile, difference: Profile) {
        let slope = self.slope.get();
        let better = slope + (difference - slope * flux) * flux.transpose() / flux.norm_squared();
        if better.trace() < 0.0 && better.determinant() > 0.0 {
            self.slope.set(better);
        }
    }
}

/// The contact as the counterface sees it.
pub(super) struct ContactDisc {
    /// Of the contact points of the half model, as far as they are in contact.
    areas: Vec<f64>,
    /// Their sum.
    pub(super) total: f64,
    /// ξ = x/a from the centre of the contact.
    places: Vec<f64>,
    /// ⟨ξ²⟩.
    second: f64,
}

impl ContactDisc {
    /// Of points at `along`, x.
    pub(super) fn new(areas: Vec<f64>, along: impl Fn(usize) -> f64) -> Self {
        let total: f64 = areas.iter().sum();
        let mean = |value: &dyn Fn(usize) -> f64| {
            (0..areas.len()).map(|point| areas[point] * value(point)).sum::<f64>() / total
        };
        let (centre, radius) = (mean(&along), radius(total));
        let places: Vec<f64> = (0..areas.len()).map(|point| (along(point) - centre) / radius).collect();
        let second = mean(&|point| places[point] * places[point]);
        Self { areas, total, places, second }
    }

    fn radius(&self) -> f64 {
        radius(self.total)
    }

    /// Profile of a field, given its integral over the area of each point.
    pub(super) fn profile(&self, integral: impl Fn(usize) -> f64) -> Profile {
        let moments = (0..self.areas.len())
            .map(|point| integral(point) * Profile::new(1.0, self.places[point]))
            .sum::<Profile>()
            / self.total;
        // A single point has no slope.
        Profile::new(moments.x, if self.second > 0.0 { moments.y / self.second } else { 0.0 })
    }

    /// The same, given its value at each point.
    pub(super) fn profile_of_values(&self, value: impl Fn(usize) -> f64) -> Profile {
        self.profile(|point| self.areas[point] * value(point))
    }
}

/// Of the disc that has twice the area.
fn radius(half: f64) -> f64 {
    (2.0 * half / std::f64::consts::PI).sqrt()
}

/// Heat flow at the contact less that into the counterface.
pub(super) struct Drawn<'a> {
    heat: &'a dyn ContactHeat,
    disc: &'a ContactDisc,
    /// Share of the frictional heat that the counterface takes up at each point.
    share: f64,
    /// Linear flux that it takes up in addition.
    linear: Profile,
}

impl<'a> Drawn<'a> {
    /// With the flux `flux` into the counterface while friction generates `frictional`.
    pub(super) fn new(
        heat: &'a dyn ContactHeat,
        disc: &'a ContactDisc,
        flux: Profile,
        frictional: Profile,
    ) -> Self {
        let share = if frictional.x > 0.0 { (flux.x / frictional.x).clamp(0.0, 1.0) } else { 0.0 };
        Self { heat, disc, share, linear: flux - share * frictional }
    }

    /// Flux into the counterface while friction generates `frictional`.
    pub(super) fn flux(&self, frictional: Profile) -> Profile {
        self.share * frictional + self.linear
    }
}

impl ContactHeat for Drawn<'_> {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let (flow, slope) = self.heat.flow(point, rise);
        let left = 1.0 - self.share;
        let linear = self.linear.x + self.linear.y * self.disc.places[point];
        (left * flow - linear * self.disc.areas[point], left * slope)
    }
}
