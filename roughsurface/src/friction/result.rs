//! Results of a prediction.

use crate::friction::contacts::Contacts;
use crate::friction::rate_law::RateLaws;
use crate::friction::rate_step::RateStepResponse;
use crate::friction::slip_curve::SlipState;
use crate::friction::warning::Warning;
use crate::surface::query::Query;
use tables::law::Estimate;

/// Friction of the surface at one pressure or separation and one slip rate; units and meanings in
/// [`QUANTITIES`](crate::friction::quantities::QUANTITIES).
#[derive(Clone, Debug)]
pub struct Friction {
    /// Static friction coefficient, see [`inception`](crate::friction::slip_curve::inception).
    pub mu_static: Estimate,
    /// Slip at which it is reached, m.
    pub inception_slip: Estimate,
    /// Energy released by weakening, J per m² of nominal area, see
    /// [`weakening_energy`](crate::friction::weakening::weakening_energy).
    pub weakening_energy: Estimate,
    /// Slip over which friction weakens, m, see
    /// [`weakening_distance`](crate::friction::weakening::weakening_distance).
    pub weakening_distance: Estimate,
    /// Energy that the asperities release from full stick to full slip, J per m² of nominal area; none
    /// where the law does not state it.
    pub energy_release: Option<Estimate>,
    /// State before the slide.
    pub pressed: SlipState,
    /// State in steady sliding, with contacts of all ages of their life: sliding friction.
    pub sliding: SlipState,
    /// Sliding friction coefficient of contacts that last.
    pub mu_steady: Estimate,
    /// Temperatures and regimes of the contacts at the end of the slide.
    pub contacts: Contacts,
    /// dμ/d ln V of sliding friction, see
    /// [`rate_sensitivity`](crate::friction::rate_dependence::rate_sensitivity).
    pub rate_sensitivity: Estimate,
    /// Friction coefficient at each slip.
    pub mu_history: Vec<Estimate>,
    /// Largest share of the load beyond the range of the law, at any slip.
    pub outside_table: f64,
}

impl Friction {
    /// The result where the law does not state how sliding begins, nor friction after the slips of the first `known` states.
    pub(crate) fn without_inception(mut self, known: usize) -> Self {
        self.mu_history.iter_mut().skip(known).for_each(|mu| *mu = Estimate::UNKNOWN);
        let unknown = Estimate::UNKNOWN;
        Self {
            mu_static: unknown,
            inception_slip: unknown,
            weakening_energy: unknown,
            weakening_distance: unknown,
            energy_release: self.energy_release.map(|_| unknown),
            ..self
        }
    }
}

/// Result of a query.
#[derive(Clone, Debug)]
pub struct Prediction {
    pub query: Query,
    /// Name of the asperity law.
    pub law: String,
    /// The request that it was computed from, as TOML; empty for a formula.
    pub request: String,
    /// Slips of the histories, m.
    pub slip: Vec<f64>,
    /// One row per pressure or separation, one column per slip rate.
    pub friction: Vec<Vec<Friction>>,
    /// √(σ_s/ω_c) of heights of standard deviation σ_s, ω_c at the mean radius.
    pub plasticity_index: f64,
    /// Laws of rate dependence per pressure or separation.
    pub rate_laws: Vec<RateLaws>,
    /// The response to a step of the slip rate, if the query has one.
    pub rate_step: Option<RateStepResponse>,
    /// Limits of validity that the prediction reaches.
    pub warnings: Vec<Warning>,
}

impl Prediction {
    /// Pressure (Pa) or separation (m), slip rate (m/s) and friction of every cell, row by row.
    pub fn cells(&self) -> impl Iterator<Item = (f64, f64, &Friction)> {
        self.query.cells().zip(self.friction.iter().flatten()).map(|((load, rate), cell)| (load, rate, cell))
    }
}
