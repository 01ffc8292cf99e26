//! The interpolant of a slice: nodes, coordinates, the elastic limit.

use roots::{SimpleConvergency, find_root_brent};

use super::ROUNDING;
use super::hertz_limit::{BelowFirstRow, ElasticSphere, extrapolated};
use super::nodes::{self, FIELDS, Nodes, Values};
use super::steffen::{self, Location, locate};
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
    /// Its slopes against ln ω.
    pub(super) log_contact_radius_slope: Vec<f64>,
    pub(super) sphere: ElasticSphere,
}

/// Reason of a missing result at a point (row, column).
pub(super) type Absent = (usize, usize);

impl Interpolant {
    pub(super) fn new(table: &Slice) -> Self {
        let slip_rate = table.axes().slip_rate.clone();
        let [log_interference, rate_coordinate] = coordinates(table.axes());
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
            sphere: ElasticSphere::new(table.metadata()),
            log_interference,
            slip_rate,
            rate_coordinate,
            nodes,
        }
    }

    /// Blends what `value` gives at the points around `place`, of which the outer two may be
    /// absent.
    pub(super) fn blend(
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

    /// State of a row at a slip rate and slip.
    fn row(&self, i: usize, rate: Location, slip: Location) -> Result<Values, Absent> {
        Self::blend(&self.rate_coordinate, rate, |j| self.nodes.state(i, j, slip).ok_or((i, j)))
    }

    /// a₀ inside the table, m.
    pub(super) fn contact_radius(&self, place: Location) -> f64 {
        let Location { index, t } = place;
        let (y, slope) = (&self.log_contact_radius, &self.log_contact_radius_slope);
        // On a row the neighbouring rows have no weight and may be absent.
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
    pub(super) fn locate_rate(&self, slip_rate: f64) -> Option<Location> {
        let (first, last) = (self.slip_rate[0], *self.slip_rate.last()?);
        let slack = ROUNDING * last;
        if !(first - slack..=last + slack).contains(&slip_rate) {
            return None;
        }
        let at = rate_coordinate(&self.slip_rate, slip_rate.clamp(first, last));
        Some(locate(&self.rate_coordinate, at))
    }

    /// State and relative errors at the radius of the table.
    pub(super) fn state(
        &self,
        interference: f64,
        rate: Location,
        slip: f64,
    ) -> Result<(Values, Values), Absent> {
        let (first, _) = self.rows.ok_or((0, 0))?;
        let log_interference = interference.ln();
        if log_interference < self.log_interference[first] {
            return self.state_below(first, log_interference, rate, slip);
        }
        let place = locate(&self.log_interference, log_interference);
        let slip = self.nodes.locate_slip(slip / self.contact_radius(place));
        let values = Self::blend(&self.log_interference, place, |i| self.row(i, rate, slip))?;
        Ok((values, self.nodes.relative_error(place, rate, slip)))
    }

    pub(super) fn below(&self, first: usize, log_interference: f64) -> BelowFirstRow {
        let first_row = self.log_interference[first];
        BelowFirstRow { first_row: first_row.exp(), log_ratio: log_interference - first_row }
    }

    /// State and relative errors below the first row.
    fn state_below(
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
        let below = self.below(first, log_interference);
        let (values, uncertainty) = self.sphere.state_below(below, ratio, &row);
        let mut error = self.nodes.relative_error(place, rate, slip);
        for (error, uncertainty) in error.iter_mut().zip(uncertainty) {
            *error += uncertainty;
        }
        Ok((values, error))
    }
}

impl Interpolant {
    /// ω/ω_c at which the slip `slip` (m), at the radius of the table, is the last of the histories.
    pub(super) fn end_of_histories(&self, slip: f64) -> Option<f64> {
        let (first, last) = self.rows?;
        let wanted = slip / self.nodes.last_slip();
        let contact_radius = |log_interference: f64| match log_interference < self.log_interference[first] {
            true => self.contact_radius_below(first, log_interference),
            false => self.contact_radius(locate(&self.log_interference, log_interference)),
        };
        // a₀ grows with ω; far below the table as its root.
        let (low, high) = (self.log_interference[first] - 40.0, self.log_interference[last]);
        let mut accuracy = SimpleConvergency { eps: 1e-13, max_iter: 200 };
        let excess = |place: f64| contact_radius(place) / wanted - 1.0;
        find_root_brent(low, high, excess, &mut accuracy).ok().filter(|_| wanted > 0.0).map(f64::exp)
    }

    /// a₀ below the first row, m.
    pub(super) fn contact_radius_below(&self, first: usize, log_interference: f64) -> f64 {
        let below = self.below(first, log_interference);
        extrapolated(
            self.sphere.contact_radius(below.interference()),
            self.sphere.contact_radius(below.first_row),
            self.log_contact_radius[first].exp(),
            below.press_weight(),
        )
    }

    /// The same at one slip rate, as an interpolant with a single column.
    pub(super) fn at_rate(&self, rate: Location) -> Self {
        Self {
            log_interference: self.log_interference.clone(),
            slip_rate: vec![0.0],
            rate_coordinate: vec![0.0],
            nodes: (self.nodes).at_rate(rate, |i, slip| self.row(i, rate, slip).ok()),
            rows: self.rows,
            log_contact_radius: self.log_contact_radius.clone(),
            log_contact_radius_slope: self.log_contact_radius_slope.clone(),
            sphere: self.sphere,
        }
    }
}

/// Coordinates in which is interpolated: ln ω, and ξ of the slip rates.
pub(crate) fn coordinates(axes: &Axes) -> [Vec<f64>; 2] {
    let rates = &axes.slip_rate;
    let rate = rates.iter().map(|rate| rate_coordinate(rates, *rate)).collect();
    [axes.interference.iter().map(|omega| omega.ln()).collect(), rate]
}

/// ξ(V): logarithmic from the first positive slip rate on, linear below it.
fn rate_coordinate(slip_rates: &[f64], slip_rate: f64) -> f64 {
    match slip_rates.iter().find(|rate| **rate > 0.0) {
        None => 0.0,
        Some(first) if slip_rate < *first => slip_rate / first,
        Some(first) => 1.0 + (slip_rate / first).ln(),
    }
}
