//! Extrapolation towards the Hertz limit, below the first interference ω₁ of a table.
//!
//! The elastic sphere has Hertz's load P, the area A = πRω, and the friction force Q of partial slip under the
//! [`ShearLimit`] of the interface at the initial temperature. So that the response is continuous at ω₁,
//! each of the three is multiplied by a power of the ratio of the first row to the elastic sphere:
//!
//! x(ω) = x_el(ω)·(x₁/x_el(ω₁))^w
//!
//! - If the first row is plastic (ω₁ > ω_c), w = √(ω/ω₁): the ratio tends to 1.
//! - If it is elastic, w = 1 for P and A: their ratios in a press in full stick do not depend on ω (D. A. Spence,
//!   *Self similar solutions to adhesive contact problems with incremental loading*, Proc. R. Soc. Lond. A 305, 55
//!   (1968), doi 10.1098/rspa.1968.0105). Softening by heat changes Q/A; it is in proportion to the contact radius,
//!   and w = √(ω/ω₁) for Q/A.
//! - Thermal expansion raises load and area at a slip rate over those at the slowest one of the table. The excess of this ratio
//!   over 1 is kept for the area, and a power of ω for the load: both are multiplied by it, in place of a part of their ratio
//!   to the elastic sphere.
//! - The slip at inception and the energy G contain plastic flow of the asperity: w = (ω/ω₁)^0.85.
//!
//! The temperature rise is in proportion to the contact radius. If the interface has no limit of the shear traction, or
//! the table does not state it, Q/P has the value of the first row.

use super::nodes::{COEFFICIENT, Errors, STATE_QUANTITIES, StateQuantity, Values};
use crate::closed_forms::hertz;
use crate::closed_forms::shear_limit::{GrossSlip, ShearLimit};
use crate::table::Metadata;

/// Friction-induced uplift: relative decrease of P and A of a sliding light contact, over f_τ²·ω_c/ω. Fitted to the
/// load of sliding 4340 steel (24 elements, isothermal), over Hertz's: 0.997, 0.987, 0.972, 0.943 and 0.896 at
/// ω/ω_c = 0.5, 0.2, 0.1, 0.05 and 0.03. Half the strength gives a third of it. Repeated by
/// `asperity calibrate`.
pub const UPLIFT: f64 = 0.003;

/// Uncertainty of a constant ratio to the elastic sphere (w = 1) at the slowest slip rate, and of a constant effect of heat,
/// over its difference from 1: that of a hot ratio, which is as large as both. Thermal expansion
/// raises the load of 4340 steel at 10 m/s to 1.42, 1.46, 1.49 and 1.53 times Hertz's at ω/ω_c = 0.1, 0.07, 0.05
/// and 0.03; for titanium 0.3 does not cover the change. Repeated by `asperity calibrate`.
pub const UNCERTAINTY_OF_KEPT_RATIO: f64 = 0.6;

/// The sphere of a table in elastic contact, at its radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElasticSphere {
    pub(super) radius: f64,
    critical_interference: f64,
    contact_modulus: f64,
    /// G* = G/(2−ν), Pa.
    tangential_modulus: f64,
    shear_limit: Option<ShearLimit>,
    /// σ_Y/√3, Pa.
    shear_strength: f64,
    /// C and ε̇₀ (1/s) of a rate law.
    rate_law: Option<(f64, f64)>,
}

impl ElasticSphere {
    pub(super) fn new(metadata: &Metadata) -> Self {
        let nu = metadata.poisson_ratio;
        Self {
            radius: metadata.asperity_radius,
            critical_interference: metadata.critical_interference,
            contact_modulus: metadata.contact_modulus,
            // G/(2−ν) with E = E*(1−ν²).
            tangential_modulus: metadata.contact_modulus * (1.0 - nu) / (2.0 * (2.0 - nu)),
            shear_limit: metadata.shear_limit(),
            shear_strength: metadata.yield_strength / 3f64.sqrt(),
            rate_law: metadata.rate_coefficient.zip(metadata.rate_reference),
        }
    }

    /// Gross slip, where the shear traction has a limit.
    fn gross_slip(&self, interference: f64) -> Option<GrossSlip> {
        let peak = 1.5 * self.load(interference) / self.area(interference);
        Some(self.shear_limit?.gross_slip(peak))
    }

    pub(super) fn has_rate_law(&self) -> bool {
        self.rate_law.is_some()
    }

    /// Λ = 1 + C ln(V/(aε̇₀)), by which the strength is larger at a slip rate (m/s) and contact radius (m); 1 without a rate
    /// law.
    pub(super) fn rate_factor(&self, slip_rate: f64, contact_radius: f64) -> f64 {
        self.rate_law.map_or(1.0, |(coefficient, reference)| {
            1.0 + coefficient * (slip_rate / (contact_radius * reference)).max(1.0).ln()
        })
    }

