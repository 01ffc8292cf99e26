//! Powers, exponentials and logarithms without branches: the compiler makes vector instructions of loops over lanes.
//!
//! Rational approximations of the Cephes library (Moshier, Methods and Programs for Mathematical Functions, 1989) with
//! the operations and their order of the vector class library (Fog, 2014-2023, www.agner.org/optimize) and of its port,
//! the crate `wide`; errors of one or two units in the last place.

use std::f64::consts::{LN_2, LOG2_E, SQRT_2};

/// ln 2 in two parts, of which the first has few digits.
const LN_2_PARTS: [f64; 2] = [0.693145751953125, 1.4286068203094173e-06];
/// ln 2 in two parts, for the logarithm.
const LN_2_OF_LOG: [f64; 2] = [f64::from_bits(0x3FE6_2E42_FEE0_0000), f64::from_bits(0x3DEA_39EF_3579_3C76)];
/// Added to an integer it moves that to the last bits.
const TO_LAST_BITS: f64 = (1_u64 << 52) as f64;

/// a·b + c, fused if the target has that instruction.
#[inline(always)]
pub fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// (f − 1, e) with x = 2^e f, √½ < f ≤ √2, for a normal x > 0.
#[inline(always)]
fn split(x: f64) -> (f64, f64) {
    let bits = x.to_bits();
    let half = f64::from_bits(bits & 0x000F_FFFF_FFFF_FFFF | 0x3FE0_0000_0000_0000);
    let exponent = f64::from_bits(bits >> 52 | TO_LAST_BITS.to_bits()) - (TO_LAST_BITS + 1023.0);
    let above = half > SQRT_2 * 0.5;
    let fraction = if above { half } else { half + half };
    (fraction - 1.0, if above { exponent + 1.0 } else { exponent })
}

/// c₀ + c₁x + … + c₅x⁵.
#[inline(always)]
fn polynomial_5(x: f64, c: [f64; 6]) -> f64 {
    let x2 = x * x;
    let x4 = x2 * x2;
    fma(x2, fma(c[3], x, c[2]), fma(x4, fma(c[5], x, c[4]), fma(c[1], x, c[0])))
}

/// e^x − 1 for small |x|.
#[inline(always)]
fn expm1_polynomial(x: f64) -> f64 {
    const C: [f64; 14] = {
        let mut c = [1.0; 14];
        let (mut i, mut factorial) = (1, 1.0);
        while i < 14 {
            factorial *= i as f64;
            c[i] = 1.0 / factorial;
            i += 1;
        }
        c
    };
    let x2 = x * x;
    let x4 = x2 * x2;
    let x8 = x4 * x4;
    let pair = |i: usize| fma(x, C[i + 1], C[i]);
    let high = fma(x4, pair(12), fma(x2, pair(10), pair(8)));
    fma(x8, high, fma(x4, fma(x2, pair(6), pair(4)), fma(x2, pair(2), x)))
}

/// 2^e for an integer −1023 < e < 1024.
#[inline(always)]
fn power_of_two(e: f64) -> f64 {
    f64::from_bits((e + (1023.0 + TO_LAST_BITS)).to_bits() << 52)
}

/// x^n, x ≥ 0, n ≥ 0; NaN and ∞ come back.
#[inline(always)]
pub fn power(x: f64, n: f64) -> f64 {
    const P: [f64; 7] = [
        20.039553499201283,
        57.11296359058554,
        60.94966798098779,
        29.911919328553072,
        6.578732594206104,
        0.49854102823193375,
        4.52700008624452e-05,
    ];
    const Q: [f64; 6] = [
        60.11866049760384,
        216.42788614495947,
        309.09872225312057,
        221.76239823732857,
        83.04756596796722,
        15.062909083469192,
    ];
    let (f, exponent) = split(x);
    let f2 = f * f;
    let f4 = f2 * f2;
    let numerator =
        fma(f4, fma(f2, P[6], fma(f, P[5], P[4])), fma(f2, fma(f, P[3], P[2]), fma(f, P[1], P[0]))) * f * f2;
    let denominator = fma(f4, fma(f, Q[5], f2 + Q[4]), fma(f2, fma(f, Q[3], Q[2]), fma(f, Q[1], Q[0])));
    let correction = numerator / denominator;
    // e and its rest of n times the exponent; ln f with its error.
    let of_exponent = (exponent * n).round_ties_even();
    let rest = fma(exponent, n, -of_exponent);
    let log = fma(-0.5, f2, f) + correction;
    let square_error = fma(0.5 * f, f, -(0.5 * f2));
    let log_error = fma(0.5, f2, log - f) - correction;
    let of_fraction = (log * n * LOG2_E).round_ties_even();
    let v = fma(log, n, -(of_fraction * LN_2_PARTS[0]));
    let v = fma(-of_fraction, LN_2_PARTS[1], v);
    let v = v - fma(log_error + square_error, n, -(rest * LN_2));
    let of_rest = (v * LOG2_E).round_ties_even();
    let v = fma(-of_rest, LN_2, v);
    let z = expm1_polynomial(v) + 1.0;
    let e = of_exponent + of_fraction + of_rest;
    let scaled = f64::from_bits(z.to_bits().wrapping_add((e + 1.5 * TO_LAST_BITS).to_bits() << 52));
    let biased = e + f64::from_bits(z.to_bits() >> 52 | TO_LAST_BITS.to_bits()) - TO_LAST_BITS;
    let scaled = if biased > 0.0 { scaled } else { 0.0 };
    let scaled = if biased < 2047.0 { scaled } else { f64::INFINITY };
    let of_zero = if n == 0.0 { 1.0 } else { 0.0 };
    let scaled = if x < f64::MIN_POSITIVE { of_zero } else { scaled };
    if x < f64::INFINITY { scaled } else { x }
}

