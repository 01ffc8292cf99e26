//! Logarithmic strain and its conjugate stress by the power series of the logarithm, for points that
//! hardly deform: the matrices are multiplied, not decomposed.
//!
//! With X = C − 1, E = ½ ln(1 + X) = Σ_k c_k X^k, c_k = ½(−1)^(k+1)/k. Horner's scheme
//! H_k = c_k + X H_(k+1) gives E = X H_1 and, transposed, S = 2 Σ_k sym(H_k T X^(k−1)).

use super::gradient::TwoPoint;
use super::spectral::{PAIR, PLACE};
use crate::lanes::{Lanes, fma};

/// Largest component of the displacement gradient up to which the series is used: |X| is at most six
/// times as large and a little more.
pub const SMALL: f64 = 1e-2;
/// Terms at [`SMALL`].
const MOST_TERMS: usize = 11;
/// Share of the strain in what is left out, |X|^N/(N + 1).
const LEFT_OUT: f64 = 3e-14;

/// The series at one point. H_k are made anew for strain and stress: kept, they would take more time to
/// clear, write and read than they take to compute.
pub struct LogSeries<const W: usize> {
    /// X by pairs.
    excess: [Lanes<W>; 6],
    /// N.
    terms: usize,
}

impl<const W: usize> LogSeries<W> {
    /// Of X, by pairs.
    #[inline(always)]
    pub fn new(excess: &[Lanes<W>; 6]) -> Self {
        Self { excess: *excess, terms: terms(excess) }
    }

    /// H_k from H_(k+1), of which H_(N+1) is zero.
    #[inline(always)]
    fn partial(&self, k: usize, after: &[Lanes<W>; 6]) -> [Lanes<W>; 6] {
        let coefficient = if k % 2 == 1 { 0.5 } else { -0.5 } / k as f64;
        let mut partial = commuting_product(&self.excess, after);
        for component in &mut partial[..3] {
            component.iter_mut().for_each(|x| *x += coefficient);
        }
        partial
    }

    /// E by pairs.
    #[inline(always)]
    pub fn log_strain(&self) -> [Lanes<W>; 6] {
        let mut partial = [[0.0; W]; 6];
        for k in (1..=self.terms).rev() {
            partial = self.partial(k, &partial);
        }
        commuting_product(&self.excess, &partial)
    }

    /// P = FS of the stress T that works on E.
    #[inline(always)]
    pub fn first_piola(&self, f: &TwoPoint<W>, log_stress: &[Lanes<W>; 6]) -> TwoPoint<W> {
        let mut partial = [[0.0; W]; 6];
        let mut sum = [[[0.0; W]; 3]; 3];
        for k in (1..=self.terms).rev() {
            partial = self.partial(k, &partial);
            if k < self.terms {
                sum = after_symmetric(&sum, &self.excess);
            }
            add_product(&partial, log_stress, &mut sum);
        }
        let mut piola = [[[0.0; W]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                let mut value = [0.0; W];
                for m in 0..3 {
                    for l in 0..W {
                        value[l] = fma(f[i][m][l], sum[m][j][l] + sum[j][m][l], value[l]);
                    }
                }
                piola[i][j] = value;
            }
        }
        piola
    }
}

/// Number of terms that leave out next to nothing in any lane.
#[inline(always)]
fn terms<const W: usize>(excess: &[Lanes<W>; 6]) -> usize {
    let mut squared = [0.0; W];
    for (v, component) in excess.iter().enumerate() {
        let factor = if v < 3 { 1.0 } else { 2.0 };
        for l in 0..W {
            squared[l] = fma(factor * component[l], component[l], squared[l]);
        }
    }
    let norm = squared.into_iter().fold(0.0, f64::max).sqrt();
    let mut power = norm * norm;
    let mut terms = 2;
    while power > LEFT_OUT * (terms + 1) as f64 && terms < MOST_TERMS {
        power *= norm;
        terms += 1;
    }
    terms
}

/// C += AB of symmetric A and B.
#[inline(always)]
fn add_product<const W: usize>(a: &[Lanes<W>; 6], b: &[Lanes<W>; 6], c: &mut TwoPoint<W>) {
    for i in 0..3 {
        for j in 0..3 {
            let mut value = c[i][j];
            for m in 0..3 {
                let (x, y) = (&a[PLACE[i][m]], &b[PLACE[m][j]]);
                for l in 0..W {
                    value[l] = fma(x[l], y[l], value[l]);
                }
            }
            c[i][j] = value;
        }
    }
}

/// AB of symmetric B.
#[inline(always)]
fn after_symmetric<const W: usize>(a: &TwoPoint<W>, b: &[Lanes<W>; 6]) -> TwoPoint<W> {
    let mut product = [[[0.0; W]; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let mut value = [0.0; W];
            for m in 0..3 {
                for l in 0..W {
                    value[l] = fma(a[i][m][l], b[PLACE[m][j]][l], value[l]);
                }
            }
            product[i][j] = value;
        }
    }
    product
}

/// AB of symmetric matrices that commute, which is symmetric, too.
#[inline(always)]
fn commuting_product<const W: usize>(a: &[Lanes<W>; 6], b: &[Lanes<W>; 6]) -> [Lanes<W>; 6] {
    let mut product = [[0.0; W]; 6];
    for (v, &(i, j)) in PAIR.iter().enumerate() {
        let mut value = [0.0; W];
        for k in 0..3 {
            let (x, y) = (&a[PLACE[i][k]], &b[PLACE[k][j]]);
            for l in 0..W {
                value[l] = fma(x[l], y[l], value[l]);
            }
        }
        product[v] = value;
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
        for size in [SMALL, 0.2 * SMALL, 0.01 * SMALL] {
            let alike: TwoPoint<1> = [[[size]; 3]; 3];
            let against: TwoPoint<1> = [[[-size]; 3]; 3];
            let odd =
                std::array::from_fn(|i| std::array::from_fn(|j| [size * (1.0 - 0.25 * (i * 2 + j) as f64)]));
            for h in [alike, against, odd] {
                let excess = cauchy_green_excess(&h);
                let f = deformation_gradient(&h);
                let stress = [[0.7], [-0.4], [0.1], [0.9], [-0.3], [0.5]];
                let series = LogSeries::new(&excess);
                let spectral = Spectral::new(&excess);
                let (apart, of) = difference(&spectral.log_strain(), &series.log_strain());
                assert!(apart < 2e-13 * of, "strain: {apart:e} of {of:e} in {} terms", series.terms);
                let exact = PointFrame::new(spectral, &f, &stress).first_piola();
                let found = series.first_piola(&f, &stress);
                let (apart, of) = difference(exact.as_flattened(), found.as_flattened());
                assert!(apart < 2e-13 * of, "stress: {apart:e} of {of:e} in {} terms", series.terms);
            }
        }
    }
}
