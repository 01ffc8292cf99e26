//! A table as a law: between its points, below them, and at other radii.
//!
//! - **Interference**: monotone cubic in ln ω, of the logarithm of positive quantities, hence
//!   exact for power laws. Below the first point the elastic asymptote, see [`elastic`]; above
//!   the last an error.
//! - **Slip rate**: the same in ξ(V) = 1 + ln(V/V₁) from the first positive slip rate V₁ on and
//!   ξ = V/V₁ below it, down to the isothermal limit V = 0 at ξ = 0 where the table has one. ξ
//!   and its derivative are continuous at V₁; heating of a resting source is linear in V at
//!   small V.
//! - **Slip**: monotone cubic in s/a₀ between the points of the histories, held after the last.
//! - **Radius**: read at VR/R_t, ω/ω_c and s/a₀; forces and areas scale with (R/R_t)².
//! - **Errors**: those of the points, interpolated linearly, plus an estimate of the
//!   interpolation error: how well each point is predicted by the others (see [`nodes`]). Along
//!   interference and slip rate only if the errors of the points do not include it already (see
//!   [`Table::with_interpolation_errors`]).

mod elastic;
mod end_of_histories;
mod extrapolation;
mod failed_cells;
mod nodes;
mod scalar;
pub mod steffen;
pub mod temperature;

pub use extrapolation::Extrapolated;
pub(crate) use nodes::{blend_one, cubic};

use std::sync::{Arc, OnceLock};

use crate::law::{AsperityLaw, Estimate, LookupError, Response, SlidingResponse};
use crate::quantity::Quantity;
use crate::table::Table;
use elastic::{Descent, Elastic};
use nodes::{FIELDS, Field, Nodes, Values};
use steffen::{Location, locate};

/// A slip rate or interference closer than this to the end of an axis, relatively, is on it.
const ROUNDING: f64 = 1e-9;

/// The interpolant of a table, made at its first use and dropped when the table changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Prepared(OnceLock<Arc<Interpolant>>);

/// It follows from the table, so it does not count in comparisons.
impl PartialEq for Prepared {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// What can be computed before the first question.
#[derive(Debug)]
pub(crate) struct Interpolant {
    log_interference: Vec<f64>,
    slip_rate: Vec<f64>,
    /// ξ of each slip rate.
    rate_coordinate: Vec<f64>,
    nodes: Nodes,
    /// Rows of the first and last interference with any result.
    rows: Option<(usize, usize)>,
    /// ln a₀ of each row, a₀ in m; NaN for rows without results.
    log_contact_radius: Vec<f64>,
    /// Its slopes against ln ω.
    log_contact_radius_slope: Vec<f64>,
    elastic: Elastic,
}

/// Why there is no result at a point: (row, column).
type Absent = (usize, usize);

impl Interpolant {
    fn new(table: &Table) -> Self {
        let axes = table.axes();
        let slip_rate = axes.slip_rate.clone();
        let rate_coordinate: Vec<f64> =
            (slip_rate.iter()).map(|rate| rate_coordinate(&slip_rate, *rate)).collect();
        let log_interference: Vec<f64> = axes.interference.iter().map(|w| w.ln()).collect();
        let nodes = Nodes::new(table, &log_interference, &rate_coordinate);
        let filled = |i: &usize| (0..slip_rate.len()).any(|j| nodes.is_present(*i, j));
        let rows = 0..log_interference.len();
        let first = rows.clone().find(filled);
        let last = rows.rev().find(filled);
        let log_contact_radius = nodes::log_contact_radii(table);
        Self {
            rows: first.zip(last),
            log_contact_radius_slope: steffen::slopes(&log_interference, &log_contact_radius),
            log_contact_radius,
            elastic: Elastic::new(table.metadata()),
            log_interference,
            slip_rate,
            rate_coordinate,
            nodes,
        }
    }

    /// Blends what `value` gives at the points around `place`, of which the outer two may be
    /// absent.
    fn blend(
        axis: &[f64],
        place: Location,
        value: impl Fn(usize) -> Result<Values, Absent>,
    ) -> Result<Values, Absent> {
        let Location { index, t } = place;
        if t <= ROUNDING {
            return value(index);
        }
        if t >= 1.0 - ROUNDING {
            return value(index + 1);
        }
        let inner = [value(index)?, value(index + 1)?];
        let before = index.checked_sub(1).and_then(|i| value(i).ok());
        let after = (index + 2 < axis.len()).then(|| value(index + 2).ok());
        let after = after.flatten();
        let h = axis[index + 1] - axis[index];
        let h_before = before.map(|_| axis[index] - axis[index - 1]);
        let h_after = after.map(|_| axis[index + 2] - axis[index + 1]);
        let mut result = [0.0; FIELDS];
        for (field, result) in result.iter_mut().enumerate() {
            let outer = [before.map(|v| v[field]), after.map(|v| v[field])];
            *result = nodes::blend_one([h_before, h_after], h, t, outer, [inner[0][field], inner[1][field]]);
        }
        Ok(result)
    }

