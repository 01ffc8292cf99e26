//! The prediction, from the press to the friction of every cell.

use crate::friction::rate_dependence::rate_sensitivity;
use crate::friction::rate_law;
use crate::friction::regime::plasticity_index;
use crate::friction::result::{Friction, Prediction};
use crate::friction::settings::{PredictionError, Settings};
use crate::friction::slip_curve::SlipState;
use crate::friction::sweep::{Slide, Sweep};
use crate::friction::warning::Warning;
use crate::integral::separation::EquilibriumState;
use crate::surface::query::{ContactLife, Query, Surface};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::law::{AsperityLaw, Estimate};

/// Neighbouring slips that one thread computes in order, each starting from the one before.
const SLIPS_PER_TASK: usize = 20;

/// Predicts the friction of `surface` from the `law` of its asperities.
///
/// `progress` receives the number of slips done and the total; the result does not depend on the number of
/// threads, because every integral is computed by one.
pub fn predict(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Prediction, PredictionError> {
    let sweep = Sweep::new(law, surface, query, settings)?;
    let pressed = sweep.press_all()?;
    let slip = sweep.slip_grid(&pressed);
    let states = slide_all(&sweep, &slip, &pressed, progress)?;
    let end = slip.len() - 1;
    let at_end = |rate: usize| states[rate][end].iter().map(SlipState::effective_separation);
    let rate_by_rate = (0..states.len()).into_par_iter();
    let contacts: Vec<_> =
        rate_by_rate.map(|rate| sweep.contacts(rate, slip[end], at_end(rate))).collect::<Result<_, _>>()?;

    let of_all_ages = |life: ContactLife| -> Result<Vec<_>, PredictionError> {
        let rates = (0..states.len()).into_par_iter();
        rates.map(|rate| sweep.slide_steadily(rate, life, &pressed[rate])).collect()
    };
    let rate_step = sweep.rate_step(&pressed[0])?;
    let (sliding, lasting) = (of_all_ages(query.contact_life)?, of_all_ages(ContactLife::Steady)?);

    let (rows, rates) = (query.loading.values().len(), query.slip_rates.len());
    let mut warnings = Vec::new();
    let mut cell = |row: usize, rate: usize| {
        let slide = Slide {
            curve: states[rate].iter().map(|rows| rows[row]).collect(),
            contacts: contacts[rate][row],
            sliding: sliding[rate][row],
            lasting: lasting[rate][row],
        };
        sweep.evaluate((row, rate), &pressed[rate][row], &slip, slide, &mut warnings)
    };
    let mut friction: Vec<Vec<Friction>> =
        (0..rows).map(|row| (0..rates).map(|rate| cell(row, rate)).collect()).collect();
    if lasting.iter().flatten().any(|state| state.unsteady > 0.0 && state.mu.value.is_nan()) {
        warnings.push(Warning::NoSteadyFriction);
    }
    let mut rate_laws = Vec::new();
    for row in &mut friction {
        let mu: Vec<Estimate> = row.iter().map(|cell| cell.sliding.mu).collect();
        for (cell, sensitivity) in row.iter_mut().zip(rate_sensitivity(&query.slip_rates, &mu)) {
            cell.rate_sensitivity = sensitivity;
        }
        rate_laws.push(rate_law::choose(&query.slip_rates, &mu));
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

/// For every slip rate and slip the states under every pressure or separation. Each task starts from the
/// press.
fn slide_all(
    sweep: &Sweep,
    slip: &[f64],
    pressed: &[Vec<EquilibriumState>],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Vec<Vec<SlipState>>>, PredictionError> {
    let tasks: Vec<(usize, &[f64])> = (0..pressed.len())
        .flat_map(|rate| slip.chunks(SLIPS_PER_TASK).map(move |slips| (rate, slips)))
        .collect();
    let (done, total) = (AtomicUsize::new(0), pressed.len() * slip.len());
    let states: Vec<_> = tasks
        .into_par_iter()
        .map(|(rate, slips)| {
            let states = sweep.slide(rate, slips, &pressed[rate]);
            progress(done.fetch_add(slips.len(), Ordering::Relaxed) + slips.len(), total);
            states
        })
        .collect();
    // In order: the failure that is reported does not depend on the threads.
    let states = states.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
    Ok(states.chunks(slip.len()).map(<[_]>::to_vec).collect())
}
