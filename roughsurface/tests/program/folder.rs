//! A folder in which the program is run.

use crate::demonstration::{Weakening, table};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tables::netcdf::DatasetReader;

/// A topography that comes with the tests.
pub fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// A surface file of Gaussian summits with that density (1/m²), radius and standard deviation (m), and the lines of its query.
pub fn surface(density: f64, radius: f64, std: f64, query: &str) -> String {
    format!(
        "[surface]\nasperity_density = {density:e}\nasperity_radius = {radius:e}\n\
         heights = {{ distribution = \"gaussian\", std = {std:e} }}\n[query]\n{query}\n"
    )
}

/// The section of a surface file with the material of closed forms, that of the demonstration.
pub const MATERIAL: &str =
    "[material]\nyoungs_modulus = 200e9\npoisson_ratio = 0.3\nyield_strength = 400e6\n";

/// A folder for one test, removed at its end.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// With the file surface.toml.
    pub fn with(surface: &str) -> Self {
        let folder = Self::new();
        folder.write("surface.toml", surface);
        folder
    }

    /// The same with table.nc, a table of asperities that weaken with the slip rate.
    pub fn with_table(surface: &str) -> Self {
        let folder = Self::with(surface);
        table(&Weakening::new()).write(&folder.path("table.nc")).unwrap();
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file, for a name or a number of text or bytes.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn dataset(&self, name: &str) -> DatasetReader {
        DatasetReader::open(&self.path(name)).unwrap()
    }

    /// Runs the program with arguments separated by white space.
    pub fn run(&self, arguments: &str) -> Output {
        program(self.0.path()).args(arguments.split_whitespace()).output().unwrap()
    }

    /// Runs the program, which must succeed.
    pub fn run_well(&self, arguments: &str) -> Output {
        let output = self.run(arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        output
    }

    /// Runs the program, which must refuse its input in one line with `expected` in it.
    pub fn refused(&self, arguments: &str, expected: &str) {
        let message = self.misused(arguments, expected);
        assert_eq!(message.lines().count(), 1, "{arguments}: {message}");
    }

    /// Runs the program, which must refuse its arguments with `expected` in the message; returns that.
    pub fn misused(&self, arguments: &str, expected: &str) -> String {
        let output = self.run(arguments);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
        assert!(message.contains(expected), "{arguments}: {message}");
        message
    }
}

/// The program, to be run in `folder`.
pub fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_roughsurface"));
    // Programs started by tests that run at the same time inherit the lock of a table that this one is
    // writing.
    command.current_dir(folder).env("HDF5_USE_FILE_LOCKING", "FALSE");
    command
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap()
}
