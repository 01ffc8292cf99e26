//! Extrapolation towards the fully plastic limit, above the last interference ω_n of a table.
//!
//! In the limit mean pressure and friction are constant: P, A and Q are in proportion to ω, a to √ω. The exponent m
//! of a quantity between the last two rows relaxes to that of the limit, m∞:
//!
//! d ln x/d ln ω = m∞ + d (ω_n/ω)^q,   ln(x/x_n) = m∞L + d (1 − e^{−qL})/q,   L = ln(ω/ω_n)
//!
//! with d = (m − m∞)·(ω_{n−1}/ω_n)^{q/2}, as m is the exponent in the middle of the last interval. Q/A keeps its
//! exponent, which is 0 without heat. The relative uncertainty is e^u − 1 with
//!
//! u = (|d|/4 + s + 2ω_c/ω_n)·(L − (1 − e^{−qL})/q) + g·(a − a_n)/R
//!
//! for an uncertainty s of m∞ and the effect g of the growth of the contact into the sphere, and u = |m|L for Q/A. The
//! relative error of the last row is multiplied by 1 + L/ln(ω_n/ω_{n−1}), as it enters the exponent. Data: rows of the
//! shipped tables from 37 and 100 ω_c, from those up to 14 and 37 ω_c, which a test of `shipped` compares;
//! and runs without and with heat at 200 ω_c (Ti-6Al-4V), 300 (6061, 4340), 500 (1045), 1000 (304), 3000 and
//! 5000 ω_c (copper), of whose scalars 98 % are within the errors of tables that end at 100 ω_c.

use super::nodes::{FIELDS, Field, Values};
use crate::quantity::ElasticLimit;

/// q. Exponents of load and area in six metals fall to the 0.75th to 0.85th of their distance from 1 between 37 and
/// 100 ω_c.
const RELAXATION: f64 = 0.25;

/// Share of |d| in the uncertainty.
const UNCERTAINTY_OF_RELAXATION: f64 = 0.25;

/// m∞, s and g of a quantity.
#[derive(Clone, Copy, Debug)]
struct Limit {
    exponent: f64,
    uncertainty: f64,
    geometry: f64,
}

/// The mean pressure falls by about 0.9 of the change of a/R in runs of six metals up to a/R = 0.34.
const LOAD: Limit = Limit { exponent: 1.0, uncertainty: 0.1, geometry: 1.0 };
const AREA: Limit = Limit { exponent: 1.0, uncertainty: 0.1, geometry: 0.2 };
const CONTACT_RADIUS: Limit = Limit { exponent: 0.5, uncertainty: 0.1, geometry: 0.1 };
const STATIC_COEFFICIENT: Limit = Limit { exponent: 0.0, uncertainty: 0.1, geometry: 1.0 };
/// Slip and energies, whose limit is not known: they grow faster than the contact radius.
const SLIP: Limit = Limit { exponent: 1.0, uncertainty: 0.5, geometry: 3.0 };
/// The exponent is ½ without softening, 0 at the melting temperature.
const RISE: Limit = Limit { exponent: 0.25, uncertainty: 0.25, geometry: 0.5 };

/// Added to s, over ω_c/ω_n: a contact of a few ω_c is far from the limit, the exponent of its area still rises.
const ELASTIC_CORE: f64 = 2.0;

/// Largest exponent of a load beyond its limit (Kogut & Etsion 2002, doi 10.1115/1.1490373), for a table of one row.
const EXPONENT_OF_ONE_ROW: f64 = 0.425;

/// An interference ω above the last row ω_n.
#[derive(Clone, Copy, Debug)]
pub(super) struct AboveLastRow {
    /// ω_n/ω_c.
    pub(super) last_row: f64,
    /// ln(ω_n/ω_{n−1}), if there are two rows.
    pub(super) gap: Option<f64>,
    /// L ≥ 0.
    pub(super) log_ratio: f64,
    /// (a − a_n)/R.
    pub(super) contact_growth: f64,
}

/// ln(x/x_n) and its uncertainty.
#[derive(Clone, Copy, Debug)]
pub(super) struct Growth {
    logarithm: f64,
    uncertainty: f64,
}

impl Growth {
    /// x/x_n.
    pub(super) fn factor(self) -> f64 {
        self.logarithm.exp()
    }

    /// Relative uncertainty of x.
    pub(super) fn relative(self) -> f64 {
        self.uncertainty.exp_m1()
    }

    fn times(self, other: Self) -> Self {
        Self {
            logarithm: self.logarithm + other.logarithm,
            uncertainty: self.uncertainty + other.uncertainty,
        }
    }

    fn inverse(self) -> Self {
        Self { logarithm: -self.logarithm, ..self }
    }
}

