//! Files that appear whole or not at all.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use rustix::fs::{Access, access};
use rustix::process::{Resource, getrlimit};

/// Writes a file under a temporary name in the folder of `path`, and renames it once it is complete and on the disk.
/// A file of that name is replaced, with its permissions, unless it is protected against writing; symbolic links are followed.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // The system ends a program that exceeds it, by a signal.
    let limit = getrlimit(Resource::Fsize).current;
    if limit.is_some_and(|limit| limit < bytes.len() as u64) {
        return Err(in_words(io::ErrorKind::FileTooLarge.into()));
    }
    write(path, bytes).map_err(in_words)
}

fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let destination = destination(path);
    let folder = folder_of(&destination);
    check_protection(&destination)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".asperity-").suffix(".partial");
    // As for any new file: temporary files are for their owner only.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // The message of the library names the temporary file instead of the requested one.
    let mut file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    file.write_all(bytes)?;
    if let Ok(replaced) = std::fs::metadata(&destination) {
        // Some file systems have none.
        let _ = file.as_file().set_permissions(replaced.permissions());
    }
    // On the disk before it has its name: a name without content would be a damaged file.
    file.as_file().sync_all()?;
    file.persist(&destination).map_err(|error| error.error)?;
    Ok(())
}

/// Whether a file may be written, if it exists: renaming would replace it even if not.
pub(super) fn check_protection(place: &Path) -> io::Result<()> {
    match place.exists() {
        true => Ok(access(place, Access::WRITE_OK)?),
        false => Ok(()),
    }
}

/// The folder of a file.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
}

/// The error with a message on disks without room in place of the system's.
pub fn in_words(error: io::Error) -> io::Error {
    let text = match error.kind() {
        io::ErrorKind::StorageFull => "no space left on the disk",
        io::ErrorKind::QuotaExceeded => "the quota of the disk is used up",
        io::ErrorKind::FileTooLarge => "larger than the system allows a file to be (ulimit -f)",
        _ => return error,
    };
    io::Error::new(error.kind(), text)
}

/// The path that a file called `path` is written to: links are followed, also those without a target.
///
/// A file gets its name by being renamed, which would put the file in place of the link, on the disk of
/// the link, and leave the target of the link unchanged.
pub fn destination(path: &Path) -> PathBuf {
    let mut place = path.to_path_buf();
    // As many in a row as Linux follows.
    for _ in 0..40 {
        let Ok(target) = std::fs::read_link(&place) else { break };
        place = place.parent().unwrap_or(Path::new("")).join(target);
    }
    place
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt;

    use super::*;

    #[test]
    fn a_file_that_is_replaced_keeps_its_permissions() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.nc");
        std::fs::write(&path, "before").unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o604)).unwrap();
        write_atomically(&path, b"after").unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "after");
        assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o604);
    }
}
