//! States of a set of summits: of one drawn surface, or of the surface of infinite extent.

use crate::friction::slip_curve::SlipState;
use crate::friction::warning::Place;
use crate::friction::{PredictionError, Settings};
use crate::integral::contact_state::ContactState;
use crate::integral::height_integral::HeightIntegral;
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::Predictor;
use crate::integral::separation::separation_for;
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::surface::heights::{Heights, Sample};
use crate::surface::query::{LoadingControl, NormalLoading, Query};
use tables::law::{AsperityLaw, Estimate};

/// A surface under one pressure at one slip rate.
#[derive(Clone, Copy, Debug, Default)]
pub struct SampledState {
    /// After the slip; errors are those of the law. The friction coefficient is NaN without contact.
    pub state: SlipState,
    /// Number of asperities in contact.
    pub contacts: f64,
}

/// The asperities at one slip rate.
pub(super) struct LawAtRate<'a> {
    pub before: Asperities<'a>,
    pub after: Asperities<'a>,
}

/// Summits whose responses are added up.
pub(super) struct Summits<'a> {
    pub heights: &'a dyn Heights,
    /// Those of each radius, of a surface that is drawn from several.
    pub of_radius: &'a [Sample],
    /// 1/m².
    pub density: f64,
    /// Those that are counted.
    pub count: usize,
}

impl Summits<'_> {
    fn integral<'a>(&'a self, asperities: &Asperities<'a>, tolerance: f64) -> SurfaceIntegral<'a> {
        if self.of_radius.is_empty() {
            return SurfaceIntegral::new(asperities, self.heights, self.density, tolerance);
        }
        let parts = self.of_radius.iter().zip(&asperities.classes).map(|(heights, (_, asperity))| {
            let share = heights.count() as f64 / self.count as f64;
            (share, HeightIntegral::new(asperity.clone(), heights, self.density, tolerance))
        });
        SurfaceIntegral::of_classes(parts.filter(|(share, _)| *share > 0.0).collect())
    }

    /// At every pressure or separation and slip rate, row by row.
    pub fn states(
        &self,
        law: &dyn AsperityLaw,
        laws: &[LawAtRate],
        predictors: &[Predictor],
        query: &Query,
        settings: &Settings,
    ) -> Result<Vec<Result<SampledState, PredictionError>>, PredictionError> {
        let plane = MeanPlane::new(query.interaction, law)?;
        let state = |cell: usize| {
            let (row, rate) = (cell / laws.len(), cell % laws.len());
            let load = (query.loading.values()[row], plane);
            let (separation, state) =
                self.slid(&laws[rate], predictors[cell], query, load, settings.tolerance)?;
            let contacts = state.contact_density * self.count as f64 / self.density;
            let state = SlipState::at_separation(separation, &state, plane);
            Ok(SampledState {
                state: state.within(law, settings, &|| Place::of(query, row, rate))?,
                contacts,
            })
        };
        Ok((0..predictors.len()).map(state).collect())
    }

    /// Effective separation (m) and state after the slide under the pressure or separation `value`.
    fn slid(
        &self,
        law: &LawAtRate,
        predictor: Predictor,
        query: &Query,
        (value, plane): (f64, MeanPlane),
        tolerance: f64,
    ) -> Result<(f64, ContactState), PredictionError> {
        let mut before = self.integral(&law.before, tolerance);
        let mut after = self.integral(&law.after, tolerance);
        if query.control == LoadingControl::Separation {
            let separation = match query.loading {
                NormalLoading::Separation(_) => value,
                NormalLoading::Pressure(_) => {
                    let displacement = plane.displacement(Estimate::exact(value));
                    separation_for(&mut before, value, predictor)?.separation - displacement.value
                }
            };
            let effective = plane.effective_separation(&mut after, separation)?;
            return Ok((effective, after.at(effective)?));
        }
        let pressure = match query.loading {
            NormalLoading::Pressure(_) => value,
            NormalLoading::Separation(_) => {
                let effective = plane.effective_separation(&mut before, value)?;
                before.at(effective)?.pressure.value
            }
        };
        if pressure <= 0.0 {
            return Ok((value, ContactState::default()));
        }
        let equilibrium = separation_for(&mut after, pressure, predictor)?;
        Ok((equilibrium.separation, equilibrium.state))
    }
}
