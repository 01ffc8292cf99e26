//! The surface and what is asked of it: summit heights φ(z), summit radii, the surface file (TOML).
//! Depends on no other room.

pub mod file;
pub mod heights;
pub mod query;
pub mod radii;
