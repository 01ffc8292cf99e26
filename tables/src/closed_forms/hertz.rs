//! Frictionless elastic contact of a sphere with a rigid flat, and its first yield.
//!
//! H. Hertz, J. reine angew. Math. 92, 156 (1882); K. L. Johnson, *Contact Mechanics*,
//! Cambridge University Press (1985), §3.4 and §4.2, doi 10.1017/CBO9781139171731.
//!
//! Symbols: E* = E/(1−ν²) for a rigid flat, Pa; R sphere radius, m; ω interference, m;
//! a contact radius, m; A contact area, m²; P normal force, N; p₀ peak pressure, Pa;
//! σ_Y yield strength, Pa.

use std::f64::consts::PI;

use crate::functions::bisect;

/// E* = E/(1−ν²), Pa: contact modulus of an elastic body against a rigid one.
pub fn contact_modulus(youngs_modulus: f64, poisson_ratio: f64) -> f64 {
    youngs_modulus / (1.0 - poisson_ratio * poisson_ratio)
}

/// β of two elastic bodies, each by its Young's modulus (Pa; infinite where rigid) and Poisson ratio: pressure displaces their
/// surfaces tangentially by amounts whose difference is proportional to β/E*; 0 of like bodies (J. Dundurs, J. Appl. Mech. 36,
/// 650 (1969), doi 10.1115/1.3564739; Johnson §5.1).
///
/// ```
/// use tables::closed_forms::hertz::dundurs_beta;
///
/// let (soft, stiff) = ((200e9, 0.3), (400e9, 0.3));
/// assert_eq!(dundurs_beta(soft, soft), 0.0);
/// assert_eq!(dundurs_beta(soft, stiff), -dundurs_beta(stiff, soft));
/// // On a rigid body (1 − 2ν)/(2(1 − ν)).
/// let rigid = (f64::INFINITY, 0.3);
/// assert!((dundurs_beta(soft, rigid) - 0.4 / 1.4).abs() < 1e-15);
/// ```
pub fn dundurs_beta(first: (f64, f64), second: (f64, f64)) -> f64 {
    // 1/G times (1 − 2ν) and (1 − ν).
    let compliances = |(youngs_modulus, ratio): (f64, f64)| {
        let shear = 2.0 * (1.0 + ratio) / youngs_modulus;
        [shear * (1.0 - 2.0 * ratio), shear * (1.0 - ratio)]
    };
    let ([tangential, normal], [other_tangential, other_normal]) = (compliances(first), compliances(second));
    (tangential - other_tangential) / (2.0 * (normal + other_normal))
}

/// P = (4/3) E* √R ω^{3/2}, N.
pub fn hertz_load(e_star: f64, radius: f64, omega: f64) -> f64 {
    4.0 / 3.0 * e_star * radius.sqrt() * omega.powf(1.5)
}

/// a = √(Rω), m.
pub fn contact_radius(radius: f64, omega: f64) -> f64 {
    (radius * omega).sqrt()
}

/// A = πRω, m².
pub fn contact_area(radius: f64, omega: f64) -> f64 {
    PI * radius * omega
}

/// p₀ = 2E*a/(πR), Pa.
pub fn peak_pressure(e_star: f64, radius: f64, omega: f64) -> f64 {
    2.0 * e_star * contact_radius(radius, omega) / (PI * radius)
}

/// p(r) = p₀ √(1 − r²/a²), Pa; zero outside the contact.
pub fn pressure(peak: f64, contact_radius: f64, r: f64) -> f64 {
    let ratio = r / contact_radius;
    peak * (1.0 - ratio * ratio).max(0.0).sqrt()
}

/// Stresses on the axis at depth z = s·a, in units of p₀, tension positive: (σ_r = σ_θ, σ_z).
///
/// σ_r/p₀ = −(1+ν)(1 − s·atan(1/s)) + 1/(2(1+s²)), σ_z/p₀ = −1/(1+s²).
/// Johnson (1985), eq. 3.45.
pub fn axis_stresses(poisson_ratio: f64, s: f64) -> (f64, f64) {
    let decay = 1.0 / (1.0 + s * s);
    let radial = -(1.0 + poisson_ratio) * (1.0 - s * inverse_tangent(s)) + 0.5 * decay;
    (radial, -decay)
}

