//! Range of an axis, its ticks and their labels.

use super::Axis;

/// Intervals between labelled ticks to aim at.
const INTERVALS: f64 = 5.0;

/// Labelled decades at most.
const DECADES: i32 = 7;

/// The values that an axis shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub from: f64,
    pub to: f64,
    pub log: bool,
}

/// Ticks with labels, and those between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    pub labelled: Vec<(f64, String)>,
    pub minor: Vec<f64>,
    /// Power of ten by which the labels are multiplied.
    pub exponent: i32,
}

impl Range {
    /// The range of an axis, by default that of the values and a little more.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let log = axis.log;
        let ends = |(from, to): (f64, f64), value: f64| (from.min(value), to.max(value));
        let nothing = (f64::INFINITY, f64::NEG_INFINITY);
        let (from, to) = axis.ends.unwrap_or_else(|| {
            values.filter(|value| value.is_finite() && (*value > 0.0 || !log)).fold(nothing, ends)
        });
        let (from, to) = match (axis.ends.is_some(), log) {
            _ if from > to => (if log { 0.1 } else { 0.0 }, 1.0),
            (true, _) => (from, to),
            (false, true) => {
                let margin = (to / from).powf(0.04).max(1.1);
                (from / margin, to * margin)
            }
            (false, false) => rounded(from, to),
        };
        Self { from, to, log }
    }

    /// 0 at the beginning of the axis, 1 at its end.
    pub fn place(&self, value: f64) -> f64 {
        match self.log {
            true => (value / self.from).ln() / (self.to / self.from).ln(),
            false => (value - self.from) / (self.to - self.from),
        }
    }

    fn holds(&self, value: f64) -> bool {
        let rounding = 1e-9;
        (-rounding..=1.0 + rounding).contains(&self.place(value))
    }

    pub fn ticks(&self) -> Ticks {
        let (first, last) = (self.from.log10().ceil() as i32, self.to.log10().floor() as i32);
        match self.log {
            true if last > first => self.decades(first, last),
            true if self.to / self.from > 3.0 => self.within_decades(first - 1, last),
            _ => self.linear(),
        }
    }

    /// Labels at powers of ten.
    fn decades(&self, first: i32, last: i32) -> Ticks {
        let step = (last - first) / DECADES + 1;
        let labelled = (first..=last).filter(|n| n % step == 0);
        let minor: Vec<f64> = match step {
            1 => (first - 1..=last).flat_map(|n| (2..10).map(move |m| f64::from(m) * power(n))).collect(),
            _ => (first..=last).filter(|n| n % step != 0).map(power).collect(),
        };
        Ticks {
            labelled: labelled.map(|n| (power(n), format!("10^{{{}}}", signed(&n.to_string())))).collect(),
            minor: minor.into_iter().filter(|value| self.holds(*value)).collect(),
            exponent: 0,
        }
    }

    /// Labels at 1, 2 and 5 times powers of ten.
    fn within_decades(&self, first: i32, last: i32) -> Ticks {
        let all = (first..=last).flat_map(|n| (1..10).map(move |m| (m, n, f64::from(m) * power(n))));
        let (labelled, minor): (Vec<_>, Vec<_>) =
            all.filter(|(_, _, value)| self.holds(*value)).partition(|(m, _, _)| [1, 2, 5].contains(m));
        let label = |(m, n, value): (i32, i32, f64)| match n {
            -3..=3 => (value, format!("{}", (value * 1e6).round() / 1e6)),
            _ => (value, format!("{m}·10^{{{}}}", signed(&n.to_string()))),
        };
        Ticks {
            labelled: labelled.into_iter().map(label).collect(),
            minor: minor.into_iter().map(|(_, _, value)| value).collect(),
            exponent: 0,
        }
    }

    fn linear(&self) -> Ticks {
        let (step, parts) = steps(self.to - self.from);
        let minor = step / parts;
        let all = (self.from / minor - 1e-6).ceil() as i64..=(self.to / minor + 1e-6).floor() as i64;
        let (labelled, minor_ticks): (Vec<i64>, Vec<i64>) = all.partition(|n| n % parts as i64 == 0);
        let largest = self.from.abs().max(self.to.abs());
        let exponent = match largest {
            1e-3..1e5 => 0,
            _ => largest.log10().floor() as i32,
        };
        let digits = (exponent as f64 - step.log10() - 1e-9).ceil().max(0.0) as usize;
        let label = |n: i64| {
            let value = n as f64 * minor;
            (value, signed(&format!("{:.digits$}", value / power(exponent) + 0.0)))
        };
        Ticks {
            labelled: labelled.into_iter().map(label).collect(),
            minor: minor_ticks.into_iter().map(|n| n as f64 * minor).collect(),
            exponent,
        }
    }
}

