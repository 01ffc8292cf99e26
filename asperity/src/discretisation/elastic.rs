//! Linear isotropic elasticity on the revolved mesh: element stiffness and matrix-free product.

use crate::discretisation::element::{
    CORNERS, Element, RevolvedMesh, VALUES, deviators_and_dilatation, stress_force,
};
use crate::material::lanes::Pack;

/// Elastic moduli, in units of the problem's stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    pub bulk: f64,
    pub shear: f64,
}

impl Moduli {
    pub fn new(youngs_modulus: f64, poisson_ratio: f64) -> Self {
        Self {
            bulk: youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)),
            shear: youngs_modulus / (2.0 * (1.0 + poisson_ratio)),
        }
    }
}

/// Forces of an element from the values of its corners, elastic.
#[inline(always)]
pub fn element_force<V: Pack>(
    element: &Element,
    moduli: Moduli,
    values: &[[V; VALUES]; CORNERS],
) -> [[V; VALUES]; CORNERS] {
    let (mut stress, dilatation) = deviators_and_dilatation(element, values);
    for (stress, &weight) in stress.iter_mut().zip(&element.weight) {
        let (shear, mean) =
            (V::splat(2.0 * moduli.shear * weight), V::splat(moduli.bulk * weight) * dilatation);
        for (i, component) in stress.iter_mut().enumerate() {
            *component = if i < 3 { shear.mul_add(*component, mean) } else { shear * *component };
        }
    }
    stress_force(element, &stress)
}

/// Stiffness of element e for harmonic m, 12 × 12 over (corner, component): u_r and u_z with
/// cos mθ, u_θ with sin mθ.
pub fn element_stiffness(mesh: &RevolvedMesh, e: usize, moduli: Moduli, m: usize) -> Vec<f64> {
    // ∂/∂θ takes cos mθ to −m sin mθ and sin mθ to m cos mθ.
    let slope = [-(m as f64), m as f64, -(m as f64)];
    let mut matrix = vec![0.0; 12 * 12];
    for j in 0..12 {
        let mut unit = [[0.0; VALUES]; CORNERS];
        unit[j / 3][j % 3] = 1.0;
        unit[j / 3][j % 3 + 3] = slope[j % 3];
        let force = element_force::<f64>(&mesh.elements[e], moduli, &unit);
        for i in 0..12 {
            let f = &force[i / 3];
            matrix[i * 12 + j] = f[i % 3] + slope[i % 3] * f[i % 3 + 3];
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::collocation::{Collocation, VECTOR_PARITY};
    use crate::discretisation::mesh::{MeridianMesh, MeshSize};
    use crate::solver::harmonic::{FieldKind, HarmonicPattern};
    use faer::linalg::solvers::Solve;
    use faer::sparse::{SparseColMat, Triplet};

    /// Values of all columns of an element's displacement, and the place of each in a field.
    fn element_places(mesh: &RevolvedMesh, element: &Element) -> Vec<usize> {
        let columns = mesh.sectors.columns();
        let nodes = element.nodes.iter();
        nodes.flat_map(|&n| (0..3 * columns).map(move |i| n as usize * 3 * columns + i)).collect()
    }

    /// The same stiffness assembled in all unknowns at all angles, those of the axis being one
    /// Cartesian displacement, without any transform; solved by faer's sparse Cholesky.
    #[test]
    fn harmonic_solver_agrees_with_a_plain_sparse_factorisation() {
        for count in [4, 8] {
            let meridian = MeridianMesh::new(MeshSize::new(0.1, 4));
            let mesh = RevolvedMesh::new(meridian, Collocation::full(count));
            let moduli = Moduli::new(500.0, 0.3);
            let angles = mesh.sectors.angles();
            let length = mesh.field_length(3);

            // Each nodal value as unknown and factor; none where the body is held.
            let on_axis = |node: usize| mesh.meridian.on_axis(node);
            let mut number = std::collections::HashMap::new();
            let mut expand: Vec<Option<(usize, f64)>> = vec![None; length];
            for (i, entry) in expand.iter_mut().enumerate() {
                let (node, c, j) = (i / (3 * count), i / count % 3, i % count);
                if mesh.meridian.is_base[node] {
                    continue;
                }
                let (key, factor) = match (on_axis(node), c) {
                    (false, _) => (i, 1.0),
                    (true, 0) => (node * 3 * count, angles[j].cos()),
                    (true, 1) => (node * 3 * count, -angles[j].sin()),
                    (true, _) => ((node * 3 + 2) * count, 1.0),
                };
                let next = number.len();
                *entry = Some((*number.entry(key).or_insert(next), factor));
            }
            let n = number.len();

            let mut triplets = Vec::new();
            let (mut u, mut slope) = (vec![0.0; length], vec![0.0; length]);
            let (mut force, mut on_slope) = (vec![0.0; length], vec![0.0; length]);
            for element in &mesh.elements {
                let places = element_places(&mesh, element);
                for &j in &places {
                    u[j] = 1.0;
                    // Only the node's own values are wanted; the rest of the fields stays zero.
                    mesh.sectors.differentiate(&VECTOR_PARITY, &u, &mut slope);
                    for first in 0..count {
                        let values = mesh.gather_vector::<f64>(&u, &slope, element, first);
                        let f = element_force(element, moduli, &values);
                        mesh.scatter_vector(&f, element, first, &mut force, &mut on_slope);
                    }
                    mesh.sectors.add_transposed(&VECTOR_PARITY, &on_slope, &mut force);
                    for &i in &places {
                        if let (Some((p, a)), Some((q, b))) = (expand[i], expand[j])
                            && force[i] != 0.0
                        {
                            triplets.push(Triplet::new(p, q, a * b * force[i]));
                        }
                    }
                    u[j] = 0.0;
                    force.fill(0.0);
                    on_slope.fill(0.0);
                }
            }
            let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets).unwrap();

            // Any force, and the sum of what acts on each unknown.
            let force: Vec<f64> = (0..length).map(|i| (i as f64 * 1.37).sin()).collect();
            let mut rhs = faer::Mat::<f64>::zeros(n, 1);
            for (i, entry) in expand.iter().enumerate() {
                if let Some((p, factor)) = entry {
                    rhs[(*p, 0)] += factor * force[i];
                }
            }
            let exact = matrix.sp_cholesky(faer::Side::Lower).unwrap().solve(&rhs);

            let pattern = HarmonicPattern::new(&mesh, FieldKind::Vector).unwrap();
            let factors = pattern.factorise(&mesh, |e, m| element_stiffness(&mesh, e, moduli, m)).unwrap();
            let mut solution = vec![0.0; length];
            let mut modal = vec![0.0; factors.modal_length()];
            factors.solve(&force, &mut solution, &mut modal);

            let largest = (0..n).map(|i| exact[(i, 0)].abs()).fold(0.0, f64::max);
            for (i, entry) in expand.iter().enumerate() {
                let value = entry.map_or(0.0, |(p, factor)| factor * exact[(p, 0)]);
                assert!(
                    (value - solution[i]).abs() < 1e-10 * largest,
                    "{count} {i}: {value} {}",
                    solution[i]
                );
            }
        }
    }
}
