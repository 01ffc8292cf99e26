//! `asperity.export`: friction for other programs.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use roughsurface::output::export::{self, ExportError, Format};

use crate::errors;

/// Friction over initial temperature, pressure and slip rate, of one file or several.
#[pyclass(frozen, module = "asperity._core")]
pub struct FrictionTable(export::FrictionTable);

/// Reads the files; with `law` the values are those of the fitted laws.
#[pyfunction]
pub fn friction_table(py: Python<'_>, paths: Vec<PathBuf>, law: bool) -> PyResult<FrictionTable> {
    let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
    let table = py.detach(|| {
        let table = export::FrictionTable::read(&paths)?;
        if law { table.of_laws() } else { Ok(table) }
    });
    table.map(FrictionTable).map_err(refused)
}

fn refused(error: ExportError) -> PyErr {
    let key = matches!(error, ExportError::Format { .. }).then_some("path");
    let file = match &error {
        ExportError::Dataset(_) | ExportError::NoFile => None,
        ExportError::Format { path, .. } | ExportError::Content { path, .. } => Some(path.as_str()),
    };
    errors::input(&error, file, key, &error)
}

#[pymethods]
impl FrictionTable {
    /// The content of a text file of that name.
    fn text(&self, path: PathBuf) -> PyResult<String> {
        Format::of(&path).map(|format| format.text(&self.0)).map_err(refused)
    }

    /// Pressures (Pa), slip rates (m/s), initial temperatures (K, NaN where the query has none).
    fn axes(&self) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let temperatures = self.0.layers.iter().map(|layer| layer.temperature.unwrap_or(f64::NAN));
        (self.0.pressures.clone(), self.0.slip_rates.clone(), temperatures.collect())
    }

    /// Friction and its error: slip rates vary fastest, then pressures, then temperatures.
    fn mu(&self) -> (Vec<f64>, Vec<f64>) {
        self.0.layers.iter().flat_map(|layer| &layer.mu).map(|mu| (mu.value, mu.error)).unzip()
    }
}
