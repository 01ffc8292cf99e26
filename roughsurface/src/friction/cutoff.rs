//! The influence of the short-wavelength cut-off of a topography on friction.

use crate::friction::predict::predict;
use crate::friction::result::{Friction, Prediction};
use crate::friction::settings::{PredictionError, Settings};
use crate::surface::query::{Query, Surface};
use tables::law::{AsperityLaw, covers};

/// A topography with another cut-off.
#[derive(Clone, Debug)]
pub struct PredictionAtCutoff {
    /// m.
    pub cutoff: f64,
    /// Summits per nominal area, 1/m².
    pub asperity_density: f64,
    /// Mean radius of the summits, m.
    pub asperity_radius: f64,
    /// Standard deviation of their heights, m.
    pub heights_std: f64,
    /// Results by row (pressure or separation) and slip rate, as in [`Prediction`]; none at slip rates that the law does not have at
    /// these radii, as other ones than at the cut-off of the prediction. A row may be refused alone.
    pub friction: Vec<Result<Vec<Option<Friction>>, PredictionError>>,
}

impl PredictionAtCutoff {
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
        let of_prediction = prediction.friction.iter().map(|row| Ok(row.iter().cloned().map(Some).collect()));
        let mut all = vec![at(cutoff, surface, of_prediction.collect())];
        all.extend(others.into_iter().map(|(cutoff, surface)| {
            let row = |row| where_covered(law, &surface, (&prediction.query, row), settings);
            at(cutoff, &surface, (0..prediction.friction.len()).map(row).collect())
        }));
        all.sort_by(|one, other| one.cutoff.total_cmp(&other.cutoff));
        all
    }
}

/// Friction of a row at the slip rates that the law has at all radii of the surface; the error of the others where there are
/// none.
fn where_covered(
    law: &dyn AsperityLaw,
    surface: &Surface,
    (query, row): (&Query, usize),
    settings: &Settings,
) -> Result<Vec<Option<Friction>>, PredictionError> {
    let range = surface.asperity_radius.slip_rate_range(law);
    let is_covered = |rate: &f64| covers(range, *rate);
    let mut asked = Query { rate_step: None, loading: query.loading.only(row), ..query.clone() };
    if query.slip_rates.iter().any(is_covered) {
        asked.slip_rates.retain(is_covered);
    }
    let predicted = predict(law, surface, &asked, settings, &|_, _| ())?;
    let mut found = predicted.friction.into_iter().flatten();
    Ok(query.slip_rates.iter().map(|rate| is_covered(rate).then(|| found.next()).flatten()).collect())
}
