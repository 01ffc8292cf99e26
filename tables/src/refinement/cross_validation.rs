//! Error of interpolation by cross-validation: computed points are left out and predicted.
//!
//! Each inner interference (slip rate) is taken out of the table with all its results, and these
//! are predicted from the others by the interpolation that a reader of the table uses. The misfit
//! is the error of interpolation over the gap that was made; that over one of its two parts is
//! taken to be smaller in proportion, as it is at a kink. Where the data are smooth the
//! interpolation is of third order, and this an upper estimate. `G` has in addition the bound of its kink at first yield.

use crate::interpolation::first_yield::largest_kink;
use crate::interpolation::{InterpolatedTable, coordinates};
use crate::quantity::Quantity;
use crate::table::{Axes, Slice};

/// Relative errors of interpolation between neighbouring points of a table.
///
/// ```
/// use tables::refinement::cross_validation::Along;
/// use tables::quantity::Quantity;
/// use tables::shipped::table;
///
/// let validation = table("copper")?.cross_validation();
/// // Between any two points of this table friction is known to 2 % and better, G is not.
/// assert!(validation.worst(Quantity::Mu).error < 0.02);
/// assert!(validation.worst(Quantity::EnergyRelease).error > validation.worst(Quantity::Mu).error);
/// // Left out and predicted from its neighbours, over a gap that is twice as wide.
/// let misfits = (1..10).filter_map(|row| validation.misfit(Along::Interference, row, 0, Quantity::Mu));
/// let largest = misfits.fold(0.0, f64::max);
/// assert!(largest > 1e-3 && largest < 0.05, "{largest}");
/// // The ends of an axis cannot be left out.
/// assert_eq!(validation.misfit(Along::Interference, 0, 0, Quantity::Mu), None);
/// # Ok::<(), tables::shipped::TableSourceError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CrossValidation {
    /// Along interference and along slip rate.
    along: [Misfits; 2],
    shape: (usize, usize),
}

/// Misfits of the points along one axis.
#[derive(Clone, Debug, PartialEq)]
struct Misfits {
    /// Coordinate in which is interpolated.
    coordinate: Vec<f64>,
    /// Relative misfit of each point (row-major) in each quantity; none at the ends of the axis and
    /// without values to compare.
    points: Vec<[Option<f64>; Quantity::SCALARS.len()]>,
}

/// One of the two axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    Interference,
    SlipRate,
}

impl Along {
    /// Indices of interference and slip rate of a point of this axis, at the point `across` of the other.
    pub(super) fn indices(self, point: usize, across: usize) -> (usize, usize) {
        match self {
            Self::Interference => (point, across),
            Self::SlipRate => (across, point),
        }
    }
}

/// The largest interpolation error of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Relative.
    pub error: f64,
    /// Point next to which it is: indices of interference and slip rate.
    pub at: (usize, usize),
}

impl Slice {
    /// Leaves out every inner interference and slip rate in turn.
    pub fn cross_validation(&self) -> CrossValidation {
        let (rows, columns) = self.shape();
        let empty = || vec![[None; Quantity::SCALARS.len()]; rows * columns];
        let mut along = coordinates(self.axes()).map(|coordinate| Misfits { coordinate, points: empty() });
        for (axis, points) in [(Along::Interference, rows), (Along::SlipRate, columns)] {
            for left_out in 1..points.saturating_sub(1) {
                let rest = self.without(axis, left_out);
                for (i, j) in self.grid().filter(|at| [at.0, at.1][axis as usize] == left_out) {
                    along[axis as usize].points[i * columns + j] = self.misfit(&rest, i, j);
                }
            }
        }
        CrossValidation { along, shape: (rows, columns) }
    }

    /// The table less one row or column.
    fn without(&self, along: Along, index: usize) -> InterpolatedTable {
        let mut axes: Axes = self.axes().clone();
        match along {
            Along::Interference => axes.interference.remove(index),
            Along::SlipRate => axes.slip_rate.remove(index),
        };
        self.regridded(axes).expect("axes of a table less a point are axes").interpolated()
    }

    fn misfit(&self, rest: &InterpolatedTable, i: usize, j: usize) -> [Option<f64>; Quantity::SCALARS.len()] {
        let (interference, slip_rate) = self.coordinates(i, j);
        let radius = self.metadata().asperity_radius;
        Quantity::SCALARS.map(|quantity| {
            let actual = self.cell(i, j)?[quantity].value;
            let base = quantity.origin(self.metadata().temperature);
            let predicted = rest.estimate(quantity, radius, interference, slip_rate).ok()?.value;
            // Of a temperature the rise: only that changes.
            let scale = (actual - base).abs().max((predicted - base).abs());
            let misfit = (predicted - actual).abs();
            match misfit {
                0.0 => Some(0.0),
                misfit => (misfit / scale).is_finite().then_some(misfit / scale),
            }
        })
    }
}

impl CrossValidation {
    /// Relative error between the points `index` and `index + 1` of an axis, at the point `across`
    /// of the other. Zero on an axis of one point, infinite on one of two, which has
    /// no inner point.
    pub fn interval(&self, along: Along, index: usize, across: usize, quantity: Quantity) -> f64 {
        let misfits = &self.along[along as usize];
        let x = &misfits.coordinate;
        if x.len() <= 2 {
            return if x.len() < 2 { 0.0 } else { f64::INFINITY };
        }
        let width = x[index + 1] - x[index];
        let mut error: f64 = 0.0;
        for point in [index, index + 1] {
            if let Some(misfit) = self.misfit(along, point, across, quantity) {
                error = error.max(misfit * width / (x[point + 1] - x[point - 1]));
            }
        }
        let is_energy = (along, quantity) == (Along::Interference, Quantity::EnergyRelease);
        let is_known = |values: &[Option<f64>; Quantity::SCALARS.len()]| values[quantity as usize].is_some();
        if is_energy && misfits.points.iter().any(is_known) {
            error = error.max(largest_kink(x[index], x[index + 1]));
        }
        error
    }

    /// Relative misfit of a point of an axis; none at end points and where a value is unknown.
    pub fn misfit(&self, along: Along, point: usize, across: usize, quantity: Quantity) -> Option<f64> {
        let (i, j) = along.indices(point, across);
        self.along[along as usize].points[i * self.shape.1 + j][quantity as usize]
    }

    /// Coordinate in which is interpolated: ln ω, and one that is ln V but for the slowest.
    pub fn coordinate(&self, along: Along) -> &[f64] {
        &self.along[along as usize].coordinate
    }

    /// Relative error of interpolating next to a point: the larger of both sides
    /// along each axis, added.
    pub fn around(&self, i: usize, j: usize, quantity: Quantity) -> f64 {
        let side = |along: Along, point: usize, across: usize| {
            let last = self.coordinate(along).len() - 1;
            let before = point.checked_sub(1).map_or(0.0, |k| self.interval(along, k, across, quantity));
            let after = if point < last { self.interval(along, point, across, quantity) } else { 0.0 };
            before.max(after)
        };
        side(Along::Interference, i, j) + side(Along::SlipRate, j, i)
    }

    /// The largest error of a quantity in the table.
    pub fn worst(&self, quantity: Quantity) -> Worst {
        let (rows, columns) = self.shape;
        let mut worst = Worst { error: 0.0, at: (0, 0) };
        for at in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
            let error = self.around(at.0, at.1, quantity);
            if error > worst.error {
                worst = Worst { error, at };
            }
        }
        worst
    }
}
