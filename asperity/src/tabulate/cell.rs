//! Cells of a table: scalars of a run, and its histories on the slips that all cells share.

use tables::functions::{Accuracy, root_of};
use tables::interpolation::steffen::Steffen;
use tables::quantity::{Estimate, Quantity, Scalars};
use tables::table::Cell;

use crate::simulate::outcome::Outcome;
use crate::solver::timings::Timings;

/// Number of intervals between the slips at which histories are stored.
const INTERVALS: usize = 72;
/// First of these slips, over a₀. Elastic contacts slip fully at 2τ_c/(πG*), 0.0009 of copper and 0.005 of 4340 steel,
/// and the friction of a surface rises up to there.
const FIRST_SLIP: f64 = 1e-4;

/// Slips s/a₀ from 0 to `slip_distance` (in a₀), dense at the start; the same for all materials.
pub fn slip_grid(slip_distance: f64) -> Vec<f64> {
    let n = INTERVALS as f64;
    let share = |grading: f64, k: f64| (grading * k / n).sinh() / grading.sinh();
    // The first slip falls from an even division to 1e-19 of the distance.
    let (even, finest) = (1e-3, 40.0);
    let excess = |grading: f64| (slip_distance * share(grading, 1.0) / FIRST_SLIP).ln();
    // A short distance needs no grading.
    let grading = root_of(even, finest, Accuracy::of(1e-12), excess).unwrap_or(even);
    (0..=INTERVALS)
        .map(|k| match k {
            INTERVALS => slip_distance,
            k => slip_distance * share(grading, k as f64),
        })
        .collect()
}

/// A run as it enters the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished {
    /// Scalars, histories on the slips of [`slip_grid`], and warnings.
    pub cell: Cell,
    /// Time of the run by part of the computation; zero for a run that was taken from a journal or a table.
    pub timings: Timings,
    /// Notes of the run's account.
    pub notes: Vec<String>,
}

impl Finished {
    /// The results of a cell that a table has.
    pub fn of_table(cell: &Cell) -> Self {
        Self { cell: cell.clone(), timings: Timings::default(), notes: Vec::new() }
    }

    /// The part of `outcome` that a table stores; `temperature` is that at the start, K.
    pub fn new(outcome: &Outcome, slips: &[f64], temperature: f64) -> Self {
        let mut cell = Cell {
            scalars: bounded(&outcome.scalars, temperature),
            steady: outcome.steady,
            wall_time: outcome.account.wall_time,
            warnings: outcome.account.warnings.iter().map(ToString::to_string).collect(),
            ..Cell::new()
        };
        for (quantity, history) in resample(outcome, slips, temperature) {
            cell = cell.with_history(quantity, history);
        }
        let notes = outcome.account.notes.iter().map(ToString::to_string).collect();
        Self { cell, timings: outcome.account.timings, notes }
    }
}

/// Scalars whose unknown errors are as large as the values, temperatures counted from the initial one: what is
/// interpolated between cells needs a bound.
fn bounded(scalars: &Scalars, temperature: f64) -> Scalars {
    Scalars::from_fn(|quantity| {
        let Estimate { value, error } = scalars[quantity];
        let bound = (value - quantity.origin(temperature)).abs();
        Estimate { value, error: if error.is_nan() { bound } else { error } }
    })
}

