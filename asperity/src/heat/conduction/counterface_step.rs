//! A conducting counterface in a step: it takes up the flux F for which the rises of both surfaces differ by the drop over the
//! resistance of the contact,
//!
//! ```text
//! θ = θ₂(F) + r (F − (1 − f_h) q),
//! ```
//!
//! q the flux of frictional heat, of which 1 − f_h is released on the side of the counterface. Fluxes and rises are those of
//! their [`Profile`], mean, slope along the motion and curvature: a counterface that moves is hotter downstream. θ falls with F in
//! proportion but for the softening of friction, so that Broyden's method finds F in a few solutions of the stage
//! ([`super::step`]); C. G. Broyden, Math. Comp. 19, 577 (1965), doi 10.1090/S0025-5718-1965-0198670-6.
//!
//! F is a share of the heat that friction generates at each point plus a smooth part, a profile with a mean of zero while that of
//! F is between 0 and that of q: points that do not slip give no heat to a counterface that is heated at others.

use std::cell::Cell;

use nalgebra::Matrix3;

use super::ContactHeat;
use crate::heat::counterface::{HalfSpace, Profile, StepResponse};

/// Heat balance with a conducting counterface in a step.
pub(super) struct CounterfaceStep<'a> {
    half_space: &'a HalfSpace,
    pub(super) response: StepResponse,
    pub(super) disc: ContactDisc,
    /// r = 1/h_c.
    pub(super) resistance: f64,
    /// 1 − f_h.
    pub(super) released: f64,
    /// Fluxes of the stages to start from.
    pub(super) expected: [Profile; 2],
    /// Estimate of d(θ − θ₂ − r(F − (1 − f_h) q))/dF.
    pub(super) jacobian: Cell<Matrix3<f64>>,
}

impl<'a> CounterfaceStep<'a> {
    /// The counterface facing the contact in a step `dt` in which it moves by `slip`, of a body of effusivity `effusivity`,
    /// with the Jacobian `known` from a step of the same length.
    pub(super) fn new(
        half_space: &'a HalfSpace,
        disc: ContactDisc,
        (effusivity, known): (f64, Option<Matrix3<f64>>),
        (dt, slip): (f64, f64),
    ) -> Self {
        let response = half_space.step(dt, slip, disc.radius);
        let resistance = half_space.resistance;
        let jacobian = known.unwrap_or_else(|| {
            // Of the asperity as of a half-space at rest, κ = 1.
            let body = HalfSpace::new(1.0, effusivity).step(dt, 0.0, disc.radius).own;
            -(body + response.own + Matrix3::identity() * resistance)
        });
        Self {
            half_space,
            response,
            disc,
            resistance,
            released: 1.0 - half_space.share,
            expected: half_space.expected_fluxes(),
            jacobian: Cell::new(jacobian),
        }
    }

    /// Rise of temperature, given that of the potential, see [`crate::heat::counterface`].
    pub(super) fn rise(&self, potential: Profile) -> Profile {
        match self.half_space.varies() {
            true => self
                .disc
                .profile_of_values(|point| self.half_space.rise_at(self.disc.value(point, potential))),
            false => potential,
        }
    }

    /// Broyden update of the Jacobian by the change `difference` of the balance with a change `flux`.
    pub(super) fn update_jacobian(&self, flux: Profile, difference: Profile) {
        let known = self.jacobian.get();
        let better = known + (difference - known * flux) * flux.transpose() / flux.norm_squared();
        if better.trace() < 0.0 && better.determinant() < 0.0 {
            self.jacobian.set(better);
        }
    }
}

/// The contact as the counterface sees it.
pub(super) struct ContactDisc {
    /// Areas of the contact points of the half model that are in contact.
    areas: Vec<f64>,
    /// Sum of the areas.
    pub(super) total: f64,
    /// a.
    radius: f64,
    /// ξ and y/a of each point.
    positions: Vec<[f64; 2]>,
    /// 1, and ξ and η less their means.
    shapes: Vec<Profile>,
    /// Mean of η + 1.
    curvature: f64,
    /// Mean squares of the shapes.
    squares: Profile,
}

