//! Interpolation along the slip rate, in the temperature rise.
//!
//! The slip rate changes a contact through its heat. Load, area and friction are nearly linear in the temperature rise: thermal
//! expansion is in proportion to it, softening nearly so. Along V they have the shape of the rise, which is in proportion to
//! V at rest and to its root at large Péclet numbers. So the rise is interpolated along V (see `low_rates` and `nodes`), and
//! the others by a monotone cubic in the rise; of Q/P its reciprocal, which is as linear as the load.
//!
//! Without heat, and with a rate law, by which V changes more than the heat, values are interpolated in ξ(V).

use super::ROUNDING;
use super::nodes::{Absent, cubic, neighbours};
use super::steffen::Location;

/// Exponents of V in a temperature rise between which its share as a coordinate grows from 0 to 1. Where the exponent is small the contact
/// is close to melting: the rise hardly grows, and friction falls. Chosen by tables cut to five slip rates.
const EXPONENTS: [f64; 2] = [0.25, 0.45];

/// The temperature rises at the slip rates, and a place among them.
pub(super) struct RiseAxis {
    rises: Vec<f64>,
    place: Location,
    /// Of the value that is interpolated in the rise; the rest is that in ξ. It is continuous at the points, as the slopes are then.
    share: f64,
}

impl RiseAxis {
    /// The place of `rise`, between the same points as `rate`, with `coordinate` ξ of each slip rate. None on a
    /// point, and where the rise does not grow. `of` gives the rise at a slip rate, if it is known.
    pub(super) fn new(
        rate: Location,
        rise: f64,
        coordinate: &[f64],
        of: impl Fn(usize) -> Option<f64>,
    ) -> Option<Self> {
        let Location { index, t } = rate;
        if t <= ROUNDING || t >= 1.0 - ROUNDING {
            return None;
        }
        let rises: Vec<f64> = (0..coordinate.len()).map(|j| of(j).unwrap_or(f64::NAN)).collect();
        let exponent = |j: usize| match rises.get(j..j + 2) {
            Some([one, other]) => (other / one).ln() / (coordinate[j + 1] - coordinate[j]),
            _ => f64::NAN,
        };
        let share_at = |j: usize| {
            let both = [j.checked_sub(1).map_or(f64::NAN, exponent), exponent(j)];
            // None beside an interval in which the rise falls, and which it cannot be the coordinate of.
            if both.iter().any(|exponent| *exponent <= 0.0) {
                return 0.0;
            }
            ((both[0].max(both[1]) - EXPONENTS[0]) / (EXPONENTS[1] - EXPONENTS[0])).clamp(0.0, 1.0)
        };
        let share = (1.0 - t) * share_at(index) + t * share_at(index + 1);
        let t = ((rise - rises[index]) / (rises[index + 1] - rises[index])).clamp(0.0, 1.0);
        (rises[index + 1] > rises[index] && share > 0.0).then_some(Self {
            rises,
            place: Location { index, t },
            share,
        })
    }

    /// A number there, and its distance to a straight line, from those in ξ.
    pub(super) fn blend(
        &self,
        of_rate: (f64, f64),
        value: impl Fn(usize) -> Result<f64, Absent>,
    ) -> Result<(f64, f64), Absent> {
        let of_rise = blend(&self.rises, self.place, value)?;
        Ok(self.shared(of_rise, of_rate))
    }

    /// As [`blend`](Self::blend), of the reciprocals of positive numbers.
    pub(super) fn blend_reciprocals(
        &self,
        of_rate: (f64, f64),
        value: impl Fn(usize) -> Result<f64, Absent>,
    ) -> Result<(f64, f64), Absent> {
        let (reciprocal, bend) = blend(&self.rises, self.place, |j| Ok(value(j)?.recip()))?;
        let found = reciprocal.recip();
        Ok(self.shared((found, bend * found * found), of_rate))
    }

    fn shared(&self, of_rise: (f64, f64), of_rate: (f64, f64)) -> (f64, f64) {
        let mean = |one: f64, other: f64| self.share * one + (1.0 - self.share) * other;
        (mean(of_rise.0, of_rate.0), mean(of_rise.1, of_rate.1))
    }
}

/// A number at a place on an axis, and its distance to a straight line.
fn blend(
    axis: &[f64],
    Location { index, t }: Location,
    value: impl Fn(usize) -> Result<f64, Absent>,
) -> Result<(f64, f64), Absent> {
    let inner = [value(index)?, value(index + 1)?];
    let outer = neighbours(axis, index, |j| value(j).ok())
        .map(|near| near.filter(|(gap, _)| *gap > 0.0 && gap.is_finite()));
    let found = cubic(axis[index + 1] - axis[index], t, outer, inner);
    Ok((found, (found - (1.0 - t) * inner[0] - t * inner[1]).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ξ of rest and of three slip rates, after which the rise grows with the exponents 0.5 and 0.2 of V.
    const COORDINATE: [f64; 4] = [0.0, 1.0, 3.0, 5.0];

    fn rises() -> [f64; 4] {
        [0.0, 10.0, 10.0 * 1f64.exp(), 10.0 * 1.4f64.exp()]
    }

    fn axis(index: usize, t: f64, rise: f64) -> Option<RiseAxis> {
        let rises = rises();
        RiseAxis::new(Location { index, t }, rise, &COORDINATE, |j| Some(rises[j]))
    }

    #[test]
    fn what_is_linear_in_the_rise_comes_back() {
        let (rises, no_share) = (rises(), (f64::NAN, f64::NAN));
        for (index, rise) in [(0, 2.0), (1, 17.0)] {
            let axis = axis(index, 0.5, rise).unwrap();
            assert_eq!(axis.share, 1.0);
            let axis = RiseAxis { share: 1.0, ..axis };
            let load = |rise: f64| 3.0 + 0.1 * rise;
            let (found, bend) = blend(&axis.rises, axis.place, |j| Ok(load(rises[j]))).unwrap();
            assert!((found / load(rise) - 1.0).abs() < 1e-12 && bend < 1e-12, "{found} {bend}");
            let of_rate = (5.0, 0.0);
            let (found, bend) = axis.blend_reciprocals(of_rate, |j| Ok(2.0 / load(rises[j]))).unwrap();
            assert!((found * load(rise) / 2.0 - 1.0).abs() < 1e-12 && bend < 1e-12, "{found} {bend}");
            assert!(axis.blend(no_share, |j| Ok(load(rises[j]))).unwrap().0.is_nan(), "both are asked for");
        }
    }

    /// Its share is 1 up to the point after which the exponent is 0.2, and falls to 0 at the next.
    #[test]
    fn the_rise_is_no_coordinate_where_it_hardly_grows() {
        let share = |index: usize, t: f64, rise: f64| axis(index, t, rise).map(|axis| axis.share);
        assert_eq!(share(1, 0.9, 25.0), Some(1.0));
        assert!((share(2, 0.25, 30.0).unwrap() - 0.75).abs() < 1e-12);
        assert_eq!(share(1, 0.0, 10.0), None, "a point");
        assert_eq!(axis(1, 0.5, 9.0).unwrap().place.t, 0.0, "a rise below the interval");
    }
}
