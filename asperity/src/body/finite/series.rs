//! Logarithmic strain and its conjugate stress by the power series of the logarithm, for points that
//! hardly deform: the matrices are multiplied, not decomposed.
//!
//! With X = C − 1, E = ½ ln(1 + X) = Σ_k c_k X^k, c_k = ½(−1)^(k+1)/k. Horner's scheme
//! H_k = c_k + X H_(k+1) gives E = X H_1 and, transposed, S = 2 Σ_k sym(H_k T X^(k−1)).

use super::gradient::TwoPoint;
use super::spectral::{PAIR, PLACE};
use crate::lanes::{Lanes, fma};

/// Largest component of the displacement gradient up to which [`LogSeries`] of [`TERMS`] is as exact as
/// rounding allows, and up to which [`FEW_TERMS`] are: |X| is at most six times as large and a little
/// more, and the first term left out |X|^N/(N + 1) of the strain.
pub const SMALL: f64 = 1e-2;
pub const TERMS: usize = 11;
pub const SMALLER: f64 = 2e-3;
pub const FEW_TERMS: usize = 7;

/// The series of N terms at one point.
pub struct LogSeries<const W: usize, const N: usize> {
    excess: [Lanes<W>; 6],
    /// H_1 to H_N.
    partial: [[Lanes<W>; 6]; N],
}

impl<const W: usize, const N: usize> LogSeries<W, N> {
    /// Of X, by pairs.
    #[inline(always)]
    pub fn new(excess: &[Lanes<W>; 6]) -> Self {
        let mut partial = [[[0.0; W]; 6]; N];
        for k in (0..N).rev() {
            let coefficient = if k % 2 == 0 { 0.5 } else { -0.5 } / (k + 1) as f64;
            if k + 1 < N {
                partial[k] = commuting_product(excess, &partial[k + 1]);
            }
            for component in &mut partial[k][..3] {
                component.iter_mut().for_each(|x| *x += coefficient);
            }
        }
        Self { excess: *excess, partial }
    }

    /// E by pairs.
    #[inline(always)]
    pub fn log_strain(&self) -> [Lanes<W>; 6] {
        commuting_product(&self.excess, &self.partial[0])
    }

    /// P = FS of the stress T that works on E.
    #[inline(always)]
    pub fn first_piola(&self, f: &TwoPoint<W>, log_stress: &[Lanes<W>; 6]) -> TwoPoint<W> {
        let mut sum = [[[0.0; W]; 3]; 3];
        for k in (0..N).rev() {
            let mut next = [[[0.0; W]; 3]; 3];
            for i in 0..3 {
                for j in 0..3 {
                    for m in 0..3 {
                        let (left, stress) = (&self.partial[k][PLACE[i][m]], &log_stress[PLACE[m][j]]);
                        let (before, right) = (&sum[i][m], &self.excess[PLACE[m][j]]);
                        for l in 0..W {
                            next[i][j][l] = fma(left[l], stress[l], next[i][j][l]);
                            if k + 1 < N {
                                next[i][j][l] = fma(before[l], right[l], next[i][j][l]);
                            }
                        }
                    }
                }
            }
            sum = next;
        }
        let mut piola = [[[0.0; W]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                for m in 0..3 {
                    for l in 0..W {
                        piola[i][j][l] = fma(f[i][m][l], sum[m][j][l] + sum[j][m][l], piola[i][j][l]);
                    }
                }
            }
        }
        piola
    }
}

/// AB of symmetric matrices that commute, which is symmetric, too.
#[inline(always)]
fn commuting_product<const W: usize>(a: &[Lanes<W>; 6], b: &[Lanes<W>; 6]) -> [Lanes<W>; 6] {
    let mut product = [[0.0; W]; 6];
    for (v, &(i, j)) in PAIR.iter().enumerate() {
        for k in 0..3 {
            let (x, y) = (&a[PLACE[i][k]], &b[PLACE[k][j]]);
            for l in 0..W {
                product[v][l] = fma(x[l], y[l], product[v][l]);
            }
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::super::gradient::{cauchy_green_excess, deformation_gradient};
    use super::super::moduli::PointFrame;
    use super::super::spectral::Spectral;
    use super::*;

    fn difference(a: &[Lanes<1>], b: &[Lanes<1>]) -> (f64, f64) {
        let size = |x: &[Lanes<1>]| x.iter().fold(0.0f64, |m, x| m.max(x[0].abs()));
        let apart: Vec<Lanes<1>> = a.iter().zip(b).map(|(a, b)| [a[0] - b[0]]).collect();
        (size(&apart), size(a))
    }

    /// At the largest gradients, the worst of them with all components alike.
    #[test]
    fn series_and_spectrum_agree_where_the_series_is_used() {
        fn check<const N: usize>(h: TwoPoint<1>) {
            let excess = cauchy_green_excess(&h);
            let f = deformation_gradient(&h);
            let stress = [[0.7], [-0.4], [0.1], [0.9], [-0.3], [0.5]];
            let series = LogSeries::<1, N>::new(&excess);
            let spectral = Spectral::new::<false>(&excess);
            let (apart, size) = difference(&spectral.log_strain(), &series.log_strain());
            assert!(apart < 2e-13 * size, "{N} terms, strain: {apart:e} of {size:e}");
            let exact = PointFrame::new(spectral, &f, &stress).first_piola();
            let (apart, size) =
                difference(exact.as_flattened(), series.first_piola(&f, &stress).as_flattened());
            assert!(apart < 2e-13 * size, "{N} terms, stress: {apart:e} of {size:e}");
        }
        for sign in [1.0, -1.0] {
            check::<TERMS>([[[sign * SMALL]; 3]; 3]);
            check::<FEW_TERMS>([[[sign * SMALLER]; 3]; 3]);
            let odd = |size: f64| {
                std::array::from_fn(|i| {
                    std::array::from_fn(|j| [sign * size * (1.0 - 0.4 * (i * 2 + j) as f64)])
                })
            };
            check::<TERMS>(odd(SMALL));
            check::<FEW_TERMS>(odd(SMALLER));
        }
    }
}
