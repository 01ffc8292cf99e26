//! Exact solver for axisymmetric operators on the revolved mesh.
//!
//! A cosine transform in θ of even components and a sine transform of odd ones decouple the 3-D
//! problem into one sparse problem on the meridian per harmonic. All harmonics share one sparsity
//! pattern, so their Cholesky factors are stored as lanes and one sweep solves all.
//!
//! The unknowns of the contact nodes come last. Elimination of the rest leaves, exactly, their
//! Schur complement: the dense stiffness of the body at the contact. A solve is a forward sweep, the
//! solution of that dense system with the contact springs or the heat exchange, and a backward sweep.
//!
//! Depends on `crate::discretisation`. Chapter "Harmonic solver" of the book.

mod cholesky;
mod in_plane;
mod pattern;
mod single;
mod sweeps;

pub use pattern::HarmonicPattern;
pub use single::SingleFactors;
use sweeps::BlockTriangle;

use crate::discretisation::collocation::{Collocation, Parity, VECTOR_PARITY};
use crate::material::instruction_set::dispatch;
use crate::material::lanes::{dot, small_product};

/// Nodal values that an operator acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldKind {
    /// (u_r, u_θ, u_z): even, odd, even.
    Vector,
    /// Even.
    Scalar,
}

impl FieldKind {
    pub fn components(self) -> usize {
        match self {
            FieldKind::Vector => 3,
            FieldKind::Scalar => 1,
        }
    }

    pub fn parity(self, component: usize) -> Parity {
        match self {
            FieldKind::Vector => VECTOR_PARITY[component],
            FieldKind::Scalar => Parity::Even,
        }
    }
}

const ABSENT: u32 = u32::MAX;

#[derive(Debug, PartialEq, thiserror::Error)]
pub enum FactorError {
    #[error("harmonic {harmonic} of the stiffness is not positive definite")]
    NotPositiveDefinite { harmonic: usize },
    #[error("out of memory in the factorisation")]
    Memory,
    #[error("stopped on request")]
    Stopped,
}

/// Cosine and sine transforms in θ, orthonormal, so that energies are invariant.
#[derive(Clone, Debug)]
pub struct ThetaTransform {
    pub columns: usize,
    /// `[m*columns + j]`: weight of harmonic m at angle j; see [`Collocation::harmonics`].
    even: Vec<f64>,
    odd: Vec<f64>,
    /// Transposes of `even` and `odd`.
    even_transposed: Vec<f64>,
    odd_transposed: Vec<f64>,
}

impl ThetaTransform {
    fn new(sectors: &Collocation) -> Self {
        let columns = sectors.columns();
        let swap =
            |t: &[f64]| (0..columns * columns).map(|i| t[(i % columns) * columns + i / columns]).collect();
        let (even, odd) = (sectors.harmonics(Parity::Even), sectors.harmonics(Parity::Odd));
        Self { columns, even_transposed: swap(&even), odd_transposed: swap(&odd), even, odd }
    }

    /// `[m*columns + j]`: weight of harmonic m at angle j.
    pub fn of(&self, parity: Parity) -> &[f64] {
        match parity {
            Parity::Even => &self.even,
            Parity::Odd => &self.odd,
        }
    }

    fn transposed(&self, parity: Parity) -> &[f64] {
        match parity {
            Parity::Even => &self.even_transposed,
            Parity::Odd => &self.odd_transposed,
        }
    }
}

/// Factors of an axisymmetric operator, all harmonics together.
#[derive(Debug)]
pub struct HarmonicFactors {
    pub kind: FieldKind,
    pub transform: ThetaTransform,
    /// Unknowns on the meridian; those of the contact nodes, ring by ring, are last.
    unknowns: usize,
    interior: usize,
    /// Position of each node and component in the elimination order.
    position: Vec<u32>,
    on_axis: Vec<bool>,
    /// Columns of the interior unknowns.
    triangle: BlockTriangle<f64>,
    /// Cholesky factor of the Schur complement of the contact unknowns per harmonic, dense
    /// lower triangle, row by row.
    schur_factor: Vec<f64>,
}

impl HarmonicFactors {
    pub fn harmonics(&self) -> usize {
        self.transform.columns
    }

    /// Length of the vector of all harmonics of all unknowns.
    pub fn modal_length(&self) -> usize {
        self.unknowns * self.harmonics()
    }

    /// Contact unknowns per harmonic: rings times components.
    pub fn contact_unknowns(&self) -> usize {
        self.unknowns - self.interior
    }

    /// Offset of the contact unknowns in the modal vector: index (ring, component, harmonic).
    pub fn contact_offset(&self) -> usize {
        self.interior * self.harmonics()
    }

