//! Parts of vectors.

use std::ops::Range;

use crate::material::lanes::fma;

/// Entries of a vector as runs of consecutive ones, rising.
#[derive(Clone, Debug, Default)]
pub struct Runs(Vec<Range<usize>>);

impl Runs {
    /// The blocks of `size` entries at rising places.
    pub fn of_blocks(places: impl Iterator<Item = usize>, size: usize) -> Self {
        let mut runs = Self::default();
        places.for_each(|place| runs.push(place * size..(place + 1) * size));
        runs
    }

    /// Adds entries after all others.
    pub fn push(&mut self, entries: Range<usize>) {
        match self.0.last_mut() {
            Some(last) if last.end == entries.start => last.end = entries.end,
            _ => self.0.push(entries),
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.0.iter().cloned()
    }

    /// Each of these entries of `target` with that of `source`.
    pub fn update<T: Copy>(&self, target: &mut [T], source: &[T], f: impl Fn(&mut T, T)) {
        for run in self.iter() {
            target[run.clone()].iter_mut().zip(&source[run]).for_each(|(target, &source)| f(target, source));
        }
    }

    /// Scalar product over these entries.
    pub fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        // Eight sums, in a fixed order, for the machine's vector units.
        let mut sums = [0.0; 8];
        let mut rest = 0.0;
        for run in self.iter() {
            let (a8, a_rest) = a[run.clone()].as_chunks::<8>();
            let (b8, b_rest) = b[run].as_chunks::<8>();
            for (x, y) in a8.iter().zip(b8) {
                for l in 0..8 {
                    sums[l] = fma(x[l], y[l], sums[l]);
                }
            }
            rest += a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum::<f64>();
        }
        sums.iter().sum::<f64>() + rest
    }
}
