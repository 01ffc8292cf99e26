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

use crate::asperity_at_slip::AsperityAtSlip;
use crate::flash_heating::{self, FlashHeating, NoFit};
use crate::integral::{HeightIntegral, NEGLIGIBLE_SHARE};
use crate::query::{Hold, Pressing, Query, Surface};
use crate::separation::{Carried, SeparationError, separation_for};
use crate::slip_curve::{SlipState, inception, slip_grid, weakening_energy};
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
}

impl Default for Settings {
    /// Integrals to a millionth and neighbouring slips 6 % apart: both far below the errors
    /// of tables.
    fn default() -> Self {
        Self { tolerance: 1e-6, slip_points: 193, extrapolate: false }
    }
}

/// Friction of the surface at one pressure or separation and one slip rate.
#[derive(Clone, Debug)]
pub struct Friction {
    /// Static friction coefficient, see [`inception`].
    pub mu_static: Estimate,
    /// Slip at which it is reached, m.
    pub inception_slip: f64,
    /// Energy released by weakening, J per m² of nominal area, see [`weakening_energy`].
    pub energy: Estimate,
    /// Energy that the asperities release from full stick to full slip, J per m² of
    /// nominal area; none where the law does not know it.
    pub energy_stick_slip: Option<Estimate>,
    /// Before the slide.
    pub pressed: SlipState,
    /// At the end of the slide: sliding friction.
    pub sliding: SlipState,
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
    /// Flash-heating parameters per pressure or separation.
    pub flash_heating: Vec<Result<FlashHeating, NoFit>>,
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

/// Real area fraction above which asperities no longer deform independently.
const CROWDED: f64 = 0.3;

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

    let radii = pressed.iter().flatten().map(|carried| carried.state.loaded_radius);
    let (smallest, largest) = radii
        .fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), radius| (low.min(radius), high.max(radius)));
    let slip = slip_grid(smallest, largest, settings.slip_points);

    let tasks = query.slip_rates.len() * slip.len();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let states = (0..tasks)
        .into_par_iter()
        .map(|task| {
            let (rate, step) = (task / slip.len(), task % slip.len());
            let states = sweep.slide(rate, slip[step], &pressed[rate]);
            let count = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
            progress(count, tasks);
            states
        })
        .collect::<Vec<_>>();
    // In order, so that the same failure is reported whatever thread meets it first.
    let states = states.into_iter().collect::<Result<Vec<_>, _>>()?;

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
    let flash_heating = friction
        .iter()
        .map(|row| {
            let mu: Vec<Estimate> = row.iter().map(|friction| friction.sliding.mu).collect();
            flash_heating::fit(&query.slip_rates, &mu)
        })
        .collect();
    Ok(Prediction { query: query.clone(), law: law.name(), slip, friction, flash_heating, warnings })
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

struct Sweep<'a> {
    law: &'a dyn AsperityLaw,
    surface: &'a Surface,
    query: &'a Query,
    settings: &'a Settings,
    /// The asperities at each slip rate, before the slide.
    asperities: Vec<AsperityAtSlip<'a>>,
}

impl<'a> Sweep<'a> {
    fn new(
        law: &'a dyn AsperityLaw,
        surface: &'a Surface,
        query: &'a Query,
        settings: &'a Settings,
    ) -> Result<Self, LookupError> {
        let radius = surface.asperity_radius;
        query.check_slip_rates(law, radius)?;
        let rates = query.slip_rates.iter();
        let asperities = rates.map(|&rate| AsperityAtSlip::new(law, radius, rate, 0.0));
        Ok(Self { law, surface, query, settings, asperities: asperities.collect::<Result<_, _>>()? })
    }

