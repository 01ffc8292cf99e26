//! Journal of a tabulation: each finished cell is one line with a checksum, written through
//! to the disk, so that a crash loses only the cells under way.
//!
//! A line is the CRC-32 of the rest, a space, and JSON. The first line is the request. A
//! line that was cut off or damaged is passed over and its cell computed again.
//!
//! The journal is locked while it is open, so that only one program makes the table.

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};
use tables::quantity::Quantity;
use tables::table::Cell;

use super::cell::Finished;
use super::shard::Shard;
use crate::output::journal_file::{JournalFile, decode};
use crate::output::provenance::{FINGERPRINT, SOURCE};
use crate::solver::timings::Timings;

/// Cell of the grid: index of the row (the interference; at several initial temperatures those of the
/// first, then those of the next) and of the slip rate.
pub type Index = (usize, usize);

/// A cell by its coordinates, which stay as they are when a grid gets more points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Initial temperature, K.
    pub temperature: f64,
    /// ω₀/ω_c.
    pub interference: f64,
    /// V, m/s.
    pub slip_rate: f64,
}

/// What became of a cell: its result, or why there is none.
pub type CellResult = Result<Finished, String>;

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// Unfinished work of an earlier run is in the way.
    #[error("{path}: unfinished table of an earlier run; continue it with --resume or delete it")]
    Exists {
        /// The journal.
        path: String,
    },
    /// The journal to continue belongs to another request or version.
    #[error("{path}: cannot be resumed: {reason}")]
    Foreign {
        /// The journal.
        path: String,
        /// What differs.
        reason: String,
    },
    /// Another program has it open.
    #[error("{path}: another program is making this table")]
    InUse {
        /// The journal.
        path: String,
    },
    /// Results would be written to a file that has been unlinked.
    #[error("{path}: was removed or replaced while the table was being made")]
    Vanished {
        /// The journal.
        path: String,
    },
    /// The disk has no space for the results.
    #[error("{path}: no room for {cells} results, about {kilobytes} kB: {source}")]
    NoRoom {
        /// The journal.
        path: String,
        /// Number of results to come.
        cells: usize,
        /// Space that they need at most.
        kilobytes: usize,
        /// What the system said.
        source: io::Error,
    },
    /// The system refused.
    #[error("{path}: {source}")]
    Io {
        /// The journal.
        path: String,
        /// What the system said.
        source: io::Error,
    },
}

#[derive(Serialize, Deserialize, PartialEq)]
struct Header {
    source: String,
    /// Of the program: another build of the version may give other numbers.
    #[serde(default)]
    fingerprint: String,
    #[serde(default)]
    shard: Option<String>,
    request: String,
}

#[derive(Serialize, Deserialize)]
struct Record {
    temperature: f64,
    interference: f64,
    slip_rate: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
    #[serde(default)]
    levelled: bool,
    /// Numbers as the hexadecimal digits of their bits: exact, and NaN has some too.
    #[serde(default)]
    numbers: String,
    #[serde(default)]
    notes: Vec<String>,
    #[serde(default)]
    warnings: Vec<String>,
}

/// An open journal.
pub struct Journal {
    file: JournalFile,
}

/// Space for a result with its warnings; one without takes about 5 kB.
const MOST_OF_A_LINE: usize = 8 << 10;

impl Journal {
    /// Open the journal at `path` for a `shard` of `request`: a new one, or with `resume` the one
    /// that is there, with the cells that it holds.
    pub fn open(
        path: &Path,
        request: &str,
        shard: Option<Shard>,
        resume: bool,
    ) -> Result<(Self, Vec<(Point, CellResult)>), JournalError> {
        let shown = || path.display().to_string();
        let io = |source| JournalError::Io { path: shown(), source };
        let header = Header {
            source: SOURCE.into(),
            fingerprint: FINGERPRINT.into(),
            shard: shard.map(|shard| shard.to_string()),
            request: request.into(),
        };
        if !resume && path.exists() {
            return Err(JournalError::Exists { path: shown() });
        }
        let (file, text) = JournalFile::open(path).map_err(|error| match error.kind() {
            io::ErrorKind::WouldBlock => JournalError::InUse { path: shown() },
            _ => io(error),
        })?;
        let mut lines = text.lines();
        let found = lines.next().and_then(decode::<Header>);
        if let Some(found) = &found
            && *found != header
        {
            let reason = differences(found, &header);
            return Err(JournalError::Foreign { path: shown(), reason });
        }
        let cells: Vec<_> = lines.filter_map(|line| decode::<Record>(line)?.into_cell()).collect();
        let mut journal = Self { file };
        if found.is_none() {
            if !cells.is_empty() {
                let reason = format!(
                    "its first line, the request, is damaged, and nothing else says what the {} results \
                     below it are of; delete it to start anew",
                    cells.len()
                );
                return Err(JournalError::Foreign { path: shown(), reason });
            }
            journal.file.clear().map_err(io)?;
            journal.append(&header)?;
        }
        Ok((journal, cells))
    }

