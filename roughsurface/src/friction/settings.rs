//! Settings of a prediction, and the reasons of its failure.

use crate::integral::separation::SeparationError;
use tables::law::LookupError;

/// How a prediction is computed.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Relative error of integrals and pressures.
    pub tolerance: f64,
    /// Slips on the curve.
    pub slip_points: usize,
    /// Extrapolate the law beyond its range instead of refusing.
    pub extrapolate: bool,
    /// Temperature from which on a contact counts as melting, K, where it is known.
    pub melting_temperature: Option<f64>,
}

impl Default for Settings {
    /// Integrals to 1e-6 and neighbouring slips 6 % apart: both far below the errors of tables.
    fn default() -> Self {
        Self { tolerance: 1e-6, slip_points: 200, extrapolate: false, melting_temperature: None }
    }
}

/// Reason of a failed prediction.
#[derive(Clone, Debug, thiserror::Error)]
pub enum PredictionError {
    #[error(transparent)]
    Lookup(#[from] LookupError),
    #[error(transparent)]
    Separation(#[from] SeparationError),
    #[error(
        "at {loading} and {slip_rate} m/s asperities pressed beyond {limit:.4} omega_c, where the table ends, carry {:.2} % of the load; a table up to about {reach:.4} omega_c would do, or extrapolate",
        100.0 * .share
    )]
    OutsideTable { loading: String, slip_rate: f64, limit: f64, reach: f64, share: f64 },
    #[error("{loading} leaves no asperity in contact")]
    NoContact { loading: String },
}
