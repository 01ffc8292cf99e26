//! What is kept of each run of the study: one line of JSON in a journal, so that the study can be
//! interrupted, and its estimates be judged anew without running anything again.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use super::Role;
use crate::loading::press::Increment;
use crate::loading::slide::SlideState;
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
    /// Interference, load, area.
    press: Vec<[f64; 3]>,
    /// Slip, friction, load, area, stick fraction, work, elastic energy, largest and mean rise.
    slide: Vec<[f64; 9]>,
    /// Why there is no result.
    pub failure: Option<String>,
}

impl Record {
    pub fn new(scene: usize, role: Role, wall_time: f64, result: Result<Sample, String>) -> Self {
        let (sample, failure) = match result {
            Ok(sample) => (sample, None),
            Err(reason) => (Sample { press: Vec::new(), history: Vec::new() }, Some(reason)),
        };
        let slide = |i: &SlideState| {
            let energies = [i.work, i.elastic];
            [
                i.slip,
                i.friction,
                i.load,
                i.area,
                i.stick_fraction,
                energies[0],
                energies[1],
                i.rise_max,
                i.rise_mean,
            ]
        };
        Self {
            scene,
            role,
            fingerprint: FINGERPRINT.to_owned(),
            wall_time,
            press: sample.press.iter().map(|i| [i.interference, i.load, i.area]).collect(),
            slide: sample.history.iter().map(slide).collect(),
            failure,
        }
    }

    /// The run, unless it failed. What scalars do not need is zero.
    pub fn sample(&self) -> Option<Sample> {
        if self.slide.is_empty() || self.press.is_empty() {
            return None;
        }
        let increment = |&[interference, load, area]: &[f64; 3]| Increment { interference, load, area };
        let instant =
            |&[slip, friction, load, area, stick_fraction, work, elastic, rise_max, rise_mean]: &[f64; 9]| {
                SlideState {
                    slip,
                    friction,
                    load,
                    area,
                    stick_fraction,
                    work,
                    elastic,
                    rise_max,
                    rise_mean,
                    ..SlideState::default()
                }
            };
        Some(Sample {
            press: self.press.iter().map(increment).collect(),
            history: self.slide.iter().map(instant).collect(),
        })
    }
}

/// The journal: records are appended as they are made.
pub struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Opens or makes the journal; what it holds already is returned. A line that was cut off is
    /// passed over.
    pub fn open(path: &Path) -> io::Result<(Self, Vec<Record>)> {
        let mut file = OpenOptions::new().create(true).read(true).append(true).open(path)?;
        let lines = BufReader::new(&file).lines().collect::<io::Result<Vec<_>>>()?;
        let records = lines.iter().filter_map(|line| serde_json::from_str(line).ok()).collect();
        // After a line that was cut off the next one must not continue it.
        if lines.last().is_some_and(|line| serde_json::from_str::<Record>(line).is_err()) {
            writeln!(file)?;
        }
        Ok((Self { path: path.to_path_buf(), file: Mutex::new(file) }, records))
    }

    pub fn append(&self, record: &Record) -> io::Result<()> {
        let json = serde_json::to_string(record)?;
        let mut file = self.file.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        writeln!(file, "{json}")?;
        file.flush()
    }

    pub fn path(&self) -> &Path {
        &self.path
    }
}
