//! Finite surfaces: friction of surfaces with a given number of asperities, their heights drawn at random,
//! and its scatter from one surface to the next.
//!
//! [`friction`](crate::friction) gives the mean of a surface of infinite extent; a specimen of a few hundred
//! asperities, of which a dozen touch, is one draw.
//!
//! Depends on `friction`, `integral` and `surface`. Chapter "Rough surfaces" of the book.

mod drawn;
mod states;
#[cfg(test)]
mod tests;

use crate::friction::warning::{Place, Warning};
use crate::friction::{PredictionError, Settings};
use crate::integral::asperity_at_slip::Additional;
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::integral::predictor::Predictor;
use crate::integral::separation::separation_for;
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::sampling::scatter::Scatter;
use crate::surface::heights::Random;
use crate::surface::query::{LoadingControl, NormalLoading, Query, Surface};
use drawn::DrawnSurface;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
pub use states::SampledState;
use states::{InfiniteSurface, LawAtRate, Summits};
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::law::{AboveRange, AsperityLaw, LookupError};

/// Request of finite surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Asperities of one surface, in contact or not.
    pub asperities: usize,
    /// Surfaces drawn.
    pub realizations: usize,
    /// Seed of the heights: the same seed gives the same surfaces.
    pub seed: u64,
    /// Slip after which friction is read, m; none for contacts of all ages of their life.
    pub slip: Option<f64>,
}

/// Results of the finite surfaces.
#[derive(Clone, Debug)]
pub struct Samples {
    pub query: Query,
    pub sampling: Sampling,
    pub law: String,
    /// One row per pressure or separation, one column per slip rate, then the surfaces.
    pub states: Vec<Vec<Vec<SampledState>>>,
    /// Of the surface of infinite extent, in the same rows and columns, where it has an equilibrium.
    pub infinite: Vec<Vec<Option<SampledState>>>,
    pub warnings: Vec<Warning>,
}

impl Samples {
    /// Scatter of a quantity at one pressure or separation and slip rate.
    pub fn scatter(&self, row: usize, rate: usize, quantity: impl Fn(&SampledState) -> f64) -> Scatter {
        Scatter::of(self.states[row][rate].iter().map(quantity))
    }
}

/// Draws finite surfaces and slides them, by [`Sampling::slip`] or steadily.
///
/// Each surface has a seed of its own, drawn in order, so the result does not depend on the number of
/// threads; the same surfaces are loaded with every pressure and slip rate. Under load control the
/// separation is that of the slide; under displacement control that of the pressure before it.
pub fn sample(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    sampling: &Sampling,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Samples, PredictionError> {
    query.check_slip_rates(law, &surface.asperity_radius)?;
    let with_rate = |&rate: &f64| {
        let before = Asperities::new(law, surface, rate)?;
        let after = before.map(|asperity| match sampling.slip {
            Some(slip) => asperity.after(slip).with(Additional::StuckLoad),
            None => asperity.of_all_ages(query.contact_life).with(Additional::UnsteadyLoad),
        });
        Ok(LawAtRate { after, before })
    };
    let laws: Vec<LawAtRate> = query.slip_rates.iter().map(with_rate).collect::<Result<_, LookupError>>()?;
    let predictors = predictors(&laws, surface, query, settings);
    let mut seeds = Random::seed_from_u64(sampling.seed);
    let seeds: Vec<u64> = (0..sampling.realizations).map(|_| seeds.random()).collect();
    let done = AtomicUsize::new(0);
    let surfaces: Vec<_> = seeds
        .into_par_iter()
        .map(|seed| {
            let states = DrawnSurface::new(surface, sampling.asperities, seed)
                .and_then(|drawn| drawn.states(law, &laws, &predictors, query, settings))
                .and_then(|states| states.into_iter().collect::<Result<Vec<_>, _>>());
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, sampling.realizations);
            states
        })
        .collect();
    let surfaces = surfaces.into_iter().collect::<Result<Vec<_>, _>>()?;

    let infinite = InfiniteSurface { surface, asperities: sampling.asperities };
    let mut infinite = infinite.states(law, &laws, &predictors, query, settings)?.into_iter().map(Result::ok);

    let rates = query.slip_rates.len();
    let cell = |cell: usize| surfaces.iter().map(|surface| surface[cell]).collect();
    let rows = query.loading.values().len();
    let infinite: Vec<Vec<Option<SampledState>>> =
        (0..rows).map(|_| infinite.by_ref().take(rates).collect()).collect();
    let states: Vec<Vec<Vec<SampledState>>> =
        (0..rows).map(|row| (0..rates).map(|rate| cell(row * rates + rate)).collect()).collect();
    let warnings = warnings(law, query, sampling.slip, &states, &infinite);
    Ok(Samples { query: query.clone(), sampling: *sampling, law: law.name(), states, infinite, warnings })
}

/// Where finite surfaces search for their separation: at that of the surface of infinite extent, for every
/// pressure or separation and slip rate, row by row.
fn predictors(laws: &[LawAtRate], surface: &Surface, query: &Query, settings: &Settings) -> Vec<Predictor> {
    let heights = surface.heights.as_ref();
    let mut predictor = Predictor::at(heights.mode(), heights);
    let mut predictors = Vec::new();
    for &value in query.loading.values() {
        for law in laws {
            let asperities = if query.control == LoadingControl::Load { &law.after } else { &law.before };
            let mut integral =
                SurfaceIntegral::new(asperities, heights, surface.asperity_density, settings.tolerance);
            predictor = match query.loading {
                NormalLoading::Separation(_) => Predictor::at(value, heights),
                // A drawn surface may have an equilibrium where the infinite one has none.
                NormalLoading::Pressure(_) => {
                    separation_for(&mut integral, heights, value, predictor, settings.tolerance)
                        .map_or(predictor, |equilibrium| equilibrium.predictor())
                }
            };
            predictors.push(Predictor { sensitivity: None, ..predictor });
        }
    }
    predictors
}

fn warnings(
    law: &dyn AsperityLaw,
    query: &Query,
    slip: Option<f64>,
    states: &[Vec<Vec<SampledState>>],
    infinite: &[Vec<Option<SampledState>>],
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (row, columns) in states.iter().enumerate() {
        for (rate, surfaces) in columns.iter().enumerate() {
            let at = || Place::of(query, row, rate);
            let outside = surfaces.iter().map(|one| one.state.outside).fold(0.0, f64::max);
            if outside > NEGLIGIBLE_SHARE && law.above_range() == AboveRange::Extrapolated {
                warnings.push(Warning::SamplesExtrapolated { at: at(), share: outside });
            }
            if let Some(SampledState { state, .. }) = infinite[row][rate]
                && state.unknown_load > NEGLIGIBLE_SHARE
            {
                let (share, known) = (state.unknown_load, !state.mu.value.is_nan());
                warnings.push(match slip {
                    Some(_) => Warning::SamplesNotSliding { at: at(), share },
                    None => Warning::Unsteady { at: at(), share, known },
                });
            }
            let idle = surfaces.iter().filter(|one| one.contacts == 0.0).count();
            if idle > 0 {
                warnings.push(Warning::SamplesWithoutContact { at: at(), idle, count: surfaces.len() });
            }
        }
    }
    let outside = states.iter().flatten().flatten().map(|one| one.state.outside);
    warnings.extend(Warning::beyond_formulae(law, outside));
    warnings
}
