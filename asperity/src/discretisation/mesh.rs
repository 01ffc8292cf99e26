//! Graded quadrilateral mesh of the meridian half-plane of the hemisphere.
//!
//! Lengths in units of R; origin at the apex, so that the sphere is z = −r²/(1 + √(1−r²))
//! without cancellation however small the contact, and the clamped base is z = −1.
//!
//! ```text
//!   z
//!   |  apex
//!   o--+--+-+-+--+---.          block: fine elements around the contact,
//!   +--+--+-+-+--+     `-.             r < 1.6 a (or more), thin layers under the surface
//!   +--+--+-+-+--+--.     \     fan: shells of growing thickness, the block's
//!   |  :  : : :  :\   `.   \         outline swelling to the base and the sphere
//!   |   shells     \    \  |
//!   +---------------+----+-+ r  base: clamped, held at the initial temperature
//! ```

use tables::functions::{Accuracy, root_of};

/// Extent and fineness of the mesh, lengths in units of the sphere's radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSize {
    /// Contact radius that the rings are laid out for.
    pub contact_radius: f64,
    /// n_c, elements per contact radius.
    pub elements_per_radius: usize,
    /// The rings keep their edge size up to here, in contact radii: the contact grows while it slides.
    pub growth_zone: f64,
    /// Thermal boundary-layer refinement: number of halvings of the layer at the surface.
    pub thermal_layer_refinements: u32,
}

impl MeshSize {
    /// Size of a mesh with the growth zone that most slides need.
    #[cfg(test)]
    pub fn new(contact_radius: f64, elements_per_radius: usize) -> Self {
        Self { contact_radius, elements_per_radius, growth_zone: GROWTH_ZONE, thermal_layer_refinements: 0 }
    }

    /// Whether the mesh fits into the hemisphere: the fine block does, and the elements around it
    /// are not squeezed out of shape.
    pub fn fits(&self) -> bool {
        let block = self.contact_radius * (self.growth_zone + RIM);
        if block > LARGEST_BLOCK {
            return false;
        }
        let mesh = MeridianMesh::new(*self);
        mesh.quads.iter().all(|quad| mesh.corner_quality(quad) > WORST_CORNER)
    }
}

/// Nodes and quadrilaterals of the meridian.
#[derive(Clone, Debug)]
pub struct MeridianMesh {
    /// (r, z) of each node.
    pub nodes: Vec<[f64; 2]>,
    /// Weight of each node in the rational map of the elements: 1 in the block, ρ₀/ρ in the fan, with ρ the distance
    /// from the apex and ρ₀ that of the block's outline on the same ray. With it, fields linear in an element are linear
    /// in 1/ρ, as the far field of a loaded or heated contact is.
    pub weights: Vec<f64>,
    /// Corners, counter-clockwise in (r, z).
    pub quads: Vec<[u32; 4]>,
    /// Nodes of the surface that can come into contact, by growing r; the apex is first.
    pub contact: Vec<u32>,
    /// True for the nodes of the clamped base.
    pub is_base: Vec<bool>,
}

/// z of the sphere at radius r, in units of R, the apex being at 0.
pub fn sphere_height(r: f64) -> f64 {
    -r * r / (1.0 + (1.0 - r * r).max(0.0).sqrt())
}

/// Element size at the contact edge, at the centre, and at the surface in depth, in units of a/n_c.
pub const EDGE_SIZE: f64 = 1.0 / 3.0;
const CENTRE_SIZE: f64 = 1.0;
pub const SURFACE_LAYER: f64 = 0.5;
/// Growth zone of a mesh unless a larger one is given.
pub const GROWTH_ZONE: f64 = 1.25;
/// Width of the coarser rim of the fine block beyond that, and its depth, in a.
const RIM: f64 = 0.35;
const BLOCK_DEPTH: f64 = 1.3;
/// Outer radius of the block at most, in R: the last ring lies a little beyond its rim.
const LARGEST_BLOCK: f64 = 0.9;
/// Least Jacobian at a corner, relative to the mean over the element.
const WORST_CORNER: f64 = 0.1;

