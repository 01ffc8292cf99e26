//! The revolution of the meridian: N_θ equal sectors over θ ∈ [0, π], with values at their
//! mid-planes θ_j = (j + ½)π/N_θ.
//!
//! In θ fields are trigonometric polynomials through these values: even ones (u_r, u_z, T) of
//! cos mθ, m < N_θ, odd ones (u_θ) of sin mθ, 1 ≤ m ≤ N_θ; the half θ < 0 mirrors this one. Their
//! derivatives in θ at the angles are exact, and integrals in θ are means over the angles, exact up
//! to harmonic 2N_θ (Canuto, Hussaini, Quarteroni & Zang, Spectral Methods, 2006, §2.1). A field that
//! does not depend on θ has no error from N_θ and is computed at one angle.
//!
//! Fields are stored node by node, component by component, one column for each angle:
//! `field[(node*components + component)*columns + j]`; vectors have components (u_r, u_θ, u_z).
//! Forces, areas, volumes and energies are those of the half body.

use std::f64::consts::PI;

use crate::material::lanes::{add_small_product, small_product};

#[derive(Clone, Debug, PartialEq)]
pub struct Collocation {
    /// N_θ over the half circle.
    count: usize,
    /// ∂/∂θ of even fields, as columns: `derivative[k*count + j]` is the weight of value k in the
    /// derivative at angle j.
    derivative: Vec<f64>,
    /// Transpose of `derivative`, which is minus ∂/∂θ of odd fields.
    transpose: Vec<f64>,
}

/// How a field changes sign from θ to −θ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    Even,
    Odd,
}

/// Parities of (u_r, u_θ, u_z) in θ.
pub const VECTOR_PARITY: [Parity; 3] = [Parity::Even, Parity::Odd, Parity::Even];

impl Collocation {
    pub fn full(count: usize) -> Self {
        let even = harmonics(count, Parity::Even);
        let mut derivative = vec![0.0; count * count];
        for m in 1..count {
            for k in 0..count {
                for j in 0..count {
                    let slope = -(m as f64) * angle_of(m, j, count).sin() * (2.0 / count as f64).sqrt();
                    derivative[k * count + j] += slope * even[m * count + k];
                }
            }
        }
        let transpose = (0..count * count).map(|i| derivative[(i % count) * count + i / count]).collect();
        Self { count, derivative, transpose }
    }

    /// One angle, for fields that do not depend on θ.
    pub fn axisymmetric() -> Self {
        Self::full(1)
    }

    /// Values stored per node and component, which is also the number of harmonics.
    pub fn columns(&self) -> usize {
        self.count
    }

    /// ∫dθ that belongs to each angle.
    pub fn weight(&self) -> f64 {
        PI / self.count as f64
    }

    /// θ_j of each column.
    pub fn angles(&self) -> Vec<f64> {
        (0..self.count).map(|j| (j as f64 + 0.5) * self.weight()).collect()
    }

    /// Harmonics of a field's values at the angles: `table[slot*count + j]`, orthonormal. Slot m
    /// holds cos mθ or sin mθ; slot 0 of odd fields holds sin N_θθ, which no other couples to.
    pub fn harmonics(&self, parity: Parity) -> Vec<f64> {
        harmonics(self.count, parity)
    }

    /// Weights of the values at the angles in an even field at `angle`: Σ_m φ_m(θ) φ_m(θ_j) of the orthonormal
    /// harmonics φ_m.
    pub fn interpolation(&self, angle: f64) -> Vec<f64> {
        let (n, even) = (self.count, self.harmonics(Parity::Even));
        let here = |m: usize| match m {
            0 => 1.0 / (n as f64).sqrt(),
            m => (m as f64 * angle).cos() * (2.0 / n as f64).sqrt(),
        };
        (0..n).map(|j| (0..n).map(|m| here(m) * even[m * n + j]).sum()).collect()
    }

    /// ∂/∂θ of a field whose components have the given parities.
    #[inline(always)]
    pub fn differentiate(&self, parities: &[Parity], field: &[f64], derivative: &mut [f64]) {
        let n = self.count;
        if n == 1 {
            return derivative.fill(0.0);
        }
        for (i, (value, slope)) in field.chunks_exact(n).zip(derivative.chunks_exact_mut(n)).enumerate() {
            match parities[i % parities.len()] {
                Parity::Even => small_product(1.0, &self.derivative, value, slope),
                Parity::Odd => small_product(-1.0, &self.transpose, value, slope),
            }
        }
    }

