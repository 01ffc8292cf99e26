//! The states that a prediction is made of: the surface pressed, and after each slip; in [`rates`] those at slip rates
//! that the query has not, and through a step of the slip rate.

mod rates;
mod warnings;

use crate::friction::contacts::Contacts;
use crate::friction::result::Friction;
use crate::friction::settings::{PredictionError, Settings};
use crate::friction::slip_curve::{HeldSeparation, SlipState, inception};
use crate::friction::warning::{Place, Warning};
use crate::friction::weakening::{weakening_distance, weakening_energy};
use crate::integral::asperity_at_slip::Additional;
use crate::integral::height_integral::NEGLIGIBLE_SHARE;
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::{Predictor, PredictorHistory};
use crate::integral::separation::{EquilibriumState, separation_for};
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::surface::query::{ContactLife, LoadingControl, NormalLoading, Query, Surface};
use tables::law::{AsperityLaw, Estimate, LookupError};

/// The slide of the surface at one pressure or separation and one slip rate.
pub(crate) struct SurfaceSlide {
    /// State after each slip of the grid.
    pub(crate) curve: Vec<SlipState>,
    /// Contacts at the end of the curve.
    pub(crate) contacts: Contacts,
    /// Steady sliding with contacts of all ages of their life.
    pub(crate) sliding: SlipState,
    /// Steady sliding with contacts that last.
    pub(crate) lasting: SlipState,
}

/// The surface under the pressure or separation of a row, before the slide.
pub(crate) struct PressedSurface {
    equilibrium: EquilibriumState,
    before_sliding: SlipState,
    /// Pressure (Pa), which a held load keeps; it has an error where the query gives the separation.
    pressure: Estimate,
    /// Separation (m), which a held separation keeps, and its error; it has one where the query gives the pressure.
    separation: (f64, HeldSeparation),
    energy_release: Option<Estimate>,
}

impl PressedSurface {
    fn history(&self) -> PredictorHistory {
        self.equilibrium.predictor().into()
    }
}

/// A row of the query, the surface that is pressed, and neighbouring slips (m) of its slide.
pub(crate) struct SlidingRow<'s> {
    pub(crate) row: usize,
    pub(crate) slips: &'s [f64],
    pub(crate) pressed: &'s PressedSurface,
}

/// One query of one surface.
pub(crate) struct Sweep<'a> {
    law: &'a dyn AsperityLaw,
    surface: &'a Surface,
    query: &'a Query,
    settings: &'a Settings,
    plane: MeanPlane,
    /// The asperities at each slip rate, before the slide.
    asperities: Vec<Asperities<'a>>,
}

impl<'a> Sweep<'a> {
    pub(crate) fn new(
        law: &'a dyn AsperityLaw,
        surface: &'a Surface,
        query: &'a Query,
        settings: &'a Settings,
    ) -> Result<Self, PredictionError> {
        query.check_slip_rates(law, &surface.asperity_radius)?;
        let rates = query.slip_rates.iter();
        let asperities = rates.map(|&rate| Asperities::new(law, surface, rate));
        let asperities = asperities.collect::<Result<_, _>>()?;
        Ok(Self { law, surface, query, settings, plane: MeanPlane::new(query, law)?, asperities })
    }

