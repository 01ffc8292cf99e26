//! Bilinear ring elements on the meridian, trigonometric in θ: geometry, gather and scatter
//! between nodes and lanes, and the mean-dilatation (B̄) strain and force operators.
//!
//! The map of an element is rational, x = Σ N w X/Σ N w with the weights w of the mesh, and displacements are bilinear
//! in the reference square: in the shells of the fan they are linear in 1/ρ, with as few shells as a far field that
//! falls with 1/ρ needs (Zienkiewicz, Emson & Bettess 1983, Int. J. Numer. Meth. Engng 19, 393, map infinite elements so).
//! With equal weights the map is bilinear.
//!
//! At each angle a meridian quadrilateral has 2 × 2 Gauss points. Strains there follow from the
//! nodal displacements at that angle and from their exact derivatives in θ, so all angles share
//! one set of coefficients and are lanes. The mean dilatation (Hughes 1980, Int. J. Numer. Meth.
//! Engng 15, 1413) is over the quadrilateral, angle by angle.
//!
//! Symmetric tensors are stored as (rr, θθ, zz, rθ, θz, zr), shear components unscaled.
//!
//! Depends on `mesh` and `collocation`. Chapter "Mesh and elements" of the book.

use crate::discretisation::collocation::Collocation;
use crate::discretisation::mesh::MeridianMesh;
use crate::material::lanes::{Lanes, Pack};

/// Gauss points of a quadrilateral.
pub const POINTS: usize = 4;
pub const CORNERS: usize = 4;
/// (u_r, u_θ, u_z) and their derivatives in θ; likewise the conjugate forces.
pub const VALUES: usize = 6;

