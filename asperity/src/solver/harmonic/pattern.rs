//! Sparsity pattern and elimination order of an axisymmetric operator, and its factorisation.

use std::ops::Range;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::{amd, cholesky::simplicial};

use super::cholesky::FactorPattern;
use super::sweeps::BlockTriangle;
use super::{ABSENT, FactorError, FieldKind, HarmonicFactors, ThetaTransform};
use crate::discretisation::elastic::element_stiffness;
use crate::discretisation::element::{CORNERS, RevolvedMesh};
use crate::material::elasticity::Moduli;
use crate::solver::StopRequest;

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
    factor_pattern: FactorPattern,
}

impl HarmonicFactors {
    /// Factors of the stiffness of an elastic body.
    pub fn elastic(mesh: &RevolvedMesh, moduli: Moduli, stop: &StopRequest) -> Result<Self, FactorError> {
        let pattern = HarmonicPattern::new(mesh, FieldKind::Vector)?;
        let entries = pattern.assemble(mesh, |e, m| element_stiffness(mesh, e, moduli, m));
        pattern.factorise(mesh, &entries, stop)
    }
}

impl HarmonicPattern {
    pub fn new(mesh: &RevolvedMesh, kind: FieldKind) -> Result<Self, FactorError> {
        let components = kind.components();
        let order = elimination_order(mesh)?;
        let mut position = vec![ABSENT; mesh.node_count() * components];
        for (rank, &node) in order.iter().enumerate() {
            for c in 0..components {
                position[node * components + c] = (rank * components + c) as u32;
            }
        }
        let unknowns = order.len() * components;
        let interior = unknowns - mesh.meridian.contact.len() * components;
        let (column_start, row) = upper_triangle(mesh, components, &position, interior..unknowns);
        let symbolic = factorise_symbolically(unknowns, &column_start, &row)?;
        let factor_pattern = FactorPattern::new(symbolic.col_ptr(), symbolic.row_idx(), &column_start, &row);
        Ok(Self { kind, unknowns, interior, position, column_start, row, symbolic, factor_pattern })
    }

    /// Entries of an operator in the upper triangle, harmonics as lanes; `matrix(e, m)` is the matrix of element e for
    /// harmonic m, row-major over (corner, component), in which they are linear.
    pub fn assemble(&self, mesh: &RevolvedMesh, matrix: impl Fn(usize, usize) -> Vec<f64>) -> Vec<f64> {
        let columns = mesh.sectors.columns();
        let components = self.kind.components();
        let rows = CORNERS * components;
        let mut values = vec![0.0; self.row.len() * columns];
        let entry = |i: usize, j: usize| {
            let column = self.column_start[j]..self.column_start[j + 1];
            column.start + self.row[column].binary_search(&i).expect("entry is in the pattern")
        };
        for (e, element) in mesh.elements.iter().enumerate() {
            let positions: Vec<u32> = (0..rows)
                .map(|i| self.position[element.nodes[i / components] as usize * components + i % components])
                .collect();
            let axis: Vec<bool> = element.nodes.iter().map(|&n| mesh.meridian.on_axis(n as usize)).collect();
            // Where each entry goes is the same for all harmonics.
            let mut targets = Vec::with_capacity(rows * rows);
            for (i, &p) in positions.iter().enumerate() {
                for (j, &q) in positions.iter().enumerate() {
                    if p != ABSENT && q != ABSENT && p <= q {
                        targets.push((i * rows + j, entry(p as usize, q as usize)));
                    }
                }
            }
            for m in 0..columns {
                let mut local = matrix(e, m);
                self.constrain_axis(&mut local, &axis, m);
                for &(from, to) in &targets {
                    values[to * columns + m] += local[from];
                }
            }
        }
        // Unknowns that do not exist on the axis in a harmonic have a unit diagonal and no coupling.
        for m in 0..columns {
            let mut absent = vec![false; self.unknowns];
            for node in (0..mesh.node_count()).filter(|&n| mesh.meridian.on_axis(n)) {
                for c in (0..components).filter(|&c| !self.exists_on_axis(c, m)) {
                    let position = self.position[node * components + c];
                    if position != ABSENT {
                        absent[position as usize] = true;
                    }
                }
            }
            for j in 0..self.unknowns {
                for at in self.column_start[j]..self.column_start[j + 1] {
                    let i = self.row[at];
                    if absent[i] || absent[j] {
                        values[at * columns + m] = f64::from(u8::from(i == j));
                    }
                }
            }
        }
        values
    }

