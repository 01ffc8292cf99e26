//! Checks of the files to be written, before the work begins.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use tables::figures::{Figure, TABLE_PANELS};
use tables::netcdf::program::{Failure, save};
use tables::netcdf::{check_irreplaceable, check_kind, check_of_others, check_results, probe};
use tables::table::Table;

// Options of the figure of a table; a documentation comment would replace the description of the command.
#[derive(Args)]
pub(super) struct TablePlot {
    /// Plot the table; at several initial temperatures one file for each, FILE-500K.svg
    #[arg(long, value_name = "FILE.svg|png|pdf")]
    pub(super) plot: Option<PathBuf>,
    /// Only this panel of the plot, 85 mm wide; may be repeated
    #[arg(long, value_name = "NAME", requires = "plot", value_parser = PossibleValuesParser::new(TABLE_PANELS))]
    pub(super) panel: Vec<String>,
}

/// Whether every output of a command can be written, and replaces neither an input, nor another output, nor a table, nor data of
/// another program. Each file is given with its role; that of a figure is its option, `--plot`.
pub fn check(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), Failure> {
    check_with_table(inputs, outputs)?;
    check_irreplaceable(outputs).map_err(Failure::input)
}

/// [`check`] of a command whose results have a title that begins with `title`; those of another command stay.
pub fn check_of_kind(
    title: &str,
    inputs: &[(&str, &Path)],
    outputs: &[(&str, &Path)],
) -> Result<(), Failure> {
    check(inputs, outputs)?;
    let mut results = outputs.iter().filter(|(role, _)| *role == OUTPUT);
    results.try_for_each(|(_, output)| check_kind(output, title)).map_err(Failure::input)
}

/// Whether every output of a command that makes a table can be written, as by [`check`]; it may replace a table.
pub fn check_with_table(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), Failure> {
    for (_, plot) in outputs.iter().filter(|(role, _)| *role == PLOT) {
        Figure::check_extension(plot).map_err(Failure::input)?;
    }
    check_results(inputs, outputs).and_then(|()| check_of_others(outputs)).map_err(Failure::input)
}

/// Role of the file that the results are written to.
pub const OUTPUT: &str = "--output";

/// Role of a figure.
pub const PLOT: &str = "--plot";

/// The files of the options `--output` and `--plot` with their roles.
pub fn with_plots<'a>(
    output: &'a Path,
    plots: impl IntoIterator<Item = &'a PathBuf>,
) -> Vec<(&'static str, &'a Path)> {
    let plots = plots.into_iter().map(|plot| (PLOT, plot.as_path()));
    std::iter::once((OUTPUT, output)).chain(plots).collect()
}

/// The figures of a table, if asked for: `plot`, or with several initial temperatures NAME-500K.svg and so on for NAME.svg.
pub fn plots(plot: &Option<PathBuf>, temperatures: &[f64]) -> Vec<PathBuf> {
    let Some(plot) = plot else { return Vec::new() };
    if temperatures.len() < 2 {
        return vec![plot.clone()];
    }
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (name, extension) = (part(plot.file_stem()), part(plot.extension()));
    let path = |temperature: &f64| plot.with_file_name(format!("{name}-{temperature}K.{extension}"));
    temperatures.iter().map(path).collect()
}

/// Draws the figures of a table, if asked for.
pub fn plot(table: &Table, TablePlot { plot, panel }: &TablePlot) -> Result<(), Failure> {
    let temperatures = table.temperatures();
    for (temperature, path) in temperatures.iter().zip(plots(plot, &temperatures)) {
        let slice = table.at(*temperature).map_err(Failure::run)?;
        draw(|| slice.figure(), panel, &Some(path))?;
    }
    Ok(())
}

/// Whether the figure will have the panels that are asked for, before the work begins.
pub fn check_panels(asked: &[String], panels: &[&str]) -> Result<(), Failure> {
    Figure::check_panels(asked, panels).map_err(Failure::input)
}

/// Writes some panels of a figure, or all, if asked for; elsewhere where `plot` cannot take it.
pub fn draw(
    figure: impl FnOnce() -> Figure,
    panels: &[String],
    plot: &Option<PathBuf>,
) -> Result<(), Failure> {
    let Some(plot) = plot else { return Ok(()) };
    let figure = figure().only(panels).map_err(Failure::run)?;
    save(plot, |path| figure.save(path))
}

/// Whether files can be written into a directory, which is created if it does not exist.
pub fn check_directory(directory: &Path) -> Result<(), Failure> {
    if directory.exists() && !directory.is_dir() {
        return Err(Failure::input(format!("{}: is a file, a folder is needed", directory.display())));
    }
    std::fs::create_dir_all(directory)
        .map_err(|error| Failure::input(format!("{}: cannot be made: {error}", directory.display())))?;
    probe(directory)
        .map_err(|error| Failure::input(format!("{}: cannot be written to: {error}", directory.display())))
}
