//! The elastic body with the contact stiffness inside, inverted: preconditioner of Newton's
//! method and of conjugate gradients.
//!
//! Only rings in contact enter the dense system over harmonics; the free ones further out are
//! eliminated with the body, harmonic by harmonic.

use std::sync::Arc;
use std::time::Instant;

use faer::linalg::solvers::{Llt, SolveCore};
use faer::{Mat, MatMut, Side};

use crate::contact::{Contact, NodeStiffness};
use crate::harmonic::{FieldKind, HarmonicFactors, SingleFactors};
use crate::timings::{Kernel, Timings};

/// The contact stiffness is not positive definite.
#[derive(Debug)]
pub struct Indefinite;

pub struct Preconditioner {
    factors: Arc<HarmonicFactors>,
    single: SingleFactors,
    modal: Vec<f64>,
    sweep: Vec<f32>,
    /// Number of rings in the dense system, its elastic part, index (ring, component, harmonic).
    rings: usize,
    elastic: Mat<f64>,
    factor: Option<Llt<f64>>,
    /// Contact stiffness that is in the factor.
    inside: Vec<NodeStiffness>,
}

impl Preconditioner {
    pub fn new(factors: Arc<HarmonicFactors>) -> Self {
        let single = SingleFactors::new(&factors);
        Self {
            modal: vec![0.0; factors.modal_length()],
            sweep: vec![0.0; single.len()],
            single,
            factors,
            rings: 0,
            elastic: Mat::new(),
            factor: None,
            inside: Vec::new(),
        }
    }

    /// Takes in the present contact stiffness.
    pub fn update(&mut self, contact: &Contact, timings: &mut Timings) -> Result<(), Indefinite> {
        if self.inside == contact.stiffness {
            return Ok(());
        }
        let clock = Instant::now();
        let touched = contact.stiffness.iter().rposition(|d| d[2][2] != 0.0);
        let rings = touched.map_or(0, |last| last / contact.columns + 1);
        if rings != self.rings {
            let harmonics = self.single.harmonics();
            let n = 3 * rings * harmonics;
            self.elastic = Mat::zeros(n, n);
            self.single.contact_stiffness(rings, |i, j, m, value| {
                self.elastic[(i * harmonics + m, j * harmonics + m)] = value;
            });
            self.rings = rings;
        }
        self.inside.clear();
        self.factor = None;
        if rings > 0 {
            let mut matrix = self.elastic.clone();
            add_contact_stiffness(&self.factors, contact, &mut matrix);
            self.factor = Some(matrix.llt(Side::Lower).map_err(|_| Indefinite)?);
        }
        self.inside.clone_from(&contact.stiffness);
        timings.since(Kernel::ContactFactorisation, clock);
        Ok(())
    }

    /// `solution` = M⁻¹ `residual`.
    pub fn apply(&mut self, residual: &[f64], solution: &mut [f64], timings: &mut Timings) {
        let clock = Instant::now();
        self.factors.to_modal(residual, &mut self.modal);
        self.single.load(&self.modal, &mut self.sweep);
        self.single.forward(&mut self.sweep, self.rings);
        if let Some(factor) = &self.factor {
            let node = 3 * self.single.harmonics();
            // Rings from the inside out, where the sweep has them from the outside in.
            let n = self.rings * node;
            let active = &mut self.modal[..n];
            let places = self.sweep.len() - n;
            for (values, slot) in
                active.chunks_exact_mut(node).rev().zip(self.sweep[places..].chunks_exact(node))
            {
                values.iter_mut().zip(slot).for_each(|(value, &x)| *value = f64::from(x));
            }
            factor
                .solve_in_place_with_conj(faer::Conj::No, MatMut::from_column_major_slice_mut(active, n, 1));
            for (values, slot) in
                active.chunks_exact(node).rev().zip(self.sweep[places..].chunks_exact_mut(node))
            {
                slot.iter_mut().zip(values).for_each(|(x, &value)| *x = value as f32);
            }
        }
        self.single.backward(&mut self.sweep, self.rings);
        self.single.store(&self.sweep, &mut self.modal);
        self.factors.to_nodal(&self.modal, solution);
        timings.since(Kernel::Preconditioner, clock);
    }
}

/// Adds the contact stiffness, transformed to harmonics ring by ring.
fn add_contact_stiffness(factors: &HarmonicFactors, contact: &Contact, matrix: &mut Mat<f64>) {
    assert_eq!(factors.kind, FieldKind::Vector);
    let columns = contact.columns;
    let transform = &factors.transform;
    let table = |c: usize| transform.of(factors.kind.parity(c));
    let size = 3 * columns;
    for ring in 0..matrix.nrows() / size {
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
        for i in 0..size {
            for j in 0..size {
                matrix[(ring * size + i, ring * size + j)] += local[i * size + j];
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