    fn integral(&self, asperity: AsperityAtSlip<'a>) -> HeightIntegral<'a> {
        HeightIntegral::new(
            asperity,
            self.surface.heights.as_ref(),
            self.surface.asperity_density,
            self.settings.tolerance,
        )
    }

    /// The surface under every pressure or separation, before the slide, per slip rate.
    fn press_all(&self) -> Result<Vec<Vec<Carried>>, PredictionError> {
        let pressed =
            (0..self.query.slip_rates.len()).into_par_iter().map(|rate| self.press(rate)).collect::<Vec<_>>();
        pressed.into_iter().collect()
    }

    /// The surface under every pressure or separation, before the slide.
    fn press(&self, rate: usize) -> Result<Vec<Carried>, PredictionError> {
        let heights = self.surface.heights.as_ref();
        let mut integral = self.integral(self.asperities[rate].asked_for_energy());
        let mut start = heights.mode();
        let mut pressed = Vec::new();
        for (row, &value) in self.query.pressing.values().iter().enumerate() {
            let carried = match self.query.pressing {
                Pressing::Pressure(_) => {
                    separation_for(&mut integral, heights, value, start, self.settings.tolerance)?
                }
                Pressing::Separation(_) => Carried::at(&mut integral, heights, value)?,
            };
            if carried.state.pressure.value <= 0.0 {
                return Err(PredictionError::NoContact { pressing: self.query.pressing.describe(row) });
            }
            start = carried.separation;
            pressed.push(carried);
        }
        Ok(pressed)
    }

    /// The surface after `slip` (m), for every pressure or separation.
    fn slide(&self, rate: usize, slip: f64, pressed: &[Carried]) -> Result<Vec<SlipState>, PredictionError> {
        let heights = self.surface.heights.as_ref();
        let mut integral = self.integral(self.asperities[rate].after(slip));
        let mut states = Vec::with_capacity(pressed.len());
        for (row, before) in pressed.iter().enumerate() {
            let state = match self.query.hold {
                Hold::Separation => {
                    SlipState::at_separation(&Carried::at(&mut integral, heights, before.separation)?)
                }
                Hold::Load => {
                    let pressure = match &self.query.pressing {
                        Pressing::Pressure(pressures) => pressures[row],
                        Pressing::Separation(_) => before.state.pressure.value,
                    };
                    let carried = separation_for(
                        &mut integral,
                        heights,
                        pressure,
                        before.separation,
                        self.settings.tolerance,
                    )?;
                    SlipState::at_pressure(&carried, pressure)
                }
            };
            if state.outside > NEGLIGIBLE_SHARE && !self.settings.extrapolate {
                return Err(PredictionError::OutsideTable {
                    pressing: self.query.pressing.describe(row),
                    slip_rate: self.query.slip_rates[rate],
                    limit: self.law.interference_limit(),
                    reach: state.reach,
                    share: state.outside,
                });
            }
            states.push(state);
        }
        Ok(states)
    }

    fn evaluate(
        &self,
        (row, rate): (usize, usize),
        pressed: &Carried,
        slip: &[f64],
        curve: &[SlipState],
        warnings: &mut Vec<String>,
    ) -> Friction {
        let mu_history: Vec<Estimate> = curve.iter().map(|state| state.mu).collect();
        let shear: Vec<Estimate> = curve.iter().map(|state| state.shear).collect();
        let start = inception(slip, &mu_history);
        let friction = Friction {
            mu_static: start.mu,
            inception_slip: start.slip,
            energy: weakening_energy(slip, &shear),
            energy_stick_slip: self.energy_stick_slip(row, pressed),
            pressed: curve[0],
            sliding: curve[curve.len() - 1],
            mu_history,
            outside_table: curve.iter().map(|state| state.outside).fold(0.0, f64::max),
        };
        let place = format!("{}, {} m/s", self.query.pressing.describe(row), self.query.slip_rates[rate]);
        if friction.outside_table > NEGLIGIBLE_SHARE {
            warnings.push(format!(
                "{place}: {:.2} % of the load lies beyond the table and is extrapolated",
                100.0 * friction.outside_table
            ));
        }
        if !start.reached {
            warnings.push(format!(
                "{place}: friction still rises at the end of the slide; mu_static is the last value"
            ));
        }
        let covered = friction.sliding.area_fraction.value;
        if covered > CROWDED {
            warnings.push(format!(
                "{place}: {:.0} % of the nominal area is in contact; neighbouring asperities, here independent, would interact",
                100.0 * covered
            ));
        }
        friction
    }

    fn energy_stick_slip(&self, row: usize, pressed: &Carried) -> Option<Estimate> {
        let mut energy = pressed.state.energy?.estimate();
        if let Pressing::Pressure(pressures) = &self.query.pressing {
            let slope = pressed.slope(|state| state.energy.map_or(f64::NAN, |e| e.value));
            energy.error += pressed.separation_error(pressures[row]) * slope;
        }
        Some(energy)
    }
}

#[cfg(test)]
mod tests;
