//! The single-asperity response: load, friction and contact area of a spherical asperity
//! against interference, slip rate and slip.
//!
//! | room | content |
//! |---|---|
//! | [`quantity`] | the list of quantities, values and histories by quantity, numbers as text, functions of one number |
//! | [`law`] | interface of the single-asperity response, of tables and closed forms |
//! | [`closed_forms`] | models of the literature |
//! | [`table`] | axes, cells and their state, merging, comparison |
//! | [`interpolation`] | interpolation between the points of a table, below the first interference, at other radii and temperatures |
//! | [`refinement`] | cross-validation, error statistics, points to be added to a table |
//! | [`netcdf`] | files: datasets, tables, checksums, comma-separated values |
//! | [`figures`] | panels of curves, maps and cells |
//! | [`shipped`] | tables that come with the crate |
//!
//! A room is one of these modules; it depends on those above it only. `asperity` computes the tables, `roughsurface` reads them.

pub mod closed_forms;
pub mod figures;
pub mod interpolation;
pub mod law;
pub mod netcdf;
pub mod quantity;
pub mod refinement;
pub mod shipped;
pub mod table;

pub use quantity::{functions, numbers};