/// atan(1/s) without the division by zero at the surface.
fn inverse_tangent(s: f64) -> f64 {
    1.0_f64.atan2(s)
}

/// Stresses below the surface, r > 0 and z > 0 in units of a, in units of p₀, tension positive: (σ_r, σ_θ, σ_z, τ_rz).
///
/// With u the positive root of r²/(1 + u) + z²/u = 1. M. T. Huber, Ann. Phys. 319, 153 (1904), doi
/// 10.1002/andp.19043190612.
pub fn stresses(poisson_ratio: f64, [r, z]: [f64; 2]) -> [f64; 4] {
    let offset = 0.5 * (r * r + z * z - 1.0);
    let distance = (offset * offset + z * z).sqrt();
    // Without cancellation of the two terms near the surface.
    let u = if offset > 0.0 { distance + offset } else { z * z / (distance - offset) };
    let root = u.sqrt();
    let (ratio, fall) = (z / root, u / (u * u + z * z));
    let bent = (1.0 - 2.0 * poisson_ratio) / (3.0 * r * r) * (1.0 - ratio.powi(3));
    let plane = (1.0 - poisson_ratio) * u / (1.0 + u);
    let angle = (1.0 + poisson_ratio) * root * (1.0 / root).atan();
    let radial = bent + ratio.powi(3) * fall + ratio * (plane + angle - 2.0);
    let hoop = -bent - ratio * (2.0 * poisson_ratio + plane - angle);
    [radial, hoop, -ratio.powi(3) * fall, -r * z * z / (u * u + z * z) * root / (1.0 + u)]
}

/// Depth z/a at which the von Mises stress on the axis is largest.
pub fn first_yield_depth(poisson_ratio: f64) -> f64 {
    // The derivative of σ_r − σ_z along the axis changes sign once between surface and z = a.
    let slope = |s: f64| {
        let decay = 1.0 / (1.0 + s * s);
        (1.0 + poisson_ratio) * (inverse_tangent(s) - s * decay) - 3.0 * s * decay * decay
    };
    let [above, below] = bisect([0.0, 1.0], 60, |s| slope(s) > 0.0);
    0.5 * (above + below)
}

/// C(ν) = p₀/σ_Y at first yield: the exact maximum of the von Mises stress on the axis.
///
/// The published fits, 1.295 exp(0.736ν) (Jackson & Green 2005) and 1.234 + 1.256ν (Brizmer,
/// Kligerman & Etsion 2006), are within 0.2 % and 0.9 % of it for 0.2 ≤ ν ≤ 0.5.
pub fn yield_coefficient(poisson_ratio: f64) -> f64 {
    let (radial, axial) = axis_stresses(poisson_ratio, first_yield_depth(poisson_ratio));
    1.0 / (radial - axial).abs()
}

/// ω_c = (π C(ν) σ_Y / 2E*)² R, m: interference of first yield.
pub fn critical_interference(e_star: f64, poisson_ratio: f64, yield_strength: f64, radius: f64) -> f64 {
    let ratio = PI * yield_coefficient(poisson_ratio) * yield_strength / (2.0 * e_star);
    ratio * ratio * radius
}

/// P_c = (4/3)(R/E*)² (π C(ν) σ_Y / 2)³, N: load of first yield.
pub fn critical_load(e_star: f64, poisson_ratio: f64, yield_strength: f64, radius: f64) -> f64 {
    let omega = critical_interference(e_star, poisson_ratio, yield_strength, radius);
    hertz_load(e_star, radius, omega)
}

