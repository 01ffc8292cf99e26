//! Overlap of a disc with heat that has spread from another disc.

use std::f64::consts::PI;

use gauss_quad::GaussLegendre;
use nalgebra::Matrix2;

/// Points of the quadrature over the distance.
const POINTS: usize = 24;
/// Standard deviations beyond which a Gaussian distribution is zero.
const WIDTH: f64 = 6.5;
/// 1/⟨ξ²⟩ over a disc.
const SLOPE: f64 = 4.0;

#[derive(Clone, Debug)]
pub(super) struct Overlap {
    rule: GaussLegendre,
}

impl Overlap {
    pub fn new() -> Self {
        Self { rule: GaussLegendre::new(POINTS).expect("there are rules of more than one point") }
    }

    /// Profile over a disc of radius a of what had the profiles (1, 0) and (0, 1) on a disc of radius b, the columns, and has
    /// since moved by `displacement` along x and spread by a Gaussian distribution of the standard deviation `spread` along
    /// each axis.
    ///
    /// With the centre of the disc b at ρ (cos ψ, sin ψ) from that of the disc a, the moments of the area that both have in
    /// common depend on ψ as 1, cos ψ and cos 2ψ, and the integral of the Gaussian distribution over ψ leaves modified Bessel
    /// functions:
    ///
    /// ```text
    /// S = ∫ Σ_m C_m(ρ) ρ/σ² exp(−(ρ² + d²)/(2σ²)) I_m(ρd/σ²) dρ.
    /// ```
    pub fn share(&self, radii: [f64; 2], spread: f64, displacement: f64) -> Matrix2<f64> {
        let [a, b] = radii;
        let distance = displacement.abs();
        let from = (distance - WIDTH * spread).max(0.0);
        let to = (distance + WIDTH * spread).min(a + b);
        let variance = spread * spread;
        let density = |rho: f64| {
            let Lens { area, u, uu, vv } = Lens::of(rho, radii);
            let [constant, cosine, double] = scaled_bessel(rho * distance / variance);
            let exponent = -(rho - distance).powi(2) / (2.0 * variance);
            let (along, across) = (uu - rho * u, vv);
            Matrix2::new(
                area * constant,
                (u - rho * area) / b * cosine,
                SLOPE * u / a * cosine,
                0.5 * SLOPE * ((along + across) * constant + (along - across) * double) / (a * b),
            ) * (rho / variance * exponent.exp())
        };
        // The area has a kink where one disc leaves the other.
        let kink = (a - b).abs().clamp(from, to.max(from));
        let sum = integral(&self.rule, from, kink, density) + integral(&self.rule, kink, to, density);
        let sign = if displacement < 0.0 { -1.0 } else { 1.0 };
        sum.component_mul(&Matrix2::new(1.0, sign, sign, 1.0)) / (PI * a * a)
    }
}

/// ∫ f dx.
pub(super) fn integral(
    rule: &GaussLegendre,
    from: f64,
    to: f64,
    f: impl Fn(f64) -> Matrix2<f64>,
) -> Matrix2<f64> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    if half <= 0.0 {
        return Matrix2::zeros();
    }
    rule.iter().map(|(node, weight)| f(middle + half * node) * (half * weight)).sum()
}

/// The area that two discs have in common, and its moments ∫u, ∫u² and ∫v² in the frame of the first disc, with u towards
/// the centre of the second.
#[derive(Clone, Copy, Debug)]
struct Lens {
    area: f64,
    u: f64,
    uu: f64,
    vv: f64,
}

impl Lens {
    /// Of discs of radii a and b with their centres at a distance.
    fn of(distance: f64, [a, b]: [f64; 2]) -> Self {
        if distance >= a + b {
            return Self { area: 0.0, u: 0.0, uu: 0.0, vv: 0.0 };
        }
        if distance <= (a - b).abs() {
            let whole = Self::segment(a.min(b), -a.min(b));
            return if b < a { whole.shifted(distance) } else { whole };
        }
        // The common chord.
        let chord = (distance * distance + a * a - b * b) / (2.0 * distance);
        let near = Self::segment(a, chord);
        let far = Self { u: -Self::segment(b, distance - chord).u, ..Self::segment(b, distance - chord) };
        let far = far.shifted(distance);
        Self { area: near.area + far.area, u: near.u + far.u, uu: near.uu + far.uu, vv: near.vv + far.vv }
    }