    fn integral(&self, asperities: &Asperities<'a>) -> SurfaceIntegral<'a> {
        let heights = self.surface.heights.as_ref();
        SurfaceIntegral::new(asperities, heights, self.surface.asperity_density, self.settings.tolerance)
    }

    pub(crate) fn press(&self, row: usize, rate: usize) -> Result<PressedSurface, PredictionError> {
        let asperities = self.asperities[rate].map(|asperity| asperity.with(Additional::EnergyRelease));
        let mut integral = self.integral(&asperities);
        let (equilibrium, before_sliding, pressure, held, shift) = match &self.query.loading {
            NormalLoading::Pressure(pressures) => {
                let pressure = Estimate::exact(pressures[row]);
                let heights = self.surface.heights.as_ref();
                let predictor = Predictor::at(heights.mode(), heights);
                let found = separation_for(&mut integral, pressure.value, predictor)?;
                let before_sliding = SlipState::at_pressure(&found, pressure, self.plane);
                let held = HeldSeparation::found(&found, pressure.value);
                (found, before_sliding, pressure, held, found.separation_error(pressure.value))
            }
            NormalLoading::Separation(separations) => {
                let effective = self.plane.effective_separation(&mut integral, separations[row])?;
                let found = EquilibriumState::at(&mut integral, effective)?;
                let held = HeldSeparation::default();
                let before_sliding = SlipState::held(&found, held, self.plane);
                let pressure = found.state.pressure.estimate();
                let shift = self.plane.displacement_error(pressure, found.sensitivity.pressure);
                (found, before_sliding, before_sliding.pressure, held, shift)
            }
        };
        let touches = equilibrium.state.pressure.value > 0.0;
        if !touches {
            return Err(PredictionError::NoContact { loading: self.query.loading.describe(row) });
        }
        let displacement = self.plane.displacement(Estimate::exact(pressure.value));
        let separation = (equilibrium.separation - displacement.value, held);
        let energy_release = equilibrium.state.additional.map(|energy| {
            let Estimate { value, error } = energy.estimate();
            Estimate { value, error: error + shift * (equilibrium.sensitivity.additional * value).abs() }
        });
        Ok(PressedSurface { equilibrium, before_sliding, pressure, separation, energy_release })
    }

    /// The surface of each of the `rows` after its neighbouring slips (m). Rows share the responses of the asperities where
    /// they share a slip, and do not depend on each other.
    pub(crate) fn slide(
        &self,
        rate: usize,
        rows: &[SlidingRow<'_>],
    ) -> Result<Vec<Vec<SlipState>>, PredictionError> {
        let mut histories: Vec<PredictorHistory> = rows.iter().map(|row| row.pressed.history()).collect();
        let mut states: Vec<Vec<SlipState>> = rows.iter().map(|_| Vec::new()).collect();
        let next = |states: &[Vec<SlipState>]| {
            let slips = rows.iter().zip(states).filter_map(|(row, done)| row.slips.get(done.len()));
            slips.copied().min_by(f64::total_cmp)
        };
        while let Some(slip) = next(&states) {
            let mut integral = self.integral(&self.asperities[rate].map(|asperity| asperity.after(slip)));
            for ((row, history), states) in rows.iter().zip(&mut histories).zip(&mut states) {
                if row.slips.get(states.len()) == Some(&slip) {
                    let cell = (row.row, self.query.slip_rates[rate]);
                    states.push(self.slid(cell, &mut integral, row.pressed, history)?);
                }
            }
        }
        Ok(states)
    }

    /// The surface of a row in steady sliding with contacts of all ages of their `life`.
    pub(crate) fn slide_steadily(
        &self,
        (row, rate): (usize, usize),
        life: ContactLife,
        pressed: &PressedSurface,
    ) -> Result<SlipState, PredictionError> {
        self.steady(&self.asperities[rate], (row, self.query.slip_rates[rate]), life, pressed)
    }

    fn steady(
        &self,
        asperities: &Asperities<'a>,
        cell: (usize, f64),
        life: ContactLife,
        pressed: &PressedSurface,
    ) -> Result<SlipState, PredictionError> {
        let asperities = asperities.map(|one| one.of_all_ages(life).with(Additional::UnsteadyLoad));
        let known = asperities.classes.iter().all(|(_, asperity)| asperity.has_friction_of_all_ages());
        let state = self.slid(cell, &mut self.integral(&asperities), pressed, &mut pressed.history())?;
        Ok(if known { state } else { state.without_friction() })
    }

    /// One pressure or separation with the asperities of `integral`; `history` predicts its separation.
    fn slid(
        &self,
        (row, slip_rate): (usize, f64),
        integral: &mut SurfaceIntegral,
        before: &PressedSurface,
        history: &mut PredictorHistory,
    ) -> Result<SlipState, PredictionError> {
        let state = match self.query.control {
            LoadingControl::Separation => {
                let (separation, held) = before.separation;
                let effective = self.plane.effective_separation(integral, separation)?;
                let equilibrium = EquilibriumState::at(integral, effective)?;
                SlipState::held(&equilibrium, held, self.plane)
            }
            LoadingControl::Load => {
                let asked = before.pressure.value;
                let equilibrium = separation_for(integral, asked, history.next())?;
                history.add(equilibrium.predictor(), equilibrium.own_sensitivity);
                SlipState::at_pressure(&equilibrium, before.pressure, self.plane)
            }
        };
        state.within(self.law, self.settings, &|| Place {
            loading: self.query.loading.describe(row),
            slip_rate,
        })
    }

    /// The contacts after `slip` (m) at one slip rate under one separation (m).
    pub(crate) fn contacts(
        &self,
        rate: usize,
        slip: f64,
        separation: Estimate,
    ) -> Result<Contacts, LookupError> {
        let Settings { tolerance, scene, .. } = *self.settings;
        let asperities = self.asperities[rate].map(|asperity| asperity.after(slip));
        let first = self.law.interference_start();
        Contacts::of(&asperities, self.surface, separation, (tolerance, first), scene.melting_temperature)
    }

    /// Static friction, energies and warnings of one cell.
    pub(crate) fn evaluate(
        &self,
        (row, rate): (usize, usize),
        pressed: &PressedSurface,
        slip: &[f64],
        slide: SurfaceSlide,
        warnings: &mut Vec<Warning>,
    ) -> Friction {
        let SurfaceSlide { curve, contacts, sliding, lasting } = &slide;
        let mu_history: Vec<Estimate> = curve.iter().map(|state| state.mu).collect();
        let start = inception(slip, &mu_history, contacts.inception_error);
        let outside_table =
            curve.iter().chain([&slide.sliding]).map(|state| state.outside).fold(0.0, f64::max);
        let stuck = contacts.stuck_load > NEGLIGIBLE_SHARE;
        self.warn((row, rate), pressed, &slide, &start, outside_table, warnings);
        let friction = Friction {
            mu_static: start.mu,
            inception_slip: start.slip,
            weakening_energy: weakening_energy(slip, &mu_history, pressed.before_sliding.pressure),
            weakening_distance: weakening_distance(slip, &mu_history),
            contacts: *contacts,
            // Follows from all slip rates together.
            rate_sensitivity: Estimate::UNKNOWN,
            energy_release: pressed.energy_release.filter(|_| !sliding.mu.value.is_nan()),
            pressed: pressed.before_sliding,
            sliding: *sliding,
            mu_steady: lasting.mu,
            mu_history,
            outside_table,
        };
        if !stuck {
            return friction;
        }
        // Larger contacts slide farther until their slides end.
        let end = self.law.last_slip() * pressed.equilibrium.state.loaded_radius;
        friction.without_inception(slip.iter().take_while(|slip| **slip <= end).count())
    }
}

/// Smallest and largest contact radius (m) averaged over the load.
pub(crate) fn loaded_radii<'a>(pressed: impl IntoIterator<Item = &'a PressedSurface>) -> [f64; 2] {
    let radii = pressed.into_iter().map(|pressed| pressed.equilibrium.state.loaded_radius);
    radii.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], radius| [low.min(radius), high.max(radius)])
}
