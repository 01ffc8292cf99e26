//! Overlap of a disc with heat that has spread from another disc, and with the displacement that it causes.

use std::f64::consts::PI;

use gauss_quad::GaussLegendre;
use nalgebra::Matrix3;

/// Step of v in the sum over Gaussian distributions, see [`raised`]: the kernel is exact to 1e-3, its
/// integral over a slip to 2e-4.
const SPREADING_STEP: f64 = 0.75;
/// Terms of that sum at most; the last is spread 1e16 times as far as the heat.
const MOST_TERMS: u32 = 50;
/// Share of the sum so far below which its remainder is left out.
const NEGLIGIBLE: f64 = 1e-3;
/// Standard deviations beyond which a Gaussian distribution is zero.
const WIDTH: f64 = 6.5;
/// 1/⟨ξ²⟩ and 1/⟨η²⟩ over a disc.
const SLOPE: f64 = 4.0;
const CURVATURE: f64 = 3.0;

/// Profile over a disc of radius a of what had the profiles (1, 0, 0), (0, 1, 0) and (0, 0, 1) on a disc of radius b, the
/// columns, and has since moved by `displacement` along x and spread by a Gaussian distribution of the standard deviation
/// `spread` along each axis, with the quadrature `rule` over the distance of the centres.
///
/// With the centre of the disc b at ρ (cos ψ, sin ψ) from that of the disc a, the moments of the area that both have in
/// common depend on ψ as 1, cos ψ and cos 2ψ, and the integral of the Gaussian distribution over ψ leaves modified Bessel
/// functions:
///
/// ```text
/// S = ∫ Σ_m C_m(ρ) ρ/σ² exp(−(ρ² + d²)/(2σ²)) I_m(ρd/σ²) dρ.
/// ```
pub(super) fn share(rule: &GaussLegendre, radii: [f64; 2], spread: f64, displacement: f64) -> Matrix3<f64> {
    let [a, b] = radii;
    let distance = displacement.abs();
    let from = (distance - WIDTH * spread).max(0.0);
    let to = (distance + WIDTH * spread).min(a + b);
    let variance = spread * spread;
    let density = |rho: f64| {
        let [constant, cosine, double] = scaled_bessel(rho * distance / variance);
        let exponent = -(rho - distance).powi(2) / (2.0 * variance);
        let weight = rho / variance * exponent.exp();
        moments(rho, radii, [weight * constant, weight * cosine, weight * double])
    };
    // The area has a kink where one disc leaves the other.
    let kink = (a - b).abs().clamp(from, to.max(from));
    let sum = integral(rule, from, kink, density) + integral(rule, kink, to, density);
    let odd = if displacement < 0.0 { -1.0 } else { 1.0 };
    let signs = Matrix3::new(1.0, odd, 1.0, odd, 1.0, odd, 1.0, odd, 1.0);
    sum.component_mul(&signs) / (PI * a * a)
}

/// Profile, as by [`share`], of what has the transform erfc(kσ/√2) in place of the Gaussian distribution exp(−k²σ²/2): the
/// displacement of the surface by heat that has spread that far. With J. W. Craig's integral (MILCOM 1991, 571),
/// sin φ = 1/cosh v,
///
/// ```text
/// erfc(x) = (2/π) ∫ exp(−x² cosh² v)/cosh v dv,      v = 0 to ∞:
/// ```
///
/// a sum of distributions of the standard deviations σ cosh v. The trapezoidal rule converges exponentially.
pub(super) fn raised(rule: &GaussLegendre, radii: [f64; 2], spread: f64, displacement: f64) -> Matrix3<f64> {
    let mut sum = 0.5 * share(rule, radii, spread, displacement);
    for step in 1..=MOST_TERMS {
        let wider = (f64::from(step) * SPREADING_STEP).cosh();
        let term = share(rule, radii, spread * wider, displacement) / wider;
        sum += term;
        // Heat that has moved away reaches the disc by the wide distributions alone.
        let reaches = spread * wider > displacement.abs();
        if reaches && term.amax() <= NEGLIGIBLE * sum.amax() {
            break;
        }
    }
    sum * (2.0 / PI * SPREADING_STEP)
}