    /// Schur complement S_m of the contact unknowns for harmonic m, row-major.
    pub fn schur_complement(&self, m: usize) -> Vec<f64> {
        let n = self.contact_unknowns();
        let lower = &self.schur_factor[m * n * n..(m + 1) * n * n];
        let mut complement = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let sum: f64 = (0..=j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
                complement[i * n + j] = sum;
                complement[j * n + i] = sum;
            }
        }
        complement
    }

    /// Eliminates the interior: on return the contact part of `modal` is the reduced force.
    pub fn forward(&self, modal: &mut [f64]) {
        dispatch! { <E> fn(factors: &HarmonicFactors = self, modal: &mut [f64] = modal) {
            factors.triangle.forward::<1>(modal, 0..factors.interior);
        }}
    }

    /// Substitutes back, given the contact part of `modal` as displacement.
    pub fn backward(&self, modal: &mut [f64]) {
        dispatch! { <E> fn(factors: &HarmonicFactors = self, modal: &mut [f64] = modal) {
            factors.triangle.backward::<1, 4>(modal, (0..factors.interior).rev());
        }}
    }

    /// Harmonics of a nodal force.
    pub fn to_modal(&self, field: &[f64], modal: &mut [f64]) {
        let size = self.node_size();
        for (node, force) in field.chunks_exact(size).enumerate() {
            if let Some(first) = self.first_position(node) {
                self.node_to_modal(node, force, &mut modal[first * self.harmonics()..][..size]);
            }
        }
    }

    /// Nodal values of modal ones; fixed nodes get zero.
    pub fn to_nodal(&self, modal: &[f64], field: &mut [f64]) {
        let size = self.node_size();
        for (node, values) in field.chunks_exact_mut(size).enumerate() {
            match self.first_position(node) {
                Some(first) => self.node_to_nodal(node, &modal[first * self.harmonics()..][..size], values),
                None => values.fill(0.0),
            }
        }
    }

    /// Values of one node: components times angles or harmonics.
    pub fn node_size(&self) -> usize {
        self.kind.components() * self.harmonics()
    }

    /// Position of the first component of a node in the elimination order, unless it is fixed; those of the others follow.
    fn first_position(&self, node: usize) -> Option<usize> {
        let position = self.position[node * self.kind.components()];
        (position != ABSENT).then_some(position as usize)
    }

    /// Harmonics of the force on one node that is not fixed, both over components.
    #[inline(always)]
    pub fn node_to_modal(&self, node: usize, force: &[f64], modal: &mut [f64]) {
        let columns = self.harmonics();
        if self.on_axis[node] {
            return self.axis_to_modal(force, modal);
        }
        for (c, (source, target)) in
            force.chunks_exact(columns).zip(modal.chunks_exact_mut(columns)).enumerate()
        {
            small_product(1.0, self.transform.transposed(self.kind.parity(c)), source, target);
        }
    }

    /// Values of one node that is not fixed.
    #[inline(always)]
    pub fn node_to_nodal(&self, node: usize, modal: &[f64], values: &mut [f64]) {
        let columns = self.harmonics();
        if self.on_axis[node] {
            return self.axis_to_nodal(modal, values);
        }
        for (c, (source, target)) in
            modal.chunks_exact(columns).zip(values.chunks_exact_mut(columns)).enumerate()
        {
            small_product(1.0, self.transform.of(self.kind.parity(c)), source, target);
        }
    }

    /// Axis nodes have u_z of m = 0 and, in the place of u_r, the translation of m = 1, to which u_θ adds with −1.
    fn axis_to_modal(&self, force: &[f64], modal: &mut [f64]) {
        let columns = self.harmonics();
        let first = columns..2 * columns;
        modal.fill(0.0);
        let axial = match self.kind {
            FieldKind::Scalar => 0,
            FieldKind::Vector => 2 * columns,
        };
        modal[axial] = dot(&self.transform.even[..columns], &force[axial..][..columns]);
        if self.kind == FieldKind::Vector && columns > 1 {
            modal[1] = dot(&self.transform.even[first.clone()], &force[..columns])
                - dot(&self.transform.odd[first.clone()], &force[first]);
        }
    }

    fn axis_to_nodal(&self, modal: &[f64], values: &mut [f64]) {
        let columns = self.harmonics();
        for (c, target) in values.chunks_exact_mut(columns).enumerate() {
            let table = self.transform.of(self.kind.parity(c));
            let (value, harmonic) = match (self.kind, c) {
                (FieldKind::Vector, 0 | 1) if columns == 1 => (0.0, 0),
                (FieldKind::Vector, 0) => (modal[1], 1),
                (FieldKind::Vector, 1) => (-modal[1], 1),
                _ => (modal[c * columns], 0),
            };
            for (t, w) in target.iter_mut().zip(&table[harmonic * columns..]) {
                *t = value * w;
            }
        }
    }
}

#[cfg(test)]
mod tests;
