//! Largest von Mises stress of the body.

use super::{Body, BodyState, TENSOR};
use crate::discretisation::element::POINTS;

/// The largest von Mises stress of a body, in units of σ_Y at the initial temperature.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LargestMises {
    /// Over the Gauss points, where yield is decided. A bilinear element has constant axial strain over its height and
    /// constant radial strain over its width: away from its centre they are wrong to first order in its size, with
    /// opposite signs on opposite sides.
    pub at_points: f64,
    /// Over the means of the four points of an element, in which that error cancels.
    pub of_elements: f64,
}

impl Body {
    pub fn largest_mises(&self, state: &BodyState) -> LargestMises {
        let lanes = self.mesh.sectors.columns();
        let mut largest = LargestMises::default();
        for e in 0..self.mesh.elements.len() {
            for lane in 0..lanes {
                let deviator = |q: usize| -> [f64; TENSOR] {
                    std::array::from_fn(|i| state.deviator[((e * POINTS + q) * TENSOR + i) * lanes + lane])
                };
                let mut mean = [0.0; TENSOR];
                for q in 0..POINTS {
                    let at_point = deviator(q);
                    largest.at_points = largest.at_points.max(mises(&at_point));
                    mean.iter_mut().zip(at_point).for_each(|(mean, s)| *mean += s / POINTS as f64);
                }
                largest.of_elements = largest.of_elements.max(mises(&mean));
            }
        }
        largest
    }
}

/// √(3/2 s:s) of (rr, θθ, zz, rθ, θz, zr).
fn mises(deviator: &[f64; TENSOR]) -> f64 {
    let weights = [1.5, 1.5, 1.5, 3.0, 3.0, 3.0];
    deviator.iter().zip(weights).map(|(s, weight)| weight * s * s).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniaxial_and_shear_stress() {
        let tension = [-1.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0, 0.0, 0.0, 0.0];
        assert!((mises(&tension) - 1.0).abs() < 1e-15);
        assert!((mises(&[0.0, 0.0, 0.0, 0.0, 0.0, 2.0]) - 12f64.sqrt()).abs() < 1e-15);
    }
}