/// Σ C_m w_m over m = 0, 1, 2.
fn moments(rho: f64, [a, b]: [f64; 2], [constant, cosine, double]: [f64; 3]) -> Matrix3<f64> {
    let Lens { area, u, uu, vv, urr, rrrr } = Lens::of(rho, [a, b]);
    // Squared distances from both centres, and u from the second.
    let (first, away) = (uu + vv, u - rho * area);
    let second = first - 2.0 * rho * u + rho * rho * area;
    let (u_second, away_first) = (urr - 2.0 * rho * uu + rho * rho * u, urr - rho * first);
    let both = rrrr - 2.0 * rho * urr + rho * rho * first;
    let (along, across) = (uu - rho * u, vv);
    // Over squared radii.
    let (first, second) = (2.0 * first / (a * a), 2.0 * second / (b * b));
    Matrix3::new(
        area * constant,
        away / b * cosine,
        (second - area) * constant,
        SLOPE * u / a * cosine,
        0.5 * SLOPE * ((along + across) * constant + (along - across) * double) / (a * b),
        SLOPE * (2.0 * u_second / (b * b) - u) / a * cosine,
        CURVATURE * (first - area) * constant,
        CURVATURE * (2.0 * away_first / (a * a) - away) / b * cosine,
        CURVATURE * (4.0 * both / (a * b).powi(2) - first - second + area) * constant,
    )
}

/// ∫ f dx.
pub(super) fn integral(
    rule: &GaussLegendre,
    from: f64,
    to: f64,
    f: impl Fn(f64) -> Matrix3<f64>,
) -> Matrix3<f64> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    if half <= 0.0 {
        return Matrix3::zeros();
    }
    rule.iter().map(|(node, weight)| f(middle + half * node) * (half * weight)).sum()
}

/// The area that two discs have in common, and its moments ∫u, ∫u², ∫v², ∫ur² and ∫r⁴ in the frame of the first disc, with u
/// towards the centre of the second, v across and r² = u² + v².
#[derive(Clone, Copy, Debug, Default)]
struct Lens {
    area: f64,
    u: f64,
    uu: f64,
    vv: f64,
    urr: f64,
    rrrr: f64,
}

impl Lens {
    /// Lens of two discs of radii a and b with their centres at a distance.
    fn of(distance: f64, [a, b]: [f64; 2]) -> Self {
        if distance >= a + b {
            return Self::default();
        }
        if distance <= (a - b).abs() {
            let whole = Self::segment(a.min(b), -a.min(b));
            return if b < a { whole.shifted(distance) } else { whole };
        }
        // The common chord.
        let chord = (distance * distance + a * a - b * b) / (2.0 * distance);
        let (near, far) = (Self::segment(a, chord), Self::segment(b, distance - chord));
        let far = Self { u: -far.u, urr: -far.urr, ..far }.shifted(distance);
        Self {
            area: near.area + far.area,
            u: near.u + far.u,
            uu: near.uu + far.uu,
            vv: near.vv + far.vv,
            urr: near.urr + far.urr,
            rrrr: near.rrrr + far.rrrr,
        }
    }

    /// The part u > `from` of a disc.
    fn segment(radius: f64, from: f64) -> Self {
        let c = from.clamp(-radius, radius);
        let squared = radius * radius;
        let half_chord = (squared - c * c).max(0.0).sqrt();
        let (cc, hh) = (c * c, half_chord * half_chord);
        let sector = squared * (c / radius).acos();
        Self {
            area: sector - c * half_chord,
            u: 2.0 / 3.0 * hh * half_chord,
            uu: 0.25 * (squared * sector - c * (2.0 * cc - squared) * half_chord),
            vv: 0.25 * squared * sector - c * (5.0 * squared - 2.0 * cc) * half_chord / 12.0,
            urr: (2.0 / 3.0 * squared - 4.0 / 15.0 * hh) * hh * half_chord,
            rrrr: (squared * squared * sector - c * half_chord * (cc * cc + cc * hh / 1.5 + hh * hh / 5.0))
                / 3.0,
        }
    }

    /// This lens with the centre of its disc at `distance` along u.
    fn shifted(self, distance: f64) -> Self {
        let Self { area, u, uu, vv, urr, rrrr } = self;
        let (d, rr) = (distance, uu + vv);
        Self {
            area,
            u: u + d * area,
            uu: uu + d * (2.0 * u + d * area),
            vv,
            urr: urr + d * (rr + 2.0 * uu + d * (3.0 * u + d * area)),
            rrrr: rrrr + d * (4.0 * urr + d * (2.0 * rr + 4.0 * uu + d * (4.0 * u + d * area))),
        }
    }
}

