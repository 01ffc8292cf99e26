//! Checksum of the superblock, the first bytes of an HDF5 file.
//!
//! The image of an open file that `H5Fget_file_image` yields is not marked as open, but HDF5 1.10 leaves the checksum of
//! the marked superblock in it. The format: HDF5 File Format Specification, "Superblock", versions 2 and 3, whose
//! checksum is Jenkins' lookup3 (B. Jenkins, 2006, lookup3.c, `hashlittle`, public domain).

/// Bytes before the checksum, with offsets of eight bytes.
const LENGTH: usize = 44;

/// Writes the checksum of the superblock at the beginning of a file.
pub(super) fn write_checksum(file: &mut [u8]) -> Option<()> {
    let (superblock, rest) = file.split_at_mut_checked(LENGTH)?;
    rest.get_mut(..4)?.copy_from_slice(&lookup3(superblock).to_le_bytes());
    Some(())
}

/// Hash of bytes whose number is no multiple of 12.
fn lookup3(bytes: &[u8]) -> u32 {
    let mut state = [0xdead_beef_u32.wrapping_add(bytes.len() as u32); 3];
    let whole = bytes.chunks_exact(12);
    let mut last = [0; 12];
    last[..whole.remainder().len()].copy_from_slice(whole.remainder());
    for block in whole {
        add(&mut state, block);
        mix(&mut state);
    }
    add(&mut state, &last);
    finish(&mut state);
    state[2]
}

fn add(state: &mut [u32; 3], block: &[u8]) {
    for (sum, word) in state.iter_mut().zip(block.chunks_exact(4)) {
        *sum = sum.wrapping_add(u32::from_le_bytes(word.try_into().expect("four bytes")));
    }
}

fn mix(state: &mut [u32; 3]) {
    for (i, turn) in [4, 6, 8, 16, 19, 4].into_iter().enumerate() {
        let (x, y, z) = (i % 3, (i + 1) % 3, (i + 2) % 3);
        state[x] = state[x].wrapping_sub(state[z]) ^ state[z].rotate_left(turn);
        state[z] = state[z].wrapping_add(state[y]);
    }
}

fn finish(state: &mut [u32; 3]) {
    for (i, turn) in [14, 11, 25, 16, 4, 14, 24].into_iter().enumerate() {
        let (x, y) = ((i + 2) % 3, (i + 1) % 3);
        state[x] = (state[x] ^ state[y]).wrapping_sub(state[y].rotate_left(turn));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the driver in lookup3.c.
    #[test]
    fn the_hash_is_that_of_its_author() {
        assert_eq!(lookup3(b"Four score and seven years ago"), 0x1777_0551);
    }
}
