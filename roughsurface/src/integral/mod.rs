//! The surface at one separation and slip (chapter "Rough surfaces" of the book, "Integrals over the heights").
//!
//! p(d) = η ∫ P(z − d) φ(z) dz, likewise friction Q, real contact area A, energy release G and mean temperature
//! (Greenwood & Williamson 1966, doi 10.1098/rspa.1966.0242), summed over the classes of the summit radii.
//!
//! - [`law_source`]: the single-asperity response, a table or a closed form; [`asperity_at_slip`]: the response at
//!   a fixed slip rate and slip, continued beyond the largest contact; [`rate_step`]: that after a step of the slip
//!   rate;
//! - `kronrod`, `panels`, [`height_integral`]: adaptive Gauss–Kronrod panels in √(ω/ω_c), stored for all separations;
//! - [`surface_integral`]: the sum over radii; [`contact_state`]: its result;
//! - [`separation`], [`predictor`]: the separation in equilibrium with a pressure;
//! - [`mean_plane`]: the effective separation where the nominal pressure displaces the mean plane.
//!
//! Depends on [`surface`](crate::surface) and on [`tables`].

pub mod asperity_at_slip;
pub mod contact_state;
pub mod height_integral;
pub(crate) mod kronrod;
pub mod law_source;
mod mean_over_ages;
pub mod mean_plane;
pub(crate) mod panels;
pub mod predictor;
pub mod rate_step;
pub mod separation;
pub mod surface_integral;
#[cfg(test)]
pub(crate) mod test_laws;