/// e⁻ˣ I_m(x) for m = 0, 1, 2 and x ≥ 0, to 2e-7 (Abramowitz & Stegun 1964, 9.8.1 to 9.8.4, 9.6.26).
fn scaled_bessel(x: f64) -> [f64; 3] {
    let polynomial = |y: f64, coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * y + c);
    if x < 3.75 {
        let (y, decay) = ((x / 3.75).powi(2), (-x).exp());
        let zeroth = [1.0, 3.5156229, 3.0899424, 1.2067492, 0.2659732, 0.0360768, 0.0045813];
        let first = [0.5, 0.87890594, 0.51498869, 0.15084934, 0.02658733, 0.00301532, 0.00032411];
        let [zeroth, over_x] = [zeroth, first].map(|coefficients| decay * polynomial(y, &coefficients));
        // I₂ = I₀ − 2I₁/x.
        [zeroth, x * over_x, zeroth - 2.0 * over_x]
    } else {
        let zeroth = [
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
        let first = [
            0.39894228,
            -0.03988024,
            -0.00362018,
            0.00163801,
            -0.01031555,
            0.02282967,
            -0.02895312,
            0.01787654,
            -0.00420059,
        ];
        let [zeroth, first] =
            [zeroth, first].map(|coefficients| polynomial(3.75 / x, &coefficients) / x.sqrt());
        [zeroth, first, zeroth - 2.0 * first / x]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// e⁻ˣ I_m(x) by Abramowitz & Stegun 1964, tables 9.8 and 9.9.
    #[test]
    fn bessel_functions_agree_with_their_tables() {
        for (x, exact) in [
            (0.0, [1.0, 0.0, 0.0]),
            (1.0, [0.4657596077, 0.2079104154, 0.0499387768]),
            (4.0, [0.2070019212, 0.1787508395, 0.1176265015]),
            (10.0, [0.1278333372, 0.1212626814, 0.1035808009]),
        ] {
            for (found, exact) in scaled_bessel(x).into_iter().zip(exact) {
                assert!((found - exact).abs() < 4e-7, "{x}: {found} {exact}");
            }
        }
    }

    /// Against sums over a grid of points of the first disc.
    #[test]
    fn moments_of_the_area_in_common_are_those_of_its_points() {
        const CELLS: i32 = 400;
        for (distance, [a, b]) in
            [(0.1, [1.0, 1.0]), (1.5, [1.0, 1.0]), (0.8, [1.0, 0.5]), (0.7, [0.6, 1.0]), (0.3, [1.0, 0.5])]
        {
            let lens = Lens::of(distance, [a, b]);
            let mut sums = [0.0; 6];
            let width = a / f64::from(CELLS);
            for (i, j) in (-CELLS..CELLS).flat_map(|i| (-CELLS..CELLS).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|k| (f64::from(k) + 0.5) * width);
                if u.hypot(v) < a && (u - distance).hypot(v) < b {
                    let rr = u * u + v * v;
                    let terms = [1.0, u, u * u, v * v, u * rr, rr * rr];
                    (0..6).for_each(|k| sums[k] += terms[k] * width * width);
                }
            }
            let Lens { area, u, uu, vv, urr, rrrr } = lens;
            for (found, sum) in [area, u, uu, vv, urr, rrrr].into_iter().zip(sums) {
                assert!((found - sum).abs() < 1e-3, "{distance} {a} {b}: {lens:?} {sums:?}");
            }
        }
        assert_eq!(Lens::of(1.6, [1.0, 0.5]).area, 0.0);
    }

    /// What has not spread is the area in common; what has spread far, a Gaussian of the heat of the disc and of its first
    /// moment; and inside of a wide disc a profile stays one.
    #[test]
    fn shares_have_their_limits() {
        let rule = GaussLegendre::new(24).unwrap();
        let share = |radii, spread, displacement| share(&rule, radii, spread, displacement);
        for d in [0.0, 0.7, 1.5] {
            let share = share([1.0, 1.0], 1e-5, d);
            let exact = moments(d, [1.0, 1.0], [1.0; 3]) / PI;
            assert!((share - exact).abs().max() < 1e-4, "{d}: {share} {exact}");
        }
        for d in [-60.0, -30.0, 0.0f64, 30.0, 60.0] {
            let share = share([1.0, 2.0], 30.0, d);
            let gauss = 2.0 * (-(d / 30.0).powi(2) / 2.0).exp() / 900.0;
            assert!((share[(0, 0)] / gauss - 1.0).abs() < 2e-3, "{d}");
            let gradient = d / 900.0;
            assert!((share[(0, 1)] + 0.5 * gradient * gauss).abs() < 2e-4 * gauss, "{d}: {share}");
            assert!((share[(1, 0)] - gradient * gauss).abs() < 2e-4 * gauss, "{d}: {share}");
        }
        for d in [-0.3f64, 0.3] {
            for spread in [1e-5f64, 0.03] {
                let share = share([0.5, 1.0], spread, d);
                // 2 (x − d)² + 2y² − 1 and the spread, with x = ξ/2 and y = υ/2.
                let mean = 2.0 * d * d - 0.75 + 4.0 * spread * spread;
                let exact = Matrix3::new(1.0, -d, mean, 0.0, 0.5, -2.0 * d, 0.0, 0.0, 0.25);
                assert!((share - exact).abs().max() < 1e-5, "{spread} {d}: {share} {exact}");
            }
        }
        assert!((share([10.0, 1.0], 0.5, 2.0)[(0, 0)] - 0.01).abs() < 1e-8);
        assert_eq!(share([1.0, 1.0], 0.01, 3.0), Matrix3::zeros());
    }
}
