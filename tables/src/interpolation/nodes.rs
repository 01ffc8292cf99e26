//! The points of a table, and the error of interpolating between them.
//!
//! The interpolation error is estimated by leaving points out: each inner point of an axis is
//! predicted from its neighbours, and the relative misfit is the error of intervals
//! twice as long as those in use. Half of it is taken as the error, which is correct at a kink
//! and an upper bound for smooth data, where the cubic is of third order. Between two points the estimate varies as
//! 4t(1−t), being zero on them.

use super::ROUNDING;
pub(super) use super::histories::{COEFFICIENT, Errors, STATE_QUANTITIES, StateQuantity, Values};
use super::histories::{given_errors, history, with_slopes};
use super::low_rates::from_zero;
use super::steffen::{Location, end_slope, hermite, inner_slope, locate};
use crate::quantity::{COVERAGE_FACTOR, OF_BOUND, Quantity};
use crate::table::{Slice, Status};

/// Point (row, column) without a result.
pub(super) type Absent = (usize, usize);

/// Error of the interpolation over that of the prediction of left-out points.
pub(super) const REFINEMENT: f64 = 0.5;
/// Distance of a parabola with zero slope at one end from the straight line, in the middle, over the difference of both ends.
pub(super) const OF_PARABOLA: f64 = 0.25;
/// Bound of the error of the cubic over its difference to linear interpolation, which is of second order, the cubic of
/// third. Tables of twice the intervals need no more: see `omitted_points_lie_within_the_stated_errors`.
pub(super) const OF_STRAIGHT: f64 = 0.5;
/// Place of the slip rate among interference, slip rate and slip.
const SLIP_RATE: usize = 1;

#[derive(Clone, Debug)]
pub(super) struct Nodes {
    rates: usize,
    slip: Vec<f64>,
    /// Histories of each (i, j), or none: values and slopes per unit of s/a₀ for each slip.
    histories: Vec<Option<Vec<[Values; 2]>>>,
    /// Relative error of the results at each (i, j, k).
    given: Vec<Errors>,
    /// Relative misfit of the point (i, j, k) when predicted along interference, slip rate, slip.
    misfit: [Vec<Errors>; 3],
}

impl Nodes {
    pub(super) fn new(table: &Slice, log_interference: &[f64]) -> Self {
        let slip = table.axes().slip.clone();
        let (_, rates) = table.shape();
        let base = table.metadata().temperature;
        let mut nodes = Self {
            rates,
            histories: table.grid().map(|(i, j)| history(table, i, j, base)).collect(),
            given: table.grid().flat_map(|(i, j)| given_errors(table, i, j, base)).collect(),
            misfit: Default::default(),
            slip,
        };
        let slips = nodes.slip.clone();
        let along_slip = nodes.misfits(slips.len(), 2, |own| without(&slips, own));
        if table.metadata().interpolation_tolerance.is_some() {
            // The errors of the points include that of interpolating between them.
            nodes.misfit = [Vec::new(), Vec::new(), along_slip];
            return nodes;
        }
        let along_interference =
            nodes.misfits(log_interference.len(), 0, |own| without(log_interference, own));
        // Without the first positive slip rate the next one is the first of a table.
        let along_rate = nodes.misfits(rates, 1, |own| {
            let (rest, own) = without(&table.axes().slip_rate, own);
            (rest.iter().map(|rate| rate_coordinate(&rest, *rate)).collect(), rate_coordinate(&rest, own))
        });
        nodes.misfit = [along_interference, along_rate, along_slip];
        nodes
    }

    /// Whether the errors of the points include those of interpolation along interference and slip rate.
    pub(super) fn errors_include_interpolation(&self) -> bool {
        self.misfit[SLIP_RATE].is_empty()
    }

    pub(super) fn is_present(&self, i: usize, j: usize) -> bool {
        self.histories[i * self.rates + j].is_some()
    }

    /// s/a₀ at which the histories end.
    pub(super) fn last_slip(&self) -> f64 {
        self.slip.last().copied().unwrap_or(0.0)
    }

    pub(super) fn locate_slip(&self, ratio: f64) -> Location {
        locate(&self.slip, ratio)
    }

    /// State at a point of the grid after some slip; none where there are no results.
    pub(super) fn state(&self, i: usize, j: usize, slip: Location) -> Option<Values> {
        let history = self.histories[i * self.rates + j].as_ref()?;
        let Location { index, t } = slip;
        let [start, start_slope] = history[index];
        if t == 0.0 {
            return Some(start);
        }
        let [end, end_slope] = history[index + 1];
        let h = self.slip[index + 1] - self.slip[index];
        Some(std::array::from_fn(|f| hermite(h, t, start[f], end[f], start_slope[f], end_slope[f])))
    }

