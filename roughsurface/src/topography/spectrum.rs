//! The spectrum of a topography, and where it ends.

use super::Topography;
use super::fft::Waves;
use super::filter::{of_surface, transmission};
use super::noise::{Bin, white};
use std::f64::consts::PI;

/// Treatment of the edges of a topography that is not periodic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Window {
    /// Hann's taper for the spectrum, scaled to keep the mean square; moments without the edges.
    #[default]
    Hann,
    /// As of a periodic topography.
    None,
}

impl Window {
    /// Whether the topography is taken to continue at its other side.
    pub(super) fn continues(self, topography: &Topography) -> bool {
        topography.periodic || self == Self::None
    }

    fn weight(self, topography: &Topography) -> impl Fn(usize, usize) -> f64 + use<> {
        let tapered = !self.continues(topography);
        let (rows, columns) = (topography.rows, topography.columns);
        // ⟨sin⁴⟩ = 3/8.
        let hann = move |index: usize, count: usize| match tapered && count > 1 {
            true => (8.0f64 / 3.0).sqrt() * (PI * (index as f64 + 0.5) / count as f64).sin().powi(2),
            false => 1.0,
        };
        move |row, column| hann(row, rows) * hann(column, columns)
    }

    /// The tapered waves of a topography.
    pub(super) fn waves(self, topography: &Topography) -> Waves {
        Waves::of(topography, self.weight(topography))
    }

    /// Number of independent waves over that without a window: 1/⟨w⁴⟩ for each direction, ⟨w²⟩ = 1.
    fn independent(self, topography: &Topography) -> f64 {
        let hann = 18.0f64 / 35.0;
        match self.continues(topography) {
            true => 1.0,
            false => hann.powi(if topography.is_profile() { 1 } else { 2 }),
        }
    }
}

/// The spectrum of a topography without trend.
pub struct Spectrum {
    waves: Waves,
    profile: bool,
    pixel: f64,
    longest: f64,
    /// Share of the powers that are independent: half belong to the same waves, and a window mixes neighbours.
    independent: f64,
    /// Power of a wave of white noise, m², where the spectrum shows it.
    noise: Option<f64>,
}

impl Spectrum {
    pub fn of(topography: &Topography, window: Window) -> Self {
        let mut spectrum = Self {
            waves: window.waves(topography),
            profile: topography.is_profile(),
            pixel: topography.pixel(),
            longest: topography.shorter_extent(),
            independent: 0.5 * window.independent(topography),
            noise: None,
        };
        let end = spectrum.bins().into_iter().filter(|bin| bin.q > FITTED * PI / spectrum.pixel);
        let flattest = if spectrum.profile { FLATTEST_PROFILE } else { FLATTEST_MAP };
        spectrum.noise = white(&end.collect::<Vec<Bin>>(), flattest);
        spectrum
    }

    /// Share of m4 of the surface after the filter of that `cutoff` (m) that white noise contributes, where the spectrum shows it.
    pub fn noise_share(&self, cutoff: f64) -> Option<f64> {
        let floor = self.noise?;
        let (noise, all) = self.waves.powers().fold((0.0, 0.0), |(noise, all), (y, x, power)| {
            let weight = match self.profile {
                true => of_surface(x, cutoff)[2],
                false => transmission(y.hypot(x), cutoff).powi(2) * (y * y + x * x).powi(2),
            };
            (noise + weight * floor, all + weight * power)
        });
        // Of a profile, sums with weights of both signs.
        Some(noise / all.max(noise))
    }

    /// (wavenumber q in rad/m, mean power of a wave in m²) in bins of equal width in ln q, up to the
    /// Nyquist wavenumber.
    pub fn radial(&self) -> Vec<(f64, f64)> {
        self.bins().into_iter().map(|bin| (bin.q, bin.power)).collect()
    }

    fn bins(&self) -> Vec<Bin> {
        let (lowest, highest) = (2.0 * PI / self.longest, PI / self.pixel);
        let bins = (BINS_PER_OCTAVE * (highest / lowest).log2()).ceil().max(1.0) as usize;
        let mut sums = vec![(0.0, 0.0, 0.0); bins];
        for (y, x, power) in self.waves.powers() {
            let q = y.hypot(x);
            let place = (BINS_PER_OCTAVE * (q / lowest).log2()).floor();
            if place >= 0.0 && q <= highest {
                let bin = &mut sums[(place as usize).min(bins - 1)];
                *bin = (bin.0 + 1.0, bin.1 + q.ln(), bin.2 + power);
            }
        }
        let filled = sums.into_iter().filter(|(count, ..)| *count > 0.0);
        let bin = |(count, ln_q, power): (f64, f64, f64)| Bin {
            q: (ln_q / count).exp(),
            power: power / count,
            count: self.independent * count,
        };
        filled.map(bin).collect()
    }

    /// Shortest wavelength (m) resolved by the measurement, and its reason: that of sampling, or the cut-off at which
    /// white noise contributes the largest accepted share of m4, a quarter of the extent at most.
    pub fn reliability_limit(&self) -> (f64, Limit) {
        let noisy = |cutoff: f64| self.noise_share(cutoff).is_some_and(|share| share > NOISY);
        let sampling = PIXELS_PER_WAVE * self.pixel;
        let (mut short, mut long) = (sampling, sampling.max(LONGEST_CUTOFF * self.longest));
        if !noisy(sampling) {
            return (sampling, Limit::Sampling);
        }
        if noisy(long) {
            return (long, Limit::Noise);
        }
        while long > 1.01 * short {
            let middle = (short * long).sqrt();
            *if noisy(middle) { &mut short } else { &mut long } = middle;
        }
        (long, Limit::Noise)
    }
}

