//! Division of the body into parts of elements that threads compute side by side.
//!
//! The elements of a part add to the part's own copy of the nodal forces; the force on a node is the sum over the parts, in
//! order. The parts follow from the mesh alone, so the results do not depend on the number of threads.

use std::ops::Range;

use rayon::prelude::*;

use crate::discretisation::collocation::{Collocation, VECTOR_PARITY};
use crate::discretisation::element::{CORNERS, RevolvedMesh, VALUES};
use crate::discretisation::threads::least_share;
use crate::material::instruction_set::dispatch;

/// Least elements times angles of a part (the last may have fewer): a tenth of a millisecond of work.
const LEAST: usize = 512;
const MOST_PARTS: usize = 32;
/// Nodes that a thread takes at a time.
const BLOCK: usize = 256;

#[derive(Clone, Debug, Default)]
pub(super) struct Partition {
    /// Elements of each part but the last.
    size: usize,
    /// Corners of each element among the nodes of its part.
    corners: Vec<[u32; CORNERS]>,
    /// Number of nodes of each part.
    node_counts: Vec<usize>,
    /// For each node its copies in the parts, part by part; those of node n begin at `start[n]`.
    part_nodes: Vec<PartNode>,
    start: Vec<u32>,
    /// Forces and the forces on the slopes ∂u/∂θ at the nodes of the parts: scratch.
    forces: Vec<f64>,
}

/// A node in a part, which has its own copy of the nodal force.
#[derive(Clone, Copy, Debug, Default)]
struct PartNode {
    part: u32,
    /// Number of the node among those of all parts.
    node: u32,
}

impl Partition {
    pub fn new(mesh: &RevolvedMesh) -> Self {
        let (elements, columns) = (mesh.elements.len(), mesh.sectors.columns());
        let size = elements.div_ceil(MOST_PARTS).max(LEAST / columns);
        let mut corners = Vec::with_capacity(elements);
        let (mut node_counts, mut of_nodes) = (Vec::new(), vec![Vec::new(); mesh.node_count()]);
        let mut before = 0;
        for (part, elements) in mesh.elements.chunks(size).enumerate() {
            let mut nodes: Vec<u32> = elements.iter().flat_map(|element| element.nodes).collect();
            nodes.sort_unstable();
            nodes.dedup();
            let local = |node: u32| nodes.binary_search(&node).expect("a node of the part") as u32;
            corners.extend(elements.iter().map(|element| element.nodes.map(local)));
            for (i, &node) in nodes.iter().enumerate() {
                of_nodes[node as usize].push(PartNode { part: part as u32, node: (before + i) as u32 });
            }
            node_counts.push(nodes.len());
            before += nodes.len();
        }
        let mut start = vec![0];
        start.extend(of_nodes.iter().scan(0, |end, part_nodes| {
            *end += part_nodes.len() as u32;
            Some(*end)
        }));
        let forces = vec![0.0; before * VALUES * columns];
        Self { size, corners, node_counts, part_nodes: of_nodes.concat(), start, forces }
    }

    /// For each part, its range in `elements`, which ascend.
    pub fn ranges_of(&self, elements: &[u32]) -> Vec<Range<usize>> {
        let before = |part: usize| elements.partition_point(|&e| (e as usize) < part * self.size);
        (0..self.node_counts.len()).map(|part| before(part)..before(part + 1)).collect()
    }

    /// Splits the scratch: for each part its elements, their corners and the forces at its nodes.
    pub fn parts(&mut self, columns: usize) -> Vec<PartForces<'_>> {
        let mut rest = &mut self.forces[..];
        let parts = self.corners.chunks(self.size).zip(&self.node_counts).enumerate();
        parts
            .map(|(part, (corners, count))| {
                let forces = rest.split_off_mut(..count * VALUES * columns).expect("of all parts");
                let first = part * self.size;
                PartForces { elements: first..first + corners.len(), corners, forces }
            })
            .collect()
    }

    /// Forces on `nodes`, which ascend: sums over the parts that are `active`. Other entries of `force` are kept.
    pub fn forces_on(&self, sectors: &Collocation, nodes: &[usize], active: &[bool], force: &mut [f64]) {
        let size = BLOCK * 3 * sectors.columns();
        let blocks = force.par_chunks_mut(size).with_min_len(least_share());
        blocks.enumerate().for_each(|(block, force)| {
            dispatch! { <E> fn(
                this: &Partition = self,
                sectors: &Collocation = sectors,
                nodes: &[usize] = of_block(nodes, block),
                active: &[bool] = active,
                force: &mut [f64] = force,
            ) {
                let width = 3 * sectors.columns();
                for &node in nodes {
                    let force = &mut force[node % BLOCK * width..][..width];
                    this.force_on(sectors, node, active, force);
                }
            }}
        });
    }

    /// Most nodes have elements of one part alone.
    #[inline(always)]
    fn force_on(&self, sectors: &Collocation, node: usize, active: &[bool], force: &mut [f64]) {
        // Those on the displacement, and with those on the slopes.
        let (width, both) = (force.len(), VALUES * sectors.columns());
        let part_nodes = &self.part_nodes[self.start[node] as usize..self.start[node + 1] as usize];
        let mut parts = part_nodes
            .iter()
            .filter(|copy| active[copy.part as usize])
            .map(|copy| self.forces[copy.node as usize * both..][..both].split_at(width));
        match parts.next() {
            None => force.fill(0.0),
            Some((of_displacement, of_slope)) => {
                force.copy_from_slice(of_displacement);
                sectors.add_transposed(&VECTOR_PARITY, of_slope, force);
            }
        }
        for (of_displacement, of_slope) in parts {
            force.iter_mut().zip(of_displacement).for_each(|(force, of_part)| *force += of_part);
            sectors.add_transposed(&VECTOR_PARITY, of_slope, force);
        }
    }

    /// All parts.
    pub fn all(&self) -> Vec<bool> {
        vec![true; self.node_counts.len()]
    }
}

