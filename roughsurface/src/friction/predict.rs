//! The prediction, from the press to the friction of every cell.

use crate::friction::rate_dependence::rate_sensitivity;
use crate::friction::rate_law::{RateLaws, choose};
use crate::friction::regime::plasticity_index;
use crate::friction::result::{Friction, Prediction};
use crate::friction::settings::{PredictionError, Settings, in_order};
use crate::friction::slip_curve::{SlipState, resampled, slip_grid};
use crate::friction::sweep::{PressedSurface, SlidingRow, SurfaceSlide, Sweep, loaded_radii};
use crate::friction::warning::Warning;
use crate::surface::query::{ContactLife, Query, Surface};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::law::{AsperityLaw, Estimate};

/// Row (pressure or separation) and slip rate.
type RowAndRate = (usize, usize);

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
    let cells: Vec<RowAndRate> = (0..rows).flat_map(|row| (0..rates).map(move |rate| (row, rate))).collect();
    let place = |(row, rate): RowAndRate| row * rates + rate;
    let pressed = in_order(&cells, |&(row, rate)| sweep.press(row, rate))?;
    let grid = |row: &[PressedSurface]| slip_grid(loaded_radii(row), settings.slip_points);
    let (slip, slips) = (grid(&pressed), pressed.chunks(rates).map(grid).collect::<Vec<_>>());
    let curves = slide_all(&sweep, &pressed, &slips, progress)?;
    let contacts = in_order(&cells, |&(row, rate)| {
        let end = slips[row].len() - 1;
        let separation = curves[place((row, rate))][end].effective_separation();
        Ok(sweep.contacts(rate, slips[row][end], separation)?)
    })?;
    let of_all_ages =
        |life: ContactLife| in_order(&cells, |&cell| sweep.slide_steadily(cell, life, &pressed[place(cell)]));
    let at_first_rate: Vec<&PressedSurface> = pressed.iter().step_by(rates).collect();
    let rate_step = sweep.rate_step(&at_first_rate)?;
    let (sliding, lasting) = (of_all_ages(query.contact_life)?, of_all_ages(ContactLife::Steady)?);

    let mut warnings = Vec::new();
    let mut evaluated = |cell: RowAndRate, curve: Vec<SlipState>| {
        let (place, slips) = (place(cell), &slips[cell.0]);
        let (contacts, sliding, lasting) = (contacts[place], sliding[place], lasting[place]);
        let slide = SurfaceSlide { curve, contacts, sliding, lasting };
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
    let rate_laws = depend_on_rate(&sweep, &at_first_rate, &mut friction, &query.slip_rates)?;
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

/// Sets the derivatives by the slip rate of all cells, and fits the rate laws of the rows.
fn depend_on_rate(
    sweep: &Sweep,
    at_first_rate: &[&PressedSurface],
    friction: &mut [Vec<Friction>],
    slip_rates: &[f64],
) -> Result<Vec<RateLaws>, PredictionError> {
    let rates_around = sweep.rates_around();
    let around = sweep.slide_steadily_around(&rates_around, at_first_rate)?;
    let of_row = |(row, around): (&mut Vec<Friction>, &Vec<Estimate>)| {
        let mu: Vec<Estimate> = row.iter().map(|cell| cell.sliding.mu).collect();
        let (rates, known) =
            if rates_around.is_empty() { (slip_rates, &mu) } else { (&rates_around[..], around) };
        for (cell, rate) in row.iter_mut().zip(slip_rates) {
            cell.rate_sensitivity = rate_sensitivity(rates, known, *rate);
        }
        choose(slip_rates, &mu)
    };
    Ok(friction.iter_mut().zip(&around).map(of_row).collect())
}

/// The states of every cell, row by row, after the `slips` (m) of its row. Each task starts from the surface that is
/// `pressed`, at slips that are its own whatever other rows there are.
fn slide_all(
    sweep: &Sweep,
    pressed: &[PressedSurface],
    slips: &[Vec<f64>],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Vec<SlipState>>, PredictionError> {
    let rates = pressed.len() / slips.len();
    let mut tasks: BTreeMap<(usize, i64), Vec<SlidingRow>> = BTreeMap::new();
    for rate in 0..rates {
        for (row, slips) in slips.iter().enumerate() {
            for slips in slips.chunk_by(|one, next| task_of(*one) == task_of(*next)) {
                let pressed = &pressed[row * rates + rate];
                tasks.entry((rate, task_of(slips[0]))).or_default().push(SlidingRow { row, slips, pressed });
            }
        }
    }
    let tasks: Vec<(usize, Vec<SlidingRow>)> =
        tasks.into_iter().map(|((rate, _), rows)| (rate, rows)).collect();
    let (done, total) = (AtomicUsize::new(0), rates * slips.iter().map(Vec::len).sum::<usize>());
    let states = in_order(&tasks, |(rate, rows)| {
        let states = sweep.slide(*rate, rows);
        let count: usize = rows.iter().map(|row| row.slips.len()).sum();
        progress(done.fetch_add(count, Ordering::Relaxed) + count, total);
        states
    })?;
    let mut curves = vec![Vec::new(); pressed.len()];
    for ((rate, rows), states) in tasks.iter().zip(states) {
        for (row, states) in rows.iter().zip(states) {
            curves[row.row * rates + rate].extend(states);
        }
    }
    Ok(curves)
}

/// Number of the task of a slip (m), by its own value: a third of a decade each.
fn task_of(slip: f64) -> i64 {
    if slip > 0.0 { (3.0 * slip.log10()).floor() as i64 } else { i64::MIN }
}
