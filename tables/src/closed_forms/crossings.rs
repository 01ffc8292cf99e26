//! Interferences at which a quantity takes a value.

use crate::functions::bisect;

/// Interferences, in ω_c, between which they are looked for.
const LOWEST: f64 = 1e-9;
const HIGHEST: f64 = 1e6;
/// To the rounding of a logarithm.
const HALVINGS: usize = 55;

/// Interferences at which `quantity` equals `value`, between `breaks` at which it may
/// jump; `steps` is the number of intervals between breaks that are searched for a change of sign.
pub(super) fn where_equal(
    quantity: impl Fn(f64) -> f64,
    value: f64,
    breaks: &[f64],
    steps: usize,
) -> Vec<f64> {
    let exceeds = |logarithm: f64| quantity(logarithm.exp()) > value;
    let mut ends = vec![LOWEST.ln()];
    ends.extend(breaks.iter().map(|place| place.ln()));
    ends.push(HIGHEST.ln());
    let mut found = Vec::new();
    for piece in ends.windows(2) {
        // A law that jumps at a break has there the value of one side.
        let (from, to) = (piece[0] + 1e-9, piece[1] - 1e-9);
        let place = |i: usize| from + (to - from) * i as f64 / steps as f64;
        let mut low = place(0);
        for high in (1..=steps).map(place) {
            let at_low = exceeds(low);
            if at_low != exceeds(high) {
                let [before, after] = bisect([low, high], HALVINGS, |middle| exceeds(middle) == at_low);
                found.push((0.5 * (before + after)).exp());
            }
            low = high;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_and_turns_and_jumps() {
        let close = |found: Vec<f64>, expected: &[f64]| {
            assert_eq!(found.len(), expected.len(), "{found:?}");
            for (found, expected) in found.iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-11, "{found} {expected}");
            }
        };
        close(where_equal(|x| 3.0 * x.sqrt(), 6.0, &[], 1), &[4.0]);
        // x/(1 + x²) = 0.3 at 1/3 and 3.
        close(where_equal(|x| x / (1.0 + x * x), 0.3, &[1.0], 8), &[1.0 / 3.0, 3.0]);
        // None above a break.
        close(where_equal(|x| if x < 2.0 { x } else { 0.0 }, 1.5, &[2.0], 8), &[1.5]);
        close(where_equal(|x| x, 1e9, &[], 8), &[]);
    }
}
