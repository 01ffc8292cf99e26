//! Functions of one number: bisection, linear interpolation.

use std::convert::Infallible;

/// Halves a bracket at whose start a condition holds and at whose end it does not.
pub fn bisect(bracket: [f64; 2], halvings: usize, mut holds: impl FnMut(f64) -> bool) -> [f64; 2] {
    let Ok(bracket) = try_bisect(bracket, halvings, |middle| Ok::<_, Infallible>(holds(middle)));
    bracket
}

/// Halves a bracket as [`bisect`] does, for a condition whose evaluation may fail.
pub fn try_bisect<E>(
    [mut start, mut end]: [f64; 2],
    halvings: usize,
    mut holds: impl FnMut(f64) -> Result<bool, E>,
) -> Result<[f64; 2], E> {
    for _ in 0..halvings {
        let middle = 0.5 * (start + end);
        if holds(middle)? { start = middle } else { end = middle }
    }
    Ok([start, end])
}

/// Number of the first points that do not exceed x, counted, as x is mostly among the first.
#[inline]
pub fn points_up_to(points: &[f64], x: f64) -> usize {
    points.iter().take_while(|&&point| point <= x).count()
}

/// Value and slope at x of the piecewise linear function through the points, constant beyond them.
#[inline]
pub fn interpolate(knots: &[f64], values: &[f64], x: f64) -> (f64, f64) {
    let after = points_up_to(knots, x);
    if after == 0 {
        return (values[0], 0.0);
    }
    if after == knots.len() {
        return (values[after - 1], 0.0);
    }
    let slope = (values[after] - values[after - 1]) / (knots[after] - knots[after - 1]);
    (values[after - 1] + slope * (x - knots[after - 1]), slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_are_halved_in_either_direction() {
        for bracket in [[1.0, 2.0], [2.0, 1.0]] {
            let rises = bracket[1] > bracket[0];
            let [start, end] = bisect(bracket, 50, |x| (x * x < 2.0) == rises);
            assert!((0.5 * (start + end) - 2f64.sqrt()).abs() < 1e-15);
        }
        assert_eq!(try_bisect([0.0, 1.0], 3, |x| if x > 0.6 { Err(x) } else { Ok(true) }), Err(0.75));
    }
}
