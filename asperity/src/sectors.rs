//! The revolution of the meridian: N_θ equal straight-sided sectors over θ ∈ [0, π].
//!
//! Fields are stored node by node, component by component, with one column for each angle
//! θ_j = jπ/N_θ, j = 0 … N_θ: `field[(node*components + component)*columns + j]`. Vectors have
//! components (u_r, u_θ, u_z). A θ-independent problem (the press) keeps a single column: the
//! same sectors, all alike.
//!
//! Fields are even (u_r, u_z, T) or odd (u_θ) in θ: the half θ < 0 mirrors this one. Forces,
//! areas, volumes and energies are those of the half body.

use std::f64::consts::PI;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sectors {
    /// N_θ over the half circle.
    pub count: usize,
    /// True when nothing depends on θ.
    pub axisymmetric: bool,
}

impl Sectors {
    pub fn full(count: usize) -> Self {
        Self { count, axisymmetric: false }
    }

    pub fn axisymmetric(count: usize) -> Self {
        Self { count, axisymmetric: true }
    }

    /// Values stored per node and component, which is also the number of harmonics.
    pub fn columns(&self) -> usize {
        if self.axisymmetric { 1 } else { self.count + 1 }
    }

    /// Sectors that are computed.
    pub fn lanes(&self) -> usize {
        if self.axisymmetric { 1 } else { self.count }
    }

    /// Sectors that each computed one stands for.
    pub fn multiplicity(&self) -> f64 {
        if self.axisymmetric { self.count as f64 } else { 1.0 }
    }

    /// Angle of a sector, Δ.
    pub fn angle(&self) -> f64 {
        PI / self.count as f64
    }

    /// √(Δ/sin Δ): the factor on radii by which straight-sided sectors have the volume of round ones.
    pub fn radius_scale(&self) -> f64 {
        (self.angle() / self.angle().sin()).sqrt()
    }

    /// θ_j of each column.
    pub fn angles(&self) -> Vec<f64> {
        (0..self.columns()).map(|j| j as f64 * self.angle()).collect()
    }

    /// Share of the half circle that belongs to column j.
    pub fn column_weight(&self, j: usize) -> f64 {
        if self.axisymmetric {
            1.0
        } else if j == 0 || j == self.count {
            0.5 / self.count as f64
        } else {
            1.0 / self.count as f64
        }
    }

    /// Spreads a θ-independent field over all columns.
    pub fn spread(&self, axisymmetric: &[f64]) -> Vec<f64> {
        axisymmetric.iter().flat_map(|&value| std::iter::repeat_n(value, self.columns())).collect()
    }
}
