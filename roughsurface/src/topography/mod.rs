//! From measured topography to the summits of a rough surface.
//!
//! Height maps and profiles are [read](read::read), a trend is taken off, and short wavelengths
//! that the instrument did not resolve are filtered out ([`filter`]). The [`spectrum`] of what is left
//! gives the moments m0, m2, m4 and from them the [`nayak`] summits; a direct search for
//! [`summits`] stands beside them. [`characterize`](characterize::characterize) does all of it.

pub mod characterize;
mod detrend;
mod fft;
pub mod filter;
mod gsf;
pub mod length;
pub mod nayak;
mod netcdf;
pub mod read;
pub mod report;
pub mod spectrum;
pub mod summits;
mod text;
mod x3p;

#[cfg(test)]
mod synthetic;

use std::path::{Path, PathBuf};

use crate::surface::file::short;

/// Heights on a regular grid: a map, or a profile if there is one row only.
///
/// ```
/// use roughsurface::topography::Topography;
///
/// let map = Topography {
///     rows: 2,
///     row_step: 2e-6,
///     columns: 3,
///     column_step: 1e-6,
///     heights: vec![0.0, 1e-7, 0.0, 1e-7, f64::NAN, 1e-7],
///     periodic: false,
///     remarks: Vec::new(),
/// };
/// assert!(!map.is_profile());
/// assert_eq!((map.pixel(), map.size().0), (2e-6, 4e-6));
/// assert_eq!(map.undefined(), 1.0 / 6.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Topography {
    /// Rows, and distance between them, m.
    pub rows: usize,
    pub row_step: f64,
    /// Points of a row, and distance between them, m.
    pub columns: usize,
    pub column_step: f64,
    /// Row by row, m; NaN where there is no value.
    pub heights: Vec<f64>,
    /// Whether the map continues at its other side.
    pub periodic: bool,
    /// What was assumed or changed in reading.
    pub remarks: Vec<String>,
}

impl Topography {
    pub fn is_profile(&self) -> bool {
        self.rows == 1
    }

    /// The longer step of the grid, m.
    pub fn pixel(&self) -> f64 {
        if self.is_profile() { self.column_step } else { self.row_step.max(self.column_step) }
    }

    /// Extent across rows and along them, m.
    pub fn size(&self) -> (f64, f64) {
        (self.rows as f64 * self.row_step, self.columns as f64 * self.column_step)
    }

    /// Share of the points without a value.
    pub fn undefined(&self) -> f64 {
        self.heights.iter().filter(|height| height.is_nan()).count() as f64 / self.heights.len() as f64
    }
}

/// What is wrong with a topography, in one line.
#[derive(Debug, thiserror::Error)]
#[error("{}: {}", .file.display(), short(.what))]
pub struct TopographyError {
    pub file: PathBuf,
    pub what: String,
}

impl TopographyError {
    pub(crate) fn new(file: &Path, what: impl Into<String>) -> Self {
        Self { file: file.to_path_buf(), what: what.into() }
    }
}
