//! Interpolation across failed cells.

use super::coordinates;
use super::nodes::reason;
use crate::law::Estimate;
use crate::quantity::Quantity;
use crate::table::{Axes, Cell, Slice};

impl Slice {
    /// The slice with points that failed or were not run interpolated where results lie on both sides
    /// of them, along the interference or along the slip rate.
    ///
    /// Values are interpolated linearly in the logarithms (of quantities that are positive) between
    /// the nearest results, over the nearer of both pairs where there are two. The error is that of
    /// the results at both ends and half their difference. Each such cell has a warning. Cells
    /// at the edge of the grid stay without results: there is no extrapolation.
    ///
    /// Interferences and slip rates without any result are left out, so that the slice has the range and the errors of
    /// interpolation of its results, also where points were added for a tolerance.
    ///
    /// With it the points of this slice that were interpolated or left out; others without a result are missing still.
    pub fn with_failed_cells_interpolated(&self) -> (Slice, Vec<(usize, usize)>) {
        let mut table = self.of_results();
        let gaps = table.clone();
        for (i, j) in gaps.grid().filter(|(i, j)| gaps.cell(*i, *j).is_none()) {
            let Some(mut cell) = gaps.across(i, j) else { continue };
            let reason = reason(gaps.status(i, j));
            cell.warnings = vec![format!("interpolated from neighbouring points ({reason})")];
            table.set_cell(i, j, cell).expect("as long as its neighbours");
        }
        let without = |slice: &Slice| slice.grid().filter(|(i, j)| slice.cell(*i, *j).is_none()).collect();
        let missing: Vec<(usize, usize)> = without(&table);
        let missing: Vec<(f64, f64)> = missing.into_iter().map(|(i, j)| table.coordinates(i, j)).collect();
        let mut passed: Vec<(usize, usize)> = without(self);
        passed.retain(|(i, j)| !missing.contains(&self.coordinates(*i, *j)));
        if !passed.is_empty() {
            table.metadata_mut().comment = table.warnings().join("\n");
            if table.shape() != self.shape() {
                table.metadata_mut().interpolation_tolerance = None;
            }
        }
        (table, passed)
    }

    /// The slice without the interferences and slip rates that have no result; unchanged if there is none at all.
    fn of_results(&self) -> Slice {
        let Axes { interference, slip_rate, slip } = self.axes().clone();
        let (rows, columns) = self.shape();
        let has_result = |(i, j): (usize, usize)| self.cell(i, j).is_some();
        let keep = |axis: &[f64], is_kept: &dyn Fn(usize) -> bool| -> Vec<f64> {
            axis.iter().enumerate().filter(|(k, _)| is_kept(*k)).map(|(_, value)| *value).collect()
        };
        let axes = Axes {
            interference: keep(&interference, &|i| (0..columns).any(|j| has_result((i, j)))),
            slip_rate: keep(&slip_rate, &|j| (0..rows).any(|i| has_result((i, j)))),
            slip,
        };
        match axes.interference.is_empty() {
            true => self.clone(),
            false => self.regridded(axes).expect("a part of the axes"),
        }
    }

    /// A cell between its nearest neighbours with results.
    fn across<'a>(&'a self, i: usize, j: usize) -> Option<Cell> {
        let [log_interference, rate_coordinate] = coordinates(self.axes());
        // Their distance, the fraction of it, and the neighbours.
        let pair = |axis: &[f64], at: usize, cell: &dyn Fn(usize) -> Option<&'a Cell>| {
            let known = |k: usize| Some((axis[k], cell(k)?));
            let (start, before) = (0..at).rev().find_map(known)?;
            let (end, after) = (at + 1..axis.len()).find_map(known)?;
            Some((end - start, (axis[at] - start) / (end - start), [before, after]))
        };
        let along_interference = pair(&log_interference, i, &|k| self.cell(k, j));
        let along_slip_rate = pair(&rate_coordinate, j, &|k| self.cell(i, k));
        let pairs = along_interference.into_iter().chain(along_slip_rate);
        let (_, t, ends) = pairs.min_by(|one, other| one.0.total_cmp(&other.0))?;
        Some(blended(ends, t, self.metadata().temperature))
    }
}

/// Between two cells, at the fraction `t` from the first to the second; `base` is the temperature
/// from which temperature rises are counted.
fn blended(ends: [&Cell; 2], t: f64, base: f64) -> Cell {
    let mut cell = Cell::new();
    for quantity in Quantity::SCALARS {
        let [Estimate { value: a, error: e }, Estimate { value: b, error: f }] =
            ends.map(|cell| cell[quantity]);
        let value = between(quantity, base, [a, b], t);
        cell = cell.with(quantity, value, (1.0 - t) * e + t * f + 0.5 * (a - b).abs());
    }
    for quantity in Quantity::TABLE_HISTORIES {
        let pairs = ends[0].history(quantity).iter().zip(ends[1].history(quantity));
        let history = pairs.map(|(a, b)| between(quantity, base, [*a, *b], t)).collect();
        cell = cell.with_history(quantity, history);
    }
    cell.steady = ends.iter().all(|cell| cell.steady);
    cell.wall_time = 0.0;
    cell
}