    /// Relative error at a place: the root of the squares of that of the results, linearly, and of those of interpolation
    /// along each axis.
    pub(super) fn relative_error(&self, place: Location, rate: Location, slip: Location) -> Errors {
        let mut error = Errors::default();
        let corner = |i: usize, j: usize, k: usize| (i * self.rates + j) * self.slip.len() + k;
        let (i, j, k) = (place.nearest(), rate.nearest(), slip.nearest());
        for (i, share_i) in ends(place) {
            for (j, share_j) in ends(rate) {
                let given = &self.given[corner(i, j, k)];
                for (error, given) in error.iter_mut().zip(given) {
                    *error += share_i * share_j * given;
                }
            }
        }
        let along = [
            (place, corner(place.index, j, k), corner(1, 0, 0)),
            (rate, corner(i, rate.index, k), corner(0, 1, 0)),
            (slip, corner(i, j, slip.index), 1),
        ];
        for (misfit, (at, position, stride)) in self.misfit.iter().zip(along) {
            let bump = COVERAGE_FACTOR * OF_BOUND * 4.0 * at.t * (1.0 - at.t) * REFINEMENT;
            if bump <= 0.0 || misfit.is_empty() {
                continue;
            }
            let (one, other) = (&misfit[position], &misfit[position + stride]);
            for (field, error) in error.iter_mut().enumerate() {
                *error = error.hypot(bump * one[field].max(other[field]));
            }
        }
        error
    }

    /// The nodes at one slip rate, as nodes with a single column: `row` is the state of a row
    /// after some slip, `error` its error. The error of interpolating along the slip rate joins that of the results.
    pub(super) fn at_rate(
        &self,
        rate: Location,
        row: impl Fn(usize, Location) -> Option<Values>,
        error: impl Fn(usize, Location) -> Errors,
    ) -> Self {
        let rows = self.histories.len() / self.rates;
        let j = rate.nearest();
        let history = |i: usize| {
            let states = (0..self.slip.len()).map(|k| row(i, Location::on(k)));
            Some(with_slopes(&self.slip, states.collect::<Option<Vec<_>>>()?))
        };
        let slips = self.slip.len();
        let column = |misfit: &Vec<Errors>| -> Vec<Errors> {
            if misfit.is_empty() {
                return Vec::new();
            }
            (0..rows).flat_map(|i| &misfit[(i * self.rates + j) * slips..][..slips]).copied().collect()
        };
        Self {
            rates: 1,
            slip: self.slip.clone(),
            histories: (0..rows).map(history).collect(),
            given: (0..rows)
                .flat_map(|i| (0..slips).map(move |k| (i, k)))
                .map(|(i, k)| error(i, Location::on(k)))
                .collect(),
            misfit: [column(&self.misfit[0]), Vec::new(), column(&self.misfit[2])],
        }
    }

