//! The factors of all harmonics against a sparse factorisation of the whole problem.

use super::*;
use crate::discretisation::elastic::element_force;
use crate::discretisation::element::{Element, RevolvedMesh, VALUES, scatter_vector};
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::material::elasticity::Moduli;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use nalgebra::{Cholesky, DMatrix, DVector};

impl HarmonicFactors {
    /// Contact part of `modal` divided by the Schur complement: a solve without anything on the contact.
    pub(super) fn solve_free_contact(&self, modal: &mut [f64]) {
        let (n, lanes) = (self.contact_unknowns(), self.harmonics());
        let contact = &mut modal[self.contact_offset()..];
        for m in 0..lanes {
            let lower = DMatrix::from_row_slice(n, n, &self.schur_factor[m * n * n..(m + 1) * n * n]);
            let force = DVector::from_fn(n, |i, _| contact[i * lanes + m]);
            let solution = Cholesky::pack_dirty(lower).solve(&force);
            (0..n).for_each(|i| contact[i * lanes + m] = solution[i]);
        }
    }
}

/// Indices of all columns of an element's displacement in a field.
fn element_indices(mesh: &RevolvedMesh, element: &Element) -> Vec<usize> {
    let columns = mesh.sectors.columns();
    let nodes = element.nodes.iter();
    nodes.flat_map(|&n| (0..3 * columns).map(move |i| n as usize * 3 * columns + i)).collect()
}

/// Number of unknowns, and of each nodal value its unknown and factor: one Cartesian displacement on the axis, none on
/// the base.
fn unknowns(mesh: &RevolvedMesh) -> (usize, Vec<Option<(usize, f64)>>) {
    let (count, angles) = (mesh.sectors.columns(), mesh.sectors.angles());
    let mut number = std::collections::HashMap::new();
    let mut expand = vec![None; mesh.field_length(3)];
    for (i, entry) in expand.iter_mut().enumerate() {
        let (node, c, j) = (i / (3 * count), i / count % 3, i % count);
        if mesh.meridian.is_base[node] {
            continue;
        }
        let (key, factor) = match (mesh.meridian.on_axis(node), c) {
            (false, _) => (i, 1.0),
            (true, 0) => (node * 3 * count, angles[j].cos()),
            (true, 1) => (node * 3 * count, -angles[j].sin()),
            (true, _) => ((node * 3 + 2) * count, 1.0),
        };
        let next = number.len();
        *entry = Some((*number.entry(key).or_insert(next), factor));
    }
    (number.len(), expand)
}

/// The stiffness of the body in all unknowns at all angles, without any transform.
fn plain_stiffness(
    mesh: &RevolvedMesh,
    moduli: Moduli,
    n: usize,
    expand: &[Option<(usize, f64)>],
) -> SparseColMat<usize, f64> {
    let mut triplets = Vec::new();
    let [mut u, mut slope, mut force] = [0; 3].map(|_| vec![0.0; expand.len()]);
    let columns = mesh.sectors.columns();
    let mut forces = vec![0.0; mesh.field_length(VALUES)];
    for element in &mesh.elements {
        let indices = element_indices(mesh, element);
        for &j in &indices {
            u[j] = 1.0;
            // Only the values of the element's nodes are needed; the rest of the fields stays zero.
            mesh.sectors.differentiate(&VECTOR_PARITY, &u, &mut slope);
            for first in 0..columns {
                let values = mesh.gather_vector::<f64>(&u, &slope, element, first);
                let f = element_force(element, moduli, &values);
                scatter_vector(&f, &element.nodes, (first, columns), &mut forces);
            }
            let of_nodes = forces.chunks_exact(2 * 3 * columns).map(|of_node| of_node.split_at(3 * columns));
            for (force, (of_displacement, of_slope)) in force.chunks_exact_mut(3 * columns).zip(of_nodes) {
                force.copy_from_slice(of_displacement);
                mesh.sectors.add_transposed(&VECTOR_PARITY, of_slope, force);
            }
            for &i in &indices {
                if let (Some((p, a)), Some((q, b))) = (expand[i], expand[j])
                    && force[i] != 0.0
                {
                    triplets.push(Triplet::new(p, q, a * b * force[i]));
                }
            }
            u[j] = 0.0;
            forces.fill(0.0);
        }
    }
    SparseColMat::try_new_from_triplets(n, n, &triplets).unwrap()
}

/// Against faer's sparse Cholesky factorisation of the plain stiffness.
#[test]
fn harmonic_solver_agrees_with_a_plain_sparse_factorisation() {
    for count in [4, 8] {
        let meridian = MeridianMesh::new(MeshSize::new(0.1, 4));
        let mesh = RevolvedMesh::new(meridian, Collocation::full(count));
        let moduli = Moduli::new(500.0, 0.3);
        let (n, expand) = unknowns(&mesh);
        let force: Vec<f64> = (0..expand.len()).map(|i| (i as f64 * 1.37).sin()).collect();
        let mut rhs = faer::Mat::<f64>::zeros(n, 1);
        for (i, entry) in expand.iter().enumerate() {
            if let Some((p, factor)) = entry {
                rhs[(*p, 0)] += factor * force[i];
            }
        }
        let matrix = plain_stiffness(&mesh, moduli, n, &expand);
        let exact = matrix.sp_cholesky(faer::Side::Lower).unwrap().solve(&rhs);

        let factors = HarmonicFactors::elastic(&mesh, moduli, &|| false).unwrap();
        let mut solution = vec![0.0; expand.len()];
        let mut modal = vec![0.0; factors.modal_length()];
        factors.to_modal(&force, &mut modal);
        factors.forward(&mut modal);
        factors.solve_free_contact(&mut modal);
        factors.backward(&mut modal);
        factors.to_nodal(&modal, &mut solution);

        let largest = (0..n).map(|i| exact[(i, 0)].abs()).fold(0.0, f64::max);
        for (i, entry) in expand.iter().enumerate() {
            let value = entry.map_or(0.0, |(p, factor)| factor * exact[(p, 0)]);
            assert!((value - solution[i]).abs() < 1e-10 * largest, "{count} {i}: {value} {}", solution[i]);
        }
    }
}
