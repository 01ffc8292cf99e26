//! The influence of the short-wavelength cut-off of a topography on friction.

use crate::friction::predict::predict;
use crate::friction::result::{Friction, Prediction};
use crate::friction::settings::{PredictionError, Settings};
use crate::surface::query::Surface;
use tables::law::AsperityLaw;

/// A topography with another cut-off.
#[derive(Clone, Debug)]
pub struct AtCutoff {
    /// m.
    pub cutoff: f64,
    /// Summits per nominal area, 1/m².
    pub asperity_density: f64,
    /// Mean radius of the summits, m.
    pub asperity_radius: f64,
    /// Standard deviation of their heights, m.
    pub heights_std: f64,
    /// By row (pressure or separation) and slip rate, as in [`Prediction`].
    pub friction: Result<Vec<Vec<Friction>>, PredictionError>,
}

impl AtCutoff {
    /// The `prediction` of the `surface` of a topography with a cut-off (m), and those of the surfaces of `others`, by
    /// ascending cut-off.
    pub fn around(
        (cutoff, surface): (f64, &Surface),
        others: impl IntoIterator<Item = (f64, Surface)>,
        law: &dyn AsperityLaw,
        prediction: &Prediction,
        settings: &Settings,
    ) -> Vec<Self> {
        let at = |cutoff: f64, surface: &Surface, friction| Self {
            cutoff,
            asperity_density: surface.asperity_density,
            asperity_radius: surface.asperity_radius.mean(),
            heights_std: surface.heights.standard_deviation(),
            friction,
        };
        let mut all = vec![at(cutoff, surface, Ok(prediction.friction.clone()))];
        all.extend(others.into_iter().map(|(cutoff, surface)| {
            let predicted = predict(law, &surface, &prediction.query, settings, &|_, _| ());
            at(cutoff, &surface, predicted.map(|prediction| prediction.friction))
        }));
        all.sort_by(|one, other| one.cutoff.total_cmp(&other.cutoff));
        all
    }
}
