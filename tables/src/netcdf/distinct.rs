//! Inputs and outputs that must be different files.

use std::path::{Path, PathBuf};

use super::OutputError;
use super::atomic::{destination, folder_of};

/// Err naming both roles if one of the `outputs` is the same file as one of the `inputs` or another output.
/// Each file is given with its role.
///
/// Files are compared by identity, through symbolic and hard links; a file that does not exist yet by its
/// folder and its name.
pub fn check_distinct(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), OutputError> {
    let known = |(role, path): &(&str, &Path)| (identity(path), role.to_string());
    let mut files: Vec<(Identity, String)> = inputs.iter().map(known).collect();
    for file in outputs {
        let (identity, output) = known(file);
        if let Some((_, other)) = files.iter().find(|(known, _)| *known == identity) {
            return Err(OutputError(format!(
                "{output} and {other} are the same file, {}: the output would replace it; give another name",
                file.1.display()
            )));
        }
        files.push((identity, output));
    }
    Ok(())
}

#[derive(PartialEq)]
enum Identity {
    /// Device and number of the file on it.
    #[cfg(unix)]
    Existing(u64, u64),
    /// The place of a file that does not exist.
    Place(PathBuf),
}

fn identity(path: &Path) -> Identity {
    #[cfg(unix)]
    if let Ok(metadata) = std::fs::metadata(path) {
        use std::os::unix::fs::MetadataExt;
        return Identity::Existing(metadata.dev(), metadata.ino());
    }
    let place = destination(path);
    // A folder that does not exist is reported where the file is opened.
    let folder = folder_of(&place);
    let folder = folder.canonicalize().unwrap_or(folder.to_path_buf());
    Identity::Place(folder.join(place.file_name().unwrap_or_default()))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn links_and_other_spellings_are_the_same_file() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("table.nc"), "").unwrap();
        std::fs::create_dir(at("sub")).unwrap();
        std::fs::hard_link(at("table.nc"), at("hard.nc")).unwrap();
        symlink("table.nc", at("soft.nc")).unwrap();
        symlink("new.nc", at("dangling.nc")).unwrap();
        symlink(folder.path(), at("folder")).unwrap();
        for (one, other) in [
            ("table.nc", "table.nc"),
            ("table.nc", "hard.nc"),
            ("soft.nc", "hard.nc"),
            ("folder/table.nc", "sub/../table.nc"),
            ("new.nc", "folder/new.nc"),
            ("new.nc", "dangling.nc"),
        ] {
            let (one, other) = (at(one), at(other));
            let said = |inputs: &[_], outputs: &[_]| check_distinct(inputs, outputs).unwrap_err().to_string();
            let as_input = said(&[("input", &one)], &[("output", &other)]);
            let expected = format!("output and input are the same file, {}: ", other.display());
            assert!(as_input.starts_with(&expected), "{as_input}");
            assert!(said(&[], &[("result", &*one), ("plot", &*other)]).starts_with("plot and result are"));
        }
        for (one, other) in [("table.nc", "new.nc"), ("new.nc", "sub/new.nc"), ("none/a.nc", "none/b.nc")] {
            assert!(check_distinct(&[("input", &at(one))], &[("output", &at(other))]).is_ok());
        }
        // Two inputs may be one file.
        let table = at("table.nc");
        assert!(check_distinct(&[("one", &table), ("other", &table)], &[]).is_ok());
    }
}
