//! Common parts of the commands: options, failures, output.

use clap::Args;
use roughsurface::friction::PredictionError;
use roughsurface::integral::separation::SeparationError;
use roughsurface::sampling::case::CaseError;
use std::path::Path;
use tables::law::LookupError;
use tables::netcdf::program::{self, Printer};
pub use tables::netcdf::program::{Failure, netcdf_name, save};
use tables::netcdf::{self, OutputError, check_irreplaceable, write_atomically};
pub use tables::netcdf::{check_kind, check_outputs, check_results};

#[derive(Args)]
pub struct RunOptions {
    /// Threads; all cores by default. Results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

/// What is printed, by any command.
#[derive(Args)]
pub struct Display {
    /// Print the summary as JSON
    #[arg(long, global = true)]
    pub json: bool,
    /// Print errors only (and the JSON with --json)
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Report the steps of the computation
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// Show progress even if stderr is not a terminal
    #[arg(long, global = true, conflicts_with = "quiet")]
    pub progress: bool,
}

impl Display {
    pub fn printer(&self) -> Printer {
        Printer { json: self.json, quiet: self.quiet }
    }
}

/// Files that a command reads or writes, with their roles in messages.
pub type Roles<'a> = [(&'a str, Option<&'a Path>)];

/// [`check_outputs`](netcdf::check_outputs) or [`check_results`](netcdf::check_results).
type Check = fn(&[(&str, &Path)], &[(&str, &Path)]) -> Result<(), OutputError>;

/// Refuses outputs by a `check` of the files, and those that cannot be computed again.
pub fn check_files(check: Check, inputs: &[(&str, &Path)], outputs: &Roles) -> Result<(), Failure> {
    let given = outputs.iter().filter_map(|(role, path)| path.map(|path| (*role, path)));
    let outputs: Vec<(&str, &Path)> = given.collect();
    check(inputs, &outputs).and_then(|()| check_irreplaceable(&outputs)).map_err(Failure::input)
}

/// A query that the table does not cover is bad input; a separation that is not found is a failure of the run.
pub fn failure(error: PredictionError) -> Failure {
    let with = |hint: &str| Failure::input(format!("{error} ({hint})"));
    match &error {
        PredictionError::ContactsTooLarge { .. } => {
            with("--extrapolate keeps their mean pressure and friction")
        }
        PredictionError::Lookup(LookupError::Missing { .. })
        | PredictionError::Separation(SeparationError::Lookup(LookupError::Missing { .. })) => with(
            "--allow-missing interpolates cells that have results on both sides, and leaves out interferences and slip rates without any",
        ),
        PredictionError::Separation(
            SeparationError::NotFound { .. } | SeparationError::NoMeanPlane { .. },
        )
        | PredictionError::NotFinite { .. } => Failure::run(error),
        _ => Failure::input(error),
    }
}

/// Uncertain parameters that cannot be varied are bad input.
pub fn case_failure(error: CaseError) -> Failure {
    match error {
        CaseError::Prediction(error) => failure(error),
        CaseError::Uncertainty(error) => Failure::input(error),
    }
}

/// Writes a file that appears whole or not at all.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_atomically(path, bytes)
        .map_err(|error| Failure::run(format!("cannot write {}: {error}", path.display())))
}

/// A line for the attribute `history`: time and command.
pub fn history() -> String {
    netcdf::history(&program::command_line("roughsurface"))
}
