//! Layers of the conduction mesh that divide the upper layers of elements of the body.
//!
//! Before sliding begins, frictional heat reaches the depth √(κt), about 1 % of the contact radius and a part of the first
//! layer of elements, later that of a few layers. Under a constant flux, the surface of layers of the thickness h with a
//! lumped heat capacity warms by the share h²/(16κt) too little if that is small. The first layer is divided into parts that grow
//! by the ratio √2 with depth, the next ones into halves.
//!
//! The meshes are nested: a shape function N of the body is the sum of those of the divided mesh, N′, times the values of
//! N at their nodes, 1 − s and s at the added ones.
//!
//! - Heat given to a node of the body is shared among the nodes of the divided mesh in proportion to N ∫N′dV.
//! - The mechanics gets the temperatures at the nodes of the body; at the surface, the value whose linear profile over the
//!   first layer has the mean of the divided mesh, as thermal expansion needs it.

use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::MeridianMesh;

/// Thickness of a part of the first layer over that of the part above it.
const RATIO: f64 = std::f64::consts::SQRT_2;
/// Number of layers below the first that are halved. Where heat has reached the second layer, the surface under a constant
/// flux is up to 5 % too cold without, and up to 2 % with them (8 elements).
const HALVED: usize = 4;

/// An added node: the nodes of the body above and below it, and the value s of the shape function of the latter.
struct Between {
    above: usize,
    below: usize,
    share: f64,
}

/// Relation between the nodes of the body and those of the divided mesh, whose numbers begin with the body's.
pub struct Sublayers {
    columns: usize,
    body_nodes: usize,
    added: Vec<Between>,
    /// Number of added nodes in the first layer, which come first.
    in_first: usize,
    /// Nodes of the surface.
    surface: Vec<usize>,
    /// ∫N′dV of the divided mesh, per node.
    volumes: Vec<f64>,
    /// Σ N ∫N′dV of the body's nodes.
    sums: Vec<f64>,
}

/// Thickness of the first layer over that of its thinnest part, of `count` parts.
pub fn thickness_ratio(count: u32) -> f64 {
    (RATIO.powi(count as i32) - 1.0) / (RATIO - 1.0)
}

impl Sublayers {
    /// The body's mesh with its first layer divided into `count` parts and the next ones halved; with one part the body's
    /// mesh itself.
    pub fn divide(body: &RevolvedMesh, count: u32) -> (RevolvedMesh, Self) {
        let columns = body.sectors.columns();
        let mut divided = Divided { body: &body.meridian, mesh: body.meridian.clone(), added: Vec::new() };
        let top: Vec<usize> = body.meridian.contact.iter().map(|&node| node as usize).collect();
        let (mut surface, mut in_first) = (Vec::new(), 0);
        if count > 1 {
            let graded: Vec<f64> =
                (1..count).map(|part| thickness_ratio(part) / thickness_ratio(count)).collect();
            let pairs = divided.layer(&top, &graded);
            in_first = divided.added.len();
            surface = pairs.iter().map(|pair| pair[0]).collect();
            let mut below: Vec<usize> = pairs.iter().map(|pair| pair[1]).collect();
            for _ in 0..HALVED {
                below = divided.layer(&below, &[0.5]).iter().map(|pair| pair[1]).collect();
            }
        }
        let Divided { mesh: meridian, added, .. } = divided;
        let mesh = RevolvedMesh::new(meridian, body.sectors.clone());
        let volumes: Vec<f64> = mesh.nodal_volumes().into_iter().step_by(columns).collect();
        let body_nodes = body.node_count();
        let mut sums = volumes[..body_nodes].to_vec();
        for (node, volume) in added.iter().zip(&volumes[body_nodes..]) {
            sums[node.above] += (1.0 - node.share) * volume;
            sums[node.below] += node.share * volume;
        }
        (mesh, Self { columns, body_nodes, added, in_first, surface, volumes, sums })
    }

    /// Length of a scalar field of the body.
    pub fn body_length(&self) -> usize {
        self.body_nodes * self.columns
    }