/// Distance of the labels of a linear axis of this length, and its number of parts.
pub(super) fn steps(length: f64) -> (f64, f64) {
    let aim = length / INTERVALS;
    let power = 10f64.powf((aim.log10() + 1e-9).floor());
    [(1.0, 5.0), (2.0, 4.0), (5.0, 5.0), (10.0, 5.0)]
        .map(|(digit, parts)| (digit * power, parts))
        .into_iter()
        .find(|(step, _)| *step >= 0.7 * aim)
        .unwrap_or((aim, 1.0))
}

/// A linear range that ends at ticks, and includes zero where that is not far.
fn rounded(from: f64, to: f64) -> (f64, f64) {
    const NEAR_ZERO: f64 = 0.5;
    let (from, to) = match (from, to) {
        (from, to) if to - from <= 1e-3 * from.abs().max(to.abs()) => {
            let margin = if from == 0.0 && to == 0.0 { 1.0 } else { 0.05 * from.abs().max(to.abs()) };
            (from - margin, to + margin)
        }
        (from, to) if from > 0.0 && from < NEAR_ZERO * to => (0.0, to),
        (from, to) if to < 0.0 && to > NEAR_ZERO * from => (from, 0.0),
        ends => ends,
    };
    let (step, parts) = steps(to - from);
    let minor = step / parts;
    // Markers at the ends are not on the frame, except at zero.
    let margin = |end: f64| if end == 0.0 { 0.0 } else { 0.02 * (to - from) };
    (((from - margin(from)) / minor).floor() * minor, ((to + margin(to)) / minor).ceil() * minor)
}

fn power(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

/// A number with the sign of mathematics.
pub(super) fn signed(number: &str) -> String {
    number.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(from: f64, to: f64, log: bool) -> Vec<String> {
        Range { from, to, log }.ticks().labelled.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_have_equal_digits() {
        assert_eq!(labels(0.0, 0.3, false), ["0.00", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30"]);
        assert_eq!(labels(-1.0, 1.0, false), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels(0.0165, 0.0275, false), ["0.018", "0.020", "0.022", "0.024", "0.026"]);
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten_and_their_multiples_between() {
        assert_eq!(labels(0.09, 110.0, true), ["10^{−1}", "10^{0}", "10^{1}", "10^{2}"]);
        let ticks = Range { from: 0.09, to: 110.0, log: true }.ticks();
        assert_eq!(ticks.minor.len(), 1 + 3 * 8);
        assert_eq!(labels(0.8, 9.0, true), ["1", "2", "5"]);
        assert_eq!(labels(0.8e7, 9.0e7, true), ["1·10^{7}", "2·10^{7}", "5·10^{7}"]);
        assert_eq!(labels(1e-19, 1e-2, true).len(), 6);
    }

    #[test]
    fn large_and_small_numbers_share_a_power_of_ten() {
        let ticks = Range { from: 0.0, to: 4e-9, log: false }.ticks();
        assert_eq!((ticks.exponent, ticks.labelled[1].1.as_str()), (-9, "1"));
    }

    #[test]
    fn ranges_hold_the_values_and_zero_where_that_is_near() {
        let range = |values: &[f64], log| {
            let range = Range::new(&Axis { log, ..Axis::default() }, values.iter().copied());
            (range.from, range.to)
        };
        assert_eq!(range(&[0.1, 0.29], false), (0.0, 0.3));
        let (from, to) = range(&[0.1, 10.0, f64::NAN, -1.0], true);
        assert!(0.08 < from && from < 0.1 && 10.0 < to && to < 12.5);
        // No values, and one.
        assert_eq!(range(&[], false), (0.0, 1.0));
        let (from, to) = range(&[300.0], false);
        assert!(from < 300.0 && 300.0 < to);
        // Far below one: no limit of the smallest value (powers of waves are of 10⁻²⁰ m²).
        let (from, to) = range(&[1e-22, 1e-18], true);
        assert!(from > 0.5e-22 && to < 2e-18);
    }
}
