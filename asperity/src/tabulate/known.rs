//! Results by the coordinates of their cells, which outlive a change of the grid.

use std::collections::HashMap;

use super::journal::{CellResult, Point};

/// What has been run so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known(HashMap<(u64, u64), CellResult>);

impl Known {
    pub fn insert(&mut self, point: Point, result: CellResult) {
        self.0.insert(key(point), result);
    }

    pub fn get(&self, point: Point) -> Option<&CellResult> {
        self.0.get(&key(point))
    }
}

/// The numbers bit for bit: they are read as they were written.
fn key(point: Point) -> (u64, u64) {
    (point.interference.to_bits(), point.slip_rate.to_bits())
}