    /// ln ω of each row.
    pub(crate) fn log_interference(&self) -> &[f64] {
        &self.log_interference
    }

    /// ξ of each slip rate.
    pub(crate) fn rate_coordinate(&self) -> &[f64] {
        &self.rate_coordinate
    }

    /// State of a row at a slip rate and slip.
    fn row(&self, i: usize, rate: Location, slip: Location) -> Result<Values, Absent> {
        Self::blend(&self.rate_coordinate, rate, |j| self.nodes.state(i, j, slip).ok_or((i, j)))
    }

    /// a₀ inside the table, m.
    fn contact_radius(&self, place: Location) -> f64 {
        let Location { index, t } = place;
        let (y, slope) = (&self.log_contact_radius, &self.log_contact_radius_slope);
        // On a row its neighbours do not matter, be they there or not.
        if t == 0.0 {
            return y[index].exp();
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
    fn locate_rate(&self, slip_rate: f64) -> Option<Location> {
        let (first, last) = (self.slip_rate[0], *self.slip_rate.last()?);
        let slack = ROUNDING * last;
        if !(first - slack..=last + slack).contains(&slip_rate) {
            return None;
        }
        let at = rate_coordinate(&self.slip_rate, slip_rate.clamp(first, last));
        Some(locate(&self.rate_coordinate, at))
    }

    /// State and relative errors at the radius of the table.
    fn state(&self, interference: f64, rate: Location, slip: f64) -> Result<(Values, Values), Absent> {
        let (first, _) = self.rows.ok_or((0, 0))?;
        let log_interference = interference.ln();
        if log_interference < self.log_interference[first] {
            return self.below(first, log_interference, rate, slip);
        }
        let place = locate(&self.log_interference, log_interference);
        let slip = self.nodes.locate_slip(slip / self.contact_radius(place));
        let values = Self::blend(&self.log_interference, place, |i| self.row(i, rate, slip))?;
        Ok((values, self.nodes.relative_error(place, rate, slip)))
    }

    fn descent(&self, first: usize, log_interference: f64) -> Descent {
        let knot = self.log_interference[first];
        Descent { knot: knot.exp(), depth: log_interference - knot }
    }

    /// Below the first row: elastic, in the ratio to elasticity that the row has.
    fn below(
        &self,
        first: usize,
        log_interference: f64,
        rate: Location,
        slip: f64,
    ) -> Result<(Values, Values), Absent> {
        let ratio = slip / self.contact_radius_below(first, log_interference);
        let place = Location { index: first, t: 0.0 };
        let slip = self.nodes.locate_slip(ratio);
        let row = self.row(first, rate, slip)?;
        let descent = self.descent(first, log_interference);
        let (values, spread) = self.elastic.below(descent, ratio, &row);
        let mut error = self.nodes.relative_error(place, rate, slip);
        for (error, spread) in error.iter_mut().zip(spread) {
            *error += spread;
        }
        Ok((values, error))
    }
}

impl Interpolant {
    /// The same at one slip rate, as an interpolant with a single column.
    fn at_rate(&self, rate: Location) -> Self {
        Self {
            log_interference: self.log_interference.clone(),
            slip_rate: vec![0.0],
            rate_coordinate: vec![0.0],
            nodes: (self.nodes).at_rate(rate, |i, slip| self.row(i, rate, slip).ok()),
            rows: self.rows,
            log_contact_radius: self.log_contact_radius.clone(),
            log_contact_radius_slope: self.log_contact_radius_slope.clone(),
            elastic: self.elastic,
        }
    }
}

/// ξ(V): logarithmic from the first positive slip rate on, linear below it.
fn rate_coordinate(slip_rates: &[f64], slip_rate: f64) -> f64 {
    match slip_rates.iter().find(|rate| **rate > 0.0) {
        None => 0.0,
        Some(first) if slip_rate < *first => slip_rate / first,
        Some(first) => 1.0 + (slip_rate / first).ln(),
    }
}

impl Table {
    pub(crate) fn interpolant(&self) -> &Interpolant {
        let make = || Arc::new(Interpolant::new(self));
        self.prepared().0.get_or_init(make)
    }

    /// R/R_t, or why the table cannot be read at that radius.
    fn radius_ratio(&self, radius: f64) -> Result<f64, LookupError> {
        let metadata = self.metadata();
        let ratio = radius / metadata.asperity_radius;
        if metadata.gap_conductance != 0.0 && (ratio - 1.0).abs() > ROUNDING {
            return Err(LookupError::RadiusFixed { table: metadata.asperity_radius, asked: radius });
        }
        Ok(ratio)
    }

    fn check_interference(&self, interference: f64) -> Result<(), LookupError> {
        let limit = self.interference_limit();
        if interference > limit * (1.0 + ROUNDING) {
            return Err(LookupError::InterferenceAbove { interference, limit });
        }
        Ok(())
    }

    /// Response at R = `ratio`·R_t from a state at R_t, which takes the slip at R_t.
    fn scaled(
        &self,
        interference: f64,
        ratio: f64,
        slip: f64,
        state: impl Fn(f64) -> Result<(Values, Values), Absent>,
    ) -> Result<Response, Absent> {
        let base = self.metadata().temperature;
        let (values, errors) =
            if interference > 0.0 { state(slip.max(0.0) / ratio)? } else { ([0.0; FIELDS], [0.0; FIELDS]) };
        let estimate = |field: Field, scale: f64| Estimate {
            value: scale * values[field as usize],
            error: scale * (values[field as usize] * errors[field as usize]).abs(),
        };
        let squared = ratio * ratio;
        let rise = estimate(Field::TemperatureRise, 1.0);
        Ok(Response {
            load: estimate(Field::Load, squared),
            friction: estimate(Field::Friction, squared),
            area: estimate(Field::Area, squared),
            temperature_max: Estimate { value: base + rise.value, error: rise.error },
        })
    }

    fn located_rate(&self, interference: f64, slip_rate: f64, ratio: f64) -> Result<Location, LookupError> {
        self.check_interference(interference)?;
        let rates = &self.axes().slip_rate;
        (self.interpolant().locate_rate(slip_rate * ratio)).ok_or(LookupError::SlipRateOutside {
            slip_rate,
            from: rates[0] / ratio,
            to: rates[rates.len() - 1] / ratio,
        })
    }

    fn absent(&self, (i, j): Absent, ratio: f64) -> LookupError {
        LookupError::Missing {
            interference: self.axes().interference[i],
            slip_rate: self.axes().slip_rate[j] / ratio,
            reason: nodes::reason(self.status(i, j)),
        }
    }
}

impl AsperityLaw for Table {
    fn name(&self) -> String {
        match self.metadata().title.as_str() {
            "" => "table".to_string(),
            title => title.to_string(),
        }
    }

    fn critical_interference(&self, radius: f64) -> f64 {
        self.metadata().critical_interference * radius / self.metadata().asperity_radius
    }

    fn interference_limit(&self) -> f64 {
        let axis = &self.axes().interference;
        let last = (self.interpolant().rows).map_or(axis.len() - 1, |(_, last)| last);
        axis[last]
    }

    fn breaks(&self) -> Vec<f64> {
        self.axes().interference.clone()
    }

    /// Where the histories end: contacts smaller than that have slid farther, and are held.
    fn breaks_after(&self, radius: f64, slip: f64) -> Vec<f64> {
        let ratio = radius / self.metadata().asperity_radius;
        self.interpolant().end_of_histories(slip / ratio).into_iter().collect()
    }

    fn slip_rate_range(&self, radius: f64) -> (f64, f64) {
        let ratio = radius / self.metadata().asperity_radius;
        let rates = &self.axes().slip_rate;
        (rates[0] / ratio, rates[rates.len() - 1] / ratio)
    }

    fn response(
        &self,
        radius: f64,
        interference: f64,
        slip_rate: f64,
        slip: f64,
    ) -> Result<Response, LookupError> {
        let ratio = self.radius_ratio(radius)?;
        let rate = self.located_rate(interference, slip_rate, ratio)?;
        let state = |slip| self.interpolant().state(interference, rate, slip);
        self.scaled(interference, ratio, slip, state).map_err(|absent| self.absent(absent, ratio))
    }

    /// Interpolates along the slip rate once and for all.
    fn at_slip_rate(&self, radius: f64, slip_rate: f64) -> Result<SlidingResponse<'_>, LookupError> {
        let ratio = self.radius_ratio(radius)?;
        let rate = self.located_rate(0.0, slip_rate, ratio)?;
        let column = self.interpolant().at_rate(rate);
        let only = Location { index: 0, t: 0.0 };
        Ok(Box::new(move |interference, slip| {
            self.check_interference(interference)?;
            let state = |slip| column.state(interference, only, slip);
            self.scaled(interference, ratio, slip, state)
                // What is absent, and why, the general way knows.
                .or_else(|_| self.response(radius, interference, slip_rate, slip))
        }))
    }

    /// G times the area at inception.
    fn energy_release(
        &self,
        radius: f64,
        interference: f64,
        slip_rate: f64,
    ) -> Result<Option<Estimate>, LookupError> {
        if interference <= 0.0 {
            return Ok(Some(Estimate::default()));
        }
        let ask = |quantity| self.estimate(quantity, radius, interference, slip_rate);
        let (per_area, inception) = (ask(Quantity::EnergyRelease)?, ask(Quantity::InceptionSlip)?);
        let area = self.response(radius, interference, slip_rate, inception.value)?.area;
        Ok(Some(Estimate {
            value: per_area.value * area.value,
            error: per_area.error * area.value + per_area.value.abs() * area.error,
        }))
    }
}

#[cfg(test)]
mod tests;
