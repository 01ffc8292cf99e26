//! Checks of the files to be written, before the work begins.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use super::OutputError;
use super::atomic::{check_protection, destination, folder_of};
use super::checksum::is_unchanged;
use super::distinct::check_distinct;
use super::reader::DatasetReader;
use super::schema::SCHEMA;

fn refused(output: &Path, why: &str) -> Result<(), OutputError> {
    Err(OutputError(format!("{}: {why}", output.display())))
}

/// End of the name of a journal of finished cells, beside the table that it will be.
pub const JOURNAL: &str = ".part";

/// Role of the journal of a table.
pub const JOURNAL_ROLE: &str = "the journal";

/// [`check_outputs`] of results: a slip of the keyboard shall not replace a scene, a request or a surface.
pub fn check_results(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), OutputError> {
    let is_input =
        |place: &Path| place.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    check_outputs(inputs, outputs)?;
    // Journals themselves have another role.
    let is_journal =
        |role: &str, place: &Path| role != JOURNAL_ROLE && place.to_string_lossy().ends_with(JOURNAL);
    for (role, output) in outputs {
        let files = if is_input(&destination(output)) {
            "files named .toml are scenes, requests and surfaces".to_owned()
        } else if is_journal(role, &destination(output)) {
            format!("files named {JOURNAL} are journals of unfinished tables")
        } else {
            continue;
        };
        return refused(output, &format!("{files}; results need another extension"));
    }
    Ok(())
}

/// Whether no output of a command that makes other files is a table, which took hours to compute and whose name is easily given
/// again, nor a TOML file that was written by hand, nor what [`check_of_others`] refuses.
pub fn check_irreplaceable(outputs: &[(&str, &Path)]) -> Result<(), OutputError> {
    for (_, output) in outputs {
        if DatasetReader::open(output).is_ok_and(|file| text(&file, "schema") == SCHEMA) {
            let why = "is a table, which only `asperity tabulate` and `asperity merge` replace; choose another name, or delete it";
            return refused(output, why);
        }
        if is_of_others(output, &["toml"]) {
            let why = "was not written by `roughsurface characterize`; choose another name, or delete it";
            return refused(output, why);
        }
        if is_edited(output) {
            let why = "was changed since `roughsurface characterize` wrote it, or is of an earlier version; choose another name, or delete it";
            return refused(output, why);
        }
    }
    check_of_others(outputs)
}

/// Refuses an output that is not a result of this command, whose title begins with `title`.
pub fn check_kind(output: &Path, title: &str) -> Result<(), OutputError> {
    match DatasetReader::open(output) {
        Ok(file) if !text(&file, "title").starts_with(title) => refused(
            output,
            &format!(
                "is not a result of this command, but \"{}\"; choose another name, or delete it",
                text(&file, "title")
            ),
        ),
        _ => Ok(()),
    }
}

/// Whether no output is data of another program, which cannot be computed again: a netCDF file, one that begins as those of
/// `BINARY_DATA`, or a text with the extension of measured heights that does not begin as those of this project.
pub fn check_of_others(outputs: &[(&str, &Path)]) -> Result<(), OutputError> {
    for (_, output) in outputs {
        let start = beginning(output);
        let is_binary = BINARY_DATA.iter().any(|magic| start.starts_with(magic));
        let of_others = match DatasetReader::open(output) {
            Ok(file) => !PROGRAMS.iter().any(|program| text(&file, "source").starts_with(program)),
            Err(_) => is_binary || is_of_others(output, &MEASURED),
        };
        if of_others {
            let why =
                "holds data of another program, as of a measured surface; choose another name, or delete it";
            return refused(output, why);
        }
    }
    Ok(())
}

/// Whether a file has one of these extensions, and does not begin as the texts of this project.
fn is_of_others(output: &Path, extensions: &[&str]) -> bool {
    let extension = output.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let start = beginning(output);
    extensions.iter().any(|of_data| extension.eq_ignore_ascii_case(of_data))
        && !start.is_empty()
        && !TEXTS.iter().any(|text| start.starts_with(text.as_bytes()))
}

/// Whether a surface file of `roughsurface characterize`, or its file of heights, is not as it was written.
fn is_edited(output: &Path) -> bool {
    let start = beginning(output);
    let has_checksum = [SURFACE, HEIGHTS].iter().any(|text| start.starts_with(text.as_bytes()));
    has_checksum && !std::fs::read_to_string(output).is_ok_and(|text| is_unchanged(&text))
}

