//! Filtered heights of a topography that ends at its edges.

use super::Topography;
use super::fft::Waves;
use std::ops::Range;

/// Straight lines over that many cut-offs, or the extent where it is shorter, lead from an edge to the opposite one:
/// a jump between them would ring over the whole map.
const GAP: f64 = 16.0;

/// A topography that is continued to its other side, and the rows and columns from which the filter reaches no
/// continuation: a cut-off away from the edges. Of a periodic one all.
pub(super) struct Continued {
    /// Rows and columns with the continuation.
    pub size: (usize, usize),
    pub waves: Waves,
    pub rows: Range<usize>,
    pub columns: Range<usize>,
}

impl Continued {
    pub(super) fn of(topography: &Topography, periodic: bool, cutoff: f64) -> Self {
        let Topography { rows, columns, row_step, column_step, .. } = *topography;
        let count = |cutoffs: f64, step: f64, count: usize| match periodic || count == 1 {
            true => 0,
            false => ((cutoffs * cutoff / step).ceil() as usize).min(count),
        };
        let (down, right) = (count(GAP, row_step, rows), count(GAP, column_step, columns));
        let lines = topography.heights.chunks_exact(columns);
        let wide: Vec<f64> = lines.flat_map(|row| continued(row.to_vec(), right)).collect();
        let width = columns + right;
        let mut heights = wide.clone();
        heights.resize((rows + down) * width, 0.0);
        for column in 0..width {
            let line = (0..rows).map(|row| wide[row * width + column]).collect();
            for (row, height) in continued(line, down).into_iter().enumerate().skip(rows) {
                heights[row * width + column] = height;
            }
        }
        let whole = Topography::map((rows + down, row_step), (width, column_step), heights);
        let (edge_rows, edge_columns) = (count(1.0, row_step, rows), count(1.0, column_step, columns));
        Self {
            size: (rows + down, width),
            waves: Waves::of(&whole, |_, _| 1.0),
            rows: edge_rows..rows - edge_rows,
            columns: edge_columns..columns - edge_columns,
        }
    }
}

/// Followed by `gap` points on a straight line to its beginning.
fn continued(mut line: Vec<f64>, gap: usize) -> Vec<f64> {
    let (first, last) = (line[0], line[line.len() - 1]);
    line.extend((1..=gap).map(|point| last + (first - last) * point as f64 / (gap + 1) as f64));
    line
}

#[cfg(test)]
mod tests {
    use super::super::filter::transmission;
    use super::super::synthetic::SelfAffine;
    use super::*;
    use rustfft::num_complex::Complex;

    #[test]
    fn curvatures_of_a_part_are_those_of_the_whole() {
        // Long waves without roll-off make the largest jumps, waves down to two points most ringing.
        let surface =
            SelfAffine { points: 512, roll_off_pixels: 512.0, shortest_pixels: 1.4, ..SelfAffine::default() };
        let (whole, part) = (surface.map(1), surface.quarter(1));
        for (pixels, allowed) in [(4.0, 0.02), (8.0, 1e-4)] {
            let cutoff = pixels * whole.pixel();
            let curvatures = |continued: &Continued| {
                continued.waves.sum((1, 1), |y, x| {
                    let square = y * y + x * x;
                    Complex::new(transmission(square.sqrt(), cutoff) * square, 0.0)
                })
            };
            let continued =
                [(&whole, true), (&part, false)].map(|(map, periodic)| Continued::of(map, periodic, cutoff));
            let [exact, found] = [0, 1].map(|i| curvatures(&continued[i]));
            let Continued { size, rows, columns, .. } = &continued[1];
            let (mut error, mut square) = (0.0, 0.0);
            for column in columns.clone() {
                for row in [rows.start, rows.end - 1] {
                    let exact = exact[row * whole.columns + column].re;
                    error += (found[row * size.1 + column].re - exact).powi(2);
                    square += exact.powi(2);
                }
            }
            assert!(error.sqrt() < allowed * square.sqrt(), "{pixels}: {}", (error / square).sqrt());
        }
    }
}