/// Values of a quantity in the row before the last, where it is known, and in the last.
pub(super) type LastRows = (Option<f64>, f64);

impl AboveLastRow {
    /// Factor of the relative errors of the last row.
    pub(super) fn error_factor(self) -> f64 {
        1.0 + self.gap.map_or(0.0, |gap| self.log_ratio / gap)
    }

    /// m.
    fn exponent(self, (before, last): LastRows) -> Option<f64> {
        let exponent = (last / before?).ln() / self.gap?;
        exponent.is_finite().then_some(exponent)
    }

    fn relaxed(self, limit: Limit, rows: LastRows) -> Growth {
        let relaxed = -(-RELAXATION * self.log_ratio).exp_m1() / RELAXATION;
        let uncertainty = limit.uncertainty + ELASTIC_CORE / self.last_row;
        let (difference, uncertainty) = match (self.exponent(rows), self.gap) {
            (Some(exponent), Some(gap)) => {
                ((exponent - limit.exponent) * (-0.5 * RELAXATION * gap).exp(), uncertainty)
            }
            _ => (0.0, uncertainty + EXPONENT_OF_ONE_ROW),
        };
        Growth {
            logarithm: limit.exponent * self.log_ratio + difference * relaxed,
            uncertainty: (UNCERTAINTY_OF_RELAXATION * difference.abs() + uncertainty)
                * (self.log_ratio - relaxed)
                + limit.geometry * self.contact_growth,
        }
    }

    fn of_load(self, rows: LastRows) -> Growth {
        self.relaxed(LOAD, rows)
    }

    /// Of A, and of Q at sliding inception.
    fn of_area(self, rows: LastRows) -> Growth {
        self.relaxed(AREA, rows)
    }

    pub(super) fn of_contact_radius(self, rows: LastRows) -> Growth {
        self.relaxed(CONTACT_RADIUS, rows)
    }

    /// Of Q, from Q and A.
    fn of_friction(self, friction: LastRows, area: LastRows) -> Growth {
        let ratio = |(before, last): LastRows, (area_before, area_last): LastRows| {
            (before.zip(area_before).map(|(friction, area)| friction / area), last / area_last)
        };
        let logarithm = self.exponent(ratio(friction, area)).unwrap_or(0.0) * self.log_ratio;
        self.of_area(area).times(Growth { logarithm, uncertainty: logarithm.abs() })
    }

    /// State above the last rows, whose states at the same s/a₀ are `before` and `last`, and its relative
    /// uncertainty.
    pub(super) fn state(self, before: Option<Values>, last: &Values) -> (Values, Values) {
        let rows = |field: Field| (before.map(|row| row[field as usize]), last[field as usize]);
        let mut values = *last;
        let mut uncertainty = [0.0; FIELDS];
        for (field, growth) in [
            (Field::Load, self.of_load(rows(Field::Load))),
            (Field::Area, self.of_area(rows(Field::Area))),
            (Field::Friction, self.of_friction(rows(Field::Friction), rows(Field::Area))),
            (Field::TemperatureRise, self.relaxed(RISE, rows(Field::TemperatureRise))),
        ] {
            values[field as usize] *= growth.factor();
            uncertainty[field as usize] = growth.relative();
        }
        (values, uncertainty)
    }

    /// Growth of a scalar of kind `limit` with the values `rows`; `load` and `area` are those of the slide.
    pub(super) fn of_scalar(
        self,
        limit: ElasticLimit,
        rows: LastRows,
        load: LastRows,
        area: LastRows,
    ) -> Growth {
        // Q, as the response has it.
        let friction = |friction: LastRows| self.of_friction(friction, area);
        match limit {
            ElasticLimit::Load => self.of_load(rows),
            ElasticLimit::Area | ElasticLimit::StaticFriction => self.of_area(rows),
            ElasticLimit::ContactRadius => self.of_contact_radius(rows),
            ElasticLimit::StaticCoefficient => self.relaxed(STATIC_COEFFICIENT, rows),
            ElasticLimit::SlidingFriction => friction(rows),
            ElasticLimit::SlidingCoefficient => {
                let force = (rows.0.zip(load.0).map(|(mu, load)| mu * load), rows.1 * load.1);
                friction(force).times(self.of_load(load).inverse())
            }
            ElasticLimit::InceptionSlip | ElasticLimit::EnergyRelease | ElasticLimit::Weakening => {
                self.relaxed(SLIP, rows)
            }
            ElasticLimit::TemperatureRise => self.relaxed(RISE, rows),
            ElasticLimit::None => Growth { logarithm: f64::NAN, uncertainty: f64::NAN },
        }
    }
}