/// The nodes of a block; `nodes` ascend.
fn of_block(nodes: &[usize], block: usize) -> &[usize] {
    let [first, end] = [block, block + 1].map(|block| nodes.partition_point(|&node| node < block * BLOCK));
    &nodes[first..end]
}

/// ∂u/∂θ at `nodes`, which ascend.
pub(super) fn differentiate(sectors: &Collocation, nodes: &[usize], u: &[f64], slope: &mut [f64]) {
    let size = BLOCK * 3 * sectors.columns();
    let blocks = u.par_chunks(size).zip(slope.par_chunks_mut(size)).with_min_len(least_share());
    blocks.enumerate().for_each(|(block, (u, slope))| {
        dispatch! { <E> fn(
            sectors: &Collocation = sectors,
            nodes: &[usize] = of_block(nodes, block),
            u: &[f64] = u,
            slope: &mut [f64] = slope,
        ) {
            let width = 3 * sectors.columns();
            for &node in nodes {
                let own = node % BLOCK * width..(node % BLOCK + 1) * width;
                sectors.differentiate(&VECTOR_PARITY, &u[own.clone()], &mut slope[own]);
            }
        }}
    });
}

/// A part of the body, and its forces.
pub(super) struct PartForces<'a> {
    pub elements: Range<usize>,
    /// Corners of each element, as numbers among the nodes of the part.
    pub corners: &'a [[u32; CORNERS]],
    pub forces: &'a mut [f64],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::element::scatter_vector;
    use crate::discretisation::mesh::{MeridianMesh, MeshSize};

    /// Unit forces on u_r and on ∂u_z/∂θ at each corner of each element: the forces on a node are those of one corner times
    /// the number of its elements in active parts.
    #[test]
    fn forces_on_nodes_are_sums_over_their_elements() {
        let columns = 8;
        let mesh = RevolvedMesh::new(MeridianMesh::new(MeshSize::new(0.1, 6)), Collocation::full(columns));
        let mut partition = Partition::new(&mesh);
        assert!(partition.node_counts.len() > 2);
        let unit = [[1.0, 0.0, 0.0, 0.0, 0.0, 1.0]; CORNERS];
        for part in partition.parts(columns) {
            for corners in part.corners {
                // At the first angle alone, so that the slope does not vanish.
                scatter_vector(&unit, corners, (0, columns), part.forces);
            }
        }
        let mut of_one = vec![0.0; 3 * columns];
        of_one[0] = 1.0;
        let on_slope: Vec<f64> = (0..3 * columns).map(|i| f64::from(u8::from(i == 2 * columns))).collect();
        mesh.sectors.add_transposed(&VECTOR_PARITY, &on_slope, &mut of_one);
        let every_third: Vec<usize> = (0..mesh.node_count()).step_by(3).collect();
        let first = (0..partition.node_counts.len()).map(|part| part == 0).collect();
        for (active, elements) in [(partition.all(), mesh.elements.len()), (first, partition.size)] {
            let mut force = vec![f64::NAN; mesh.field_length(3)];
            partition.forces_on(&mesh.sectors, &every_third, &active, &mut force);
            for (node, force) in force.chunks_exact(3 * columns).enumerate() {
                if !node.is_multiple_of(3) {
                    assert!(force.iter().all(|f| f.is_nan()));
                    continue;
                }
                let corners = mesh.elements[..elements].iter().flat_map(|element| element.nodes);
                let count = corners.filter(|corner| *corner as usize == node).count() as f64;
                assert!(force.iter().zip(&of_one).all(|(f, one)| (f - count * one).abs() < 1e-12));
            }
        }
    }

    #[test]
    fn ranges_of_elements_cover_them() {
        let mesh = RevolvedMesh::new(MeridianMesh::new(MeshSize::new(0.1, 6)), Collocation::full(8));
        let partition = Partition::new(&mesh);
        let elements: Vec<u32> = (0..mesh.elements.len() as u32).step_by(7).collect();
        for (part, range) in partition.ranges_of(&elements).into_iter().enumerate() {
            assert!(elements[range].iter().all(|&e| e as usize / partition.size == part));
        }
        let lengths = partition.ranges_of(&elements).into_iter().map(|range| range.len());
        assert_eq!(lengths.sum::<usize>(), elements.len());
    }
}
