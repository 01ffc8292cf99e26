//! Below the first interference of a table: the elastic sphere.
//!
//! P is Hertz's, A = πRω, and Q that of partial slip under the constant shear strength
//! τ_c = f_τσ_Y/√3 of the initial temperature (heating vanishes with the contact). So that there
//! is no jump at the first row ω₁, each is multiplied by the ratio that the row has to it,
//! raised to √(ω/ω₁): the ratio goes to 1 with the contact radius, as heating and
//! plastic deformation do. The temperature rise goes with the contact radius. Where the
//! interface has no strength of its own, Q/P keeps the value that it has at the first row.

use super::nodes::{FIELDS, Field, Values};
use crate::closed_forms::hertz;
use crate::closed_forms::partial_slip::constant_shear;
use crate::table::Metadata;

#[derive(Clone, Copy, Debug)]
pub(super) struct Elastic {
    radius: f64,
    critical_interference: f64,
    contact_modulus: f64,
    /// G* = G/(2−ν), Pa.
    tangential_modulus: f64,
    /// τ_c, Pa.
    shear_strength: Option<f64>,
}

impl Elastic {
    pub(super) fn new(metadata: &Metadata) -> Self {
        let nu = metadata.poisson_ratio;
        Self {
            radius: metadata.asperity_radius,
            critical_interference: metadata.critical_interference,
            contact_modulus: metadata.contact_modulus,
            // G/(2−ν) with E = E*(1−ν²).
            tangential_modulus: metadata.contact_modulus * (1.0 - nu) / (2.0 * (2.0 - nu)),
            shear_strength: (metadata.strength_factor)
                .map(|factor| factor * metadata.yield_strength / 3f64.sqrt()),
        }
    }

    /// a, m, at ω/ω_c.
    pub(super) fn contact_radius(&self, interference: f64) -> f64 {
        hertz::contact_radius(self.radius, interference * self.critical_interference)
    }

    /// P, N.
    pub(super) fn load(&self, interference: f64) -> f64 {
        let omega = interference * self.critical_interference;
        hertz::hertz_load(self.contact_modulus, self.radius, omega)
    }

    /// A, m².
    pub(super) fn area(&self, interference: f64) -> f64 {
        hertz::contact_area(self.radius, interference * self.critical_interference)
    }

    /// Q, N, after the slip s = `slip`·a.
    fn friction(&self, interference: f64, slip: f64) -> Option<f64> {
        let strength = self.shear_strength?;
        let gross = constant_shear::gross_slip_displacement(strength, self.tangential_modulus, 1.0);
        let mobilised = constant_shear::force_fraction(slip / gross);
        Some(strength * self.area(interference) * mobilised)
    }

    /// Q of gross slip, N.
    pub(super) fn sliding_friction(&self, interference: f64) -> Option<f64> {
        Some(self.shear_strength? * self.area(interference))
    }

    /// Slip at which the last point slips, m.
    pub(super) fn inception_slip(&self, interference: f64) -> Option<f64> {
        let a = self.contact_radius(interference);
        let strength = self.shear_strength?;
        Some(constant_shear::gross_slip_displacement(strength, self.tangential_modulus, a))
    }

    /// Frictional dissipation up to gross slip per area, J/m².
    pub(super) fn energy_release(&self, interference: f64) -> Option<f64> {
        let (_, _, dissipated) = constant_shear::energies_at_gross_slip();
        Some(self.shear_strength? * self.inception_slip(interference)? * dissipated)
    }

    /// The asymptote at ω, given what it and the table are at ω₁ and `depth` = ln(ω/ω₁) ≤ 0.
    pub(super) fn continued(&self, here: f64, at_knot: f64, table: f64, depth: f64) -> f64 {
        if at_knot > 0.0 && table > 0.0 {
            here * (table / at_knot).powf(fade(depth))
        } else {
            // No ratio to carry on: the row's own value fades.
            table + (here - at_knot) * (1.0 - fade(depth))
        }
    }

    /// State at `depth` = ln(ω/ω₁) below the row at `knot` = ω₁/ω_c, whose state at the same
    /// s/a₀ = `slip` is `row`, and the relative error of going there: the distance between the
    /// asymptote and what was made of it, as far as it is not given by the row.
    pub(super) fn below(&self, knot: f64, depth: f64, slip: f64, row: &Values) -> (Values, Values) {
        let here = knot * depth.exp();
        let (load, area) = (Field::Load as usize, Field::Area as usize);
        let (friction, rise) = (Field::Friction as usize, Field::TemperatureRise as usize);
        let mut values = [0.0; FIELDS];
        let mut spread = [0.0; FIELDS];
        let mut continue_from = |field: usize, asymptote: f64, at_knot: f64| {
            values[field] = self.continued(asymptote, at_knot, row[field], depth);
            if asymptote > 0.0 {
                let distance = (values[field] / asymptote - 1.0).abs();
                spread[field] = distance * (1.0 - fade(depth));
            }
        };
        continue_from(load, self.load(here), self.load(knot));
        continue_from(area, self.area(here), self.area(knot));
        if let (Some(asymptote), Some(at_knot)) = (self.friction(here, slip), self.friction(knot, slip)) {
            continue_from(friction, asymptote, at_knot);
        } else if row[load] != 0.0 {
            values[friction] = values[load] * row[friction] / row[load];
            spread[friction] = spread[load];
        }
        values[rise] = row[rise] * fade(depth);
        (values, spread)
    }
}

/// √(ω/ω₁), the share of the first row in what is below it.
pub(super) fn fade(depth: f64) -> f64 {
    (0.5 * depth).exp()
}
