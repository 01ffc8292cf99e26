//! Logarithmic strain and its conjugate stress by resolvents, for points that hardly deform: a few matrices are
//! inverted, none is decomposed.
//!
//! With X = C − 1, E = ½ ln(1 + X) = ½ ∫₀¹ X(1 + tX)⁻¹ dt. Gauss quadrature with m points t_i makes of that
//! the [m/m] Padé approximant of the logarithm, wrong by (m!)⁴/((2m)!(2m + 1)!) |X|^2m of it (Dieci, Morini & Papini
//! 1996, SIAM J. Matrix Anal. Appl. 17, 570). With A_i = (1 + t_iX)⁻¹ the derivative is ½ Σ w_i A_i dX A_i, so that a
//! stress T on E is the second Piola–Kirchhoff stress S = Σ w_i A_i T A_i.

use super::gradient::TwoPoint;
use super::spectral::{PAIR, PLACE};
use crate::lanes::{Lanes, fma};

/// Largest component of the displacement gradient up to which resolvents are used: |X| is at most six
/// times as large and a little more.
pub const SMALL: f64 = 1e-2;

/// (t, w) on [0, 1], and |X| up to which what they are wrong by is 10⁻¹⁴ of the strain.
struct Rule {
    points: &'static [(f64, f64)],
    reach: f64,
}

