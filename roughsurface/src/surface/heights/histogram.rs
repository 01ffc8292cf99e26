use super::distribution::{Heights, Random};
use super::text_file::TextFile;
use rand::RngExt;
use std::path::Path;

/// Rules for a line of a file, and for the whole.
const LINE: &str = "not the lower edge of a bin (m) and its count, or after the last bin its upper edge";
const FILE: &str = "must hold ascending edges in metres with counts that are not negative, and a last line with \
                    the upper edge alone";

/// Heights counted in bins, evenly spread within each.
#[derive(Clone, Debug)]
pub struct Histogram {
    /// Edges of the bins, ascending, m: one more than bins.
    edges: Vec<f64>,
    /// ln φ in each bin, φ in 1/m; −∞ in empty ones.
    ln_density: Vec<f64>,
    /// Share of the summits above each edge.
    above: Vec<f64>,
    std: f64,
}

impl Histogram {
    /// Bins between ascending `edges` (m) and the count of each, in any unit; none unless
    /// there is one edge more than counts, and something was counted.
    pub fn new(edges: Vec<f64>, counts: &[f64]) -> Option<Self> {
        let ascending = edges.windows(2).all(|pair| pair[0] < pair[1]);
        let finite = edges.iter().all(|edge| edge.is_finite());
        let counted = counts.iter().all(|count| *count >= 0.0 && count.is_finite());
        let total: f64 = counts.iter().sum();
        if !(ascending && finite && counted && total > 0.0 && edges.len() == counts.len() + 1) {
            return None;
        }
        // Empty bins at the ends are no part of the support.
        let first = counts.iter().position(|count| *count > 0.0)?;
        let last = counts.iter().rposition(|count| *count > 0.0)?;
        let (edges, counts) = (&edges[first..=last + 1], &counts[first..=last]);
        let mut above = vec![0.0; edges.len()];
        for bin in (0..counts.len()).rev() {
            above[bin] = above[bin + 1] + counts[bin] / total;
        }
        // Rounding of the sum.
        above[0] = 1.0;
        let middle = |bin: usize| 0.5 * (edges[bin] + edges[bin + 1]);
        let width = |bin: usize| edges[bin + 1] - edges[bin];
        let mean: f64 = (0..counts.len()).map(|bin| counts[bin] / total * middle(bin)).sum();
        let variance: f64 = (0..counts.len())
            .map(|bin| counts[bin] / total * ((middle(bin) - mean).powi(2) + width(bin).powi(2) / 12.0))
            .sum();
        let ln_density = (0..counts.len()).map(|bin| (counts[bin] / total / width(bin)).ln()).collect();
        Some(Self { edges: edges.to_vec(), ln_density, above, std: variance.sqrt() })
    }

    /// Reads a file of two columns, the lower edge of a bin in metres and its count,
    /// and a last line with the upper edge alone; white space or a comma between columns, `#`
    /// starts a comment.
    pub fn read(file: &Path) -> Result<Self, String> {
        let file = TextFile::read(file)?;
        let (mut edges, mut counts) = (Vec::new(), Vec::new());
        for (index, line, words) in file.lines() {
            let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
            match numbers.as_deref() {
                Ok([]) => {}
                // The upper edge ends the histogram.
                Ok([edge, rest @ ..]) if rest.len() <= 1 && edges.len() == counts.len() => {
                    edges.push(*edge);
                    counts.extend(rest);
                }
                _ => return Err(file.error_in(index, line, LINE)),
            }
        }
        Self::new(edges, &counts).ok_or_else(|| file.error(FILE))
    }

    /// Bin of a height within the support.
    fn bin(&self, height: f64) -> usize {
        self.edges.partition_point(|edge| *edge <= height).clamp(1, self.ln_density.len()) - 1
    }
}

impl Heights for Histogram {
    fn ln_density(&self, height: f64) -> f64 {
        let (lowest, highest) = self.support();
        if (lowest..=highest).contains(&height) {
            self.ln_density[self.bin(height)]
        } else {
            f64::NEG_INFINITY
        }
    }
    fn tail(&self, height: f64) -> f64 {
        let (lowest, highest) = self.support();
        let height = height.clamp(lowest, highest);
        let bin = self.bin(height);
        let share = (self.edges[bin + 1] - height) / (self.edges[bin + 1] - self.edges[bin]);
        self.above[bin + 1] + share * (self.above[bin] - self.above[bin + 1])
    }
    fn mode(&self) -> f64 {
        let highest = (0..self.ln_density.len())
            .max_by(|&one, &other| self.ln_density[one].total_cmp(&self.ln_density[other]));
        highest.map_or(f64::NAN, |bin| 0.5 * (self.edges[bin] + self.edges[bin + 1]))
    }
    fn ln_peak(&self, from: f64, to: f64) -> f64 {
        let (lowest, highest) = self.support();
        if to < lowest || from > highest || to < from {
            return f64::NEG_INFINITY;
        }
        let bins = self.bin(from)..=self.bin(to);
        self.ln_density[bins].iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
    fn step_between(&self, from: f64, to: f64) -> Option<f64> {
        let first = self.edges.partition_point(|edge| *edge <= from);
        let end = self.edges.partition_point(|edge| *edge < to);
        (first < end).then(|| self.edges[(first + end) / 2])
    }
    fn support(&self) -> (f64, f64) {
        (self.edges[0], self.edges[self.edges.len() - 1])
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        let wanted = random.random::<f64>();
        let bin = self.above.partition_point(|above| *above > wanted).clamp(1, self.ln_density.len()) - 1;
        let share = (self.above[bin] - wanted) / (self.above[bin] - self.above[bin + 1]);
        self.edges[bin] + share.clamp(0.0, 1.0) * (self.edges[bin + 1] - self.edges[bin])
    }
}
