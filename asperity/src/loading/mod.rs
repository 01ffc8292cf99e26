//! The loading of one asperity: the normal loading (press), then the sliding (slide).
//!
//! Contains the scene in dimensionless form (`problem`), the press and the slide with their step control, the bracket
//! of sliding inception, the coupling of mechanics, contact edge and heat within a step, the states of a slide (`state`) and
//! their recorded fields ([`recording`], [`body_fields`]). It computes one run at one resolution; [`simulate`](mod@crate::simulate) chooses
//! resolutions and estimates errors.
//!
//! Depends on `crate::heat` and the rooms below it. Chapters "One asperity" and "Equilibrium" of the book.

pub mod body_fields;
mod energy_release;
pub(crate) mod inception;
mod mobilisation;
pub(crate) mod press;
pub(crate) mod problem;
pub mod recording;
pub(crate) mod slide;
pub(crate) mod state;

/// Relative residual at which a step counts as solved: values are then off by some 1e-5, a hundredth of the error of the
/// finest usual mesh.
pub(crate) const NEWTON_TOLERANCE: f64 = 2e-6;
