//! Record of each run of the study: the study can be interrupted, and its estimates can be evaluated again without
//! repeating runs.

use serde::{Deserialize, Serialize};
use tables::quantity::Quantity;

use super::Role;
use crate::output::provenance::FINGERPRINT;
use crate::simulate::RunHistory;
use crate::simulate::outcome::{ErrorSource, Outcome};

/// One run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Record {
    /// Position of the scene, see [`super::scenes::study_scene`].
    pub scene: usize,
    pub role: Role,
    /// Fingerprint of the build that ran it.
    pub fingerprint: String,
    /// s, of this run alone on one thread.
    pub wall_time: f64,
    /// Result of a run without error estimates.
    #[serde(rename = "sample")]
    pub run_history: Option<RunHistory>,
    /// Result of a run with error estimates.
    pub reported: Option<Reported>,
    /// Why there is no result.
    pub failure: Option<String>,
}

impl Record {
    pub fn new(scene: usize, role: Role) -> Self {
        let fingerprint = FINGERPRINT.to_owned();
        Self { scene, role, fingerprint, wall_time: 0.0, run_history: None, reported: None, failure: None }
    }
}

/// What a run reports of the judged quantities, in their order, SI.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Reported {
    pub values: Vec<f64>,
    /// Stated errors.
    pub errors: Vec<f64>,
    /// Errors by source, in the order of [`ErrorSource::ALL`].
    pub parts: Vec<[f64; 5]>,
}

impl Reported {
    pub fn of(outcome: &Outcome, judged: &[Quantity]) -> Self {
        let estimate = |&quantity| outcome.scalars[quantity];
        let parts = |&quantity| ErrorSource::ALL.map(|source| outcome.budget.part(source, quantity));
        Self {
            values: judged.iter().map(|quantity| estimate(quantity).value).collect(),
            errors: judged.iter().map(|quantity| estimate(quantity).error).collect(),
            parts: judged.iter().map(parts).collect(),
        }
    }
}
