//! Kink of `G` along interference where a contact that sticks first flows plastically.
//!
//! The slope of ln G against ln ω changes there, and an interval that contains the kink shows it neither by the slopes at its ends
//! nor by the prediction of its points from others.
//!
//! - Chosen: the change of slope as a bound.
//! - Data: shipped tables cut to four interferences, 0.4 to 4 ω_c in one interval: `G` off by 8 to 27 %, which are changes of slope of 0.2 to 0.5;
//!   0.2 to 2 ω_c: 13 to 37 %, 0.25 to 0.7; 0.7 to 2 ω_c: 5 to 14 %.

use super::steffen::Location;

/// ω/ω_c.
const FIRST_YIELD: f64 = 0.9;
const CHANGE_OF_SLOPE: f64 = 0.6;

/// Bound, relative to the value, of the error of `G` by a kink in the interval of a place on the axis ln ω.
pub(super) fn kink(log_interference: &[f64], Location { index, t }: Location) -> f64 {
    let Some(&to) = log_interference.get(index + 1) else { return 0.0 };
    let [before, after] = around(log_interference[index], to);
    CHANGE_OF_SLOPE * (t * after).min((1.0 - t) * before)
}

/// The largest such bound between two ln ω.
pub(crate) fn largest_kink(from: f64, to: f64) -> f64 {
    let [before, after] = around(from, to);
    if to > from { CHANGE_OF_SLOPE * before * after / (to - from) } else { 0.0 }
}

/// Distances of the kink from the ends of an interval; zero where it is outside.
fn around(from: f64, to: f64) -> [f64; 2] {
    let distances = [FIRST_YIELD.ln() - from, to - FIRST_YIELD.ln()];
    if distances.iter().all(|distance| *distance > 0.0) { distances } else { [0.0; 2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_is_largest_at_the_kink_and_zero_at_the_points() {
        let axis = [0.4, 4.0, 40.0].map(f64::ln);
        let at = |omega: f64| {
            let index = usize::from(omega >= 4.0);
            let t = (omega.ln() - axis[index]) / (axis[index + 1] - axis[index]);
            kink(&axis, Location { index, t })
        };
        assert_eq!([at(0.4), at(4.0), at(10.0)], [0.0; 3]);
        let largest = largest_kink(axis[0], axis[1]);
        assert!((at(FIRST_YIELD) / largest - 1.0).abs() < 1e-12 && largest > 0.25, "{largest}");
        assert!(at(0.6) < largest && at(2.0) < largest);
        assert_eq!(largest_kink(axis[1], axis[2]), 0.0);
    }
}
