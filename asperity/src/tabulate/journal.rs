//! Journal of a tabulation: each finished cell is one line with a checksum, written through
//! to the disk, so that a crash loses unfinished cells only.
//!
//! A line is the CRC-32 of the rest, a space, and JSON. The first line is the request; every other line carries the
//! checksum of the request. A line that was cut off or damaged is passed over and its cell computed again. A file
//! that is not a journal of the request is left as it is.
//!
//! The journal is locked while it is open, so that only one program makes the table.

mod record;

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use tables::netcdf::{JOURNAL, destination, in_words};
use tables::table::comparison::{OfKey, request_differences};
use tables::table::{Status, Table};

use super::cell::Finished;
use super::shard::Shard;
use crate::output::journal_file::{JournalFile, decode, encode};
use crate::output::provenance::{FINGERPRINT, SOURCE};
use record::Record;

/// Cell of the grid: index of the row (the interference; at several initial temperatures those of the
/// first, then those of the next) and of the slip rate.
pub type Index = (usize, usize);

/// A cell by its coordinates, which stay as they are when a grid gets more points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Initial temperature, K.
    pub temperature: f64,
    /// ω₀/ω_c.
    pub interference: f64,
    /// V, m/s.
    pub slip_rate: f64,
}

impl Point {
    /// Bits of the coordinates, by which points are compared.
    pub(super) fn key(self) -> [u64; 3] {
        [self.temperature, self.interference, self.slip_rate].map(f64::to_bits)
    }
}

/// Results so far by [`Point::key`].
pub(super) type Known = HashMap<[u64; 3], CellResult>;

/// Result of a cell, or the reason of its failure.
pub type CellResult = Result<Finished, String>;

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}", .path.display())]
pub struct JournalError {
    /// The journal.
    path: PathBuf,
    fault: Fault,
}

#[derive(Debug, thiserror::Error)]
enum Fault {
    #[error("unfinished table of an earlier run; continue it with --resume or delete it")]
    Exists,
    /// The journal belongs to another request or build; what differs.
    #[error("cannot be resumed: {0}; delete it, or choose another name with --output")]
    Foreign(String),
    #[error(
        "is not a journal of this table, but has its name; move it away or choose another name with --output"
    )]
    Unknown,
    #[error("is a symbolic link; the journal of finished cells needs a file of its own, remove the link")]
    Link,
    #[error("another program is making this table")]
    InUse,
    /// Results would be written to a file that has been unlinked.
    #[error("was removed or replaced while the table was being made")]
    Vanished,
    #[error("no room for {cells} results, about {kilobytes} kB: {source}")]
    NoRoom { cells: usize, kilobytes: usize, source: io::Error },
    #[error("{0}")]
    Io(io::Error),
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::Io(in_words(error))
    }
}

impl JournalError {
    fn new(path: &Path, fault: impl Into<Fault>) -> Self {
        Self { path: path.to_owned(), fault: fault.into() }
    }

    /// Whether the system failed; otherwise the journal belongs to another request.
    pub fn is_of_the_system(&self) -> bool {
        matches!(self.fault, Fault::Vanished | Fault::NoRoom { .. } | Fault::Io(_))
    }
}

#[derive(Serialize, Deserialize, PartialEq)]
struct Header {
    source: String,
    /// Fingerprint of the program: another build of the version may give other numbers.
    fingerprint: String,
    shard: Option<String>,
    request: String,
}

/// An open journal.
pub struct Journal {
    file: JournalFile,
    /// Checksum of the header.
    header: u32,
}

/// Space for a result with its warnings; one without takes about 5 kB.
const MOST_OF_A_LINE: usize = 8 << 10;

impl Journal {
    /// Path of the journal of a table to be written to `output`: beside the file, whatever links lead to it.
    pub fn beside(output: &Path) -> PathBuf {
        let output = destination(output);
        let mut name = output.file_name().unwrap_or_default().to_owned();
        name.push(JOURNAL);
        output.with_file_name(name)
    }

