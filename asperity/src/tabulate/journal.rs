//! Journal of a tabulation: each finished cell is one line with a checksum, written through
//! to the disk, so that a crash loses only the cells under way.
//!
//! A line is the CRC-32 of the rest, a space, and JSON. The first line is the request. A
//! line that was cut off or damaged is passed over and its cell computed again.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use tables::quantity::Quantity;
use tables::table::Cell;

use super::cell::Finished;
use super::shard::Shard;
use crate::provenance::{FINGERPRINT, SOURCE};
use crate::timings::Timings;

/// Cell of the grid: index of the interference and of the slip rate.
pub type Index = (usize, usize);

/// A cell by its coordinates, which stay as they are when a grid gets more points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
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
    /// Of the program: one of the same version may do other physics.
    #[serde(default)]
    fingerprint: String,
    #[serde(default)]
    shard: Option<String>,
    request: String,
}

#[derive(Serialize, Deserialize)]
struct Record {
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
    path: PathBuf,
    file: File,
}

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
        let text = match std::fs::read(path) {
            Ok(_) if !resume => return Err(JournalError::Exists { path: shown() }),
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(io(error)),
        };
        let mut lines = text.lines();
        let found = lines.next().and_then(decode::<Header>);
        if let Some(found) = &found
            && *found != header
        {
            let reason = differences(found, &header);
            return Err(JournalError::Foreign { path: shown(), reason });
        }
        let mut options = OpenOptions::new();
        // Without a readable header nothing in the file can be trusted.
        let options = match found {
            Some(_) => options.append(true),
            None => options.write(true).create(true).truncate(true),
        };
        let mut journal = Self { path: path.to_owned(), file: options.open(path).map_err(io)? };
        if found.is_none() {
            journal.append(&header)?;
            return Ok((journal, Vec::new()));
        }
        if !text.ends_with('\n') {
            // Keep the next line apart from the one that was cut off.
            journal.file.write_all(b"\n").map_err(io)?;
        }
        let cells = lines.filter_map(|line| decode::<Record>(line)?.into_cell()).collect();
        Ok((journal, cells))
    }

    /// Write a finished cell through to the disk.
    pub fn record(&mut self, point: Point, result: &CellResult) -> Result<(), JournalError> {
        self.append(&Record::new(point, result))
    }

    /// Remove the journal once its table is written.
    pub fn remove(self) -> Result<(), JournalError> {
        std::fs::remove_file(&self.path)
            .map_err(|source| JournalError::Io { path: self.path.display().to_string(), source })
    }

    fn append(&mut self, value: &impl Serialize) -> Result<(), JournalError> {
        let json = serde_json::to_string(value).expect("plain data");
        let line = format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes()));
        self.file
            .write_all(line.as_bytes())
            .and_then(|()| self.file.sync_data())
            .map_err(|source| JournalError::Io { path: self.path.display().to_string(), source })
    }
}

fn decode<T: for<'a> Deserialize<'a>>(line: &str) -> Option<T> {
    let (checksum, json) = line.split_once(' ')?;
    let checksum = u32::from_str_radix(checksum, 16).ok()?;
    let intact = checksum == crc32fast::hash(json.as_bytes());
    intact.then(|| serde_json::from_str(json).ok()).flatten()
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
    fn new(Point { interference, slip_rate }: Point, result: &CellResult) -> Self {
        let empty = Self {
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
                levelled: finished.cell.levelled,
                numbers: numbers(&finished.cell),
                notes: finished.notes.clone(),
                warnings: finished.warnings.clone(),
                ..empty
            },
        }
    }

    fn into_cell(self) -> Option<(Point, CellResult)> {
        let point = Point { interference: self.interference, slip_rate: self.slip_rate };
        if let Some(reason) = self.failure {
            return Some((point, Err(reason)));
        }
        let numbers = from_hexadecimal(&self.numbers)?;
        let (wall_time, numbers) = numbers.split_first()?;
        let (scalars, histories) = numbers.split_at_checked(2 * Quantity::ALL.len())?;
        let count = Quantity::HISTORIES.len();
        if histories.is_empty() || histories.len() % count != 0 {
            return None;
        }
        let mut cell = Cell::new();
        cell.levelled = self.levelled;
        cell.wall_time = *wall_time;
        for (quantity, pair) in Quantity::ALL.into_iter().zip(scalars.chunks_exact(2)) {
            cell = cell.with(quantity, pair[0], pair[1]);
        }
        let histories = histories.chunks_exact(histories.len() / count);
        for (quantity, history) in Quantity::HISTORIES.into_iter().zip(histories) {
            cell = cell.with_history(quantity, history.to_vec());
        }
        let finished =
            Finished { cell, timings: Timings::default(), notes: self.notes, warnings: self.warnings };
        Some((point, Ok(finished)))
    }
}

