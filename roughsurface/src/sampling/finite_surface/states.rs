//! States of a set of summits: of one drawn surface, or of the surface of infinite extent.

use crate::friction::slip_curve::SlipState;
use crate::friction::warning::Place;
use crate::friction::{PredictionError, Settings};
use crate::integral::contact_state::ContactState;
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::Predictor;
use crate::integral::separation::separation_for;
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::surface::heights::Heights;
use crate::surface::query::{LoadingControl, NormalLoading, Query, Surface};
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
pub(super) trait Summits {
    fn heights(&self) -> &dyn Heights;

    /// Nominal area, m².
    fn area(&self) -> f64;

    fn integral<'a>(&'a self, asperities: &Asperities<'a>, tolerance: f64) -> SurfaceIntegral<'a>;

    /// At every pressure or separation and slip rate, row by row.
    fn states(
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
            let contacts = state.contact_density * self.area();
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
        let heights = self.heights();
        let mut before = self.integral(&law.before, tolerance);
        let mut after = self.integral(&law.after, tolerance);
        let find = |integral: &mut SurfaceIntegral, pressure: f64| {
            separation_for(integral, heights, pressure, predictor, tolerance)
        };
        if query.control == LoadingControl::Separation {
            let separation = match query.loading {
                NormalLoading::Separation(_) => value,
                NormalLoading::Pressure(_) => {
                    let displacement = plane.displacement(Estimate::exact(value));
                    find(&mut before, value)?.separation - displacement.value
                }
            };
            let effective = plane.effective_separation(&mut after, heights, separation, tolerance)?;
            return Ok((effective, after.at(effective)?));
        }
        let pressure = match query.loading {
            NormalLoading::Pressure(_) => value,
            NormalLoading::Separation(_) => {
                let effective = plane.effective_separation(&mut before, heights, value, tolerance)?;
                before.at(effective)?.pressure.value
            }
        };
        if pressure <= 0.0 {
            return Ok((value, ContactState::default()));
        }
        let equilibrium = find(&mut after, pressure)?;
        Ok((equilibrium.separation, equilibrium.state))
    }
}

/// The surface of infinite extent, of which a number of asperities are counted.
pub(super) struct InfiniteSurface<'a> {
    pub surface: &'a Surface,
    pub asperities: usize,
}

impl Summits for InfiniteSurface<'_> {
    fn heights(&self) -> &dyn Heights {
        self.surface.heights.as_ref()
    }

    fn area(&self) -> f64 {
        self.asperities as f64 / self.surface.asperity_density
    }

    fn integral<'a>(&'a self, asperities: &Asperities<'a>, tolerance: f64) -> SurfaceIntegral<'a> {
        SurfaceIntegral::new(asperities, self.heights(), self.surface.asperity_density, tolerance)
    }
}