    /// The part u > `from` of a disc.
    fn segment(radius: f64, from: f64) -> Self {
        let c = from.clamp(-radius, radius);
        let squared = radius * radius;
        let half_chord = (squared - c * c).max(0.0).sqrt();
        let sector = squared * (c / radius).acos();
        Self {
            area: sector - c * half_chord,
            u: 2.0 / 3.0 * half_chord.powi(3),
            uu: 0.25 * (squared * sector - c * (2.0 * c * c - squared) * half_chord),
            vv: 0.25 * squared * sector - c * (5.0 * squared - 2.0 * c * c) * half_chord / 12.0,
        }
    }

    /// With the centre of its disc at `distance` along u.
    fn shifted(self, distance: f64) -> Self {
        Self {
            u: self.u + distance * self.area,
            uu: self.uu + distance * (2.0 * self.u + distance * self.area),
            ..self
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
            let mut sums = [0.0; 4];
            let width = a / f64::from(CELLS);
            for (i, j) in (-CELLS..CELLS).flat_map(|i| (-CELLS..CELLS).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|k| (f64::from(k) + 0.5) * width);
                if u.hypot(v) < a && (u - distance).hypot(v) < b {
                    let terms = [1.0, u, u * u, v * v];
                    (0..4).for_each(|k| sums[k] += terms[k] * width * width);
                }
            }
            for (found, sum) in [lens.area, lens.u, lens.uu, lens.vv].into_iter().zip(sums) {
                assert!((found - sum).abs() < 1e-3, "{distance} {a} {b}: {lens:?} {sums:?}");
            }
        }
        assert_eq!(Lens::of(1.6, [1.0, 0.5]).area, 0.0);
    }

    /// What has not spread is the area in common; what has spread far, a Gaussian of the heat of the disc and of its first
    /// moment; and inside of a wide disc a linear profile stays one.
    #[test]
    fn shares_have_their_limits() {
        let overlap = Overlap::new();
        for d in [0.0, 0.7, 1.5] {
            let (share, lens) = (overlap.share([1.0, 1.0], 1e-5, d), Lens::of(d, [1.0, 1.0]));
            let exact =
                Matrix2::new(lens.area, lens.u - d * lens.area, 4.0 * lens.u, 4.0 * (lens.uu - d * lens.u))
                    / PI;
            assert!((share - exact).abs().max() < 1e-4, "{d}: {share} {exact}");
        }
        for d in [-60.0, -30.0, 0.0f64, 30.0, 60.0] {
            let share = overlap.share([1.0, 2.0], 30.0, d);
            let gauss = 2.0 * (-(d / 30.0).powi(2) / 2.0).exp() / 900.0;
            assert!((share[(0, 0)] / gauss - 1.0).abs() < 2e-3, "{d}");
            let gradient = d / 900.0;
            assert!((share[(0, 1)] + 0.5 * gradient * gauss).abs() < 2e-4 * gauss, "{d}: {share}");
            assert!((share[(1, 0)] - gradient * gauss).abs() < 2e-4 * gauss, "{d}: {share}");
        }
        for d in [-0.3, 0.3] {
            for spread in [1e-5, 0.03] {
                let share = overlap.share([0.5, 1.0], spread, d);
                let exact = Matrix2::new(1.0, -d, 0.0, 0.5);
                assert!((share - exact).abs().max() < 1e-5, "{spread} {d}: {share}");
            }
        }
        assert!((overlap.share([10.0, 1.0], 0.5, 2.0)[(0, 0)] - 0.01).abs() < 1e-8);
        assert_eq!(overlap.share([1.0, 1.0], 0.01, 3.0), Matrix2::zeros());
    }
}
