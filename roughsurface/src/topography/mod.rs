//! From measured topography to the summits of a rough surface.
//!
//! Height maps and profiles are [read](readers::read), a trend is subtracted, and short wavelengths that the
//! instrument did not resolve ([`spectrum`]) are filtered out ([`filter`], ISO 16610). The remainder gives the
//! [`moments`] m0, m2, m4 (m², 1, 1/m²) and from them the summits of a Gaussian surface ([`nayak`]); the
//! [`summits`] are also searched for directly. [`characterize`](characterize::characterize) performs all steps;
//! [`two_faces`] adds a rough face on the other side.
//! Depends on `surface` for reading files and the wording of messages only. Chapter "Rough surfaces" of the book, "From topography".

pub mod characterize;
mod detrend;
mod edges;
mod fft;
pub mod filter;
pub mod moments;
pub mod nayak;
mod noise;
mod plausibility;
pub mod readers;
pub mod report;
pub mod spectrum;
pub mod summits;
pub mod two_faces;
pub mod warning;

#[cfg(test)]
mod synthetic;

use std::path::PathBuf;

use crate::surface::messages::short;
use warning::Warning;

/// Heights on a regular grid: a map, or a profile if there is one row only.
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
    /// Assumptions and changes in reading.
    pub remarks: Vec<Warning>,
}

impl Topography {
    /// Number of rows and of points in a row, each with their distance (m), and heights row by row (m).
    pub fn map(rows: (usize, f64), columns: (usize, f64), heights: Vec<f64>) -> Self {
        Self {
            rows: rows.0,
            row_step: rows.1,
            columns: columns.0,
            column_step: columns.1,
            heights,
            periodic: false,
            remarks: Vec::new(),
        }
    }

    /// Heights (m) at points `step` (m) apart.
    pub fn profile(step: f64, heights: Vec<f64>) -> Self {
        Self::map((1, step), (heights.len(), step), heights)
    }

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

    /// The shorter extent; of a profile that along it, m.
    pub fn shorter_extent(&self) -> f64 {
        let (across, along) = self.size();
        if self.is_profile() { along } else { across.min(along) }
    }

    /// Mean square of the heights, m².
    pub(crate) fn mean_square(&self) -> f64 {
        self.heights.iter().map(|z| z * z).sum::<f64>() / self.heights.len() as f64
    }
}

/// An error in a topography, in one line.
#[derive(Debug, thiserror::Error)]
#[error("{}: {}", .file.display(), short(.what))]
pub struct TopographyError {
    pub file: PathBuf,
    pub what: String,
}
