//! Files and figures that the package writes.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use tables::netcdf::{
    OutputError, check_irreplaceable, check_of_others, check_outputs, check_results, write_atomically,
};

use crate::errors;

/// Refuses an output that cannot be written, is one of the `inputs`, or, unless it is a table itself, would replace what
/// cannot be computed again.
#[pyfunction]
pub fn check_output(output: PathBuf, inputs: Vec<PathBuf>, is_table: bool) -> PyResult<()> {
    let inputs: Vec<(&str, &Path)> = inputs.iter().map(|path| ("an input of the result", &**path)).collect();
    let outputs = [("the output", &*output)];
    let irreplaceable = if is_table { check_of_others } else { check_irreplaceable };
    refused(check_outputs(&inputs, &outputs).and_then(|()| irreplaceable(&outputs)), &outputs)
}

/// The same of the files of a table with their roles.
pub fn distinct(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> PyResult<()> {
    refused(check_results(inputs, outputs).and_then(|()| check_of_others(outputs)), outputs)
}

fn refused(checked: Result<(), OutputError>, outputs: &[(&str, &Path)]) -> PyResult<()> {
    let file = outputs.first().map(|(_, path)| path.display().to_string());
    checked.map_err(|error| errors::input(&error, file.as_deref(), None, &error))
}

/// A figure of a result.
#[pyclass(frozen, module = "asperity._core")]
pub struct Figure(tables::figures::Figure);

impl Figure {
    /// With some of the panels, or with all.
    pub fn new(figure: tables::figures::Figure, panels: &[String]) -> PyResult<Self> {
        figure.only(panels).map(Self).map_err(|error| errors::refused("panels", error))
    }
}

#[pymethods]
impl Figure {
    fn svg(&self) -> String {
        self.0.svg()
    }

    fn save(&self, path: PathBuf) -> PyResult<()> {
        self.0.save(&path).map_err(|error| errors::refused("path", error))
    }
}

/// Writes a file that appears whole or not at all.
#[pyfunction]
pub fn write_bytes(path: PathBuf, content: &[u8]) -> PyResult<()> {
    let failed =
        |error: std::io::Error| errors::failed(format!("cannot write {}: {error}", path.display()), None);
    write_atomically(&path, content).map_err(failed)
}
