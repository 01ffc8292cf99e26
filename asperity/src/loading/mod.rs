//! The loading of one asperity: the normal loading (press), then the sliding (slide).
//!
//! Here: the scene in dimensionless form ([`problem`]), the press and the slide with their step
//! control, the bracket of sliding inception, the coupling of mechanics, contact edge and heat within
//! a step, the states of a slide ([`state`]) and their recorded fields ([`recording`],
//! [`body_fields`]). One run at one resolution; resolutions and errors are chosen in
//! [`crate::simulate`].
//!
//! Depends on solver, interface, heat, discretisation, material, scene. Book: "One asperity", loading,
//! coupling and step control.

pub mod body_fields;
pub(crate) mod inception;
pub(crate) mod press;
pub(crate) mod problem;
pub mod recording;
pub(crate) mod slide;
pub(crate) mod state;

/// Relative residual at which a step counts as solved.
pub(crate) const NEWTON_TOLERANCE: f64 = 2e-7;
