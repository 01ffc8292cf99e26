//! Results by the coordinates of their cells, which outlive a change of the grid.

use std::collections::HashMap;

use super::journal::{CellResult, Point};

/// Initial temperature, interference and slip rate.
type Key = (Option<u64>, u64, u64);

/// What has been run so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known(HashMap<Key, CellResult>);

impl Known {
    pub fn insert(&mut self, point: Point, result: CellResult) {
        self.0.insert(key(point), result);
    }

    pub fn get(&self, point: Point) -> Option<&CellResult> {
        self.0.get(&key(point))
    }
}

/// The numbers bit for bit: they are read as they were written.
fn key(point: Point) -> Key {
    (point.temperature.map(f64::to_bits), point.interference.to_bits(), point.slip_rate.to_bits())
}
