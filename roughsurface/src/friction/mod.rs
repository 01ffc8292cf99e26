//! Friction of a rough surface: the friction–slip curve and the quantities that follow from it.
//!
//! For every pressure (or separation) and slip rate the surface is pressed, then slid; after the
//! slip s its friction coefficient is μ(s) = ∫ Q(ω, V, s) φ dz / ∫ P(ω, V, s) φ dz ([`predict()`]). Static
//! friction ([`slip_curve`]) and the weakening energy ([`weakening`]) follow from that curve. Sliding friction is that with Q and P
//! averaged over the life of each contact; dμ/d ln V and a law of rate dependence follow from it at several slip
//! rates ([`rate_dependence`], [`rate_law`]). [`rate_step`] is the response of steady sliding to a step of the slip rate.
//! [`contacts`] gives the temperatures of the contacts and the shares of the load by regime, [`regime`] the shares of
//! elastic, plastic and melting contacts. [`comparison`] repeats the prediction with closed forms, [`cutoff`] with other
//! cut-offs of a topography, and [`quantities`] lists every result. Depends on `integral`, `topography` and `surface`.
//!
//! Under load control the separation decreases as asperities lose load, so that the interference of each asperity grows
//! during the slide. A table contains slides at constant interference only: the response of an asperity at ω after the
//! slip s is taken from the slide at that ω throughout. At sliding inception the separation has hardly changed and the
//! error is small; the difference from `hold = "separation"` bounds it. Chapter "Rough surfaces" of the book.

pub mod comparison;
pub(crate) mod confidence;
pub mod contacts;
pub mod cutoff;
mod hottest;
pub mod limits;
mod predict;
pub mod quantities;
pub mod rate_dependence;
pub mod rate_law;
pub mod rate_step;
pub mod regime;
mod result;
mod settings;
pub mod slip_curve;
mod sweep;
#[cfg(test)]
mod tests;
pub mod warning;
pub mod weakening;

pub use predict::predict;
pub use result::{Friction, Prediction};
pub(crate) use settings::in_order;
pub use settings::{PredictionError, Settings};
