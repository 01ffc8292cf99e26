//! The interpolant of a slice: nodes, coordinates, the elastic and the fully plastic limit.

use super::ROUNDING;
use super::hertz_limit::{BelowFirstRow, ElasticSphere, HeatRatio, extrapolated};
use super::low_rates::{self, RiseFactor};
use super::nodes::{self, Absent, Errors, Nodes, OF_STRAIGHT, StateQuantity, Values, blend, rate_coordinate};
use super::plastic_limit::AboveLastRow;
use super::steffen::{self, Location, locate};
use super::temperature_rise::RiseAxis;
use crate::functions::{Accuracy, root_of};
use crate::law::{LARGEST_CONTACT, covers};
use crate::quantity::{COVERAGE_FACTOR, OF_BOUND};
use crate::table::{Axes, Slice};

/// Interpolates the fields of the response.
#[derive(Clone, Debug)]
pub(super) struct Interpolant {
    pub(super) log_interference: Vec<f64>,
    pub(super) slip_rate: Vec<f64>,
    /// ξ of each slip rate.
    pub(super) rate_coordinate: Vec<f64>,
    pub(super) nodes: Nodes,
    /// Rows of the first and last interference with any result.
    pub(super) rows: Option<(usize, usize)>,
    /// ln a₀ of each row, a₀ in m; NaN for rows without results.
    pub(super) log_contact_radius: Vec<f64>,
    /// Slopes of `log_contact_radius` against ln ω.
    pub(super) log_contact_radius_slope: Vec<f64>,
    pub(super) sphere: ElasticSphere,
    /// ln ω at which the contact radius is the largest that the sphere allows, at least that of the last row.
    pub(super) log_end: f64,
}

const FRICTION: usize = StateQuantity::Friction as usize;
const RISE: usize = StateQuantity::TemperatureRise as usize;

/// Share of the histories from whose state to the last one their trend is taken.
const TREND: f64 = 0.5;

/// Largest exponent of the slip in it: a temperature rise grows with its root at most, that of
/// a plane under constant heat.
const STEEPEST: f64 = 0.5;

/// Relative change of each field and of Q/P from the end of the histories to `farther` times their last slip, with the
/// exponent of their last part.
fn continued(earlier: &Values, last: &Values, farther: f64) -> Errors {
    let [earlier, last] = [earlier, last].map(nodes::with_coefficient);
    std::array::from_fn(|field| {
        let exponent = (last[field] / earlier[field]).ln().abs() / -TREND.ln();
        if exponent.is_nan() { 0.0 } else { (exponent.min(STEEPEST) * farther.ln()).exp_m1() }
    })
}

/// Position of an interference among the rows.
pub(super) enum RowPosition {
    Below(BelowFirstRow),
    Inside(Location),
    Above(AboveLastRow),
}

impl Interpolant {
    pub(super) fn new(table: &Slice) -> Self {
        let slip_rate = table.axes().slip_rate.clone();
        let [log_interference, rate_coordinate] = coordinates(table.axes());
        let nodes = Nodes::new(table, &log_interference);
        let filled = |i: &usize| (0..slip_rate.len()).any(|j| nodes.is_present(*i, j));
        let rows = 0..log_interference.len();
        let first = rows.clone().find(filled);
        let last = rows.rev().find(filled);
        let log_contact_radius = nodes::log_contact_radii(table);
        let mut interpolant = Self {
            rows: first.zip(last),
            log_contact_radius_slope: steffen::slopes(&log_interference, &log_contact_radius),
            log_contact_radius,
            sphere: ElasticSphere::new(table.metadata()),
            log_end: log_interference[last.unwrap_or(0)],
            log_interference,
            slip_rate,
            rate_coordinate,
            nodes,
        };
        let largest = LARGEST_CONTACT * table.metadata().asperity_radius;
        if let Some(end) = interpolant.log_interference_of(largest) {
            interpolant.log_end = interpolant.log_end.max(end);
        }
        interpolant
    }

