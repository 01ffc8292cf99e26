//! What one asperity does, as looked up: load, friction and contact area of a
//! spherical asperity against interference, slip rate and slip.
//!
//! A [`law::AsperityLaw`] answers that question, be it a table computed by the
//! `asperity` crate or a closed form of the literature.

mod assembly;
pub mod closed_forms;
pub mod dataset;
pub mod figure;
mod interpolation;
pub mod law;
mod netcdf_file;
mod overview;
pub mod quantity;
pub mod steffen;
pub mod table;
