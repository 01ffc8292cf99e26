//! Inputs and outputs that must be different files.

use std::path::{Path, PathBuf};

use super::atomic::{destination, folder_of};

/// Two files of a command that are one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{output} and {other} are the same file, {}: the output would replace it; give another name", .path.display())]
pub struct SameFile {
    /// Role of the output, such as `--output`.
    pub output: String,
    /// Role of the other file.
    pub other: String,
    /// The output as it was given.
    pub path: PathBuf,
}

/// Err naming both roles if one of the `outputs` is the same file as one of the `inputs` or another output.
/// Each file is given with its role.
///
/// Files are compared by identity, through symbolic and hard links; a file that does not exist yet by its
/// folder and its name.
pub fn check_distinct(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<(), SameFile> {
    let known = |(role, path): &(&str, &Path)| (identity(path), role.to_string());
    let mut files: Vec<(Identity, String)> = inputs.iter().map(known).collect();
    for file in outputs {
        let (identity, output) = known(file);
        if let Some((_, other)) = files.iter().find(|(known, _)| *known == identity) {
            return Err(SameFile { output, other: other.clone(), path: file.1.to_path_buf() });
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
            let as_input = check_distinct(&[("input", &one)], &[("output", &other)]).unwrap_err();
            let expected =
                SameFile { output: "output".into(), other: "input".into(), path: other.to_path_buf() };
            assert_eq!(as_input, expected);
            let outputs = [("result", &*one), ("plot", &*other)];
            assert_eq!(check_distinct(&[], &outputs).unwrap_err().other, "result");
        }
        for (one, other) in [("table.nc", "new.nc"), ("new.nc", "sub/new.nc"), ("none/a.nc", "none/b.nc")] {
            assert!(check_distinct(&[("input", &at(one))], &[("output", &at(other))]).is_ok());
        }
        // Two inputs may be one file.
        let table = at("table.nc");
        assert!(check_distinct(&[("one", &table), ("other", &table)], &[]).is_ok());
    }
}
