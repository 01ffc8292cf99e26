//! Journal of a long computation: one line of JSON with a checksum for each result, written through to the disk, so
//! that a crash loses only unfinished results. A damaged or incomplete line is skipped.
//!
//! A line is the CRC-32 of the rest, a space, and JSON. The file is locked while it is open: one program writes it.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// An open journal.
pub struct JournalFile {
    path: PathBuf,
    file: File,
    /// The last line is incomplete.
    torn: bool,
}

impl JournalFile {
    /// Opens or makes the journal; the text that it holds is returned. The error is of kind `WouldBlock` if another
    /// program has it open.
    pub fn open(path: &Path) -> io::Result<(Self, String)> {
        let mut file = open_locked(path)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        // Keep the next line apart from one that was cut off.
        let torn = !text.is_empty() && !text.ends_with('\n');
        Ok((Self { path: path.to_owned(), file, torn }, text))
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Removes all lines.
    pub fn clear(&mut self) -> io::Result<()> {
        self.torn = false;
        self.file.set_len(0)
    }

    /// Writes a line through to the disk. The error is of kind `NotFound` if the file has been removed or replaced.
    pub fn append(&mut self, value: &impl Serialize) -> io::Result<()> {
        let start = if self.torn { "\n" } else { "" };
        let line = format!("{start}{}", encode(value)?);
        if !leads_to(&self.path, &self.file) {
            return Err(io::ErrorKind::NotFound.into());
        }
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.sync_data());
        self.torn = written.is_err();
        written
    }

    /// Reserves disk space, where the system can; the error is that there is not as much.
    #[cfg(target_os = "linux")]
    pub fn reserve(&self, bytes: usize) -> io::Result<()> {
        use rustix::fs::{FallocateFlags, fallocate};
        use rustix::io::Errno;

        let end = self.file.metadata().map_or(0, |data| data.len());
        if bytes == 0 {
            return Ok(());
        }
        match fallocate(&self.file, FallocateFlags::KEEP_SIZE, end, bytes as u64) {
            Err(error @ (Errno::NOSPC | Errno::DQUOT | Errno::FBIG)) => Err(error.into()),
            // Other errors: the file system cannot reserve.
            _ => Ok(()),
        }
    }

    /// This system has no reservation.
    #[cfg(not(target_os = "linux"))]
    pub fn reserve(&self, _bytes: usize) -> io::Result<()> {
        Ok(())
    }

    /// Removes the file, unless the name leads to another by now.
    pub fn remove(self) -> io::Result<()> {
        if leads_to(&self.path, &self.file) { std::fs::remove_file(&self.path) } else { Ok(()) }
    }
}

/// The line of a value, with its end.
pub fn encode(value: &impl Serialize) -> io::Result<String> {
    let json = serde_json::to_string(value)?;
    Ok(format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes())))
}

/// The value of a line, if it is intact.
pub fn decode<T: for<'a> Deserialize<'a>>(line: &str) -> Option<T> {
    let (checksum, json) = line.split_once(' ')?;
    let checksum = u32::from_str_radix(checksum, 16).ok()?;
    let intact = checksum == crc32fast::hash(json.as_bytes());
    intact.then(|| serde_json::from_str(json).ok()).flatten()
}

/// The file at `path`, made if need be, which no other program has open as a journal.
fn open_locked(path: &Path) -> io::Result<File> {
    loop {
        let file = OpenOptions::new().read(true).append(true).create(true).open(path)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(io::ErrorKind::WouldBlock.into()),
            // Some network file systems have no locks.
            Err(TryLockError::Error(_)) => {}
        }
        // The program that had it open before may have removed it in between.
        if leads_to(path, &file) {
            return Ok(file);
        }
    }
}

/// Whether the name still leads to the open file.
#[cfg(unix)]
fn leads_to(path: &Path, file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (std::fs::metadata(path), file.metadata()) {
        (Ok(named), Ok(open)) => (named.dev(), named.ino()) == (open.dev(), open.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn leads_to(path: &Path, _file: &File) -> bool {
    path.exists()
}