    /// State of a row at a slip rate and slip.
    fn row(&self, i: usize, rate: Location, slip: Location) -> Result<Values, Absent> {
        let state = |j: usize| self.nodes.state(i, j, slip).ok_or((i, j));
        let mut values = blend(&self.rate_coordinate, rate, state)?;
        if let Some(low_rate) = self.rise_factor_after(i, rate, slip) {
            let first = state(1)?;
            values[RISE] = first[RISE] * rate.t * low_rate.factor * values[FRICTION] / first[FRICTION];
        }
        let rise = |j: usize| Some(state(j).ok()?[RISE]);
        if let Some(axis) = self.rise_axis(rate, values[RISE], rise) {
            for field in (0..values.len()).filter(|field| *field != RISE) {
                (values[field], _) = axis.blend((values[field], 0.0), |j| Ok(state(j)?[field]))?;
            }
        }
        Ok(values)
    }

    /// The place of a `rise` on the axis of the temperature rises; none where values are interpolated in ξ alone.
    pub(super) fn rise_axis(
        &self,
        rate: Location,
        rise: f64,
        of: impl Fn(usize) -> Option<f64>,
    ) -> Option<RiseAxis> {
        let follows_heat = !self.sphere.has_rate_law();
        follows_heat.then(|| RiseAxis::new(rate, rise, &self.rate_coordinate, of))?
    }

    /// Relative error at a place inside the rows: that of the nodes, and that of a temperature rise at a low slip rate, unless those of
    /// the points include it.
    fn relative_error(&self, place: Location, rate: Location, slip: Location) -> Errors {
        let mut error = self.nodes.relative_error(place, rate, slip);
        let low_rate = self.rise_factor_after(place.nearest(), rate, slip);
        if let Some(low_rate) = low_rate.filter(|_| !self.nodes.errors_include_interpolation()) {
            error[RISE] = error[RISE].hypot(COVERAGE_FACTOR * OF_BOUND * OF_STRAIGHT * low_rate.bend);
        }
        error
    }

    /// Ratio of a temperature rise to one in proportion to QV, in row `i` below the first positive slip rate; none elsewhere, and
    /// where there is no friction or no rise. `of` gives rise and friction force in a row at a slip rate, by their numbers.
    pub(super) fn rise_factor(
        &self,
        i: usize,
        rate: Location,
        of: impl Fn(usize, usize) -> Option<[f64; 2]>,
    ) -> Option<RiseFactor> {
        let is_below = rate.index == 0 && rate.t > 0.0 && rate.t < 1.0 && self.slip_rate[0] == 0.0;
        let (first, _) = self.rows.filter(|_| is_below)?;
        low_rates::rise_factor(rate.t, &self.slip_rate, [first, i], |i, j| {
            let [rise, friction] = of(i, j)?;
            let n = rise * self.log_contact_radius[i].exp() / (friction * self.slip_rate[j]);
            (n > 0.0 && n.is_finite()).then_some(n)
        })
    }

    /// [`rise_factor`](Self::rise_factor) of the highest temperature after a slip.
    fn rise_factor_after(&self, i: usize, rate: Location, slip: Location) -> Option<RiseFactor> {
        self.rise_factor(i, rate, |i, j| {
            let state = self.nodes.state(i, j, slip)?;
            Some([state[RISE], state[FRICTION]])
        })
    }

    /// a₀ between the rows, m.
    fn contact_radius_between(&self, Location { index, t }: Location) -> f64 {
        let (y, slope) = (&self.log_contact_radius, &self.log_contact_radius_slope);
        // On a row the neighbouring rows have no weight and may be absent.
        if t == 0.0 || t == 1.0 {
            return y[index + usize::from(t == 1.0)].exp();
        }
        let h = self.log_interference[index + 1] - self.log_interference[index];
        let one_sided = |slope: f64| match slope.is_nan() {
            true => (y[index + 1] - y[index]) / h,
            false => slope,
        };
        let (start, end) = (one_sided(slope[index]), one_sided(slope[index + 1]));
        steffen::hermite(h, t, y[index], y[index + 1], start, end).exp()
    }

    /// ξ of a slip rate at the radius of the table.
    pub(super) fn locate_rate(&self, slip_rate: f64) -> Option<Location> {
        let (first, last) = (self.slip_rate[0], *self.slip_rate.last()?);
        if !covers((first, last), slip_rate) {
            return None;
        }
        let at = rate_coordinate(&self.slip_rate, slip_rate.clamp(first, last));
        Some(locate(&self.rate_coordinate, at))
    }

