//! First Piola–Kirchhoff stress and its derivative from stress and moduli in logarithmic strain
//! (Miehe, Apel & Lambrecht 2002, Comput. Methods Appl. Mech. Engrg 191, 5383).
//!
//! With E = ½ ln C, its conjugate stress T, and dT = D:dE, in the frame of the eigenvectors of C:
//! S_ab = 2f[a,b] T_ab and dS = (4 f f D + second derivative of E along T):½dC; P = FS.

use super::gradient::{TwoPoint, after};
use super::spectral::{PAIR, PLACE, Spectral, into_frame, triple};
use crate::lanes::{Lanes, add_scaled, fma};

/// Independent entries of the symmetric ∂P/∂F: 9·10/2, row by row.
pub const ENTRIES: usize = 45;

/// Moduli in logarithmic strain: c₀·dev + c₁ n⊗n.
pub struct LogModuli<const W: usize> {
    pub shear: Lanes<W>,
    pub radial: Lanes<W>,
    /// n by pairs, if anything flows.
    pub direction: Option<[Lanes<W>; 6]>,
}

/// Place of row i, column j ≥ i of a symmetric 9 × 9 matrix.
const fn entry(i: usize, j: usize) -> usize {
    i * (17 - i) / 2 + j
}

/// What the two results share at one point.
pub struct PointFrame<const W: usize> {
    spectral: Spectral<W>,
    /// F times the eigenvectors, as columns.
    image: TwoPoint<W>,
    /// T in the frame.
    log_stress: [Lanes<W>; 6],
    /// S in the frame.
    stress: [Lanes<W>; 6],
}

impl<const W: usize> PointFrame<W> {
    #[inline(always)]
    pub fn new(spectral: Spectral<W>, f: &TwoPoint<W>, log_stress: &[Lanes<W>; 6]) -> Self {
        let mut image = [[[0.0; W]; 3]; 3];
        for i in 0..3 {
            for a in 0..3 {
                for (j, row) in spectral.frame.iter().enumerate() {
                    for l in 0..W {
                        image[i][a][l] = fma(f[i][j][l], row[a][l], image[i][a][l]);
                    }
                }
            }
        }
        let log_stress = into_frame(&spectral.frame, log_stress);
        let mut stress = log_stress;
        for (s, first) in stress.iter_mut().zip(&spectral.first) {
            for l in 0..W {
                s[l] *= 2.0 * first[l];
            }
        }
        Self { spectral, image, log_stress, stress }
    }

    /// P = F S.
    #[inline(always)]
    pub fn first_piola(&self) -> TwoPoint<W> {
        let mut p = [[[0.0; W]; 3]; 3];
        for (v, &(a, b)) in PAIR.iter().enumerate() {
            for i in 0..3 {
                for j in 0..3 {
                    let frame = &self.spectral.frame[j];
                    for l in 0..W {
                        let mut part = self.image[i][a][l] * frame[b][l];
                        if v >= 3 {
                            part = fma(self.image[i][b][l], frame[a][l], part);
                        }
                        p[i][j][l] = fma(self.stress[v][l], part, p[i][j][l]);
                    }
                }
            }
        }
        p
    }

    /// ∂P/∂F of the deviatoric part.
    #[inline(always)]
    pub fn tangent(&self, moduli: &LogModuli<W>) -> [Lanes<W>; ENTRIES] {
        let material = self.material_moduli(moduli);
        let frame = &self.spectral.frame;
        // X_ab = ½dC_ab = weights·dF, twice that for a ≠ b, so that both places of a shear count.
        let mut weights = [[[0.0; W]; 9]; 6];
        for (v, &(a, b)) in PAIR.iter().enumerate() {
            for i in 0..3 {
                for j in 0..3 {
                    let weight = &mut weights[v][3 * i + j];
                    for l in 0..W {
                        weight[l] = self.image[i][a][l] * frame[j][b][l];
                        if v >= 3 {
                            weight[l] = fma(self.image[i][b][l], frame[j][a][l], weight[l]);
                        }
                    }
                }
            }
        }
        let mut tangent = [[0.0; W]; ENTRIES];
        for v in 0..6 {
            let mut row = [[0.0; W]; 9];
            for w in 0..6 {
                for (entry, weight) in row.iter_mut().zip(&weights[w]) {
                    for l in 0..W {
                        entry[l] = fma(material[v][w][l], weight[l], entry[l]);
                    }
                }
            }
            for i in 0..9 {
                for j in i..9 {
                    let target = &mut tangent[entry(i, j)];
                    for l in 0..W {
                        target[l] = fma(weights[v][i][l], row[j][l], target[l]);
                    }
                }
            }
        }
        // δ_ik S_JL.
        for j in 0..3 {
            for m in j..3 {
                let mut s = [0.0; W];
                for (v, &(a, b)) in PAIR.iter().enumerate() {
                    for l in 0..W {
                        let mut part = frame[j][a][l] * frame[m][b][l];
                        if v >= 3 {
                            part = fma(frame[j][b][l], frame[m][a][l], part);
                        }
                        s[l] = fma(self.stress[v][l], part, s[l]);
                    }
                }
                for i in 0..3 {
                    add_scaled(&mut tangent[entry(3 * i + j, 3 * i + m)], 1.0, &s);
                }
            }
        }
        tangent
    }

