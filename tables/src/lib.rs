//! The single-asperity response: load, friction and contact area of a spherical asperity
//! against interference, slip rate and slip.
//!
//! | room | content |
//! |---|---|
//! | [`quantity`] | the one list of quantities, values and histories keyed by it, numbers as text |
//! | [`law`] | interface of the single-asperity response, of tables and closed forms |
//! | [`closed_forms`] | models of the literature |
//! | [`table`] | axes, cells and their state, merging, comparison |
//! | [`interpolation`] | a table between its points, below and above them, at other radii and temperatures |
//! | [`refinement`] | cross-validation, error statistics, points that a table lacks |
//! | [`netcdf`] | files: datasets, tables, checksums, comma-separated values |
//! | [`figures`] | panels of curves, maps and cells |
//! | [`shipped`] | tables that come with the crate |
//!
//! A room depends on those above it only. `asperity` computes the tables, `roughsurface` reads them.

pub mod closed_forms;
pub mod figures;
pub mod interpolation;
pub mod law;
pub mod netcdf;
pub mod quantity;
pub mod refinement;
pub mod shipped;
pub mod table;

pub use quantity::numbers;
