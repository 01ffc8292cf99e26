//! Finite surfaces: friction of surfaces with a given number of asperities, their heights drawn at random,
//! and its scatter from one surface to the next.
//!
//! [`friction`](crate::friction) gives the mean of a surface of infinite extent; a specimen of a few hundred
//! asperities, of which a dozen touch, is one draw.
//!
//! Depends on `friction`, `integral` and `surface`. Chapter "Rough surfaces" of the book.

mod realization;
mod states;
#[cfg(test)]
mod tests;

use crate::friction::warning::{Place, Warning};
use crate::friction::{PredictionError, Settings, in_order, predict};
use crate::integral::asperity_at_slip::Additional;
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::Predictor;
use crate::integral::separation::separation_for;
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::surface::heights::Random;
use crate::surface::query::{LoadingControl, NormalLoading, Query, Surface};
use rand::{RngExt, SeedableRng};
use realization::Realization;
pub use states::SampledState;
use states::{LawAtRate, SummitLoading, SummitPopulation};
use std::sync::atomic::{AtomicUsize, Ordering};
use tables::law::{AboveRange, AsperityLaw, LookupError};

/// Mean number of contacts of a surface below which its friction may be so skewed that intervals for the mean of 3 to 20 surfaces hold
/// less than 95 %: of 4340 steel 95 % with 6.4 contacts, 78 to 93 % with 1.6, 29 to 83 % with 1.1; of the closed form of Jackson
/// & Green 90 % with 15 and with 2.3, 15 % with 1.03.
const FEW_CONTACTS: f64 = 10.0;

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
    /// States of all surfaces, at every pressure or separation and slip rate, row by row.
    pub states: Vec<Vec<SampledState>>,
    /// States of the surface of infinite extent likewise, where it has an equilibrium.
    pub infinite: Vec<Option<SampledState>>,
    pub warnings: Vec<Warning>,
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
    let plane = MeanPlane::new(query, law)?;
    let loading = SummitLoading { law, query, settings, plane, laws: &laws, predictors: &predictors };
    let mut seeds = Random::seed_from_u64(sampling.seed);
    let seeds: Vec<u64> = (0..sampling.realizations).map(|_| seeds.random()).collect();
    let done = AtomicUsize::new(0);
    let infinite = SummitPopulation {
        heights: surface.heights.as_ref(),
        heights_by_radius: &[],
        density: surface.asperity_density,
        count: sampling.asperities,
    };
    let surfaces: Vec<Vec<SampledState>> = in_order(&seeds, |&seed| {
        let Realization { heights, heights_by_radius } =
            Realization::draw(surface, sampling.asperities, seed);
        let summits =
            SummitPopulation { heights: &heights, heights_by_radius: &heights_by_radius, ..infinite };
        let states = loading.states(&summits).into_iter().collect();
        progress(done.fetch_add(1, Ordering::Relaxed) + 1, sampling.realizations);
        states
    })?;
    let infinite = loading.states(&infinite);
    let unknown = infinite.iter().enumerate().filter_map(|(cell, state)| Some((cell, state.as_ref().err()?)));
    let unknown: Vec<Warning> = unknown
        .map(|(cell, error)| Warning::UnknownBias {
            at: Place::of(query, cell / laws.len(), cell % laws.len()),
            reason: error.to_string(),
        })
        .collect();
    let infinite: Vec<Option<SampledState>> = infinite.into_iter().map(Result::ok).collect();
    let states: Vec<Vec<SampledState>> =
        (0..predictors.len()).map(|cell| surfaces.iter().map(|surface| surface[cell]).collect()).collect();
    let mut warnings = of_infinite_extent(law, surface, query, sampling.slip, settings);
    warnings.extend(unknown);
    warnings.extend(of_samples(law, query, sampling.slip, &states, &infinite));
    Ok(Samples { query: query.clone(), sampling: *sampling, law: law.name(), states, infinite, warnings })
}

/// Starts of the search of finite surfaces for their separation: at that of the surface of infinite extent, for every
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
                NormalLoading::Pressure(_) => separation_for(&mut integral, value, predictor)
                    .map_or(predictor, |equilibrium| equilibrium.predictor()),
            };
            predictors.push(Predictor { sensitivity: None, ..predictor });
        }
    }
    predictors
}

/// What a prediction of the surface of infinite extent warns of and drawn surfaces share; nothing where that is refused, as drawn
/// surfaces may have a result nevertheless.
fn of_infinite_extent(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    slip: Option<f64>,
    settings: &Settings,
) -> Vec<Warning> {
    let query = Query { rate_step: None, ..query.clone() };
    let Ok(prediction) = predict(law, surface, &query, settings, &|_, _| ()) else { return Vec::new() };
    let is_shared = |warning: &Warning| match warning {
        Warning::BelowTable { .. }
        | Warning::Adhesion { .. }
        | Warning::StrongInterface { .. }
        | Warning::FewContacts { .. } => true,
        // Of the life of the contacts, and of the slide of a prediction.
        Warning::ShortLife { .. }
        | Warning::NominalHeating { .. }
        | Warning::HeatOfFaces { .. }
        | Warning::AboveMelting { .. } => slip.is_none(),
        _ => false,
    };
    prediction.warnings.into_iter().filter(is_shared).collect()
}

fn of_samples(
    law: &dyn AsperityLaw,
    query: &Query,
    slip: Option<f64>,
    states: &[Vec<SampledState>],
    infinite: &[Option<SampledState>],
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let rates = query.slip_rates.len();
    for (cell, (surfaces, infinite)) in states.iter().zip(infinite).enumerate() {
        let at = || Place::of(query, cell / rates, cell % rates);
        let outside = surfaces.iter().map(|one| one.state.outside).fold(0.0, f64::max);
        if outside > NEGLIGIBLE_SHARE && law.above_range() == AboveRange::Extrapolated {
            warnings.push(Warning::SamplesExtrapolated { at: at(), share: outside });
        }
        if let Some(SampledState { state, .. }) = infinite
            && state.unknown_load > NEGLIGIBLE_SHARE
        {
            let (share, known) = (state.unknown_load, !state.mu.value.is_nan());
            warnings.push(match slip {
                Some(_) => Warning::SamplesNotSliding { at: at(), share },
                None => Warning::Unsteady { at: at(), share, known },
            });
        }
        let share = infinite.map_or(f64::NAN, |infinite| infinite.state.area_fraction.value);
        warnings.extend(Warning::of_area(query, share, at));
        let contacts = surfaces.iter().map(|one| one.contacts).sum::<f64>() / surfaces.len() as f64;
        if contacts < FEW_CONTACTS {
            warnings.push(Warning::SamplesWithFewContacts { at: at(), contacts });
        }
        let idle = surfaces.iter().filter(|one| one.contacts == 0.0).count();
        if idle > 0 {
            warnings.push(Warning::SamplesWithoutContact { at: at(), idle, count: surfaces.len() });
        }
    }
    let outside = states.iter().flatten().map(|one| one.state.outside);
    warnings.extend(Warning::beyond_formulae(law, outside));
    warnings
}
