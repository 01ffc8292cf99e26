//! The influence of the short-wavelength cut-off of a topography on friction.

use crate::friction::predict::predict;
use crate::friction::result::{Friction, Prediction};
use crate::friction::settings::{PredictionError, Settings};
use crate::surface::heights::Gaussian;
use crate::surface::query::Surface;
use crate::surface::radii::Radii;
use crate::topography::characterize::Characterization;
use crate::topography::nayak::Nayak;
use tables::law::AsperityLaw;

/// A topography with another cut-off.
#[derive(Clone, Debug)]
pub struct AtCutoff {
    /// m.
    pub cutoff: f64,
    pub summits: Nayak,
    /// By row (pressure or separation) and slip rate, as in [`Prediction`].
    pub friction: Result<Vec<Vec<Friction>>, PredictionError>,
}

impl AtCutoff {
    /// The `prediction` of the summits of `measured` from their moments, and those at half and at twice the
    /// cut-off, by ascending cut-off.
    pub fn around(
        measured: &Characterization,
        law: &dyn AsperityLaw,
        prediction: &Prediction,
        settings: &Settings,
    ) -> Vec<Self> {
        let (cutoff, summits) = (measured.cutoff, measured.summits);
        let mut all = vec![Self { cutoff, summits, friction: Ok(prediction.friction.clone()) }];
        all.extend(measured.other_cutoffs.iter().map(|other| {
            let Nayak { density, radius, std, .. } = other.summits;
            let heights = Box::new(Gaussian::new(std));
            let surface =
                Surface { asperity_density: density, asperity_radius: Radii::from(radius), heights };
            let predicted = predict(law, &surface, &prediction.query, settings, &|_, _| ());
            let friction = predicted.map(|prediction| prediction.friction);
            Self { cutoff: other.cutoff, summits: other.summits, friction }
        }));
        all.sort_by(|one, other| one.cutoff.total_cmp(&other.cutoff));
        all
    }
}
