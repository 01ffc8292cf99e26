//! The header of a classic netCDF file, checked before the netCDF library reads it.
//!
//! The library allocates memory by the counts of a header before it checks whether the file
//! contains the data: gigabytes for a small file with a damaged count. The format: NetCDF Users Guide,
//! appendix "File Format Specifications" (CDF-1, CDF-2, CDF-5).

const DIMENSIONS: u64 = 0x0A;
const VARIABLES: u64 = 0x0B;
const ATTRIBUTES: u64 = 0x0C;
/// Bytes of the external types byte, char, short, int, float, double and, of CDF-5, ubyte to uint64.
const TYPE_SIZES: [u64; 11] = [1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8];

/// Error in the header of a classic file; none for other files.
pub(super) fn damage(bytes: &[u8]) -> Option<&'static str> {
    let version = bytes.strip_prefix(b"CDF").and_then(|rest| rest.first())?;
    let wide = match version {
        1 | 2 => false,
        5 => true,
        _ => return Some("damaged: a classic netCDF file of an unknown version"),
    };
    let mut header = Header { rest: &bytes[4..], wide, place: if *version == 1 { 4 } else { 8 } };
    header.walk().is_none().then_some("damaged: its header asks for more than the file holds")
}

struct Header<'a> {
    rest: &'a [u8],
    /// Counts have eight bytes, not four.
    wide: bool,
    /// Bytes of a place in the file.
    place: u64,
}

impl Header<'_> {
    fn walk(&mut self) -> Option<()> {
        // Number of records.
        self.count()?;
        let dimensions = self.list(DIMENSIONS)?;
        for _ in 0..dimensions {
            self.name()?;
            self.count()?;
        }
        self.attributes()?;
        for _ in 0..self.list(VARIABLES)? {
            self.name()?;
            let count = self.count()?;
            let size = if self.wide { 8 } else { 4 };
            self.skip(count.checked_mul(size)?)?;
            self.attributes()?;
            self.number(4)?;
            self.count()?;
            self.skip(self.place)?;
        }
        Some(())
    }

    fn attributes(&mut self) -> Option<()> {
        for _ in 0..self.list(ATTRIBUTES)? {
            self.name()?;
            let kind = self.number(4)?.checked_sub(1)?;
            let size = TYPE_SIZES.get(usize::try_from(kind).ok()?)?;
            let count = self.count()?;
            self.skip_padded(count.checked_mul(*size)?)?;
        }
        Some(())
    }

    /// Number of entries of a list; an absent one has neither tag nor entries. Each entry takes four bytes
    /// at the very least.
    fn list(&mut self, tag: u64) -> Option<u64> {
        let found = self.number(4)?;
        let count = self.count()?;
        let absent = found == 0 && count == 0;
        (absent || (found == tag && count <= self.rest.len() as u64 / 4)).then_some(count)
    }

    fn name(&mut self) -> Option<()> {
        let length = self.count()?;
        self.skip_padded(length)
    }

    fn count(&mut self) -> Option<u64> {
        self.number(if self.wide { 8 } else { 4 })
    }

    fn number(&mut self, size: u64) -> Option<u64> {
        let (digits, rest) = self.rest.split_at_checked(size as usize)?;
        self.rest = rest;
        Some(digits.iter().fold(0, |number, digit| number << 8 | u64::from(*digit)))
    }

    fn skip(&mut self, bytes: u64) -> Option<()> {
        self.rest = self.rest.get(usize::try_from(bytes).ok()?..)?;
        Some(())
    }

    /// Values are filled up to a multiple of four bytes.
    fn skip_padded(&mut self, bytes: u64) -> Option<()> {
        self.skip(bytes.checked_next_multiple_of(4)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One dimension "x" of 3, one attribute "unit" = "m", one variable "heights" over x.
    fn file() -> Vec<u8> {
        let word = |number: u32| number.to_be_bytes();
        let mut bytes = b"CDF\x02".to_vec();
        for piece in [&word(0), &word(10), &word(1), &word(1), b"x\0\0\0", &word(3)] {
            bytes.extend_from_slice(piece);
        }
        for piece in [&word(12), &word(1), &word(4), b"unit", &word(2), &word(1), b"m\0\0\0"] {
            bytes.extend_from_slice(piece);
        }
        for piece in [&word(11)[..], &word(1), &word(7), b"heights\0", &word(1), &word(0)] {
            bytes.extend_from_slice(piece);
        }
        for piece in [word(0), word(0), word(6), word(24), word(0), word(120)] {
            bytes.extend_from_slice(&piece);
        }
        bytes
    }

    #[test]
    fn a_header_that_ends_in_the_file_is_let_through() {
        assert_eq!(damage(&file()), None);
        assert_eq!(damage(b"\x89HDF"), None);
        for cut in 4..file().len() {
            assert!(damage(&file()[..cut]).is_some(), "{cut}");
        }
    }

    #[test]
    fn counts_beyond_the_file_are_refused() {
        // Number of dimensions, length of a name, of an attribute, number of variables, of their dimensions.
        for at in [12, 16, 48, 60, 76] {
            let mut bytes = file();
            bytes[at] = 0x0f;
            assert!(damage(&bytes).is_some(), "{at}");
        }
        assert!(damage(b"CDF\x07").unwrap().contains("unknown version"));
    }
}
