//! Cubic interpolation that keeps monotone data monotone.
//!
//! M. Steffen, *A simple method for monotonic interpolation in one dimension*,
//! Astron. Astrophys. 239, 443 (1990): a piecewise cubic with continuous slope, without
//! overshoot, third-order accurate where the data are smooth and monotone; extrema stay at
//! data points.

/// Slope at an inner point with intervals h₀, h₁ and secants d₀, d₁ to its left and right.
pub fn inner_slope(h0: f64, h1: f64, d0: f64, d1: f64) -> f64 {
    if d0 * d1 <= 0.0 {
        return 0.0;
    }
    let parabola = (d0 * h1 + d1 * h0) / (h0 + h1);
    let smallest = d0.abs().min(d1.abs()).min(0.5 * parabola.abs());
    2.0 * smallest.copysign(d0)
}

/// Slope at an end point whose own interval is h₀ with secant d₀, the next one h₁ with d₁.
pub fn end_slope(h0: f64, h1: f64, d0: f64, d1: f64) -> f64 {
    let share = h0 / (h0 + h1);
    let parabola = d0 * (1.0 + share) - d1 * share;
    if parabola * d0 <= 0.0 {
        0.0
    } else if parabola.abs() > 2.0 * d0.abs() {
        2.0 * d0
    } else {
        parabola
    }
}

/// Cubic over an interval of length h from (y₀, slope m₀) to (y₁, m₁) at the fraction t.
pub fn hermite(h: f64, t: f64, y0: f64, y1: f64, m0: f64, m1: f64) -> f64 {
    let rest = 1.0 - t;
    let bend = rest * (m0 * h - (y1 - y0)) + t * ((y1 - y0) - m1 * h);
    rest * y0 + t * y1 + t * rest * bend
}

/// Slopes at all points; zero for a single one.
pub fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    if n < 2 {
        return vec![0.0; n];
    }
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let d: Vec<f64> = (y.windows(2).zip(&h)).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();
    if n == 2 {
        return vec![d[0]; 2];
    }
    let mut slopes = vec![end_slope(h[0], h[1], d[0], d[1])];
    slopes.extend((1..n - 1).map(|i| inner_slope(h[i - 1], h[i], d[i - 1], d[i])));
    slopes.push(end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]));
    slopes
}

/// Position of a value on an axis: between the points `index` and `index + 1`, at the fraction
/// `t` of the way; `t` is 0 or 1 outside the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location {
    /// Number of the point below.
    pub index: usize,
    /// Fraction of the way to the next point.
    pub t: f64,
}

impl Location {
    /// On a point.
    pub fn on(index: usize) -> Self {
        Self { index, t: 0.0 }
    }

    /// The nearest point.
    pub fn nearest(self) -> usize {
        self.index + usize::from(self.t > 0.5)
    }
}

/// Finds `at` on the strictly increasing axis `x`; NaN, as from the radius of a missing cell, is put between the first
/// two points.
pub fn locate(x: &[f64], at: f64) -> Location {
    if x.len() < 2 || at <= x[0] {
        return Location::on(0);
    }
    let index = x.partition_point(|point| *point <= at).saturating_sub(1).min(x.len() - 2);
    let t = ((at - x[index]) / (x[index + 1] - x[index])).min(1.0);
    Location { index, t }
}

/// Interpolant through given points, held constant beyond both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Steffen {
    x: Vec<f64>,
    y: Vec<f64>,
    slopes: Vec<f64>,
}

impl Steffen {
    /// Through (x, y), x strictly increasing. Panics if there are no points or their numbers
    /// differ.
    pub fn new(x: Vec<f64>, y: Vec<f64>) -> Self {
        assert!(!x.is_empty() && x.len() == y.len());
        let slopes = slopes(&x, &y);
        Self { x, y, slopes }
    }

    /// Value at one abscissa.
    pub fn value(&self, at: f64) -> f64 {
        let Location { index, t } = locate(&self.x, at);
        if self.x.len() == 1 {
            return self.y[0];
        }
        hermite(
            self.x[index + 1] - self.x[index],
            t,
            self.y[index],
            self.y[index + 1],
            self.slopes[index],
            self.slopes[index + 1],
        )
    }

    /// Values at several abscissae, for example a history of a run on the slip axis of a table.
    pub fn resample(&self, at: &[f64]) -> Vec<f64> {
        at.iter().map(|at| self.value(*at)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_has_an_index_on_the_axis() {
        assert_eq!(locate(&[0.0, 1.0, 2.0], f64::NAN).index, 0);
    }

    #[test]
    fn exact_for_straight_lines_and_held_beyond() {
        let line = Steffen::new(vec![0.0, 1.0, 3.0, 3.5], vec![1.0, 3.0, 7.0, 8.0]);
        for at in [0.0, 0.3, 1.0, 2.9, 3.5] {
            assert!((line.value(at) - (1.0 + 2.0 * at)).abs() < 1e-14);
        }
        assert_eq!(line.value(-1.0), 1.0);
        assert_eq!(line.value(9.0), 8.0);
    }

    #[test]
    fn monotone_data_stay_monotone() {
        let y = vec![0.0, 0.01, 5.0, 5.0, 5.001, 40.0];
        let x = vec![0.0, 1.0, 1.2, 4.0, 5.0, 5.1];
        let curve = Steffen::new(x, y);
        let mut last = 0.0;
        for step in 0..=5100 {
            let value = curve.value(step as f64 * 1e-3);
            assert!(value >= last - 1e-13, "{step}");
            last = value;
        }
    }

    #[test]
    fn third_order_where_smooth() {
        let error = |n: usize| {
            let x: Vec<f64> = (0..=n).map(|i| i as f64 / n as f64).collect();
            let y = x.iter().map(|x| x.exp()).collect();
            let curve = Steffen::new(x, y);
            (0..1000).map(|i| i as f64 / 1000.0).map(|x| (curve.value(x) - x.exp()).abs()).fold(0.0, f64::max)
        };
        let order = (error(16) / error(32)).log2();
        assert!(order > 2.8, "{order}");
    }
}
