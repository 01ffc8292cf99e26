//! The surface and the query: summit heights φ(z), summit radii, the surface file (TOML).
//! Depends on no other room.

pub mod file;
pub mod heights;
pub(crate) mod messages;
pub mod query;
pub mod radii;