/// Histories of a table at the slips `slips` (in a₀), from the pressed state at the initial
/// `temperature` on; NaN beyond the slide.
fn resample(outcome: &Outcome, slips: &[f64], temperature: f64) -> Vec<(Quantity, Vec<f64>)> {
    let radius = outcome.scalars[Quantity::ContactRadius].value;
    // The pressed state, then the rows of the slide; a row at the slip of the one before replaces it.
    let mut abscissae = vec![0.0];
    let mut rows = vec![None];
    for (row, &slip) in outcome.slide.column(Quantity::Slip).iter().enumerate() {
        match slip > abscissae[abscissae.len() - 1] {
            true => {
                abscissae.push(slip);
                rows.push(Some(row));
            }
            false => *rows.last_mut().expect("not empty") = Some(row),
        }
    }
    // The last row may miss the end of the slide by rounding.
    let end = abscissae[abscissae.len() - 1] * (1.0 + 1e-9);
    let pressed = |quantity| outcome.press.last(quantity).unwrap_or(f64::NAN);
    let resampled = |quantity: Quantity| -> Vec<f64> {
        let start = match quantity {
            Quantity::Load => pressed(Quantity::LoadPress),
            Quantity::Area => pressed(Quantity::AreaPress),
            quantity => quantity.origin(temperature),
        };
        let column = outcome.slide.column(quantity);
        let values = rows.iter().map(|row| row.map_or(start, |row| column[row])).collect();
        let curve = Steffen::new(abscissae.clone(), values);
        let value = |slip: f64| if slip <= end { curve.value(slip) } else { f64::NAN };
        slips.iter().map(|slip| value(slip * radius)).collect()
    };
    let history = |quantity| match quantity {
        // From the resampled forces, so that the three histories agree at every slip.
        Quantity::Mu => {
            let (friction, load) = (resampled(Quantity::Friction), resampled(Quantity::Load));
            friction.iter().zip(&load).map(|(q, p)| q / p).collect()
        }
        quantity => resampled(quantity),
    };
    Quantity::TABLE_HISTORIES.into_iter().map(|quantity| (quantity, history(quantity))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::fake;

    #[test]
    fn slips_rise_from_zero_to_the_end() {
        for distance in [0.001, 0.02, 2.0, 20.0] {
            let slips = slip_grid(distance);
            assert_eq!((slips[0], slips[INTERVALS]), (0.0, distance));
            assert!(slips.windows(2).all(|pair| pair[1] > pair[0]));
            // Weakening varies with the logarithm of slip.
            let late = slips[1..].windows(2).skip(INTERVALS / 2);
            assert!(late.map(|pair| pair[1] / pair[0]).fold(1.0, f64::max) < 1.2);
        }
        // Partial slip of copper, and of 4340 steel.
        let until = |end: f64| slip_grid(2.0).iter().filter(|slip| (1e-9..=end).contains(*slip)).count();
        assert_eq!((until(0.0009), until(0.005)), (7, 21));
    }

    fn outcome() -> Outcome {
        fake::outcome(&fake::scene(20.0, 1.0))
    }

    fn cell(outcome: &Outcome) -> Cell {
        Finished::new(outcome, &slip_grid(2.0), 298.0).cell
    }

    #[test]
    fn histories_start_unloaded_and_end_with_the_last_step() {
        let outcome = outcome();
        let cell = cell(&outcome);
        let last = |quantity| outcome.slide.last(quantity).unwrap();
        let ends = |quantity| {
            let values = cell.history(quantity);
            (values[0], *values.last().unwrap())
        };
        assert_eq!(ends(Quantity::Friction), (0.0, last(Quantity::Friction)));
        assert_eq!(ends(Quantity::Load), (last(Quantity::Load), last(Quantity::Load)));
        assert_eq!(ends(Quantity::TemperatureMax), (298.0, last(Quantity::TemperatureMax)));
        assert_eq!(ends(Quantity::Mu), (0.0, last(Quantity::Friction) / last(Quantity::Load)));
        assert_eq!(cell[Quantity::Mu], outcome.scalars[Quantity::Mu]);
    }

    #[test]
    fn unknown_errors_have_the_values_as_bounds() {
        let mut outcome = outcome();
        outcome.scalars = Scalars::from_fn(|_| Estimate { value: 400.0, error: f64::NAN });
        let cell = cell(&outcome);
        assert_eq!((cell[Quantity::Load].error, cell[Quantity::TemperatureMax].error), (400.0, 102.0));
    }

    #[test]
    fn linear_histories_are_kept() {
        let mut outcome = outcome();
        let friction = outcome.slide.column(Quantity::Slip).iter().map(|slip| 3.0 * slip).collect();
        *outcome.slide.column_mut(Quantity::Friction) = friction;
        let radius = outcome.scalars[Quantity::ContactRadius].value;
        for (slip, friction) in slip_grid(2.0).iter().zip(cell(&outcome).history(Quantity::Friction)) {
            assert!((friction - 3.0 * slip * radius).abs() < 1e-15);
        }
    }

    #[test]
    fn nothing_is_invented_beyond_the_end_of_a_slide() {
        let mut outcome = outcome();
        outcome.slide.truncate(20);
        let cell = cell(&outcome);
        let friction = cell.history(Quantity::Friction);
        assert!(friction.last().unwrap().is_nan());
        assert!(friction[3].is_finite());
    }
}
