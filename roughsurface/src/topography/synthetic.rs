//! Surfaces with known spectra, for tests.

use super::Topography;
use super::characterize::Options;
use super::fft::transform;
use super::filter::transmission;
use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rustfft::num_complex::Complex;
use std::f64::consts::PI;

const PIXEL: f64 = 0.1e-6;

/// The usual options with a cut-off (m).
pub fn at(cutoff: f64) -> Options {
    Options { cutoff: Some(cutoff), ..Options::default() }
}

fn square(points: usize, heights: Vec<f64>) -> Topography {
    Topography { periodic: true, ..Topography::map((points, PIXEL), (points, PIXEL), heights) }
}

/// a cos(q·r) with whole numbers of waves across and along, |q| and a.
pub fn cosine(rows: usize, columns: usize, waves: (usize, usize)) -> (Topography, f64, f64) {
    let (column_step, amplitude) = (0.2e-6, 3e-8);
    let phase = |place: usize| {
        let (r, c) = ((place / columns) as f64 / rows as f64, (place % columns) as f64 / columns as f64);
        2.0 * PI * (waves.0 as f64 * r + waves.1 as f64 * c)
    };
    let heights = (0..rows * columns).map(|place| amplitude * phase(place).cos()).collect();
    let map = Topography { rows, columns, column_step, heights, ..square(rows, Vec::new()) };
    let (across, along) = map.size();
    let q = 2.0 * PI * (waves.0 as f64 / across).hypot(waves.1 as f64 / along);
    (map, q, amplitude)
}

/// a cos(qx) cos(qy) with that many waves each way, q and a.
pub fn egg_box(points: usize, waves: usize) -> (Topography, f64, f64) {
    let (q, amplitude) = (2.0 * PI * waves as f64 / (points as f64 * PIXEL), 1e-8);
    let wave = |index: usize| (q * PIXEL * index as f64).cos();
    let heights = (0..points * points).map(|p| amplitude * wave(p / points) * wave(p % points)).collect();
    (square(points, heights), q, amplitude)
}

/// Power of a wave: constant up to a roll-off, q^{−2−2H} to the shortest wavelength, then zero.
#[derive(Clone, Copy)]
pub struct SelfAffine {
    pub points: usize,
    pub hurst: f64,
    /// Wavelength of the roll-off, in pixels.
    pub roll_off_pixels: f64,
    /// Shortest wavelength, in pixels.
    pub shortest_pixels: f64,
}

impl Default for SelfAffine {
    fn default() -> Self {
        Self { points: 256, hurst: 0.8, roll_off_pixels: 64.0, shortest_pixels: 8.0 }
    }
}

impl SelfAffine {
    pub fn shortest(&self) -> f64 {
        self.shortest_pixels * PIXEL
    }

    /// Power of a wave, m².
    pub fn power(&self, q: f64) -> f64 {
        let roll_off = 2.0 * PI / (self.roll_off_pixels * PIXEL);
        if q > 2.0 * PI / self.shortest() {
            return 0.0;
        }
        1e-20 * (q.max(roll_off) / roll_off).powf(-2.0 - 2.0 * self.hurst)
    }

    /// Wavenumber of the wave at a place of the transform.
    fn wavenumber(&self, place: usize) -> f64 {
        let n = self.points;
        let signed = |index: usize| if 2 * index > n { index as f64 - n as f64 } else { index as f64 };
        2.0 * PI / (n as f64 * PIXEL) * signed(place / n).hypot(signed(place % n))
    }

    /// m_n of the map after the filter: the sum over its waves of power·transmission²·qⁿ·(1, 1/2, 3/8).
    pub fn sum(&self, n: i32, cutoff: f64) -> f64 {
        let of = |place: usize| {
            let q = self.wavenumber(place);
            self.power(q) * transmission(q, cutoff).powi(2) * q.powi(n)
        };
        [1.0, 0.0, 0.5, 0.0, 0.375][n as usize] * (1..self.points * self.points).map(of).sum::<f64>()
    }

    /// A map with exactly that power in every wave, phases those of white noise.
    pub fn map(&self, seed: u64) -> Topography {
        self.with_noise(seed, 0.0)
    }

    /// A map with exactly that power in every wave, with white noise of the power `noise` a wave (m²) added.
    pub fn with_noise(&self, seed: u64, noise: f64) -> Topography {
        let n = self.points;
        let mut random = crate::surface::heights::Random::seed_from_u64(seed);
        let mut waves: Vec<Complex<f64>> =
            (0..n * n).map(|_| Complex::new(random.sample::<f64, _>(StandardNormal), 0.0)).collect();
        transform(&mut waves, n, n, false);
        for (place, wave) in waves.iter_mut().enumerate() {
            let power = if place == 0 { 0.0 } else { self.power(self.wavenumber(place)) + noise };
            *wave *= (n * n) as f64 * power.sqrt() / wave.norm();
        }
        transform(&mut waves, n, n, true);
        square(n, waves.into_iter().map(|wave| wave.re).collect())
    }

    /// A quarter of the map, which does not continue at its edges.
    pub fn quarter(&self, seed: u64) -> Topography {
        let (whole, half) = (self.map(seed), self.points / 2);
        let heights = (0..half * half).map(|p| whole.heights[p / half * self.points + p % half]).collect();
        Topography { periodic: false, ..square(half, heights) }
    }
}