impl MeridianMesh {
    pub fn new(size: MeshSize) -> Self {
        let a = size.contact_radius;
        let rings: Vec<f64> = ring_radii(size).iter().map(|r| r * a).collect();
        let depths: Vec<f64> = layer_depths(size).iter().map(|d| d * a).collect();
        let columns = rings.len() - 1;
        let layers = depths.len() - 1;

        let mut nodes = Vec::new();
        for &depth in &depths {
            for &r in &rings {
                nodes.push([r, sphere_height(r) - depth]);
            }
        }
        let block = |i: usize, k: usize| (k * (columns + 1) + i) as u32;
        let mut quads = Vec::new();
        for k in 0..layers {
            for i in 0..columns {
                quads.push([block(i, k + 1), block(i + 1, k + 1), block(i + 1, k), block(i, k)]);
            }
        }

        // Outline of the block, from the axis below the contact to the surface outside of it.
        let mut outline: Vec<u32> = (0..=columns).map(|i| block(i, layers)).collect();
        outline.extend((0..layers).rev().map(|k| block(columns, k)));
        let growth = 1.0 + 3.0 / size.elements_per_radius as f64;
        let block_size = (size.growth_zone + RIM) * a;
        let shells = ((1.0 / block_size).ln() / growth.ln()).ceil().max(2.0) as usize;
        let (start, last) = (outline.clone(), outline.len() - 1);
        let mut previous = outline;
        let mut weights = vec![1.0; nodes.len()];
        for shell in 1..=shells {
            let t = shell as f64 / shells as f64;
            let current: Vec<u32> = (0..=last)
                .map(|p| {
                    let uniform = p as f64 / last as f64;
                    let inner = nodes[start[p] as usize];
                    let point = fan_point(inner, uniform, t);
                    nodes.push(point);
                    weights.push(inner[0].hypot(inner[1]) / point[0].hypot(point[1]));
                    (nodes.len() - 1) as u32
                })
                .collect();
            for p in 0..last {
                quads.push([previous[p], current[p], current[p + 1], previous[p + 1]]);
            }
            previous = current;
        }
        let mut is_base = vec![false; nodes.len()];
        for &node in &previous {
            is_base[node as usize] = true;
        }
        // Exactly on the axis: removes the rounding error of the trigonometry.
        for node in &mut nodes {
            if node[0] < 1e-12 {
                node[0] = 0.0;
            }
        }
        let contact = (0..=columns).map(|i| block(i, 0)).collect();
        Self { nodes, weights, quads, contact, is_base }
    }

    /// Radii of the rings that can come into contact.
    pub fn contact_radii(&self) -> Vec<f64> {
        self.contact.iter().map(|&n| self.nodes[n as usize][0]).collect()
    }

    /// Smallest Jacobian over the corners of a quadrilateral, relative to its mean; not positive
    /// unless it is convex.
    fn corner_quality(&self, quad: &[u32; 4]) -> f64 {
        let p = quad.map(|n| self.nodes[n as usize]);
        let jacobians: [f64; 4] = std::array::from_fn(|i| {
            let (a, b, c) = (p[(i + 3) % 4], p[i], p[(i + 1) % 4]);
            (c[0] - b[0]) * (a[1] - b[1]) - (c[1] - b[1]) * (a[0] - b[0])
        });
        let mean = jacobians.iter().sum::<f64>() / 4.0;
        let least = jacobians.into_iter().fold(f64::INFINITY, f64::min);
        if mean > 0.0 { least / mean } else { f64::NEG_INFINITY }
    }

    pub fn on_axis(&self, node: usize) -> bool {
        self.nodes[node][0] == 0.0
    }
}

/// Point of the fan on the ray that starts at `start` on the block's outline.
///
/// In polar coordinates (ρ, ψ) about the apex, ψ counted from the axis downwards and scaled by
/// the angle ψ_s(ρ) = acos(ρ/2) of the sphere's surface, ln ρ and ψ/ψ_s go linearly and smoothly
/// from the outline (t = 0) to the base (t = 1), where ρ cos ψ = 1.
fn fan_point(start: [f64; 2], uniform: f64, t: f64) -> [f64; 2] {
    let surface_angle = |rho: f64| (0.5 * rho).acos();
    let rho_start = start[0].hypot(start[1]);
    let angle_start = if uniform >= 1.0 { 1.0 } else { start[0].atan2(-start[1]) / surface_angle(rho_start) };
    let rho_end = base_distance(uniform, surface_angle);
    let rho = (rho_start.ln() * (1.0 - t) + rho_end.ln() * t).exp();
    let spread = 1.0 - (1.0 - t).powi(3);
    let angle = (angle_start * (1.0 - spread) + uniform * spread) * surface_angle(rho);
    [rho * angle.sin(), -rho * angle.cos()]
}

/// Distance ρ from the apex of the point of the base on the ray of scaled angle ψ/ψ_s: the root
/// of ρ cos(ψ) = 1, which rises with ρ.
fn base_distance(scaled_angle: f64, surface_angle: impl Fn(f64) -> f64) -> f64 {
    let beyond_base = |rho: f64| rho * (scaled_angle * surface_angle(rho)).cos() - 1.0;
    root_of(1.0, std::f64::consts::SQRT_2, Accuracy::of(1e-14), beyond_base)
        .expect("the base crosses every ray between the axis and the rim")
}

/// Radii of the rings in units of the contact radius: the edge, r = 1, lies midway between two.
///
/// The size shrinks linearly from the centre to the edge, stays as it is where the contact may
/// grow, and grows again towards the rim of the block.
fn ring_radii(size: MeshSize) -> Vec<f64> {
    let n = size.elements_per_radius;
    let edge = EDGE_SIZE / n as f64;
    let inner = 1.0 - 0.5 * edge;
    // Sizes in arithmetic progression from about CENTRE_SIZE to EDGE_SIZE whose sum is `inner`.
    let count = (inner / (0.5 * (CENTRE_SIZE + EDGE_SIZE) / n as f64)).round().max(2.0) as usize;
    let centre = 2.0 * inner / count as f64 - edge;
    let mut radii = vec![0.0];
    let mut r = 0.0;
    for i in 0..count {
        r += centre + (edge - centre) * i as f64 / (count - 1) as f64;
        radii.push(r);
    }
    while r < size.growth_zone {
        r += edge;
        radii.push(r);
    }
    let mut width = edge;
    let growth = 1.0 + 3.0 / n as f64;
    while r < size.growth_zone + RIM {
        width *= growth;
        r += width;
        radii.push(r);
    }
    radii
}

