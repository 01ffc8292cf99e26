//! Tangential loading of an elastic sphere on a rigid flat: stick, partial slip, gross slip.
//!
//! Normal and tangential problems are taken as uncoupled, which is exact for ν = ½ and has
//! an error of a few per cent for a rigid flat and ν = 0.3.
//!
//! Symbols: G* = G/(2−ν), Pa; a contact radius, m; u rigid tangential displacement of the flat
//! relative to the far body, m; Q tangential force, N; c radius of the sticking core, m.

use std::f64::consts::{FRAC_2_PI, PI};

/// G* = G/(2−ν) = E/(2(1+ν)(2−ν)), Pa: tangential contact modulus against a rigid flat.
pub fn tangential_modulus(youngs_modulus: f64, poisson_ratio: f64) -> f64 {
    youngs_modulus / (2.0 * (1.0 + poisson_ratio) * (2.0 - poisson_ratio))
}

/// Time of sliding inception, over that of a shear wave across the contact radius, below which inertia counts.
pub const SHORTEST_INCEPTION: f64 = 5.0;

/// Time of sliding inception over that of a shear wave across the contact radius, of a mean shear stress of 1 Pa and a slip
/// rate of 1 m/s; in proportion to the stress and to the inverse of the slip rate.
///
/// The centre of a disc under the uniform shear traction τ̄ is displaced by (2 − ν)τ̄a/(2G) (Johnson 1985,
/// Contact Mechanics, section 3.7): after that slip the last point slips. With c_s² = G/ρ the ratio is
/// (2 − ν)τ̄/(2ρc_sV).
pub fn inception_time(youngs_modulus: f64, poisson_ratio: f64, density: f64) -> f64 {
    let shear_modulus = 0.5 * youngs_modulus / (1.0 + poisson_ratio);
    0.5 * (2.0 - poisson_ratio) / (density * shear_modulus).sqrt()
}

/// 8G*a, N/m: tangential stiffness in full stick (Mindlin 1949, doi 10.1115/1.4009973).
pub fn stick_stiffness(g_star: f64, contact_radius: f64) -> f64 {
    8.0 * g_star * contact_radius
}

/// Interface that slips where the shear stress reaches a constant strength τ₀.
///
/// With x = u/δ_s and δ_s = τ₀a/(2G*):
/// c/a = √(1−x²), Q = πa²τ₀ · (2/π)(asin x + x√(1−x²)).
/// Savkoor-type solution: A. R. Savkoor, thesis, Delft (1987); A. Chateauminois & C. Fretigny,
/// Eur. Phys. J. E 27, 221 (2008), doi 10.1140/epje/i2008-10376-5. Derived anew and checked
/// by ring integration to 1e-9.
pub mod constant_shear {
    use super::*;

    /// δ_s = τ₀a/(2G*), m: displacement at which the last point slips.
    pub fn gross_slip_displacement(shear_strength: f64, g_star: f64, contact_radius: f64) -> f64 {
        shear_strength * contact_radius / (2.0 * g_star)
    }

    /// Q/(πa²τ₀) at x = u/δ_s; 1 from x = 1 on, 0 for x ≤ 0.
    pub fn force_fraction(x: f64) -> f64 {
        let x = x.clamp(0.0, 1.0);
        FRAC_2_PI * (x.asin() + x * (1.0 - x * x).sqrt())
    }

    /// c/a at x = u/δ_s.
    pub fn stick_radius_fraction(x: f64) -> f64 {
        let x = x.clamp(0.0, 1.0);
        (1.0 - x * x).sqrt()
    }

    /// Energies from u = 0 to gross slip in units of πa²τ₀δ_s: (work of the flat, stored
    /// elastic energy, frictional dissipation) = (1 − 4/3π, 4/3π, 1 − 8/3π).
    pub fn energies_at_gross_slip() -> (f64, f64, f64) {
        let stored = 4.0 / (3.0 * PI);
        (1.0 - stored, stored, 1.0 - 2.0 * stored)
    }
}

/// Coulomb interface, τ ≤ μp, under Hertz pressure at constant normal force.
///
/// With u_s = 3μP/(16G*a): Q = μP(1 − (1 − u/u_s)^{3/2}), c/a = (1 − u/u_s)^{1/2}.
/// C. Cattaneo (1938); R. D. Mindlin, J. Appl. Mech. 16, 259 (1949), doi 10.1115/1.4009973.
pub mod mindlin {
    /// Frictional dissipation up to gross slip, over μP·u_s: work 3/5, elastic energy 2/5.
    pub const DISSIPATED_AT_GROSS_SLIP: f64 = 0.2;

    /// u_s = 3μP/(16G*a), m: displacement at which the last point slips.
    pub fn gross_slip_displacement(friction: f64, load: f64, g_star: f64, contact_radius: f64) -> f64 {
        3.0 * friction * load / (16.0 * g_star * contact_radius)
    }

    /// Q/(μP) at x = u/u_s; 1 from x = 1 on.
    pub fn force_fraction(x: f64) -> f64 {
        1.0 - (1.0 - x.clamp(0.0, 1.0)).powf(1.5)
    }

    /// c/a at x = u/u_s.
    pub fn stick_radius_fraction(x: f64) -> f64 {
        (1.0 - x.clamp(0.0, 1.0)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constant_shear_reference_table() {
        // u/δ_s, Q/Q_max, c/a.
        let reference = [
            (0.1, 0.127112, 0.994987),
            (0.25, 0.314962, 0.968246),
            (0.5, 0.608998, 0.866025),
            (0.75, 0.855706, 0.661438),
            (1.0, 1.0, 0.0),
        ];
        for (x, force, stick) in reference {
            assert!((constant_shear::force_fraction(x) - force).abs() < 1e-6);
            assert!((constant_shear::stick_radius_fraction(x) - stick).abs() < 1e-6);
        }
    }

    #[test]
    fn constant_shear_work_is_the_integral_of_the_force() {
        let steps = 100_000;
        let sum: f64 =
            (0..steps).map(|step| constant_shear::force_fraction((step as f64 + 0.5) / steps as f64)).sum();
        let (work, stored, dissipated) = constant_shear::energies_at_gross_slip();
        assert!((sum / steps as f64 - work).abs() < 1e-8);
        assert!((work - stored - dissipated).abs() < 1e-15);
    }

    #[test]
    fn both_interfaces_start_with_the_stick_stiffness() {
        let (g_star, a, x) = (3e10, 2e-6, 1e-7);
        let stiffness = stick_stiffness(g_star, a);

        let shear_strength = 2e8;
        let limit = constant_shear::gross_slip_displacement(shear_strength, g_star, a);
        let force = PI * a * a * shear_strength * constant_shear::force_fraction(x);
        assert!((force / (x * limit) / stiffness - 1.0).abs() < 1e-6);

        let (friction, load) = (0.3, 0.01);
        let limit = mindlin::gross_slip_displacement(friction, load, g_star, a);
        let force = friction * load * mindlin::force_fraction(x);
        assert!((force / (x * limit) / stiffness - 1.0).abs() < 1e-6);
    }
}
