//! Displacement gradient at the Gauss points, its transpose, and what follows from it alone.
//!
//! Two-point tensors have components (i, J), the first and the second index in the orthonormal
//! basis (e_r, e_θ, e_z) of the material point before deformation: `h[i][j]` = ∂u_i/∂X_J.

use crate::element::{CORNERS, ShapeAtPoint, VALUES};
use crate::lanes::{Lanes, Pack, add_scaled};

/// Components (i, J).
pub type TwoPoint<T> = [[T; 3]; 3];

/// Components of a symmetric tensor, see [`PAIR`].
pub type Symmetric<T> = [T; 6];

/// Tensor components of the six that are stored: (rr, θθ, zz, rθ, θz, zr).
pub const PAIR: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// Place in [`PAIR`] of two indices.
pub const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// ∂u_i/∂X_J at a Gauss point.
#[inline(always)]
pub fn displacement_gradient<const W: usize>(
    shape: &[ShapeAtPoint; CORNERS],
    values: &[[Lanes<W>; VALUES]; CORNERS],
) -> TwoPoint<Lanes<W>> {
    let mut h = [[[0.0; W]; 3]; 3];
    for (n, v) in shape.iter().zip(values) {
        for i in 0..3 {
            add_scaled(&mut h[i][0], n.dr, &v[i]);
            add_scaled(&mut h[i][1], n.over_r, &v[i + 3]);
            add_scaled(&mut h[i][2], n.dz, &v[i]);
        }
        // The basis turns with θ.
        add_scaled(&mut h[0][1], -n.over_r, &v[1]);
        add_scaled(&mut h[1][1], n.over_r, &v[0]);
    }
    h
}

/// Adds the forces on the corners that work as the stress P, already times the point's weight.
#[inline(always)]
pub fn add_stress_force<const W: usize>(
    shape: &[ShapeAtPoint; CORNERS],
    stress: &TwoPoint<Lanes<W>>,
    force: &mut [[Lanes<W>; VALUES]; CORNERS],
) {
    for (n, f) in shape.iter().zip(force) {
        for i in 0..3 {
            add_scaled(&mut f[i], n.dr, &stress[i][0]);
            add_scaled(&mut f[i], n.dz, &stress[i][2]);
            add_scaled(&mut f[i + 3], n.over_r, &stress[i][1]);
        }
        add_scaled(&mut f[1], -n.over_r, &stress[0][1]);
        add_scaled(&mut f[0], n.over_r, &stress[1][1]);
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
    (0..3).fold(V::splat(0.0), |sum, i| {
        sum + (h[i][i] + h[0][i].mul_add(cofactors[0][i], cofactors[i][i]))
    })
}
