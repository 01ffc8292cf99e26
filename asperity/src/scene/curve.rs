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
    /// Slope before each knot and beyond the last one; 0 beyond the ends.
    slopes: Vec<f64>,
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
        let inner = (1..knots.len()).map(|i| (values[i] - values[i - 1]) / (knots[i] - knots[i - 1]));
        let slopes = std::iter::once(0.0).chain(inner).chain([0.0]).collect();
        Self { knots, values, integrals, slopes }
    }

    pub fn constant(value: f64) -> Self {
        Self::new(vec![0.0], vec![value])
    }

    /// This curve with knots also wherever `other` has them: a point of one curve is then valid on the other.
    pub fn with_knots_of(&self, other: &Self) -> Self {
        let (mut knots, mut values) = (self.knots.clone(), self.values.clone());
        for (i, &x) in other.knots.iter().enumerate() {
            let equal_before = i - other.knots.partition_point(|&knot| knot < x);
            let [first, after] = [knots.partition_point(|&knot| knot < x), points_up_to(&knots, x)];
            if after - first <= equal_before {
                knots.insert(after, x);
                values.insert(after, self.value(x));
            }
        }
        Self::new(knots, values)
    }

    pub fn value(&self, x: f64) -> f64 {
        self.at(&self.point(x)).0
    }

    /// ∫₀ˣ.
    pub fn integral(&self, x: f64) -> f64 {
        self.at(&self.point(x)).1
    }

    /// The x at which ∫₀ˣ is `integral`; the curve must be positive.
    pub fn inverse_integral(&self, integral: f64) -> f64 {
        self.abscissa(&self.point_of_integral(integral))
    }

    fn point(&self, x: f64) -> CurvePoint {
        let point = CurvePoint::new(points_up_to(&self.knots, x), x < 0.0);
        CurvePoint { distance: x - self.knots[point.knot], ..point }
    }

    /// Point at which ∫₀ˣ is `integral`; the curve must be positive.
    #[inline]
    pub fn point_of_integral(&self, integral: f64) -> CurvePoint {
        let point = CurvePoint::new(points_up_to(&self.integrals, integral), integral < 0.0);
        let (value, excess) = (self.values[point.knot], integral - self.integrals[point.knot]);
        // The root of ½·slope·d² + value·d = excess in the form without cancellation.
        let discriminant = (value * value + 2.0 * self.slopes[point.after] * excess).max(0.0);
        CurvePoint { distance: 2.0 * excess / (value + discriminant.sqrt()), ..point }
    }

    #[inline]
    pub fn abscissa(&self, point: &CurvePoint) -> f64 {
        self.knots[point.knot] + point.distance
    }

    /// Value and ∫₀ˣ.
    #[inline]
    pub fn at(&self, point: &CurvePoint) -> (f64, f64) {
        let (knot, d, slope) = (point.knot, point.distance, self.slopes[point.after]);
        let value = self.values[knot];
        (value + slope * d, self.integrals[knot] + d * (value + 0.5 * slope * d))
    }
}

/// Point of a curve: its segment and the distance from one of its ends.
pub struct CurvePoint {
    /// Number of knots up to it.
    after: usize,
    /// End of its segment that is nearer to 0.
    knot: usize,
    /// Distance from that knot.
    distance: f64,
}

impl CurvePoint {
    fn new(after: usize, is_negative: bool) -> Self {
        let knot = if is_negative { after } else { after.saturating_sub(1) };
        Self { after, knot, distance: 0.0 }
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

    /// Knots of another curve change no value: where both have a jump, where one has it and where neither has.
    #[test]
    fn knots_of_another_curve_change_no_value() {
        let (one, other) =
            (curve(), Curve::new(vec![-3.0, 1.0, 1.0, 2.0, 2.0, 4.0], vec![2.0, 1.0, 5.0, 3.0, 1.0, 7.0]));
        let pair = [one.with_knots_of(&other), other.with_knots_of(&one)];
        assert_eq!(pair[0].knots, [-3.0, -1.0, 0.0, 1.0, 1.0, 2.0, 2.0, 4.0, 5.0]);
        assert_eq!(pair[0].knots, pair[1].knots);
        for i in -400..700 {
            let x = 0.01 * i as f64;
            let integral = one.integral(x);
            let point = pair[0].point_of_integral(integral);
            for (pair, alone) in pair.iter().zip([&one, &other]) {
                assert!((pair.value(x) - alone.value(x)).abs() < 1e-13, "{x}");
                assert!((pair.at(&point).1 - alone.integral(x)).abs() < 1e-12, "{x}");
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
