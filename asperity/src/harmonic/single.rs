//! The sweeps of the preconditioner, in single precision and node by node.
//!
//! They are bound by memory, and a preconditioner needs few digits: conjugate gradients take as
//! many iterations as with the factors in double precision. The three components of a node have
//! one pattern, so the factor consists of 3 × 3 blocks, and a sweep goes through a vector once per
//! block instead of three times.
//!
//! What does not depend on θ has no u_θ, so that one harmonic alone takes 2 × 2 blocks over (u_r, u_z), and leaves
//! u_θ as it is.
//!
//! The rings of the contact come last, the outermost first: a sweep may stop before any of them,
//! and what it leaves is the stiffness of the body as the rings within feel it.

use super::{FieldKind, HarmonicFactors};

/// Components of a node.
const SIZE: usize = 3;

type Wide<const M: usize> = [f32; M];

/// Row and column of the entries of a block.
const FULL: [(usize, usize); SIZE * SIZE] =
    [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];
/// Those over (u_r, u_z), which are all of one harmonic alone.
const PLANE: [(usize, usize); 4] = [(0, 0), (0, 2), (2, 0), (2, 2)];

/// Factor over nodes, harmonics as lanes.
#[derive(Debug)]
pub struct SingleFactors {
    harmonics: usize,
    rings: usize,
    /// Nodes that are not on the contact.
    interior: usize,
    /// Of the blocks below the diagonal, per node.
    start: Vec<u32>,
    row: Vec<u32>,
    /// Those of `places`, block by block.
    block: Vec<f32>,
    /// Per node the inverse diagonal (3 values) and what is below it (10, 20, 21).
    diagonal: Vec<f32>,
    /// The contact's part of the factor in double precision, dense over (slot, component), where
    /// slot 0 is the outermost ring: `[(i*n + j)*harmonics + m]`.
    contact: Vec<f64>,
}

impl SingleFactors {
    /// Of the factors of a vector field.
    pub fn new(factors: &HarmonicFactors) -> Self {
        assert_eq!(factors.kind, FieldKind::Vector);
        let lanes = factors.harmonics();
        let interior = factors.interior / SIZE;
        let rings = factors.contact_unknowns() / SIZE;
        let mut single = Self {
            harmonics: lanes,
            rings,
            interior,
            start: vec![0],
            row: Vec::new(),
            block: Vec::new(),
            diagonal: Vec::new(),
            contact: contact_factor(factors),
        };
        for node in 0..interior {
            let column = |c: usize| factors.column_start[SIZE * node + c] as usize;
            let diagonal = |c: usize| &factors.inverse_diagonal[(SIZE * node + c) * lanes..][..lanes];
            let entry = |e: usize| &factors.value[e * lanes..][..lanes];
            let own = [diagonal(0), diagonal(1), diagonal(2)];
            let below = [entry(column(0)), entry(column(0) + 1), entry(column(1))];
            single.diagonal.extend(own.into_iter().chain(below).flatten().map(|&x| x as f32));
            // After those of the node itself come whole nodes, the same ones in all three columns.
            let first: [usize; SIZE] = std::array::from_fn(|c| column(c) + SIZE - 1 - c);
            let count = column(1) - first[0];
            assert_eq!(count, factors.column_start[SIZE * node + SIZE] as usize - first[2]);
            for k in (0..count).step_by(SIZE) {
                let unknown = factors.row[first[0] + k] as usize;
                assert!(unknown.is_multiple_of(SIZE));
                single.row.push(single.place(unknown / SIZE) as u32);
                for &(r, c) in single.places() {
                    single.block.extend(entry(first[c] + k + r).iter().map(|&x| x as f32));
                }
            }
            single.start.push(single.row.len() as u32);
        }
        single.add_contact_columns();
        single
    }

    /// Node of the factors as node of this one: contact rings in reverse.
    fn place(&self, node: usize) -> usize {
        match node.checked_sub(self.interior) {
            None => node,
            Some(ring) => self.interior + self.rings - 1 - ring,
        }
    }

