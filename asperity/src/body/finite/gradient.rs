//! Displacement gradient at the Gauss points, its transpose, and what follows from it alone.
//!
//! Two-point tensors have components (i, J), the first and the second index in the orthonormal
//! basis (e_r, e_θ, e_z) of the material point before deformation: `h[i][j]` = ∂u_i/∂X_J.

use super::spectral::PAIR;
use crate::element::{CORNERS, ShapeAtPoint, VALUES};
use crate::lanes::{Lanes, add_scaled};

/// Components (i, J).
pub type TwoPoint<const W: usize> = [[Lanes<W>; 3]; 3];

/// ∂u_i/∂X_J at a Gauss point.
#[inline(always)]
pub fn displacement_gradient<const W: usize>(
    shape: &[ShapeAtPoint; CORNERS],
    values: &[[Lanes<W>; VALUES]; CORNERS],
) -> TwoPoint<W> {
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
    stress: &TwoPoint<W>,
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
pub fn deformation_gradient<const W: usize>(h: &TwoPoint<W>) -> TwoPoint<W> {
    let mut f = *h;
    for (i, row) in f.iter_mut().enumerate() {
        for value in &mut row[i] {
            *value += 1.0;
        }
    }
    f
}

/// C − 1 = h + hᵀ + hᵀh, by pairs.
#[inline(always)]
pub fn cauchy_green_excess<const W: usize>(h: &TwoPoint<W>) -> [Lanes<W>; 6] {
    let mut c = [[0.0; W]; 6];
    for (v, &(a, b)) in PAIR.iter().enumerate() {
        for l in 0..W {
            c[v][l] = h[a][b][l] + h[b][a][l];
            for row in h {
                c[v][l] += row[a][l] * row[b][l];
            }
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
pub fn cofactors<const W: usize>(f: &TwoPoint<W>) -> TwoPoint<W> {
    let mut cofactors = [[[0.0; W]; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let (k, m, n, o) = (after(i), after(after(i)), after(j), after(after(j)));
            for l in 0..W {
                cofactors[i][j][l] = f[k][n][l] * f[m][o][l] - f[k][o][l] * f[m][n][l];
            }
        }
    }
    cofactors
}

/// J − 1, to all digits for small gradients: tr h + tr cof h + det h.
#[inline(always)]
pub fn volume_excess<const W: usize>(h: &TwoPoint<W>) -> Lanes<W> {
    let cofactors = cofactors(h);
    let mut excess = [0.0; W];
    for l in 0..W {
        for i in 0..3 {
            excess[l] += h[i][i][l] + cofactors[i][i][l] + h[0][i][l] * cofactors[0][i][l];
        }
    }
    excess
}
