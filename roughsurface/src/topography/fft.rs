//! Fourier transforms of maps and profiles.

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use std::f64::consts::PI;

use super::Topography;

/// Transforms `data`, rows × columns, in place; the inverse is divided by the number of points.
pub(super) fn transform(data: &mut Vec<Complex<f64>>, rows: usize, columns: usize, inverse: bool) {
    let mut planner = FftPlanner::new();
    let mut along_rows = |data: &mut [Complex<f64>], columns: usize| {
        let plan = match inverse {
            true => planner.plan_fft_inverse(columns),
            false => planner.plan_fft_forward(columns),
        };
        data.par_chunks_exact_mut(columns).for_each(|row| plan.process(row));
    };
    along_rows(data, columns);
    if rows > 1 {
        let mut turned = transposed(data, rows, columns);
        along_rows(&mut turned, rows);
        *data = transposed(&turned, columns, rows);
    }
    if inverse {
        let scale = 1.0 / (rows * columns) as f64;
        data.iter_mut().for_each(|value| *value *= scale);
    }
}

fn transposed(data: &[Complex<f64>], rows: usize, columns: usize) -> Vec<Complex<f64>> {
    (0..data.len()).map(|place| data[place % rows * columns + place / rows]).collect()
}

/// A topography as a sum of waves.
pub(super) struct Waves {
    rows: usize,
    columns: usize,
    steps: (f64, f64),
    amplitudes: Vec<Complex<f64>>,
}

impl Waves {
    /// Waves of the heights of `topography`, each times its `weight`.
    pub(super) fn of(topography: &Topography, weight: impl Fn(usize, usize) -> f64) -> Self {
        let (rows, columns) = (topography.rows, topography.columns);
        let weighted = |(place, height): (usize, &f64)| {
            Complex::new(height * weight(place / columns, place % columns), 0.0)
        };
        let mut amplitudes: Vec<_> = topography.heights.iter().enumerate().map(weighted).collect();
        transform(&mut amplitudes, rows, columns, false);
        Self { rows, columns, steps: (topography.row_step, topography.column_step), amplitudes }
    }

    /// (q_y, q_x, share of the mean square) of every wave but the mean, q in rad/m.
    pub(super) fn powers(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let scale = 1.0 / (self.amplitudes.len() as f64).powi(2);
        self.amplitudes.iter().enumerate().skip(1).map(move |(place, amplitude)| {
            let (y, x) = self.wavenumbers(place);
            (y, x, scale * amplitude.norm_sqr())
        })
    }

    /// The sum of the waves, each times a `factor` of its (q_y, q_x), on a grid of `refined` times as many rows and
    /// columns. With a complex factor real and imaginary parts are two fields.
    ///
    /// Waves at the Nyquist wavenumber are left out: between the points their sign is unknown.
    pub(super) fn sum(
        &self,
        (more_rows, more_columns): (usize, usize),
        factor: impl Fn(f64, f64) -> Complex<f64>,
    ) -> Vec<Complex<f64>> {
        let (rows, columns) = (self.rows, self.columns);
        let nyquist = |place: usize| 2 * (place / columns) == rows || 2 * (place % columns) == columns;
        let scaled = |(place, amplitude): (usize, &Complex<f64>)| match nyquist(place) {
            true => Complex::ZERO,
            false => {
                let (y, x) = self.wavenumbers(place);
                amplitude * factor(y, x)
            }
        };
        let waves: Vec<_> = self.amplitudes.iter().enumerate().map(scaled).collect();
        let mut fine = vec![Complex::ZERO; waves.len() * more_rows * more_columns];
        // The refined grid consists of shifted copies of the grid.
        for (down, right) in (0..more_rows).flat_map(|down| (0..more_columns).map(move |right| (down, right)))
        {
            let shift = (
                self.steps.0 * down as f64 / more_rows as f64,
                self.steps.1 * right as f64 / more_columns as f64,
            );
            let turn = |q: f64, shift: f64| Complex::from_polar(1.0, q * shift);
            let across: Vec<_> =
                (0..rows).map(|row| turn(self.wavenumbers(row * columns).0, shift.0)).collect();
            let along: Vec<_> =
                (0..columns).map(|column| turn(self.wavenumbers(column).1, shift.1)).collect();
            let turned = |(place, wave): (usize, &Complex<f64>)| {
                wave * across[place / columns] * along[place % columns]
            };
            let mut copy: Vec<_> = waves.iter().enumerate().map(turned).collect();
            transform(&mut copy, rows, columns, true);
            for (place, value) in copy.into_iter().enumerate() {
                let (row, column) =
                    (place / columns * more_rows + down, place % columns * more_columns + right);
                fine[row * columns * more_columns + column] = value;
            }
        }
        fine
    }

    fn wavenumbers(&self, place: usize) -> (f64, f64) {
        let wavenumber = |index: usize, count: usize, step: f64| {
            let signed = if 2 * index > count { index as f64 - count as f64 } else { index as f64 };
            2.0 * PI * signed / (count as f64 * step)
        };
        (
            wavenumber(place / self.columns, self.rows, self.steps.0),
            wavenumber(place % self.columns, self.columns, self.steps.1),
        )
    }
}