/// e^x, x ≤ 0; zero where that is below the normal numbers.
#[inline(always)]
pub fn exponential(x: f64) -> f64 {
    let r = (x * LOG2_E).round_ties_even();
    let rest = fma(-r, LN_2_PARTS[1], fma(-r, LN_2_PARTS[0], x));
    let value = (expm1_polynomial(rest) + 1.0) * power_of_two(r);
    if r < -1022.0 { 0.0 } else { value }
}

/// ln x; NaN for x < 0, −∞ below the normal numbers.
#[inline(always)]
pub fn logarithm(x: f64) -> f64 {
    const P: [f64; 6] = [
        7.708387337558854,
        17.936867850781983,
        14.498922534161093,
        4.705791198788817,
        0.497494994976747,
        0.00010187566380458093,
    ];
    const Q: [f64; 5] =
        [23.125162012676533, 71.15447506185639, 82.98752669127767, 45.227914583753225, 11.287358718916746];
    let (f, exponent) = split(x);
    let f2 = f * f;
    let f4 = f2 * f2;
    let numerator = f2 * f * polynomial_5(f, P);
    let denominator = fma(f2, fma(Q[3], f, Q[2]), fma(f4, Q[4] + f, fma(Q[1], f, Q[0])));
    let log = fma(exponent, LN_2_OF_LOG[1], numerator / denominator) + fma(-f2, 0.5, f);
    let log = fma(exponent, LN_2_OF_LOG[0], log);
    let below = if x < 0.0 { f64::NAN } else { f64::NEG_INFINITY };
    let log = if x < f64::MIN_POSITIVE { below } else { log };
    if x < f64::INFINITY { log } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(value: f64, exact: f64, at: (f64, f64)) {
        let error = (value - exact).abs();
        assert!(error <= 1e-15 * exact.abs() || value == exact, "{value:e} {exact:e} at {at:?}");
    }

    #[test]
    fn agree_with_the_c_library() {
        for step in -3000_i32..3000 {
            let x = (0.1 * f64::from(step)).exp();
            for n in [0.014, 0.26, 0.5, 1.0, 1.03] {
                assert_close(power(x, n), x.powf(n), (x, n));
            }
            let near_one = 1.0 + 1e-4 * f64::from(step);
            assert_close(logarithm(x), x.ln(), (x, 0.0));
            assert_close(logarithm(near_one), near_one.ln(), (near_one, 0.0));
            let y = -0.1 * f64::from(step.abs());
            assert_close(exponential(y), y.exp(), (y, 0.0));
        }
    }

    #[test]
    fn limits() {
        assert_eq!([power(0.0, 0.26), power(0.0, 0.0), power(f64::INFINITY, 0.5)], [0.0, 1.0, f64::INFINITY]);
        assert_eq!([exponential(0.0), exponential(-1e3), exponential(f64::NEG_INFINITY)], [1.0, 0.0, 0.0]);
        assert_eq!([logarithm(0.0), logarithm(f64::INFINITY)], [f64::NEG_INFINITY, f64::INFINITY]);
        assert!(power(f64::NAN, 0.5).is_nan() && exponential(f64::NAN).is_nan());
        assert!(logarithm(f64::NAN).is_nan() && logarithm(-1.0).is_nan());
    }
}