    /// Misfits along the axis `along` of (interference, slip rate, slip) of `length` points; `without` has the coordinates
    /// of all others and of a point itself in an axis that it is left out of.
    fn misfits(
        &self,
        length: usize,
        along: usize,
        without: impl Fn(usize) -> (Vec<f64>, f64),
    ) -> Vec<Errors> {
        let value = |[i, j, k]: [usize; 3]| Some(self.histories[i * self.rates + j].as_ref()?[k][0]);
        let slips = self.slip.len();
        let points = (0..self.histories.len())
            .flat_map(|cell| (0..slips).map(move |k| (cell, k)))
            .map(|(cell, k)| [cell / self.rates, cell % self.rates, k]);
        let misfit = |point: [usize; 3]| -> Errors {
            let line = |n: usize| {
                let mut at = point;
                at[along] = n;
                value(at)
            };
            // End points cannot be left out, nor those beside an absent one: they take the misfit of the nearest that can.
            let own = point[along];
            let mut others: Vec<usize> = (1..length.saturating_sub(1)).collect();
            others.sort_by_key(|other| own.abs_diff(*other));
            let known = others.into_iter().find_map(|other| left_out(&without, line, other));
            let neighbours = [own.checked_sub(1), Some(own + 1).filter(|next| *next < length)];
            let of_pair = || {
                let mut pairs =
                    neighbours.into_iter().flatten().filter_map(|next| Some((line(own)?, line(next)?)));
                let (one, other) = pairs.next()?;
                Some(if along == SLIP_RATE { parabola(&one, &other) } else { two_means(&one, &other) })
            };
            known.or_else(of_pair).unwrap_or_default()
        };
        points.map(misfit).collect()
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
    let outer = neighbours(axis, index, |i| value(i).ok());
    let h = axis[index + 1] - axis[index];
    Ok(std::array::from_fn(|f| {
        blend_one(h, t, outer.map(|near| near.map(|(gap, v)| (gap, v[f]))), inner.map(|v| v[f]))
    }))
}

/// Blends one number that `value` gives at the points around `place`; with its [`bend`], which is zero on a point.
pub(super) fn blend_with_bend(
    axis: &[f64],
    place: Location,
    value: impl Fn(usize) -> Result<f64, Absent>,
) -> Result<(f64, f64), Absent> {
    let Location { index, t } = place;
    if t <= ROUNDING || t >= 1.0 - ROUNDING {
        return Ok((value(place.nearest())?, 0.0));
    }
    let inner = [value(index)?, value(index + 1)?];
    let outer = neighbours(axis, index, |i| value(i).ok());
    let h = axis[index + 1] - axis[index];
    let found = blend_one(h, t, outer, inner);
    Ok((found, bend(h, t, outer, inner, found)))
}

/// What is known at the points before and after the interval from `index` on, with their distances from it.
pub(crate) fn neighbours<T>(
    axis: &[f64],
    index: usize,
    value: impl Fn(usize) -> Option<T>,
) -> [Option<(f64, T)>; 2] {
    let before = index.checked_sub(1).and_then(|i| Some((axis[index] - axis[i], value(i)?)));
    let next = index + 2;
    let after = (next < axis.len()).then(|| Some((axis[next] - axis[next - 1], value(next)?)));
    [before, after.flatten()]
}

/// ξ(V): logarithmic from the first positive slip rate on, linear below it.
pub(super) fn rate_coordinate(slip_rates: &[f64], slip_rate: f64) -> f64 {
    match slip_rates.iter().find(|rate| **rate > 0.0) {
        None => 0.0,
        Some(first) if slip_rate < *first => slip_rate / first,
        Some(first) => 1.0 + (slip_rate / first).ln(),
    }
}

/// The points of an axis but one, and that one.
pub(super) fn without(axis: &[f64], own: usize) -> (Vec<f64>, f64) {
    ([&axis[..own], &axis[own + 1..]].concat(), axis[own])
}

/// Errors where no point of a line can be left out: the difference of the two possible means in the middle of two, as the misfit of an
/// interval twice as long.
fn two_means(one: &Values, other: &Values) -> Errors {
    let (a, b) = (with_coefficient(one), with_coefficient(other));
    std::array::from_fn(|f| {
        let (geometric, mean) = ((a[f] * b[f]).max(0.0).sqrt(), 0.5 * (a[f] + b[f]));
        let misfit = (mean - geometric).abs() / geometric.abs().max(f64::MIN_POSITIVE);
        if geometric > 0.0 { misfit.min(1.0) / REFINEMENT } else { 0.0 }
    })
}

/// Errors where no point can be left out along the slip rate, along which values have no power law: the distance in the middle of a parabola with zero slope at
/// one end from the straight line.
fn parabola(one: &Values, other: &Values) -> Errors {
    let (a, b) = (with_coefficient(one), with_coefficient(other));
    std::array::from_fn(|f| {
        let largest = a[f].abs().max(b[f].abs());
        if largest > 0.0 { OF_PARABOLA * (a[f] - b[f]).abs() / largest / REFINEMENT } else { 0.0 }
    })
}

/// Relative misfit of the inner point `own` of a line when predicted from the others.
fn left_out(
    without: impl Fn(usize) -> (Vec<f64>, f64),
    line: impl Fn(usize) -> Option<Values>,
    own: usize,
) -> Option<Errors> {
    let (rest, at) = without(own);
    let place = Location { index: own - 1, t: (at - rest[own - 1]) / (rest[own] - rest[own - 1]) };
    let of_rest = |n: usize| line(n + usize::from(n >= own)).ok_or((n, 0));
    let (predicted, actual) = (blend(&rest, place, of_rest).ok()?, line(own)?);
    let (predicted, actual) = (with_coefficient(&predicted), with_coefficient(&actual));
    Some(std::array::from_fn(|f| {
        if actual[f] == 0.0 { 0.0 } else { ((predicted[f] - actual[f]) / actual[f]).abs() }
    }))
}

/// A state and Q/P.
pub(super) fn with_coefficient(values: &Values) -> Errors {
    let [load, friction, ..] = *values;
    let mut all = Errors::default();
    all[..STATE_QUANTITIES].copy_from_slice(values);
    all[COEFFICIENT] = if load == 0.0 { 0.0 } else { friction / load };
    all
}

/// What is known at the points before and after an interval, with their distances from it; as from [`neighbours`].
type Outer = [Option<(f64, f64)>; 2];

/// Monotone cubic between two points with optional outer ones; of the [`logarithms`] where it can be. From zero
/// [`from_zero`].
pub(crate) fn blend_one(h: f64, t: f64, outer: Outer, inner: [f64; 2]) -> f64 {
    if let Some((outer, inner)) = logarithms(outer, inner) {
        return cubic(h, t, outer, inner).exp();
    }
    if let ([0.0, end], [None, Some((gap, next))]) = (inner, outer)
        && (0.0..next).contains(&end)
    {
        return end * from_zero(t, gap.exp(), next / end);
    }
    cubic(h, t, outer, inner)
}

/// Difference of [`blend_one`], which is `value`, to the straight line through the inner points. Of logarithms the parts of
/// the two ends are added as if they had one sign: at an inflection they cancel, and the cubic is not more certain there.
fn bend(h: f64, t: f64, outer: Outer, inner: [f64; 2], value: f64) -> f64 {
    let Some((outer, inner)) = logarithms(outer, inner) else {
        return (value - (1.0 - t) * inner[0] - t * inner[1]).abs();
    };
    let rise = inner[1] - inner[0];
    let [start, end] = end_slopes(h, outer, inner).map(|slope| (slope * h - rise).abs());
    value * t * (1.0 - t) * ((1.0 - t) * start + t * end)
}

/// Logarithms of two positive values, and of the outer ones that are positive.
fn logarithms(outer: Outer, inner: [f64; 2]) -> Option<(Outer, [f64; 2])> {
    let of_positive = |near: Option<(f64, f64)>| {
        near.filter(|(_, value)| *value > 0.0).map(|(gap, value)| (gap, value.ln()))
    };
    inner.iter().all(|value| *value > 0.0).then(|| (outer.map(of_positive), inner.map(f64::ln)))
}

/// The monotone cubic of the values as they are.
pub(crate) fn cubic(h: f64, t: f64, outer: Outer, inner: [f64; 2]) -> f64 {
    let [start, end] = end_slopes(h, outer, inner);
    hermite(h, t, inner[0], inner[1], start, end)
}

/// Slopes of the cubic at the ends of the interval.
fn end_slopes(h: f64, [before, after]: Outer, [y0, y1]: [f64; 2]) -> [f64; 2] {
    let secant = (y1 - y0) / h;
    let before = before.map(|(gap, value)| (gap, (y0 - value) / gap));
    let after = after.map(|(gap, value)| (gap, (value - y1) / gap));
    let slope = |near: Option<(f64, f64)>, far: Option<(f64, f64)>| match (near, far) {
        (Some((gap, d)), _) => inner_slope(gap, h, d, secant),
        (None, Some((gap, d))) => end_slope(h, gap, secant, d),
        (None, None) => secant,
    };
    [slope(before, after), slope(after, before)]
}

/// The two ends of an interval with their shares.
pub(super) fn ends(place: Location) -> impl Iterator<Item = (usize, f64)> {
    let Location { index, t } = place;
    [(index, 1.0 - t), (index + 1, t)].into_iter().filter(|(_, share)| *share > 0.0)
}

/// ln a₀ of each row: a₀ belongs to the press and does not depend on the slip rate.
pub(super) fn log_contact_radii(table: &Slice) -> Vec<f64> {
    let (rows, rates) = table.shape();
    let radius = |i: usize| {
        let known = (0..rates)
            .filter_map(|j| table.cell(i, j))
            .map(|cell| cell[Quantity::ContactRadius].value)
            .find(|radius| *radius > 0.0);
        known.map_or(f64::NAN, f64::ln)
    };
    (0..rows).map(radius).collect()
}

/// Reason of a missing response at a point.
pub(super) fn reason(status: &Status) -> String {
    match status {
        Status::Done(_) => "the table has no complete results there".to_string(),
        Status::NotRun => "not run".to_string(),
        Status::Failed(reason) => format!("the run failed: {reason}"),
    }
}
