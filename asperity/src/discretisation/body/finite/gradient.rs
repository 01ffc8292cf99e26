//! Displacement gradient at the Gauss points, its transpose, and what follows from it alone.
//!
//! Two-point tensors have components (i, J), the first and the second index in the orthonormal
//! basis (e_r, e_θ, e_z) of the material point before deformation: `h[i][j]` = ∂u_i/∂X_J.

use crate::discretisation::element::{CORNERS, ShapeAtPoint, VALUES};
use crate::material::lanes::Pack;

/// Components (i, J).
pub type TwoPoint<T> = [[T; 3]; 3];

/// Components of a symmetric tensor, see [`PAIR`].
pub type Symmetric<T> = [T; 6];

/// Tensor components of the six that are stored: (rr, θθ, zz, rθ, θz, zr).
pub const PAIR: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// Place in [`PAIR`] of two indices.
pub const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// Derivatives of a corner's shape function at as many Gauss points as fit beside the angles.
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

/// F = 1 + h.
#[inline(always)]
pub fn deformation_gradient<V: Pack>(h: &TwoPoint<V>) -> TwoPoint<V> {
    let mut f = *h;
    for (i, row) in f.iter_mut().enumerate() {
        row[i] = row[i] + V::splat(1.0);
    }
    f
}

/// C − 1 = h + hᵀ + hᵀh.
#[inline(always)]
pub fn cauchy_green_excess<V: Pack>(h: &TwoPoint<V>) -> Symmetric<V> {
    let mut c = [V::splat(0.0); 6];
    for (v, (a, b)) in PAIR.into_iter().enumerate() {
        c[v] = h[a][b] + h[b][a];
        for row in h {
            c[v] = row[a].mul_add(row[b], c[v]);
        }
    }
    c
}

/// Index that follows i, cyclically.
pub const fn after(i: usize) -> usize {
    (i + 1) % 3
}

/// ∂J/∂F, the cofactors of F.
#[inline(always)]
pub fn cofactors<V: Pack>(f: &TwoPoint<V>) -> TwoPoint<V> {
    let mut cofactors = *f;
    for i in 0..3 {
        for j in 0..3 {
            let (k, m, n, o) = (after(i), after(after(i)), after(j), after(after(j)));
            cofactors[i][j] = f[k][n].mul_add(f[m][o], -(f[k][o] * f[m][n]));
        }
    }
    cofactors
}

/// J − 1, to all digits for small gradients: tr h + tr cof h + det h.
#[inline(always)]
pub fn volume_excess<V: Pack>(h: &TwoPoint<V>) -> V {
    let cofactors = cofactors(h);
    (0..3).fold(V::splat(0.0), |sum, i| sum + (h[i][i] + h[0][i].mul_add(cofactors[0][i], cofactors[i][i])))
}
