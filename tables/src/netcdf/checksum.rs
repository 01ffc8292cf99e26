//! A checksum over all bytes of a file, in a line behind the data.
//!
//! The checksum of the content of a table (see [`schema`](super::schema)) is an attribute, which can be read only
//! once the HDF5 library has opened the file; some damage makes that library crash or write outside its memory. So
//! every file ends with a line of its own, which is verified before the library opens it.
//!
//! HDF5 states in its first bytes where its data end, and ignores what follows: to other programs the file is an
//! ordinary one. A program that changes the file drops the line, as HDF5 cuts the file off where its data end. A
//! file with neither the line nor the length that HDF5 states is damaged.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use sha2::{Digest, Sha256};

const MARK: &[u8] = b"\nsha256 of all before this line: ";
const DIGITS: usize = 64;
const LENGTH: usize = MARK.len() + DIGITS + 1;

/// First bytes of an HDF5 file. A superblock of the versions below states at a fixed position where the data end.
const SUPERBLOCK: &[u8] = b"\x89HDF\r\n\x1a\n";
const SUPERBLOCK_VERSIONS: [u8; 2] = [2, 3];
const BYTES_OF_PLACES: u8 = 8;
const END_OF_DATA: usize = 28;
const HEAD: usize = END_OF_DATA + 8;

/// Comment of a TOML file with the checksum of all before it.
const COMMENT: &str = "# sha256 of all before this line: ";

/// A text of lines with the comment that tells whether it was changed.
pub fn with_checksum(text: &str) -> String {
    format!("{text}{COMMENT}{:x}\n", Sha256::digest(text))
}

/// Whether a text is as [`with_checksum`] wrote it.
pub fn is_unchanged(text: &str) -> bool {
    text.rfind(COMMENT).is_some_and(|place| with_checksum(&text[..place]) == text)
}

/// Appends the line to the bytes of a complete file.
pub(super) fn append(bytes: &mut Vec<u8>) -> io::Result<()> {
    let line = line(bytes.as_slice())?;
    bytes.extend(line);
    Ok(())
}

/// Whether the bytes of a file agree with the line at its end.
#[derive(Debug, PartialEq)]
pub(super) enum Checksum {
    Agrees,
    /// Description of the damage.
    Damaged(String),
    /// There is none, and the file is as long as it states if it does.
    Absent,
}

pub(super) fn inspect(file: &mut File) -> io::Result<Checksum> {
    let length = file.metadata()?.len();
    let (mut head, mut end) = (Vec::new(), Vec::new());
    file.rewind()?;
    file.take(HEAD as u64).read_to_end(&mut head)?;
    let before = length.saturating_sub(LENGTH as u64);
    file.seek(SeekFrom::Start(before))?;
    file.take(LENGTH as u64).read_to_end(&mut end)?;
    if end.len() == LENGTH && end.starts_with(MARK) {
        file.seek(SeekFrom::Start(0))?;
        let whole = line(file.take(before))? == end;
        let broken = || Checksum::Damaged("damaged: its bytes do not agree with their checksum".to_string());
        return Ok(if whole { Checksum::Agrees } else { broken() });
    }
    let other_length = stated_length(&head).filter(|stated| *stated != length);
    Ok(other_length.map_or(Checksum::Absent, |stated| {
        let text = "bytes and no checksum, and states that its data end at";
        Checksum::Damaged(format!("damaged: it has {length} {text} {stated}"))
    }))
}

/// The line with the checksum of all bytes.
fn line(mut bytes: impl Read) -> io::Result<Vec<u8>> {
    let mut digest = Sha256::new();
    io::copy(&mut bytes, &mut digest)?;
    let mut line = MARK.to_vec();
    writeln!(line, "{:x}", digest.finalize())?;
    Ok(line)
}

/// Byte at which the data end, if this is the beginning of an HDF5 file as netCDF writes them.
fn stated_length(head: &[u8]) -> Option<u64> {
    let known = head.starts_with(SUPERBLOCK)
        && SUPERBLOCK_VERSIONS.contains(head.get(SUPERBLOCK.len())?)
        && *head.get(SUPERBLOCK.len() + 1)? == BYTES_OF_PLACES;
    let stated = head.get(END_OF_DATA..HEAD)?;
    known.then(|| u64::from_le_bytes(stated.try_into().expect("eight bytes")))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::netcdf::{DatasetReader, DatasetWriter};

    /// A small file as this crate writes it, and where its data end.
    fn file_with_checksum(directory: &Path) -> (std::path::PathBuf, Vec<u8>, usize) {
        let path = directory.join("checksum.nc");
        let mut file = DatasetWriter::create(&path, "checksum").unwrap();
        file.coordinate("x", &[0.0, 1.0, 2.0], &[]).unwrap();
        file.finish().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let end = bytes.len() - LENGTH;
        (path, bytes, end)
    }

    fn refused(path: &Path, bytes: &[u8]) -> Option<String> {
        std::fs::remove_file(path).unwrap();
        std::fs::write(path, bytes).unwrap();
        DatasetReader::open(path).err().map(|error| error.to_string())
    }

    /// Detects any changed bit and any truncation, except the one that removes exactly the whole line, after
    /// which the file is one without a checksum.
    #[test]
    fn any_single_damage_is_found_before_the_library_sees_it() {
        let directory = tempfile::tempdir().unwrap();
        let (path, bytes, end) = file_with_checksum(directory.path());
        assert_eq!(stated_length(&bytes), Some(end as u64));
        assert_eq!(refused(&path, &bytes), None);
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 1 << (at % 8);
            let message = refused(&path, &changed).unwrap_or_else(|| panic!("byte {at} of {}", bytes.len()));
            assert!(message.contains("damaged: "), "{at}: {message}");
            let message = refused(&path, &bytes[..at]);
            assert_eq!(message.is_none(), at == end, "cut off at {at}: {message:?}");
        }
        assert!(refused(&path, &[&bytes[..], b"more"].concat()).unwrap().contains("no checksum"));
    }

    #[test]
    fn a_file_that_another_program_changed_is_read() {
        let directory = tempfile::tempdir().unwrap();
        let (path, bytes, _) = file_with_checksum(directory.path());
        ::netcdf::append(&path).unwrap().add_attribute("note", "added").unwrap();
        assert!(!std::fs::read(&path).unwrap().ends_with(&bytes[bytes.len() - LENGTH..]));
        assert_eq!(DatasetReader::open(&path).unwrap().attribute_text("note").unwrap(), "added");
    }
}
