//! What one asperity does, as looked up: load, friction and contact area of a
//! spherical asperity against interference, slip rate and slip.
//!
//! A [`law::AsperityLaw`] answers that question, be it a table computed by the
//! `asperity` crate or a closed form of the literature.
//!
//! A [`table::Table`] is interpolated in the logarithms of interference and slip rate, continued
//! by the elastic asymptote below its first interference, and refused above its last. It is
//! computed for one radius and read at any: at fixed ω/ω_c, V·R and s/a₀ forces and areas scale
//! with R², lengths with R. [`quantity`] is the one list of what a table holds; [`dataset`] and
//! [`figure`] are the netCDF files and the figures of the whole project.

mod assembly;
mod bridging;
mod classic;
pub mod closed_forms;
pub mod comparison;
pub mod cross_validation;
mod csv_file;
pub mod dataset;
pub mod figure;
pub mod fracture;
mod interpolation;
pub mod law;
mod netcdf_file;
mod overview;
pub mod quantity;
pub mod refinement;
pub mod rehearsal;
pub mod schema;
mod seal;
pub mod series;
pub mod shipped;
pub mod statistics;
pub mod steffen;
pub mod table;

pub use interpolation::Extrapolated;
pub use quantity::numbers;