fn numbers(cell: &Cell) -> String {
    let scalars = Quantity::ALL.into_iter().flat_map(|q| [cell[q].value, cell[q].error]);
    let histories = Quantity::HISTORIES.into_iter().flat_map(|q| cell.history(q));
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
mod tests {
    use super::*;
    use crate::fake::{self, Fake};
    use crate::tabulate::cell::slip_grid;

    fn at(interference: f64, slip_rate: f64) -> Point {
        Point { interference, slip_rate }
    }

    fn finished() -> Finished {
        let mut outcome = Fake::outcome(&fake::scene(20.0, 1.0));
        outcome.summary.mu.error = f64::NAN;
        outcome.account.wall_time = 0.1 + 0.2;
        Finished::new(&outcome, &slip_grid(2.0), 298.0)
    }

    #[test]
    fn cells_come_back_bit_for_bit() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.nc.part");
        let (mut journal, found) = Journal::open(&path, "a = 1\n", None, false).unwrap();
        assert!(found.is_empty());
        journal.record(at(0.1 + 0.2, 2e-7), &Ok(finished())).unwrap();
        journal.record(at(100.0, 0.0), &Err("did not\nconverge".into())).unwrap();
        let (_, found) = Journal::open(&path, "a = 1\n", None, true).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].0, at(0.1 + 0.2, 2e-7));
        let cell = found[0].1.as_ref().unwrap();
        assert_eq!(cell, &finished());
        assert_eq!(numbers(&cell.cell), numbers(&finished().cell));
        assert_eq!(found[1], (at(100.0, 0.0), Err("did not\nconverge".into())));
    }

    #[test]
    fn a_cut_or_damaged_line_loses_only_its_cell() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.nc.part");
        let (mut journal, _) = Journal::open(&path, "a = 1\n", None, false).unwrap();
        for k in 0..3 {
            journal.record(at(f64::from(k), 0.0), &Err(format!("reason {k}"))).unwrap();
        }
        let whole = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, &whole[..whole.len() - 5]).unwrap();
        let (mut journal, found) = Journal::open(&path, "a = 1\n", None, true).unwrap();
        assert_eq!(found.len(), 2);
        journal.record(at(2.0, 0.0), &Err("again".into())).unwrap();
        let (_, found) = Journal::open(&path, "a = 1\n", None, true).unwrap();
        assert_eq!(found[2], (at(2.0, 0.0), Err("again".into())));

        std::fs::write(&path, whole.replace("reason 1", "reason 7")).unwrap();
        let (_, found) = Journal::open(&path, "a = 1\n", None, true).unwrap();
        let points: Vec<Point> = found.iter().map(|(point, _)| *point).collect();
        assert_eq!(points, [at(0.0, 0.0), at(2.0, 0.0)]);
    }

    #[test]
    fn other_requests_and_unasked_continuations_are_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.nc.part");
        Journal::open(&path, "a = 1\nb = 2\n", None, false).unwrap();
        let refused = |request: &str, resume: bool| {
            let error = Journal::open(&path, request, None, resume).err().unwrap();
            error.to_string()
        };
        assert!(refused("a = 1\nb = 2\n", false).contains("--resume"));
        assert!(refused("a = 1\nb = 3\n", true).contains("\"b = 2\""));
        let shard = "2/3".parse().ok();
        let error = Journal::open(&path, "a = 1\nb = 2\n", shard, true).err().unwrap().to_string();
        assert!(error.contains("it is of the whole table, not of shard 2/3"), "{error}");
    }

    #[test]
    fn a_journal_of_another_build_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.nc.part");
        let refused = |header: &Header| {
            let json = serde_json::to_string(header).unwrap();
            std::fs::write(&path, format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes()))).unwrap();
            match Journal::open(&path, "a = 1\n", None, true) {
                Ok(_) => String::new(),
                Err(error) => error.to_string(),
            }
        };
        let mut header = Header {
            source: SOURCE.into(),
            fingerprint: FINGERPRINT.into(),
            shard: None,
            request: "a = 1\n".into(),
        };
        assert_eq!(refused(&header), "");
        header.fingerprint = "0123456789abcdef".into();
        let message = refused(&header);
        assert!(message.contains("another build") && message.contains(FINGERPRINT), "{message}");
        header.fingerprint = String::new();
        assert!(refused(&header).contains("another build"));
        header.source = "asperity 0.0.9".into();
        assert!(refused(&header).contains("asperity 0.0.9"));
    }

    #[test]
    fn resuming_without_a_journal_starts_one() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.nc.part");
        assert!(Journal::open(&path, "a = 1\n", None, true).unwrap().1.is_empty());
        // The header itself was cut off.
        std::fs::write(&path, "0123").unwrap();
        assert!(Journal::open(&path, "a = 1\n", None, true).unwrap().1.is_empty());
        assert!(Journal::open(&path, "a = 1\n", None, true).unwrap().1.is_empty());
    }
}