/// A_c = πRω_c, m²: contact area at first yield.
pub fn critical_area(e_star: f64, poisson_ratio: f64, yield_strength: f64, radius: f64) -> f64 {
    let omega = critical_interference(e_star, poisson_ratio, yield_strength, radius);
    contact_area(radius, omega)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(value: f64, reference: f64, relative: f64) {
        assert!((value - reference).abs() <= relative * reference.abs(), "{value} against {reference}");
    }

    #[test]
    fn first_yield_agrees_with_an_independent_maximisation() {
        // ν, C(ν), z/a.
        let reference = [
            (0.20, 1.49858583, 0.447810),
            (0.25, 1.55434743, 0.464313),
            (0.28, 1.58908337, 0.474237),
            (0.29, 1.60088342, 0.477550),
            (0.30, 1.61279656, 0.480864),
            (0.32, 1.63696796, 0.487502),
            (0.33, 1.64922922, 0.490825),
            (0.342, 1.66410003, 0.494816),
            (0.35, 1.67411050, 0.497480),
            (0.40, 1.73848095, 0.514175),
            (0.50, 1.87723934, 0.547868),
        ];
        for (nu, coefficient, depth) in reference {
            assert!((yield_coefficient(nu) - coefficient).abs() < 6e-9, "{nu}");
            assert!((first_yield_depth(nu) - depth).abs() < 6e-7, "{nu}");
        }
    }

    #[test]
    fn anchor_of_400_mpa_steel() {
        let (nu, yield_strength, radius) = (0.3, 400e6, 100e-6);
        let e_star = contact_modulus(200e9, nu);
        close(e_star, 219.780e9, 1e-5);
        let omega = critical_interference(e_star, nu, yield_strength, radius);
        close(omega, 2.12589e-9, 5e-6);
        close(critical_load(e_star, nu, yield_strength, radius), 2.87237e-4, 5e-6);
        close(contact_radius(radius, omega), 0.46107e-6, 2e-5);
        close(peak_pressure(e_star, radius, omega), 645.119e6, 5e-6);
        let area = critical_area(e_star, nu, yield_strength, radius);
        close(area, PI * 0.46107e-6 * 0.46107e-6, 5e-5);
    }

    /// Near the axis those of the axis, near the surface the pressure, and in equilibrium between.
    #[test]
    fn stresses_are_in_equilibrium() {
        for depth in [0.1, 0.48, 2.0] {
            let (radial, axial) = axis_stresses(0.3, depth);
            let [near, hoop, down, shear] = stresses(0.3, [1e-4, depth]);
            assert!((near - radial).abs() < 1e-6 && (hoop - radial).abs() < 1e-6);
            assert!((down - axial).abs() < 1e-6 && shear.abs() < 1e-4);
        }
        let [_, _, down, shear] = stresses(0.3, [0.6, 1e-9]);
        assert!((down + 0.8).abs() < 1e-8 && shear.abs() < 1e-8);
        let step = 1e-5;
        for [r, z] in [[0.3, 0.4], [0.9, 0.2], [1.5, 1.0]] {
            let [radial, hoop, _, shear] = stresses(0.3, [r, z]);
            let (out, inner) = (stresses(0.3, [r + step, z]), stresses(0.3, [r - step, z]));
            let (deep, shallow) = (stresses(0.3, [r, z + step]), stresses(0.3, [r, z - step]));
            let slope = |a: [f64; 4], b: [f64; 4], i: usize| (a[i] - b[i]) / (2.0 * step);
            let along_r = slope(out, inner, 0) + slope(deep, shallow, 3) + (radial - hoop) / r;
            let along_z = slope(out, inner, 3) + slope(deep, shallow, 2) + shear / r;
            assert!(along_r.abs() < 1e-8 && along_z.abs() < 1e-8, "{along_r} {along_z}");
        }
    }

    #[test]
    fn pressure_integrates_to_the_load() {
        let (e_star, radius, omega) = (2e11, 1e-3, 1e-8);
        let (a, peak) = (contact_radius(radius, omega), peak_pressure(e_star, radius, omega));
        let rings = 20_000;
        let width = a / rings as f64;
        let sum: f64 = (0..rings)
            .map(|ring| (ring as f64 + 0.5) * width)
            .map(|r| 2.0 * PI * r * pressure(peak, a, r) * width)
            .sum();
        close(sum, hertz_load(e_star, radius, omega), 1e-5);
    }
}
