//! Spectral decomposition of the right Cauchy–Green tensor, and divided differences of the
//! logarithmic strain.
//!
//! E = ½ ln C has the eigenvectors of C and the eigenvalues f(λ) = ½ ln λ. In the frame of the
//! eigenvectors its first derivative is f[λ_a, λ_b]·dC_ab and its second one takes
//! f[λ_a, λ_b, λ_c], with the divided differences of f (Bhatia, Matrix Analysis, 1997, ch. V.3;
//! Miehe & Lambrecht 2001, Commun. Numer. Meth. Engng 17, 337, who list the cases of equal
//! eigenvalues that divided differences need not tell apart).

use crate::lanes::{Lanes, fma};

/// Tensor components of the six that are stored: (rr, θθ, zz, rθ, θz, zr).
pub const PAIR: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// Place in [`PAIR`] of two indices.
pub const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// Sorted triples of eigenvalues.
const TRIPLES: usize = 10;

/// Eigenvectors as columns.
pub type Frame<const W: usize> = [[Lanes<W>; 3]; 3];

/// Logarithmic strain and its derivatives in the frame of the eigenvectors of C.
pub struct Spectral<const W: usize> {
    /// `frame[i][a]`: component i of eigenvector a.
    pub frame: Frame<W>,
    /// ½ ln λ_a.
    pub strain: [Lanes<W>; 3],
    /// f[λ_a, λ_b] by pair.
    pub first: [Lanes<W>; 6],
    /// f[λ_a, λ_b, λ_c], see [`triple`].
    pub second: [Lanes<W>; TRIPLES],
}

/// Place of f[λ_a, λ_b, λ_c], which is symmetric, in [`Spectral::second`].
pub const fn triple(a: usize, b: usize, c: usize) -> usize {
    // Numbers of indices 1 and 2 among the three tell a triple.
    let ones = (a == 1) as usize + (b == 1) as usize + (c == 1) as usize;
    let twos = (a == 2) as usize + (b == 2) as usize + (c == 2) as usize;
    [0, 4, 7, 9][twos] + ones
}

impl<const W: usize> Spectral<W> {
    /// Of C = 1 + `excess`, given by pairs: small strains keep all their digits.
    #[inline(always)]
    pub fn new(excess: &[Lanes<W>; 6]) -> Self {
        let (values, frame) = eigen(*excess);
        let mut spectral =
            Self { frame, strain: [[0.0; W]; 3], first: [[0.0; W]; 6], second: [[0.0; W]; TRIPLES] };
        spectral.set_close(&values);
        for l in 0..W {
            let excess = [values[0][l], values[1][l], values[2][l]];
            if !close(excess) {
                spectral.set_lane(l, excess);
            }
        }
        spectral
    }

    /// By the series that hold where [`close`] says so, which is nearly everywhere: all lanes at once.
    #[inline(always)]
    fn set_close(&mut self, excess: &[Lanes<W>; 3]) {
        for a in 0..3 {
            for l in 0..W {
                let x = excess[a][l];
                let inverse = 0.5 / (1.0 + x);
                self.strain[a][l] = half_log(x);
                self.first[a][l] = inverse;
                self.second[triple(a, a, a)][l] = -inverse * inverse;
            }
        }
        for (v, &(a, b)) in PAIR.iter().enumerate().skip(3) {
            let (a_a_b, a_b_b) = (triple(a, a, b), triple(a, b, b));
            for l in 0..W {
                let inverse = 1.0 / (2.0 + excess[a][l] + excess[b][l]);
                let d = (excess[b][l] - excess[a][l]) * inverse;
                self.first[v][l] = inverse * artanh_over(d);
                let (even, odd) = second_of_two(d);
                self.second[a_a_b][l] = -inverse * inverse * (even + odd);
                self.second[a_b_b][l] = -inverse * inverse * (even - odd);
            }
        }
        self.second[triple(0, 1, 2)] = second_of_close(*excess);
    }

    /// One lane, whatever the eigenvalues.
    fn set_lane(&mut self, l: usize, excess: [f64; 3]) {
        let strain = excess.map(|x| 0.5 * x.ln_1p());
        let divided = Divided { excess, strain };
        for a in 0..3 {
            self.strain[a][l] = strain[a];
        }
        for (v, &(a, b)) in PAIR.iter().enumerate() {
            self.first[v][l] = divided.first(a, b);
        }
        for a in 0..3 {
            for b in a..3 {
                for c in b..3 {
                    self.second[triple(a, b, c)][l] = divided.second(a, b, c);
                }
            }
        }
    }

    /// E itself, by pairs.
    #[inline(always)]
    pub fn log_strain(&self) -> [Lanes<W>; 6] {
        let mut e = [[0.0; W]; 6];
        for (v, &(i, j)) in PAIR.iter().enumerate() {
            for a in 0..3 {
                for l in 0..W {
                    e[v][l] += self.strain[a][l] * self.frame[i][a][l] * self.frame[j][a][l];
                }
            }
        }
        e
    }
}