    /// Adds to `force` the transpose of [`Self::differentiate`] applied to the force `on_derivative` conjugate to
    /// ∂u/∂θ.
    #[inline(always)]
    pub fn add_transposed(&self, parities: &[Parity], on_derivative: &[f64], force: &mut [f64]) {
        let n = self.count;
        if n == 1 {
            return;
        }
        for (i, (source, target)) in on_derivative.chunks_exact(n).zip(force.chunks_exact_mut(n)).enumerate()
        {
            match parities[i % parities.len()] {
                Parity::Even => add_small_product(1.0, &self.transpose, source, target),
                Parity::Odd => add_small_product(-1.0, &self.derivative, source, target),
            }
        }
    }

    /// A θ-independent field at all angles.
    pub fn spread<T: Copy>(&self, axisymmetric: &[T]) -> Vec<T> {
        axisymmetric.iter().flat_map(|&value| std::iter::repeat_n(value, self.count)).collect()
    }
}

/// mθ_j, reduced so that zeros of its sine and cosine come out as zeros.
fn angle_of(m: usize, j: usize, count: usize) -> f64 {
    let halves = (m * (2 * j + 1)) % (4 * count);
    halves as f64 * PI / (2 * count) as f64
}

fn harmonics(count: usize, parity: Parity) -> Vec<f64> {
    let n = count as f64;
    (0..count * count)
        .map(|i| {
            let (slot, j) = (i / count, i % count);
            match (parity, slot) {
                (Parity::Even, 0) => 1.0 / n.sqrt(),
                (Parity::Even, m) => angle_of(m, j, count).cos() * (2.0 / n).sqrt(),
                (Parity::Odd, 0) => angle_of(count, j, count).sin() / n.sqrt(),
                (Parity::Odd, m) => angle_of(m, j, count).sin() * (2.0 / n).sqrt(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::lanes::dot;

    #[test]
    fn even_fields_are_interpolated_by_their_cosine_series() {
        let field = |t: f64| 0.3 + t.cos() - 2.0 * (5.0 * t).cos();
        let collocation = Collocation::full(8);
        let values: Vec<f64> = collocation.angles().into_iter().map(field).collect();
        for angle in [0.0, 0.1, 1.7, 3.0, -0.4, 5.0] {
            let value = dot(&collocation.interpolation(angle), &values);
            assert!((value - field(angle)).abs() < 1e-12, "{angle}");
        }
        assert_eq!(Collocation::axisymmetric().interpolation(2.0), [1.0]);
    }

    #[test]
    fn harmonics_are_orthonormal() {
        for count in [1, 4, 8, 12] {
            let sectors = Collocation::full(count);
            for parity in [Parity::Even, Parity::Odd] {
                let table = sectors.harmonics(parity);
                for m in 0..count {
                    for k in 0..count {
                        let sum: f64 = (0..count).map(|j| table[m * count + j] * table[k * count + j]).sum();
                        let expected = if m == k { 1.0 } else { 0.0 };
                        assert!((sum - expected).abs() < 1e-14, "{count} {parity:?} {m} {k}: {sum}");
                    }
                }
            }
        }
    }

    #[test]
    fn derivatives_of_trigonometric_polynomials_are_exact() {
        let sectors = Collocation::full(8);
        let at = |f: &dyn Fn(f64) -> f64| sectors.angles().iter().map(|&t| f(t)).collect::<Vec<f64>>();
        let field = [
            at(&|t| 0.3 + t.cos() - 2.0 * (5.0 * t).cos()),
            at(&|t| t.sin() + 0.5 * (7.0 * t).sin()),
            at(&|t| (3.0 * t).cos()),
        ]
        .concat();
        let exact = [
            at(&|t| -t.sin() + 10.0 * (5.0 * t).sin()),
            at(&|t| t.cos() + 3.5 * (7.0 * t).cos()),
            at(&|t| -3.0 * (3.0 * t).sin()),
        ]
        .concat();
        let mut derivative = vec![0.0; 24];
        sectors.differentiate(&VECTOR_PARITY, &field, &mut derivative);
        for (d, e) in derivative.iter().zip(&exact) {
            assert!((d - e).abs() < 1e-12);
        }
        // The transpose: f·(Du) = (Dᵀf)·u.
        let force: Vec<f64> = (0..24).map(|i| (1.7 * i as f64).sin()).collect();
        let mut turned = vec![0.0; 24];
        sectors.add_transposed(&VECTOR_PARITY, &force, &mut turned);
        assert!((dot(&force, &derivative) - dot(&turned, &field)).abs() < 1e-12);
    }
}
