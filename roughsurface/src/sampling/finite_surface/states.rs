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
use crate::surface::heights::{Empirical, Heights};
use crate::surface::query::{LoadingControl, NormalLoading, Query};
use tables::law::{AsperityLaw, Estimate};

/// A surface under one pressure at one slip rate.
#[derive(Clone, Copy, Debug, Default)]
pub struct SampledState {
    /// State after the slip; errors are those of the law. The friction coefficient is NaN without contact.
    pub state: SlipState,
    /// Number of asperities in contact.
    pub contacts: f64,
}

/// The asperities at one slip rate.
pub(super) struct LawAtRate<'a> {
    pub before: Asperities<'a>,
    pub after: Asperities<'a>,
}

/// The summits of one surface, whose responses are added up.
pub(super) struct SummitPopulation<'a> {
    pub heights: &'a dyn Heights,
    /// Heights of the summits of each radius, of a finite surface with several radii; empty otherwise.
    pub heights_by_radius: &'a [Empirical],
    /// Summits per nominal area, 1/m².
    pub density: f64,
    /// Number of summits.
    pub count: usize,
}

impl SummitPopulation<'_> {
    fn integral<'a>(&'a self, asperities: &Asperities<'a>, tolerance: f64) -> SurfaceIntegral<'a> {
        if self.heights_by_radius.is_empty() {
            return SurfaceIntegral::new(asperities, self.heights, self.density, tolerance);
        }
        let parts = self.heights_by_radius.iter().zip(&asperities.classes).map(|(heights, (_, asperity))| {
            let share = heights.count() as f64 / self.count as f64;
            (share, HeightIntegral::new(asperity.clone(), heights, self.density, tolerance))
        });
        SurfaceIntegral::of_classes(parts.filter(|(share, _)| *share > 0.0).collect())
    }
}

/// Loading of the summits of a surface: normal loading, then the slide.
pub(super) struct SummitLoading<'a> {
    pub law: &'a dyn AsperityLaw,
    pub query: &'a Query,
    pub settings: &'a Settings,
    pub plane: MeanPlane,
    /// Response of the asperities at each slip rate.
    pub laws: &'a [LawAtRate<'a>],
    /// Starts of the search for a separation, at every pressure or separation and slip rate, row by row.
    pub predictors: &'a [Predictor],
}

impl SummitLoading<'_> {
    /// States at every pressure or separation and slip rate, row by row.
    pub fn states(&self, summits: &SummitPopulation) -> Vec<Result<SampledState, PredictionError>> {
        (0..self.predictors.len()).map(|cell| self.state(summits, cell)).collect()
    }

    fn state(&self, summits: &SummitPopulation, cell: usize) -> Result<SampledState, PredictionError> {
        let (row, rate) = (cell / self.laws.len(), cell % self.laws.len());
        let (separation, state) = self.slid(summits, row, rate, self.predictors[cell])?;
        let contacts = state.contact_density * summits.count as f64 / summits.density;
        let state = SlipState::at_separation(separation, &state, self.plane);
        let at = || Place::of(self.query, row, rate);
        Ok(SampledState { state: state.within(self.law, self.settings, &at)?, contacts })
    }

    /// Effective separation (m) and state after the slide.
    fn slid(
        &self,
        summits: &SummitPopulation,
        row: usize,
        rate: usize,
        predictor: Predictor,
    ) -> Result<(f64, ContactState), PredictionError> {
        let Self { query, plane, laws, .. } = *self;
        let value = query.loading.values()[row];
        let [mut before, mut after] =
            [&laws[rate].before, &laws[rate].after].map(|of| summits.integral(of, self.settings.tolerance));
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
