//! How the cells of a tabulation lie: interferences by slip rates, for each initial temperature.

use tables::table::Axes;

use super::journal::{Index, Point};
use crate::scene::Scene;
use crate::simulate::expected_time::expected_time;

/// The rows of cells are the interferences at the first temperature, then those at the next.
#[derive(Clone, Copy)]
pub struct Layout<'a> {
    /// Template of the scenes of each initial temperature.
    pub templates: &'a [Scene],
    pub axes: &'a Axes,
}

impl<'a> Layout<'a> {
    pub fn rows(&self) -> usize {
        self.templates.len() * self.axes.interference.len()
    }

    pub fn template(&self, row: usize) -> &'a Scene {
        &self.templates[row / self.axes.interference.len()]
    }

    pub fn interference(&self, row: usize) -> f64 {
        self.axes.interference[row % self.axes.interference.len()]
    }

    /// A cell by its coordinates.
    pub fn point(&self, (i, j): Index) -> Point {
        Point {
            temperature: self.template(i).loading.temperature,
            interference: self.interference(i),
            slip_rate: self.axes.slip_rate[j],
        }
    }

    /// Index of a cell, row-major.
    pub fn position(&self, (i, j): Index) -> usize {
        i * self.axes.slip_rate.len() + j
    }

    /// The cells, row-major.
    pub fn cells(&self) -> impl Iterator<Item = Index> {
        let columns = self.axes.slip_rate.len();
        (0..self.rows()).flat_map(move |i| (0..columns).map(move |j| (i, j)))
    }

    /// The rows, that of the largest interference first.
    pub fn order(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = (0..self.rows()).collect();
        rows.sort_by(|a, b| self.interference(*b).total_cmp(&self.interference(*a)));
        rows
    }

    /// The scene of a cell.
    pub fn scene(&self, (i, j): Index) -> Scene {
        let mut scene = self.template(i).clone();
        scene.loading.interference = self.interference(i);
        scene.loading.slip_rate = self.axes.slip_rate[j];
        scene
    }

    /// Expected times of the cells, row-major, s.
    pub fn expected_times(&self) -> Vec<f64> {
        self.cells().map(|at| expected_time(&self.scene(at))).collect()
    }
}
