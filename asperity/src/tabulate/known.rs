//! Results by the coordinates of their cells, which stay when a grid gets more points.

use std::collections::HashMap;

use super::journal::{CellResult, Point};

/// Bits of initial temperature, interference and slip rate.
type Key = [u64; 3];

/// The results so far.
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

impl FromIterator<(Point, CellResult)> for Known {
    fn from_iter<I: IntoIterator<Item = (Point, CellResult)>>(results: I) -> Self {
        Self(results.into_iter().map(|(point, result)| (key(point), result)).collect())
    }
}

fn key(point: Point) -> Key {
    [point.temperature, point.interference, point.slip_rate].map(f64::to_bits)
}
