//! Bilinear ring elements on the meridian, trigonometric in θ: geometry, gather and scatter
//! between nodes and lanes, and the mean-dilatation (B̄) strain and force operators.
//!
//! At each angle a meridian quadrilateral has 2 × 2 Gauss points. Strains there follow from the
//! nodal displacements at that angle and from their exact derivatives in θ, so all angles share
//! one set of coefficients and are lanes. The mean dilatation (Hughes 1980, Int. J. Numer. Meth.
//! Engng 15, 1413) is over the quadrilateral, angle by angle.
//!
//! Symmetric tensors are stored as (rr, θθ, zz, rθ, θz, zr), shear components unscaled.

use crate::lanes::{Lanes, add_scaled, fma};
use crate::mesh::MeridianMesh;
use crate::sectors::Sectors;

/// Gauss points of a quadrilateral.
pub const POINTS: usize = 4;
pub const CORNERS: usize = 4;
/// (u_r, u_θ, u_z) and their derivatives in θ; likewise the forces that work on them.
pub const VALUES: usize = 6;

/// 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;
const CORNER_XI: [f64; 4] = [-1.0, 1.0, 1.0, -1.0];
const CORNER_ETA: [f64; 4] = [-1.0, -1.0, 1.0, 1.0];

/// Shape function N of a corner at a Gauss point.
#[derive(Clone, Copy, Debug, Default)]
pub struct ShapeAtPoint {
    /// ∂N/∂r.
    pub dr: f64,
    /// ∂N/∂z.
    pub dz: f64,
    /// N/r.
    pub over_r: f64,
}

/// Geometry of one element.
#[derive(Clone, Debug)]
pub struct Element {
    /// Corners in the meridian.
    pub nodes: [u32; CORNERS],
    pub shape: [[ShapeAtPoint; CORNERS]; POINTS],
    /// Volume that belongs to each Gauss point of one angle.
    pub weight: [f64; POINTS],
    /// Their sum.
    pub volume: f64,
}

/// Position of Gauss point q in the reference square.
fn gauss_point(q: usize) -> [f64; 2] {
    let sign = |bit: usize| if q >> bit & 1 == 0 { -GAUSS } else { GAUSS };
    [sign(0), sign(1)]
}

/// Bilinear shape functions at the Gauss points; the same for all elements.
pub fn shape_at_points() -> [[f64; CORNERS]; POINTS] {
    std::array::from_fn(|q| {
        let [xi, eta] = gauss_point(q);
        std::array::from_fn(|n| 0.25 * (1.0 + CORNER_XI[n] * xi) * (1.0 + CORNER_ETA[n] * eta))
    })
}

impl Element {
    fn new(corners: [[f64; 2]; CORNERS], nodes: [u32; CORNERS], sectors: &Sectors) -> Self {
        let shapes = shape_at_points();
        let mut weight = [0.0; POINTS];
        let shape = std::array::from_fn(|q| {
            let [xi, eta] = gauss_point(q);
            let local: [[f64; 2]; CORNERS] = std::array::from_fn(|n| {
                let (cx, ce) = (CORNER_XI[n], CORNER_ETA[n]);
                [0.25 * cx * (1.0 + ce * eta), 0.25 * ce * (1.0 + cx * xi)]
            });
            let mut jacobian = nalgebra::Matrix2::<f64>::zeros();
            let mut r = 0.0;
            for n in 0..CORNERS {
                r += shapes[q][n] * corners[n][0];
                for d in 0..2 {
                    for k in 0..2 {
                        jacobian[(d, k)] += local[n][k] * corners[n][d];
                    }
                }
            }
            let determinant = jacobian.determinant();
            assert!(determinant > 0.0, "inverted element at r, z = {:?}", corners[0]);
            weight[q] = determinant * r * sectors.weight();
            let inverse = jacobian.try_inverse().expect("positive area");
            std::array::from_fn(|n| ShapeAtPoint {
                dr: local[n][0] * inverse[(0, 0)] + local[n][1] * inverse[(1, 0)],
                dz: local[n][0] * inverse[(0, 1)] + local[n][1] * inverse[(1, 1)],
                over_r: shapes[q][n] / r,
            })
        });
        Self { nodes, shape, volume: weight.iter().sum(), weight }
    }
}

/// The revolved mesh: the elements of the meridian and the angles.
#[derive(Clone, Debug)]
pub struct RevolvedMesh {
    pub meridian: MeridianMesh,
    pub sectors: Sectors,
    pub elements: Vec<Element>,
}

