//! Eight-node brick of a sector: geometry, gather and scatter between nodes and lanes, and the
//! mean-dilatation (B̄) strain and force operators.
//!
//! A sector of a meridian quadrilateral is a brick (a wedge at the axis). All sectors are alike
//! in the Cartesian frame of their own mid-plane: x radial, y circumferential, z axial. So the
//! geometry is stored once per quadrilateral and sectors are lanes. Local nodes 0–3 are the
//! quadrilateral's corners on the side of the smaller angle, 4–7 on the larger.
//!
//! Symmetric tensors are stored as (xx, yy, zz, xy, yz, zx), shear components unscaled.

use crate::lanes::{Lanes, add_scaled, fma};
use crate::mesh::MeridianMesh;
use crate::sectors::Sectors;

/// Gauss points of an element.
pub const POINTS: usize = 8;
/// Nodes of an element.
pub const NODES: usize = 8;

/// 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;
const CORNER_XI: [f64; 4] = [-1.0, 1.0, 1.0, -1.0];
const CORNER_ETA: [f64; 4] = [-1.0, -1.0, 1.0, 1.0];

/// Gauss points come in pairs q, q + 4, mirror images in the sector's mid-plane.
const PAIRS: usize = POINTS / 2;

/// Derivatives of the shape functions of a corner's two nodes (L, R) at a mirror pair of points.
///
/// With S = u_L + u_R and D = u_R − u_L the gradient at the points is E ∓ O: E takes `even_x`,
/// `even_z` from S and `even_y` from D, O takes `odd_x`, `odd_z` from D and `odd_y` from S. So each
/// product serves both points.
#[derive(Clone, Copy, Debug, Default)]
struct Mirror {
    even_x: f64,
    even_y: f64,
    even_z: f64,
    odd_x: f64,
    odd_y: f64,
    odd_z: f64,
}

/// Geometry of one brick.
#[derive(Clone, Debug)]
pub struct Element {
    /// Corners of the quadrilateral in the meridian.
    pub nodes: [u32; 4],
    /// Shape function derivatives of each mirror pair of Gauss points and corner; see [`Mirror`].
    mirror: [[Mirror; 4]; PAIRS],
    /// Volume that belongs to each Gauss point.
    pub weight: [f64; POINTS],
    pub volume: f64,
}

/// Trilinear shape functions at a point of the reference cube.
fn shape(xi: f64, eta: f64, zeta: f64) -> [f64; NODES] {
    std::array::from_fn(|n| {
        let side = if n < 4 { -1.0 } else { 1.0 };
        0.125 * (1.0 + CORNER_XI[n % 4] * xi) * (1.0 + CORNER_ETA[n % 4] * eta) * (1.0 + side * zeta)
    })
}

/// Position of Gauss point q in the reference cube.
fn gauss_point(q: usize) -> [f64; 3] {
    let sign = |bit: usize| if q >> bit & 1 == 0 { -GAUSS } else { GAUSS };
    [sign(0), sign(1), sign(2)]
}

/// Shape functions at the Gauss points; the same for all elements.
pub fn shape_at_points() -> [[f64; NODES]; POINTS] {
    std::array::from_fn(|q| {
        let [xi, eta, zeta] = gauss_point(q);
        shape(xi, eta, zeta)
    })
}

/// ∂N_n/∂(ξ, η, ζ) at the Gauss points; the same for all elements.
pub fn local_gradients_at_points() -> [[[f64; 3]; NODES]; POINTS] {
    std::array::from_fn(|q| {
        let [xi, eta, zeta] = gauss_point(q);
        std::array::from_fn(|n| {
            let (cx, ce) = (CORNER_XI[n % 4], CORNER_ETA[n % 4]);
            let cz = if n < 4 { -1.0 } else { 1.0 };
            [
                0.125 * cx * (1.0 + ce * eta) * (1.0 + cz * zeta),
                0.125 * ce * (1.0 + cx * xi) * (1.0 + cz * zeta),
                0.125 * cz * (1.0 + cx * xi) * (1.0 + ce * eta),
            ]
        })
    })
}

