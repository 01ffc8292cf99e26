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

use wide::f32x4;

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
    /// Place of each node of the mesh, unless it is fixed.
    place: Vec<Option<u32>>,
    /// Of the blocks below the diagonal, per node.
    start: Vec<u32>,
    row: Vec<u32>,
    /// Those of `entries`, block by block.
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
            place: Vec::new(),
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
                single.row.push(single.reversed(unknown / SIZE) as u32);
                for &(r, c) in single.entries() {
                    single.block.extend(entry(first[c] + k + r).iter().map(|&x| x as f32));
                }
            }
            single.start.push(single.row.len() as u32);
        }
        single.add_contact_columns();
        let place = |node| factors.first_place(node).map(|first| single.reversed(first / SIZE) as u32);
        single.place = (0..factors.on_axis.len()).map(place).collect();
        single
    }

    /// Node of the factors as node of this one: contact rings in reverse.
    fn reversed(&self, node: usize) -> usize {
        match node.checked_sub(self.interior) {
            None => node,
            Some(ring) => self.interior + self.rings - 1 - ring,
        }
    }

    fn entries(&self) -> &'static [(usize, usize)] {
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
                for &(r, c) in self.entries() {
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

    /// Blocks below the diagonal at a place.
    fn column(&self, place: usize) -> std::ops::Range<usize> {
        self.start[place] as usize..self.start[place + 1] as usize
    }

    /// Harmonics of the forces on some nodes of the mesh.
    pub fn load(
        &self,
        factors: &HarmonicFactors,
        force: &[f64],
        nodes: impl Iterator<Item = usize>,
        x: &mut [f32],
    ) {
        let size = SIZE * self.harmonics;
        let mut modal = vec![0.0; size];
        for node in nodes {
            let Some(place) = self.place(node) else { continue };
            factors.node_to_modal(node, &force[node * size..][..size], &mut modal);
            x[place * size..][..size].iter_mut().zip(&modal).for_each(|(x, &value)| *x = value as f32);
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
        let size = SIZE * self.harmonics;
        let mut modal = vec![0.0; size];
        for node in nodes {
            let values = &mut field[node * size..][..size];
            let Some(place) = self.place(node) else {
                values.fill(0.0);
                continue;
            };
            modal.iter_mut().zip(&x[place * size..]).for_each(|(value, &x)| *value = f64::from(x));
            factors.node_to_nodal(node, &modal, values);
        }
    }

    /// Number of nodes of the mesh.
    pub fn nodes(&self) -> usize {
        self.place.len()
    }

    /// Place of a node of the mesh, unless it is fixed.
    pub fn place(&self, node: usize) -> Option<usize> {
        self.place[node].map(|place| place as usize)
    }

    /// Places before those of the innermost `rings`, in the order of elimination.
    pub fn places_before(&self, rings: usize) -> std::ops::Range<u32> {
        0..(self.interior + self.rings - rings) as u32
    }

    /// Marks also what the marked places are eliminated into: a force on these alone leaves the rest of a forward
    /// sweep at zero. The contact always belongs to it.
    pub fn close(&self, marked: &mut [bool]) {
        marked[self.interior..].fill(true);
        for j in 0..self.interior {
            // The first is the parent in the elimination tree, from which the others can be reached.
            if let (true, Some(&parent)) = (marked[j], self.row[self.column(j)].first()) {
                marked[parent as usize] = true;
            }
        }
    }

    /// Eliminates `places`, which rise.
    pub fn forward(&self, x: &mut [f32], places: &[u32]) {
        match self.harmonics {
            1 => self.forward_in_plane(x, places),
            4 => self.forward_lanes::<4>(x, places),
            8 => self.forward_lanes::<8>(x, places),
            16 => self.forward_lanes::<16>(x, places),
            lanes => (0..lanes).for_each(|lane| self.forward_one(x, places, lane)),
        }
    }

    /// Substitutes `places` back, which rise, given the displacement of what they are eliminated into.
    pub fn backward(&self, x: &mut [f32], places: &[u32]) {
        match self.harmonics {
            1 => self.backward_in_plane(x, places),
            4 => self.backward_lanes::<4>(x, places),
            8 => self.backward_lanes::<8>(x, places),
            16 => self.backward_lanes::<16>(x, places),
            lanes => (0..lanes).for_each(|lane| self.backward_one(x, places, lane)),
        }
    }

    fn forward_in_plane(&self, x: &mut [f32], places: &[u32]) {
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<{ PLANE.len() }>();
        for j in places.iter().map(|&j| j as usize) {
            let [over_r, _, over_z, _, z_r, _] = diagonal[j];
            let r = x[j][0] * over_r;
            let z = (x[j][2] - z_r * r) * over_z;
            (x[j][0], x[j][2]) = (r, z);
            let entries = self.column(j);
            for ([rr, rz, zr, zz], &i) in block[entries.clone()].iter().zip(&self.row[entries]) {
                let y = &mut x[i as usize];
                y[0] -= rr * r + rz * z;
                y[2] -= zr * r + zz * z;
            }
        }
    }

    fn backward_in_plane(&self, x: &mut [f32], places: &[u32]) {
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<{ PLANE.len() }>();
        for j in places.iter().rev().map(|&j| j as usize) {
            // Sums that need not wait for each other, over the entries of blocks.
            let mut sums = [f32x4::ZERO; 4];
            let entries = self.column(j);
            let (blocks, rows) = (&block[entries.clone()], &self.row[entries]);
            for (blocks, rows) in blocks.rchunks(sums.len()).zip(rows.rchunks(sums.len())) {
                for ((sum, &block), &i) in sums.iter_mut().zip(blocks).zip(rows) {
                    let [r, _, z] = x[i as usize];
                    *sum = f32x4::new(block).mul_add(f32x4::new([r, r, z, z]), *sum);
                }
            }
            let [rr, rz, zr, zz] = ((sums[0] + sums[1]) + (sums[2] + sums[3])).to_array();
            let [over_r, _, over_z, _, z_r, _] = diagonal[j];
            let z = (x[j][2] - (rz + zz)) * over_z;
            (x[j][0], x[j][2]) = ((x[j][0] - (rr + zr) - z_r * z) * over_r, z);
        }
    }

    fn forward_lanes<const M: usize>(&self, x: &mut [f32], places: &[u32]) {
        let (x, _) = x.as_chunks_mut::<M>();
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<M>();
        let (diagonal, _) = diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<M>();
        let (block, _) = block.as_chunks::<{ SIZE * SIZE }>();
        for j in places.iter().map(|&j| j as usize) {
            let [d0, d1, d2, l10, l20, l21] = &diagonal[j];
            let mut v = x[j];
            for l in 0..M {
                v[0][l] *= d0[l];
                v[1][l] = (v[1][l] - l10[l] * v[0][l]) * d1[l];
                v[2][l] = (v[2][l] - l20[l] * v[0][l] - l21[l] * v[1][l]) * d2[l];
            }
            x[j] = v;
            let entries = self.column(j);
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

    fn backward_lanes<const M: usize>(&self, x: &mut [f32], places: &[u32]) {
        let (x, _) = x.as_chunks_mut::<M>();
        let (x, _) = x.as_chunks_mut::<SIZE>();
        let (diagonal, _) = self.diagonal.as_chunks::<M>();
        let (diagonal, _) = diagonal.as_chunks::<6>();
        let (block, _) = self.block.as_chunks::<M>();
        let (block, _) = block.as_chunks::<{ SIZE * SIZE }>();
        for j in places.iter().rev().map(|&j| j as usize) {
            let [d0, d1, d2, l10, l20, l21] = &diagonal[j];
            // A sum for each row of the blocks: one alone would wait for itself.
            let mut sums = [x[j], [[0.0; M]; SIZE], [[0.0; M]; SIZE]];
            let entries = self.column(j);
            // From the end: memory is fetched ahead as long as addresses keep falling.
            for (b, &i) in block[entries.clone()].iter().zip(&self.row[entries]).rev() {
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
    fn forward_one(&self, x: &mut [f32], places: &[u32], lane: usize) {
        let lanes = self.harmonics;
        for j in places.iter().map(|&j| j as usize) {
            let d: [f32; 6] = std::array::from_fn(|k| self.diagonal[(6 * j + k) * lanes + lane]);
            let at = |node: usize, c: usize| (SIZE * node + c) * lanes + lane;
            let mut v: [f32; SIZE] = std::array::from_fn(|c| x[at(j, c)]);
            v[0] *= d[0];
            v[1] = (v[1] - d[3] * v[0]) * d[1];
            v[2] = (v[2] - d[4] * v[0] - d[5] * v[1]) * d[2];
            (0..SIZE).for_each(|c| x[at(j, c)] = v[c]);
            for e in self.column(j) {
                let i = self.row[e] as usize;
                for (r, c) in (0..SIZE * SIZE).map(|k| (k / SIZE, k % SIZE)) {
                    x[at(i, r)] -= self.block[(9 * e + SIZE * r + c) * lanes + lane] * v[c];
                }
            }
        }
    }

    fn backward_one(&self, x: &mut [f32], places: &[u32], lane: usize) {
        let lanes = self.harmonics;
        for j in places.iter().rev().map(|&j| j as usize) {
            let d: [f32; 6] = std::array::from_fn(|k| self.diagonal[(6 * j + k) * lanes + lane]);
            let at = |node: usize, c: usize| (SIZE * node + c) * lanes + lane;
            let mut v: [f32; SIZE] = std::array::from_fn(|c| x[at(j, c)]);
            for e in self.column(j) {
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
mod tests;
