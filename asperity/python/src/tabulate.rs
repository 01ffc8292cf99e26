//! `asperity.tabulate`.

use std::path::{Path, PathBuf};

use asperity::output::provenance;
use asperity::scene::file::{parse_request, read_request};
use asperity::tabulate::{Journal, Options, TabulateError, completed};
use pyo3::prelude::*;

use crate::errors;
use crate::input::Given;
use crate::output::distinct;
use crate::table::Table;
use crate::watch::{Follower, followed};

/// Runs the missing cells of a request and writes the table, as `asperity tabulate`. The journal is beside the table and
/// remains until that is written.
#[pyfunction]
pub fn tabulate(
    py: Python<'_>,
    request: Given,
    output: PathBuf,
    overrides: Vec<String>,
    jobs: Option<usize>,
    resume: bool,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Table> {
    let journal = Journal::beside(&output);
    let path = request.is_path().then_some(("the request", Path::new(&request.content)));
    distinct(path.as_slice(), &[("the output", &output), ("the journal", &journal)])?;
    let request = match path {
        Some((_, path)) => read_request(path, &overrides),
        None => parse_request(&request.content, &request.kind, &overrides),
    };
    let request = request.map_err(errors::of_scene)?;
    if resume
        && let Some(table) = completed(&request, None, &output)
            .map_err(|error| errors::input(&error, Some(&output.display().to_string()), None, &error))?
    {
        return Ok(Table::new(table, request.remarks()));
    }
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    let options = Options { jobs: jobs.unwrap_or_else(processors), journal: &journal, resume, shard: None };
    let work = |follower: &Follower| asperity::tabulate::tabulate(&request, &options, follower);
    let (tabulation, journal) =
        followed(py, Some(1), progress.as_ref(), work)?.map_err(|error| match error {
            TabulateError::Journal(ref journal) if journal.is_of_the_system() => errors::failed(error, None),
            error => errors::input(&error, Some(&output.display().to_string()), None, &error),
        })?;
    let failed = |error: String| errors::failed(error, None);
    let history = provenance::history("asperity.tabulate (Python)");
    let table = tabulation.table(history).map_err(|error| failed(error.to_string()))?;
    table.write(&output).map_err(|error| failed(error.to_string()))?;
    journal.remove().map_err(|error| failed(error.to_string()))?;
    let warnings = request.remarks().into_iter().chain(tabulation.warnings()).collect();
    Ok(Table::new(table, warnings))
}
