//! Histories of a cell as quantities of the state: values, slopes and errors along the slip axis.

use super::steffen;
use crate::quantity::{Estimate, Quantity};
use crate::table::Slice;

/// Quantities of the state after a slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StateQuantity {
    Load,
    Friction,
    Area,
    /// Rise of T_max above the initial temperature, which follows power laws.
    TemperatureRise,
}

pub(super) const STATE_QUANTITIES: usize = 4;

const RISE: usize = StateQuantity::TemperatureRise as usize;

/// One number for each [`StateQuantity`].
pub(super) type Values = [f64; STATE_QUANTITIES];

/// Place of Q/P among the errors.
pub(super) const COEFFICIENT: usize = STATE_QUANTITIES;

/// Relative errors of each [`StateQuantity`] and of Q/P, in which errors of Q and P of the same sign cancel.
pub(super) type Errors = [f64; STATE_QUANTITIES + 1];

/// Quantity of each [`StateQuantity`] and of Q/P. The last has no history of its own.
const QUANTITIES: [Quantity; STATE_QUANTITIES + 1] =
    [Quantity::Load, Quantity::Friction, Quantity::Area, Quantity::TemperatureMax, Quantity::Mu];

/// Scalars up to sliding inception in place of [`QUANTITIES`], in the same order.
const BEFORE_SLIDING: [Quantity; STATE_QUANTITIES + 1] = [
    Quantity::LoadPress,
    Quantity::FrictionStatic,
    Quantity::AreaPress,
    Quantity::TemperatureMax,
    Quantity::MuStatic,
];

/// States of a cell along the slip axis with their slopes; none without complete results. `base` is the initial
/// temperature.
pub(super) fn history(table: &Slice, i: usize, j: usize, base: f64) -> Option<Vec<[Values; 2]>> {
    // A slip has its place on the slip axis by a₀.
    let cell = (table.cell(i, j)).filter(|cell| cell[Quantity::ContactRadius].value > 0.0)?;
    let slip = &table.axes().slip;
    let columns: [Vec<f64>; STATE_QUANTITIES] = std::array::from_fn(|field| {
        let quantity = QUANTITIES[field];
        cell.history(quantity).iter().map(|value| quantity.above_origin(*value, base)).collect()
    });
    let mechanical = &columns[..StateQuantity::TemperatureRise as usize];
    if mechanical.iter().flatten().any(|value| !value.is_finite()) {
        return None;
    }
    let mut states: Vec<Values> = (0..slip.len()).map(|k| std::array::from_fn(|f| columns[f][k])).collect();
    let rise = Quantity::TemperatureMax.above_origin(cell[Quantity::TemperatureMax].value, base);
    if rise > 0.0 && states.iter().all(|state| state[RISE] == 0.0) {
        for (state, share) in states.iter_mut().zip(heating(table, i, base)?) {
            state[RISE] = share * rise;
        }
    }
    Some(with_slopes(slip, states))
}

/// Share of the rise of a cell at each slip, where the cell states the rise of a slide in which heat was left out: that of
/// the slowest slide of the row with heat, without one the whole rise from inception on.
fn heating(table: &Slice, i: usize, base: f64) -> Option<Vec<f64>> {
    let (_, rates) = table.shape();
    let slips = &table.axes().slip;
    let rises = |j: usize| -> Option<Vec<f64>> {
        let history = table.cell(i, j)?.history(Quantity::TemperatureMax).iter();
        let rises: Vec<f64> =
            history.map(|value| Quantity::TemperatureMax.above_origin(*value, base)).collect();
        let highest = rises.iter().copied().fold(0.0, f64::max);
        (highest > 0.0).then(|| rises.into_iter().map(|rise| rise / highest).collect())
    };
    (0..rates).find_map(rises).or_else(|| {
        let cell = (0..rates).find_map(|j| table.cell(i, j))?;
        let begins = cell[Quantity::InceptionSlip].value / cell[Quantity::ContactRadius].value;
        let begun = |slip: &f64| *slip > 0.0 && (begins.is_nan() || *slip >= begins);
        Some(slips.iter().map(|slip| f64::from(u8::from(begun(slip)))).collect())
    })
}

/// States along the slip axis, each with its slope.
pub(super) fn with_slopes(slip: &[f64], states: Vec<Values>) -> Vec<[Values; 2]> {
    let slopes: [Vec<f64>; STATE_QUANTITIES] = std::array::from_fn(|f| {
        let column: Vec<f64> = states.iter().map(|state| state[f]).collect();
        steffen::slopes(slip, &column)
    });
    let slope = |k: usize| std::array::from_fn(|f| slopes[f][k]);
    (states.into_iter().enumerate()).map(|(k, state)| [state, slope(k)]).collect()
}

/// Relative error of the results of a cell at each slip: from those of static friction, and of load and area after
/// the press, up to inception, along straight lines to those at the end. At rest the rise is exactly 0; its relative error just
/// above rest is that of the next slip rate.
pub(super) fn given_errors(table: &Slice, i: usize, j: usize, base: f64) -> Vec<Errors> {
    let slips = &table.axes().slip;
    let Some(cell) = table.cell(i, j) else {
        return vec![[f64::NAN; STATE_QUANTITIES + 1]; slips.len()];
    };
    let next = (j + 1).min(table.shape().1 - 1);
    let heated = table
        .cell(i, next)
        .filter(|next| table.axes().slip_rate[j] == 0.0 && next[Quantity::TemperatureMax].error.is_finite());
    let relative = |quantity: Quantity| {
        let of = heated.filter(|_| quantity == Quantity::TemperatureMax).unwrap_or(cell);
        let Estimate { value, error } = of[quantity];
        let value = quantity.above_origin(value, base);
        // The temperature of an unheated contact is exact.
        if error == 0.0 || value == 0.0 { 0.0 } else { (error / value).abs() }
    };
    let begins = cell[Quantity::InceptionSlip].value / cell[Quantity::ContactRadius].value;
    let begins = if begins.is_finite() { begins } else { 0.0 };
    let ends = slips.last().copied().unwrap_or(0.0);
    let last = QUANTITIES.map(relative);
    // Without errors at the start, those at the end.
    let first: Errors = std::array::from_fn(|f| match relative(BEFORE_SLIDING[f]) {
        error if error.is_nan() => last[f],
        error => error,
    });
    (slips.iter())
        .map(|slip| {
            let share = if ends > begins { ((slip - begins) / (ends - begins)).clamp(0.0, 1.0) } else { 1.0 };
            std::array::from_fn(|f| first[f] + share * (last[f] - first[f]))
        })
        .collect()
}