    /// Whether the axis has component c in harmonic m: u_z (and T) of m = 0, and the translation
    /// u_r = −u_θ of m = 1, which is stored as u_r. Off the axis all components exist.
    fn exists_on_axis(&self, component: usize, m: usize) -> bool {
        match (self.kind, component) {
            (FieldKind::Vector, 0) => m == 1,
            (FieldKind::Vector, 1) => false,
            _ => m == 0,
        }
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

    /// Factors of an operator from its [entries](Self::assemble).
    pub fn factorise(
        &self,
        mesh: &RevolvedMesh,
        values: &[f64],
        stop: &StopRequest,
    ) -> Result<HarmonicFactors, FactorError> {
        let lanes = mesh.sectors.columns();
        let (columns, rows) = (self.symbolic.col_ptr(), self.symbolic.row_idx());
        let sparse = columns[self.interior] - self.interior;
        let dense = self.unknowns - self.interior;
        let mut factors = HarmonicFactors {
            kind: self.kind,
            transform: ThetaTransform::new(&mesh.sectors),
            unknowns: self.unknowns,
            interior: self.interior,
            position: self.position.clone(),
            on_axis: (0..mesh.node_count()).map(|n| mesh.meridian.on_axis(n)).collect(),
            triangle: BlockTriangle {
                lanes,
                start: vec![0],
                row: Vec::with_capacity(sparse),
                block: vec![0.0; sparse * lanes],
                diagonal: vec![0.0; self.interior * lanes],
            },
            schur_factor: vec![0.0; dense * dense * lanes],
        };
        let triangle = &mut factors.triangle;
        for j in 0..self.interior {
            debug_assert_eq!(rows[columns[j]], j);
            triangle.row.extend(rows[columns[j] + 1..columns[j + 1]].iter().map(|&i| i as u32));
            triangle.start.push(triangle.row.len() as u32);
        }
        // N_θ is one or a multiple of four.
        for first in (0..lanes).step_by(group_of(lanes)) {
            match group_of(lanes) {
                8 => self.factorise_lanes::<8>(values, first, &mut factors, stop)?,
                4 => self.factorise_lanes::<4>(values, first, &mut factors, stop)?,
                _ => self.factorise_lanes::<1>(values, first, &mut factors, stop)?,
            }
        }
        Ok(factors)
    }

    /// M harmonics from the harmonic `first` on.
    fn factorise_lanes<const M: usize>(
        &self,
        values: &[f64],
        first: usize,
        factors: &mut HarmonicFactors,
        stop: &StopRequest,
    ) -> Result<(), FactorError> {
        let lanes = factors.harmonics();
        let value = |entry: usize| std::array::from_fn(|l| values[entry * lanes + first + l]);
        let lower = self.factor_pattern.cholesky::<M>(value, first, stop)?;
        let columns = self.symbolic.col_ptr();
        for j in 0..self.interior {
            let own = &lower[columns[j]];
            for l in 0..M {
                factors.triangle.diagonal[j * lanes + first + l] = 1.0 / own[l];
            }
            // Diagonals are stored separately: j + 1 of them come before.
            for at in columns[j] + 1..columns[j + 1] {
                let start = (at - j - 1) * lanes + first;
                factors.triangle.block[start..start + M].copy_from_slice(&lower[at]);
            }
        }
        let (rows, dense) = (self.symbolic.row_idx(), self.unknowns - self.interior);
        for j in self.interior..self.unknowns {
            for at in columns[j]..columns[j + 1] {
                for l in 0..M {
                    let row = (first + l) * dense + rows[at] - self.interior;
                    factors.schur_factor[row * dense + j - self.interior] = lower[at][l];
                }
            }
        }
        Ok(())
    }
}

/// Harmonics that are factorised together.
fn group_of(lanes: usize) -> usize {
    match lanes {
        n if n.is_multiple_of(8) => 8,
        n if n.is_multiple_of(4) => 4,
        _ => 1,
    }
}

/// Nodes that are not fixed: the interior ones in minimum-degree order, then the contact rings.
fn elimination_order(mesh: &RevolvedMesh) -> Result<Vec<usize>, FactorError> {
    let (meridian, nodes) = (&mesh.meridian, mesh.node_count());
    let mut is_contact = vec![false; nodes];
    for &node in &meridian.contact {
        is_contact[node as usize] = true;
    }
    let interior: Vec<usize> = (0..nodes).filter(|&n| !is_contact[n] && !meridian.is_base[n]).collect();
    let mut local = vec![ABSENT; nodes];
    for (i, &node) in interior.iter().enumerate() {
        local[node] = i as u32;
    }
    let n = interior.len();
    let (column_start, row) = upper_triangle(mesh, 1, &local, n..n);
    let graph = SymbolicSparseColMatRef::new_checked(n, n, &column_start, None, &row);
    let (mut order, mut rank) = (vec![0usize; n], vec![0usize; n]);
    let mut memory =
        MemBuffer::try_new(amd::order_scratch::<usize>(n, row.len())).map_err(|_| FactorError::Memory)?;
    amd::order(&mut order, &mut rank, graph, amd::Control::default(), MemStack::new(&mut memory))
        .map_err(|_| FactorError::Memory)?;
    let contact = meridian.contact.iter().map(|&n| n as usize);
    Ok(order.into_iter().map(|i| interior[i]).chain(contact).collect())
}

/// Compressed columns of the upper triangle over the positions `position` of nodes and components; those of the contact
/// are dense.
fn upper_triangle(
    mesh: &RevolvedMesh,
    components: usize,
    position: &[u32],
    contact: Range<usize>,
) -> (Vec<usize>, Vec<usize>) {
    let mut columns: Vec<Vec<usize>> = vec![Vec::new(); contact.end];
    for quad in &mesh.meridian.quads {
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
    // The contact block is dense in the factor; a dense pattern lets it be read row by row.
    for j in contact.clone() {
        columns[j].extend(contact.start..=j);
    }
    let mut start = vec![0];
    let mut row = Vec::new();
    for mut column in columns {
        column.sort_unstable();
        column.dedup();
        row.extend(column);
        start.push(row.len());
    }
    (start, row)
}

/// Pattern of the Cholesky factor.
fn factorise_symbolically(
    unknowns: usize,
    column_start: &[usize],
    row: &[usize],
) -> Result<simplicial::SymbolicSimplicialCholesky<usize>, FactorError> {
    let pattern = SymbolicSparseColMatRef::new_checked(unknowns, unknowns, column_start, None, row);
    let mut memory = MemBuffer::try_new(StackReq::any_of(&[
        simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(unknowns, row.len()),
        simplicial::factorize_simplicial_symbolic_cholesky_scratch::<usize>(unknowns),
    ]))
    .map_err(|_| FactorError::Memory)?;
    let (mut tree, mut counts) = (vec![0isize; unknowns], vec![0usize; unknowns]);
    simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, MemStack::new(&mut memory));
    simplicial::factorize_simplicial_symbolic_cholesky(
        pattern,
        // SAFETY: the tree was just filled for this pattern.
        unsafe { simplicial::EliminationTreeRef::from_inner(&tree) },
        &counts,
        MemStack::new(&mut memory),
    )
    .map_err(|_| FactorError::Memory)
}