fn between(quantity: Quantity, base: f64, ends: [f64; 2], t: f64) -> f64 {
    let [a, b] = ends.map(|value| quantity.above_origin(value, base));
    let above = match a > 0.0 && b > 0.0 {
        true => ((1.0 - t) * a.ln() + t * b.ln()).exp(),
        false => (1.0 - t) * a + t * b,
    };
    quantity.origin(base) + above
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::LookupError;
    use crate::table::Metadata;

    /// Power laws over 4 interferences and 4 slip rates.
    fn table() -> Slice {
        let axes = Axes {
            interference: vec![1.0, 2.0, 4.0, 8.0],
            slip_rate: vec![0.1, 1.0, 10.0, 100.0],
            slip: vec![0.0, 1.0],
        };
        let metadata = Metadata { temperature: 300.0, asperity_radius: 1e-3, ..Metadata::default() };
        let cell = |omega: f64, rate: f64| {
            let load = omega.powf(1.5) * rate.powf(-0.1);
            Cell::new()
                .with(Quantity::TemperatureMax, 300.0 + 50.0 * rate.powf(0.5), 1.0)
                .with(Quantity::Load, load, 0.02 * load)
                .with(Quantity::Friction, 0.3 * load, 0.0)
                .with(Quantity::Area, omega, 0.0)
                .with(Quantity::ContactRadius, 1e-5 * omega.sqrt(), 0.0)
                .with_history(Quantity::Load, vec![load, load])
                .with_history(Quantity::Friction, vec![0.0, 0.3 * load])
                .with_history(Quantity::Area, vec![omega, omega])
        };
        Slice::filled(axes, metadata, cell).unwrap()
    }

    #[test]
    fn failed_cells_inside_are_interpolated_with_a_larger_error_and_a_warning() {
        let whole = table();
        let mut table = whole.clone();
        table.mark_failed(1, 2, "no convergence");
        assert!(table.clone().interpolated().estimate(Quantity::Load, 1e-3, 2.0, 10.0).is_err());
        let (whole_again, filled) = table.with_failed_cells_interpolated();
        assert_eq!(filled, [(1, 2)]);
        let (cell, truth) = (whole_again.cell(1, 2).unwrap(), whole.cell(1, 2).unwrap());
        for quantity in [Quantity::Load, Quantity::Friction, Quantity::TemperatureMax] {
            let (found, actual) = (cell[quantity], truth[quantity]);
            assert!((found.value / actual.value - 1.0).abs() < 1e-12, "{quantity:?}");
            assert!(found.error >= actual.error, "{quantity:?}");
        }
        assert!(cell[Quantity::Load].error > 0.3 * cell[Quantity::Load].value);
        assert_eq!(cell.history(Quantity::Friction)[0], 0.0);
        let warning = "interpolated from neighbouring points (the run failed: no convergence)";
        assert_eq!(cell.warnings, [warning]);
        assert!(whole_again.metadata().comment.contains(warning));
        assert!(whole_again.clone().interpolated().estimate(Quantity::Load, 1e-3, 2.0, 10.0).is_ok());
    }

    #[test]
    fn edges_are_interpolated_along_the_edge_and_corners_not_at_all() {
        let mut table = table();
        table.mark_failed(0, 1, "a");
        table.mark_failed(3, 3, "b");
        let (whole_again, filled) = table.with_failed_cells_interpolated();
        assert_eq!(filled, [(0, 1)]);
        assert_eq!(whole_again.status(3, 3), table.status(3, 3));
        assert_eq!(whole_again.missing(), []);
    }

    #[test]
    fn interferences_and_slip_rates_without_results_are_left_out() {
        let mut table = table();
        for k in 0..4 {
            table.mark_failed(3, k, "a");
            table.mark_failed(k, 1, "b");
        }
        let load = |table: &Slice, interference, rate| {
            table.clone().interpolated().estimate(Quantity::Load, 1e-3, interference, rate)
        };
        // Above 4 the whole slice has a row that failed, and is not extrapolated as one that ends there.
        assert!(load(&table, 4.0, 10.0).is_ok());
        for (interference, rate) in [(4.1, 10.0), (8.0, 10.0), (9.0, 10.0), (2.0, 2.0)] {
            assert!(
                matches!(load(&table, interference, rate), Err(LookupError::Missing { .. })),
                "{interference}"
            );
        }
        let (rest, filled) = table.with_failed_cells_interpolated();
        assert_eq!((rest.shape(), filled.len()), ((3, 3), 7));
        assert_eq!(rest.axes().interference, [1.0, 2.0, 4.0]);
        assert_eq!(rest.axes().slip_rate, [0.1, 10.0, 100.0]);
        assert!(load(&rest, 9.0, 2.0).is_ok());
    }

    #[test]
    fn whole_tables_stay_as_they_are() {
        let table = table();
        assert_eq!(table.with_failed_cells_interpolated(), (table.clone(), vec![]));
    }
}