    /// ∂S/∂(½C) in the frame, by pairs.
    #[inline(always)]
    fn material_moduli(&self, moduli: &LogModuli<W>) -> [[Lanes<W>; 6]; 6] {
        let (first, second) = (&self.spectral.first, &self.spectral.second);
        let direction = moduli.direction.as_ref().map(|n| into_frame(&self.spectral.frame, n));
        let mut material = [[[0.0; W]; 6]; 6];
        for v in 0..6 {
            for w in v..6 {
                let deviatoric = match (v < 3, w < 3) {
                    (true, true) if v == w => 2.0 / 3.0,
                    (true, true) => -1.0 / 3.0,
                    (false, false) if v == w => 0.5,
                    _ => 0.0,
                };
                let mut sum = [0.0; W];
                for l in 0..W {
                    sum[l] = 4.0 * first[v][l] * first[w][l] * (deviatoric * moduli.shear[l]);
                }
                // One test for all lanes: inside the loop it keeps them from the vector units.
                if let Some(n) = &direction {
                    for l in 0..W {
                        let flow = moduli.radial[l] * n[v][l] * n[w][l];
                        sum[l] = fma(4.0 * first[v][l] * first[w][l], flow, sum[l]);
                    }
                }
                material[v][w] = sum;
            }
        }
        for (v, w, f, t) in SECOND_DERIVATIVE {
            for l in 0..W {
                material[v][w][l] = fma(2.0 * second[f][l], self.log_stress[t][l], material[v][w][l]);
            }
        }
        for v in 0..6 {
            for w in 0..v {
                material[v][w] = material[w][v];
            }
        }
        material
    }
}

/// Terms of T:d²E[X, Y] with X = e_p e_q and Y = e_r e_s, made symmetric in each: pair of X, that of
/// Y, not before it, and the places of the second difference and of the stress.
const SECOND_DERIVATIVE: [(usize, usize, usize, usize); SECOND_TERMS] = {
    let mut terms = [(0, 0, 0, 0); SECOND_TERMS];
    let (mut count, mut at) = (0, 0);
    while at < 36 * 4 {
        let (v, w) = (at / 24, at / 4 % 6);
        let ((p, q), (r, s)) = (PAIR[v], PAIR[w]);
        // The index that X and Y share, and the two others.
        let (equal, a, b, c) = match at % 4 {
            0 => (q == r, p, q, s),
            1 => (p == r, q, p, s),
            2 => (q == s, p, q, r),
            _ => (p == s, q, p, r),
        };
        if v <= w && equal {
            terms[count] = (v, w, triple(a, b, c), PLACE[a][c]);
            count += 1;
        }
        at += 1;
    }
    assert!(count == SECOND_TERMS);
    terms
};
/// Of 21 pairs of pairs those that share an index, once for each way they do (asserted above).
const SECOND_TERMS: usize = 33;

/// Places of ∂²J/∂F∂F, each with row and column of F and the sign of the two permutations.
const CURVATURE: [(usize, usize, usize, f64); 18] = {
    let mut places = [(0, 0, 0, 0.0); 18];
    let (mut place, mut at) = (0, 0);
    while at < 27 {
        // (i, k) is a pair of rows, i < k, m the third row; j and n are columns, o the third one.
        let (i, k) = [(0, 1), (0, 2), (1, 2)][at / 9];
        let (j, n) = ((at / 3) % 3, at % 3);
        if n != j {
            let (m, o) = (3 - i - k, 3 - j - n);
            // ε_ikm for i < k: negative for (r, z) alone.
            let sign = if (k == after(i)) == (n == after(j)) { 1.0 } else { -1.0 };
            places[place] = (entry(3 * i + j, 3 * k + n), m, o, sign);
            place += 1;
        }
        at += 1;
    }
    places
};

/// Adds `factor`·∂²J/∂F∂F, which is F itself with the signs of two permutations.
#[inline(always)]
pub fn add_volume_curvature<const W: usize>(
    factor: &Lanes<W>,
    f: &TwoPoint<W>,
    tangent: &mut [Lanes<W>; ENTRIES],
) {
    for (place, m, o, sign) in CURVATURE {
        for l in 0..W {
            tangent[place][l] += sign * factor[l] * f[m][o][l];
        }
    }
}

/// y = A x for a symmetric 9 × 9 matrix, whose entries are `at(place)`.
#[inline(always)]
pub fn symmetric_product<'a, const W: usize>(
    at: impl Fn(usize) -> &'a [f32],
    x: &TwoPoint<W>,
) -> TwoPoint<W> {
    let mut y = [[[0.0; W]; 3]; 3];
    for i in 0..9 {
        for j in i..9 {
            let stored = at(entry(i, j));
            let a: Lanes<W> = std::array::from_fn(|l| f64::from(stored[l]));
            for l in 0..W {
                y[i / 3][i % 3][l] = fma(a[l], x[j / 3][j % 3][l], y[i / 3][i % 3][l]);
            }
            if i != j {
                for l in 0..W {
                    y[j / 3][j % 3][l] = fma(a[l], x[i / 3][i % 3][l], y[j / 3][j % 3][l]);
                }
            }
        }
    }
    y
}
