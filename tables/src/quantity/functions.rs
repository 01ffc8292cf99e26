//! Functions of one number: bisection, roots in a bracket by Brent's method, linear interpolation.

use std::convert::Infallible;

use roots::{Convergency, find_root_brent};

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

/// Halving alone reaches any accuracy of double precision in some sixty steps.
const MOST_STEPS: usize = 200;

/// Tolerances of a root.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Largest magnitude of the function at the root.
    pub value: f64,
    /// Width of the bracket below which it is not halved.
    pub width: f64,
}

impl Accuracy {
    /// The same number for both.
    pub const fn of(tolerance: f64) -> Self {
        Self { value: tolerance, width: tolerance }
    }
}

impl Convergency<f64> for Accuracy {
    fn is_root_found(&mut self, value: f64) -> bool {
        value.abs() <= self.value
    }
    fn is_converged(&mut self, one: f64, other: f64) -> bool {
        (one - other).abs() <= self.width
    }
    fn is_iteration_limit_reached(&mut self, steps: usize) -> bool {
        steps >= MOST_STEPS
    }
}

/// A root of `function` between `from` and `to`; none without a change of sign, unless the function is within its
/// tolerance at an end. An error of the function ends the search.
pub fn root_between<E>(
    from: f64,
    to: f64,
    mut accuracy: Accuracy,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    let mut failure = None;
    // The library evaluates the ends of the bracket again.
    let mut known: Vec<(f64, f64)> = Vec::new();
    let value = |x: f64| {
        if let Some((_, value)) = known.iter().rev().find(|(place, _)| *place == x) {
            return *value;
        }
        let value = function(x).unwrap_or_else(|error| {
            failure = Some(error);
            0.0
        });
        known.push((x, value));
        value
    };
    let found = find_root_brent(from, to, value, &mut accuracy);
    let at_end = || known.iter().find(|(_, value)| accuracy.is_root_found(*value)).map(|(place, _)| *place);
    match failure {
        Some(error) => Err(error),
        None => Ok(found.ok().or_else(at_end)),
    }
}

/// Root of a function that cannot fail, between `from` and `to`, see [`root_between`].
pub fn root_of(from: f64, to: f64, mut accuracy: Accuracy, function: impl Fn(f64) -> f64) -> Option<f64> {
    find_root_brent(from, to, function, &mut accuracy).ok()
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

    #[test]
    fn roots_errors_and_missing_changes_of_sign() {
        let accuracy = Accuracy { value: 0.0, width: 1e-15 };
        let root = |from, to, f: fn(f64) -> Result<f64, &'static str>| root_between(from, to, accuracy, f);
        assert!((root(0.0, 2.0, |x| Ok(x * x - 2.0)).unwrap().unwrap() - 2f64.sqrt()).abs() < 1e-14);
        // A step, and a function that is almost infinite on one side.
        assert!(
            (root(0.0, 1.0, |x| Ok(if x < 0.3 { 1e3 } else { -1.0 })).unwrap().unwrap() - 0.3).abs() < 1e-14
        );
        assert_eq!(root(0.0, 1.0, |x| Ok(x + 1.0)), Ok(None));
        // No change of sign by rounding.
        let accuracy = Accuracy { value: 1e-3, width: 1e-15 };
        let found = root_between(0.0, 1.0, accuracy, |x| Ok::<_, ()>(if x < 1.0 { -1.0 } else { -1e-9 }));
        assert_eq!(found, Ok(Some(1.0)));
        assert_eq!(
            root(0.0, 1.0, |x| if x > 0.2 { Err("out of range") } else { Ok(-1.0) }),
            Err("out of range")
        );
    }
}
