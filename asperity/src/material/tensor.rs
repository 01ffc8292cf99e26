//! Second-order tensors at a point, and the kinematics of the displacement gradient h = ∂u/∂X.
//!
//! Two-point tensors have components (i, J), the first and the second index in the orthonormal basis
//! (e_r, e_θ, e_z) of the material point before deformation: `h[i][j]` = ∂u_i/∂X_J.

use crate::material::lanes::Pack;

/// Components (i, J).
pub type TwoPoint<T> = [[T; 3]; 3];

/// Components of a symmetric tensor, see [`PAIR`].
pub type Symmetric<T> = [T; 6];

/// Tensor components of the six that are stored: (rr, θθ, zz, rθ, θz, zr).
pub const PAIR: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// Index in [`PAIR`] of a component (i, j).
pub const SYMMETRIC_INDEX: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// x:y, which counts shears twice.
#[inline(always)]
pub fn contracted<V: Pack>(x: &Symmetric<V>, y: &Symmetric<V>) -> V {
    let shears = x[3].mul_add(y[3], x[4].mul_add(y[4], x[5] * y[5]));
    x[0].mul_add(y[0], x[1].mul_add(y[1], x[2].mul_add(y[2], shears + shears)))
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
