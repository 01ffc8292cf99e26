//! Files that appear whole or not at all.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempPath;

/// Writes a file under a temporary name in the folder of `path`, and renames it once it is complete and on the disk.
/// A file of that name is replaced; symbolic links are followed.
///
/// ```
/// use std::io::Write;
/// use tables::netcdf::write_atomically;
///
/// let path = std::env::temp_dir().join(format!("atomic-example-{}.txt", std::process::id()));
/// write_atomically(&path, |file| writeln!(file, "whole"))?;
/// assert_eq!(std::fs::read_to_string(&path)?, "whole\n");
/// // A file that could not be completed is removed, and the previous one is unchanged.
/// assert!(write_atomically(&path, |_| Err(std::io::Error::other("no data"))).is_err());
/// assert_eq!(std::fs::read_to_string(&path)?, "whole\n");
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let temporary = Temporary::beside(path)?;
    let mut file = File::options().write(true).open(&temporary.place)?;
    write(&mut file)?;
    file.sync_all()?;
    drop(file);
    temporary.persist()
}

/// An empty file under a temporary name, removed when it is dropped.
pub(super) struct Temporary {
    /// Where it is.
    pub(super) place: TempPath,
    destination: PathBuf,
}

impl Temporary {
    pub(super) fn beside(path: &Path) -> io::Result<Self> {
        let destination = destination(path);
        let folder = match destination.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let name = destination.file_name().unwrap_or_default().to_string_lossy();
        let prefix = format!(".{name}.");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".partial");
        // As for any new file: temporary files are for their owner only.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        // The message of the library names the temporary file instead of the requested one.
        let file = builder.tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
        Ok(Self { place: file.into_temp_path(), destination })
    }

    /// Gives the file its name.
    pub(super) fn persist(self) -> io::Result<()> {
        self.place.persist(&self.destination).map_err(|error| error.error)
    }
}

/// The path that a file called `path` is written to: links are followed, also those without a target.
///
/// A file gets its name by being renamed, which would put the file in place of the link, on the disk of
/// the link, and leave the target of the link unchanged.
///
/// ```
/// use tables::netcdf::destination;
///
/// let folder = std::env::temp_dir().join(format!("destination-example-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// # #[cfg(unix)] {
/// std::os::unix::fs::symlink("large-disk.nc", folder.join("table.nc"))?;
/// assert_eq!(destination(&folder.join("table.nc")), folder.join("large-disk.nc"));
/// # }
/// assert_eq!(destination(&folder.join("other.nc")), folder.join("other.nc"));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn destination(path: &Path) -> PathBuf {
    let mut place = path.to_path_buf();
    // As many in a row as Linux follows.
    for _ in 0..40 {
        let Ok(target) = std::fs::read_link(&place) else { break };
        place = place.parent().unwrap_or(Path::new("")).join(target);
    }
    place
}