    /// Reserves disk space for a number of further cells, where the system can, so that no result is lost
    /// to a full disk.
    pub fn reserve(&self, cells: usize) -> Result<(), JournalError> {
        let bytes = cells * MOST_OF_A_LINE;
        self.file.reserve(bytes).map_err(|source| JournalError::NoRoom {
            path: self.shown(),
            cells,
            kilobytes: bytes >> 10,
            source,
        })
    }

    fn shown(&self) -> String {
        self.file.path().display().to_string()
    }

    /// Write a finished cell through to the disk.
    pub fn record(&mut self, point: Point, result: &CellResult) -> Result<(), JournalError> {
        self.append(&Record::new(point, result))
    }

    /// Remove the journal once its table is written.
    pub fn remove(self) -> Result<(), JournalError> {
        let path = self.shown();
        self.file.remove().map_err(|source| JournalError::Io { path, source })
    }

    fn append(&mut self, value: &impl Serialize) -> Result<(), JournalError> {
        self.file.append(value).map_err(|source| match source.kind() {
            io::ErrorKind::NotFound => JournalError::Vanished { path: self.shown() },
            _ => JournalError::Io { path: self.shown(), source },
        })
    }
}

/// The first line in which two headers differ.
fn differences(found: &Header, asked: &Header) -> String {
    if found.source != asked.source {
        return format!("it was written by {}, this is {}", found.source, asked.source);
    }
    if found.fingerprint != asked.fingerprint {
        return format!(
            "it was written by another build of {} (fingerprint {}), this one ({}) may give other numbers",
            asked.source, found.fingerprint, asked.fingerprint
        );
    }
    if found.shard != asked.shard {
        let name =
            |shard: &Option<String>| shard.clone().map_or("the whole table".into(), |k| format!("shard {k}"));
        return format!("it is of {}, not of {}", name(&found.shard), name(&asked.shard));
    }
    let mut lines = found.request.lines().zip(asked.request.lines());
    match lines.find(|(found, asked)| found != asked) {
        Some((found, asked)) => format!("it has \"{found}\", the request \"{asked}\""),
        None => "it belongs to another request".into(),
    }
}

impl Record {
    fn new(Point { temperature, interference, slip_rate }: Point, result: &CellResult) -> Self {
        let empty = Self {
            temperature,
            interference,
            slip_rate,
            failure: None,
            levelled: false,
            numbers: String::new(),
            notes: Vec::new(),
            warnings: Vec::new(),
        };
        match result {
            Err(reason) => Self { failure: Some(reason.clone()), ..empty },
            Ok(finished) => Self {
                levelled: finished.cell.steady,
                numbers: numbers(&finished.cell),
                notes: finished.notes.clone(),
                warnings: finished.warnings.clone(),
                ..empty
            },
        }
    }

    fn into_cell(self) -> Option<(Point, CellResult)> {
        let Self { temperature, interference, slip_rate, .. } = self;
        let point = Point { temperature, interference, slip_rate };
        if let Some(reason) = self.failure {
            return Some((point, Err(reason)));
        }
        let numbers = from_hexadecimal(&self.numbers)?;
        let (wall_time, numbers) = numbers.split_first()?;
        let (scalars, histories) = numbers.split_at_checked(2 * Quantity::SCALARS.len())?;
        let count = Quantity::TABLE_HISTORIES.len();
        if histories.is_empty() || histories.len() % count != 0 {
            return None;
        }
        let mut cell = Cell::new();
        cell.steady = self.levelled;
        cell.wall_time = *wall_time;
        for (quantity, pair) in Quantity::SCALARS.into_iter().zip(scalars.chunks_exact(2)) {
            cell = cell.with(quantity, pair[0], pair[1]);
        }
        let histories = histories.chunks_exact(histories.len() / count);
        for (quantity, history) in Quantity::TABLE_HISTORIES.into_iter().zip(histories) {
            cell = cell.with_history(quantity, history.to_vec());
        }
        let finished =
            Finished { cell, timings: Timings::default(), notes: self.notes, warnings: self.warnings };
        Some((point, Ok(finished)))
    }
}

fn numbers(cell: &Cell) -> String {
    let scalars = Quantity::SCALARS.into_iter().flat_map(|q| [cell[q].value, cell[q].error]);
    let histories = Quantity::TABLE_HISTORIES.into_iter().flat_map(|q| cell.history(q));
    std::iter::once(cell.wall_time)
        .chain(scalars)
        .chain(histories.copied())
        .map(|number| format!("{:016x}", number.to_bits()))
        .collect()
}

fn from_hexadecimal(text: &str) -> Option<Vec<f64>> {
    let digits = |chunk: &[u8]| {
        let text = std::str::from_utf8(chunk).ok()?;
        Some(f64::from_bits(u64::from_str_radix(text, 16).ok()?))
    };
    text.as_bytes().chunks(16).map(digits).collect()
}

#[cfg(test)]
mod tests;
