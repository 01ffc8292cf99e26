//! Numbers of the query: one, a list, or a range.

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt;
use tables::numbers::Spacing;

use crate::surface::units::Units;

/// Numbers of a key, as `1e6`, `[1e5, 1e6]`, or a range `{ from = 0.1, to = 10, points = 7, spacing = "log" }`; on
/// the command line as `1e6`, `1MPa`, `1e5,1e6`, `0.1..10` or `0.1..10:7`.
///
/// A range is logarithmic unless `spacing` is "linear" or `from` is not positive, and has
/// four points a decade, or eleven if it is linear, unless `points` is given; its ends belong to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(pub Vec<f64>);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PointRange {
    from: f64,
    to: f64,
    points: Option<usize>,
    spacing: Option<Spacing>,
}

/// More points than a figure shows or a table has.
const MOST_POINTS: usize = 1000;
const POINTS_PER_DECADE: f64 = 4.0;
const LINEAR_POINTS: usize = 11;

impl PointRange {
    fn values(&self) -> Result<Values, String> {
        let Self { from, to, points, spacing } = *self;
        if !(from.is_finite() && to.is_finite() && to > from) {
            return Err(format!("to = {to:?} must be above from = {from:?}, both finite"));
        }
        let usual = if from > 0.0 { Spacing::Log } else { Spacing::Linear };
        let spacing = spacing.unwrap_or(usual);
        if spacing == Spacing::Log && from <= 0.0 {
            return Err(format!("from = {from:?} must be positive if spacing = \"log\""));
        }
        let intervals = || ((POINTS_PER_DECADE * (to.log10() - from.log10())).ceil() as usize).max(1);
        let usual = if spacing == Spacing::Log { 1 + intervals() } else { LINEAR_POINTS };
        let points = points.unwrap_or(usual);
        if !(2..=MOST_POINTS).contains(&points) {
            return Err(match self.points {
                Some(points) => format!("points = {points} must be a number from 2 to {MOST_POINTS}"),
                None => format!(
                    "from {from:e} to {to:e} are too many points; give a number of points up to {MOST_POINTS}"
                ),
            });
        }
        Ok(Values(spacing.range(from, to, points)))
    }
}

impl Values {
    /// Numbers of the command line, all in SI units or each with its unit.
    pub fn parse(text: &str, units: &Units) -> Result<Self, String> {
        const FORM: &str = "must be numbers such as 1e6, 1e5,1e6 or a range 0.1..10 or 0.1..10:7 (points)";
        let Some((from, to)) = text.split_once("..") else {
            return units.numbers(&text.split(',').collect::<Vec<_>>(), FORM).map(Self);
        };
        let (to, points) = match to.split_once(':') {
            Some((to, points)) => (to, Some(points.trim().parse().map_err(|_| FORM.to_owned())?)),
            None => (to, None),
        };
        let ends = units.numbers(&[from, to], FORM)?;
        PointRange { from: ends[0], to: ends[1], points, spacing: None }.values()
    }
}

impl<'de> Deserialize<'de> for Values {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ValuesVisitor)
    }
}

struct ValuesVisitor;

impl<'de> Visitor<'de> for ValuesVisitor {
    type Value = Values;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a number, a list such as [1, 10] or a range such as { from = 1, to = 10 }")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Values, E> {
        Ok(Values(vec![value]))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Values, E> {
        Ok(Values(vec![value as f64]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Values, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Values)
    }

    fn visit_map<A: MapAccess<'de>>(self, range: A) -> Result<Values, A::Error> {
        PointRange::deserialize(MapAccessDeserializer::new(range))?.values().map_err(Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::units::{LENGTH, PRESSURE, SLIP_RATE};

    #[test]
    fn numbers_lists_and_ranges_of_the_command_line() {
        let read = |text: &str| Values::parse(text, &PRESSURE);
        let of = |text: &str| read(text).unwrap().0;
        assert_eq!(of("1e6"), [1e6]);
        assert_eq!(of("1e5, 1e6"), [1e5, 1e6]);
        let decades = of("0.1..10");
        assert_eq!((decades.len(), decades[0], decades[8]), (9, 0.1, 10.0));
        assert!((decades[4] - 1.0).abs() < 1e-12);
        assert_eq!(of("1..100:3"), [1.0, 10.0, 100.0]);
        assert_eq!(of("-1..1:3"), [-1.0, 0.0, 1.0]);
        assert_eq!(of("0..1").len(), 11);
        assert_eq!(of("1kPa, 2.3 MPa, 1.1e-2GPa"), [1e3, 2.3e6, 1.1e7]);
        assert_eq!(Values::parse("-0.1um, 5um", &LENGTH).unwrap().0, [-0.1e-6, 5e-6]);
        assert_eq!(Values::parse("9mm/s", &SLIP_RATE).unwrap().0, [9e-3]);
        for (text, units) in [("0.1..10MPa", &PRESSURE), ("0.1..10um", &LENGTH), ("1,5mm/s", &SLIP_RATE)] {
            assert!(Values::parse(text, units).unwrap_err().contains("behind each number"), "{text}");
        }
        assert_eq!(of("1MPa..100MPa:3"), [1e6, 1e7, 1e8]);
        for text in ["", "one", "1..", "10..1", "1..10:1", "1..10:x", "1,,2", "1..inf", "nan..1", "1um"] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