impl Element {
    fn new(corners: [[f64; 2]; 4], nodes: [u32; 4], sectors: Sectors) -> Self {
        let half = 0.5 * sectors.angle();
        let position: [[f64; 3]; NODES] = std::array::from_fn(|n| {
            let [r, z] = corners[n % 4];
            let r = r * sectors.radius_scale();
            let angle = if n < 4 { -half } else { half };
            [r * angle.cos(), r * angle.sin(), z]
        });
        let mut gradient = [[[0.0; 3]; NODES]; POINTS];
        let mut weight = [0.0; POINTS];
        let local_gradients = local_gradients_at_points();
        for q in 0..POINTS {
            let local = &local_gradients[q];
            let mut jacobian = nalgebra::Matrix3::<f64>::zeros();
            for n in 0..NODES {
                for d in 0..3 {
                    for k in 0..3 {
                        jacobian[(d, k)] += local[n][k] * position[n][d];
                    }
                }
            }
            // Reference axes (ξ, η, ζ) = (r, z, θ) are left-handed in (x, y, z).
            weight[q] = -jacobian.determinant();
            assert!(weight[q] > 0.0, "inverted element at r, z = {:?}", corners[0]);
            let inverse = jacobian.try_inverse().expect("positive volume");
            for n in 0..NODES {
                for d in 0..3 {
                    gradient[q][n][d] = (0..3).map(|k| local[n][k] * inverse[(k, d)]).sum();
                }
            }
        }
        let volume = weight.iter().sum();
        let mirror = std::array::from_fn(|pair| {
            std::array::from_fn(|corner| {
                // At the point of smaller angle; the other has them swapped and y negated.
                let [left, right] = [gradient[pair][corner], gradient[pair][corner + 4]];
                Mirror {
                    even_x: 0.5 * (left[0] + right[0]),
                    odd_x: 0.5 * (left[0] - right[0]),
                    even_y: 0.5 * (right[1] - left[1]),
                    odd_y: -0.5 * (left[1] + right[1]),
                    even_z: 0.5 * (left[2] + right[2]),
                    odd_z: 0.5 * (left[2] - right[2]),
                }
            })
        });
        Self { nodes, mirror, weight, volume }
    }
}

/// The revolved mesh: elements of one sector and the way sectors join.
#[derive(Clone, Debug)]
pub struct RevolvedMesh {
    pub meridian: MeridianMesh,
    pub sectors: Sectors,
    pub elements: Vec<Element>,
    /// cos and sin of half a sector.
    half: (f64, f64),
}

impl RevolvedMesh {
    pub fn new(meridian: MeridianMesh, sectors: Sectors) -> Self {
        let elements = meridian
            .quads
            .iter()
            .map(|quad| Element::new(quad.map(|n| meridian.nodes[n as usize]), *quad, sectors))
            .collect();
        let half = 0.5 * sectors.angle();
        Self { meridian, sectors, elements, half: (half.cos(), half.sin()) }
    }

    pub fn node_count(&self) -> usize {
        self.meridian.nodes.len()
    }

    /// Length of a field with the given number of components.
    pub fn field_length(&self, components: usize) -> usize {
        self.node_count() * components * self.sectors.columns()
    }

    /// Volume ∫N dV of each node and column (half body), the lumped mass.
    pub fn nodal_volumes(&self) -> Vec<f64> {
        let columns = self.sectors.columns();
        let mut volumes = vec![0.0; self.field_length(1)];
        let shapes = shape_at_points();
        for element in &self.elements {
            for n in 0..4 {
                // Both sides of a sector carry the same share.
                let share: f64 = (0..POINTS).map(|q| element.weight[q] * shapes[q][n]).sum();
                let node = element.nodes[n] as usize;
                for j in 0..columns {
                    let sides = 2.0 * self.sectors.count as f64 * self.sectors.column_weight(j);
                    volumes[node * columns + j] += share * sides;
                }
            }
        }
        volumes
    }

    /// Areas ∫N dA (half body) of the contact rings, per ring and column, projected on the flat.
    pub fn contact_areas(&self) -> Vec<f64> {
        let radii = self.meridian.contact_radii();
        let mut ring = vec![0.0; radii.len()];
        for i in 1..radii.len() {
            // ∫ N r dr over [r0, r1] for the two linear functions; half circle of angle π.
            let (r0, r1) = (radii[i - 1], radii[i]);
            let h = r1 - r0;
            ring[i - 1] += std::f64::consts::PI * h * (2.0 * r0 + r1) / 6.0;
            ring[i] += std::f64::consts::PI * h * (r0 + 2.0 * r1) / 6.0;
        }
        let columns = self.sectors.columns();
        (0..ring.len() * columns)
            .map(|i| ring[i / columns] * self.sectors.column_weight(i % columns))
            .collect()
    }