/// A symmetric tensor in the frame of the eigenvectors: NᵀAN, by pairs.
#[inline(always)]
pub fn into_frame<const W: usize>(frame: &Frame<W>, tensor: &[Lanes<W>; 6]) -> [Lanes<W>; 6] {
    let mut turned = [[0.0; W]; 6];
    for a in 0..3 {
        // A·N_a.
        let mut image = [[0.0; W]; 3];
        for i in 0..3 {
            for j in 0..3 {
                for l in 0..W {
                    image[i][l] += tensor[PLACE[i][j]][l] * frame[j][a][l];
                }
            }
        }
        for (v, &(p, q)) in PAIR.iter().enumerate() {
            if q == a {
                for i in 0..3 {
                    for l in 0..W {
                        turned[v][l] += frame[i][p][l] * image[i][l];
                    }
                }
            }
        }
    }
    turned
}

/// Eigenvalues and eigenvectors of symmetric tensors by cyclic Jacobi rotations (Golub & Van Loan,
/// Matrix Computations, §8.5), which are as exact for equal eigenvalues as for others.
#[inline(always)]
fn eigen<const W: usize>(mut a: [Lanes<W>; 6]) -> ([Lanes<W>; 3], Frame<W>) {
    const SWEEPS: usize = 10;
    let mut frame = [[[0.0; W]; 3]; 3];
    for (i, row) in frame.iter_mut().enumerate() {
        row[i] = [1.0; W];
    }
    for _ in 0..SWEEPS {
        let mut open = false;
        for l in 0..W {
            let off = a[3][l] * a[3][l] + a[4][l] * a[4][l] + a[5][l] * a[5][l];
            let on = a[0][l] * a[0][l] + a[1][l] * a[1][l] + a[2][l] * a[2][l];
            open |= off > 1e-33 * on;
        }
        if !open {
            break;
        }
        // Pair (p, q) and the pairs that the third index r forms with them.
        rotate::<W, 0, 1, 3, 5, 4>(&mut a, &mut frame);
        rotate::<W, 1, 2, 4, 3, 5>(&mut a, &mut frame);
        rotate::<W, 2, 0, 5, 4, 3>(&mut a, &mut frame);
    }
    ([a[0], a[1], a[2]], frame)
}

/// Turns the axes p and q so that their shear vanishes. Places are constants and lanes the innermost
/// loops: else no vector units are used.
#[inline(always)]
fn rotate<
    const W: usize,
    const P: usize,
    const Q: usize,
    const PQ: usize,
    const RP: usize,
    const RQ: usize,
>(
    a: &mut [Lanes<W>; 6],
    frame: &mut Frame<W>,
) {
    let (mut t, mut c, mut s) = ([0.0; W], [0.0; W], [0.0; W]);
    for l in 0..W {
        let (difference, off) = (a[Q][l] - a[P][l], a[PQ][l]);
        let root = (difference * difference + 4.0 * off * off).sqrt();
        let below = difference.abs() + root + f64::MIN_POSITIVE;
        // |t| ≤ 1 but for rounding.
        t[l] = 2.0 * off * 1f64.copysign(difference) / below;
    }
    for l in 0..W {
        c[l] = 1.0 / (1.0 + t[l] * t[l]).sqrt();
        s[l] = t[l] * c[l];
    }
    for l in 0..W {
        a[P][l] -= t[l] * a[PQ][l];
        a[Q][l] += t[l] * a[PQ][l];
    }
    a[PQ] = [0.0; W];
    let turn = |x: &mut Lanes<W>, y: &mut Lanes<W>| {
        for l in 0..W {
            let (before, other) = (x[l], y[l]);
            x[l] = c[l] * before - s[l] * other;
            y[l] = s[l] * before + c[l] * other;
        }
    };
    let (mut x, mut y) = (a[RP], a[RQ]);
    turn(&mut x, &mut y);
    (a[RP], a[RQ]) = (x, y);
    for row in frame {
        let (mut x, mut y) = (row[P], row[Q]);
        turn(&mut x, &mut y);
        (row[P], row[Q]) = (x, y);
    }
}

/// Spread of the eigenvalues relative to their mean up to which the series below are exact, to
/// rounding in strain and stress and to 1e-10 in the second differences, of which the tangent alone
/// is made; quotients of differences lose digits there.
const CLOSE: f64 = 0.3;

/// Whether the series hold for eigenvalues 1 + `excess`, and for the strain itself.
#[inline(always)]
fn close(excess: [f64; 3]) -> bool {
    excess.iter().all(|x| x.abs() < 0.5 * CLOSE)
}

/// Terms of the series of artanh.
const ARTANH_TERMS: usize = 10;

/// artanh(d)/d for |d| ≤ CLOSE/2 or a little more.
#[inline(always)]
fn artanh_over(d: f64) -> f64 {
    let x = d * d;
    let mut sum = 0.0;
    for k in (0..ARTANH_TERMS).rev() {
        sum = fma(sum, x, 1.0 / (2 * k + 1) as f64);
    }
    sum
}

