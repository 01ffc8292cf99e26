//! The program `asperity`: arguments, exit status, and one module per subcommand; see `asperity --help`.
//!
//! Depends on every room of the crate.

mod arguments;
mod calibrate;
mod convergence;
mod effectivity;
mod help;
mod manual;
mod materials;
mod merge;
mod outputs;
mod progress;
mod robustness;
mod run;
mod table;
mod tabulate;
mod timings;
mod verify;

use std::process::ExitCode;

use clap::Parser;
use serde_json::Value;
use tables::netcdf::streams::{self, say};

use arguments::{
    Arguments, Command, ConvergenceArguments, Display, EffectivityArguments, MergeArguments, RunArguments,
    TabulateArguments, VerifyArguments,
};

/// Reason of a failed command.
enum Failure {
    /// Bad input or usage; no computation was started.
    Input(String),
    /// A run failed; the results up to the failure are written.
    Run(String),
}

impl Failure {
    fn input(reason: impl ToString) -> Self {
        Self::Input(reason.to_string())
    }

    fn run(reason: impl ToString) -> Self {
        Self::Run(reason.to_string())
    }
}

fn main() -> ExitCode {
    tables::netcdf::check_processor();
    program()
}

/// Not a part of `main`, whose first instructions might already be ones that the processor lacks.
#[inline(never)]
fn program() -> ExitCode {
    tables::netcdf::enable_sandbox();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        // Help and version, or an error of usage.
        Err(message) => return streams::usage(message.exit_code(), message.print()),
    };
    let display = &arguments.display;
    let work = || match &arguments.command {
        Command::Run(arguments) => run::run(arguments, display),
        Command::Tabulate(arguments) => tabulate::tabulate(arguments, display),
        Command::Merge(arguments) => merge::merge(arguments, display),
        Command::Table(command) => table::table(command, display),
        Command::Convergence(arguments) => convergence::convergence(arguments, display),
        Command::Verify(arguments) => verify::verify(arguments, display),
        Command::Effectivity(arguments) => effectivity::effectivity(arguments, display),
        Command::Calibrate => calibrate::calibrate(display),
        Command::Completions { shell } => manual::completions(*shell),
        Command::Man { directory } => manual::man(directory),
        Command::Materials { name } => materials::materials(name.as_deref(), display),
    };
    let (status, reason) = match std::panic::catch_unwind(work) {
        Ok(Ok(())) => return ExitCode::SUCCESS,
        Ok(Err(Failure::Run(reason))) => (1, reason),
        Ok(Err(Failure::Input(reason))) => (2, reason),
        Err(_) => (1, "internal error (see above); please report it".into()),
    };
    say(format!("error: {reason}"));
    ExitCode::from(status)
}

/// Write to standard output, after all files; text that is lost there is a failure.
fn print(text: &str) -> Result<(), Failure> {
    streams::print(text).map_err(|error| Failure::Run(format!("standard output cannot be written: {error}")))
}

impl Display {
    /// Write warnings on standard error, a line each.
    fn warn<W: std::fmt::Display>(&self, warnings: impl IntoIterator<Item = W>) {
        if !self.quiet {
            warnings.into_iter().for_each(|warning| say(format!("warning: {warning}")));
        }
    }

    /// Write the result of a command to stdout: JSON with `--json`, text otherwise.
    fn print(&self, json: impl FnOnce() -> Value, text: impl FnOnce() -> String) -> Result<(), Failure> {
        match (self.json, self.quiet) {
            (true, _) => print(&format!("{:#}\n", json())),
            (false, false) => print(&text()),
            (false, true) => Ok(()),
        }
    }
}

/// Number of threads that a tabulation uses by default.
fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The command as given, for the history of the files that it writes.
fn command_line() -> String {
    let arguments = std::env::args_os().skip(1).map(|argument| {
        let argument = argument.to_string_lossy().into_owned();
        match argument.contains(char::is_whitespace) {
            true => format!("'{argument}'"),
            false => argument,
        }
    });
    std::iter::once("asperity".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn options_may_stand_before_or_after_the_subcommand() {
        for line in [
            "asperity --json run scene.toml -o run.nc",
            "asperity run scene.toml -o run.nc --json --set a.b=1 --set a.c=2",
        ] {
            assert!(Arguments::try_parse_from(line.split(' ')).unwrap().display.json);
        }
        for line in [
            "asperity run scene.toml",
            "asperity tabulate r.toml -o t.nc --jobs 0",
            "asperity run scene.toml -o run.nc --quiet -v",
        ] {
            assert!(Arguments::try_parse_from(line.split(' ')).is_err(), "{line}");
        }
    }
}
