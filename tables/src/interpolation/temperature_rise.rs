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

/// Least exponent of V in a temperature rise. Where it is smaller the contact is close to melting: the rise hardly grows, and friction
/// falls. Chosen by tables cut to five slip rates, which 0.35 serves better than 0.25 and 0.45.
const LEAST_EXPONENT: f64 = 0.35;

/// The temperature rises at the slip rates as an axis, and the place of `rise` on it, which lies between the same points as
/// `rate`, with `coordinate` ξ of each slip rate. None on a point, and where the rises around it do not grow. `of` gives the
/// rise at a slip rate, if it is known.
pub(super) fn axis(
    rate: Location,
    rise: f64,
    coordinate: &[f64],
    of: impl Fn(usize) -> Option<f64>,
) -> Option<(Vec<f64>, Location)> {
    let Location { index, t } = rate;
    if t <= ROUNDING || t >= 1.0 - ROUNDING {
        return None;
    }
    let axis: Vec<f64> = (0..coordinate.len()).map(|j| of(j).unwrap_or(f64::NAN)).collect();
    let least = (LEAST_EXPONENT * (coordinate[index + 1] - coordinate[index])).exp();
    let around = &axis[index.saturating_sub(1)..(index + 3).min(axis.len())];
    let grows = axis[index + 1] > least * axis[index]
        && around.windows(2).all(|pair| pair[0].is_nan() || pair[1].is_nan() || pair[1] > pair[0]);
    let share = (rise - axis[index]) / (axis[index + 1] - axis[index]);
    (grows && (0.0..=1.0).contains(&share)).then_some((axis, Location { index, t: share }))
}

/// A number at a place on the axis, and its distance to a straight line.
pub(super) fn blend(
    axis: &[f64],
    Location { index, t }: Location,
    value: impl Fn(usize) -> Result<f64, Absent>,
) -> Result<(f64, f64), Absent> {
    let inner = [value(index)?, value(index + 1)?];
    let outer =
        neighbours(axis, index, |j| value(j).ok()).map(|near| near.filter(|(gap, _)| gap.is_finite()));
    let found = cubic(axis[index + 1] - axis[index], t, outer, inner);
    Ok((found, (found - (1.0 - t) * inner[0] - t * inner[1]).abs()))
}

/// As [`blend`], of the reciprocals of positive numbers.
pub(super) fn blend_reciprocals(
    axis: &[f64],
    place: Location,
    value: impl Fn(usize) -> Result<f64, Absent>,
) -> Result<(f64, f64), Absent> {
    let (reciprocal, bend) = blend(axis, place, |j| Ok(value(j)?.recip()))?;
    let found = reciprocal.recip();
    Ok((found, bend * found * found))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rises at rest and at three slip rates, the last of which grow with the exponents 0.5 and 0.2 of V.
    const COORDINATE: [f64; 4] = [0.0, 1.0, 3.0, 5.0];

    fn rises() -> [f64; 4] {
        [0.0, 10.0, 10.0 * 1f64.exp(), 10.0 * 1.4f64.exp()]
    }

    #[test]
    fn what_is_linear_in_the_rise_comes_back() {
        let rises = rises();
        for (index, rise) in [(0, 2.0), (1, 17.0)] {
            let rate = Location { index, t: 0.5 };
            let (axis, place) = axis(rate, rise, &COORDINATE, |j| Some(rises[j])).unwrap();
            let load = |rise: f64| 3.0 + 0.1 * rise;
            let (found, bend) = blend(&axis, place, |j| Ok(load(rises[j]))).unwrap();
            assert!((found / load(rise) - 1.0).abs() < 1e-12 && bend < 1e-12, "{found} {bend}");
            let coefficient = |j: usize| Ok(2.0 / load(rises[j]));
            let (found, bend) = blend_reciprocals(&axis, place, coefficient).unwrap();
            assert!((found * load(rise) / 2.0 - 1.0).abs() < 1e-12 && bend < 1e-12, "{found} {bend}");
        }
    }

    #[test]
    fn there_is_no_axis_where_the_rise_hardly_grows_or_is_outside() {
        let rises = rises();
        let of = |index: usize, t: f64, rise: f64| {
            axis(Location { index, t }, rise, &COORDINATE, |j| Some(rises[j])).is_some()
        };
        assert!(of(1, 0.5, 17.0) && !of(2, 0.5, 34.0), "exponents 0.5 and 0.2");
        assert!(!of(1, 0.0, 10.0) && !of(1, 0.5, 9.0), "a point, and a rise below it");
    }
}