    /// The slip rate (m/s) there, for the strain rate.
    pub(super) fn slip_rate_at(&self, Location { index, t }: Location) -> f64 {
        match self.slip_rate[index..] {
            [0.0, next, ..] => t * next,
            [here, next, ..] if t > 0.0 => here.powf(1.0 - t) * next.powf(t),
            [here, ..] => here,
            [] => 0.0,
        }
    }

    /// State and relative errors at the radius of the table.
    ///
    /// After the last slip of the histories it is that of their end; what it may change until a given slip is an error.
    pub(super) fn state(
        &self,
        interference: f64,
        rate: Location,
        slip: f64,
    ) -> Result<(Values, Errors), Absent> {
        let rows = self.rows.ok_or((0, 0))?;
        let place = self.row_position_with_results(rows, interference.ln(), rate)?;
        let ratio = slip / self.contact_radius(rows, &place);
        let (values, mut error) = self.state_at(rows, &place, rate, ratio)?;
        let farther = ratio / self.nodes.last_slip();
        if farther > 1.0 && farther.is_finite() {
            let (earlier, _) = self.state_at(rows, &place, rate, TREND * self.nodes.last_slip())?;
            let missing = continued(&earlier, &values, farther);
            error.iter_mut().zip(missing).for_each(|(error, missing)| *error += missing);
        }
        Ok((values, error))
    }

    /// State at a slip of `ratio` contact radii, as the histories have it, with its relative errors.
    fn state_at(
        &self,
        (first, last): (usize, usize),
        place: &RowPosition,
        rate: Location,
        ratio: f64,
    ) -> Result<(Values, Errors), Absent> {
        let slip = self.nodes.locate_slip(ratio);
        let (at, factor, (values, uncertainty)) = match *place {
            RowPosition::Below(below) => {
                let row = self.row(first, rate, slip)?;
                let heat = [StateQuantity::Load, StateQuantity::Area].map(|field| {
                    self.heat_ratio(
                        (first, last),
                        field == StateQuantity::Load,
                        |i, rate| Some(self.row(i, rate, slip).ok()?[field as usize]),
                        rate,
                    )
                });
                (
                    Location::on(first),
                    1.0,
                    self.sphere.state_below(below, (ratio, self.slip_rate_at(rate)), &row, heat),
                )
            }
            RowPosition::Inside(place) => {
                let values = blend(&self.log_interference, place, |i| self.row(i, rate, slip))?;
                (place, 1.0, (values, Errors::default()))
            }
            RowPosition::Above(above) => {
                let before = last.checked_sub(1).and_then(|before| self.row(before, rate, slip).ok());
                (Location::on(last), above.error_factor(), above.state(before, &self.row(last, rate, slip)?))
            }
        };
        let mut error = self.relative_error(at, rate, slip);
        for (error, uncertainty) in error.iter_mut().zip(uncertainty) {
            *error = factor * *error + uncertainty;
        }
        Ok((values, error))
    }

    /// Effect of heat on load or area in the first of the rows, from a function that gives it in a row at a slip rate; of
    /// the load `grows` as ω decreases.
    pub(super) fn heat_ratio(
        &self,
        (first, last): (usize, usize),
        grows: bool,
        of: impl Fn(usize, Location) -> Option<f64>,
        rate: Location,
    ) -> HeatRatio {
        let pair = |i: usize| Some([of(i, rate)?, of(i, Location::on(0))?]);
        let Some(here) = pair(first) else { return HeatRatio::NONE };
        match pair(first + 1).filter(|_| grows && first < last) {
            Some(second) => {
                let log_ratio = self.log_interference[first + 1] - self.log_interference[first];
                HeatRatio::power(here, second, log_ratio)
            }
            None => HeatRatio::constant(here),
        }
    }

