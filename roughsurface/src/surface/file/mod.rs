//! The surface file: TOML that describes a surface and the query.
//!
//! Depends on `heights`, `radii` and `query`. Chapter "Surface" of the book.

mod defaults;
mod keys;
mod overrides;
mod parameter;
mod read;
#[cfg(test)]
mod tests;
mod values;

pub use overrides::{query_key, query_values};
pub use parameter::{Parameter, Uncertain};
pub use read::{SurfaceFile, SurfaceFileError};
pub use values::Values;
