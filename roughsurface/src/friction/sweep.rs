//! The states that a prediction is made of: the surface pressed, and after each slip.

use crate::friction::regime::RegimeShares;
use crate::friction::slip_curve::{SlipState, inception, weakening_distance, weakening_energy};
use crate::friction::{Friction, PredictionError, Settings};
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::integral::predictor::{Start, Trail};
use crate::integral::separation::{Carried, separation_for};
use crate::integral::surface_integral::{Asperities, ContactIntegral, SurfaceIntegral};
use crate::surface::query::{Hold, Pressing, Query, Surface};
use rayon::prelude::*;
use tables::law::{AsperityLaw, Estimate, LookupError};

/// Real area fraction above which asperities no longer deform independently.
const CROWDED: f64 = 0.3;

/// One query of one surface.
pub(crate) struct Sweep<'a> {
    law: &'a dyn AsperityLaw,
    surface: &'a Surface,
    query: &'a Query,
    settings: &'a Settings,
    /// The asperities at each slip rate, before the slide.
    asperities: Vec<Asperities<'a>>,
}

impl<'a> Sweep<'a> {
    pub(crate) fn new(
        law: &'a dyn AsperityLaw,
        surface: &'a Surface,
        query: &'a Query,
        settings: &'a Settings,
    ) -> Result<Self, LookupError> {
        query.check_slip_rates(law, &surface.asperity_radius)?;
        let rates = query.slip_rates.iter();
        let asperities = rates.map(|&rate| Asperities::new(law, surface, rate));
        Ok(Self { law, surface, query, settings, asperities: asperities.collect::<Result<_, _>>()? })
    }

    fn integral(&self, asperities: &Asperities<'a>) -> SurfaceIntegral<'a> {
        SurfaceIntegral::new(
            asperities,
            self.surface.heights.as_ref(),
            self.surface.asperity_density,
            self.settings.tolerance,
        )
    }

    /// The surface under every pressure or separation, before the slide, per slip rate.
    pub(crate) fn press_all(&self) -> Result<Vec<Vec<Carried>>, PredictionError> {
        let pressed =
            (0..self.query.slip_rates.len()).into_par_iter().map(|rate| self.press(rate)).collect::<Vec<_>>();
        pressed.into_iter().collect()
    }

    /// The surface under every pressure or separation, before the slide.
    pub(crate) fn press(&self, rate: usize) -> Result<Vec<Carried>, PredictionError> {
        let heights = self.surface.heights.as_ref();
        let mut integral = self.integral(&self.asperities[rate].asked_for_energy());
        let mut start = Start::at(heights.mode(), heights);
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
            start = carried.start();
            pressed.push(carried);
        }
        Ok(pressed)
    }

    /// The surface after each of the neighbouring `slips` (m), for every pressure or separation.
    pub(crate) fn slide(
        &self,
        rate: usize,
        slips: &[f64],
        pressed: &[Carried],
    ) -> Result<Vec<Vec<SlipState>>, PredictionError> {
        let mut trails: Vec<Trail> = pressed.iter().map(|before| Trail::from(before.start())).collect();
        slips
            .iter()
            .map(|&slip| {
                let mut integral = self.integral(&self.asperities[rate].after(slip));
                pressed
                    .iter()
                    .zip(&mut trails)
                    .enumerate()
                    .map(|(row, (before, trail))| self.slid((row, rate), &mut integral, before, trail))
                    .collect()
            })
            .collect()
    }

    /// One pressure or separation after the slip of `integral`, with which `trail` goes on.
    fn slid(
        &self,
        (row, rate): (usize, usize),
        integral: &mut SurfaceIntegral,
        before: &Carried,
        trail: &mut Trail,
    ) -> Result<SlipState, PredictionError> {
        let heights = self.surface.heights.as_ref();
        let state = match self.query.hold {
            Hold::Separation => {
                let mut state = integral.at(before.separation)?;
                integral.complete_errors(before.separation, &mut state)?;
                SlipState::at_separation(before.separation, &state)
            }
            Hold::Load => {
                let pressure = match &self.query.pressing {
                    Pressing::Pressure(pressures) => pressures[row],
                    Pressing::Separation(_) => before.state.pressure.value,
                };
                let carried =
                    separation_for(integral, heights, pressure, trail.next(), self.settings.tolerance)?;
                trail.add(carried.start(), carried.own_sensitivity);
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
        Ok(state)
    }

    pub(crate) fn evaluate(
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
            weakening_energy: weakening_energy(slip, &shear),
            weakening_distance: weakening_distance(slip, &shear),
            shares: self.shares(rate, slip[slip.len() - 1], curve[curve.len() - 1].separation.value),
            rate_sensitivity: Estimate { value: f64::NAN, error: f64::NAN },
            energy_release: self.energy_release(row, pressed),
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

    fn shares(&self, rate: usize, slip: f64, separation: f64) -> RegimeShares {
        let heights = self.surface.heights.as_ref();
        let asperities = self.asperities[rate].after(slip);
        RegimeShares::of(&asperities, heights, separation, self.settings.melting_temperature)
    }

    fn energy_release(&self, row: usize, pressed: &Carried) -> Option<Estimate> {
        let mut energy = pressed.state.energy?.estimate();
        if let Pressing::Pressure(pressures) = &self.query.pressing {
            let slope = (pressed.sensitivity.energy * energy.value).abs();
            energy.error += pressed.separation_error(pressures[row]) * slope;
        }
        Some(energy)
    }
}
