//! The factors of a vector field in single precision and by blocks of a node: those of the preconditioner.
//!
//! Its sweeps are bound by memory, and few digits suffice: conjugate gradients take as many iterations as with factors
//! in double precision. The components of a node share one pattern, so the factor consists of 3 × 3 blocks.
//!
//! The rings of the contact come last, the outermost first: a sweep may stop before any of them, and leaves the
//! stiffness of the body at the rings within.

use std::ops::Range;

use super::sweeps::BlockTriangle;
use super::{FieldKind, HarmonicFactors, in_plane};
use crate::material::instruction_set::dispatch;

/// Components of a node.
const SIZE: usize = 3;
/// Row and column of the entries of a block.
const FULL: [(usize, usize); SIZE * SIZE] =
    [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];

/// Factor over nodes, harmonics as lanes.
#[derive(Debug)]
pub struct SingleFactors {
    rings: usize,
    /// Nodes that are not on the contact.
    interior: usize,
    /// Position of each node of the mesh in the elimination order, unless it is fixed.
    position: Vec<Option<u32>>,
    triangle: BlockTriangle<f32>,
    /// The contact's part of the factor in double precision, dense over (slot, component), where
    /// slot 0 is the outermost ring: `[(i*n + j)*harmonics + m]`.
    contact: Vec<f64>,
}

impl SingleFactors {
    /// Converts the factors of a vector field.
    pub fn new(factors: &HarmonicFactors) -> Self {
        assert_eq!(factors.kind, FieldKind::Vector);
        let lanes = factors.harmonics();
        let empty = BlockTriangle { lanes, start: vec![0], row: vec![], block: vec![], diagonal: vec![] };
        let mut single = Self {
            rings: factors.contact_unknowns() / SIZE,
            interior: factors.interior / SIZE,
            position: Vec::new(),
            triangle: empty,
            contact: contact_factor(factors),
        };
        (0..single.interior).for_each(|node| single.add_interior_column(factors, node));
        (0..single.rings).for_each(|slot| single.add_contact_column(slot));
        let position = |node| factors.first_position(node).map(|first| single.reversed(first / SIZE) as u32);
        single.position = (0..factors.on_axis.len()).map(position).collect();
        single
    }

