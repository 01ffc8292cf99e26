//! Exact solver for axisymmetric operators on the revolved mesh.
//!
//! A cosine transform in θ of even components and a sine transform of odd ones decouple the 3-D
//! problem into one sparse problem on the meridian per harmonic m = 0 … N_θ. All harmonics share
//! one sparsity pattern, so their Cholesky factors are stored as lanes and one sweep solves all.
//!
//! The unknowns of the contact nodes come last. Elimination of the rest leaves, exactly, their
//! Schur complement: the dense stiffness of the body as the contact feels it. A solve is a
//! forward sweep, whatever is to be done with that dense system (contact springs, nonlinear
//! heat exchange), and a backward sweep.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::{amd, cholesky::simplicial};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

use crate::element::RevolvedMesh;
use crate::lanes::fma;

/// Which nodal values an operator acts on.
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

    pub fn is_odd(self, component: usize) -> bool {
        self == FieldKind::Vector && component == 1
    }
}

const ABSENT: u32 = u32::MAX;

#[derive(Debug, thiserror::Error)]
pub enum FactorError {
    #[error("harmonic {harmonic} of the stiffness is not positive definite")]
    NotPositiveDefinite { harmonic: usize },
    #[error("out of memory in the factorisation")]
    Memory,
}

/// Cosine and sine transforms in θ, scaled so that energies keep their value.
#[derive(Clone, Debug)]
pub struct ThetaTransform {
    pub columns: usize,
    /// `even[m*columns + j]`: weight of harmonic m at angle j.
    pub even: Vec<f64>,
    pub odd: Vec<f64>,
}

impl ThetaTransform {
    fn new(mesh: &RevolvedMesh) -> Self {
        let sectors = mesh.sectors;
        let columns = sectors.columns();
        let n = sectors.count as f64;
        let mut even = vec![0.0; columns * columns];
        let mut odd = vec![0.0; columns * columns];
        for m in 0..columns {
            let norm = if m == 0 || m == sectors.count { n } else { 0.5 * n };
            for j in 0..columns {
                // Reduce m·j so that zeros come out as zeros.
                let turns = (m * j) % (2 * sectors.count);
                let angle = turns as f64 * sectors.angle();
                even[m * columns + j] = angle.cos() / norm.sqrt();
                odd[m * columns + j] =
                    if turns.is_multiple_of(sectors.count) { 0.0 } else { angle.sin() / norm.sqrt() };
            }
        }
        Self { columns, even, odd }
    }

    pub fn of(&self, odd: bool) -> &[f64] {
        if odd { &self.odd } else { &self.even }
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
    column_start: Vec<u32>,
    row: Vec<u32>,
    /// Entries of L below the diagonal, harmonics as lanes; 1/diagonal apart.
    value: Vec<f64>,
    inverse_diagonal: Vec<f64>,
    /// Cholesky factor of the Schur complement of the contact unknowns per harmonic, dense
    /// lower triangle, row by row.
    schur: Vec<f64>,
}

/// Sparsity pattern, ordering and elimination tree of an operator: made once per mesh.
#[derive(Debug)]
pub struct HarmonicPattern {
    kind: FieldKind,
    unknowns: usize,
    interior: usize,
    position: Vec<u32>,
    column_start: Vec<usize>,
    row: Vec<usize>,
    symbolic: simplicial::SymbolicSimplicialCholesky<usize>,
}

impl HarmonicPattern {
    pub fn new(mesh: &RevolvedMesh, kind: FieldKind) -> Result<Self, FactorError> {
        let components = kind.components();
        let meridian = &mesh.meridian;
        let nodes = mesh.node_count();
        let mut is_contact = vec![false; nodes];
        for &node in &meridian.contact {
            is_contact[node as usize] = true;
        }

        // Minimum-degree order of the interior nodes, then the contact rings.
        let interior_nodes: Vec<usize> =
            (0..nodes).filter(|&n| !is_contact[n] && !meridian.is_base[n]).collect();
        let mut local = vec![usize::MAX; nodes];
        for (i, &node) in interior_nodes.iter().enumerate() {
            local[node] = i;
        }
        let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); interior_nodes.len()];
        for quad in &meridian.quads {
            for &a in quad {
                for &b in quad {
                    let (i, j) = (local[a as usize], local[b as usize]);
                    if i != usize::MAX && j != usize::MAX && i <= j {
                        neighbours[j].push(i);
                    }
                }
            }
        }
        let (column_start, row) = compress(&mut neighbours);
        let n = interior_nodes.len();
        let graph = SymbolicSparseColMatRef::new_checked(n, n, &column_start, None, &row);
        let (mut order, mut rank) = (vec![0usize; n], vec![0usize; n]);
        let mut memory =
            MemBuffer::try_new(amd::order_scratch::<usize>(n, row.len())).map_err(|_| FactorError::Memory)?;
        amd::order(&mut order, &mut rank, graph, amd::Control::default(), MemStack::new(&mut memory))
            .map_err(|_| FactorError::Memory)?;
        let mut position = vec![ABSENT; nodes * components];
        let sequence =
            order.iter().map(|&i| interior_nodes[i]).chain(meridian.contact.iter().map(|&n| n as usize));
        let mut unknowns = 0;
        for node in sequence {
            for c in 0..components {
                position[node * components + c] = unknowns as u32;
                unknowns += 1;
            }
        }
        let interior = unknowns - meridian.contact.len() * components;

