//! The derivative of the first Piola-Kirchhoff stress from stress and moduli in logarithmic strain
//! (Miehe, Apel & Lambrecht 2002, Comput. Methods Appl. Mech. Engrg 191, 5383).
//!
//! With E = ½ ln C, its conjugate stress T, dT = D:dE and H = sym(FᵀdF) = ½dC, dE = K:H and
//! dS = (KDK + second derivative of E along T):H; P = FS.

use crate::material::lanes::Pack;
use crate::material::log_strain::LogStrain;
use crate::material::tensor::{SYMMETRIC_INDEX, Symmetric, TwoPoint, after, contracted};

/// Independent entries of the symmetric ∂P/∂F: 9·10/2, row by row.
pub const ENTRIES: usize = 45;

/// Moduli in logarithmic strain: c₀·dev + c₁ n⊗n.
pub struct LogModuli<V> {
    pub shear: V,
    pub radial: V,
    /// n, if anything flows.
    pub direction: Option<Symmetric<V>>,
}

/// Index of row i, column j ≥ i of a symmetric 9 × 9 matrix.
const fn entry(i: usize, j: usize) -> usize {
    i * (17 - i) / 2 + j
}

/// ∂P/∂F of the deviatoric part, of the stress T on E and S = `second`.
#[inline(always)]
pub fn tangent<V: Pack>(
    log: &LogStrain<V>,
    f: &TwoPoint<V>,
    log_stress: &Symmetric<V>,
    second: &Symmetric<V>,
    moduli: &LogModuli<V>,
) -> [V; ENTRIES] {
    let material = material_moduli(log, log_stress, moduli);
    // H_jm = ½ Σ F_ij dF_im + F_im dF_ij, so that row v of the moduli gives Σ_m F_im times the component (j, m).
    let mut rows = [[V::splat(0.0); 9]; 6];
    for v in 0..6 {
        for i in 0..9 {
            rows[v][i] = pulled(&f[i / 3], i % 3, |component| material[v][component]);
        }
    }
    let mut tangent = [V::splat(0.0); ENTRIES];
    for i in 0..9 {
        for j in i..9 {
            tangent[entry(i, j)] = pulled(&f[i / 3], i % 3, |component| rows[component][j]);
        }
    }
    // δ_ik S_JL.
    for j in 0..3 {
        for m in j..3 {
            for i in 0..3 {
                let modulus = &mut tangent[entry(3 * i + j, 3 * i + m)];
                *modulus = *modulus + second[SYMMETRIC_INDEX[j][m]];
            }
        }
    }
    tangent
}

/// Σ_m F_im x_jm of a symmetric x, given a row of F.
#[inline(always)]
fn pulled<V: Pack>(row: &[V; 3], j: usize, x: impl Fn(usize) -> V) -> V {
    let [first, middle, last] = SYMMETRIC_INDEX[j];
    row[0].mul_add(x(first), row[1].mul_add(x(middle), row[2] * x(last)))
}

/// ∂S/∂(½C) over the symmetric units of which shears are two halves.
#[inline(always)]
fn material_moduli<V: Pack>(
    log: &LogStrain<V>,
    log_stress: &Symmetric<V>,
    moduli: &LogModuli<V>,
) -> [Symmetric<V>; 6] {
    let (mut first, mut material) = log.derivatives(log_stress);
    for v in 0..6 {
        for w in 0..v {
            first[v][w] = first[w][v];
        }
    }
    // Row v is the tensor K:e_v, e_v the symmetric unit.
    let (mut trace, mut flow) = ([V::splat(0.0); 6], [V::splat(0.0); 6]);
    for v in 0..6 {
        trace[v] = first[v][0] + first[v][1] + first[v][2];
        if let Some(n) = &moduli.direction {
            flow[v] = contracted(n, &first[v]);
        }
    }
    let third = V::splat(-1.0 / 3.0) * moduli.shear;
    for v in 0..6 {
        for w in v..6 {
            let product = contracted(&first[v], &first[w]);
            let with_trace = (third * trace[v]).mul_add(trace[w], material[v][w]);
            let with_flow = (moduli.radial * flow[v]).mul_add(flow[w], with_trace);
            material[v][w] = moduli.shear.mul_add(product, with_flow);
            material[w][v] = material[v][w];
        }
    }
    material
}

/// Entries of ∂²J/∂F∂F, each with row and column of F and the sign of the two permutations.
const CURVATURE: [(usize, usize, usize, f64); 18] = {
    let mut entries = [(0, 0, 0, 0.0); 18];
    let (mut count, mut at) = (0, 0);
    while at < 27 {
        // (i, k) is a pair of rows, i < k, m the third row; j and n are columns, o the third one.
        let (i, k) = [(0, 1), (0, 2), (1, 2)][at / 9];
        let (j, n) = ((at / 3) % 3, at % 3);
        if n != j {
            let (m, o) = (3 - i - k, 3 - j - n);
            // ε_ikm for i < k: negative for (r, z) alone.
            let sign = if (k == after(i)) == (n == after(j)) { 1.0 } else { -1.0 };
            entries[count] = (entry(3 * i + j, 3 * k + n), m, o, sign);
            count += 1;
        }
        at += 1;
    }
    entries
};

/// Adds `factor`·∂²J/∂F∂F, which is F itself with the signs of two permutations.
#[inline(always)]
pub fn add_volume_curvature<V: Pack>(factor: V, f: &TwoPoint<V>, tangent: &mut [V; ENTRIES]) {
    for (index, m, o, sign) in CURVATURE {
        tangent[index] = (V::splat(sign) * factor).mul_add(f[m][o], tangent[index]);
    }
}

/// y = A x for a symmetric 9 × 9 matrix, whose entries are `at(index)`, see `entry`.
#[inline(always)]
pub fn symmetric_product<V: Pack>(at: impl Fn(usize) -> V, x: &TwoPoint<V>) -> TwoPoint<V> {
    let mut y = [[V::splat(0.0); 3]; 3];
    for i in 0..9 {
        for j in i..9 {
            let a = at(entry(i, j));
            y[i / 3][i % 3] = a.mul_add(x[j / 3][j % 3], y[i / 3][i % 3]);
            if i != j {
                y[j / 3][j % 3] = a.mul_add(x[i / 3][i % 3], y[j / 3][j % 3]);
            }
        }
    }
    y
}