    fn entries(&self) -> &'static [(usize, usize)] {
        if self.harmonics() == 1 { &in_plane::ENTRIES } else { &FULL }
    }

    /// Node of the factors as node of this one: contact rings in reverse.
    fn reversed(&self, node: usize) -> usize {
        match node.checked_sub(self.interior) {
            None => node,
            Some(ring) => self.interior + self.rings - 1 - ring,
        }
    }

    fn add_interior_column(&mut self, factors: &HarmonicFactors, node: usize) {
        let (lanes, scalar) = (self.harmonics(), &factors.triangle);
        let column = |c: usize| scalar.column(SIZE * node + c).start;
        let entry = |e: usize, m: usize| scalar.block[e * lanes + m];
        self.add_diagonal(
            |c, m| scalar.diagonal[(SIZE * node + c) * lanes + m],
            |r, c, m| entry(column(c) + r - c - 1, m),
        );
        // After those of the node itself come whole nodes, the same ones in all three columns.
        let first: [usize; SIZE] = std::array::from_fn(|c| column(c) + SIZE - 1 - c);
        let count = column(1) - first[0];
        assert_eq!(count, scalar.column(SIZE * node + SIZE - 1).end - first[2]);
        for k in (0..count).step_by(SIZE) {
            let unknown = scalar.row[first[0] + k] as usize;
            assert!(unknown.is_multiple_of(SIZE));
            self.add_block(self.reversed(unknown / SIZE), |r, c, m| entry(first[c] + k + r, m));
        }
        self.triangle.start.push(self.triangle.row.len() as u32);
    }

    fn add_contact_column(&mut self, slot: usize) {
        let (lanes, n) = (self.harmonics(), SIZE * self.rings);
        let contact = std::mem::take(&mut self.contact);
        let entry = |i: usize, j: usize, m: usize| contact[(i * n + j) * lanes + m];
        let own = SIZE * slot;
        self.add_diagonal(|c, m| 1.0 / entry(own + c, own + c, m), |r, c, m| entry(own + r, own + c, m));
        for below in slot + 1..self.rings {
            self.add_block(self.interior + below, |r, c, m| entry(SIZE * below + r, own + c, m));
        }
        self.triangle.start.push(self.triangle.row.len() as u32);
        self.contact = contact;
    }

    /// Appends a diagonal block from 1/L_cc and L_rc of each harmonic.
    fn add_diagonal(
        &mut self,
        inverse: impl Fn(usize, usize) -> f64,
        below: impl Fn(usize, usize, usize) -> f64,
    ) {
        let (lanes, target) = (self.harmonics(), &mut self.triangle.diagonal);
        for c in 0..SIZE {
            target.extend((0..lanes).map(|m| inverse(c, m) as f32));
        }
        for (r, c) in [(1, 0), (2, 0), (2, 1)] {
            target.extend((0..lanes).map(|m| below(r, c, m) as f32));
        }
    }

    /// Appends a block below the diagonal.
    fn add_block(&mut self, row: usize, entry: impl Fn(usize, usize, usize) -> f64) {
        let lanes = self.harmonics();
        self.triangle.row.push(row as u32);
        for &(r, c) in self.entries() {
            self.triangle.block.extend((0..lanes).map(|m| entry(r, c, m) as f32));
        }
    }

    pub fn harmonics(&self) -> usize {
        self.triangle.lanes
    }

    /// Length of the vector of all harmonics.
    pub fn len(&self) -> usize {
        (self.interior + self.rings) * SIZE * self.harmonics()
    }

    /// Bytes that one sweep reads of the factor.
    pub fn bytes(&self) -> usize {
        4 * (self.triangle.block.len() + self.triangle.diagonal.len() + self.triangle.row.len())
    }

    /// Multiplications with additions of one sweep.
    pub fn multiplications(&self) -> usize {
        self.triangle.block.len() + self.triangle.diagonal.len()
    }

    /// Schur complement of the innermost `rings`, the stiffness of the body at them while the others are free, for harmonic m
    /// between (ring, component) i and j, as `f(i, j, m, value)`.
    pub fn schur_complement(&self, rings: usize, mut f: impl FnMut(usize, usize, usize, f64)) {
        let (lanes, n) = (self.harmonics(), SIZE * self.rings);
        let slot = |i: usize| SIZE * (self.rings - 1 - i / SIZE) + i % SIZE;
        let first = n - SIZE * rings;
        for i in 0..SIZE * rings {
            for j in 0..SIZE * rings {
                let (a, b) = (slot(i), slot(j));
                for m in 0..lanes {
                    let at = |i: usize, k: usize| self.contact[(i * n + k) * lanes + m];
                    f(i, j, m, (first..=a.min(b)).map(|k| at(a, k) * at(b, k)).sum());
                }
            }
        }
    }

    /// Harmonics of the forces on some nodes of the mesh.
    pub fn load(
        &self,
        factors: &HarmonicFactors,
        force: &[f64],
        nodes: impl Iterator<Item = usize>,
        x: &mut [f32],
    ) {
        let size = SIZE * self.harmonics();
        let mut modal = vec![0.0; size];
        for node in nodes {
            let Some(position) = self.position(node) else { continue };
            factors.node_to_modal(node, &force[node * size..][..size], &mut modal);
            x[position * size..][..size].iter_mut().zip(&modal).for_each(|(x, &value)| *x = value as f32);
        }
    }

    /// Values at some nodes of the mesh, zero where these are fixed.
    pub fn store(
        &self,
        factors: &HarmonicFactors,
        x: &[f32],
        nodes: impl Iterator<Item = usize>,
        field: &mut [f64],
    ) {
        let size = SIZE * self.harmonics();
        let mut modal = vec![0.0; size];
        for node in nodes {
            let values = &mut field[node * size..][..size];
            let Some(position) = self.position(node) else {
                values.fill(0.0);
                continue;
            };
            modal.iter_mut().zip(&x[position * size..]).for_each(|(value, &x)| *value = f64::from(x));
            factors.node_to_nodal(node, &modal, values);
        }
    }

    /// Number of nodes of the mesh.
    pub fn nodes(&self) -> usize {
        self.position.len()
    }

    /// Position of a node of the mesh in the elimination order, unless it is fixed.
    pub fn position(&self, node: usize) -> Option<usize> {
        self.position[node].map(|position| position as usize)
    }

    /// Positions before those of the innermost `rings`, in the order of elimination.
    pub fn positions_before(&self, rings: usize) -> Range<u32> {
        0..(self.interior + self.rings - rings) as u32
    }

    /// Marks also what the marked positions are eliminated into: a force on these alone leaves the rest of a forward
    /// sweep at zero. The contact is always marked.
    pub fn close(&self, marked: &mut [bool]) {
        marked[self.interior..].fill(true);
        for j in 0..self.interior {
            // The first is the parent in the elimination tree, from which the others can be reached.
            if let (true, Some(&parent)) = (marked[j], self.triangle.row[self.triangle.column(j)].first()) {
                marked[parent as usize] = true;
            }
        }
    }

    /// Eliminates `positions`, which rise.
    pub fn forward(&self, x: &mut [f32], positions: &[u32]) {
        dispatch! { <E> fn(single: &SingleFactors = self, x: &mut [f32] = x, positions: &[u32] = positions) {
            let columns = positions.iter().map(|&j| j as usize);
            match single.harmonics() {
                1 => single.triangle.forward_in_plane(x, columns),
                _ => single.triangle.forward::<SIZE>(x, columns),
            }
        }}
    }

    /// Substitutes `positions` back, which rise, given the displacement of what they are eliminated into.
    pub fn backward(&self, x: &mut [f32], positions: &[u32]) {
        dispatch! { <E> fn(single: &SingleFactors = self, x: &mut [f32] = x, positions: &[u32] = positions) {
            let columns = positions.iter().rev().map(|&j| j as usize);
            match single.harmonics() {
                1 => single.triangle.backward_in_plane(x, columns),
                _ => single.triangle.backward::<SIZE, 1>(x, columns),
            }
        }}
    }
}

/// Cholesky factors of the contact's Schur complements with the rings in reverse.
fn contact_factor(factors: &HarmonicFactors) -> Vec<f64> {
    let (lanes, n) = (factors.harmonics(), factors.contact_unknowns());
    let slot = |i: usize| n - SIZE * (i / SIZE + 1) + i % SIZE;
    let mut all = vec![0.0; n * n * lanes];
    for m in 0..lanes {
        let complement = factors.schur_complement(m);
        let mut lower = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
                let rest = complement[slot(i) * n + slot(j)] - known;
                lower[i * n + j] = if i == j { rest.sqrt() } else { rest / lower[j * n + j] };
                all[(i * n + j) * lanes + m] = lower[i * n + j];
            }
        }
    }
    all
}

#[cfg(test)]
mod tests;
