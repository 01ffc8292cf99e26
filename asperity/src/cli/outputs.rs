//! Checks of the files to be written, before the work begins.

use std::fmt::Display;
use std::io::{self, ErrorKind};
use std::path::Path;

use tables::figures::Figure;
use tables::netcdf::{check_distinct, destination};
use tables::table::{Slice, Table};

use super::Failure;

/// Whether every output of a command can be written, and replaces neither an input nor another output. Each file is
/// given with its role; that of a figure is its option, `--plot`.
pub fn check(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), Failure> {
    for (_, plot) in outputs.iter().filter(|(role, _)| *role == PLOT) {
        Figure::check_extension(plot).map_err(Failure::input)?;
    }
    check_distinct(inputs, outputs).map_err(Failure::input)?;
    outputs.iter().try_for_each(|(_, output)| check_place(output))
}

/// Role of the file that the results are written to.
pub const OUTPUT: &str = "--output";

/// Role of a figure.
pub const PLOT: &str = "--plot";

/// The files of the options `--output` and `--plot` with their roles.
pub fn with_plot<'a>(output: &'a Path, plot: Option<&'a Path>) -> Vec<(&'static str, &'a Path)> {
    std::iter::once((OUTPUT, output)).chain(plot.map(|plot| (PLOT, plot))).collect()
}

fn check_place(output: &Path) -> Result<(), Failure> {
    let shown = output.display();
    if output.is_dir() {
        return Err(Failure::input(format!("{shown}: is a directory, a file name is needed")));
    }
    let place = destination(output);
    if place.exists() && !place.is_file() {
        // A device would be replaced by the file.
        return Err(Failure::input(format!("{shown}: is not a regular file")));
    }
    let folder = place.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let mut longest = place.clone().into_os_string();
    longest.push(LONGEST_SUFFIX);
    let fits = match Path::new(&longest).symlink_metadata() {
        Err(error) if error.kind() == ErrorKind::InvalidFilename => Err(error),
        _ => Ok(()),
    };
    fits.and_then(|()| probe(folder))
        .map_err(|error| Failure::input(format!("{shown}: cannot be written: {error}")))
}

/// Of the files beside an output: its journal, or the figures of its initial temperatures.
const LONGEST_SUFFIX: &str = "-1000.5K";

/// Whether a file can be created in a folder.
fn probe(folder: &Path) -> io::Result<()> {
    tempfile::tempfile_in(folder).map(drop)
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

/// Writes a result that took long to compute. Where `output` cannot take it, it is saved in a new folder in the current
/// directory or in that of temporary files, which the failure names.
pub fn save<E: Display>(output: &Path, write: impl Fn(&Path) -> Result<(), E>) -> Result<(), Failure> {
    let Err(error) = write(output) else { return Ok(()) };
    let folders = [std::env::current_dir().ok(), Some(std::env::temp_dir())];
    for folder in folders.into_iter().flatten() {
        // A new folder: nothing of that name is overwritten, and no link is followed.
        let Ok(new) = tempfile::Builder::new().prefix("asperity-").tempdir_in(folder) else { continue };
        let place = new.path().join(output.file_name().unwrap_or_default());
        if write(&place).is_ok() {
            let _ = new.keep();
            return Err(Failure::Run(format!("{error}; the results are in {} instead", place.display())));
        }
    }
    Err(Failure::Run(format!(
        "{error}; nor can the current directory or {} be written: the results are lost",
        std::env::temp_dir().display()
    )))
}

/// Whether files can be written into a directory, which is created if it does not exist.
pub fn check_directory(directory: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(directory)
        .map_err(|error| Failure::input(format!("{}: cannot be made: {error}", directory.display())))?;
    probe(directory)
        .map_err(|error| Failure::input(format!("{}: cannot be written to: {error}", directory.display())))
}
