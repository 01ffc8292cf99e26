//! One finite surface: its summits drawn at random, and its states.

use crate::friction::slip_curve::SlipState;
use crate::friction::warning::Place;
use crate::friction::{PredictionError, Settings};
use crate::integral::contact_state::ContactState;
use crate::integral::height_integral::HeightIntegral;
use crate::integral::mean_plane::MeanPlane;
use crate::integral::predictor::Predictor;
use crate::integral::separation::separation_for;
use crate::integral::surface_integral::{Asperities, ContactIntegral, SurfaceIntegral};
use crate::surface::heights::{Heights, Random, Sample};
use crate::surface::query::{LoadingControl, NormalLoading, Query, Surface};
use rand::SeedableRng;
use tables::law::{AsperityLaw, Estimate};

/// One finite surface under one pressure at one slip rate.
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

/// A finite surface.
pub(super) struct DrawnSurface {
    asperity_density: f64,
    asperities: usize,
    all: Sample,
    /// Heights of the summits of each radius; empty if there is one radius only.
    of_class: Vec<Sample>,
}

impl DrawnSurface {
    pub(super) fn new(surface: &Surface, asperities: usize, seed: u64) -> Result<Self, PredictionError> {
        let mut random = Random::seed_from_u64(seed);
        let heights: Vec<f64> = (0..asperities).map(|_| surface.heights.draw(&mut random)).collect();
        let mut of_class = Vec::new();
        let radii = &surface.asperity_radius;
        if radii.classes().len() > 1 {
            let mut classes = vec![Vec::new(); radii.classes().len()];
            for &height in &heights {
                classes[radii.draw(&mut random)].push(height);
            }
            of_class = classes.into_iter().map(Sample::part).collect();
        }
        // One asperity has no distribution of heights.
        let too_few =
            || PredictionError::NoContact { loading: "a surface of less than two asperities".into() };
        let all = Sample::new(heights).ok_or_else(too_few)?;
        Ok(Self { asperity_density: surface.asperity_density, asperities, all, of_class })
    }

    fn integral<'a>(&'a self, asperities: &Asperities<'a>, tolerance: f64) -> SurfaceIntegral<'a> {
        let parts =
            if self.of_class.is_empty() { std::slice::from_ref(&self.all) } else { &self.of_class[..] };
        let integrals = parts.iter().zip(asperities.classes()).map(|(heights, (_, asperity))| {
            let count = heights.measured().map_or(0, <[f64]>::len);
            let share = count as f64 / self.asperities as f64;
            (share, HeightIntegral::new(asperity.clone(), heights, self.asperity_density, tolerance))
        });
        SurfaceIntegral::of_parts(integrals.filter(|(share, _)| *share > 0.0).collect())
    }

    /// At every pressure or separation and slip rate, row by row.
    pub(super) fn states(
        &self,
        law: &dyn AsperityLaw,
        laws: &[LawAtRate],
        predictors: &[Predictor],
        query: &Query,
        settings: &Settings,
    ) -> Result<Vec<SampledState>, PredictionError> {
        let plane = MeanPlane::new(query.interaction, law)?;
        let mut states = Vec::new();
        for (row, &value) in query.loading.values().iter().enumerate() {
            let of_row = &predictors[row * laws.len()..];
            for (rate, (law_at_rate, predictor)) in laws.iter().zip(of_row).enumerate() {
                let (separation, state) =
                    self.slid(law_at_rate, *predictor, query, (value, plane), settings.tolerance)?;
                let contacts = state.contact_density / self.asperity_density * self.asperities as f64;
                let state = SlipState::at_separation(separation, &state, plane);
                let state = state.within(law, settings, &|| Place::of(query, row, rate))?;
                states.push(SampledState { state, contacts });
            }
        }
        Ok(states)
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
        let find = |integral: &mut SurfaceIntegral, pressure: f64| {
            separation_for(integral, &self.all, pressure, predictor, tolerance)
        };
        if query.control == LoadingControl::Separation {
            let separation = match query.loading {
                NormalLoading::Separation(_) => value,
                NormalLoading::Pressure(_) => {
                    let displacement = plane.displacement(Estimate { value, error: 0.0 });
                    find(&mut before, value)?.separation - displacement.value
                }
            };
            let effective = plane.effective_separation(&mut after, &self.all, separation, tolerance)?;
            return Ok((effective, after.at(effective)?));
        }
        let pressure = match query.loading {
            NormalLoading::Pressure(_) => value,
            NormalLoading::Separation(_) => {
                let effective = plane.effective_separation(&mut before, &self.all, value, tolerance)?;
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
