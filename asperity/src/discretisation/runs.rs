//! Vectors restricted to a part of their entries.

use std::ops::Range;

use crate::material::lanes::dot_of_parts;

/// Rising runs of consecutive entries of a vector.
#[derive(Clone, Debug, Default)]
pub struct Runs(Vec<Range<usize>>);

impl Runs {
    /// All entries of a vector.
    pub fn all(vector: &[f64]) -> Self {
        let mut runs = Self::default();
        runs.push(0..vector.len());
        runs
    }

    /// The blocks of `size` entries at rising positions.
    pub fn of_blocks(positions: impl Iterator<Item = usize>, size: usize) -> Self {
        let mut runs = Self::default();
        positions.for_each(|position| runs.push(position * size..(position + 1) * size));
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
        dot_of_parts(self.iter().map(|run| (&a[run.clone()], &b[run])))
    }
}
