//! The prediction, from the press to the friction of every cell.

use crate::friction::rate_dependence::rate_sensitivity;
use crate::friction::rate_law::choose;
use crate::friction::regime::plasticity_index;
use crate::friction::result::{Friction, Prediction};
use crate::friction::settings::{PredictionError, Settings};
use crate::friction::slip_curve::{SlipState, resampled, slip_grid};
use crate::friction::sweep::{Slide, Sweep, loaded_radii};
use crate::friction::warning::Warning;
use crate::integral::separation::EquilibriumState;
use crate::surface::query::{ContactLife, Query, Surface};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::law::{AsperityLaw, Estimate};

/// Neighbouring slips that one thread computes in order, each starting from the one before.
const SLIPS_PER_TASK: usize = 20;

/// Row (pressure or separation) and slip rate.
type Cell = (usize, usize);

/// Predicts the friction of `surface` from the `law` of its asperities.
///
/// Rows do not depend on each other, but for the slips at which [`Prediction`] states the histories. `progress` receives the
/// number of slips done and the total; the result does not depend on the number of threads, because every integral is
/// computed by one.
pub fn predict(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Prediction, PredictionError> {
    let sweep = Sweep::new(law, surface, query, settings)?;
    let (rows, rates) = (query.loading.values().len(), query.slip_rates.len());
    let cells: Vec<Cell> = (0..rows).flat_map(|row| (0..rates).map(move |rate| (row, rate))).collect();
    let place = |(row, rate): Cell| row * rates + rate;
    let pressed = in_order(&cells, |(row, rate)| sweep.press(row, rate))?;
    let grid = |row: &[EquilibriumState]| slip_grid(loaded_radii(row), settings.slip_points);
    let (slip, slips) = (grid(&pressed), pressed.chunks(rates).map(grid).collect::<Vec<_>>());
    let curves = slide_all(&sweep, &cells, &slips, |cell| &pressed[place(cell)], progress)?;
    let contacts = in_order(&cells, |(row, rate)| {
        let end = slips[row].len() - 1;
        let separation = curves[place((row, rate))][end].effective_separation();
        Ok(sweep.contacts(rate, slips[row][end], separation)?)
    })?;
    let of_all_ages =
        |life: ContactLife| in_order(&cells, |cell| sweep.slide_steadily(cell, life, &pressed[place(cell)]));
    let at_first_rate: Vec<&EquilibriumState> = pressed.iter().step_by(rates).collect();
    let rate_step = sweep.rate_step(&at_first_rate)?;
    let (sliding, lasting) = (of_all_ages(query.contact_life)?, of_all_ages(ContactLife::Steady)?);

    let mut warnings = Vec::new();
    let mut evaluated = |cell: Cell, curve: Vec<SlipState>| {
        let (place, slips) = (place(cell), &slips[cell.0]);
        let (contacts, sliding, lasting) = (contacts[place], sliding[place], lasting[place]);
        let slide = Slide { curve, contacts, sliding, lasting };
        let mut friction = sweep.evaluate(cell, &pressed[place], slips, slide, &mut warnings);
        friction.mu_history = resampled(slips, &friction.mu_history, &slip);
        friction
    };
    let friction: Vec<Friction> =
        cells.iter().zip(curves).map(|(cell, curve)| evaluated(*cell, curve)).collect();
    let mut friction: Vec<Vec<Friction>> = friction.chunks(rates).map(<[_]>::to_vec).collect();
    if lasting.iter().any(|state| state.unknown_load > 0.0 && state.mu.value.is_nan()) {
        warnings.push(Warning::NoSteadyFriction);
    }
    let rates_around = sweep.rates_around();
    let around = sweep.slide_steadily_around(&rates_around, &at_first_rate)?;
    let mut rate_laws = Vec::new();
    for (row, around) in friction.iter_mut().zip(&around) {
        let mu: Vec<Estimate> = row.iter().map(|cell| cell.sliding.mu).collect();
        for (cell, rate) in row.iter_mut().zip(&query.slip_rates) {
            cell.rate_sensitivity = match rates_around.is_empty() {
                true => rate_sensitivity(&query.slip_rates, &mu, *rate),
                false => rate_sensitivity(&rates_around, around, *rate),
            };
        }
        rate_laws.push(choose(&query.slip_rates, &mu));
    }
    let outside = friction.iter().flatten().map(|cell| cell.outside_table);
    warnings.extend(Warning::beyond_formulae(law, outside));
    Ok(Prediction {
        query: query.clone(),
        law: law.name(),
        request: law.request().into(),
        slip,
        friction,
        plasticity_index: plasticity_index(law, surface),
        rate_laws,
        rate_step,
        warnings,
    })
}

/// Of every cell. In order: the failure that is reported does not depend on the threads.
fn in_order<C: Copy + Sync, T: Send>(
    cells: &[C],
    of: impl Fn(C) -> Result<T, PredictionError> + Sync,
) -> Result<Vec<T>, PredictionError> {
    let all: Vec<_> = cells.par_iter().map(|cell| of(*cell)).collect();
    all.into_iter().collect()
}

/// The states of every cell after the `slips` (m) of its row. Each task starts from the surface that is `pressed`.
fn slide_all<'p>(
    sweep: &Sweep,
    cells: &[Cell],
    slips: &[Vec<f64>],
    pressed: impl Fn(Cell) -> &'p EquilibriumState + Sync,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Vec<SlipState>>, PredictionError> {
    let tasks: Vec<(Cell, &[f64])> = cells
        .iter()
        .flat_map(|&cell| slips[cell.0].chunks(SLIPS_PER_TASK).map(move |slips| (cell, slips)))
        .collect();
    let each = slips[0].len();
    let (done, total) = (AtomicUsize::new(0), cells.len() * each);
    let states = in_order(&tasks, |(cell, slips)| {
        let states = sweep.slide(cell, slips, pressed(cell));
        progress(done.fetch_add(slips.len(), Ordering::Relaxed) + slips.len(), total);
        states
    })?;
    Ok(states.concat().chunks(each).map(<[_]>::to_vec).collect())
}
