//! The program `roughsurface`: command line of the friction of rough surfaces, one module per subcommand.

mod characterize;
mod common;
mod help;
mod input;
mod predict;
mod progress;
mod sample;
mod topography;

use clap::{Parser, Subcommand};
use common::Failure;
use help::{EXAMPLES, after_help};
use std::process::ExitCode;

/// Friction of a rough surface from the friction of one asperity
#[derive(Parser)]
#[command(version, after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{}", after_help()), arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
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
}

fn main() -> ExitCode {
    tables::netcdf::enable_sandbox();
    let result = match Cli::parse().command {
        Command::Predict(options) => predict::run(&options),
        Command::Sample(options) => sample::run(&options),
        Command::Characterize(options) => characterize::run(&options),
    };
    let (error, status) = match result {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Input(error)) => (error, 2),
        Err(Failure::Run(error)) => (error, 1),
    };
    eprintln!("error: {error:#}");
    ExitCode::from(status)
}
