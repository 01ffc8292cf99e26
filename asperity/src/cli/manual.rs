//! `asperity completions` and `asperity man`, made from the list of arguments.

use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;

use super::{Arguments, Failure, outputs, print};

/// Print the completion script of a shell.
pub fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "asperity", &mut script);
    print(&String::from_utf8_lossy(&script))
}

/// Write a page for the program and for each subcommand.
pub fn man(directory: &Path) -> Result<(), Failure> {
    outputs::check_directory(directory)?;
    clap_mangen::generate_to(Arguments::command(), directory)
        .map_err(|error| Failure::Run(format!("{}: cannot be written to: {error}", directory.display())))
}