/// Reason why shorter wavelengths are not resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Limit {
    /// Fewer than four points a wave.
    Sampling,
    /// White noise contributes to the curvature.
    Noise,
}

impl std::fmt::Display for Limit {
    fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Sampling => "four points a wave",
            Self::Noise => "white noise",
        })
    }
}

/// Points that a wave must have for its curvature to be seen.
pub const PIXELS_PER_WAVE: f64 = 4.0;

const BINS_PER_OCTAVE: f64 = 4.0;

/// Wavenumbers over the Nyquist wavenumber to which noise is fitted: the last three octaves.
const FITTED: f64 = 0.125;

/// Exponents of the flattest self-affine surface: maps fall with q^{−2−2H}, profiles with q^{−1−2H}, H the Hurst
/// exponent between 0 and 1.
const FLATTEST_MAP: f64 = 2.0;
const FLATTEST_PROFILE: f64 = 1.0;

/// Longest cut-off over the extent of a topography.
pub const LONGEST_CUTOFF: f64 = 0.25;

/// Largest share of noise in m4 that is accepted: R is then 2.5 % too small.
pub const NOISY: f64 = 0.05;

#[cfg(test)]
mod tests {
    use super::super::synthetic::SelfAffine;
    use super::*;
    use crate::surface::heights::Random;
    use rand::{RngExt, SeedableRng};
    use rand_distr::StandardNormal;

    /// The same with white noise of that mean square (m²).
    fn noisy(mut map: Topography, mean_square: f64, seed: u64) -> Topography {
        let mut random = Random::seed_from_u64(seed);
        for height in &mut map.heights {
            *height += mean_square.sqrt() * random.sample::<f64, _>(StandardNormal);
        }
        map
    }

    #[test]
    fn the_cutoff_leaves_the_accepted_share_of_noise() {
        let points = 512;
        let shape = SelfAffine { points, shortest_pixels: 1.4, ..SelfAffine::default() };
        // The same power in every wave.
        let white = SelfAffine { hurst: -1.0, ..shape };
        for (hurst, seed) in [(0.3, 1), (0.5, 2), (0.8, 3), (1.0, 4)] {
            let surface = SelfAffine { hurst, ..shape };
            let map = surface.map(seed);
            let sampling = PIXELS_PER_WAVE * map.pixel();
            // Mean square of the noise that contributes that share at four points a wave.
            let per_share =
                |share: f64| share / (1.0 - share) * surface.sum(4, sampling) / white.sum(4, sampling);
            for share in [0.1, 0.3, 0.6] {
                let ratio = per_share(share);
                let mean_square = ratio * white.power(1.0) * (points * points) as f64;
                let spectrum_of = |map| Spectrum::of(&noisy(map, mean_square, 100 + seed), Window::Hann);
                let spectrum = spectrum_of(map.clone());
                let stated = spectrum.noise_share(sampling).unwrap();
                assert!((stated / share - 1.0).abs() < 0.15, "{hurst} {share}: {stated}");
                let (limit, why) = spectrum.reliability_limit();
                assert_eq!(why, Limit::Noise, "{hurst} {share}");
                let noise = ratio * white.sum(4, limit);
                let left = noise / (noise + surface.sum(4, limit));
                assert!((left / NOISY - 1.0).abs() < 0.2, "{hurst} {share}: {left}");
            }
        }
    }

    #[test]
    fn no_noise_is_seen_where_there_is_none() {
        let sampled = |topography: &Topography| {
            let limit = Spectrum::of(topography, Window::Hann).reliability_limit();
            assert_eq!(limit, (PIXELS_PER_WAVE * topography.pixel(), Limit::Sampling));
        };
        for (seed, hurst) in (1..=12).zip([0.3, 0.5, 0.8, 1.0].into_iter().cycle()) {
            for (points, roll_off_pixels) in [(64, 64.0), (128, 16.0), (512, 512.0), (512, 8.0)] {
                let surface = SelfAffine { points, hurst, roll_off_pixels, shortest_pixels: 1.4 };
                let map = surface.map(seed);
                let quarter = surface.quarter(seed);
                // An instrument that blurs: the mean of four points.
                let mut blurred = quarter.clone();
                for place in 0..quarter.heights.len() {
                    let after = |step: usize| quarter.heights[(place + step) % quarter.heights.len()];
                    blurred.heights[place] =
                        0.25 * (after(0) + after(1) + after(quarter.columns) + after(quarter.columns + 1));
                }
                let row = Topography::profile(map.column_step, map.heights[..points].to_vec());
                [&map, &quarter, &blurred, &row].into_iter().for_each(sampled);
            }
        }
        // Noise far below a spectrum that ends before the shortest waves contributes nothing to m4.
        let band_limited = SelfAffine::default();
        let faint = 1e-9 * band_limited.power(2.0 * PI / band_limited.shortest());
        sampled(&band_limited.with_noise(5, faint));
    }

    #[test]
    fn noise_alone_is_said_to_be_noise() {
        let map = noisy(SelfAffine::default().map(1), 1.0, 2);
        let row = Topography::profile(map.column_step, map.heights[..256].to_vec());
        assert_eq!(Spectrum::of(&row, Window::Hann).reliability_limit().1, Limit::Noise);
        let spectrum = Spectrum::of(&map, Window::Hann);
        let (limit, why) = spectrum.reliability_limit();
        assert_eq!((limit, why), (64.0 * map.pixel(), Limit::Noise));
        assert!(spectrum.noise_share(limit).unwrap() > 0.8);
    }
}
