//! Common parts of the commands: options, failures, output.

use anyhow::{Context, anyhow};
use clap::Args;
use roughsurface::friction::PredictionError;
use roughsurface::integral::separation::SeparationError;
use roughsurface::sampling::case::CaseError;
use std::fmt::Display as Printable;
use std::path::Path;
use tables::law::LookupError;
use tables::netcdf::streams::{print, say};
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

/// Files that a command reads or writes, with their roles in messages.
pub type Roles<'a> = [(&'a str, Option<&'a Path>)];

/// Refuses outputs that cannot be written, and those that are an input or another output.
pub fn check_outputs(inputs: &[(&str, &Path)], outputs: &Roles) -> Result<(), Failure> {
    let outputs: Vec<(&str, &Path)> =
        outputs.iter().filter_map(|(role, path)| path.map(|path| (*role, path))).collect();
    netcdf::check_outputs(inputs, &outputs).map_err(input)
}

/// Failure of a command, by exit status.
pub enum Failure {
    /// Bad input: exit status 2.
    Input(anyhow::Error),
    /// The run failed: exit status 1.
    Run(anyhow::Error),
}

pub fn input(error: impl Into<anyhow::Error>) -> Failure {
    Failure::Input(error.into())
}

/// A query that the table does not cover is bad input; a separation that is not found is a failure of the run.
pub fn failure(error: PredictionError) -> Failure {
    let hint = match &error {
        PredictionError::ContactsTooLarge { .. } => {
            Some("--extrapolate keeps their mean pressure and friction")
        }
        PredictionError::Lookup(LookupError::Missing { .. })
        | PredictionError::Separation(SeparationError::Lookup(LookupError::Missing { .. })) => {
            Some("--allow-missing interpolates where results lie on both sides")
        }
        PredictionError::Separation(
            SeparationError::NotFound { .. } | SeparationError::NoMeanPlane { .. },
        )
        | PredictionError::NotFinite { .. } => {
            return Failure::Run(error.into());
        }
        _ => None,
    };
    match hint {
        Some(hint) => Failure::Input(anyhow!("{error} ({hint})")),
        None => input(error),
    }
}

/// Uncertain parameters that cannot be varied are bad input.
pub fn case_failure(error: CaseError) -> Failure {
    match error {
        CaseError::Prediction(error) => failure(error),
        CaseError::Uncertainty(error) => input(error),
    }
}

/// Warnings to stderr.
pub fn warn(display: &Display, warnings: &[impl Printable]) {
    if !display.quiet {
        for warning in warnings {
            say(format!("warning: {warning}"));
        }
    }
}

/// Warnings to stderr, the summary to stdout.
pub fn summarise(
    display: &Display,
    warnings: &[impl Printable],
    text: impl Fn() -> String,
    json: impl Fn() -> serde_json::Value,
) -> Result<(), Failure> {
    warn(display, warnings);
    let printed = match (display.json, display.quiet) {
        (true, _) => print(&format!("{:#}\n", json())),
        (false, false) => print(&text()),
        (false, true) => Ok(()),
    };
    printed.map_err(|error| Failure::Run(anyhow!("standard output cannot be written: {error}")))
}

/// Writes a result, elsewhere where `output` cannot take it; see [`netcdf::save`].
pub fn save<E: Printable>(output: &Path, write: impl Fn(&Path) -> Result<(), E>) -> Result<(), Failure> {
    netcdf::save(output, write).map_err(|error| Failure::Run(error.into()))
}

/// Ok, or the reasons of all failures: each may name the place of something that was saved.
pub fn all(results: impl IntoIterator<Item = Result<(), Failure>>) -> Result<(), Failure> {
    let failures = results.into_iter().filter_map(Result::err);
    let reasons: Vec<String> =
        failures.map(|(Failure::Input(reason) | Failure::Run(reason))| format!("{reason:#}")).collect();
    if reasons.is_empty() { Ok(()) } else { Err(Failure::Run(anyhow!(reasons.join("; ")))) }
}

/// Writes a file that appears whole or not at all.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_atomically(path, bytes)
        .map_err(|error| Failure::Run(anyhow!("cannot write {}: {error}", path.display())))
}

pub fn thread_pool(options: &RunOptions) -> Result<rayon::ThreadPool, Failure> {
    let threads = options.threads.map_or(0, usize::from);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .context("cannot start threads")
        .map_err(Failure::Run)
}

pub fn command_line() -> String {
    // Not `args`, which panics where a name is not UTF-8.
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    let mut words: Vec<String> = words.collect();
    // The folder of the binary does not influence the result.
    words[0] = "roughsurface".into();
    words.join(" ")
}
