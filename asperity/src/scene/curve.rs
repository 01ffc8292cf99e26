//! Piecewise linear curves with their integrals and the inverse of these.

use tables::functions::{interpolate, points_up_to};

/// Piecewise linear function of x, constant beyond its ends. Two equal neighbouring abscissae make
/// a jump, at which the right-hand value holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    knots: Vec<f64>,
    values: Vec<f64>,
    /// ∫₀ of the curve, at the knots.
    integrals: Vec<f64>,
}

impl Curve {
    /// Through the points (knots, values); knots do not fall.
    pub fn new(mut knots: Vec<f64>, mut values: Vec<f64>) -> Self {
        assert!(knots.len() == values.len() && !knots.is_empty(), "a curve has points");
        // A knot at 0, so that integrals over however little from there have no rounding error of more.
        let after = knots.partition_point(|&knot| knot <= 0.0);
        if after == 0 || knots[after - 1] < 0.0 {
            let value = interpolate(&knots, &values, 0.0).0;
            knots.insert(after, 0.0);
            values.insert(after, value);
        }
        let mut integrals = vec![0.0];
        for i in 1..knots.len() {
            let area = 0.5 * (values[i - 1] + values[i]) * (knots[i] - knots[i - 1]);
            integrals.push(integrals[i - 1] + area);
        }
        let origin = integrals[knots.partition_point(|&knot| knot < 0.0)];
        integrals.iter_mut().for_each(|integral| *integral -= origin);
        Self { knots, values, integrals }
    }

    pub fn constant(value: f64) -> Self {
        Self::new(vec![0.0], vec![value])
    }

    pub fn value(&self, x: f64) -> f64 {
        interpolate(&self.knots, &self.values, x).0
    }

    /// ∫₀ˣ, reckoned from the end of the segment that is nearer to 0.
    pub fn integral(&self, x: f64) -> f64 {
        let after = points_up_to(&self.knots, x);
        let at = if x < 0.0 { after } else { after.saturating_sub(1) };
        let d = x - self.knots[at];
        self.integrals[at] + d * (self.values[at] + 0.5 * self.slope(after) * d)
    }

    /// The x at which ∫₀ˣ is `integral`; the curve must be positive.
    pub fn inverse_integral(&self, integral: f64) -> f64 {
        let after = points_up_to(&self.integrals, integral);
        let at = if integral < 0.0 { after } else { after.saturating_sub(1) };
        let (value, excess) = (self.values[at], integral - self.integrals[at]);
        let slope = self.slope(after);
        // The root of ½·slope·d² + value·d = excess in the form without cancellation.
        let discriminant = (value * value + 2.0 * slope * excess).max(0.0);
        self.knots[at] + 2.0 * excess / (value + discriminant.sqrt())
    }

    /// Between the knot `after` and the one before; 0 beyond the ends.
    fn slope(&self, after: usize) -> f64 {
        if after == 0 || after == self.knots.len() {
            return 0.0;
        }
        (self.values[after] - self.values[after - 1]) / (self.knots[after] - self.knots[after - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rise, a fall, a jump at 2 and constant ends.
    fn curve() -> Curve {
        Curve::new(vec![-1.0, 1.0, 2.0, 2.0, 5.0], vec![1.0, 3.0, 0.5, 4.0, 4.0])
    }

    #[test]
    fn integral_is_the_area_under_the_curve() {
        let curve = curve();
        assert_eq!(curve.integral(0.0), 0.0);
        // By hand: from 0 to 1 the mean is 2.5, from 1 to 2 it is 1.75, then 4.
        for (x, area) in [(1.0, 2.5), (2.0, 4.25), (3.0, 8.25), (7.0, 24.25), (-1.0, -1.5), (-3.0, -3.5)] {
            assert!((curve.integral(x) - area).abs() < 1e-14, "{x}");
        }
        assert_eq!((curve.value(2.0), curve.value(1.5), curve.value(-9.0)), (4.0, 1.75, 1.0));
    }

    #[test]
    fn small_integrals_are_as_exact_as_large_ones() {
        for knots in [vec![-70.0, 30.0], vec![-70.0, -30.0], vec![30.0, 70.0]] {
            let curve = Curve::new(knots, vec![1.0, 3.0]);
            for x in [1e-12, 1e-9, -1e-9] {
                let area = curve.integral(x);
                assert!((area / (x * curve.value(0.0)) - 1.0).abs() < 1e-9, "{x}");
                assert!((curve.inverse_integral(area) / x - 1.0).abs() < 1e-14, "{x}");
            }
        }
    }

    #[test]
    fn inverse_integral_undoes_the_integral() {
        for curve in [curve(), Curve::constant(0.3)] {
            for i in -400..800 {
                let x = 0.01 * i as f64 + 0.003;
                let back = curve.inverse_integral(curve.integral(x));
                assert!((back - x).abs() < 1e-13 * (1.0 + x.abs()), "{x} {back}");
            }
        }
    }
}
