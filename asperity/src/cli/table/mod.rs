//! `asperity table`: contents, differences, cells computed again, figures, export.
//!
//! Depends on [`tables`] and, for cells computed again, on `tabulate`. Chapters "First steps" and "Shipped tables" of
//! the book.

mod check;
mod diff;
mod info;

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use serde_json::json;
use tables::figures::TABLE_PANELS;
use tables::interpolation::InterpolatedTable;
use tables::netcdf::input::number;
use tables::netcdf::write_atomically;
use tables::shipped;
use tables::table::Table;

use super::{Display, Failure, outputs};

#[derive(Subcommand)]
pub enum TableCommand {
    /// Range, errors, provenance and cost of a table
    Info {
        /// Table to describe, or name of a shipped one; its checksum is verified
        #[arg(value_name = "TABLE.nc|NAME")]
        table: String,
        #[command(flatten)]
        at: At,
    },
    /// Names of the shipped tables, with their largest errors
    List,
    /// Compute some cells again; exit status 1 where a number differs by more than the errors
    Check(CheckArguments),
    /// Differences between two tables, where they have points in common
    Diff(DiffArguments),
    /// Maps and curves of mu, Q/A, G and the highest temperature
    Plot {
        /// Table to plot, or name of a shipped one
        #[arg(value_name = "TABLE.nc|NAME")]
        table: String,
        /// File to write
        #[arg(short, long, value_name = "FILE.svg|png|pdf")]
        output: PathBuf,
        /// Only this panel, 85 mm wide; may be repeated
        #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(TABLE_PANELS))]
        panel: Vec<String>,
        #[command(flatten)]
        at: At,
    },
    /// The table as comma-separated values, a line for each cell
    Export {
        /// Table to export, or name of a shipped one
        #[arg(value_name = "TABLE.nc|NAME")]
        table: String,
        /// File to write
        #[arg(short, long, value_name = "FILE.csv")]
        output: PathBuf,
        /// The histories along the slide instead, a line for each cell and slip
        #[arg(long)]
        histories: bool,
        #[command(flatten)]
        at: At,
    },
}

#[derive(Args)]
pub struct At {
    /// Initial temperature of body and flat at which to read a table that has several; in between it
    /// is interpolated
    #[arg(long, value_name = "K", allow_negative_numbers = true, value_parser = temperature)]
    temperature: Option<f64>,
}

#[derive(Args)]
pub struct DiffArguments {
    /// First table, or name of a shipped one
    #[arg(value_name = "A.nc|NAME")]
    here: String,
    /// Second table
    #[arg(value_name = "B.nc|NAME")]
    there: String,
    /// Largest relative difference allowed; if one is larger, or a cell is done in one of the tables
    /// only, exit with status 1
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    at: At,
}

#[derive(Args)]
pub struct CheckArguments {
    /// Table to check, or name of a shipped one
    #[arg(value_name = "TABLE.nc|NAME")]
    table: String,
    /// Cells to compute again
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..))]
    cells: u16,
    /// Seed of the random choice of cells
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Compute half-way between the interferences and slip rates of the table: error of what is read there
    #[arg(long)]
    between: bool,
    #[command(flatten)]
    at: At,
}

fn temperature(text: &str) -> Result<f64, String> {
    number(text, |value| *value > 0.0 && f64::is_finite(*value), "must be a positive number (K)")
}

fn tolerance(text: &str) -> Result<f64, String> {
    number(text, |value| *value >= 0.0, "must be zero or a positive number")
}

/// Run the subcommand.
pub fn table(command: &TableCommand, display: &Display) -> Result<(), Failure> {
    match command {
        TableCommand::Info { table, at } => info::info(&read_all(table, at)?, table, display),
        TableCommand::List => info::list(display),
        TableCommand::Check(arguments) => check::check(arguments, display),
        TableCommand::Diff(arguments) => diff::diff(arguments, display),
        TableCommand::Plot { table, output, panel, at } => {
            outputs::check(&[("the table", Path::new(table))], &[(outputs::PLOT, output)])?;
            let figure = read(table, at)?.figure().only(panel).map_err(Failure::input)?;
            figure.save(output).map_err(Failure::run)?;
            printed(output, display)
        }
        TableCommand::Export { table, output, histories, at } => {
            check_csv(output)?;
            outputs::check(&[("the table", Path::new(table))], &[(outputs::OUTPUT, output)])?;
            export(&read_all(table, at)?, output, *histories)?;
            printed(output, display)
        }
    }
}

/// What is printed of a file that was written: its name as JSON, or nothing.
fn printed(output: &Path, display: &Display) -> Result<(), Failure> {
    display.printer().print(|| json!({ "output": output.display().to_string() }), String::new)
}

/// The table at the given initial temperature, which is required if the table has several.
fn read(table_name: &str, at: &At) -> Result<InterpolatedTable, Failure> {
    shipped::open(table_name, at.temperature).map_err(Failure::input)
}

/// The table at the given initial temperature, or at all its temperatures if none is given.
fn read_all(table_name: &str, at: &At) -> Result<Table, Failure> {
    match at.temperature {
        Some(_) => read(table_name, at).map(|table| Table::from(table.into_slice())),
        None => shipped::load(table_name).map_err(Failure::input),
    }
}

/// Whether the name is one of the only format of an export.
fn check_csv(output: &Path) -> Result<(), Failure> {
    match output.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("csv") => Ok(()),
        _ => Err(Failure::input(format!(
            "{}: tables are exported as comma-separated values; choose a name that ends in .csv",
            output.display()
        ))),
    }
}

fn export(table: &Table, output: &Path, histories: bool) -> Result<(), Failure> {
    let mut text = Vec::new();
    let written = match histories {
        true => table.write_histories_csv(&mut text),
        false => table.write_csv(&mut text),
    };
    written
        .and_then(|()| write_atomically(output, &text))
        .map_err(|error| Failure::Run(format!("{}: cannot be written: {error}", output.display())))
}