/// Of 2, 3 and 4 points.
const RULES: [Rule; 3] = [
    Rule { points: &[(0.211_324_865_405_187_1, 0.5), (0.788_675_134_594_812_9, 0.5)], reach: 1.15e-3 },
    Rule {
        points: &[
            (0.112_701_665_379_258_3, 5.0 / 18.0),
            (0.5, 8.0 / 18.0),
            (0.887_298_334_620_741_7, 5.0 / 18.0),
        ],
        reach: 1.74e-2,
    },
    Rule {
        points: &[
            (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
            (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
            (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
            (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
        ],
        reach: 6.7e-2,
    },
];

/// The logarithm at one point. The resolvents are made anew for strain and stress: to write and read them takes as
/// long.
pub struct SmallLog<const W: usize> {
    /// X by pairs.
    excess: [Lanes<W>; 6],
    points: &'static [(f64, f64)],
}

impl<const W: usize> SmallLog<W> {
    /// Of X, by pairs.
    #[inline(always)]
    pub fn new(excess: &[Lanes<W>; 6]) -> Self {
        let size = largest_norm(excess);
        let rule = RULES.iter().find(|rule| size <= rule.reach).unwrap_or(&RULES[RULES.len() - 1]);
        Self { excess: *excess, points: rule.points }
    }

    /// E by pairs.
    #[inline(always)]
    pub fn log_strain(&self) -> [Lanes<W>; 6] {
        let mut sum = [[0.0; W]; 6];
        for &(t, weight) in self.points {
            let resolvent = resolvent(t, &self.excess);
            for (sum, component) in sum.iter_mut().zip(&resolvent) {
                for l in 0..W {
                    sum[l] = fma(0.5 * weight, component[l], sum[l]);
                }
            }
        }
        commuting_product(&self.excess, &sum)
    }

    /// P = FS of the stress T that works on E.
    #[inline(always)]
    pub fn first_piola(&self, f: &TwoPoint<W>, log_stress: &[Lanes<W>; 6]) -> TwoPoint<W> {
        let mut second = [[0.0; W]; 6];
        for &(t, weight) in self.points {
            add_congruence(weight, &resolvent(t, &self.excess), log_stress, &mut second);
        }
        let mut piola = [[[0.0; W]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                let mut value = [0.0; W];
                for m in 0..3 {
                    let (x, y) = (&f[i][m], &second[PLACE[m][j]]);
                    for l in 0..W {
                        value[l] = fma(x[l], y[l], value[l]);
                    }
                }
                piola[i][j] = value;
            }
        }
        piola
    }
}

/// |X| of the lane where it is largest.
#[inline(always)]
fn largest_norm<const W: usize>(excess: &[Lanes<W>; 6]) -> f64 {
    let mut squared = [0.0; W];
    for (v, component) in excess.iter().enumerate() {
        let factor = if v < 3 { 1.0 } else { 2.0 };
        for l in 0..W {
            squared[l] = fma(factor * component[l], component[l], squared[l]);
        }
    }
    squared.into_iter().fold(0.0, f64::max).sqrt()
}

/// (1 + tX)⁻¹ by cofactors.
#[inline(always)]
fn resolvent<const W: usize>(t: f64, x: &[Lanes<W>; 6]) -> [Lanes<W>; 6] {
    let mut inverse = [[0.0; W]; 6];
    for l in 0..W {
        let diagonal = |v: usize| fma(t, x[v][l], 1.0);
        let beside = |i: usize, j: usize| t * x[PLACE[i][j]][l];
        let (a, b, c) = (diagonal(PLACE[0][0]), diagonal(PLACE[1][1]), diagonal(PLACE[2][2]));
        let (ab, bc, ca) = (beside(0, 1), beside(1, 2), beside(2, 0));
        let (first, second, third) = (fma(b, c, -bc * bc), fma(bc, ca, -ab * c), fma(ab, bc, -b * ca));
        let over = 1.0 / fma(a, first, fma(ab, second, ca * third));
        inverse[PLACE[0][0]][l] = over * first;
        inverse[PLACE[0][1]][l] = over * second;
        inverse[PLACE[0][2]][l] = over * third;
        inverse[PLACE[1][1]][l] = over * fma(a, c, -ca * ca);
        inverse[PLACE[1][2]][l] = over * fma(ab, ca, -a * bc);
        inverse[PLACE[2][2]][l] = over * fma(a, b, -ab * ab);
    }
    inverse
}

/// C += w·ABA of symmetric A and B.
#[inline(always)]
fn add_congruence<const W: usize>(w: f64, a: &[Lanes<W>; 6], b: &[Lanes<W>; 6], c: &mut [Lanes<W>; 6]) {
    for i in 0..3 {
        // A row of w·AB.
        let mut row = [[0.0; W]; 3];
        for (j, value) in row.iter_mut().enumerate() {
            for k in 0..3 {
                let (x, y) = (&a[PLACE[i][k]], &b[PLACE[k][j]]);
                for l in 0..W {
                    value[l] = fma(w * x[l], y[l], value[l]);
                }
            }
        }
        for j in i..3 {
            let value = &mut c[PLACE[i][j]];
            for k in 0..3 {
                let y = &a[PLACE[k][j]];
                for l in 0..W {
                    value[l] = fma(row[k][l], y[l], value[l]);
                }
            }
        }
    }
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
    fn resolvents_and_spectrum_agree_where_resolvents_are_used() {
        for size in [SMALL, 0.2 * SMALL, 0.1 * SMALL, 0.01 * SMALL] {
            let alike: TwoPoint<1> = [[[size]; 3]; 3];
            let against: TwoPoint<1> = [[[-size]; 3]; 3];
            let odd =
                std::array::from_fn(|i| std::array::from_fn(|j| [size * (1.0 - 0.25 * (i * 2 + j) as f64)]));
            for h in [alike, against, odd] {
                let excess = cauchy_green_excess(&h);
                let f = deformation_gradient(&h);
                let stress = [[0.7], [-0.4], [0.1], [0.9], [-0.3], [0.5]];
                let small = SmallLog::new(&excess);
                let spectral = Spectral::new(&excess);
                let (apart, of) = difference(&spectral.log_strain(), &small.log_strain());
                assert!(apart < 2e-13 * of, "strain: {apart:e} of {of:e} with {} points", small.points.len());
                let exact = PointFrame::new(spectral, &f, &stress).first_piola();
                let found = small.first_piola(&f, &stress);
                let (apart, of) = difference(exact.as_flattened(), found.as_flattened());
                assert!(apart < 2e-13 * of, "stress: {apart:e} of {of:e} with {} points", small.points.len());
            }
        }
    }
}
