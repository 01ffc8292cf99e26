//! Interferences at which a quantity takes a value.

/// Interferences, in ω_c, between which they are looked for.
const LOWEST: f64 = 1e-9;
const HIGHEST: f64 = 1e6;

/// Interferences at which the positive `quantity` equals `value`, between `breaks` at which it may
/// jump; `steps` is the number of intervals between breaks that are searched for a change of sign.
pub(super) fn where_equal(
    quantity: impl Fn(f64) -> f64,
    value: f64,
    breaks: &[f64],
    steps: usize,
) -> Vec<f64> {
    let excess = |ln_interference: f64| (quantity(ln_interference.exp()) / value).ln();
    let mut ends = vec![LOWEST.ln()];
    ends.extend(breaks.iter().map(|place| place.ln()));
    ends.push(HIGHEST.ln());
    let mut found = Vec::new();
    for piece in ends.windows(2) {
        // A law that jumps at a break has there the value of one side.
        let (from, to) = (piece[0] + 1e-9, piece[1] - 1e-9);
        let place = |i: usize| from + (to - from) * i as f64 / steps as f64;
        let mut low = (place(0), excess(place(0)));
        for i in 1..=steps {
            let high = (place(i), excess(place(i)));
            if (low.1 > 0.0) != (high.1 > 0.0) {
                found.push(sign_change(excess, low, high).exp());
            }
            low = high;
        }
    }
    found
}

/// Where a function changes its sign between two places with its values there: regula falsi with
/// the weight of the end that stays halved.
fn sign_change(function: impl Fn(f64) -> f64, mut low: (f64, f64), mut high: (f64, f64)) -> f64 {
    let (mut weight_low, mut weight_high) = (low.1, high.1);
    for _ in 0..100 {
        if high.0 - low.0 <= 1e-13 * high.0.abs().max(1.0) {
            break;
        }
        let secant = low.0 + (high.0 - low.0) * weight_low / (weight_low - weight_high);
        // The logarithm of 0 is infinite.
        let next = if secant > low.0 && secant < high.0 { secant } else { 0.5 * (low.0 + high.0) };
        let value = function(next);
        if value == 0.0 {
            return next;
        }
        if (value > 0.0) == (low.1 > 0.0) {
            low = (next, value);
            weight_low = value;
            weight_high *= 0.5;
        } else {
            high = (next, value);
            weight_high = value;
            weight_low *= 0.5;
        }
    }
    0.5 * (low.0 + high.0)
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
