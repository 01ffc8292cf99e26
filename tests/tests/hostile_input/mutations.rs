//! Damage to good files by a fixed sequence of pseudo-random numbers.

/// splitmix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }
}

/// Numbers and words known for trouble, for text and in binary.
const TROUBLE: [&[u8]; 22] = [
    b"nan",
    b"inf",
    b"-inf",
    b"0",
    b"-1",
    b"1e308",
    b"-1e308",
    b"1e-320",
    b"9223372036854775807",
    b"-9223372036854775808",
    b"1e999",
    b"[]",
    b"{}",
    b"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    b"\"\"\"",
    b"a.b.c.d.e.f=1\n",
    b"\xff\xfe\x00",
    b"\x00\x00\x00\x00\x00\x00\x00\x00",
    b"\xff\xff\xff\xff\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\x00\x00\x00\x00\x00\x00\xf8\x7f",
    b"\n",
];

pub fn mutate(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(4) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        match random.below(7) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes.truncate(at),
            2 => {
                let end = (at + random.below(64)).min(bytes.len());
                bytes.drain(at..end);
            }
            3 => {
                let end = (at + random.below(200)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            4 => {
                let word = TROUBLE[random.below(TROUBLE.len())];
                let end = (at + word.len()).min(bytes.len());
                bytes.splice(at..end, word.iter().copied());
            }
            5 => bytes[at] = random.next() as u8,
            // A number or word of a text.
            _ => {
                let ends = |byte: &u8| b" ,=[]{}\n\t\"".contains(byte);
                let start = bytes[..at].iter().rposition(ends).map_or(0, |k| k + 1);
                let end = at + bytes[at..].iter().position(ends).unwrap_or(0);
                let word = TROUBLE[random.below(TROUBLE.len())];
                bytes.splice(start..end.max(start), word.iter().copied());
            }
        }
    }
    bytes
}

/// Bytes changed where they stand, so that the length is the one that the file states.
pub fn corrupt(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(8) {
        let word = TROUBLE[random.below(TROUBLE.len())];
        let at = random.below(bytes.len() - word.len());
        if random.below(2) == 0 {
            bytes[at] = random.next() as u8;
        } else {
            bytes[at..at + word.len()].copy_from_slice(word);
        }
    }
    bytes
}
