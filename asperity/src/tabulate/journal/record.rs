//! A cell as a line of a journal.

use serde::{Deserialize, Serialize};
use tables::quantity::Quantity;
use tables::table::Cell;

use super::{CellResult, Point};
use crate::tabulate::cell::Finished;

#[derive(Serialize, Deserialize)]
pub struct Record {
    /// Checksum of the header: which request the result is of, should the first line be damaged.
    header: u32,
    point: Point,
    result: Result<RecordedCell, String>,
}

#[derive(Serialize, Deserialize)]
struct RecordedCell {
    steady: bool,
    /// Wall time, scalars with errors, and histories, each number as the hexadecimal digits of its bits:
    /// exact, and NaN can be written.
    numbers: String,
    notes: Vec<String>,
    warnings: Vec<String>,
}

impl Record {
    pub fn new(header: u32, point: Point, result: &CellResult) -> Self {
        let recorded = |finished: &Finished| RecordedCell {
            steady: finished.cell.steady,
            numbers: hexadecimal(&finished.cell),
            notes: finished.notes.clone(),
            warnings: finished.cell.warnings.clone(),
        };
        Self { header, point, result: result.as_ref().map(recorded).map_err(Clone::clone) }
    }

    /// Result of the line; none for a line that is not complete, or of another request.
    pub fn into_result(self, header: u32) -> Option<(Point, CellResult)> {
        if self.header != header {
            return None;
        }
        let result = match self.result {
            Err(reason) => Err(reason),
            Ok(recorded) => Ok(recorded.into_finished()?),
        };
        Some((self.point, result))
    }
}

impl RecordedCell {
    fn into_finished(self) -> Option<Finished> {
        let numbers = from_hexadecimal(&self.numbers)?;
        let (wall_time, numbers) = numbers.split_first()?;
        let (scalars, histories) = numbers.split_at_checked(2 * Quantity::SCALARS.len())?;
        let count = Quantity::TABLE_HISTORIES.len();
        if histories.is_empty() || histories.len() % count != 0 {
            return None;
        }
        let mut cell = Cell { steady: self.steady, wall_time: *wall_time, ..Cell::default() };
        for (quantity, pair) in Quantity::SCALARS.into_iter().zip(scalars.chunks_exact(2)) {
            cell = cell.with(quantity, pair[0], pair[1]);
        }
        let histories = histories.chunks_exact(histories.len() / count);
        for (quantity, history) in Quantity::TABLE_HISTORIES.into_iter().zip(histories) {
            cell = cell.with_history(quantity, history.to_vec());
        }
        cell.warnings = self.warnings;
        Some(Finished { notes: self.notes, ..Finished::of_table(&cell) })
    }
}

pub(super) fn hexadecimal(cell: &Cell) -> String {
    let scalars = cell.scalars.iter().flat_map(|(_, estimate)| [estimate.value, estimate.error]);
    let histories = cell.histories.iter().flat_map(|(_, history)| history.iter().copied());
    let numbers = std::iter::once(cell.wall_time).chain(scalars).chain(histories);
    numbers.map(|number| format!("{:016x}", number.to_bits())).collect()
}

fn from_hexadecimal(text: &str) -> Option<Vec<f64>> {
    let digits = |chunk: &[u8]| {
        let text = std::str::from_utf8(chunk).ok()?;
        Some(f64::from_bits(u64::from_str_radix(text, 16).ok()?))
    };
    text.as_bytes().chunks(16).map(digits).collect()
}
