//! How the cells of a tabulation lie: interferences by slip rates, for each initial temperature.

use tables::closed_forms::hertz;
use tables::table::Axes;

use super::cost::{Case, CostModel};
use super::journal::{Index, Point};
use crate::heat::expected::{HeatEffect, choose_heat};
use crate::scene::Scene;

/// From this number of interferences on, one cell of the middle, of the smallest and of the largest are run first, so
/// that the dependence of run times on interference is known from the start.
const ROWS_WORTH_A_PROBE: usize = 4;

/// The rows of cells are the interferences at the first temperature, then those at the next.
#[derive(Clone, Copy)]
pub struct Layout<'a> {
    /// What the scenes of each initial temperature share.
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

    /// Place of a cell, row-major.
    pub fn position(&self, (i, j): Index) -> usize {
        i * self.axes.slip_rate.len() + j
    }

    /// The cell at a place.
    pub fn index(&self, position: usize) -> Index {
        let columns = self.axes.slip_rate.len();
        (position / columns, position % columns)
    }

    /// Of run times, before any is known.
    pub fn cost_model(&self) -> CostModel {
        let largest = self.axes.interference[self.axes.interference.len() - 1];
        CostModel::new(largest, self.axes.slip_rate.len())
    }

    /// The rows, that of the largest interference first.
    pub fn order(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = (0..self.rows()).collect();
        rows.sort_by(|a, b| self.interference(*b).total_cmp(&self.interference(*a)));
        rows
    }

    /// Rows of which one cell is run first, at the temperature in the middle.
    pub fn probes(&self) -> Vec<usize> {
        let count = self.axes.interference.len();
        let first = self.templates.len() / 2 * count;
        match count >= ROWS_WORTH_A_PROBE {
            true => probes(count).map(|row| first + row).to_vec(),
            false => Vec::new(),
        }
    }

    /// The scene of a cell.
    pub fn scene(&self, (i, j): Index) -> Scene {
        let mut scene = self.template(i).clone();
        scene.loading.interference = self.interference(i);
        scene.loading.slip_rate = self.axes.slip_rate[j];
        scene
    }

    /// The cells as far as their run times are concerned, row-major.
    pub fn cases(&self) -> Vec<Case> {
        let case = |row: usize, column: usize| {
            let scene = &self.template(row).with_combined_modulus();
            let critical = scene.material.elastic_plastic().critical_interference(scene.radius);
            let interference = self.interference(row);
            let radius = hertz::contact_radius(scene.radius, interference * critical);
            let slip_rate = self.axes.slip_rate[column];
            let effect = HeatEffect::expected(scene, slip_rate, radius);
            let heated = choose_heat(scene, slip_rate, &effect).is_coupled();
            Case { interference, column, heated }
        };
        let rows = 0..self.rows();
        rows.flat_map(|row| (0..self.axes.slip_rate.len()).map(move |column| case(row, column))).collect()
    }
}

/// Rows of which one cell is run first, of a number of rows.
pub fn probes(rows: usize) -> [usize; 3] {
    [rows / 2, 0, rows - 1]
}
