//! Prediction of the friction of a rough surface.
//!
//! For every pressure (or separation) and slip rate the surface is first pressed,
//! then slid; at every slip its friction coefficient is
//! ∫ Q(ω, V, s) φ dz / ∫ P(ω, V, s) φ dz.
//!
//! With the load held, asperities that lose load while they slide let the flat sink
//! until the nominal pressure is restored, so every asperity is pressed deeper as it
//! slides. A table knows slides at constant interference only: the response of an
//! asperity now at ω after slip s is taken from the slide at that ω throughout,
//! as if it had not been pressed less before. Near the surface's static friction
//! the flat has hardly moved and the approximation is good; compare `hold =
//! "separation"` to see how much it can matter.

pub mod comparison;
pub mod flash_heating;
pub mod rate_dependence;
pub mod regime;
pub mod slip_curve;
pub(crate) mod sweep;

use crate::friction::comparison::Comparison;
use crate::friction::flash_heating::{FlashHeating, NoFit};
use crate::friction::rate_dependence::rate_sensitivity;
use crate::friction::regime::{RegimeShares, plasticity_index};
use crate::friction::slip_curve::{SlipState, slip_grid};
use crate::friction::sweep::Sweep;
use crate::integral::separation::{Carried, SeparationError};
use crate::sampling::uncertainty::Propagated;
use crate::surface::query::{Query, Surface};
use rayon::prelude::*;
use tables::law::{AsperityLaw, Estimate, LookupError};

/// How the answer is computed.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Relative error of integrals and pressures.
    pub tolerance: f64,
    /// Slips on the curve.
    pub slip_points: usize,
    /// Continue the law beyond its range instead of refusing.
    pub extrapolate: bool,
    /// Temperature from which on a contact counts as melting, K, where it is known.
    pub melting_temperature: Option<f64>,
}

impl Friction {
    /// An energy per nominal area as one per real contact area (J/m²).
    fn per(energy: Estimate, area_fraction: Estimate) -> Estimate {
        let value = energy.value / area_fraction.value;
        let error = (energy.error + value.abs() * area_fraction.error) / area_fraction.value;
        Estimate { value, error }
    }

    /// [`weakening_energy`](Self::weakening_energy) per real contact area at the end of the slide, J/m².
    pub fn weakening_of_real_area(&self) -> Estimate {
        Self::per(self.weakening_energy, self.sliding.area_fraction)
    }

    /// [`energy_release`](Self::energy_release) per real contact area before the slide, J/m².
    pub fn release_of_real_area(&self) -> Option<Estimate> {
        self.energy_release.map(|energy| Self::per(energy, self.pressed.area_fraction))
    }
}

impl Default for Settings {
    /// Integrals to a millionth and neighbouring slips 6 % apart: both far below the errors
    /// of tables.
    fn default() -> Self {
        Self { tolerance: 1e-6, slip_points: 200, extrapolate: false, melting_temperature: None }
    }
}

/// Friction of the surface at one pressure or separation and one slip rate.
#[derive(Clone, Debug)]
pub struct Friction {
    /// Static friction coefficient, see [`inception`](crate::friction::slip_curve::inception).
    pub mu_static: Estimate,
    /// Slip at which it is reached, m.
    pub inception_slip: Estimate,
    /// Energy released by weakening, J per m² of nominal area, see
    /// [`weakening_energy`](crate::friction::slip_curve::weakening_energy).
    pub weakening_energy: Estimate,
    /// Slip over which friction weakens, m, see
    /// [`weakening_distance`](crate::friction::slip_curve::weakening_distance).
    pub weakening_distance: Estimate,
    /// Energy that the asperities release from full stick to full slip, J per m² of
    /// nominal area; none where the law does not know it.
    pub energy_release: Option<Estimate>,
    /// Before the slide.
    pub pressed: SlipState,
    /// At the end of the slide: sliding friction.
    pub sliding: SlipState,
    /// Share of the contacts in each regime at the end of the slide.
    pub shares: RegimeShares,
    /// dμ/d ln V of sliding friction, see [`rate_sensitivity`].
    pub rate_sensitivity: Estimate,
    /// Friction coefficient at each slip.
    pub mu_history: Vec<Estimate>,
    /// Largest share of the load beyond the range of the law, at any slip.
    pub outside_table: f64,
}

/// Answer to a query.
#[derive(Clone, Debug)]
pub struct Prediction {
    pub query: Query,
    /// Name of the asperity law.
    pub law: String,
    /// Slips of the histories, m.
    pub slip: Vec<f64>,
    /// One row per pressure or separation, one column per slip rate.
    pub friction: Vec<Vec<Friction>>,
    /// √(σ_s/ω_c) of heights of standard deviation σ_s, ω_c at the mean radius.
    pub plasticity_index: f64,
    /// Flash-heating parameters per pressure or separation.
    pub flash_heating: Vec<Result<FlashHeating, NoFit>>,
    /// What uncertain parameters mean for the results; filled in by who asked for it.
    pub propagated: Option<Propagated>,
    /// What models of the literature say; filled in by who asked for it.
    pub comparisons: Vec<Comparison>,
    /// What the user should know before believing the numbers.
    pub warnings: Vec<String>,
}