    /// Λ, the factor of [`rate_factor`](Self::rate_factor), at a slip rate (m/s) and ω/ω_c.
    pub(super) fn rate_factor_at(&self, slip_rate: f64, interference: f64) -> f64 {
        self.rate_factor(slip_rate, self.contact_radius(interference))
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

    /// Q, N, after the slip s = `slip`·a at a slip rate.
    fn friction(&self, interference: f64, slip: f64, slip_rate: f64) -> Option<f64> {
        let sliding = self.gross_slip(interference)?;
        let rate_factor = self.rate_factor_at(slip_rate, interference);
        let at_gross_slip = rate_factor * sliding.displacement(self.tangential_modulus, 1.0);
        Some(
            rate_factor
                * sliding.mean
                * self.area(interference)
                * sliding.force_fraction(slip / at_gross_slip),
        )
    }

    /// Q of gross slip, N.
    pub(super) fn sliding_friction(&self, interference: f64) -> Option<f64> {
        Some(self.gross_slip(interference)?.mean * self.area(interference))
    }

    /// Slip at which the last point slips, m.
    pub(super) fn inception_slip(&self, interference: f64) -> Option<f64> {
        let a = self.contact_radius(interference);
        Some(self.gross_slip(interference)?.displacement(self.tangential_modulus, a))
    }

    /// Frictional dissipation up to gross slip per area, J/m².
    pub(super) fn energy_release(&self, interference: f64) -> Option<f64> {
        let sliding = self.gross_slip(interference)?;
        Some(sliding.mean * self.inception_slip(interference)? * sliding.dissipated())
    }

    /// Relative uncertainty of P and A by friction-induced uplift, of which the first row has that at ω₁.
    pub(super) fn uplift_uncertainty(&self, below: BelowFirstRow) -> f64 {
        let uplift = |interference: f64| {
            let factor = self.gross_slip(interference).map_or(0.0, |slip| slip.mean / self.shear_strength);
            UPLIFT * factor * factor / interference
        };
        (uplift(below.interference()) - uplift(below.first_row)).min(1.0)
    }

    /// Load or area below the first row, in which it is `row`, and its relative uncertainty but for uplift; `elastic` is that of
    /// the elastic sphere.
    pub(super) fn pressed_below(
        below: BelowFirstRow,
        elastic: &dyn Fn(f64) -> f64,
        row: f64,
        heat: HeatRatio,
    ) -> (f64, f64) {
        let (here, first) = (elastic(below.interference()), elastic(below.first_row));
        let cold = row / heat.first_row;
        let value = extrapolated(here, first, cold, below.press_weight());
        (value * heat.at(below), below.ratio_uncertainty(cold / first) + heat.uncertainty(below))
    }

    /// State below the first row, whose state at the same s/a₀ = `slip` is `row`, and its relative uncertainty; with the
    /// effect of heat on load and area in the first row.
    pub(super) fn state_below(
        &self,
        below: BelowFirstRow,
        (slip, slip_rate): (f64, f64),
        row: &Values,
        heat: [HeatRatio; 2],
    ) -> (Values, Errors) {
        let (here, first) = (below.interference(), below.first_row);
        let (load, area) = (StateQuantity::Load as usize, StateQuantity::Area as usize);
        let (friction, rise) = (StateQuantity::Friction as usize, StateQuantity::TemperatureRise as usize);
        let mut values = [0.0; STATE_QUANTITIES];
        let mut uncertainty = Errors::default();
        let uplift = self.uplift_uncertainty(below);
        let of_load: &dyn Fn(f64) -> f64 = &|at| self.load(at);
        for (field, elastic, heat) in [(load, of_load, heat[0]), (area, &|at| self.area(at), heat[1])] {
            let (value, relative) = Self::pressed_below(below, elastic, row[field], heat);
            (values[field], uncertainty[field]) = (value, relative + uplift);
        }
        if let (Some(elastic), Some(elastic_at_row)) =
            (self.friction(here, slip, slip_rate), self.friction(first, slip, slip_rate))
        {
            let per_area = values[area] / self.area(here);
            let row_per_area = row[friction] / (row[area] / self.area(first));
            let of_strength = extrapolated(elastic, elastic_at_row, row_per_area, below.thermal_weight());
            values[friction] = per_area * of_strength;
            let ratio = if elastic > 0.0 { of_strength / elastic } else { 1.0 };
            let thermal = (ratio - 1.0).abs() * (1.0 - below.thermal_weight());
            uncertainty[friction] = uncertainty[area].max(uncertainty[load]) + thermal;
            // As a scalar has it: uplift decreases load and area alike.
            uncertainty[COEFFICIENT] = uncertainty[area] + uncertainty[load] - uplift + thermal;
        } else if row[load] != 0.0 {
            values[friction] = values[load] * row[friction] / row[load];
            uncertainty[friction] = uncertainty[load];
        }
        values[rise] = row[rise] * below.thermal_weight();
        uncertainty[rise] = below.rise_uncertainty();
        (values, uncertainty)
    }
}

/// x_el(ω)·(x₁/x_el(ω₁))^w of a quantity that is `elastic` in the elastic sphere at ω, `elastic_at_row` there at ω₁,
/// and `row` in the first row.
pub(super) fn extrapolated(elastic: f64, elastic_at_row: f64, row: f64, weight: f64) -> f64 {
    if elastic_at_row > 0.0 && row > 0.0 {
        elastic * (row / elastic_at_row).powf(weight)
    } else {
        // Without a ratio, the difference is weighted.
        row + (elastic - elastic_at_row) * (1.0 - weight)
    }
}

/// Load or area in the first row over that at the slowest slip rate of the table: the effect of frictional heat, by thermal
/// expansion.
#[derive(Clone, Copy, Debug)]
pub(super) struct HeatRatio {
    pub(super) first_row: f64,
    /// Exponent of ω in the excess of the ratio over 1.
    exponent: f64,
}

impl HeatRatio {
    pub(super) const NONE: Self = Self { first_row: 1.0, exponent: 0.0 };

