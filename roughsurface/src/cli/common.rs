//! What the commands have in common: options, failures, progress.

use anyhow::{Context, anyhow};
use clap::Args;
use roughsurface::friction::PredictionError;
use roughsurface::integral::law_source::{asperity_law, asperity_law_without_gaps};
use roughsurface::integral::separation::SeparationError;
use roughsurface::surface::file::SurfaceFile;
use std::io::{IsTerminal, Write};
use std::path::Path;
use tables::law::{AsperityLaw, LookupError};
use tables::netcdf::destination;

#[derive(Args)]
pub struct RunOptions {
    /// Threads; all cores by default. Results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Print the summary as JSON
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors (and the JSON, if asked for)
    #[arg(short, long)]
    pub quiet: bool,
    /// Show progress even if stderr is not a terminal
    #[arg(long)]
    pub progress: bool,
    /// Say what is being done
    #[arg(short, long)]
    pub verbose: bool,
}

/// What went wrong, and whose fault it is.
pub enum Failure {
    /// Bad input: exit status 2.
    Input(anyhow::Error),
    /// The run failed: exit status 1.
    Run(anyhow::Error),
}

pub fn input(error: impl Into<anyhow::Error>) -> Failure {
    Failure::Input(error.into())
}

/// What the table cannot answer is bad input; the rest is a failure of the run.
pub fn failure(error: PredictionError) -> Failure {
    let hint = match &error {
        PredictionError::OutsideTable { .. } => Some("--extrapolate continues the table"),
        PredictionError::Lookup(LookupError::Missing { .. })
        | PredictionError::Separation(SeparationError::Lookup(LookupError::Missing { .. })) => {
            Some("--allow-missing interpolates where results lie on both sides")
        }
        PredictionError::Separation(SeparationError::NotFound { .. }) => {
            return Failure::Run(error.into());
        }
        _ => None,
    };
    match hint {
        Some(hint) => Failure::Input(anyhow!("{error} ({hint})")),
        None => input(error),
    }
}

/// The law of one asperity, and a warning if gaps of a table were bridged.
pub fn law(
    table: &str,
    file: &SurfaceFile,
    allow_missing: bool,
) -> Result<(Box<dyn AsperityLaw>, Option<String>), Failure> {
    let material = file.material.as_ref();
    match allow_missing {
        true => asperity_law_without_gaps(table, material, file.temperature).map_err(input),
        false => Ok((asperity_law(table, material, file.temperature).map_err(input)?, None)),
    }
}

/// Warnings to stderr, the summary to stdout.
pub fn summarise(
    quiet: bool,
    as_json: bool,
    warnings: &[String],
    text: impl Fn() -> String,
    json: impl Fn() -> serde_json::Value,
) {
    if !quiet {
        for warning in warnings {
            eprintln!("warning: {warning}");
        }
    }
    if as_json {
        print(&format!("{:#}\n", json()));
    } else if !quiet {
        print(&text());
    }
}

/// Writes a file under a temporary name first, so that it appears whole or not at all.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let path = destination(path);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
    let written = std::fs::write(&temporary, bytes).and_then(|()| std::fs::rename(&temporary, &path));
    written.map_err(|error| {
        let _ = std::fs::remove_file(&temporary);
        Failure::Run(anyhow!("cannot write {}: {error}", path.display()))
    })
}

pub fn check_folder(path: &Path) -> Result<(), Failure> {
    let place = destination(path);
    let folder = match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let reason = if place.is_dir() {
        "it is a folder"
    } else if !folder.is_dir() {
        "its folder does not exist"
    } else if place.exists() && !place.is_file() {
        // A device would be replaced by the file.
        "it is not a regular file"
    } else {
        return Ok(());
    };
    Err(input(anyhow!("cannot write {}: {reason}", path.display())))
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
    // Where the binary lies says nothing about the result.
    words[0] = "roughsurface".into();
    words.join(" ")
}

/// Writes to stdout; a reader that has seen enough (`| head`) is no error.
fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// One line on stderr that counts.
pub struct Progress {
    shown: bool,
    terminal: bool,
    what: &'static str,
}

impl Progress {
    pub fn new(options: &RunOptions, what: &'static str) -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self { shown: options.progress || (terminal && !options.quiet), terminal, what }
    }

    pub fn show(&self, done: usize, total: usize) {
        if !self.shown {
            return;
        }
        if self.terminal {
            eprint!("\r{done} of {total} {}", self.what);
        } else if done * 10 / total != (done - 1) * 10 / total {
            eprintln!("{done} of {total} {}", self.what);
        }
    }

    pub fn clear(&self) {
        if self.shown && self.terminal {
            eprint!("\r\x1b[K");
        }
    }
}
