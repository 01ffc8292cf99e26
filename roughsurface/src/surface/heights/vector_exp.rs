//! Exponentials of many numbers at once.
//!
//! Integrals over heights spend most of their time in exponentials, and the one of the C library
//! is called number by number. This one is a loop without branches, which the compiler turns
//! into vector instructions.

/// ln 2 in two parts: the first has so few digits that its product with an exponent is exact.
const LN2_HIGH: f64 = 0.693_147_180_369_123_8;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Added to a number it leaves the nearest integer in the last bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Below this eˣ is taken for zero, above for infinite: the ends of normal numbers.
const LOWEST: f64 = -708.0;
const HIGHEST: f64 = 709.0;

/// 1/n! from n = 13 down to 2; on |r| ≤ ln 2/2 the next term is 4e-18.
const SERIES: [f64; 12] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    1.0 / 2.0,
];

/// a·b + c, in one instruction where the machine has one: elsewhere it would be a call.
#[inline(always)]
fn multiply_add(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// x → eˣ in place, to two units in the last place.
pub(super) fn exp(values: &mut [f64]) {
    for value in values {
        let x = value.clamp(LOWEST, HIGHEST);
        let shifted = multiply_add(x, std::f64::consts::LOG2_E, ROUNDING);
        let exponent = shifted - ROUNDING;
        let r = multiply_add(exponent, -LN2_LOW, multiply_add(exponent, -LN2_HIGH, x));
        let tail = SERIES.iter().fold(0.0, |sum, term| multiply_add(sum, r, *term));
        let power_of_two = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
        let result = (1.0 + multiply_add(r * r, tail, r)) * power_of_two;
        *value = if *value < LOWEST {
            0.0
        } else if *value > HIGHEST {
            f64::INFINITY
        } else {
            result
        };
    }
}

#[cfg(test)]
mod tests {
    use super::exp;

    #[test]
    fn agrees_with_the_library_everywhere() {
        for step in -70_800..=70_900 {
            let x = f64::from(step) * 0.01;
            let mut here = [x];
            exp(&mut here);
            let library = x.exp();
            assert!((here[0] - library).abs() <= 4.5e-16 * library, "{x}: {} {library}", here[0]);
        }
    }

    #[test]
    fn ends_are_zero_and_infinite() {
        let mut ends = [f64::NEG_INFINITY, -709.0, 710.0, 0.0];
        exp(&mut ends);
        assert_eq!(ends, [0.0, 0.0, f64::INFINITY, 1.0]);
    }
}
