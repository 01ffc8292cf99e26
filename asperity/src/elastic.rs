//! Linear isotropic elasticity on the revolved mesh: element stiffness and matrix-free product.

use crate::element::{Element, RevolvedMesh, deviators_and_dilatation, stress_force};
use crate::lanes::{Lanes, fma};

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

/// Nodal forces of an element from its nodal displacements, elastic.
#[inline(always)]
pub fn element_force<const W: usize>(
    element: &Element,
    moduli: Moduli,
    displacement: &[[Lanes<W>; 3]; 8],
) -> [[Lanes<W>; 3]; 8] {
    let (mut stress, dilatation) = deviators_and_dilatation(element, displacement);
    for (stress, &weight) in stress.iter_mut().zip(&element.weight) {
        let (shear, bulk) = (2.0 * moduli.shear * weight, moduli.bulk * weight);
        for (i, component) in stress.iter_mut().enumerate() {
            for l in 0..W {
                let volumetric = if i < 3 { bulk * dilatation[l] } else { 0.0 };
                component[l] = fma(shear, component[l], volumetric);
            }
        }
    }
    stress_force(element, &stress)
}

/// Stiffness of a sector of element e in its own frame, 24 × 24.
pub fn element_stiffness(mesh: &RevolvedMesh, e: usize, moduli: Moduli) -> Vec<f64> {
    let mut matrix = vec![0.0; 24 * 24];
    for j in 0..24 {
        let mut unit = [[[0.0; 1]; 3]; 8];
        unit[j / 3][j % 3] = [1.0];
        let force = element_force::<1>(&mesh.elements[e], moduli, &unit);
        for i in 0..24 {
            matrix[i * 24 + j] = force[i / 3][i % 3][0];
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harmonic::{FieldKind, HarmonicPattern};
    use crate::mesh::{MeridianMesh, MeshSize};
    use crate::sectors::Sectors;
    use faer::linalg::solvers::Solve;
    use faer::sparse::{SparseColMat, Triplet};

    /// The same stiffness assembled in 3-D Cartesian unknowns, each physical node once, with
    /// u_y = 0 on the symmetry plane; solved by faer's sparse Cholesky.
    #[test]
    fn harmonic_solver_agrees_with_a_plain_sparse_factorisation() {
        for count in [4, 8] {
            let meridian = MeridianMesh::new(MeshSize { contact_radius: 0.1, elements_per_radius: 4 });
            let mesh = RevolvedMesh::new(meridian, Sectors::full(count));
            let moduli = Moduli::new(500.0, 0.3);
            let sectors = mesh.sectors;
            let columns = sectors.columns();

            let mut number = std::collections::HashMap::new();
            let mut unknown = |node: usize, j: usize, d: usize| -> Option<usize> {
                if mesh.meridian.is_base[node] {
                    return None;
                }
                let on_axis = mesh.meridian.on_axis(node);
                if d == 1 && (on_axis || j == 0 || j == count) {
                    return None;
                }
                let next = number.len();
                Some(*number.entry((node, if on_axis { 0 } else { j }, d)).or_insert(next))
            };
            let mut triplets = Vec::new();
            for (e, element) in mesh.elements.iter().enumerate() {
                let k = element_stiffness(&mesh, e, moduli);
                for sector in 0..count {
                    let (sin, cos) = ((sector as f64 + 0.5) * sectors.angle()).sin_cos();
                    // Rows of the rotation from global Cartesian to the sector's frame.
                    let rotation = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]];
                    for a in 0..24 {
                        for b in 0..24 {
                            let ua = unknown(element.nodes[a / 3 % 4] as usize, sector + a / 12, a % 3);
                            let ub = unknown(element.nodes[b / 3 % 4] as usize, sector + b / 12, b % 3);
                            if let (Some(i), Some(j)) = (ua, ub) {
                                let mut value = 0.0;
                                for c in 0..3 {
                                    for d in 0..3 {
                                        value += rotation[c][a % 3]
                                            * k[(a / 3 * 3 + c) * 24 + b / 3 * 3 + d]
                                            * rotation[d][b % 3];
                                    }
                                }
                                triplets.push(Triplet::new(i, j, value));
                            }
                        }
                    }
                }
            }
            let n = number.len();
            let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets).unwrap();

            // Any force: Cartesian per unknown, and the same in nodal cylindrical components.
            let force: Vec<f64> = (0..n).map(|i| (i as f64 * 1.37).sin()).collect();
            let mut cylindrical = vec![0.0; mesh.field_length(3)];
            for (&(node, j, d), &i) in &number {
                // A force on an axis node is given to column 0, where x is the radial direction.
                let (sin, cos) = (j as f64 * sectors.angle()).sin_cos();
                let [fr, ft, fz] = match d {
                    0 => [force[i] * cos, -force[i] * sin, 0.0],
                    1 => [force[i] * sin, force[i] * cos, 0.0],
                    _ => [0.0, 0.0, force[i]],
                };
                cylindrical[node * 3 * columns + j] += fr;
                cylindrical[(node * 3 + 1) * columns + j] += ft;
                cylindrical[(node * 3 + 2) * columns + j] += fz;
            }
            let rhs = faer::Mat::from_fn(n, 1, |i, _| force[i]);
            let exact = matrix.sp_cholesky(faer::Side::Lower).unwrap().solve(&rhs);

            let pattern = HarmonicPattern::new(&mesh, FieldKind::Vector).unwrap();
            let factors = pattern.factorise(&mesh, |e| element_stiffness(&mesh, e, moduli)).unwrap();
            let mut solution = vec![0.0; mesh.field_length(3)];
            let mut modal = vec![0.0; factors.modal_length()];
            factors.solve(&cylindrical, &mut solution, &mut modal);

            let largest = (0..n).map(|i| exact[(i, 0)].abs()).fold(0.0, f64::max);
            for (&(node, j, d), &i) in &number {
                let (sin, cos) = (j as f64 * sectors.angle()).sin_cos();
                let at = |c: usize| solution[(node * 3 + c) * columns + j];
                let value = match d {
                    0 => at(0) * cos - at(1) * sin,
                    1 => at(0) * sin + at(1) * cos,
                    _ => at(2),
                };
                assert!((value - exact[(i, 0)]).abs() < 1e-10 * largest, "{count} {node} {j} {d}: {value}");
            }
        }
    }
}
