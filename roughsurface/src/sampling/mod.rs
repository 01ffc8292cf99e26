//! Predictions for many surfaces: random finite surfaces, and surfaces with changed parameters.
//!
//! - [`finite_surface`]: surfaces of a given number of asperities, heights and radii drawn at random, and the
//!   [`scatter`] of their friction;
//! - [`uncertainty`]: standard deviations of the parameters propagated to the results, (f(x + σ) − f(x − σ))/2 for
//!   each parameter, squares added;
//! - [`case`]: a surface with the response of its asperities and the query, and all that is predicted of it.
//!
//! Depends on `friction`, `integral`, `topography` and `surface`. Chapter "Rough surfaces" of the book, "Errors".

pub mod case;
pub mod finite_surface;
pub mod scatter;
pub mod uncertainty;
