//! Fourier transforms of maps and profiles.

use rayon::prelude::*;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use std::f64::consts::PI;

use super::Topography;

/// Transforms `data`, rows × columns, in place; the inverse is divided by the number of points.
fn transform(data: &mut Vec<Complex<f64>>, rows: usize, columns: usize, inverse: bool) {
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
    /// Of the heights of `topography`, each times its `weight`.
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

    /// The sum of the waves, each times a factor of its (q_y, q_x).
    pub(super) fn sum(&self, factor: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let scaled = |(place, amplitude): (usize, &Complex<f64>)| {
            let (y, x) = self.wavenumbers(place);
            amplitude * factor(y, x)
        };
        let mut data: Vec<_> = self.amplitudes.iter().enumerate().map(scaled).collect();
        transform(&mut data, self.rows, self.columns, true);
        data.into_iter().map(|value| value.re).collect()
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