        // Pattern of the permuted upper triangle.
        let mut columns: Vec<Vec<usize>> = vec![Vec::new(); unknowns];
        for quad in &meridian.quads {
            for &a in quad {
                for &b in quad {
                    for (ca, cb) in (0..components * components).map(|i| (i / components, i % components)) {
                        let i = position[a as usize * components + ca];
                        let j = position[b as usize * components + cb];
                        if i != ABSENT && j != ABSENT && i <= j {
                            columns[j as usize].push(i as usize);
                        }
                    }
                }
            }
        }
        // The contact block is dense in the factor anyway; say so, to read it off row by row.
        for j in interior..unknowns {
            columns[j].extend(interior..=j);
        }
        let (column_start, row) = compress(&mut columns);
        let pattern = SymbolicSparseColMatRef::new_checked(unknowns, unknowns, &column_start, None, &row);
        let mut memory = MemBuffer::try_new(StackReq::any_of(&[
            simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(unknowns, row.len()),
            simplicial::factorize_simplicial_symbolic_cholesky_scratch::<usize>(unknowns),
        ]))
        .map_err(|_| FactorError::Memory)?;
        let (mut tree, mut counts) = (vec![0isize; unknowns], vec![0usize; unknowns]);
        simplicial::prefactorize_symbolic_cholesky(
            &mut tree,
            &mut counts,
            pattern,
            MemStack::new(&mut memory),
        );
        let symbolic = simplicial::factorize_simplicial_symbolic_cholesky(
            pattern,
            // SAFETY: the tree was just filled for this pattern.
            unsafe { simplicial::EliminationTreeRef::from_inner(&tree) },
            &counts,
            MemStack::new(&mut memory),
        )
        .map_err(|_| FactorError::Memory)?;
        Ok(Self { kind, unknowns, interior, position, column_start, row, symbolic })
    }

    /// Factors of the operator whose sector-element matrices are given.
    ///
    /// `matrix(e)` is the stiffness of element e in the frame of its sector: row-major over
    /// (local node, component), 24 × 24 or 8 × 8.
    pub fn factorise(
        &self,
        mesh: &RevolvedMesh,
        matrix: impl Fn(usize) -> Vec<f64>,
    ) -> Result<HarmonicFactors, FactorError> {
        let sectors = mesh.sectors;
        let columns = sectors.columns();
        let components = self.kind.components();
        let rows = 4 * components;
        let mut values = vec![vec![0.0; self.row.len()]; columns];
        let entry = |i: usize, j: usize| {
            let column = self.column_start[j]..self.column_start[j + 1];
            column.start + self.row[column].binary_search(&i).expect("entry is in the pattern")
        };
        for (e, element) in mesh.elements.iter().enumerate() {
            let sector_matrix = self.rotate(&matrix(e), sectors.angle());
            let place: Vec<u32> = (0..rows)
                .map(|i| self.position[element.nodes[i / components] as usize * components + i % components])
                .collect();
            let axis: Vec<bool> = element.nodes.iter().map(|&n| mesh.meridian.on_axis(n as usize)).collect();
            for (m, values) in values.iter_mut().enumerate() {
                let mut local = self.harmonic_matrix(&sector_matrix, 0.5 * m as f64 * sectors.angle());
                self.constrain_axis(&mut local, &axis, m);
                for i in 0..rows {
                    for j in 0..rows {
                        let (p, q) = (place[i], place[j]);
                        if p != ABSENT && q != ABSENT && p <= q {
                            values[entry(p as usize, q as usize)] += local[i * rows + j];
                        }
                    }
                }
            }
        }
        // Unknowns that the axis does not have in a harmonic: unit diagonal.
        for (m, values) in values.iter_mut().enumerate() {
            for node in (0..mesh.node_count()).filter(|&n| mesh.meridian.on_axis(n)) {
                for c in (0..components).filter(|&c| !self.exists_on_axis(c, m)) {
                    let place = self.position[node * components + c];
                    if place == ABSENT {
                        continue;
                    }
                    let place = place as usize;
                    values[self.column_start[place]..self.column_start[place + 1]].fill(0.0);
                    for j in place..self.unknowns {
                        let column = self.column_start[j]..self.column_start[j + 1];
                        if let Ok(at) = self.row[column.clone()].binary_search(&place) {
                            values[column.start + at] = 0.0;
                        }
                    }
                    values[entry(place, place)] = 1.0;
                }
            }
        }
        self.gather_factors(mesh, &values)
    }

    /// Whether the axis has component c in harmonic m: u_z (and T) of m = 0, and the translation
    /// u_r = −u_θ of m = 1, which is kept as u_r. (Off the axis all components are kept; u_θ of
    /// m = 0 and N_θ is decoupled, never loaded and never read.)
    fn exists_on_axis(&self, component: usize, m: usize) -> bool {
        match (self.kind, component) {
            (FieldKind::Vector, 0) => m == 1,
            (FieldKind::Vector, 1) => false,
            _ => m == 0,
        }
    }

    /// Turns nodal components from the sector's frame to (r, θ, z).
    fn rotate(&self, matrix: &[f64], angle: f64) -> Vec<f64> {
        if self.kind == FieldKind::Scalar {
            return matrix.to_vec();
        }
        let (sin, cos) = (0.5 * angle).sin_cos();
        let size = 24;
        let mut turned = matrix.to_vec();
        // Columns, then rows: (f_r, f_θ) = (f_x cos + f_y sin, −f_x sin + f_y cos).
        for n in 0..8 {
            let sin = if n < 4 { -sin } else { sin };
            for i in 0..size {
                let (x, y) = (turned[i * size + 3 * n], turned[i * size + 3 * n + 1]);
                turned[i * size + 3 * n] = x * cos + y * sin;
                turned[i * size + 3 * n + 1] = y * cos - x * sin;
            }
        }
        for n in 0..8 {
            let sin = if n < 4 { -sin } else { sin };
            for j in 0..size {
                let (x, y) = (turned[3 * n * size + j], turned[(3 * n + 1) * size + j]);
                turned[3 * n * size + j] = x * cos + y * sin;
                turned[(3 * n + 1) * size + j] = y * cos - x * sin;
            }
        }
        turned
    }

    /// Matrix on the meridian of the harmonic whose phase over half a sector is `phase`:
    /// CᵀkC + SᵀkS, where C and S expand meridian values into the values on both sides of a
    /// sector in and out of phase with its middle.
    fn harmonic_matrix(&self, k: &[f64], phase: f64) -> Vec<f64> {
        let components = self.kind.components();
        let (rows, size) = (4 * components, 8 * components);
        let (sin, cos) = phase.sin_cos();
        let mut result = vec![0.0; rows * rows];
        for part in 0..2 {
            let weight: Vec<f64> = (0..size)
                .map(|i| {
                    let side = if i < rows { -1.0 } else { 1.0 };
                    match (self.kind.is_odd(i % components), part) {
                        (false, 0) => cos,
                        (false, _) => side * sin,
                        (true, 0) => side * sin,
                        (true, _) => -cos,
                    }
                })
                .collect();
            for i in 0..size {
                for j in 0..size {
                    result[(i % rows) * rows + j % rows] += weight[i] * k[i * size + j] * weight[j];
                }
            }
        }
        result
    }

    /// On the axis the first harmonic is the translation u_r = −u_θ: fold u_θ into u_r.
    fn constrain_axis(&self, local: &mut [f64], axis: &[bool], m: usize) {
        if self.kind == FieldKind::Scalar || m != 1 {
            return;
        }
        let rows = 12;
        for a in (0..4).filter(|&a| axis[a]) {
            for i in 0..rows {
                local[i * rows + 3 * a] -= local[i * rows + 3 * a + 1];
            }
            for j in 0..rows {
                local[3 * a * rows + j] -= local[(3 * a + 1) * rows + j];
            }
        }
    }

    /// Runs faer's Cholesky on each harmonic and interleaves the factors.
    fn gather_factors(
        &self,
        mesh: &RevolvedMesh,
        values: &[Vec<f64>],
    ) -> Result<HarmonicFactors, FactorError> {
        let lanes = values.len();
        let pattern = SymbolicSparseColMatRef::new_checked(
            self.unknowns,
            self.unknowns,
            &self.column_start,
            None,
            &self.row,
        );
        let columns = self.symbolic.col_ptr();
        let rows = self.symbolic.row_idx();
        let sparse = columns[self.interior];
        let dense = self.unknowns - self.interior;
        let mut factors = HarmonicFactors {
            kind: self.kind,
            transform: ThetaTransform::new(mesh),
            unknowns: self.unknowns,
            interior: self.interior,
            position: self.position.clone(),
            on_axis: (0..mesh.node_count()).map(|n| mesh.meridian.on_axis(n)).collect(),
            column_start: Vec::with_capacity(self.interior + 1),
            row: Vec::with_capacity(sparse - self.interior),
            value: vec![0.0; (sparse - self.interior) * lanes],
            inverse_diagonal: vec![0.0; self.interior * lanes],
            schur: vec![0.0; dense * dense * lanes],
        };
        for j in 0..self.interior {
            factors.column_start.push(factors.row.len() as u32);
            debug_assert_eq!(rows[columns[j]], j);
            factors.row.extend(rows[columns[j] + 1..columns[j + 1]].iter().map(|&i| i as u32));
        }
        factors.column_start.push(factors.row.len() as u32);

        let mut memory = MemBuffer::try_new(
            simplicial::factorize_simplicial_numeric_llt_scratch::<usize, f64>(self.unknowns),
        )
        .map_err(|_| FactorError::Memory)?;
        let mut lower = vec![0.0; self.symbolic.len_val()];
        for (m, values) in values.iter().enumerate() {
            simplicial::factorize_simplicial_numeric_llt::<usize, f64>(
                &mut lower,
                SparseColMatRef::new(pattern, values),
                Default::default(),
                &self.symbolic,
                MemStack::new(&mut memory),
            )
            .map_err(|_| FactorError::NotPositiveDefinite { harmonic: m })?;
            let mut at = 0;
            for j in 0..self.interior {
                factors.inverse_diagonal[j * lanes + m] = 1.0 / lower[columns[j]];
                for &entry in &lower[columns[j] + 1..columns[j + 1]] {
                    factors.value[at * lanes + m] = entry;
                    at += 1;
                }
            }
            for j in 0..dense {
                let column = columns[self.interior + j]..columns[self.interior + j + 1];
                for (&i, &entry) in rows[column.clone()].iter().zip(&lower[column]) {
                    factors.schur[(m * dense + i - self.interior) * dense + j] = entry;
                }
            }
        }
        Ok(factors)
    }
}

