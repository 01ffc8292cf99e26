//! The preconditioner for forces on a part of the body alone.
//!
//! A forward sweep is zero outside the nodes that those with forces are eliminated into, and a backward sweep can omit
//! them while displacements are needed in that part alone. Conjugate gradients need the displacement of the whole body
//! once, at the end, as a sum of solutions: the sum is stored in harmonics and substituted back once.

use std::time::Instant;

use super::Preconditioner;
use crate::discretisation::runs::Runs;
use crate::solver::timings::{Kernel, Timings};

/// Directions of search for forces on some nodes.
pub struct Search {
    /// Nodes with forces.
    nodes: Vec<usize>,
    /// Positions outside the dense system that forward sweeps reach, and the remaining ones.
    within: Vec<u32>,
    beyond: Vec<u32>,
    /// Harmonics within, with those of the dense system.
    entries: Runs,
    /// The last solution, the direction of search and the sum of the steps in such directions.
    solution: Vec<f32>,
    direction: Vec<f32>,
    sum: Vec<f32>,
}

impl Search {
    /// Search with forces on `nodes` alone; the contact stiffness is that of the preconditioner.
    pub fn new(preconditioner: &Preconditioner, nodes: Vec<usize>) -> Self {
        let Preconditioner { single, positions, .. } = preconditioner;
        let mut marked = vec![false; single.positions_before(0).len()];
        nodes.iter().filter_map(|&node| single.position(node)).for_each(|position| marked[position] = true);
        single.close(&mut marked);
        let (within, beyond) = positions.iter().partition(|&&position| marked[position as usize]);
        let reached = (0..marked.len()).filter(|&position| marked[position]);
        let zeros = || vec![0.0; single.len()];
        Self {
            entries: Runs::of_blocks(reached, single.len() / marked.len()),
            nodes,
            within,
            beyond,
            solution: zeros(),
            direction: zeros(),
            sum: zeros(),
        }
    }

    /// `solution` = M⁻¹ `residual` on the nodes of the search.
    pub fn apply(
        &mut self,
        preconditioner: &Preconditioner,
        residual: &[f64],
        solution: &mut [f64],
        timings: &mut Timings,
    ) {
        self.entries.iter().for_each(|run| self.solution[run].fill(0.0));
        let nodes = self.nodes.iter().copied();
        preconditioner.sweep(nodes, &self.within, residual, (&mut self.solution, solution), timings);
    }

    /// New search direction: the last solution plus `rate` times the previous direction.
    pub fn turn(&mut self, rate: f64) {
        let rate = rate as f32;
        self.entries.update(&mut self.direction, &self.solution, |direction, solution| {
            *direction = solution + rate * *direction;
        });
    }

    /// Adds a step of this length in the search direction.
    pub fn step(&mut self, length: f64) {
        let length = length as f32;
        self.entries.update(&mut self.sum, &self.direction, |sum, direction| *sum += length * direction);
    }

    /// `solution` = the sum of the steps, over the whole body.
    pub fn finish(mut self, preconditioner: &Preconditioner, solution: &mut [f64], timings: &mut Timings) {
        let start = Instant::now();
        let Preconditioner { factors, single, .. } = preconditioner;
        single.backward(&mut self.sum, &self.beyond);
        single.store(factors, &self.sum, 0..single.nodes(), solution);
        timings.since(Kernel::Preconditioner, start);
    }
}
