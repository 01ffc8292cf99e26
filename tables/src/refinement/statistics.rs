//! Errors, states and cost of a table in a few numbers.

use crate::interpolation::InterpolatedTable;
use crate::quantity::{Estimate, Quantity};
use crate::table::{Metadata, Slice, Status};

/// Relative errors of a quantity over the cells with results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorStatistics {
    /// The quantity.
    pub quantity: Quantity,
    /// Smallest and largest value, in the unit of the quantity.
    pub range: (f64, f64),
    /// Median relative error.
    pub median: f64,
    /// Largest relative error.
    pub largest: f64,
    /// Where the largest is: indices of interference and slip rate.
    pub largest_at: (usize, usize),
    /// Largest error of interpolation, by cross-validation; infinite where an axis has two points.
    pub interpolation: f64,
    /// Median and largest relative error of values read half-way between neighbouring points of both axes, that of
    /// interpolation included; none without such points.
    pub between: Option<[f64; 2]>,
}

/// Numbers of cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cells with results.
    pub done: usize,
    /// Cells that were not run.
    pub not_run: usize,
    /// Cells that failed.
    pub failed: usize,
}

/// Median and largest relative error half-way between the points; values of no more than `nothing` are left out.
fn between_points(table: &InterpolatedTable, quantity: Quantity, nothing: f64) -> Option<[f64; 2]> {
    let Metadata { asperity_radius, temperature, .. } = table.metadata();
    let origin = quantity.origin(*temperature);
    let error = |(omega, rate)| {
        let Estimate { value, error } = table.estimate(quantity, *asperity_radius, omega, rate).ok()?;
        let size = (value - origin).abs();
        (size > nothing && error.is_finite()).then_some(error / size)
    };
    let mut errors: Vec<f64> = table.between_points().into_iter().filter_map(error).collect();
    errors.sort_by(f64::total_cmp);
    Some([*errors.get(errors.len() / 2)?, *errors.last()?])
}

impl Slice {
    /// (ω₀/ω_c, V in m/s) half-way between neighbouring points of both axes, in the logarithm but next to zero.
    pub fn between_points(&self) -> Vec<(f64, f64)> {
        let middle = |pair: &[f64]| match pair[0] > 0.0 {
            true => (pair[0] * pair[1]).sqrt(),
            false => 0.5 * (pair[0] + pair[1]),
        };
        let [interferences, rates] = [&self.axes().interference, &self.axes().slip_rate]
            .map(|axis| axis.windows(2).map(middle).collect::<Vec<_>>());
        interferences.iter().flat_map(|omega| rates.iter().map(move |rate| (*omega, *rate))).collect()
    }

    /// Errors of each quantity that has any values, relative to the value (of temperatures: to the
    /// rise above the initial one).
    pub fn error_statistics(&self) -> Vec<ErrorStatistics> {
        let validation = self.cross_validation();
        let interpolated = self.clone().interpolated();
        let of = |quantity: Quantity| {
            let base = quantity.origin(self.metadata().temperature);
            /// Over the largest value: smaller values are rounding errors.
            const NOTHING: f64 = 1e-9;
            let known = self.grid().filter_map(|at| Some((at, self.cell(at.0, at.1)?[quantity])));
            let known: Vec<_> = known.filter(|(_, estimate)| estimate.value.is_finite()).collect();
            let size = |value: f64| (value - base).abs();
            let scale = known.iter().map(|(_, estimate)| size(estimate.value)).fold(0.0, f64::max);
            let (mut errors, mut range) = (Vec::new(), (f64::INFINITY, f64::NEG_INFINITY));
            for (at, estimate) in known {
                range = (range.0.min(estimate.value), range.1.max(estimate.value));
                // The temperature rise of a cell without heat has no relative error.
                let nothing = size(estimate.value) <= NOTHING * scale;
                errors.push((if nothing { 0.0 } else { estimate.error / size(estimate.value) }, at));
            }
            errors.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (largest, largest_at) = *errors.last()?;
            Some(ErrorStatistics {
                quantity,
                range,
                median: errors[errors.len() / 2].0,
                largest,
                largest_at,
                interpolation: validation.worst(quantity).error,
                between: between_points(&interpolated, quantity, NOTHING * scale),
            })
        };
        Quantity::SCALARS.into_iter().filter_map(of).collect()
    }

    /// Cells by their state.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for (i, j) in self.grid() {
            match self.status(i, j) {
                Status::Done(_) => counts.done += 1,
                Status::NotRun => counts.not_run += 1,
                Status::Failed(_) => counts.failed += 1,
            }
        }
        counts
    }

    /// Run times of all cells together, s.
    pub fn cost(&self) -> f64 {
        let times = self.grid().filter_map(|(i, j)| Some(self.cell(i, j)?.wall_time));
        times.filter(|time| time.is_finite()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{Axes, Cell, Metadata};

    #[test]
    fn median_largest_and_where() {
        let axes =
            Axes { interference: vec![1.0], slip_rate: vec![1.0, 2.0, 3.0, 4.0], slip: vec![0.0, 1.0] };
        let metadata = Metadata { temperature: 300.0, ..Metadata::default() };
        let mut table = Slice::new(axes, metadata).unwrap();
        for (j, error) in [0.01, 0.05, 0.02].into_iter().enumerate() {
            let mut cell =
                Cell::new().with(Quantity::Mu, 0.5, error).with(Quantity::TemperatureMax, 310.0, 1.0);
            cell.wall_time = 2.0;
            table.set_cell(0, j, cell).unwrap();
        }
        table.mark_failed(0, 3, "no memory");
        let statistics = table.error_statistics();
        assert_eq!(statistics.len(), 2);
        let mu = statistics[0];
        assert_eq!((mu.median, mu.largest, mu.largest_at, mu.range), (0.04, 0.1, (0, 1), (0.5, 0.5)));
        assert_eq!(statistics[1].largest, 0.1);
        assert_eq!(table.counts(), Counts { done: 3, not_run: 0, failed: 1 });
        assert_eq!(table.cost(), 6.0);
    }
}
