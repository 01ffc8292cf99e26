//! The program `roughsurface`: command line of the friction of rough surfaces, one module per subcommand.

mod characterize;
mod common;
mod export;
mod help;
mod input;
mod manual;
mod predict;
mod progress;
mod sample;
mod topography;

use clap::{Parser, Subcommand};
use common::Display;
use help::{EXAMPLES, after_help};
use std::process::ExitCode;
use tables::netcdf::program::exit_status;
use tables::netcdf::streams;

/// Friction of a rough surface from the friction of one asperity
#[derive(Parser)]
#[command(version, after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{}", after_help()), arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    display: Display,
}

#[derive(Subcommand)]
enum Command {
    /// Predict static and sliding friction against pressure and slip rate
    #[command(after_help = predict::HELP, after_long_help = format!("{}\n\n{}", predict::HELP, after_help()))]
    Predict(predict::Predict),
    /// Slide finite surfaces with heights drawn at random: how much specimens scatter
    #[command(after_help = sample::HELP, after_long_help = format!("{}\n\n{}", sample::HELP, after_help()))]
    Sample(sample::Sample),
    /// Summits of a measured topography, as a surface file
    #[command(after_help = characterize::HELP)]
    Characterize(characterize::Characterize),
    /// Write predicted friction for other programs: Abaqus, COMSOL, MATLAB; and the fitted rate law
    #[command(after_help = export::HELP)]
    Export(export::Export),
    /// Print the completion script of a shell
    Completions {
        /// Shell to complete in
        shell: clap_complete::Shell,
    },
    /// Write the man pages
    Man {
        /// Folder to write them to, such as ~/.local/share/man/man1
        directory: std::path::PathBuf,
    },
}

fn main() -> ExitCode {
    tables::netcdf::check_processor();
    program()
}

/// Not a part of `main`, whose first instructions might already be ones that the processor lacks.
#[inline(never)]
fn program() -> ExitCode {
    tables::netcdf::enable_sandbox();
    let arguments = match Cli::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => return streams::usage(message.exit_code(), message.print()),
    };
    let display = &arguments.display;
    exit_status(|| match arguments.command {
        Command::Predict(options) => predict::run(&options, display),
        Command::Sample(options) => sample::run(&options, display),
        Command::Characterize(options) => characterize::run(&options, display),
        Command::Export(options) => export::run(&options, display),
        Command::Completions { shell } => manual::completions(shell),
        Command::Man { directory } => manual::man(&directory),
    })
}
