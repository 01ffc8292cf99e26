//! Checks of the files to be written, before the work begins.

use std::fs::File;
use std::path::Path;

use tables::figures::Figure;
use tables::netcdf::destination;
use tables::table::{Slice, Table};

use super::Failure;

/// Whether `output` can be written and is not the `input`.
pub fn check_output(output: &Path, input: &Path) -> Result<(), Failure> {
    let shown = output.display();
    if output.is_dir() {
        return Err(Failure::input(format!("{shown}: is a directory, a file name is needed")));
    }
    let same = match (output.canonicalize(), input.canonicalize()) {
        (Ok(output), Ok(input)) => output == input,
        _ => false,
    };
    if same {
        return Err(Failure::input(format!("{shown}: is the input; choose another output")));
    }
    let place = destination(output);
    if place.exists() && !place.is_file() {
        // A device would be replaced by the file.
        return Err(Failure::input(format!("{shown}: is not a regular file")));
    }
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    let probe = place.with_file_name(format!(".{name}.{}.probe", std::process::id()));
    File::create_new(&probe)
        .and_then(|_| std::fs::remove_file(&probe))
        .map_err(|error| Failure::input(format!("{shown}: cannot be written: {error}")))
}

/// Whether `plot` can be written and has a known format.
pub fn check_plot(plot: Option<&Path>, input: &Path) -> Result<(), Failure> {
    let Some(plot) = plot else { return Ok(()) };
    Figure::check_extension(plot).map_err(Failure::input)?;
    check_output(plot, input)
}

/// File of the figure of a table; with several initial temperatures one file each, NAME-500K.svg for NAME.svg.
pub fn plot(table: &Table, plot: &Path, panels: &[String]) -> Result<(), Failure> {
    let draw = |slice: &Slice, place: &Path| {
        slice.figure().only(panels).and_then(|figure| figure.save(place)).map_err(Failure::run)
    };
    if let Ok(slice) = table.only() {
        return draw(slice, plot);
    }
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (name, extension) = (part(plot.file_stem()), part(plot.extension()));
    for temperature in table.temperatures() {
        let table = table.at(temperature).map_err(Failure::run)?;
        let place = plot.with_file_name(format!("{name}-{temperature}K.{extension}"));
        draw(&table, &place)?;
    }
    Ok(())
}

/// Whether files can be written into a directory, which is created if it does not exist.
pub fn check_directory(directory: Option<&Path>) -> Result<(), Failure> {
    let Some(directory) = directory else { return Ok(()) };
    std::fs::create_dir_all(directory)
        .map_err(|error| Failure::input(format!("{}: cannot be made: {error}", directory.display())))?;
    let probe = directory.join(format!(".{}.probe", std::process::id()));
    File::create_new(&probe)
        .and_then(|_| std::fs::remove_file(&probe))
        .map_err(|error| Failure::input(format!("{}: cannot be written to: {error}", directory.display())))
}
