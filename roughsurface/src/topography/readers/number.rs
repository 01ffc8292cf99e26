//! Binary numbers.

/// Type of the numbers of a file.
pub(super) struct Number {
    /// `f`, `i` or `u`.
    kind: char,
    /// Bytes.
    pub size: usize,
    big_endian: bool,
}

impl Number {
    /// Format of a number type as NumPy writes it, such as `<f8`.
    pub fn of(text: &str) -> Option<Self> {
        let [order, kind, size] = text.chars().collect::<Vec<_>>()[..] else { return None };
        let size = size.to_digit(10)? as usize;
        matches!((kind, size), ('f', 4 | 8) | ('i' | 'u', 1 | 2 | 4 | 8)).then_some(Self {
            kind,
            size,
            big_endian: order == '>',
        })
    }

    /// The numbers that `data` holds.
    pub fn read(&self, data: &[u8]) -> impl Iterator<Item = f64> {
        data.chunks_exact(self.size).map(|bytes| self.read_one(bytes))
    }

    fn read_one(&self, bytes: &[u8]) -> f64 {
        let byte = |place: usize| bytes[if self.big_endian { self.size - 1 - place } else { place }];
        let bits = (0..self.size).fold(0, |bits, place| bits | u64::from(byte(place)) << (8 * place));
        let unused = 64 - 8 * self.size as u32;
        match (self.kind, self.size) {
            ('f', 4) => f64::from(f32::from_bits(bits as u32)),
            ('f', _) => f64::from_bits(bits),
            // The sign is that of the highest bit.
            ('i', _) => ((bits << unused) as i64 >> unused) as f64,
            _ => bits as f64,
        }
    }
}