/// 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;
const CORNER_XI: [f64; 4] = [-1.0, 1.0, 1.0, -1.0];
const CORNER_ETA: [f64; 4] = [-1.0, -1.0, 1.0, 1.0];
/// ξη at the corners.
pub const HOURGLASS: [f64; 4] = [1.0, -1.0, 1.0, -1.0];

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
    /// Sum of the weights.
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
    fn new(meridian: &MeridianMesh, nodes: [u32; CORNERS], sectors: &Collocation) -> Self {
        let shapes = shape_at_points();
        let corners = nodes.map(|n| meridian.nodes[n as usize]);
        let weights = nodes.map(|n| meridian.weights[n as usize]);
        let mut weight = [0.0; POINTS];
        let shape = std::array::from_fn(|q| {
            let [xi, eta] = gauss_point(q);
            let local: [[f64; 2]; CORNERS] = std::array::from_fn(|n| {
                let (cx, ce) = (CORNER_XI[n], CORNER_ETA[n]);
                [0.25 * cx * (1.0 + ce * eta), 0.25 * ce * (1.0 + cx * xi)]
            });
            let mut jacobian = nalgebra::Matrix2::<f64>::zeros();
            let parts: [f64; CORNERS] = std::array::from_fn(|n| shapes[q][n] * weights[n]);
            let whole: f64 = parts.iter().sum();
            let point: [f64; 2] =
                std::array::from_fn(|d| (0..CORNERS).map(|n| parts[n] * corners[n][d]).sum::<f64>() / whole);
            for n in 0..CORNERS {
                for d in 0..2 {
                    for k in 0..2 {
                        jacobian[(d, k)] += local[n][k] * weights[n] * (corners[n][d] - point[d]) / whole;
                    }
                }
            }
            let r = point[0];
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

    /// |∇ξ|² + |∇η|² at a Gauss point, with ∇ξ = Σ ξ_n ∇N_n.
    pub fn reference_gradients(&self, point: usize) -> f64 {
        let gradient = |corner: [f64; CORNERS]| {
            let shape = self.shape[point].iter().zip(corner);
            shape.fold([0.0; 2], |[r, z], (shape, value)| [r + value * shape.dr, z + value * shape.dz])
        };
        [CORNER_XI, CORNER_ETA].map(gradient).iter().flatten().map(|part| part * part).sum()
    }
}

/// The revolved mesh: the elements of the meridian and the angles.
#[derive(Clone, Debug)]
pub struct RevolvedMesh {
    pub meridian: MeridianMesh,
    pub sectors: Collocation,
    pub elements: Vec<Element>,
}

impl RevolvedMesh {
    pub fn new(meridian: MeridianMesh, sectors: Collocation) -> Self {
        let elements = meridian.quads.iter().map(|quad| Element::new(&meridian, *quad, &sectors)).collect();
        Self { meridian, sectors, elements }
    }

    pub fn node_count(&self) -> usize {
        self.meridian.nodes.len()
    }

    /// Length of a field with the given number of components.
    pub fn field_length(&self, components: usize) -> usize {
        self.node_count() * components * self.sectors.columns()
    }

    /// Volume ∫N dV of each node and column (half body); times ρc the lumped heat capacity.
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

    /// Displacements of an element's corners and their derivatives in θ, at as many angles from `first` on as a
    /// pack holds.
    #[inline(always)]
    pub fn gather_vector<V: Pack>(
        &self,
        field: &[f64],
        derivative: &[f64],
        element: &Element,
        first: usize,
    ) -> [[V; VALUES]; CORNERS] {
        let columns = self.sectors.columns();
        let mut values = [[V::splat(0.0); VALUES]; CORNERS];
        for (values, &node) in values.iter_mut().zip(&element.nodes) {
            let base = node as usize * 3 * columns + first;
            for c in 0..3 {
                let at = base + c * columns;
                values[c] = V::load(&field[at..]);
                values[c + 3] = V::load(&derivative[at..]);
            }
        }
        values
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

/// Adds the forces conjugate to the corners' displacements and to their derivatives in θ to `forces`, which has
/// [`VALUES`] components a node, at as many of `columns` angles from `first` on as a pack holds.
#[inline(always)]
pub fn scatter_vector<V: Pack>(
    values: &[[V; VALUES]; CORNERS],
    nodes: &[u32; CORNERS],
    (first, columns): (usize, usize),
    forces: &mut [f64],
) {
    for (values, &node) in values.iter().zip(nodes) {
        let base = node as usize * VALUES * columns + first;
        for (c, &value) in values.iter().enumerate() {
            let target = &mut forces[base + c * columns..];
            (V::load(target) + value).store(target);
        }
    }
}

/// Adds factor·value.
#[inline(always)]
fn add<V: Pack>(sum: &mut V, factor: f64, value: V) {
    *sum = V::splat(factor).mul_add(value, *sum);
}

/// Deviatoric strains of all Gauss points and the mean dilatation of the element (B̄).
#[inline(always)]
pub fn deviators_and_dilatation<V: Pack>(
    element: &Element,
    values: &[[V; VALUES]; CORNERS],
) -> ([[V; 6]; POINTS], V) {
    let zero = V::splat(0.0);
    // u_r + ∂u_θ/∂θ.
    let mut hoop = [zero; CORNERS];
    for (hoop, v) in hoop.iter_mut().zip(values) {
        *hoop = v[0] + v[4];
    }
    let mut strains = [[zero; 6]; POINTS];
    let mut dilatation = zero;
    let inverse_volume = 1.0 / element.volume;
    for q in 0..POINTS {
        let e = &mut strains[q];
        for ((n, v), hoop) in element.shape[q].iter().zip(values).zip(&hoop) {
            let (half_dr, half_dz, half_over_r) = (0.5 * n.dr, 0.5 * n.dz, 0.5 * n.over_r);
            add(&mut e[0], n.dr, v[0]);
            add(&mut e[1], n.over_r, *hoop);
            add(&mut e[2], n.dz, v[2]);
            add(&mut e[3], half_dr - half_over_r, v[1]);
            add(&mut e[3], half_over_r, v[3]);
            add(&mut e[4], half_dz, v[1]);
            add(&mut e[4], half_over_r, v[5]);
            add(&mut e[5], half_dr, v[2]);
            add(&mut e[5], half_dz, v[0]);
        }
        let trace = e[0] + e[1] + e[2];
        dilatation = V::splat(element.weight[q] * inverse_volume).mul_add(trace, dilatation);
        for component in &mut e[..3] {
            *component = V::splat(-1.0 / 3.0).mul_add(trace, *component);
        }
    }
    (strains, dilatation)
}

/// Forces on the corners of the stresses (already times the points' weights) at all Gauss points.
#[inline(always)]
pub fn stress_force<V: Pack>(element: &Element, stress: &[[V; 6]; POINTS]) -> [[V; VALUES]; CORNERS] {
    let mut force = [[V::splat(0.0); VALUES]; CORNERS];
    for (shape, s) in element.shape.iter().zip(stress) {
        for (n, f) in shape.iter().zip(&mut force) {
            add(&mut f[0], n.dr, s[0]);
            add(&mut f[0], n.dz, s[5]);
            add(&mut f[1], n.dr - n.over_r, s[3]);
            add(&mut f[1], n.dz, s[4]);
            add(&mut f[2], n.dz, s[2]);
            add(&mut f[2], n.dr, s[5]);
            add(&mut f[3], n.over_r, s[3]);
            add(&mut f[4], n.over_r, s[1]);
            add(&mut f[5], n.over_r, s[4]);
        }
    }
    // The hoop stress works on u_r + ∂u_θ/∂θ.
    for f in &mut force {
        f[0] = f[0] + f[4];
    }
    force
}

#[cfg(test)]
pub(crate) mod tests;