/// f[λ_a, λ_a, λ_b] of f = ½ ln λ is −(even + odd)/(λ_a + λ_b)², with d = (λ_b − λ_a)/(λ_b + λ_a):
/// (f[λ_a, λ_b] − f'(λ_a))/(λ_b − λ_a) by the series of both.
#[inline(always)]
fn second_of_two(d: f64) -> (f64, f64) {
    let x = d * d;
    let mut odd = 0.0;
    for k in (0..ARTANH_TERMS).rev() {
        odd = fma(odd, x, (2 * k + 2) as f64 / (2 * k + 3) as f64);
    }
    (1.0 / (1.0 - x), d * odd)
}

/// ½ ln(1 + excess) = artanh(excess/(2 + excess)).
#[inline(always)]
fn half_log(excess: f64) -> f64 {
    let d = excess / (2.0 + excess);
    d * artanh_over(d)
}

/// ln(1 + x).
#[inline(always)]
pub fn log_1p<const W: usize>(x: &Lanes<W>) -> Lanes<W> {
    if x.iter().all(|x| x.abs() < 0.5 * CLOSE) { x.map(|x| 2.0 * half_log(x)) } else { x.map(f64::ln_1p) }
}

/// f[λ_a, λ_b] by ½ ln(λ_a/λ_b) = artanh d.
#[inline(always)]
fn first_of_close(a: f64, b: f64) -> f64 {
    let sum = 2.0 + a + b;
    artanh_over((a - b) / sum) / sum
}

/// f[λ_a, λ_b, λ_c] by Taylor's series about the mean m: ½ Σ (−1)^(k+1)/(k+2) h_k(x)/m², with the
/// complete symmetric polynomials h_k of the deviations x, of which h₁ = 0 and
/// h_k = x_a x_b x_c h_(k−3) − e₂ h_(k−2).
#[inline(always)]
fn second_of_close<const W: usize>(excess: [Lanes<W>; 3]) -> Lanes<W> {
    /// |x| is at most 2/3 CLOSE.
    const TERMS: usize = 15;
    let [mut x, mut y, mut z] = excess;
    let mut scale = [0.0; W];
    for l in 0..W {
        let mean = 1.0 + (x[l] + y[l] + z[l]) / 3.0;
        scale[l] = 1.0 / mean;
        x[l] = (1.0 + x[l] - mean) * scale[l];
        y[l] = (1.0 + y[l] - mean) * scale[l];
        z[l] = (1.0 + z[l] - mean) * scale[l];
    }
    let (mut e2, mut e3) = ([0.0; W], [0.0; W]);
    for l in 0..W {
        e2[l] = x[l] * y[l] + (x[l] + y[l]) * z[l];
        e3[l] = x[l] * y[l] * z[l];
    }
    let mut h = [[1.0; W], [0.0; W], e2.map(|e| -e)];
    let mut sum = e2.map(|e| -0.25 + e / 8.0);
    for k in 3..TERMS {
        let factor = if k % 2 == 0 { -0.5 } else { 0.5 } / (k + 2) as f64;
        let mut next = [0.0; W];
        for l in 0..W {
            next[l] = e3[l] * h[0][l] - e2[l] * h[1][l];
            sum[l] += factor * next[l];
        }
        h = [h[1], h[2], next];
    }
    for l in 0..W {
        sum[l] *= scale[l] * scale[l];
    }
    sum
}

/// Divided differences of ½ ln λ at one point, λ_a = 1 + excess_a.
struct Divided {
    excess: [f64; 3],
    strain: [f64; 3],
}

impl Divided {
    fn first(&self, a: usize, b: usize) -> f64 {
        let difference = self.excess[a] - self.excess[b];
        if 2.0 * difference.abs() < CLOSE * (2.0 + self.excess[a] + self.excess[b]) {
            first_of_close(self.excess[a], self.excess[b])
        } else {
            (self.strain[a] - self.strain[b]) / difference
        }
    }

    fn second(&self, a: usize, b: usize, c: usize) -> f64 {
        // The two farthest apart divide.
        let distance = |i: usize, j: usize| (self.excess[i] - self.excess[j]).abs();
        let (far, near, middle) = [(a, b, c), (b, c, a), (c, a, b)]
            .into_iter()
            .max_by(|x, y| distance(x.0, x.1).total_cmp(&distance(y.0, y.1)))
            .expect("three");
        let mean = 1.0 + (self.excess[a] + self.excess[b] + self.excess[c]) / 3.0;
        if distance(far, near) < CLOSE * mean {
            second_of_close([a, b, c].map(|i| [self.excess[i]]))[0]
        } else {
            (self.first(far, middle) - self.first(middle, near)) / (self.excess[far] - self.excess[near])
        }
    }
}

#[cfg(test)]
mod tests;
