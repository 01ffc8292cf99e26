//! Below the first interference of a table: the elastic sphere.
//!
//! P is Hertz's, A = πRω, and Q that of partial slip under the constant shear strength
//! τ_c = f_τσ_Y/√3 of the initial temperature. So that there is no jump at the first row ω₁, each is
//! multiplied by the ratio that the row has to it.
//!
//! - If the first row is elastic (ω₁ ≤ ω_c), P and A keep their ratios: those of a press in full stick do not
//!   depend on ω (Spence 1968). The part of Q that is not the area's, softening by heat, goes with the
//!   contact radius: its ratio is raised to √(ω/ω₁).
//! - If it is plastic, all ratios are, and go to 1.
//! - Friction lifts a light contact, as τ_c is above its pressure, the more the lighter it is. What it takes of
//!   load and area, in the square of τ_c over the pressure, is left as a doubt about everything that slides.
//!
//! The temperature rise goes with the contact radius. Where the interface has no strength of its own, Q/P keeps
//! the value that it has at the first row.

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
    /// f_τ.
    strength_factor: Option<f64>,
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
            strength_factor: metadata.strength_factor,
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

    /// The asymptote at ω, given what it and the table are at ω₁; `share` of the row's ratio is kept.
    pub(super) fn continued(&self, here: f64, at_knot: f64, table: f64, share: f64) -> f64 {
        if at_knot > 0.0 && table > 0.0 {
            here * (table / at_knot).powf(share)
        } else {
            // No ratio to carry on: the row's own value fades.
            table + (here - at_knot) * (1.0 - share)
        }
    }

    /// Share of load and area that friction takes from a light contact and the row does not know of. 4340 steel that
    /// slides bears 0.997, 0.988, 0.975, 0.955 and 0.919 of Hertz's load at 0.5, 0.2, 0.1, 0.05 and 0.03 ω_c, which is
    /// 0.0022 ω_c/ω less than in heavier contacts, and so is its area; half as strong an interface takes a third, copper
    /// and aluminium lose 0.0016 ω_c/ω (24 elements, isothermal).
    pub(super) fn lifted(&self, descent: Descent) -> f64 {
        const LIFT: f64 = 0.0022;
        let Some(factor) = self.strength_factor else { return 0.0 };
        let lift = |interference: f64| LIFT * factor * factor / interference;
        (lift(descent.here()) - lift(descent.knot)).min(1.0)
    }

    /// State below a row, whose state at the same s/a₀ = `slip` is `row`, and the relative error of going there.
    pub(super) fn below(&self, descent: Descent, slip: f64, row: &Values) -> (Values, Values) {
        let (here, knot) = (descent.here(), descent.knot);
        let (load, area) = (Field::Load as usize, Field::Area as usize);
        let (friction, rise) = (Field::Friction as usize, Field::TemperatureRise as usize);
        let mut values = [0.0; FIELDS];
        let mut spread = [0.0; FIELDS];
        let lifted = self.lifted(descent);
        for (field, asymptote, at_knot) in
            [(load, self.load(here), self.load(knot)), (area, self.area(here), self.area(knot))]
        {
            values[field] = self.continued(asymptote, at_knot, row[field], descent.kept());
            spread[field] = descent.doubt(values[field] / asymptote) + lifted;
        }
        if let (Some(asymptote), Some(at_knot)) = (self.friction(here, slip), self.friction(knot, slip)) {
            let per_area = values[area] / self.area(here);
            let row_per_area = row[friction] / (row[area] / self.area(knot));
            let faded = self.continued(asymptote, at_knot, row_per_area, descent.fade());
            values[friction] = per_area * faded;
            let of_strength = if asymptote > 0.0 { faded / asymptote } else { 1.0 };
            spread[friction] = spread[area] + (of_strength - 1.0).abs() * (1.0 - descent.fade());
        } else if row[load] != 0.0 {
            values[friction] = values[load] * row[friction] / row[load];
            spread[friction] = spread[load];
        }
        values[rise] = row[rise] * descent.fade();
        (values, spread)
    }
}

/// From a row down to an interference.
#[derive(Clone, Copy, Debug)]
pub(super) struct Descent {
    /// ω₁/ω_c of the row.
    pub(super) knot: f64,
    /// ln(ω/ω₁) ≤ 0.
    pub(super) depth: f64,
}

impl Descent {
    /// ω/ω_c.
    pub(super) fn here(self) -> f64 {
        self.knot * self.depth.exp()
    }

    /// √(ω/ω₁), the share of the first row in what heat does below it.
    pub(super) fn fade(self) -> f64 {
        (0.5 * self.depth).exp()
    }

    /// Share of the ratio of P and A to those of the elastic sphere that is kept.
    pub(super) fn kept(self) -> f64 {
        if self.knot <= 1.0 { 1.0 } else { self.fade() }
    }

    /// Doubt about a ratio to the asymptote: all of what fades, and a share of what is kept. The expansion of a hot
    /// contact gives 4340 steel at 10 m/s 1.42, 1.46, 1.49 and 1.53 times the load at 0.1, 0.07, 0.05 and 0.03 ω_c, and more
    /// to titanium, where 0.3 of it was not enough.
    pub(super) fn doubt(self, ratio: f64) -> f64 {
        const OF_KEPT: f64 = 0.6;
        let share = if self.kept() < 1.0 { 1.0 } else { OF_KEPT };
        let doubt = share * (ratio - 1.0).abs() * (1.0 - self.fade());
        if doubt.is_finite() { doubt } else { 0.0 }
    }
}