impl RevolvedMesh {
    pub fn new(meridian: MeridianMesh, sectors: Sectors) -> Self {
        let elements = meridian
            .quads
            .iter()
            .map(|quad| Element::new(quad.map(|n| meridian.nodes[n as usize]), *quad, &sectors))
            .collect();
        Self { meridian, sectors, elements }
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
            for (n, &node) in element.nodes.iter().enumerate() {
                let share: f64 = (0..POINTS).map(|q| element.weight[q] * shapes[q][n]).sum();
                for volume in &mut volumes[node as usize * columns..][..columns] {
                    *volume += share;
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
            // ∫ N r dr over [r0, r1] for the two linear functions.
            let (r0, r1) = (radii[i - 1], radii[i]);
            let h = r1 - r0;
            ring[i - 1] += h * (2.0 * r0 + r1) / 6.0;
            ring[i] += h * (r0 + 2.0 * r1) / 6.0;
        }
        let columns = self.sectors.columns();
        (0..ring.len() * columns).map(|i| ring[i / columns] * self.sectors.weight()).collect()
    }

    /// Displacements of an element's corners and their derivatives in θ, at W angles from `first` on.
    #[inline(always)]
    pub fn gather_vector<const W: usize>(
        &self,
        field: &[f64],
        derivative: &[f64],
        element: &Element,
        first: usize,
    ) -> [[Lanes<W>; VALUES]; CORNERS] {
        let columns = self.sectors.columns();
        let mut values = [[[0.0; W]; VALUES]; CORNERS];
        for (values, &node) in values.iter_mut().zip(&element.nodes) {
            let base = node as usize * 3 * columns + first;
            for c in 0..3 {
                let at = base + c * columns;
                values[c].copy_from_slice(&field[at..at + W]);
                values[c + 3].copy_from_slice(&derivative[at..at + W]);
            }
        }
        values
    }

    /// Adds forces on the corners' displacements and on their derivatives to fields of each.
    #[inline(always)]
    pub fn scatter_vector<const W: usize>(
        &self,
        values: &[[Lanes<W>; VALUES]; CORNERS],
        element: &Element,
        first: usize,
        field: &mut [f64],
        on_derivative: &mut [f64],
    ) {
        let columns = self.sectors.columns();
        for (values, &node) in values.iter().zip(&element.nodes) {
            let base = node as usize * 3 * columns + first;
            for c in 0..3 {
                let at = base + c * columns;
                for (target, value) in field[at..at + W].iter_mut().zip(&values[c]) {
                    *target += value;
                }
                for (target, value) in on_derivative[at..at + W].iter_mut().zip(&values[c + 3]) {
                    *target += value;
                }
            }
        }
    }

    /// Scalar values of an element's corners at W angles from `first` on.
    #[inline(always)]
    pub fn gather_scalar<const W: usize>(
        &self,
        field: &[f64],
        element: &Element,
        first: usize,
    ) -> [Lanes<W>; CORNERS] {
        let columns = self.sectors.columns();
        element.nodes.map(|node| {
            let at = node as usize * columns + first;
            std::array::from_fn(|l| field[at + l])
        })
    }

    /// Adds corner values at W angles to a scalar field.
    #[inline(always)]
    pub fn scatter_scalar<const W: usize>(
        &self,
        values: &[Lanes<W>; CORNERS],
        element: &Element,
        first: usize,
        field: &mut [f64],
    ) {
        let columns = self.sectors.columns();
        for (values, &node) in values.iter().zip(&element.nodes) {
            let at = node as usize * columns + first;
            for (target, value) in field[at..at + W].iter_mut().zip(values) {
                *target += value;
            }
        }
    }
}

/// Deviatoric strains of all Gauss points and the mean dilatation of the element (B̄).
#[inline(always)]
pub fn deviators_and_dilatation<const W: usize>(
    element: &Element,
    values: &[[Lanes<W>; VALUES]; CORNERS],
) -> ([[Lanes<W>; 6]; POINTS], Lanes<W>) {
    // u_r + ∂u_θ/∂θ.
    let mut hoop = [[0.0; W]; CORNERS];
    for (hoop, v) in hoop.iter_mut().zip(values) {
        for l in 0..W {
            hoop[l] = v[0][l] + v[4][l];
        }
    }
    let mut strains = [[[0.0; W]; 6]; POINTS];
    let mut dilatation = [0.0; W];
    let inverse_volume = 1.0 / element.volume;
    for q in 0..POINTS {
        let e = &mut strains[q];
        for ((n, v), hoop) in element.shape[q].iter().zip(values).zip(&hoop) {
            let (half_dr, half_dz, half_over_r) = (0.5 * n.dr, 0.5 * n.dz, 0.5 * n.over_r);
            add_scaled(&mut e[0], n.dr, &v[0]);
            add_scaled(&mut e[1], n.over_r, hoop);
            add_scaled(&mut e[2], n.dz, &v[2]);
            add_scaled(&mut e[3], half_dr - half_over_r, &v[1]);
            add_scaled(&mut e[3], half_over_r, &v[3]);
            add_scaled(&mut e[4], half_dz, &v[1]);
            add_scaled(&mut e[4], half_over_r, &v[5]);
            add_scaled(&mut e[5], half_dr, &v[2]);
            add_scaled(&mut e[5], half_dz, &v[0]);
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
    (strains, dilatation)
}

/// Forces on the corners of the stresses (already times the points' weights) at all Gauss points.
#[inline(always)]
pub fn stress_force<const W: usize>(
    element: &Element,
    stress: &[[Lanes<W>; 6]; POINTS],
) -> [[Lanes<W>; VALUES]; CORNERS] {
    let mut force = [[[0.0; W]; VALUES]; CORNERS];
    for (shape, s) in element.shape.iter().zip(stress) {
        for (n, f) in shape.iter().zip(&mut force) {
            add_scaled(&mut f[0], n.dr, &s[0]);
            add_scaled(&mut f[0], n.dz, &s[5]);
            add_scaled(&mut f[1], n.dr - n.over_r, &s[3]);
            add_scaled(&mut f[1], n.dz, &s[4]);
            add_scaled(&mut f[2], n.dz, &s[2]);
            add_scaled(&mut f[2], n.dr, &s[5]);
            add_scaled(&mut f[3], n.over_r, &s[3]);
            add_scaled(&mut f[4], n.over_r, &s[1]);
            add_scaled(&mut f[5], n.over_r, &s[4]);
        }
    }
    // The hoop stress works on u_r + ∂u_θ/∂θ.
    for f in &mut force {
        for l in 0..W {
            f[0][l] += f[4][l];
        }
    }
    force
}

#[cfg(test)]
mod tests;