    /// Vector values of an element's nodes in the frames of W sectors from `first` on.
    #[inline(always)]
    pub fn gather_vector<const W: usize>(
        &self,
        field: &[f64],
        element: &Element,
        first: usize,
    ) -> [[Lanes<W>; 3]; NODES] {
        let columns = self.sectors.columns();
        let (cos, sin) = self.half;
        let mut values = [[[0.0; W]; 3]; NODES];
        for a in 0..4 {
            let base = element.nodes[a] as usize * 3 * columns;
            let (radial, rest) = field[base..base + 3 * columns].split_at(columns);
            let (hoop, axial) = rest.split_at(columns);
            for side in 0..2 {
                let start = if self.sectors.axisymmetric { 0 } else { first + side };
                let (radial, hoop, axial) =
                    (&radial[start..start + W], &hoop[start..start + W], &axial[start..start + W]);
                let sin = if side == 0 { -sin } else { sin };
                let target = &mut values[a + 4 * side];
                for l in 0..W {
                    target[0][l] = fma(radial[l], cos, -(hoop[l] * sin));
                    target[1][l] = fma(radial[l], sin, hoop[l] * cos);
                    target[2][l] = axial[l];
                }
            }
        }
        values
    }

    /// Adds nodal forces given in the sectors' frames to a field.
    #[inline(always)]
    pub fn scatter_vector<const W: usize>(
        &self,
        values: &[[Lanes<W>; 3]; NODES],
        element: &Element,
        first: usize,
        field: &mut [f64],
    ) {
        let columns = self.sectors.columns();
        let multiplicity = self.sectors.multiplicity();
        let (cos, sin) = self.half;
        for a in 0..4 {
            let base = element.nodes[a] as usize * 3 * columns;
            let (radial, rest) = field[base..base + 3 * columns].split_at_mut(columns);
            let (hoop, axial) = rest.split_at_mut(columns);
            for side in 0..2 {
                let start = if self.sectors.axisymmetric { 0 } else { first + side };
                let radial = &mut radial[start..start + W];
                let hoop = &mut hoop[start..start + W];
                let axial = &mut axial[start..start + W];
                let sin = if side == 0 { -sin } else { sin };
                let source = &values[a + 4 * side];
                for l in 0..W {
                    radial[l] += multiplicity * fma(source[0][l], cos, source[1][l] * sin);
                    hoop[l] += multiplicity * fma(source[1][l], cos, -(source[0][l] * sin));
                    axial[l] += multiplicity * source[2][l];
                }
            }
        }
    }

    /// Scalar values of an element's nodes for W sectors from `first` on.
    #[inline(always)]
    pub fn gather_scalar<const W: usize>(
        &self,
        field: &[f64],
        element: &Element,
        first: usize,
    ) -> [Lanes<W>; NODES] {
        let columns = self.sectors.columns();
        let mut values = [[0.0; W]; NODES];
        for a in 0..4 {
            let base = element.nodes[a] as usize * columns;
            for side in 0..2 {
                let start = if self.sectors.axisymmetric { 0 } else { first + side };
                values[a + 4 * side].copy_from_slice(&field[base + start..base + start + W]);
            }
        }
        values
    }

    /// Adds nodal values of W sectors to a scalar field.
    #[inline(always)]
    pub fn scatter_scalar<const W: usize>(
        &self,
        values: &[Lanes<W>; NODES],
        element: &Element,
        first: usize,
        field: &mut [f64],
    ) {
        let columns = self.sectors.columns();
        let multiplicity = self.sectors.multiplicity();
        for a in 0..4 {
            let base = element.nodes[a] as usize * columns;
            for side in 0..2 {
                let start = if self.sectors.axisymmetric { 0 } else { first + side };
                for l in 0..W {
                    field[base + start + l] += multiplicity * values[a + 4 * side][l];
                }
            }
        }
    }
}

