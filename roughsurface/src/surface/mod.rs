//! The surface and the query (chapter "Rough surfaces" of the book, "Heights and radii").
//!
//! - [`heights`]: distributions φ(z) of the summit heights, each in its own file, and their catalogue;
//! - [`radii`]: classes of summit radii;
//! - [`query`]: loading, slip rates, loading control;
//! - [`mod@file`]: the surface file (TOML), its keys, its uncertain parameters;
//! - [`units`]: units of numbers on the command line and in topographies.
//!
//! Depends on no other room.

pub mod file;
pub mod heights;
pub(crate) mod messages;
pub mod query;
pub mod radii;
pub(crate) mod text;
pub mod units;

use std::io;
use std::path::Path;
use tables::netcdf::check_regular;

/// The content of a regular file: reading a FIFO or a device might not end.
pub(crate) fn read_regular(file: &Path) -> io::Result<Vec<u8>> {
    check_regular(file).and_then(|()| std::fs::read(file))
}
