//! Limit of the shear traction of an interface, τ ≤ min(τ₀ + αp, τ_max), and the elastic sphere that slides under it.

use std::f64::consts::PI;

use super::partial_slip::{constant_shear, mindlin};

/// τ ≤ min(τ₀ + αp, τ_max): a constant strength, a film (Briscoe & Tabor 1975), Coulomb's law, each with an upper limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLimit {
    /// τ₀, Pa.
    pub film: f64,
    /// α.
    pub coefficient: f64,
    /// τ_max, Pa; may be infinite.
    pub cap: f64,
}

/// An elastic sphere in gross slip.
#[derive(Clone, Copy, Debug)]
pub struct GrossSlip {
    /// Mean shear traction, Pa.
    pub mean: f64,
    /// Share of it that does not depend on the pressure.
    constant: f64,
}

impl ShearLimit {
    /// A limit that does not depend on the pressure: `strength`, Pa.
    pub fn constant(strength: f64) -> Self {
        Self { film: strength, coefficient: 0.0, cap: f64::INFINITY }
    }

    /// Gross slip under Hertz's pressure p₀u with u = √(1 − r²/a²), `peak` = p₀ in Pa.
    ///
    /// The mean is 2∫min(τ₀ + αp₀u, τ_max) u du from 0 to 1; the limit is τ_max from u_max = (τ_max − τ₀)/(αp₀) on.
    pub fn gross_slip(&self, peak: f64) -> GrossSlip {
        let Self { film, coefficient, cap } = *self;
        let slope = coefficient * peak;
        let capped_from = if film + slope <= cap { 1.0 } else { ((cap - film) / slope).max(0.0) };
        let of_pressure = 2.0 / 3.0 * slope * capped_from.powi(3);
        let at_cap = if capped_from < 1.0 { cap * (1.0 - capped_from * capped_from) } else { 0.0 };
        let mean = film * capped_from * capped_from + of_pressure + at_cap;
        GrossSlip { mean, constant: if mean > 0.0 { 1.0 - of_pressure / mean } else { 1.0 } }
    }
}

impl GrossSlip {
    /// Displacement at which the last point slips, over that of a constant traction τ̄a/(2G*): the displacements of the
    /// constant and of the Hertzian part of the traction add up.
    fn displacement_ratio(&self) -> f64 {
        self.constant + (1.0 - self.constant) * 3.0 * PI / 8.0
    }

    /// Displacement (m) at which the last point slips; `tangential_modulus` is G*, Pa, the contact radius in m.
    pub fn displacement(&self, tangential_modulus: f64, contact_radius: f64) -> f64 {
        let of_constant =
            constant_shear::gross_slip_displacement(self.mean, tangential_modulus, contact_radius);
        of_constant * self.displacement_ratio()
    }

    /// Q over that of gross slip at x = displacement over that of gross slip: by the shares of both parts, exact for
    /// each alone.
    pub fn force_fraction(&self, x: f64) -> f64 {
        self.constant * constant_shear::force_fraction(x) + (1.0 - self.constant) * mindlin::force_fraction(x)
    }

    /// Frictional dissipation up to gross slip over friction times its displacement, likewise: 1 − 8/3π of a constant
    /// limit, 1/5 of Coulomb's law.
    pub fn dissipated(&self) -> f64 {
        self.constant * constant_shear::energies_at_gross_slip().2
            + (1.0 - self.constant) * mindlin::DISSIPATED_AT_GROSS_SLIP
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G_STAR: f64 = 3e10;
    const RADIUS: f64 = 1e-5;

    /// The mean by the midpoint rule over the radius.
    #[test]
    fn means_are_integrals_over_the_contact() {
        let peak = 1e9;
        for limit in [
            ShearLimit::constant(2e8),
            ShearLimit { film: 3e7, coefficient: 0.1, cap: f64::INFINITY },
            ShearLimit { film: 3e7, coefficient: 0.1, cap: 9e7 },
            ShearLimit { film: 0.0, coefficient: 0.3, cap: 1e8 },
            ShearLimit { film: 3e7, coefficient: 0.1, cap: 2e7 },
        ] {
            let steps = 100_000;
            let sum: f64 = (0..steps)
                .map(|i| (f64::from(i) + 0.5) / f64::from(steps))
                .map(|r| {
                    let pressure = peak * (1.0 - r * r).sqrt();
                    (limit.film + limit.coefficient * pressure).min(limit.cap) * 2.0 * r
                })
                .sum();
            let mean = limit.gross_slip(peak).mean;
            assert!((mean / (sum / f64::from(steps)) - 1.0).abs() < 1e-7, "{limit:?}: {mean}");
        }
    }

    #[test]
    fn one_part_alone_is_the_known_solution() {
        let (peak, friction) = (1e9, 0.2);
        let load = 2.0 / 3.0 * peak * PI * RADIUS * RADIUS;
        let coulomb = ShearLimit { film: 0.0, coefficient: friction, cap: f64::INFINITY }.gross_slip(peak);
        let exact = mindlin::gross_slip_displacement(friction, load, G_STAR, RADIUS);
        assert!((coulomb.displacement(G_STAR, RADIUS) / exact - 1.0).abs() < 1e-14);
        assert!((coulomb.mean * PI * RADIUS * RADIUS / (friction * load) - 1.0).abs() < 1e-14);
        assert!((coulomb.force_fraction(0.4) - mindlin::force_fraction(0.4)).abs() < 1e-15);
        assert!((coulomb.dissipated() - 0.2).abs() < 1e-15);
        let constant = ShearLimit::constant(2e8).gross_slip(peak);
        let exact = constant_shear::gross_slip_displacement(2e8, G_STAR, RADIUS);
        assert_eq!(constant.displacement(G_STAR, RADIUS), exact);
        assert_eq!(constant.force_fraction(0.4), constant_shear::force_fraction(0.4));
    }

    /// Dissipation of Coulomb's law: the work of the flat less the elastic energy, half the integral of traction times
    /// displacement u_s(1 − r²/2a²) of the full slip.
    #[test]
    fn dissipation_is_work_less_stored_energy() {
        let steps = 100_000;
        let at = |i: i32| (f64::from(i) + 0.5) / f64::from(steps);
        let work: f64 = (0..steps).map(|i| mindlin::force_fraction(at(i))).sum::<f64>() / f64::from(steps);
        let stored: f64 = (0..steps)
            .map(at)
            .map(|r| 0.5 * 1.5 * (1.0 - r * r).sqrt() * (1.0 - 0.5 * r * r) * 2.0 * r)
            .sum::<f64>()
            / f64::from(steps);
        assert!((work - stored - mindlin::DISSIPATED_AT_GROSS_SLIP).abs() < 1e-6, "{}", work - stored);
    }
}
