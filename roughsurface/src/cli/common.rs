//! Common parts of the commands: options, failures, output.

use clap::Args;
use roughsurface::friction::PredictionError;
use roughsurface::integral::separation::SeparationError;
use roughsurface::sampling::case::CaseError;
use std::path::Path;
use tables::law::LookupError;
use tables::netcdf::program::{self, Printer};
pub use tables::netcdf::program::{Failure, netcdf_name, save};
use tables::netcdf::{self, write_atomically};

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

/// Refuses outputs that cannot be written, and those that are an input or another output.
pub fn check_outputs(inputs: &[(&str, &Path)], outputs: &Roles) -> Result<(), Failure> {
    let outputs = given(outputs);
    netcdf::check_outputs(inputs, &outputs)
        .and_then(|()| netcdf::check_irreplaceable(&outputs))
        .map_err(Failure::input)
}

/// Refuses outputs that cannot be written, and those that are an input or another output, where the inputs are results and
/// no surface files.
pub fn check_results(inputs: &[(&str, &Path)], outputs: &Roles) -> Result<(), Failure> {
    let outputs = given(outputs);
    netcdf::check_results(inputs, &outputs)
        .and_then(|()| netcdf::check_irreplaceable(&outputs))
        .map_err(Failure::input)
}

/// Refuses an output that holds results of another command than that whose results have this title.
pub fn check_kind(output: &Path, title: &str) -> Result<(), Failure> {
    netcdf::check_kind(output, title).map_err(Failure::input)
}

fn given<'a>(outputs: &Roles<'a>) -> Vec<(&'a str, &'a Path)> {
    outputs.iter().filter_map(|(role, path)| path.map(|path| (*role, path))).collect()
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

pub fn command_line() -> String {
    program::command_line("roughsurface")
}
