//! `roughsurface export`.

use super::common::*;
use clap::Args;
use roughsurface::output::export::{Format, FrictionTable};
use std::path::{Path, PathBuf};
use tables::numbers::plain;

pub const HELP: &str = "\
The extension decides on the format:
  .inp    Abaqus: *FRICTION with slip rate, pressure and temperature
  .txt    COMSOL: interpolation function, data format Grid
  .csv    MATLAB (readtable), pandas, spreadsheets; MATLAB also reads friction.nc itself (ncread)
  .json   parameters of the rate law at each pressure
A .mat file for MATLAB is written by the Python package: asperity.export(\"friction.nc\", \"friction.mat\")

Examples:
    roughsurface export friction.nc -o friction.inp
    roughsurface export friction.nc -o law.json
  With a dependence on temperature, from predictions with query.temperature:
    roughsurface export cold.nc warm.nc hot.nc -o friction.inp";

#[derive(Args)]
pub struct Export {
    /// Results of `roughsurface predict` over pressures; several have an initial temperature each
    #[arg(required = true, value_name = "FRICTION.nc")]
    friction: Vec<PathBuf>,
    /// File to write
    #[arg(short, long, value_name = "FILE.inp|txt|csv|json")]
    output: PathBuf,
    /// Values of the fitted rate law, ten slip rates a decade, in place of the values computed
    #[arg(long)]
    law: bool,
}

/// Reads, writes.
pub fn run(options: &Export, display: &Display) -> Result<(), Failure> {
    let format = Format::of(&options.output).map_err(Failure::input)?;
    let inputs: Vec<&Path> = options.friction.iter().map(PathBuf::as_path).collect();
    let roles: Vec<(&str, &Path)> = inputs.iter().map(|path| ("the result", *path)).collect();
    check_files(check_results, &roles, &[("--output", Some(&options.output))])?;
    let table = FrictionTable::read(&inputs).map_err(Failure::input)?;
    if options.law {
        let unreliable = table.limitations().map(|(pressure, limitation)| {
            format!("the rate law at {} Pa is not reliable: {limitation}", plain(pressure))
        });
        display.printer().warn(unreliable);
    }
    let table = if options.law { table.of_laws().map_err(Failure::input)? } else { table };
    write_whole(&options.output, format.text(&table).as_bytes())
}