/// Sorted, duplicate-free compressed columns.
fn compress(columns: &mut [Vec<usize>]) -> (Vec<usize>, Vec<usize>) {
    let mut start = vec![0];
    let mut row = Vec::new();
    for column in columns {
        column.sort_unstable();
        column.dedup();
        row.extend_from_slice(column);
        start.push(row.len());
    }
    (start, row)
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

    /// Where the contact unknowns begin in the modal vector: index (ring, component, harmonic).
    pub fn contact_offset(&self) -> usize {
        self.interior * self.harmonics()
    }

    /// Schur complement S_m of the contact unknowns for harmonic m, row-major.
    pub fn contact_stiffness(&self, m: usize) -> Vec<f64> {
        let n = self.contact_unknowns();
        let lower = &self.schur[m * n * n..(m + 1) * n * n];
        let mut stiffness = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let sum: f64 = (0..=j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
                stiffness[i * n + j] = sum;
                stiffness[j * n + i] = sum;
            }
        }
        stiffness
    }

    /// Harmonics of a nodal force.
    pub fn to_modal(&self, field: &[f64], modal: &mut [f64]) {
        let components = self.kind.components();
        let columns = self.harmonics();
        modal.fill(0.0);
        for node in 0..self.on_axis.len() {
            for c in 0..components {
                let place = self.position[node * components + c];
                if place == ABSENT {
                    continue;
                }
                let source = &field[(node * components + c) * columns..][..columns];
                let target = place as usize * columns;
                let table = self.transform.of(self.kind.is_odd(c));
                if self.on_axis[node] {
                    self.axis_to_modal(source, c, target, modal);
                } else {
                    for (m, value) in modal[target..target + columns].iter_mut().enumerate() {
                        *value = dot(&table[m * columns..(m + 1) * columns], source);
                    }
                }
            }
        }
    }

    /// Axis nodes have u_z of m = 0 and the translation of m = 1, to which u_θ adds with −1.
    fn axis_to_modal(&self, source: &[f64], component: usize, target: usize, modal: &mut [f64]) {
        let columns = self.harmonics();
        match (self.kind, component) {
            (FieldKind::Vector, 0) if columns > 1 => {
                modal[target + 1] += dot(&self.transform.even[columns..2 * columns], source);
            }
            (FieldKind::Vector, 1) if columns > 1 => {
                // The place of u_r is the one before.
                modal[target - columns + 1] -= dot(&self.transform.odd[columns..2 * columns], source);
            }
            (FieldKind::Vector, 0 | 1) => {}
            _ => modal[target] += dot(&self.transform.even[..columns], source),
        }
    }

    /// Nodal values of modal ones; fixed nodes get zero.
    pub fn to_nodal(&self, modal: &[f64], field: &mut [f64]) {
        let components = self.kind.components();
        let columns = self.harmonics();
        for node in 0..self.on_axis.len() {
            for c in 0..components {
                let place = self.position[node * components + c];
                let target = &mut field[(node * components + c) * columns..][..columns];
                target.fill(0.0);
                if place == ABSENT {
                    continue;
                }
                let source = &modal[place as usize * columns..][..columns];
                let table = self.transform.of(self.kind.is_odd(c));
                if !self.on_axis[node] {
                    for (m, &value) in source.iter().enumerate() {
                        for (t, w) in target.iter_mut().zip(&table[m * columns..(m + 1) * columns]) {
                            *t = fma(value, *w, *t);
                        }
                    }
                } else if self.kind == FieldKind::Vector && c < 2 {
                    if columns > 1 {
                        let translation = modal[(place as usize - c) * columns + 1];
                        let translation = if c == 1 { -translation } else { translation };
                        for (t, w) in target.iter_mut().zip(&table[columns..2 * columns]) {
                            *t = translation * w;
                        }
                    }
                } else {
                    for (t, w) in target.iter_mut().zip(&table[..columns]) {
                        *t = source[0] * w;
                    }
                }
            }
        }
    }

    /// Eliminates the interior: on return the contact part of `modal` is the reduced force.
    pub fn forward(&self, modal: &mut [f64]) {
        match self.harmonics() {
            1 => self.forward_lanes::<1>(modal),
            5 => self.forward_lanes::<5>(modal),
            9 => self.forward_lanes::<9>(modal),
            13 => self.forward_lanes::<13>(modal),
            17 => self.forward_lanes::<17>(modal),
            25 => self.forward_lanes::<25>(modal),
            33 => self.forward_lanes::<33>(modal),
            _ => self.forward_any(modal),
        }
    }

    /// Substitutes back, given the contact part of `modal` as displacement.
    pub fn backward(&self, modal: &mut [f64]) {
        match self.harmonics() {
            1 => self.backward_lanes::<1>(modal),
            5 => self.backward_lanes::<5>(modal),
            9 => self.backward_lanes::<9>(modal),
            13 => self.backward_lanes::<13>(modal),
            17 => self.backward_lanes::<17>(modal),
            25 => self.backward_lanes::<25>(modal),
            33 => self.backward_lanes::<33>(modal),
            _ => self.backward_any(modal),
        }
    }

    fn forward_lanes<const M: usize>(&self, modal: &mut [f64]) {
        let (x, _) = modal.as_chunks_mut::<M>();
        let (value, _) = self.value.as_chunks::<M>();
        let (diagonal, _) = self.inverse_diagonal.as_chunks::<M>();
        for j in 0..self.interior {
            let mut xj = x[j];
            for l in 0..M {
                xj[l] *= diagonal[j][l];
            }
            x[j] = xj;
            let entries = self.column_start[j] as usize..self.column_start[j + 1] as usize;
            for (v, &i) in value[entries.clone()].iter().zip(&self.row[entries]) {
                let xi = &mut x[i as usize];
                for l in 0..M {
                    xi[l] = fma(-v[l], xj[l], xi[l]);
                }
            }
        }
    }

    fn backward_lanes<const M: usize>(&self, modal: &mut [f64]) {
        let (x, _) = modal.as_chunks_mut::<M>();
        let (value, _) = self.value.as_chunks::<M>();
        let (diagonal, _) = self.inverse_diagonal.as_chunks::<M>();
        for j in (0..self.interior).rev() {
            let mut xj = x[j];
            let entries = self.column_start[j] as usize..self.column_start[j + 1] as usize;
            for (v, &i) in value[entries.clone()].iter().zip(&self.row[entries]) {
                let xi = &x[i as usize];
                for l in 0..M {
                    xj[l] = fma(-v[l], xi[l], xj[l]);
                }
            }
            for l in 0..M {
                xj[l] *= diagonal[j][l];
            }
            x[j] = xj;
        }
    }

    /// The same for numbers of sectors without a version of their own.
    fn forward_any(&self, x: &mut [f64]) {
        let lanes = self.harmonics();
        for j in 0..self.interior {
            for l in 0..lanes {
                x[j * lanes + l] *= self.inverse_diagonal[j * lanes + l];
                for e in self.column_start[j] as usize..self.column_start[j + 1] as usize {
                    x[self.row[e] as usize * lanes + l] -= self.value[e * lanes + l] * x[j * lanes + l];
                }
            }
        }
    }

    fn backward_any(&self, x: &mut [f64]) {
        let lanes = self.harmonics();
        for j in (0..self.interior).rev() {
            for l in 0..lanes {
                for e in self.column_start[j] as usize..self.column_start[j + 1] as usize {
                    x[j * lanes + l] -= self.value[e * lanes + l] * x[self.row[e] as usize * lanes + l];
                }
                x[j * lanes + l] *= self.inverse_diagonal[j * lanes + l];
            }
        }
    }

    /// Contact part of `modal` divided by the Schur complement: a solve without anything on the contact.
    #[cfg(test)]
    fn solve_free_contact(&self, modal: &mut [f64]) {
        let (n, lanes) = (self.contact_unknowns(), self.harmonics());
        let contact = &mut modal[self.interior * lanes..];
        for m in 0..lanes {
            let lower = &self.schur[m * n * n..(m + 1) * n * n];
            for i in 0..n {
                let mut sum = contact[i * lanes + m];
                for k in 0..i {
                    sum -= lower[i * n + k] * contact[k * lanes + m];
                }
                contact[i * lanes + m] = sum / lower[i * n + i];
            }
            for i in (0..n).rev() {
                let mut sum = contact[i * lanes + m];
                for k in i + 1..n {
                    sum -= lower[k * n + i] * contact[k * lanes + m];
                }
                contact[i * lanes + m] = sum / lower[i * n + i];
            }
        }
    }

    /// Whole solve without anything on the contact.
    #[cfg(test)]
    pub fn solve(&self, force: &[f64], solution: &mut [f64], modal: &mut [f64]) {
        self.to_modal(force, modal);
        self.forward(modal);
        self.solve_free_contact(modal);
        self.backward(modal);
        self.to_nodal(modal, solution);
    }
}

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (x, y)| fma(*x, *y, sum))
}
