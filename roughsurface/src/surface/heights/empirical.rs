use super::distribution::{Heights, Random};
use super::text_file::TextFile;
use rand::RngExt;
use std::path::Path;

/// Empirical distribution: heights that are measured or drawn, each with an equal share of the summits.
#[derive(Clone, Debug)]
pub struct Empirical {
    /// Highest first, m.
    heights: Vec<f64>,
    std: f64,
}

impl Empirical {
    /// A set of at least two different finite heights (m), beyond the rounding of their mean.
    pub fn new(mut heights: Vec<f64>) -> Option<Self> {
        const ROUNDING: f64 = 1e-12;
        heights.sort_unstable_by(|one, other| other.total_cmp(one));
        let count = heights.len() as f64;
        let mean = heights.iter().sum::<f64>() / count;
        let variance = heights.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / count;
        let highest = heights.iter().fold(0.0, |highest: f64, z| highest.max(z.abs()));
        (variance.sqrt() > ROUNDING * highest && variance.is_finite())
            .then_some(Self { heights, std: variance.sqrt() })
    }

    /// A part of a set of heights (m) with the standard deviation `std` (m) of the set; the heights may be equal, one or none.
    pub(crate) fn part(mut heights: Vec<f64>, std: f64) -> Self {
        heights.sort_unstable_by(|one, other| other.total_cmp(one));
        Self { heights, std }
    }

    pub(crate) fn count(&self) -> usize {
        self.heights.len()
    }

    /// Reads heights of summits in metres, separated by white space or commas; `#` starts a comment.
    pub fn read(file: &Path) -> Result<Self, String> {
        /// Least number of lines, and of numbers in each, of a map.
        const LEAST_MAP: usize = 16;
        let file = TextFile::read(file)?;
        let mut heights = Vec::new();
        let mut words_of_lines = Vec::new();
        for (index, _, words) in file.lines() {
            let before = heights.len();
            for word in words {
                match word.parse::<f64>() {
                    Ok(height) if height.is_finite() => heights.push(height),
                    _ => return Err(file.error_in(index, word, "not a height in metres")),
                }
            }
            words_of_lines.extend(Some(heights.len() - before).filter(|count| *count > 0));
        }
        let first = words_of_lines.first().copied().unwrap_or_default();
        let is_matrix = words_of_lines.iter().all(|count| *count == first);
        let what = match (first, words_of_lines.len()) {
            (2, 3..) if is_matrix => "positions and heights",
            (LEAST_MAP.., LEAST_MAP..) if is_matrix => "a map of heights",
            _ => "",
        };
        if !what.is_empty() {
            let numbers = if first == 2 { "two".to_owned() } else { first.to_string() };
            return Err(file.error(&format!(
                "has {numbers} numbers in every line, as of {what}: write the heights of the summits alone, one in a line; \
                 a profile or a map of the surface is given in place of the surface file, as a topography"
            )));
        }
        Self::new(heights).ok_or_else(|| file.error("must hold at least two different heights in metres"))
    }
}

impl Heights for Empirical {
    fn ln_density(&self, _height: f64) -> f64 {
        unreachable!("heights of a finite set are summed one by one")
    }
    fn tail(&self, height: f64) -> f64 {
        let above = self.heights.partition_point(|&z| z > height);
        above as f64 / self.heights.len() as f64
    }
    fn mode(&self) -> f64 {
        self.heights[self.heights.len() / 2]
    }
    fn support(&self) -> (f64, f64) {
        (self.heights[self.heights.len() - 1], self.heights[0])
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        self.heights[random.random_range(0..self.heights.len())]
    }
    fn finite_set(&self) -> Option<&[f64]> {
        Some(&self.heights)
    }
}