    fn places(&self) -> &'static [(usize, usize)] {
        if self.harmonics == 1 { &PLANE } else { &FULL }
    }

    fn add_contact_columns(&mut self) {
        let (lanes, n) = (self.harmonics, SIZE * self.rings);
        for slot in 0..self.rings {
            let entry = |i: usize, j: usize| &self.contact[(i * n + j) * lanes..][..lanes];
            let j = SIZE * slot;
            for c in 0..SIZE {
                self.diagonal.extend(entry(j + c, j + c).iter().map(|&x| (1.0 / x) as f32));
            }
            for (r, c) in [(1, 0), (2, 0), (2, 1)] {
                self.diagonal.extend(entry(j + r, j + c).iter().map(|&x| x as f32));
            }
            for below in slot + 1..self.rings {
                self.row.push((self.interior + below) as u32);
                for &(r, c) in self.places() {
                    self.block.extend(entry(SIZE * below + r, j + c).iter().map(|&x| x as f32));
                }
            }
            self.start.push(self.row.len() as u32);
        }
    }

    pub fn harmonics(&self) -> usize {
        self.harmonics
    }

    #[cfg(test)]
    pub fn rings(&self) -> usize {
        self.rings
    }

    /// Length of the vector of all harmonics.
    pub fn len(&self) -> usize {
        (self.interior + self.rings) * SIZE * self.harmonics
    }

    /// Bytes that one sweep reads of the factor.
    pub fn bytes(&self) -> usize {
        4 * (self.block.len() + self.diagonal.len() + self.row.len())
    }

    /// Multiplications with additions of one sweep.
    pub fn multiplications(&self) -> usize {
        self.block.len() + self.diagonal.len()
    }

    /// Stiffness of the body as the innermost `rings` feel it while the others are free, for
    /// harmonic m between (ring, component) i and j, as `f(i, j, m, value)`.
    pub fn contact_stiffness(&self, rings: usize, mut f: impl FnMut(usize, usize, usize, f64)) {
        let (lanes, n) = (self.harmonics, SIZE * self.rings);
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

    /// Single precision of a modal vector in the order of the factors.
    pub fn load(&self, modal: &[f64], x: &mut [f32]) {
        let node = SIZE * self.harmonics;
        let (interior, contact) = modal.split_at(self.interior * node);
        for (x, &value) in x.iter_mut().zip(interior) {
            *x = value as f32;
        }
        let slots = x[self.interior * node..].chunks_exact_mut(node);
        for (x, values) in slots.zip(contact.chunks_exact(node).rev()) {
            x.iter_mut().zip(values).for_each(|(x, &value)| *x = value as f32);
        }
    }

    /// Back to the order of the factors.
    pub fn store(&self, x: &[f32], modal: &mut [f64]) {
        let node = SIZE * self.harmonics;
        let (interior, contact) = modal.split_at_mut(self.interior * node);
        for (value, &x) in interior.iter_mut().zip(x) {
            *value = f64::from(x);
        }
        let slots = x[self.interior * node..].chunks_exact(node);
        for (values, x) in contact.chunks_exact_mut(node).rev().zip(slots) {
            values.iter_mut().zip(x).for_each(|(value, &x)| *value = f64::from(x));
        }
    }

    /// Eliminates all but the innermost `rings`.
    pub fn forward(&self, x: &mut [f32], rings: usize) {
        let nodes = self.interior + self.rings - rings;
        match self.harmonics {
            1 => self.forward_in_plane(x, nodes),
            4 => self.forward_lanes::<4>(x, nodes),
            8 => self.forward_lanes::<8>(x, nodes),
            16 => self.forward_lanes::<16>(x, nodes),
            lanes => (0..lanes).for_each(|lane| self.forward_one(x, nodes, lane)),
        }
    }

    /// Substitutes back, given the displacement of the innermost `rings`.
    pub fn backward(&self, x: &mut [f32], rings: usize) {
        let nodes = self.interior + self.rings - rings;
        match self.harmonics {
            1 => self.backward_in_plane(x, nodes),
            4 => self.backward_lanes::<4>(x, nodes),
            8 => self.backward_lanes::<8>(x, nodes),
            16 => self.backward_lanes::<16>(x, nodes),
            lanes => (0..lanes).for_each(|lane| self.backward_one(x, nodes, lane)),
        }
    }

    fn forward_in_plane(&self, x: &mut [f32], nodes: usize) {
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<{ PLANE.len() }>();
        for j in 0..nodes {
            let [over_r, _, over_z, _, z_r, _] = diagonal[j];
            let r = x[j][0] * over_r;
            let z = (x[j][2] - z_r * r) * over_z;
            (x[j][0], x[j][2]) = (r, z);
            let entries = self.start[j] as usize..self.start[j + 1] as usize;
            for ([rr, rz, zr, zz], &i) in block[entries.clone()].iter().zip(&self.row[entries]) {
                let y = &mut x[i as usize];
                y[0] -= rr * r + rz * z;
                y[2] -= zr * r + zz * z;
            }
        }
    }

    fn backward_in_plane(&self, x: &mut [f32], nodes: usize) {
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<{ PLANE.len() }>();
        for j in (0..nodes).rev() {
            let [over_r, _, over_z, _, z_r, _] = diagonal[j];
            let [mut r, _, mut z] = x[j];
            let entries = self.start[j] as usize..self.start[j + 1] as usize;
            for ([rr, rz, zr, zz], &i) in block[entries.clone()].iter().zip(&self.row[entries]) {
                let y = &x[i as usize];
                r -= rr * y[0] + zr * y[2];
                z -= rz * y[0] + zz * y[2];
            }
            z *= over_z;
            (x[j][0], x[j][2]) = ((r - z_r * z) * over_r, z);
        }
    }

    fn forward_lanes<const M: usize>(&self, x: &mut [f32], nodes: usize) {
        let (x, _) = x.as_chunks_mut::<M>();
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<M>();
        let (diagonal, _) = diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<M>();
        let (block, _) = block.as_chunks::<{ SIZE * SIZE }>();
        for j in 0..nodes {
            let [d0, d1, d2, l10, l20, l21] = &diagonal[j];
            let mut v = x[j];
            for l in 0..M {
                v[0][l] *= d0[l];
                v[1][l] = (v[1][l] - l10[l] * v[0][l]) * d1[l];
                v[2][l] = (v[2][l] - l20[l] * v[0][l] - l21[l] * v[1][l]) * d2[l];
            }
            x[j] = v;
            let entries = self.start[j] as usize..self.start[j + 1] as usize;
            for (b, &i) in block[entries.clone()].iter().zip(&self.row[entries]) {
                let y = &mut x[i as usize];
                for r in 0..SIZE {
                    let mut sum = y[r];
                    for c in 0..SIZE {
                        subtract_product(&mut sum, &b[SIZE * r + c], &v[c]);
                    }
                    y[r] = sum;
                }
            }
        }
    }

    fn backward_lanes<const M: usize>(&self, x: &mut [f32], nodes: usize) {
        let (x, _) = x.as_chunks_mut::<M>();
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<M>();
        let (diagonal, _) = diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<M>();
        let (block, _) = block.as_chunks::<{ SIZE * SIZE }>();
        for j in (0..nodes).rev() {
            let [d0, d1, d2, l10, l20, l21] = &diagonal[j];
            // A sum for each row of the blocks: one alone would wait for itself.
            let mut sums = [x[j], [[0.0; M]; SIZE], [[0.0; M]; SIZE]];
            let entries = self.start[j] as usize..self.start[j + 1] as usize;
            for (b, &i) in block[entries.clone()].iter().zip(&self.row[entries]) {
                let y = &x[i as usize];
                for r in 0..SIZE {
                    for c in 0..SIZE {
                        subtract_product(&mut sums[r][c], &b[SIZE * r + c], &y[r]);
                    }
                }
            }
            let [mut v, second, third] = sums;
            for c in 0..SIZE {
                for l in 0..M {
                    v[c][l] += second[c][l] + third[c][l];
                }
            }
            for l in 0..M {
                v[2][l] *= d2[l];
                v[1][l] = (v[1][l] - l21[l] * v[2][l]) * d1[l];
                v[0][l] = (v[0][l] - l10[l] * v[1][l] - l20[l] * v[2][l]) * d0[l];
            }
            x[j] = v;
        }
    }

    /// One harmonic, for numbers of them without a version of their own.
    fn forward_one(&self, x: &mut [f32], nodes: usize, lane: usize) {
        let lanes = self.harmonics;
        for j in 0..nodes {
            let d: [f32; 6] = std::array::from_fn(|k| self.diagonal[(6 * j + k) * lanes + lane]);
            let at = |node: usize, c: usize| (SIZE * node + c) * lanes + lane;
            let mut v: [f32; SIZE] = std::array::from_fn(|c| x[at(j, c)]);
            v[0] *= d[0];
            v[1] = (v[1] - d[3] * v[0]) * d[1];
            v[2] = (v[2] - d[4] * v[0] - d[5] * v[1]) * d[2];
            (0..SIZE).for_each(|c| x[at(j, c)] = v[c]);
            for e in self.start[j] as usize..self.start[j + 1] as usize {
                let i = self.row[e] as usize;
                for (r, c) in (0..SIZE * SIZE).map(|k| (k / SIZE, k % SIZE)) {
                    x[at(i, r)] -= self.block[(9 * e + SIZE * r + c) * lanes + lane] * v[c];
                }
            }
        }
    }

    fn backward_one(&self, x: &mut [f32], nodes: usize, lane: usize) {
        let lanes = self.harmonics;
        for j in (0..nodes).rev() {
            let d: [f32; 6] = std::array::from_fn(|k| self.diagonal[(6 * j + k) * lanes + lane]);
            let at = |node: usize, c: usize| (SIZE * node + c) * lanes + lane;
            let mut v: [f32; SIZE] = std::array::from_fn(|c| x[at(j, c)]);
            for e in self.start[j] as usize..self.start[j + 1] as usize {
                let i = self.row[e] as usize;
                for (r, c) in (0..SIZE * SIZE).map(|k| (k / SIZE, k % SIZE)) {
                    v[c] -= self.block[(9 * e + SIZE * r + c) * lanes + lane] * x[at(i, r)];
                }
            }
            v[2] *= d[2];
            v[1] = (v[1] - d[5] * v[2]) * d[1];
            v[0] = (v[0] - d[3] * v[1] - d[4] * v[2]) * d[0];
            (0..SIZE).for_each(|c| x[at(j, c)] = v[c]);
        }
    }
}

