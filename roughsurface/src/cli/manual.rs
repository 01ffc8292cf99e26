//! `roughsurface completions` and `roughsurface man`, made from the list of arguments.

use super::Cli;
use super::common::Failure;
use clap::CommandFactory;
use clap_complete::Shell;
use std::path::Path;
use tables::netcdf::program::print;

/// Print the completion script of a shell.
pub fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command().name("roughsurface"), "roughsurface", &mut script);
    print(&String::from_utf8_lossy(&script))
}

/// Write a page for the program and for each subcommand.
pub fn man(directory: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(directory)
        .and_then(|()| clap_mangen::generate_to(Cli::command().name("roughsurface"), directory))
        .map_err(|error| Failure::run(format!("{}: cannot be written to: {error}", directory.display())))
}
