//! Resolutions and errors: the ladder of resolutions of a run ([`resolution`]), and the error of every
//! quantity as a function of the values of its runs ([`error_budget`], [`modelling_error`]).
//!
//! Independent of how runs are made. Book: "Errors".

pub(crate) mod error_budget;
pub(crate) mod modelling_error;
pub(crate) mod resolution;
