//! Inverse of the elastic stiffness of the body with the contact stiffness: preconditioner of Newton's method and of
//! conjugate gradients.
//!
//! Only the contact rings that touch enter the dense system, which couples the harmonics. Rings outside of the contact
//! are eliminated with the body, harmonic by harmonic. Depends on `crate::solver::harmonic` and `crate::interface`.
//! Chapter "Harmonic solver" of the book.

use std::sync::Arc;
use std::time::Instant;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::{self, factor::LltError};
use faer::{Mat, MatMut, Par, Spec};

use crate::interface::contact::{Contact, NodeStiffness};
use crate::solver::harmonic::{FieldKind, HarmonicFactors, SingleFactors};
use crate::solver::timings::{Kernel, Timings};
pub use search::Search;

mod search;

pub struct Preconditioner {
    factors: Arc<HarmonicFactors>,
    single: SingleFactors,
    /// Positions in the sweeps outside of the dense system.
    positions: Vec<u32>,
    /// Number of rings in the dense system, its elastic part, and the Cholesky factor of the whole; index (ring,
    /// component, harmonic), rings from the outside in, as the sweeps have them.
    rings: usize,
    elastic: Mat<f32>,
    factor: Mat<f32>,
    /// Contact stiffness contained in the factor.
    inside: Vec<NodeStiffness>,
}

impl Preconditioner {
    pub fn new(factors: Arc<HarmonicFactors>) -> Self {
        let single = SingleFactors::new(&factors);
        Self {
            positions: single.positions_before(0).collect(),
            single,
            factors,
            rings: 0,
            elastic: Mat::new(),
            factor: Mat::new(),
            inside: Vec::new(),
        }
    }

    /// Factorises the present contact stiffness, if it has changed; the error is that it is not positive definite.
    pub fn update(&mut self, contact: &Contact, timings: &mut Timings) -> Result<(), LltError> {
        if self.inside == contact.stiffness {
            return Ok(());
        }
        let start = Instant::now();
        let touched = contact.stiffness.iter().rposition(|d| d[2][2] != 0.0);
        let rings = touched.map_or(0, |last| last / contact.columns + 1);
        if rings != self.rings {
            let harmonics = self.single.harmonics();
            let n = 3 * rings * harmonics;
            self.elastic = Mat::zeros(n, n);
            self.single.schur_complement(rings, |i, j, m, value| {
                let index = |i: usize| (3 * (rings - 1 - i / 3) + i % 3) * harmonics + m;
                self.elastic[(index(i), index(j))] = value as f32;
            });
            self.factor = self.elastic.clone();
            self.rings = rings;
            self.positions = self.single.positions_before(rings).collect();
        }
        self.inside.clear();
        if rings > 0 {
            self.factor.copy_from(&self.elastic);
            add_contact_stiffness(&self.factors, contact, &mut self.factor);
            let n = self.factor.nrows();
            let work = llt::factor::cholesky_in_place_scratch::<f32>(n, Par::Seq, Spec::default());
            llt::factor::cholesky_in_place(
                self.factor.as_mut(),
                Default::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(work)),
                Spec::default(),
            )?;
        }
        self.inside.clone_from(&contact.stiffness);
        timings.since(Kernel::ContactFactorisation, start);
        Ok(())
    }

    /// `solution` = M⁻¹ `residual`.
    pub fn apply(&self, residual: &[f64], solution: &mut [f64], timings: &mut Timings) {
        let mut sweep = vec![0.0; self.single.len()];
        self.sweep(0..self.single.nodes(), &self.positions, residual, (&mut sweep, solution), timings);
    }

    /// `solution` = M⁻¹ `residual` on `nodes`, by sweeps over `positions`, and the same in harmonics, which are zero before where
    /// there is no residual.
    fn sweep(
        &self,
        nodes: impl Iterator<Item = usize> + Clone,
        positions: &[u32],
        residual: &[f64],
        (harmonics, solution): (&mut [f32], &mut [f64]),
        timings: &mut Timings,
    ) {
        let start = Instant::now();
        self.single.load(&self.factors, residual, nodes.clone(), harmonics);
        self.single.forward(harmonics, positions);
        self.solve_dense(harmonics);
        self.single.backward(harmonics, positions);
        self.single.store(&self.factors, harmonics, nodes, solution);
        timings.since(Kernel::Preconditioner, start);
    }

    /// Between the sweeps: the rings in contact, which come last.
    fn solve_dense(&self, sweep: &mut [f32]) {
        let n = self.factor.nrows();
        if n > 0 {
            let first = sweep.len() - n;
            llt::solve::solve_in_place(
                self.factor.as_ref(),
                MatMut::from_column_major_slice_mut(&mut sweep[first..], n, 1),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(llt::solve::solve_in_place_scratch::<f32>(n, 1, Par::Seq))),
            );
        }
    }
}

/// Adds the contact stiffness, transformed to harmonics ring by ring.
fn add_contact_stiffness(factors: &HarmonicFactors, contact: &Contact, matrix: &mut Mat<f32>) {
    assert_eq!(factors.kind, FieldKind::Vector);
    let columns = contact.columns;
    let transform = &factors.transform;
    let table = |c: usize| transform.of(factors.kind.parity(c));
    let size = 3 * columns;
    let rings = matrix.nrows() / size;
    for ring in 0..rings {
        let nodes = &contact.stiffness[ring * columns..(ring + 1) * columns];
        if nodes.iter().all(|d| d[2][2] == 0.0) {
            continue;
        }
        // Over (component, harmonic).
        let mut local = vec![0.0; size * size];
        for (c, d) in (0..9).map(|i| (i / 3, i % 3)) {
            if nodes.iter().all(|node| node[c][d] == 0.0) {
                continue;
            }
            for m in 0..columns {
                for k in 0..columns {
                    let sum: f64 = (0..columns)
                        .map(|j| table(c)[m * columns + j] * nodes[j][c][d] * table(d)[k * columns + j])
                        .sum();
                    local[(c * columns + m) * size + d * columns + k] += sum;
                }
            }
        }
        if contact.radii[ring] == 0.0 {
            local = axis_block(&local, columns);
        }
        let first = (rings - 1 - ring) * size;
        for i in 0..size {
            for j in 0..size {
                matrix[(first + i, first + j)] += local[i * size + j] as f32;
            }
        }
    }
}

/// The apex has u_z of m = 0 and the translation u_r = −u_θ of m = 1 only.
fn axis_block(local: &[f64], columns: usize) -> Vec<f64> {
    let size = 3 * columns;
    let mut block = vec![0.0; size * size];
    let axial = 2 * columns;
    block[axial * size + axial] = local[axial * size + axial];
    if columns > 1 {
        let (r, t) = (1, columns + 1);
        let at = |i: usize, j: usize| local[i * size + j];
        block[r * size + r] = at(r, r) - at(r, t) - at(t, r) + at(t, t);
        block[r * size + axial] = at(r, axial) - at(t, axial);
        block[axial * size + r] = block[r * size + axial];
    }
    block
}