/// Depths of the layers under the surface in units of the contact radius: growing fast up to the usual
/// size at the surface where the first is thinner than that, then slowly.
fn layer_depths(size: MeshSize) -> Vec<f64> {
    let n = size.elements_per_radius as f64;
    let usual = SURFACE_LAYER / n;
    let mut thickness = usual * 0.5f64.powi(size.thermal_layer_refinements as i32);
    let mut depths = vec![0.0];
    let mut depth = 0.0;
    while depth < BLOCK_DEPTH {
        depth += thickness;
        depths.push(depth);
        thickness = match thickness < usual {
            true => (thickness * (1.0 + 4.8 / n)).min(usual),
            false => thickness * (1.0 + 1.6 / n),
        };
    }
    depths
}

/// Volume of the body of revolution, by Pappus' theorem on the two triangles of each element.
#[cfg(test)]
pub(crate) fn revolved_volume(mesh: &MeridianMesh) -> f64 {
    let triangle = |p: [[f64; 2]; 3]| {
        let double = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
        std::f64::consts::PI * double * (p[0][0] + p[1][0] + p[2][0]) / 3.0
    };
    let corner = |n: u32| mesh.nodes[n as usize];
    mesh.quads
        .iter()
        .map(|&[a, b, c, d]| {
            triangle([corner(a), corner(b), corner(c)]) + triangle([corner(a), corner(c), corner(d)])
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::collocation::Collocation;
    use crate::discretisation::element::RevolvedMesh;

    #[test]
    fn elements_are_convex_for_small_and_large_contacts() {
        for a in [1e-4, 1e-2, 0.13, 0.3] {
            assert!([4, 8, 16].into_iter().all(|n| MeshSize::new(a, n).fits()), "a = {a}");
        }
    }

    /// A mesh that fits is one that can be used, however large the contact and its room to grow.
    #[test]
    fn a_mesh_is_refused_before_its_elements_fold() {
        let size = |contact_radius: f64, growth_zone: f64| MeshSize {
            contact_radius,
            elements_per_radius: 6,
            growth_zone,
            thermal_layer_refinements: (10.0 * growth_zone) as u32 % 3,
        };
        assert!(size(0.3, GROWTH_ZONE).fits() && size(0.1, 4.0).fits());
        assert!(!size(0.6, GROWTH_ZONE).fits() && !size(0.3, 4.0).fits() && !size(40.0, GROWTH_ZONE).fits());
        for k in 1..60 {
            for growth_zone in [1.25, 1.9, 4.0] {
                let size = size(0.01 * f64::from(k), growth_zone);
                if size.fits() {
                    // Panics where an element is inverted at a Gauss point.
                    RevolvedMesh::new(MeridianMesh::new(size), Collocation::full(4));
                }
            }
        }
    }

    #[test]
    fn volume_approaches_the_hemisphere_at_second_order() {
        let exact = 2.0 / 3.0 * std::f64::consts::PI;
        let error = |n: usize| {
            let mesh = MeridianMesh::new(MeshSize::new(0.05, n));
            (revolved_volume(&mesh) / exact - 1.0).abs()
        };
        assert!(error(16) < 0.02);
        assert!(error(16) / error(32) > 3.0, "{} {}", error(16), error(32));
    }

    /// Finer at the surface only: the layers below are those of the mesh without refinement, slightly shifted.
    #[test]
    fn halvings_add_few_layers() {
        for n in [4, 8, 16] {
            let size = MeshSize::new(0.05, n);
            let usual = layer_depths(size);
            for thermal_layer_refinements in [1, 2, 4] {
                let depths = layer_depths(MeshSize { thermal_layer_refinements, ..size });
                assert!(
                    (depths[1] / usual[1] * 2f64.powi(thermal_layer_refinements as i32) - 1.0).abs() < 1e-12
                );
                // The number of layers over which the thickness grows back by that factor, and one more.
                let most =
                    (thermal_layer_refinements as f64 * 2f64.ln() / (1.0 + 4.8 / n as f64).ln()).ceil();
                assert!(depths.len() <= usual.len() + most as usize + 1, "{n} {thermal_layer_refinements}");
            }
        }
    }

    #[test]
    fn the_edge_lies_midway_between_two_rings() {
        for n in [6, 8, 12, 16, 32] {
            let radii = ring_radii(MeshSize::new(1.0, n));
            let after = radii.iter().position(|&r| r > 1.0).unwrap();
            let middle = 0.5 * (radii[after - 1] + radii[after]);
            assert!((middle - 1.0).abs() < 1e-12);
        }
    }
}
