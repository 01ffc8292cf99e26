//! Resolutions and errors: the ladder of resolutions of a run (`resolution`), the error of every quantity as a function
//! of the values of its runs (`error_budget`, `scatter`, `modelling_error`), and errors of known sign (`correction`).
//!
//! Does not depend on the computation of the runs. Chapter "Errors of a run" of the book.

pub(crate) mod correction;
pub(crate) mod error_budget;
pub(crate) mod modelling_error;
pub(crate) mod resolution;
pub(crate) mod scatter;
