//! Refinement of a table: points are added where the error of interpolation exceeds a tolerance.
//!
//! The criterion is cross-validation against computed results (see [`cross_validation`]): each inner point is left out
//! in turn and predicted from the others. A point is added in the middle of an interval, computed, and takes part in the
//! next cross-validation. The grid stays a product of its axes: a new interference is a row
//! of runs, a new slip rate a column. [`statistics`] summarises the errors of a table.
//!
//! Depends on `interpolation`, `table` and `quantity`. Chapter "Tables" of the book, "Errors of interpolation".

pub mod cross_validation;
pub mod statistics;

use crate::law::Estimate;
use crate::numbers::rounded;
use crate::quantity::{COVERAGE_FACTOR, OF_BOUND, Quantity};
use crate::table::{Axes, Slice};
use cross_validation::{Along, CrossValidation};

/// Quantities whose error of interpolation is judged: those of friction.
pub const JUDGED: [Quantity; 4] =
    [Quantity::Mu, Quantity::MuStatic, Quantity::Friction, Quantity::EnergyRelease];

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Largest relative error of interpolation.
    pub tolerance: f64,
    /// Points that the grid may have.
    pub most_cells: usize,
}

/// Points closer than this factor apart are not refined for a misfit that their own errors explain.
const CLOSE: f64 = 1.5;
/// Intervals below this factor are left as they are.
const NARROWEST: f64 = 1.02;

/// An interval that needs a point, and its error.
type Wanted = (f64, Along, usize);

impl Goal {
    /// Axes with more points, or none if every quantity of [`JUDGED`] interpolates within its allowance of the tolerance,
    /// or if the grid is full.
    pub fn next_axes(&self, table: &Slice) -> Option<Axes> {
        let mut wanted = self.wanted(table, &table.cross_validation());
        // The worst first: what does not fit any more is left out.
        wanted.sort_by(|a, b| b.0.total_cmp(&a.0));
        let axes = table.axes();
        let mut more = axes.clone();
        for (_, along, index) in wanted {
            let (axis, longer, other) = match along {
                Along::Interference => (&axes.interference, &mut more.interference, more.slip_rate.len()),
                Along::SlipRate => (&axes.slip_rate, &mut more.slip_rate, more.interference.len()),
            };
            if (longer.len() + 1) * other <= self.most_cells {
                longer.push(middle(axis[index], axis[index + 1]));
            }
        }
        more.interference.sort_by(f64::total_cmp);
        more.slip_rate.sort_by(f64::total_cmp);
        (more != *axes).then_some(more)
    }

    /// The intervals that a mesh of the grid with too large an error votes for: of its two, the
    /// one with the larger share of it.
    fn wanted(&self, table: &Slice, validation: &CrossValidation) -> Vec<Wanted> {
        let (rows, columns) = table.shape();
        let mut wanted: Vec<Wanted> = Vec::new();
        let mut vote = |error: f64, along: Along, index: usize| match wanted
            .iter_mut()
            .find(|(_, axis, at)| (*axis, *at) == (along, index))
        {
            Some(known) => known.0 = known.0.max(error),
            None => wanted.push((error, along, index)),
        };
        // An axis of one point has no intervals, but the other one has them all the same.
        for i in 0..rows.max(2) - 1 {
            for j in 0..columns.max(2) - 1 {
                for quantity in JUDGED {
                    let share = |along: Along, index: usize, across: usize, breadth: usize| {
                        let pair = across..(across + 2).min(breadth);
                        let error = |at| {
                            relevant(table, validation, along, index, at, quantity) / quantity.allowance()
                        };
                        pair.map(error).fold(0.0, f64::max)
                    };
                    let of_row = if rows > 1 { share(Along::Interference, i, j, columns) } else { 0.0 };
                    let of_column = if columns > 1 { share(Along::SlipRate, j, i, rows) } else { 0.0 };
                    let error = of_row + of_column;
                    if error <= self.tolerance {
                        continue;
                    }
                    if of_row >= of_column {
                        vote(error, Along::Interference, i);
                    }
                    if of_column >= of_row {
                        vote(error, Along::SlipRate, j);
                    }
                }
            }
        }
        wanted
    }
}

/// Error of an interval as far as a point in it can help.
fn relevant(
    table: &Slice,
    validation: &CrossValidation,
    along: Along,
    index: usize,
    across: usize,
    quantity: Quantity,
) -> f64 {
    let error = validation.interval(along, index, across, quantity);
    let x = validation.coordinate(along);
    let width = x[index + 1] - x[index];
    let is_explained = || width < CLOSE.ln() && error <= own_error(table, along, index, across, quantity);
    if width < NARROWEST.ln() || is_explained() { 0.0 } else { error }
}

/// The larger relative error of the results at both ends of an interval.
fn own_error(table: &Slice, along: Along, index: usize, across: usize, quantity: Quantity) -> f64 {
    let of = |point: usize| {
        let (i, j) = along.indices(point, across);
        let Some(cell) = table.cell(i, j) else { return 0.0 };
        let Estimate { value, error } = cell[quantity];
        let relative = (error / value).abs();
        if relative.is_finite() { relative } else { 0.0 }
    };
    of(index).max(of(index + 1))
}

/// The geometric mean (half of the upper end where the lower is 0), to three digits where these
/// suffice.
fn middle(lower: f64, upper: f64) -> f64 {
    let exact = if lower > 0.0 { (lower * upper).sqrt() } else { 0.5 * upper };
    let rounded = rounded(exact, 3);
    let inside = |at: f64| lower * 1.005 < at && at < upper / 1.005;
    if inside(rounded) { rounded } else { exact }
}

impl Slice {
    /// The table with the error of interpolating around each point added to its errors, and a note
    /// of it, so that it is not added again on reading.
    pub fn with_interpolation_errors(mut self, tolerance: f64) -> Slice {
        let validation = self.cross_validation();
        let base = self.metadata().temperature;
        for (i, j) in self.grid() {
            let Some(mut cell) = self.cell(i, j).cloned() else { continue };
            for quantity in Quantity::SCALARS {
                let relative = validation.around(i, j, quantity);
                let shift = quantity.origin(base);
                let added = COVERAGE_FACTOR * OF_BOUND * relative * (cell[quantity].value - shift).abs();
                if added > 0.0 {
                    cell[quantity].error = cell[quantity].error.hypot(added);
                }
            }
            self.set_cell(i, j, cell).expect("its histories were as long as the slip axis before");
        }
        self.metadata_mut().interpolation_tolerance = Some(tolerance);
        self
    }
}

#[cfg(test)]
mod tests;
