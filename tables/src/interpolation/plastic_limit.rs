//! Extrapolation towards the fully plastic limit, above the last interference ω_n of a table.
//!
//! The exponent m of a quantity between the last two rows relaxes to a limit m∞, and the contact grows into the sphere:
//!
//! d ln x/d ln ω = m∞ + d (ω_n/ω)^q + g da₀/(R d ln ω),   ln(x/x_n) = m∞L + dλ + g (a₀ − a_n)/R
//!
//! with L = ln(ω/ω_n), λ = (1 − e^{−qL})/q, and d = (m − m∞)·(ω_{n−1}/ω_n)^{q/2}, as m is the exponent in the middle of
//! the last interval. Q/A keeps its exponent, which is 0 without heat. The relative uncertainty is e^u − 1 with
//!
//! u = (s + 1.2ω_c/ω_n)·(L − λ) + k·(a₀ − a_n)/R,   of Q/A u = 0.32|m|L + k·(a₀ − a_n)/R.
//!
//! The relative error of the last row is multiplied by 1 + λ/(2 ln(ω_n/ω_{n−1})), as half of it enters the exponent:
//! errors of neighbouring rows mostly have the same sign.
//!
//! m∞ and g were fitted to rows of tables of the six metals (slides over two contact radii) from 37 ω_c on, seen from
//! those below, and to runs at 200 ω_c
//! (Ti-6Al-4V), 300 (6061, 4340), 500 (1045), 1000 and 2500 (304) and 3000 ω_c (copper), with and without heat. A metal
//! that is left out of the fit is predicted within 2.1 % (P, root mean square), 2.3 % (A) and 4 % (μ). s and k of P,
//! `Q_static`, Q/A and G were chosen from the rows of the shipped tables, which a test of `shipped` compares.

use super::nodes::{COEFFICIENT, Errors, StateQuantity, Values};
use crate::quantity::ElasticLimit;

/// q, of L − λ in all uncertainties too.
const RELAXATION: f64 = 0.25;

/// How a quantity grows.
#[derive(Clone, Copy, Debug)]
struct Limit {
    /// m∞.
    exponent: f64,
    /// q.
    relaxation: f64,
    /// g.
    geometry: f64,
    /// s.
    uncertainty: f64,
    /// k.
    uncertainty_of_geometry: f64,
    /// Largest m.
    steepest: f64,
}

const fn limit(exponent: f64, geometry: f64, uncertainty: [f64; 2]) -> Limit {
    let [uncertainty, uncertainty_of_geometry] = uncertainty;
    Limit {
        exponent,
        relaxation: RELAXATION,
        geometry,
        uncertainty,
        uncertainty_of_geometry,
        steepest: f64::INFINITY,
    }
}

/// The mean pressure rises by hardening, without which m∞ is 1, and falls as the contact becomes large against the
/// sphere.
const LOAD: Limit = limit(1.1, -1.1, [0.1, 0.35]);
const LOAD_PRESS: Limit = limit(1.1, -0.7, [0.1, 0.2]);
const AREA: Limit = limit(1.0, -0.1, [0.05, 0.1]);
const STATIC_FRICTION: Limit = limit(1.0, -0.2, [0.025, 0.2]);
const CONTACT_RADIUS: Limit = limit(0.5, 0.0, [0.05, 0.1]);
const STATIC_COEFFICIENT: Limit = limit(-0.1, 0.8, [0.1, 0.3]);
const INCEPTION_SLIP: Limit = limit(0.75, -0.3, [0.2, 0.5]);
const ENERGY: Limit = limit(0.9, -1.2, [0.73, 0.8]);
/// The rise is bounded by melting. That of a source of constant strength grows with √ω at most, in proportion to the contact
/// radius, and hardening adds to it; where the row before the last has hardly begun to slide, rows differ by many orders.
const RISE: Limit = Limit { relaxation: 0.07, steepest: 1.0, ..limit(0.0, 0.0, [0.3, 0.2]) };

/// u of Q/A over |m|L, and k.
const UNCERTAINTY_OF_STRENGTH: f64 = 0.32;
const STRENGTH_IN_LARGE_CONTACTS: f64 = 0.1;

/// k of Q/P, whose s is that of P.
const COEFFICIENT_IN_LARGE_CONTACTS: f64 = 0.3;

