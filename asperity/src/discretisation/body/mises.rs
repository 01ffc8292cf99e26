//! Von Mises stress on the axis.

use super::state::value_index;
use super::{Body, BodyState, TENSOR};
use crate::discretisation::element::{CORNERS, POINTS, shape_at_points};

/// Mean stress of the four points of an element, in the first column.
///
/// A bilinear element has constant axial strain over its height and constant radial strain over its width: at its points
/// they are wrong to first order in its size, with opposite signs on opposite sides. The mean is of second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanStress {
    /// (r, z) of the points, over R.
    pub points: [[f64; 2]; POINTS],
    /// Von Mises stress of the mean, in units of σ_Y at the initial temperature.
    pub mises: f64,
}

impl Body {
    /// Mean stresses of the elements on the axis.
    pub fn mean_stresses_on_axis(&self, state: &BodyState) -> Vec<MeanStress> {
        let on_axis = |e: &usize| {
            self.mesh.elements[*e].nodes.iter().any(|&node| self.mesh.meridian.on_axis(node as usize))
        };
        let elements = (0..self.mesh.elements.len()).filter(on_axis);
        elements.map(|e| MeanStress { points: self.points(e), mises: self.mises_of_mean(state, e) }).collect()
    }

    fn points(&self, element: usize) -> [[f64; 2]; POINTS] {
        let meridian = &self.mesh.meridian;
        let nodes = self.mesh.elements[element].nodes.map(|node| node as usize);
        shape_at_points().map(|shape| {
            let weighted = |of: &dyn Fn(usize) -> f64| -> f64 {
                (0..CORNERS).map(|n| shape[n] * meridian.weights[nodes[n]] * of(nodes[n])).sum()
            };
            [0, 1].map(|d| weighted(&|node| meridian.nodes[node][d]) / weighted(&|_| 1.0))
        })
    }

    fn mises_of_mean(&self, state: &BodyState, element: usize) -> f64 {
        let lanes = self.mesh.sectors.columns();
        let at = |q: usize, i: usize| state.deviator[value_index(TENSOR, [element, i, q], lanes)];
        mises(&std::array::from_fn(|i| (0..POINTS).map(|q| at(q, i)).sum::<f64>() / POINTS as f64))
    }
}

/// √(3/2 s:s) of the deviator of (rr, θθ, zz, rθ, θz, zr).
pub fn mises(stress: &[f64; TENSOR]) -> f64 {
    let mean = stress[..3].iter().sum::<f64>() / 3.0;
    let normal: f64 = stress[..3].iter().map(|s| 1.5 * (s - mean).powi(2)).sum();
    let shear: f64 = stress[3..].iter().map(|s| 3.0 * s * s).sum();
    (normal + shear).sqrt()
}