    /// Heat given to the nodes of the divided mesh, from that given to the body's.
    pub fn spread(&self, body: &[f64]) -> Vec<f64> {
        let columns = self.columns;
        let mut heat = body.to_vec();
        for (node, given) in heat.chunks_exact_mut(columns).enumerate() {
            given.iter_mut().for_each(|heat| *heat *= self.volumes[node] / self.sums[node]);
        }
        for (node, volume) in self.added.iter().zip(&self.volumes[self.body_nodes..]) {
            let shares = [(node.above, 1.0 - node.share), (node.below, node.share)];
            let [above, below] = shares.map(|(n, share)| (n * columns, share * volume / self.sums[n]));
            heat.extend((0..columns).map(|j| above.1 * body[above.0 + j] + below.1 * body[below.0 + j]));
        }
        heat
    }

    /// Temperature rise at the body's nodes, from that of the divided mesh.
    pub fn of_body(&self, rise: &[f64]) -> Vec<f64> {
        let columns = self.columns;
        let mut body = rise[..self.body_length()].to_vec();
        // At the surface Σ(θ − sθ_b)V′/Σ(1 − s)V′ over the nodes of the layer, with θ_b below.
        let mut sums = self.volumes[..self.body_nodes].to_vec();
        for &node in &self.surface {
            body[node * columns..][..columns].iter_mut().for_each(|rise| *rise *= sums[node]);
        }
        for (n, node) in self.added[..self.in_first].iter().enumerate() {
            let added = self.body_nodes + n;
            for j in 0..columns {
                let excess = rise[added * columns + j] - node.share * rise[node.below * columns + j];
                body[node.above * columns + j] += self.volumes[added] * excess;
            }
            sums[node.above] += (1.0 - node.share) * self.volumes[added];
        }
        for &node in &self.surface {
            body[node * columns..][..columns].iter_mut().for_each(|rise| *rise /= sums[node]);
        }
        body
    }
}

/// A mesh whose layers are divided one after the other, with the added nodes behind the others.
struct Divided<'a> {
    body: &'a MeridianMesh,
    mesh: MeridianMesh,
    added: Vec<Between>,
}

impl Divided<'_> {
    /// Divides the layer below the nodes `top` at shares of its thickness; returns the nodes above and below it.
    fn layer(&mut self, top: &[usize], shares: &[f64]) -> Vec<[usize; 2]> {
        let body = self.body;
        let layer = layer_below(body, top);
        let sides = |quad: usize| {
            let [a, b, c, d] = body.quads[quad].map(|node| node as usize);
            [[d, a], [c, b]]
        };
        let mut pairs: Vec<[usize; 2]> = layer.iter().flat_map(|&quad| sides(quad)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let first = self.mesh.nodes.len();
        for &[above, below] in &pairs {
            for &share in shares {
                self.add(Between { above, below, share });
            }
        }
        // Nodes of a side from above.
        let chain = |side: [usize; 2]| {
            let pair = pairs.binary_search(&side).expect("a side of the layer");
            let between = (0..shares.len()).map(|part| first + pair * shares.len() + part);
            let nodes = std::iter::once(side[0]).chain(between).chain([side[1]]);
            nodes.map(|node| node as u32).collect::<Vec<u32>>()
        };
        for &quad in &layer {
            let [left, right] = sides(quad).map(chain);
            let mut parts = (0..=shares.len()).map(|k| [left[k + 1], right[k + 1], right[k], left[k]]);
            self.mesh.quads[quad] = parts.next().expect("the upper part");
            self.mesh.quads.extend(parts);
        }
        pairs
    }

    fn add(&mut self, node: Between) {
        let Between { above, below, share } = node;
        let mesh = &mut self.mesh;
        // The map of the elements is rational.
        let parts = [(above, (1.0 - share) * mesh.weights[above]), (below, share * mesh.weights[below])];
        let weight = parts[0].1 + parts[1].1;
        let at =
            |axis: usize| parts.iter().map(|&(n, part)| part * mesh.nodes[n][axis]).sum::<f64>() / weight;
        let position = [at(0), at(1)];
        mesh.nodes.push(position);
        mesh.weights.push(weight);
        mesh.is_base.push(mesh.is_base[above] && mesh.is_base[below]);
        self.added.push(node);
    }
}

