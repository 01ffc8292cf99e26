//! Overlap of a disc with heat that has spread from another disc.

use std::f64::consts::PI;

use gauss_quad::GaussLegendre;

/// Points of the quadrature over the distance.
const POINTS: usize = 24;
/// Standard deviations beyond which a Gaussian distribution is zero.
const WIDTH: f64 = 6.5;

#[derive(Clone, Debug)]
pub(super) struct Overlap {
    rule: GaussLegendre,
}

impl Overlap {
    pub fn new() -> Self {
        Self { rule: GaussLegendre::new(POINTS).expect("there are rules of more than one point") }
    }

    /// Mean over a disc of radius a of what was 1 on a disc of radius b, and has since moved by `distance` and spread by
    /// a Gaussian distribution of the standard deviation `spread` along each axis:
    ///
    /// ```text
    /// S = 1/(πa²) ∫ O(ρ) ρ/σ² exp(−(ρ² + d²)/(2σ²)) I₀(ρd/σ²) dρ,
    /// ```
    ///
    /// O(ρ) the area that both discs have in common at a distance ρ of their centres.
    pub fn share(&self, radii: [f64; 2], spread: f64, distance: f64) -> f64 {
        let [a, b] = radii;
        let from = (distance - WIDTH * spread).max(0.0);
        let to = (distance + WIDTH * spread).min(a + b);
        let variance = spread * spread;
        let density = |rho: f64| {
            let exponent = -(rho - distance).powi(2) / (2.0 * variance);
            common_area(rho, radii) * rho / variance
                * exponent.exp()
                * scaled_bessel(rho * distance / variance)
        };
        // The area has a kink where one disc leaves the other.
        let kink = (a - b).abs().clamp(from, to.max(from));
        let part = |from: f64, to: f64| if to > from { self.rule.integrate(from, to, density) } else { 0.0 };
        (part(from, kink) + part(kink, to)) / (PI * a * a)
    }
}

/// Area that two discs have in common at a distance of their centres.
fn common_area(distance: f64, [a, b]: [f64; 2]) -> f64 {
    let smaller = a.min(b);
    if distance <= (a - b).abs() {
        return PI * smaller * smaller;
    }
    if distance >= a + b {
        return 0.0;
    }
    // Distance of the common chord from each centre.
    let to_chord =
        |own: f64, other: f64| (distance * distance + own * own - other * other) / (2.0 * distance);
    let segment = |radius: f64, chord: f64| {
        radius * radius * (chord / radius).clamp(-1.0, 1.0).acos()
            - chord * (radius * radius - chord * chord).max(0.0).sqrt()
    };
    segment(a, to_chord(a, b)) + segment(b, to_chord(b, a))
}

/// e⁻ˣ I₀(x), x ≥ 0, to 2e-7 (Abramowitz & Stegun 1964, 9.8.1 and 9.8.2).
fn scaled_bessel(x: f64) -> f64 {
    let polynomial = |y: f64, coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * y + c);
    if x < 3.75 {
        let small = [1.0, 3.5156229, 3.0899424, 1.2067492, 0.2659732, 0.0360768, 0.0045813];
        (-x).exp() * polynomial((x / 3.75).powi(2), &small)
    } else {
        let large = [
            0.39894228,
            0.01328592,
            0.00225319,
            -0.00157565,
            0.00916281,
            -0.02057706,
            0.02635537,
            -0.01647633,
            0.00392377,
        ];
        polynomial(3.75 / x, &large) / x.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// I₀ of Abramowitz & Stegun 1964, table 9.8: e⁻ˣ I₀(x).
    #[test]
    fn bessel_function_agrees_with_its_table() {
        for (x, exact) in [(0.0, 1.0), (1.0, 0.4657596077), (4.0, 0.2070019212), (10.0, 0.1278333372)] {
            assert!((scaled_bessel(x) / exact - 1.0).abs() < 1e-6, "{x}");
        }
    }

    #[test]
    fn common_area_of_discs() {
        // Two unit discs: 2 arccos(d/2) − (d/2)√(4 − d²).
        for d in [0.1f64, 0.5, 1.0, 1.9] {
            let exact = 2.0 * (0.5 * d).acos() - 0.5 * d * (4.0 - d * d).sqrt();
            assert!((common_area(d, [1.0, 1.0]) - exact).abs() < 1e-14, "{d}");
        }
        assert_eq!(common_area(0.4, [1.0, 0.5]), PI * 0.25);
        assert_eq!(common_area(1.6, [1.0, 0.5]), 0.0);
    }

    /// What has not spread is the common area; what has spread far, a Gaussian of the heat of the disc; and the heat
    /// of a disc within a wide one stays there.
    #[test]
    fn shares_have_their_limits() {
        let overlap = Overlap::new();
        let share = |radii, spread, distance| overlap.share(radii, spread, distance);
        for d in [0.0, 0.7, 1.5] {
            let area = common_area(d, [1.0, 1.0]) / PI;
            assert!((share([1.0, 1.0], 1e-5, d) - area).abs() < 2e-5, "{d}");
        }
        for d in [0.0f64, 30.0, 60.0] {
            let gauss = 0.5 * (-(d / 30.0).powi(2) / 2.0).exp() / 900.0;
            assert!((share([1.0, 1.0], 30.0, d) / gauss - 1.0).abs() < 2e-3, "{d}");
        }
        assert!((share([10.0, 1.0], 0.5, 2.0) - 0.01).abs() < 1e-8);
        assert_eq!(share([1.0, 1.0], 0.01, 3.0), 0.0);
    }
}