/// sum -= a·b.
#[inline(always)]
fn subtract_product<const M: usize>(sum: &mut Wide<M>, a: &Wide<M>, b: &Wide<M>) {
    for l in 0..M {
        sum[l] =
            if cfg!(target_feature = "fma") { (-a[l]).mul_add(b[l], sum[l]) } else { sum[l] - a[l] * b[l] };
    }
}

/// Cholesky factors of the contact's Schur complements with the rings in reverse.
fn contact_factor(factors: &HarmonicFactors) -> Vec<f64> {
    let (lanes, n) = (factors.harmonics(), factors.contact_unknowns());
    let slot = |i: usize| n - SIZE * (i / SIZE + 1) + i % SIZE;
    let mut all = vec![0.0; n * n * lanes];
    for m in 0..lanes {
        let stiffness = factors.contact_stiffness(m);
        let mut lower = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
                let rest = stiffness[slot(i) * n + slot(j)] - known;
                lower[i * n + j] = if i == j { rest.sqrt() } else { rest / lower[j * n + j] };
                all[(i * n + j) * lanes + m] = lower[i * n + j];
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::HarmonicPattern;
    use super::*;
    use crate::elastic::{Moduli, element_stiffness};
    use crate::element::RevolvedMesh;
    use crate::mesh::{MeridianMesh, MeshSize};
    use crate::sectors::Sectors;

    fn factors(sectors: usize) -> HarmonicFactors {
        let meridian = MeridianMesh::new(MeshSize::new(0.05, 4));
        let mesh = RevolvedMesh::new(meridian, Sectors::full(sectors));
        let moduli = Moduli::new(250.0, 0.3);
        let pattern = HarmonicPattern::new(&mesh, FieldKind::Vector).unwrap();
        pattern.factorise(&mesh, |e, m| element_stiffness(&mesh, e, moduli, m)).unwrap()
    }

    /// A force that every harmonic has its share of, zero where the axis has no unknowns, without a hoop component
    /// if it does not depend on θ.
    fn force(factors: &HarmonicFactors) -> Vec<f64> {
        let nodal: Vec<f64> =
            (0..factors.on_axis.len() * 3 * factors.harmonics()).map(|i| (0.7 * i as f64).sin()).collect();
        let mut modal = vec![0.0; factors.modal_length()];
        factors.to_modal(&nodal, &mut modal);
        if factors.harmonics() == 1 {
            modal.iter_mut().skip(1).step_by(SIZE).for_each(|hoop| *hoop = 0.0);
        }
        modal
    }

    #[test]
    fn single_precision_solves_what_double_does() {
        for sectors in [1, 4, 8, 12] {
            let factors = factors(sectors);
            let single = SingleFactors::new(&factors);
            let force = force(&factors);
            let mut exact = force.clone();
            factors.forward(&mut exact);
            factors.solve_free_contact(&mut exact);
            factors.backward(&mut exact);
            let largest = exact.iter().fold(0.0f64, |m, x| m.max(x.abs()));

            let lanes = factors.harmonics();
            let mut x = vec![0.0; single.len()];
            let mut solution = force.clone();
            for rings in [0, 1, 3, single.rings()] {
                single.load(&force, &mut x);
                single.forward(&mut x, rings);
                // The dense system of the innermost rings, harmonic by harmonic.
                let n = SIZE * rings;
                let mut stiffness = vec![nalgebra::DMatrix::<f64>::zeros(n, n); lanes];
                single.contact_stiffness(rings, |i, j, m, value| stiffness[m][(i, j)] = value);
                let first = x.len() - n * lanes;
                let place =
                    |i: usize, m: usize| first + (SIZE * (rings - 1 - i / SIZE) + i % SIZE) * lanes + m;
                for (m, stiffness) in stiffness.into_iter().enumerate().filter(|_| n > 0) {
                    let right = nalgebra::DVector::from_fn(n, |i, _| f64::from(x[place(i, m)]));
                    let left = stiffness.cholesky().unwrap().solve(&right);
                    (0..n).for_each(|i| x[place(i, m)] = left[i] as f32);
                }
                single.backward(&mut x, rings);
                single.store(&x, &mut solution);
                for (i, (a, b)) in solution.iter().zip(&exact).enumerate() {
                    assert!((a - b).abs() < 1e-4 * largest, "{sectors} {rings} {i}: {a} {b}");
                }
            }
        }
    }
}
