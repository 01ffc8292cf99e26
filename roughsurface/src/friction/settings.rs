//! Settings of a prediction, and the reasons of its failure.

use crate::friction::warning::Place;
use crate::integral::law_source::SceneConstants;
use crate::integral::separation::SeparationError;
use rayon::prelude::*;
use tables::law::{LARGEST_CONTACT, LookupError};
use tables::numbers::{digits, plain};

/// How a prediction is computed.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Relative error of integrals and pressures.
    pub tolerance: f64,
    /// Slips on the curve.
    pub slip_points: usize,
    /// Keep mean pressure and friction beyond the largest contact of the model instead of refusing.
    pub extrapolate: bool,
    /// Constants of the bodies, for regimes and warnings.
    pub scene: SceneConstants,
}

impl Default for Settings {
    /// Integrals to 1e-6 and neighbouring slips 6 % apart: both far below the errors of tables.
    fn default() -> Self {
        Self { tolerance: 1e-6, slip_points: 200, extrapolate: false, scene: SceneConstants::default() }
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
        "at {loading} and {} m/s {:.2} % of the load is on asperities whose contact radius is above {LARGEST_CONTACT} of their radius (from {} omega_c on), where the model of a hemisphere ends: the summits are too sharp for this load: use larger radii, those of a longer cut-off of the roughness, or, unless the heights are exponential (the sizes of their contacts do not depend on the load), a much lower load",
        plain(*.slip_rate), 100.0 * .share, digits(*.limit, 4)
    )]
    ContactsTooLarge { loading: String, slip_rate: f64, limit: f64, share: f64 },
    #[error(
        "{at}: the contacts would cover {:.0} % of the nominal area; the model of separate asperities ends far below: take a lower pressure or a larger separation, or check density, radius and heights of the summits",
        100.0 * .share
    )]
    AreaAboveNominal { at: Place, share: f64 },
    #[error("{at}: the {quantity} is not a finite number; check the table with `asperity table check`")]
    NotFinite { at: Place, quantity: &'static str },
    #[error(
        "query.rate_step: contacts live for a slip of {life} contact radii, and the slides of the table end at {end}; contact_life must be at most {} diameters",
        0.5 * .end
    )]
    LifeBeyondHistories { life: f64, end: f64 },
    #[error("{loading} leaves no asperity in contact")]
    NoContact { loading: String },
}

/// Results of all cells, computed in parallel, in the order of the cells: the failure that is reported does not depend on the
/// threads.
pub(crate) fn in_order<C: Sync, T: Send>(
    cells: &[C],
    of: impl Fn(&C) -> Result<T, PredictionError> + Sync,
) -> Result<Vec<T>, PredictionError> {
    let all: Vec<_> = cells.par_iter().map(&of).collect();
    all.into_iter().collect()
}
