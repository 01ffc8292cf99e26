//! Displacement gradient at the Gauss points of an element, and its transpose.

use crate::discretisation::element::{CORNERS, ShapeAtPoint, VALUES};
use crate::material::lanes::Pack;
use crate::material::tensor::TwoPoint;

/// Derivatives of a corner's shape function at the Gauss points that share a vector register.
pub type PackedShape<V> = [[V; 3]; CORNERS];

/// (∂/∂r, 1/r, ∂/∂z) of each corner at the points that `of_points` gives.
#[inline(always)]
pub fn packed_shape<const P: usize, V: Pack>(
    of_points: [&[ShapeAtPoint; CORNERS]; P],
    spread: impl Fn([f64; P]) -> V,
) -> PackedShape<V> {
    let mut shape = [[spread([0.0; P]); 3]; CORNERS];
    for (corner, packed) in shape.iter_mut().enumerate() {
        let of_corner = of_points.map(|shape| &shape[corner]);
        *packed = [
            spread(of_corner.map(|n| n.dr)),
            spread(of_corner.map(|n| n.over_r)),
            spread(of_corner.map(|n| n.dz)),
        ];
    }
    shape
}

/// ∂u_i/∂X_J at Gauss points.
#[inline(always)]
pub fn displacement_gradient<V: Pack>(
    shape: &PackedShape<V>,
    values: &[[V; VALUES]; CORNERS],
) -> TwoPoint<V> {
    let mut h = [[V::splat(0.0); 3]; 3];
    for ([dr, over_r, dz], v) in shape.iter().zip(values) {
        for i in 0..3 {
            h[i][0] = dr.mul_add(v[i], h[i][0]);
            h[i][1] = over_r.mul_add(v[i + 3], h[i][1]);
            h[i][2] = dz.mul_add(v[i], h[i][2]);
        }
        // The basis turns with θ.
        h[0][1] = (-*over_r).mul_add(v[1], h[0][1]);
        h[1][1] = over_r.mul_add(v[0], h[1][1]);
    }
    h
}

/// Adds the forces on the corners that work as the stress P, already times the point's weight.
#[inline(always)]
pub fn add_stress_force<V: Pack>(
    shape: &PackedShape<V>,
    stress: &TwoPoint<V>,
    force: &mut [[V; VALUES]; CORNERS],
) {
    for ([dr, over_r, dz], f) in shape.iter().zip(force) {
        for i in 0..3 {
            f[i] = dr.mul_add(stress[i][0], dz.mul_add(stress[i][2], f[i]));
            f[i + 3] = over_r.mul_add(stress[i][1], f[i + 3]);
        }
        f[1] = (-*over_r).mul_add(stress[0][1], f[1]);
        f[0] = over_r.mul_add(stress[1][1], f[0]);
    }
}