    /// Open the journal at `path` for a `shard` of `request`: a new one, or with `resume` the one
    /// that is there, with the cells that it holds.
    pub fn open(
        path: &Path,
        request: &str,
        shard: Option<Shard>,
        resume: bool,
    ) -> Result<(Self, Vec<(Point, CellResult)>), JournalError> {
        let fault = |fault: Fault| JournalError::new(path, fault);
        let io = |error: io::Error| JournalError::new(path, error);
        let header = Header {
            source: SOURCE.into(),
            fingerprint: FINGERPRINT.into(),
            shard: shard.map(|shard| shard.to_string()),
            request: request.into(),
        };
        if path.is_symlink() {
            return Err(fault(Fault::Link));
        }
        let existed = path.exists();
        let (file, text) = JournalFile::open(path).map_err(|error| match error.kind() {
            io::ErrorKind::WouldBlock => fault(Fault::InUse),
            _ => io(error),
        })?;
        let first_line = encode(&header).map_err(io)?;
        let mut journal = Self { file, header: crc32fast::hash(first_line.as_bytes()) };
        let mut lines = text.lines();
        let found = lines.next().and_then(decode::<Header>);
        let record = |line| decode::<Record>(line)?.into_result(journal.header);
        let cells: Vec<_> = lines.filter_map(record).collect();
        // A crash may have cut the first line itself.
        let begun = found.is_none() && first_line.starts_with(&text);
        match &found {
            None if cells.is_empty() && !begun => return Err(fault(Fault::Unknown)),
            Some(found) if *found != header => {
                return Err(fault(Fault::Foreign(differences(found, &header))));
            }
            _ if existed && !resume => return Err(fault(Fault::Exists)),
            _ => {}
        }
        if begun {
            journal.file.clear().map_err(io)?;
            journal.append(&header)?;
        }
        Ok((journal, cells))
    }

    /// A journal at `path`, where there is none, of the cells that a `table` of the whole `request` has, in place of the
    /// journals that they were in.
    pub fn of_table(path: &Path, request: &str, table: &Table) -> Result<(), JournalError> {
        let (mut journal, _) = Self::open(path, request, None, false)?;
        for slice in table.slices() {
            for (i, j) in slice.grid() {
                let (interference, slip_rate) = slice.coordinates(i, j);
                let temperature = slice.metadata().temperature;
                let result = match slice.status(i, j) {
                    Status::NotRun => continue,
                    Status::Failed(reason) => Err(reason.clone()),
                    Status::Done(cell) => Ok(Finished::of_table(cell)),
                };
                journal.record(Point { temperature, interference, slip_rate }, &result)?;
            }
        }
        Ok(())
    }

    /// Reserves disk space for a number of further cells, where the system can, so that no result is lost
    /// to a full disk.
    pub fn reserve(&self, cells: usize) -> Result<(), JournalError> {
        let bytes = cells * MOST_OF_A_LINE;
        let no_room =
            |error| self.error(Fault::NoRoom { cells, kilobytes: bytes >> 10, source: in_words(error) });
        self.file.reserve(bytes).map_err(no_room)
    }

    fn error(&self, fault: impl Into<Fault>) -> JournalError {
        JournalError::new(self.file.path(), fault)
    }

    /// Write a finished cell through to the disk.
    pub fn record(&mut self, point: Point, result: &CellResult) -> Result<(), JournalError> {
        self.append(&Record::new(self.header, point, result))
    }

    /// Remove the journal once its table is written.
    pub fn remove(self) -> Result<(), JournalError> {
        let path = self.file.path().to_owned();
        self.file.remove().map_err(|error| JournalError::new(&path, error))
    }

    fn append(&mut self, value: &impl Serialize) -> Result<(), JournalError> {
        self.file.append(value).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => self.error(Fault::Vanished),
            _ => self.error(error),
        })
    }
}

/// The first of the differences of two headers.
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
    match &request_differences(&found.request, &asked.request)[..] {
        [OfKey { key, here, there }, ..] => format!("of {key} it has {here}, the request {there}"),
        [] => "it belongs to another request".into(),
    }
}

#[cfg(test)]
mod tests;
