//! Lengths that a file may not state.

/// Lengths that a file may not state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Metres per unit of a text file; 1 unless given.
    pub unit: Option<f64>,
    /// Distance between the points of a matrix or a single column of heights, m.
    pub pixel: Option<f64>,
}