/// Why there is no prediction.
#[derive(Clone, Debug, thiserror::Error)]
pub enum PredictionError {
    #[error(transparent)]
    Lookup(#[from] LookupError),
    #[error(transparent)]
    Separation(#[from] SeparationError),
    #[error(
        "at {pressing} and {slip_rate} m/s asperities pressed beyond {limit:.4} omega_c, where the table ends, carry {:.2} % of the load; a table up to about {reach:.4} omega_c would do, or extrapolate",
        100.0 * .share
    )]
    OutsideTable { pressing: String, slip_rate: f64, limit: f64, reach: f64, share: f64 },
    #[error("{pressing} leaves no asperity in contact")]
    NoContact { pressing: String },
}

/// Slips of a slide that one thread goes through in order.
const PIECE: usize = 20;

/// Predicts the friction of `surface` from the `law` of its asperities.
///
/// `progress` is told the number of slides done and the total; the result does not
/// depend on the number of threads, because every integral is computed by one.
pub fn predict(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Prediction, PredictionError> {
    let sweep = Sweep::new(law, surface, query, settings)?;
    let pressed =
        (0..query.slip_rates.len()).into_par_iter().map(|rate| sweep.press(rate)).collect::<Vec<_>>();
    let pressed = pressed.into_iter().collect::<Result<Vec<_>, _>>()?;

    let (smallest, largest) = loaded_radii(&pressed);
    let slip = slip_grid(smallest, largest, settings.slip_points);

    // Each piece of a slide starts from the press; along it a slip starts from the one before.
    let pieces: Vec<(usize, &[f64])> = (0..query.slip_rates.len())
        .flat_map(|rate| slip.chunks(PIECE).map(move |piece| (rate, piece)))
        .collect();
    let tasks = query.slip_rates.len() * slip.len();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let states = pieces
        .into_par_iter()
        .map(|(rate, piece)| {
            let states = sweep.slide(rate, piece, &pressed[rate]);
            let count = done.fetch_add(piece.len(), std::sync::atomic::Ordering::Relaxed) + piece.len();
            progress(count, tasks);
            states
        })
        .collect::<Vec<_>>();
    // In order, so that the same failure is reported whatever thread meets it first.
    let states = states.into_iter().collect::<Result<Vec<_>, _>>()?.concat();

    let mut warnings = Vec::new();
    let friction: Vec<Vec<Friction>> = (0..query.pressing.values().len())
        .map(|row| {
            (0..query.slip_rates.len())
                .map(|rate| {
                    let curve: Vec<SlipState> = states[rate * slip.len()..(rate + 1) * slip.len()]
                        .iter()
                        .map(|rows| rows[row])
                        .collect();
                    sweep.evaluate((row, rate), &pressed[rate][row], &slip, &curve, &mut warnings)
                })
                .collect()
        })
        .collect();
    let mut friction = friction;
    for row in &mut friction {
        let mu: Vec<Estimate> = row.iter().map(|cell| cell.sliding.mu).collect();
        for (cell, sensitivity) in row.iter_mut().zip(rate_sensitivity(&query.slip_rates, &mu)) {
            cell.rate_sensitivity = sensitivity;
        }
    }
    let flash_heating = friction
        .iter()
        .map(|row| {
            let mu: Vec<Estimate> = row.iter().map(|friction| friction.sliding.mu).collect();
            flash_heating::fit(&query.slip_rates, &mu)
        })
        .collect();
    Ok(Prediction {
        query: query.clone(),
        law: law.name(),
        slip,
        friction,
        plasticity_index: plasticity_index(law, surface),
        flash_heating,
        propagated: None,
        comparisons: Vec::new(),
        warnings,
    })
}

/// Slip (m) at which [`predict`] ends its slides.
pub fn end_of_slide(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    settings: &Settings,
) -> Result<f64, PredictionError> {
    let sweep = Sweep::new(law, surface, query, settings)?;
    let (smallest, largest) = loaded_radii(&sweep.press_all()?);
    let grid = slip_grid(smallest, largest, settings.slip_points);
    Ok(grid[grid.len() - 1])
}

/// Smallest and largest contact radius of the loaded asperities, m.
fn loaded_radii(pressed: &[Vec<Carried>]) -> (f64, f64) {
    let radii = pressed.iter().flatten().map(|carried| carried.state.loaded_radius);
    radii.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), radius: f64| {
        (low.min(radius), high.max(radius))
    })
}

#[cfg(test)]
mod tests;