impl ContactDisc {
    /// The disc of contact points with these areas, at `position` (x, y).
    pub(super) fn new(areas: Vec<f64>, position: impl Fn(usize) -> [f64; 2]) -> Self {
        let total: f64 = areas.iter().sum();
        let mean = |value: &dyn Fn(usize) -> f64| {
            (0..areas.len()).map(|point| areas[point] * value(point)).sum::<f64>() / total
        };
        // That of the disc of twice the area.
        let radius = (2.0 * total / std::f64::consts::PI).sqrt();
        let centre = mean(&|point| position(point)[0]);
        let relative = |point| [(position(point)[0] - centre) / radius, position(point)[1] / radius];
        let positions: Vec<[f64; 2]> = (0..areas.len()).map(relative).collect();
        let squared = |point: usize| positions[point].iter().map(|x| x * x).sum::<f64>();
        let curvature = mean(&|point| 2.0 * squared(point));
        let shapes: Vec<Profile> = (0..areas.len())
            .map(|point| Profile::new(1.0, positions[point][0], 2.0 * squared(point) - curvature))
            .collect();
        let squares = Profile::from_fn(|k, _| mean(&|point| shapes[point][k].powi(2)));
        Self { areas, total, radius, positions, shapes, curvature, squares }
    }

    /// Value of a profile and its derivative along x at a point. Beyond the disc the profile continues in proportion to the
    /// logarithm of the distance, as the displacement around steady heat does, with the same inclination at the edge.
    pub(super) fn elevation(&self, point: usize, profile: Profile) -> [f64; 2] {
        let [xi, upsilon] = self.positions[point];
        let distance = xi.hypot(upsilon);
        let squared = distance * distance;
        // Factor of ξ, η + 1, and their derivatives along x.
        let (factor, curved, of_slope, of_curvature) = if distance <= 1.0 {
            (1.0, 2.0 * squared, 1.0, 4.0 * xi)
        } else {
            let log = distance.ln();
            let factor = (1.0 + log) / distance;
            (factor, 2.0 + 4.0 * log, factor - xi * xi * log / (squared * distance), 4.0 * xi / squared)
        };
        let height = profile.x + profile.y * factor * xi + profile.z * (curved - self.curvature);
        [height, (profile.y * of_slope + profile.z * of_curvature) / self.radius]
    }

    /// Value of a profile at a point.
    fn value(&self, point: usize, profile: Profile) -> f64 {
        profile.dot(&self.shapes[point])
    }

    /// Profile of a field, given its integral over the area of each point.
    pub(super) fn profile(&self, integral: impl Fn(usize) -> f64) -> Profile {
        let moments =
            (0..self.areas.len()).map(|point| integral(point) * self.shapes[point]).sum::<Profile>();
        // A single point has neither slope nor curvature.
        moments.zip_map(
            &self.squares,
            |moment, square| if square > 0.0 { moment / (square * self.total) } else { 0.0 },
        )
    }

    /// Profile of a field, given its value at each point.
    pub(super) fn profile_of_values(&self, value: impl Fn(usize) -> f64) -> Profile {
        self.profile(|point| self.areas[point] * value(point))
    }
}

/// Net heat flow into the asperity at the contact: that of friction and of the gap, less that into the counterface.
pub(super) struct NetContactHeat<'a> {
    heat: &'a dyn ContactHeat,
    disc: &'a ContactDisc,
    /// Share of the frictional heat that the counterface takes up at each point.
    share: f64,
    /// Smooth flux that it takes up in addition.
    smooth: Profile,
}

impl<'a> NetContactHeat<'a> {
    /// Net heat flow at the contact with the flux `flux` into the counterface while friction generates `frictional`.
    pub(super) fn new(
        heat: &'a dyn ContactHeat,
        disc: &'a ContactDisc,
        flux: Profile,
        frictional: Profile,
    ) -> Self {
        let share = if frictional.x > 0.0 { (flux.x / frictional.x).clamp(0.0, 1.0) } else { 0.0 };
        Self { heat, disc, share, smooth: flux - share * frictional }
    }

    /// Flux into the counterface while friction generates `frictional`.
    pub(super) fn flux(&self, frictional: Profile) -> Profile {
        self.share * frictional + self.smooth
    }
}

impl ContactHeat for NetContactHeat<'_> {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        let (flow, slope) = self.heat.flow(point, rise);
        let left = 1.0 - self.share;
        let smooth = self.disc.value(point, self.smooth);
        (left * flow - smooth * self.disc.areas[point], left * slope)
    }
}