    /// An excess that does not depend on ω, from the value in the first row at the slip rate and at the slowest one.
    pub(super) fn constant([value, slowest]: [f64; 2]) -> Self {
        let first_row = value / slowest;
        if first_row.is_finite() && first_row > 0.0 { Self { first_row, exponent: 0.0 } } else { Self::NONE }
    }

    /// An excess that is a power of ω, with the exponent from the first row to the second, whose ω is larger by `log_ratio` in its logarithm.
    pub(super) fn power(
        [value, slowest]: [f64; 2],
        [second, second_slowest]: [f64; 2],
        log_ratio: f64,
    ) -> Self {
        /// Smallest exponent of the shipped tables, of the titanium alloy at 10 m/s, rounded.
        const LEAST: f64 = -0.6;
        let here = Self::constant([value, slowest]);
        let excess = [here.first_row, second / second_slowest].map(|ratio| (ratio - 1.0).max(0.0));
        let exponent = (excess[1] / excess[0]).ln() / log_ratio;
        if exponent.is_nan() { here } else { Self { exponent: exponent.clamp(LEAST, 0.0), ..here } }
    }

    /// Constant below a hundredth of the first row.
    fn at(self, below: BelowFirstRow) -> f64 {
        let log_ratio = below.log_ratio.max(0.01f64.ln());
        1.0 + (self.first_row - 1.0) * (self.exponent * log_ratio).exp()
    }

    /// Relative uncertainty of that.
    fn uncertainty(self, below: BelowFirstRow) -> f64 {
        let here = self.at(below);
        let kept = UNCERTAINTY_OF_KEPT_RATIO * (self.first_row - 1.0).abs() * (1.0 - below.thermal_weight());
        (kept / self.first_row).max(0.5 * (here - self.first_row).abs() / here)
    }
}

/// An interference ω below the first row ω₁.
#[derive(Clone, Copy, Debug)]
pub(super) struct BelowFirstRow {
    /// ω₁/ω_c.
    pub(super) first_row: f64,
    /// ln(ω/ω₁) ≤ 0.
    pub(super) log_ratio: f64,
}

impl BelowFirstRow {
    /// ω/ω_c.
    pub(super) fn interference(self) -> f64 {
        self.first_row * self.log_ratio.exp()
    }

    /// √(ω/ω₁): weight of the first row in quantities that depend on heat.
    pub(super) fn thermal_weight(self) -> f64 {
        (0.5 * self.log_ratio).exp()
    }

    /// Relative uncertainty of a temperature rise in proportion to the contact radius a: where a moving counterface carries heat away,
    /// or heat takes strength, it is in proportion to a power of a between 1/2 and 1.
    pub(super) fn rise_uncertainty(self) -> f64 {
        1.0 / self.thermal_weight().sqrt() - 1.0
    }

    /// Weight w of the first row in P and A.
    pub(super) fn press_weight(self) -> f64 {
        if self.first_row <= 1.0 { 1.0 } else { self.thermal_weight() }
    }

    /// Weight w of the first row in the slip at inception and in G: the logarithms of their ratios to the elastic sphere are
    /// in proportion to powers of ω, with exponents of 0.8 to 1 up to 2 ω_c in the shipped tables, and 0.5 to 0.8 up to 4 ω_c.
    pub(super) fn plastic_weight(self) -> f64 {
        (0.85 * self.log_ratio).exp()
    }

    /// Relative uncertainty of a quantity with that weight, by its ratio to the elastic sphere in the first row: 1.25 times the
    /// difference to a weight of √(ω/ω₁).
    pub(super) fn plastic_uncertainty(self, ratio: f64) -> f64 {
        let uncertainty = 1.25 * ratio.ln().abs() * (self.thermal_weight() - self.plastic_weight());
        if uncertainty.is_finite() { uncertainty } else { 0.0 }
    }

    /// Relative uncertainty of a ratio to the elastic sphere: all of the part that tends to 1, and a share of a
    /// constant ratio.
    pub(super) fn ratio_uncertainty(self, ratio: f64) -> f64 {
        let share = if self.press_weight() < 1.0 { 1.0 } else { UNCERTAINTY_OF_KEPT_RATIO };
        let uncertainty = share * (ratio - 1.0).abs() * (1.0 - self.thermal_weight());
        if uncertainty.is_finite() { uncertainty } else { 0.0 }
    }
}
