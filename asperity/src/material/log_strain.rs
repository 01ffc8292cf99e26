//! Logarithmic strain and its conjugate stress by resolvents, without an eigenvalue decomposition.
//!
//! With X = C − 1, E = ½ ln(1 + X) = ½ ∫₀¹ X(1 + tX)⁻¹ dt. Gauss quadrature with m points t_i makes of that a Padé
//! approximant of the logarithm (Dieci, Morini & Papini 1996, SIAM J. Matrix Anal. Appl. 17, 570), which for an
//! eigenvalue λ of C has a relative error of about ρ^2m, ρ = (√λ − 1)/(√λ + 1). With A_i = (1 + t_iX)⁻¹ the
//! derivative is ½ Σ w_i A_i dX A_i, so that a stress T on E is the second Piola-Kirchhoff stress S = Σ w_i A_i T A_i.
//! Force and tangent are the exact derivatives of the approximant: its truncation error does not enter any balance.

use gauss_quad::GaussLegendre;

use crate::material::lanes::Pack;
use crate::material::tensor::{PAIR, SYMMETRIC_INDEX, Symmetric, TwoPoint, contracted};

/// Largest truncation ρ^2m: far below the tolerance of Newton's method.
const TRUNCATION: f64 = 1e-12;
/// Points of the largest rule, which is used beyond its reach, a principal strain of 2.2, as well.
const MOST_POINTS: usize = 64;
/// Up to this |X| the smallest eigenvalue is bounded by 1 − |X|, beyond by the inverse of C.
const MODERATE: f64 = 0.5;

/// Gauss quadrature on [0, 1].
#[derive(Clone, Debug)]
struct Rule {
    /// (t, w).
    points: Vec<(f64, f64)>,
    /// Largest eigenvalue of C, and inverse of the smallest, within the truncation.
    reach: f64,
}

/// Rules of two points and more.
#[derive(Clone, Debug)]
pub struct Rules(Vec<Rule>);

impl Rules {
    pub fn new() -> Self {
        let rule = |count: usize| {
            let gauss = GaussLegendre::new(count).expect("there are rules of more than one point");
            let rho = TRUNCATION.powf(0.5 / count as f64);
            Rule {
                points: gauss.iter().map(|(t, w)| (0.5 + 0.5 * t, 0.5 * w)).collect(),
                reach: ((1.0 + rho) / (1.0 - rho)).powi(2),
            }
        };
        Self((2..=MOST_POINTS).map(rule).collect())
    }

    /// The logarithm of 1 + X.
    #[inline(always)]
    pub fn log<V: Pack>(&self, excess: &Symmetric<V>) -> LogStrain<'_, V> {
        let size = largest_norm(excess);
        let lowest = if size < MODERATE {
            1.0 - size
        } else {
            let inverse = resolvent(1.0, excess);
            let beyond: Symmetric<V> = std::array::from_fn(|v| inverse[v] - V::splat(f64::from(v < 3)));
            1.0 / (1.0 + largest_norm(&beyond))
        };
        let ratio = (1.0 + size).max(1.0 / lowest);
        let rule = self.0.iter().find(|rule| ratio <= rule.reach).unwrap_or(&self.0[self.0.len() - 1]);
        LogStrain { excess: *excess, points: &rule.points }
    }
}

/// The logarithm at one point. The resolvents are computed again for strain, stress and tangent: storing them takes as
/// long.
pub struct LogStrain<'a, V> {
    /// X.
    excess: Symmetric<V>,
    points: &'a [(f64, f64)],
}

impl<V: Pack> LogStrain<'_, V> {
    /// E.
    #[inline(always)]
    pub fn strain(&self) -> Symmetric<V> {
        let mut sum = [V::splat(0.0); 6];
        for &(t, weight) in self.points {
            let resolvent = resolvent(t, &self.excess);
            for v in 0..6 {
                sum[v] = V::splat(0.5 * weight).mul_add(resolvent[v], sum[v]);
            }
        }
        // Matrices that commute have a symmetric product.
        let mut strain = sum;
        for i in 0..3 {
            for j in i..3 {
                strain[SYMMETRIC_INDEX[i][j]] = row_times(&self.excess, i, &sum, j);
            }
        }
        strain
    }

    /// S of the stress T that works on E.
    #[inline(always)]
    pub fn second_piola(&self, log_stress: &Symmetric<V>) -> Symmetric<V> {
        let mut second = [V::splat(0.0); 6];
        for &(t, weight) in self.points {
            let congruent = congruence(&resolvent(t, &self.excess), log_stress);
            for v in 0..6 {
                second[v] = V::splat(weight).mul_add(congruent[v], second[v]);
            }
        }
        second
    }

    /// ∂E/∂(½C) = Σ w_i A_i⊗A_i, as products of components, and −4 Σ w_i t_i A_i⊗B_i with B_i = A_i T A_i, the second
    /// derivative of E along T.
    #[inline(always)]
    pub fn derivatives(&self, log_stress: &Symmetric<V>) -> ([Symmetric<V>; 6], [Symmetric<V>; 6]) {
        let mut first = [[V::splat(0.0); 6]; 6];
        let mut second = first;
        for &(t, weight) in self.points {
            let a = resolvent(t, &self.excess);
            add_square(V::splat(weight), &a, &a, &mut first);
            let b = congruence(&a, log_stress);
            add_square(V::splat(-4.0 * weight * t), &b, &a, &mut second);
        }
        (first, second)
    }
}