/// First words of the attribute `source` of the files of this project.
const PROGRAMS: [&str; 2] = ["asperity ", "roughsurface "];

/// Beginnings of archives (X3P), numpy arrays, fields of Gwyddion and SDF files.
const BINARY_DATA: [&[u8]; 7] =
    [b"PK\x03\x04", b"\x93NUMPY", b"Gwyddion", b"aISO-", b"bISO-", b"aBCR-", b"bBCR-"];

/// Extensions of measured heights in text files, of input of Abaqus and of settings of other programs.
const MEASURED: [&str; 8] = ["csv", "txt", "tsv", "dat", "xyz", "asc", "inp", "json"];

/// Beginnings of the texts of this project with such an extension: tables, friction for MATLAB, COMSOL and Abaqus, rate laws,
/// heights of summits, and surfaces.
const TEXTS: [&str; 8] = [
    "interference [1],",
    "temperature [K],interference [1],",
    "temperature_K,",
    "% Friction coefficient",
    "** Friction coefficient",
    RATE_LAW,
    HEIGHTS,
    SURFACE,
];
const RATE_LAW: &str = "{\n  \"files\": [";
const HEIGHTS: &str = "# Heights of summits ";
const SURFACE: &str = "# Summits of ";

/// A text attribute; empty if there is none.
fn text(file: &DatasetReader, name: &str) -> String {
    file.optional_text(name).ok().flatten().unwrap_or_default()
}

/// The first bytes of a regular file; none of another.
fn beginning(path: &Path) -> Vec<u8> {
    let mut start = Vec::new();
    if path.is_file()
        && let Ok(file) = File::open(path)
    {
        // A file that cannot be read cannot be told from those of others by its beginning.
        let _ = file.take(64).read_to_end(&mut start);
    }
    start
}

/// Whether every output of a command can be written, and replaces neither an input nor another output. Each file is
/// given with its role, which is named in the error.
pub fn check_outputs(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), OutputError> {
    check_distinct(inputs, outputs)?;
    outputs.iter().try_for_each(|(_, output)| {
        let checked = match output.as_os_str() == "-" {
            true => Err("results are not written to standard output; a file name is needed".into()),
            false => check_place(&destination(output)),
        };
        checked.or_else(|reason| refused(output, &format!("cannot be written: {reason}")))
    })
}

fn check_place(place: &Path) -> Result<(), String> {
    match place.symlink_metadata() {
        Ok(data) if data.is_dir() => return Err("it is a folder, a file name is needed".into()),
        // A device would be replaced by the file.
        Ok(data) if !data.is_file() => return Err("it is not a regular file".into()),
        // The temporary name of the file is short, so the probe would not notice.
        Err(error) if error.kind() == ErrorKind::InvalidFilename => return Err("its name is too long".into()),
        _ => {}
    }
    check_protection(place).map_err(|_| "it is protected against writing")?;
    let folder = folder_of(place);
    probe(folder).map_err(|error| match error.kind() {
        // Folders of the system, as /proc, say so of every new file.
        ErrorKind::NotFound if folder.is_dir() => "its folder takes no files".into(),
        ErrorKind::NotFound => "its folder does not exist".into(),
        _ => error.to_string(),
    })
}

/// Whether a file can be created in a folder.
pub fn probe(folder: &Path) -> io::Result<()> {
    tempfile::tempfile_in(folder).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_not_named_like_inputs() {
        for name in ["scene.toml", "other.TOML"] {
            let refused = check_results(&[], &[("--output", Path::new(name))]).unwrap_err().to_string();
            assert!(refused.starts_with(&format!("{name}: files named .toml")), "{refused}");
            check_outputs(&[], &[("--output", Path::new(name))]).unwrap();
        }
        check_results(&[], &[("--output", Path::new("toml.nc")), ("--plot", Path::new("toml"))]).unwrap();
        let journal = Path::new("table.nc.part");
        let refused = check_results(&[], &[("--output", journal)]).unwrap_err().to_string();
        assert!(refused.starts_with("table.nc.part: files named .part are journals"), "{refused}");
        check_results(&[], &[(JOURNAL_ROLE, journal)]).unwrap();
    }

    #[test]
    fn standard_output_is_no_place_for_a_file() {
        let refused = check_outputs(&[], &[("--output", Path::new("-"))]).unwrap_err().to_string();
        assert!(refused.starts_with("-: cannot be written") && !Path::new("-").exists(), "{refused}");
    }
}
