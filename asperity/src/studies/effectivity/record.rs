//! Record of each run of the study: the study can be interrupted, and its estimates can be evaluated again without
//! repeating runs.

use std::io;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};

use super::Role;
use crate::output::journal_file::{JournalFile, decode};
use crate::output::provenance::FINGERPRINT;
use crate::simulate::Sample;

/// One run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Record {
    /// Position in [`super::scenes::SCENES`].
    pub scene: usize,
    pub role: Role,
    /// Of the build that ran it.
    pub fingerprint: String,
    /// s, of this run alone on one thread.
    pub wall_time: f64,
    pub sample: Option<Sample>,
    /// Why there is no result.
    pub failure: Option<String>,
}

impl Record {
    pub fn new(scene: usize, role: Role, wall_time: f64, result: Result<Sample, String>) -> Self {
        let (sample, failure) = match result {
            Ok(sample) => (Some(sample), None),
            Err(reason) => (None, Some(reason)),
        };
        Self { scene, role, fingerprint: FINGERPRINT.to_owned(), wall_time, sample, failure }
    }
}

/// The journal: records are appended as they are made.
pub struct Journal {
    file: Mutex<JournalFile>,
}

impl Journal {
    /// Opens or makes the journal; its records are returned.
    pub fn open(path: &Path) -> io::Result<(Self, Vec<Record>)> {
        let (file, text) = JournalFile::open(path)?;
        Ok((Self { file: Mutex::new(file) }, text.lines().filter_map(decode).collect()))
    }

    pub fn append(&self, record: &Record) -> io::Result<()> {
        self.file.lock().unwrap_or_else(PoisonError::into_inner).append(record)
    }
}