/// Strains at a mirror pair of points as (E, O): E − O at the first, E + O at the second.
#[inline(always)]
fn mirror_strain<const W: usize>(
    corners: &[Mirror; 4],
    sum: &[[Lanes<W>; 3]; 4],
    difference: &[[Lanes<W>; 3]; 4],
) -> ([Lanes<W>; 6], [Lanes<W>; 6]) {
    let mut even = [[0.0; W]; 6];
    let mut odd = [[0.0; W]; 6];
    for ((m, s), d) in corners.iter().zip(sum).zip(difference) {
        let half_even = [0.5 * m.even_x, 0.5 * m.even_y, 0.5 * m.even_z];
        let half_odd = [0.5 * m.odd_x, 0.5 * m.odd_y, 0.5 * m.odd_z];
        add_scaled(&mut even[0], m.even_x, &s[0]);
        add_scaled(&mut even[1], m.even_y, &d[1]);
        add_scaled(&mut even[2], m.even_z, &s[2]);
        add_scaled(&mut even[3], half_even[1], &d[0]);
        add_scaled(&mut even[3], half_even[0], &s[1]);
        add_scaled(&mut even[4], half_even[2], &s[1]);
        add_scaled(&mut even[4], half_even[1], &d[2]);
        add_scaled(&mut even[5], half_even[0], &s[2]);
        add_scaled(&mut even[5], half_even[2], &s[0]);
        add_scaled(&mut odd[0], m.odd_x, &d[0]);
        add_scaled(&mut odd[1], m.odd_y, &s[1]);
        add_scaled(&mut odd[2], m.odd_z, &d[2]);
        add_scaled(&mut odd[3], half_odd[1], &s[0]);
        add_scaled(&mut odd[3], half_odd[0], &d[1]);
        add_scaled(&mut odd[4], half_odd[2], &d[1]);
        add_scaled(&mut odd[4], half_odd[1], &s[2]);
        add_scaled(&mut odd[5], half_odd[0], &d[2]);
        add_scaled(&mut odd[5], half_odd[2], &d[0]);
    }
    (even, odd)
}

/// Nodal forces of the stresses (already times the points' weights) at all Gauss points.
#[inline(always)]
pub fn stress_force<const W: usize>(
    element: &Element,
    stress: &[[Lanes<W>; 6]; POINTS],
) -> [[Lanes<W>; 3]; NODES] {
    // Forces that work on the sums and on the differences of the nodal displacements.
    let mut on_sum = [[[0.0; W]; 3]; 4];
    let mut on_difference = [[[0.0; W]; 3]; 4];
    for pair in 0..PAIRS {
        let (first, second) = (&stress[pair], &stress[pair + PAIRS]);
        let mut even = [[0.0; W]; 6];
        let mut odd = [[0.0; W]; 6];
        for i in 0..6 {
            for l in 0..W {
                even[i][l] = second[i][l] + first[i][l];
                odd[i][l] = second[i][l] - first[i][l];
            }
        }
        for (m, (s, d)) in element.mirror[pair].iter().zip(on_sum.iter_mut().zip(&mut on_difference)) {
            // Row c of the stress: its components with x, y and z.
            for (c, [x, y, z]) in [[0, 3, 5], [3, 1, 4], [5, 4, 2]].into_iter().enumerate() {
                add_scaled(&mut s[c], m.even_x, &even[x]);
                add_scaled(&mut s[c], m.odd_y, &odd[y]);
                add_scaled(&mut s[c], m.even_z, &even[z]);
                add_scaled(&mut d[c], m.odd_x, &odd[x]);
                add_scaled(&mut d[c], m.even_y, &even[y]);
                add_scaled(&mut d[c], m.odd_z, &odd[z]);
            }
        }
    }
    let mut force = [[[0.0; W]; 3]; NODES];
    for a in 0..4 {
        for c in 0..3 {
            for l in 0..W {
                force[a][c][l] = on_sum[a][c][l] - on_difference[a][c][l];
                force[a + 4][c][l] = on_sum[a][c][l] + on_difference[a][c][l];
            }
        }
    }
    force
}