/// The quadrilaterals below nodes of the block and, beyond them, of the fan; their last side is the upper one.
fn layer_below(body: &MeridianMesh, top: &[usize]) -> Vec<usize> {
    let mut is_top = vec![false; body.nodes.len()];
    top.iter().for_each(|&node| is_top[node] = true);
    let mut layer = Vec::new();
    for (n, &[_, _, c, d]) in body.quads.iter().enumerate() {
        if is_top[d as usize] {
            layer.push(n);
            // The shells of the fan follow each other outwards.
            is_top[c as usize] = true;
        }
    }
    layer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::collocation::Collocation;
    use crate::discretisation::mesh::{MeshSize, sphere_height};
    use crate::material::lanes::dot;

    /// The coarsest mesh has just as many layers as are divided.
    fn meshes(count: u32) -> (RevolvedMesh, RevolvedMesh, Sublayers) {
        let body = RevolvedMesh::new(MeridianMesh::new(MeshSize::new(0.05, 4)), Collocation::full(4));
        let (mesh, sublayers) = Sublayers::divide(&body, count);
        (body, mesh, sublayers)
    }

    /// Nested meshes: the layers go along the surface from the axis to the base, their volume stays, and one part is no
    /// division.
    #[test]
    fn the_layer_along_the_surface_is_divided() {
        let (body, mesh, sublayers) = meshes(5);
        let on_surface = |node: usize| {
            let [r, z] = body.meridian.nodes[node];
            ((z - sphere_height(r)).abs() < 1e-12).then_some(r)
        };
        let radii: Vec<f64> = sublayers.surface.iter().map(|&node| on_surface(node).unwrap()).collect();
        let all = (0..body.node_count()).filter(|&node| on_surface(node).is_some()).count();
        assert_eq!(radii.len(), all);
        assert_eq!(radii.iter().fold(1.0, |least: f64, r| least.min(*r)), 0.0);
        assert!((radii.iter().fold(0.0, |most: f64, r| most.max(*r)) - 1.0).abs() < 1e-12);
        let more = (4 + HALVED) * (radii.len() - 1);
        assert_eq!(mesh.elements.len(), body.elements.len() + more);
        assert_eq!(mesh.node_count(), body.node_count() + (4 + HALVED) * radii.len());
        let volume = |mesh: &RevolvedMesh| mesh.elements.iter().map(|e| e.volume).sum::<f64>();
        assert!((volume(&mesh) / volume(&body) - 1.0).abs() < 2e-3);
        let thinnest = mesh.meridian.quads[0].map(|node| mesh.meridian.nodes[node as usize][1]);
        let ratio = body.meridian.nodes[body.meridian.quads[0][0] as usize][1] / thinnest[0];
        assert!((ratio / thickness_ratio(5) - 1.0).abs() < 1e-12, "{ratio}");
        let (body, mesh, _) = meshes(1);
        assert_eq!(mesh.meridian.quads, body.meridian.quads);
    }

    /// Fields that are linear in each element of the body are the same on both meshes; heat keeps its sum, and so does
    /// the mean rise.
    #[test]
    fn heat_and_linear_temperatures_are_transferred() {
        let (body, mesh, sublayers) = meshes(6);
        let columns = body.sectors.columns();
        let on_body: Vec<f64> = (0..body.field_length(1)).map(|i| (0.37 * i as f64).sin()).collect();
        let mut linear = on_body.clone();
        for node in &sublayers.added {
            for j in 0..columns {
                let [surface, below] = [node.above, node.below].map(|n| on_body[n * columns + j]);
                linear.push((1.0 - node.share) * surface + node.share * below);
            }
        }
        assert_eq!(linear.len(), mesh.field_length(1));
        for (mean, exact) in sublayers.of_body(&linear).iter().zip(&on_body) {
            assert!((mean - exact).abs() < 1e-12, "{mean} {exact}");
        }
        let spread = sublayers.spread(&on_body);
        let (sum, given) = (spread.iter().sum::<f64>(), on_body.iter().sum::<f64>());
        assert!((sum - given).abs() < 1e-12 * on_body.len() as f64, "{sum} {given}");
        // A rise of the surface alone.
        let mut rise = vec![0.0; mesh.field_length(1)];
        for &node in &body.meridian.contact {
            rise[node as usize * columns..][..columns].fill(1.0);
        }
        let exact = dot(&rise, &mesh.nodal_volumes());
        let found = dot(&sublayers.of_body(&rise), &body.nodal_volumes());
        assert!((found / exact - 1.0).abs() < 2e-3, "{found} {exact}");
    }
}
