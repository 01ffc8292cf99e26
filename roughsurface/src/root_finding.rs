//! Roots in a bracket, by Brent's method.

use roots::{Convergency, find_root_brent};

/// Halving alone reaches any accuracy of double precision in some sixty steps.
const MOST_STEPS: usize = 200;

/// Tolerances of a root.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accuracy {
    /// Largest magnitude of the function at the root.
    pub value: f64,
    /// Width of the bracket below which it is not halved.
    pub width: f64,
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
pub(crate) fn root_between<E>(
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
pub(crate) fn root_of(
    from: f64,
    to: f64,
    mut accuracy: Accuracy,
    function: impl Fn(f64) -> f64,
) -> Option<f64> {
    find_root_brent(from, to, function, &mut accuracy).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

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