/// Deviatoric strains of all Gauss points and the mean dilatation of the element (B̄).
#[inline(always)]
pub fn deviators_and_dilatation<const W: usize>(
    element: &Element,
    displacement: &[[Lanes<W>; 3]; NODES],
) -> ([[Lanes<W>; 6]; POINTS], Lanes<W>) {
    let mut sum = [[[0.0; W]; 3]; 4];
    let mut difference = [[[0.0; W]; 3]; 4];
    for a in 0..4 {
        for c in 0..3 {
            for l in 0..W {
                sum[a][c][l] = displacement[a + 4][c][l] + displacement[a][c][l];
                difference[a][c][l] = displacement[a + 4][c][l] - displacement[a][c][l];
            }
        }
    }
    let mut deviators = [[[0.0; W]; 6]; POINTS];
    let mut dilatation = [0.0; W];
    let inverse_volume = 1.0 / element.volume;
    for pair in 0..PAIRS {
        let (even, odd) = mirror_strain(&element.mirror[pair], &sum, &difference);
        for (q, sign) in [(pair, -1.0), (pair + PAIRS, 1.0)] {
            let e = &mut deviators[q];
            for i in 0..6 {
                for l in 0..W {
                    e[i][l] = fma(sign, odd[i][l], even[i][l]);
                }
            }
            let share = element.weight[q] * inverse_volume;
            for l in 0..W {
                let trace = e[0][l] + e[1][l] + e[2][l];
                dilatation[l] = fma(share, trace, dilatation[l]);
                for component in &mut e[..3] {
                    component[l] -= trace / 3.0;
                }
            }
        }
    }
    (deviators, dilatation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshSize;

    fn mesh(sectors: Sectors) -> RevolvedMesh {
        let meridian = MeridianMesh::new(MeshSize { contact_radius: 0.05, elements_per_radius: 4 });
        RevolvedMesh::new(meridian, sectors)
    }

    /// Cylindrical nodal values of a Cartesian displacement symmetric about y = 0.
    fn nodal(mesh: &RevolvedMesh, u: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
        let columns = mesh.sectors.columns();
        let mut field = vec![0.0; mesh.field_length(3)];
        for (node, &[r, z]) in mesh.meridian.nodes.iter().enumerate() {
            for (j, theta) in mesh.sectors.angles().into_iter().enumerate() {
                let (sin, cos) = theta.sin_cos();
                let r = r * mesh.sectors.radius_scale();
                let [ux, uy, uz] = u([r * cos, r * sin, z]);
                field[node * 3 * columns + j] = ux * cos + uy * sin;
                field[(node * 3 + 1) * columns + j] = -ux * sin + uy * cos;
                field[(node * 3 + 2) * columns + j] = uz;
            }
        }
        field
    }

    #[test]
    fn linear_displacements_have_their_exact_strain_everywhere() {
        let mesh = mesh(Sectors::full(8));
        // Symmetric about y = 0: u_x, u_z even and u_y odd in y.
        let u = nodal(&mesh, |[x, y, z]| [0.3 * x - 0.2 * z + 1.0, 0.7 * y, 0.5 * x + 0.1 * z]);
        for element in &mesh.elements {
            for first in [0, 4] {
                let local = mesh.gather_vector::<4>(&u, element, first);
                let (deviators, dilatation) = deviators_and_dilatation(element, &local);
                for l in 0..4 {
                    // Rotate the exact strain into the sector's frame.
                    let (sin, cos) =
                        ((first + l) as f64 * mesh.sectors.angle() + 0.5 * mesh.sectors.angle()).sin_cos();
                    let (exx, eyy, ezz, exz): (f64, f64, f64, f64) = (0.3, 0.7, 0.1, 0.15);
                    let third = (exx + eyy + ezz) / 3.0;
                    let exact = [
                        exx * cos * cos + eyy * sin * sin - third,
                        exx * sin * sin + eyy * cos * cos - third,
                        ezz - third,
                        (eyy - exx) * sin * cos,
                        -exz * sin,
                        exz * cos,
                    ];
                    assert!((dilatation[l] - 3.0 * third).abs() < 1e-10);
                    for q in 0..POINTS {
                        for i in 0..6 {
                            assert!((deviators[q][i][l] - exact[i]).abs() < 1e-10);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn straight_sectors_have_the_volume_of_round_ones() {
        for count in [4, 8, 16] {
            let mesh = mesh(Sectors::full(count));
            let total: f64 = mesh.nodal_volumes().iter().sum();
            let axisymmetric = RevolvedMesh::new(mesh.meridian.clone(), Sectors::axisymmetric(count));
            let alike: f64 = axisymmetric.nodal_volumes().iter().sum();
            assert!((total / alike - 1.0).abs() < 1e-12);
            let exact = 0.5 * crate::mesh::revolved_volume(&mesh.meridian);
            assert!((total / exact - 1.0).abs() < 1e-12, "{total} {exact}");
        }
    }

    #[test]
    fn gather_and_scatter_are_transposes() {
        let mesh = mesh(Sectors::full(4));
        let n = mesh.field_length(3);
        let u: Vec<f64> = (0..n).map(|i| (i as f64 * 0.7).sin()).collect();
        let mut f = vec![0.0; n];
        let element = &mesh.elements[3];
        let local = mesh.gather_vector::<4>(&u, element, 0);
        mesh.scatter_vector(&local, element, 0, &mut f);
        let energy: f64 = f.iter().zip(&u).map(|(a, b)| a * b).sum();
        let squares: f64 = local.iter().flatten().flatten().map(|v| v * v).sum();
        assert!((energy - squares).abs() < 1e-12 * squares);
    }
}
