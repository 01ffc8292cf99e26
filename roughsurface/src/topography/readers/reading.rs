//! Lengths that a file may not state.

use crate::topography::warning::Warning;

/// Lengths that a file may not state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Metres per unit of a text or npy file; 1 unless given.
    pub unit: Option<f64>,
    /// Distance between the points of a matrix or a single column of heights, m.
    pub pixel: Option<f64>,
}

impl Reading {
    /// Metres per unit: as given, else as `stated` in the file, else metres with a warning.
    pub(super) fn unit(&self, stated: Option<f64>, remarks: &mut Vec<Warning>) -> f64 {
        self.unit.or(stated).unwrap_or_else(|| {
            remarks.push(Warning::NoUnit);
            1.0
        })
    }

    /// Distance between points, m.
    pub(super) fn pixel(&self) -> Result<f64, String> {
        let missing = "the file does not state the distance of its points; give it with --pixel LENGTH";
        self.pixel.ok_or_else(|| missing.into())
    }
}