    /// Position of an interference below, between or above the `rows` with results.
    pub(super) fn row_position(&self, (first, last): (usize, usize), log_interference: f64) -> RowPosition {
        let rows = &self.log_interference;
        if log_interference < rows[first] {
            let (first_row, log_ratio) = (rows[first].exp(), log_interference - rows[first]);
            return RowPosition::Below(BelowFirstRow { first_row, log_ratio });
        }
        if log_interference <= rows[last] + ROUNDING {
            return RowPosition::Inside(locate(rows, log_interference.min(rows[last])));
        }
        let gap = last.checked_sub(1).map(|before| rows[last] - rows[before]);
        let log_ratio = log_interference - rows[last];
        let above = AboveLastRow { last_row: rows[last].exp(), gap, log_ratio, contact_growth: 0.0 };
        let growth = self.contact_radius_above(last, above) - self.log_contact_radius[last].exp();
        RowPosition::Above(AboveLastRow { contact_growth: growth / self.sphere.radius, ..above })
    }

    /// Position of an interference as by [`row_position`](Self::row_position); absent beyond rows at the edge of the table that
    /// have no results: a table is extrapolated from its first and last row.
    pub(super) fn row_position_with_results(
        &self,
        rows @ (first, last): (usize, usize),
        log_interference: f64,
        rate: Location,
    ) -> Result<RowPosition, Absent> {
        let column = rate.nearest();
        match self.row_position(rows, log_interference) {
            RowPosition::Below(_) if first > 0 => Err((first - 1, column)),
            RowPosition::Above(_) if last + 1 < self.log_interference.len() => Err((last + 1, column)),
            place => Ok(place),
        }
    }

    /// a₀, m.
    pub(super) fn contact_radius(&self, (first, last): (usize, usize), place: &RowPosition) -> f64 {
        let of_row = |row: usize| self.log_contact_radius[row].exp();
        match *place {
            RowPosition::Below(below) => extrapolated(
                self.sphere.contact_radius(below.interference()),
                self.sphere.contact_radius(below.first_row),
                of_row(first),
                below.press_weight(),
            ),
            RowPosition::Inside(place) => self.contact_radius_between(place),
            RowPosition::Above(above) => self.contact_radius_above(last, above),
        }
    }

    fn contact_radius_above(&self, last: usize, above: AboveLastRow) -> f64 {
        let of_row = |row: usize| self.log_contact_radius[row].exp();
        let rows = (last.checked_sub(1).map(of_row), of_row(last));
        rows.1 * above.of_contact_radius(rows).factor()
    }

    /// ln ω at which a₀ is `wanted` (m).
    fn log_interference_of(&self, wanted: f64) -> Option<f64> {
        let rows @ (first, last) = self.rows?;
        if wanted <= 0.0 {
            return None;
        }
        // a₀ grows with ω; far outside the table as its root.
        let (low, high) = (self.log_interference[first] - 40.0, self.log_interference[last] + 40.0);
        let excess = |place: f64| (self.contact_radius(rows, &self.row_position(rows, place)) / wanted).ln();
        root_of(low, high, Accuracy::of(1e-13), excess)
    }

    /// ω/ω_c at which the slip `slip` (m), at the radius of the table, is the last of the histories.
    pub(super) fn end_of_histories(&self, slip: f64) -> Option<f64> {
        let end = self.log_interference_of(slip / self.nodes.last_slip())?;
        (end < self.log_end).then(|| end.exp())
    }

    /// The interpolant at one slip rate, with a single column.
    pub(super) fn at_rate(&self, rate: Location) -> Self {
        Self {
            log_interference: self.log_interference.clone(),
            slip_rate: vec![0.0],
            rate_coordinate: vec![0.0],
            nodes: self.nodes.at_rate(
                rate,
                |i, slip| self.row(i, rate, slip).ok(),
                |i, slip| self.relative_error(Location::on(i), rate, slip),
            ),
            rows: self.rows,
            log_contact_radius: self.log_contact_radius.clone(),
            log_contact_radius_slope: self.log_contact_radius_slope.clone(),
            sphere: self.sphere,
            log_end: self.log_end,
        }
    }
}

/// Coordinates in which is interpolated: ln ω, and ξ of the slip rates.
pub(crate) fn coordinates(axes: &Axes) -> [Vec<f64>; 2] {
    let rates = &axes.slip_rate;
    let rate = rates.iter().map(|rate| rate_coordinate(rates, *rate)).collect();
    [axes.interference.iter().map(|omega| omega.ln()).collect(), rate]
}