/// Added to s, over ω_c/ω_n: a contact of a few ω_c is far from the limit, the exponent of its area still rises.
const ELASTIC_CORE: f64 = 1.2;

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
    /// λ.
    fn relaxed_logarithm(self, relaxation: f64) -> f64 {
        -(-relaxation * self.log_ratio).exp_m1() / relaxation
    }

    /// L − λ.
    fn departure(self) -> f64 {
        self.log_ratio - self.relaxed_logarithm(RELAXATION)
    }

    /// Factor of the relative errors of the last row.
    pub(super) fn error_factor(self) -> f64 {
        1.0 + self.gap.map_or(0.0, |gap| 0.5 * self.relaxed_logarithm(RELAXATION) / gap)
    }

    /// m.
    fn exponent(self, (before, last): LastRows) -> Option<f64> {
        let exponent = (last / before?).ln() / self.gap?;
        exponent.is_finite().then_some(exponent)
    }

    fn relaxed(self, limit: Limit, rows: LastRows) -> Growth {
        let relaxed = self.relaxed_logarithm(limit.relaxation);
        let (difference, unknown) = match (self.exponent(rows), self.gap) {
            (Some(exponent), Some(gap)) => {
                ((exponent.min(limit.steepest) - limit.exponent) * (-0.5 * limit.relaxation * gap).exp(), 0.0)
            }
            _ => (0.0, EXPONENT_OF_ONE_ROW),
        };
        Growth {
            logarithm: limit.exponent * self.log_ratio
                + difference * relaxed
                + limit.geometry * self.contact_growth,
            uncertainty: self.uncertainty(limit.uncertainty, limit.uncertainty_of_geometry)
                + unknown * relaxed,
        }
    }

    fn uncertainty(self, of_exponent: f64, of_geometry: f64) -> f64 {
        (of_exponent + ELASTIC_CORE / self.last_row) * self.departure() + of_geometry * self.contact_growth
    }

    pub(super) fn of_contact_radius(self, rows: LastRows) -> Growth {
        self.relaxed(CONTACT_RADIUS, rows)
    }

    /// Growth of Q/A, from Q and A.
    fn of_strength(self, friction: LastRows, area: LastRows) -> Growth {
        let before = friction.0.zip(area.0).map(|(friction, area)| friction / area);
        let exponent = self.exponent((before, friction.1 / area.1)).unwrap_or(0.0);
        let logarithm = exponent * self.log_ratio;
        let uncertainty = UNCERTAINTY_OF_STRENGTH * logarithm.abs()
            + STRENGTH_IN_LARGE_CONTACTS * self.contact_growth.max(0.0);
        Growth { logarithm: logarithm - STRENGTH_IN_LARGE_CONTACTS * self.contact_growth, uncertainty }
    }

    /// Growth of Q, from Q and A.
    fn of_friction(self, friction: LastRows, area: LastRows) -> Growth {
        self.of_strength(friction, area).times(self.relaxed(AREA, area))
    }

    /// Growth of Q/P, from Q, A and P.
    fn of_coefficient(self, friction: LastRows, area: LastRows, load: LastRows) -> Growth {
        let growth = self.of_friction(friction, area).times(self.relaxed(LOAD, load).inverse());
        let thermal = self.of_strength(friction, area).uncertainty;
        let cold = self.uncertainty(LOAD.uncertainty, COEFFICIENT_IN_LARGE_CONTACTS);
        Growth { uncertainty: growth.uncertainty.min(thermal + cold), ..growth }
    }

    /// State above the last rows, whose states at the same s/a₀ are `before` and `last`, and its relative
    /// uncertainty.
    pub(super) fn state(self, before: Option<Values>, last: &Values) -> (Values, Errors) {
        let rows = |field: StateQuantity| (before.map(|row| row[field as usize]), last[field as usize]);
        let [load, area, friction] =
            [StateQuantity::Load, StateQuantity::Area, StateQuantity::Friction].map(rows);
        let mut values = *last;
        let mut uncertainty = Errors::default();
        for (field, growth) in [
            (StateQuantity::Load, self.relaxed(LOAD, load)),
            (StateQuantity::Area, self.relaxed(AREA, area)),
            (StateQuantity::Friction, self.of_friction(friction, area)),
            (StateQuantity::TemperatureRise, self.relaxed(RISE, rows(StateQuantity::TemperatureRise))),
        ] {
            values[field as usize] *= growth.factor();
            uncertainty[field as usize] = growth.relative();
        }
        uncertainty[COEFFICIENT] = self.of_coefficient(friction, area, load).relative();
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
        match limit {
            ElasticLimit::LoadPress => self.relaxed(LOAD_PRESS, rows),
            ElasticLimit::Load => self.relaxed(LOAD, rows),
            ElasticLimit::Area | ElasticLimit::AreaPress => self.relaxed(AREA, rows),
            ElasticLimit::StaticFriction => self.relaxed(STATIC_FRICTION, rows),
            ElasticLimit::ContactRadius => self.of_contact_radius(rows),
            ElasticLimit::StaticCoefficient => self.relaxed(STATIC_COEFFICIENT, rows),
            ElasticLimit::SlidingFriction => self.of_friction(rows, area),
            ElasticLimit::SlidingCoefficient => {
                let force = (rows.0.zip(load.0).map(|(mu, load)| mu * load), rows.1 * load.1);
                self.of_coefficient(force, area, load)
            }
            ElasticLimit::InceptionSlip => self.relaxed(INCEPTION_SLIP, rows),
            ElasticLimit::EnergyRelease | ElasticLimit::Weakening => self.relaxed(ENERGY, rows),
            ElasticLimit::TemperatureRise => self.relaxed(RISE, rows),
            ElasticLimit::FirstRow => Growth { logarithm: 0.0, ..self.relaxed(RISE, rows) },
            ElasticLimit::None => Growth { logarithm: f64::NAN, uncertainty: f64::NAN },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Just after inception: a row that slides above one that hardly does.
    #[test]
    fn a_rise_grows_at_most_in_proportion_to_the_interference() {
        let above = AboveLastRow { last_row: 1700.0, gap: Some(0.5), log_ratio: 1.5, contact_growth: 0.1 };
        let growth = above.relaxed(RISE, (Some(1e-12), 0.1));
        assert!(growth.factor() <= 1.5f64.exp() && growth.relative() < 1.0, "{growth:?}");
        // An ordinary one: exponent 0.5, λ = 1.4239.
        let growth = above.relaxed(RISE, (Some(1.0), 0.25f64.exp()));
        assert!((growth.logarithm - 0.5 * (-0.0175f64).exp() * 1.42393).abs() < 1e-4, "{growth:?}");
    }
}