/// F·S.
#[inline(always)]
pub fn first_piola<V: Pack>(f: &TwoPoint<V>, second: &Symmetric<V>) -> TwoPoint<V> {
    let mut first = *f;
    for i in 0..3 {
        for j in 0..3 {
            first[i][j] = times(&f[i], second, j);
        }
    }
    first
}

/// |X| of the lane where it is largest.
#[inline(always)]
fn largest_norm<V: Pack>(x: &Symmetric<V>) -> f64 {
    contracted(x, x).largest().sqrt()
}

/// (1 + tX)⁻¹ by cofactors.
#[inline(always)]
fn resolvent<V: Pack>(t: f64, x: &Symmetric<V>) -> Symmetric<V> {
    let (t, one) = (V::splat(t), V::splat(1.0));
    let (a, b, c) = (t.mul_add(x[0], one), t.mul_add(x[1], one), t.mul_add(x[2], one));
    let (ab, bc, ca) = (t * x[3], t * x[4], t * x[5]);
    let (first, second, third) = (minor(b, c, bc, bc), minor(bc, ca, ab, c), minor(ab, bc, b, ca));
    let over = V::splat(1.0) / a.mul_add(first, ab.mul_add(second, ca * third));
    let mut inverse = [first, minor(a, c, ca, ca), minor(a, b, ab, ab), second, minor(ab, ca, a, bc), third];
    for m in &mut inverse {
        *m = over * *m;
    }
    inverse
}

/// ab − cd.
#[inline(always)]
fn minor<V: Pack>(a: V, b: V, c: V, d: V) -> V {
    a.mul_add(b, -(c * d))
}

/// Row i of the symmetric A times column j of the symmetric B.
#[inline(always)]
fn row_times<V: Pack>(a: &Symmetric<V>, i: usize, b: &Symmetric<V>, j: usize) -> V {
    let [first, middle, last] = SYMMETRIC_INDEX[i];
    times(&[a[first], a[middle], a[last]], b, j)
}

/// A row times column j of the symmetric B.
#[inline(always)]
fn times<V: Pack>(row: &[V; 3], b: &Symmetric<V>, j: usize) -> V {
    let [first, middle, last] = SYMMETRIC_INDEX[j];
    row[0].mul_add(b[first], row[1].mul_add(b[middle], row[2] * b[last]))
}

/// ABA of symmetric A and B.
#[inline(always)]
fn congruence<V: Pack>(a: &Symmetric<V>, b: &Symmetric<V>) -> Symmetric<V> {
    let zero = V::splat(0.0);
    let mut product = [zero; 6];
    for i in 0..3 {
        let mut row = [zero; 3];
        for j in 0..3 {
            row[j] = row_times(a, i, b, j);
        }
        for j in i..3 {
            product[SYMMETRIC_INDEX[i][j]] = times(&row, a, j);
        }
    }
    product
}

/// Adds factor·e_v:(A e_w B) over the symmetric units e_v of [`PAIR`], shears of two halves, made symmetric in A
/// and B. For A = B it is component v of A e_w A. Components below the diagonal stay as they are.
#[inline(always)]
fn add_square<V: Pack>(factor: V, a: &Symmetric<V>, b: &Symmetric<V>, sum: &mut [Symmetric<V>; 6]) {
    let half = V::splat(0.5) * factor;
    let mut scaled = *a;
    for x in &mut scaled {
        *x = half * *x;
    }
    for v in 0..6 {
        for w in v..6 {
            let ((p, q), (r, s)) = (PAIR[v], PAIR[w]);
            let straight = both(&scaled, b, SYMMETRIC_INDEX[p][r], SYMMETRIC_INDEX[q][s]);
            let component = &mut sum[v][w];
            *component = if v < 3 {
                *component + straight
            } else {
                V::splat(0.5).mul_add(
                    straight + both(&scaled, b, SYMMETRIC_INDEX[p][s], SYMMETRIC_INDEX[q][r]),
                    *component,
                )
            };
        }
    }
}

/// A_ac B_bd + A_bd B_ac.
#[inline(always)]
fn both<V: Pack>(a: &Symmetric<V>, b: &Symmetric<V>, a_c: usize, b_d: usize) -> V {
    a[a_c].mul_add(b[b_d], a[b_d] * b[a_c])
}

#[cfg(test)]
mod tests;
