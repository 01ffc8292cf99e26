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

use asperity::simulate::STACK_SIZE;
use clap::Parser;
use tables::netcdf::program::{self, Failure, exit_status, print};
use tables::netcdf::streams;

use arguments::{
    Arguments, Command, ConvergenceArguments, Display, EffectivityArguments, MergeArguments, RunArguments,
    TabulateArguments, VerifyArguments,
};

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
    exit_status(|| start_threads(&arguments.command).and_then(|()| work()))
}

/// Starts the threads of the commands that simulate, as many as processors by default; `tabulate` has its own.
fn start_threads(command: &Command) -> Result<(), Failure> {
    let number = match command {
        Command::Run(arguments) => arguments.threads,
        Command::Convergence(arguments) => arguments.threads,
        Command::Verify(_) | Command::Effectivity(_) | Command::Calibrate => None,
        Command::Table(table::TableCommand::Check(_)) => None,
        _ => return Ok(()),
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number.map_or(0, usize::from));
    let started = pool.stack_size(STACK_SIZE).build_global();
    started.map_err(|error| Failure::run(format!("cannot start threads: {error}")))
}

/// Number of threads that a tabulation uses by default.
fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn command_line() -> String {
    program::command_line("asperity")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_may_stand_before_or_after_the_subcommand() {
        for line in [
            "asperity --json run scene.toml -o run.nc",
            "asperity run scene.toml -o run.nc --json --set a.b=1 --set a.c=2",
        ] {
            assert!(Arguments::try_parse_from(line.split(' ')).unwrap().display.json);
        }
    }
}
