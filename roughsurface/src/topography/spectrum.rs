//! Spectral moments, and where a measured spectrum ends.

use super::Topography;
use super::fft::Waves;
use super::filter::transmission;
use std::f64::consts::PI;

/// Mean squares of the height, slope and curvature of a profile along any direction of an
/// isotropic surface (Nayak 1971, doi 10.1115/1.3451608).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Moments {
    /// m².
    pub m0: f64,
    /// 1.
    pub m2: f64,
    /// 1/m².
    pub m4: f64,
    /// Mean square slopes across the lay and along it, 1: eigenvalues of ⟨∇z ∇zᵀ⟩; of a profile, m2 twice.
    pub principal_slopes: (f64, f64),
    /// Angle of the lay, the direction of the smallest slopes, to the rows, degrees from −90 to 90, positive
    /// towards later rows.
    pub lay_angle: f64,
}

/// Taper at the edges of a topography that is not periodic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Window {
    /// Hann's, scaled to keep the mean square; none for periodic maps.
    #[default]
    Hann,
    None,
}

impl Window {
    fn weight(self, topography: &Topography) -> impl Fn(usize, usize) -> f64 + use<> {
        let tapered = self == Self::Hann && !topography.periodic;
        let (rows, columns) = (topography.rows, topography.columns);
        // ⟨sin⁴⟩ = 3/8.
        let hann = move |index: usize, count: usize| match tapered && count > 1 {
            true => (8.0f64 / 3.0).sqrt() * (PI * (index as f64 + 0.5) / count as f64).sin().powi(2),
            false => 1.0,
        };
        move |row, column| hann(row, rows) * hann(column, columns)
    }
}

/// The spectrum of a topography without trend.
pub struct Spectrum {
    waves: Waves,
    profile: bool,
    /// Mean square height, m².
    mean_square: f64,
    pixel: f64,
    longest: f64,
}

impl Spectrum {
    pub fn of(topography: &Topography, window: Window) -> Self {
        let weight = window.weight(topography);
        let count = topography.heights.len() as f64;
        let (across, along) = topography.size();
        Self {
            waves: Waves::of(topography, weight),
            profile: topography.is_profile(),
            mean_square: topography.heights.iter().map(|height| height * height).sum::<f64>() / count,
            pixel: topography.pixel(),
            longest: if topography.is_profile() { along } else { across.min(along) },
        }
    }

    /// Moments after the filter of that `cutoff` (m).
    ///
    /// Of a map m2 = ⟨|∇z|²⟩/2 and m4 = 3⟨(∇²z)²⟩/8, the means over all directions. m0 is that of
    /// the heights themselves less the power that the filter removes: a window weakens the longest waves,
    /// which contribute most of it.
    pub fn moments(&self, cutoff: f64) -> Moments {
        let (mut removed, mut across, mut along, mut mixed, mut m4) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (y, x, power) in self.waves.powers() {
            let square = y * y + x * x;
            let passed = transmission(square.sqrt(), cutoff).powi(2);
            removed += (1.0 - passed) * power;
            across += passed * power * y * y;
            along += passed * power * x * x;
            mixed += passed * power * x * y;
            m4 += passed * power * square * square;
        }
        let m0 = self.mean_square - removed;
        if self.profile {
            return Moments { m0, m2: along, m4, principal_slopes: (along, along), lay_angle: 0.0 };
        }
        let (mean, half) = (0.5 * (across + along), (0.5 * (along - across)).hypot(mixed));
        // Of the steepest direction; the lay is across it.
        let steepest = 0.5 * (2.0 * mixed).atan2(along - across).to_degrees();
        Moments {
            m0,
            m2: mean,
            m4: 0.375 * m4,
            principal_slopes: (mean + half, mean - half),
            lay_angle: if steepest > 0.0 { steepest - 90.0 } else { steepest + 90.0 },
        }
    }

    /// Share of m4 after the filter of that `cutoff` (m) that white noise contributes, where the spectrum ends in
    /// noise.
    pub fn noise_share(&self, cutoff: f64, m4: f64) -> Option<f64> {
        let floor = self.noise_floor(&self.radial())?;
        let noise = self.waves.powers().map(|(y, x, _)| {
            let square = y * y + x * x;
            floor * transmission(square.sqrt(), cutoff).powi(2) * square * square
        });
        let mean = if self.profile { 1.0 } else { 0.375 };
        Some(mean * noise.sum::<f64>() / m4)
    }

    /// Mean power of a wave in the last octave (m²), where the spectrum does not fall there.
    fn noise_floor(&self, radial: &[(f64, f64)]) -> Option<f64> {
        let highest = PI / self.pixel;
        let end: Vec<(f64, f64)> = radial.iter().copied().filter(|(q, _)| *q > 0.5 * highest).collect();
        let flat = if self.profile { FLAT_PROFILE } else { FLAT_MAP };
        let floor = end.iter().map(|(_, power)| power).sum::<f64>() / end.len() as f64;
        slope(&end).is_some_and(|slope| slope >= flat).then_some(floor)
    }

    /// (wavenumber q in rad/m, mean power of a wave in m²) in bins of equal width in ln q, up to the
    /// Nyquist wavenumber.
    pub fn radial(&self) -> Vec<(f64, f64)> {
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
        filled.map(|(count, ln_q, power)| ((ln_q / count).exp(), power / count)).collect()
    }

    /// Shortest wavelength (m) resolved by the measurement, and its reason. Noise that contributes little to m4 at the
    /// limit of sampling, as that of rounding, limits nothing.
    pub fn reliability_limit(&self) -> (f64, Limit) {
        let sampling = PIXELS_PER_WAVE * self.pixel;
        if self.noise_share(sampling, self.moments(sampling).m4).is_none_or(|share| share <= NOISY) {
            return (sampling, Limit::Sampling);
        }
        let radial = self.radial();
        let Some(floor) = self.noise_floor(&radial) else {
            return (sampling, Limit::Sampling);
        };
        let buried = radial.iter().find(|(_, power)| *power < ABOVE_NOISE * floor);
        let noise = buried.map_or(sampling, |(q, _)| 2.0 * PI / q);
        if noise > sampling { (noise, Limit::Noise) } else { (sampling, Limit::Sampling) }
    }
}

/// Reason why shorter wavelengths are not resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Limit {
    /// Fewer than four points a wave.
    Sampling,
    /// The spectrum is that of noise: flat.
    Noise,
}

impl std::fmt::Display for Limit {
    fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Sampling => "four points a wave",
            Self::Noise => "below, the spectrum is that of noise",
        })
    }
}

/// Points that a wave must have for its curvature to be seen.
pub const PIXELS_PER_WAVE: f64 = 4.0;

const BINS_PER_OCTAVE: f64 = 4.0;

/// Slopes of ln(power) against ln(q) over the last octave, above which it is noise: self-affine
/// maps fall with q^{−2−2H}, profiles with q^{−1−2H}, H the Hurst exponent between 0 and 1.
const FLAT_MAP: f64 = -1.0;
const FLAT_PROFILE: f64 = -0.5;

/// Largest share of noise in m4 that is accepted: R is then 2.5 % too small.
pub const NOISY: f64 = 0.05;

/// Ratio to the noise above which a spectrum is used.
const ABOVE_NOISE: f64 = 4.0;

/// Slope of the straight line through ln(power) against ln(q).
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> =
        points.iter().filter(|(_, power)| *power > 0.0).map(|(q, power)| (q.ln(), power.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) = logs.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let square: f64 = logs.iter().map(|point| (point.0 - x).powi(2)).sum();
    let cross: f64 = logs.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    (square > 0.0).then(|| cross / square)
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{SelfAffine, cosine};
    use super::*;

    #[test]
    fn moments_of_a_wave() {
        // z = a cos(q·r): m0 = a²/2, ⟨|∇z|²⟩ = a²q²/2, ⟨(∇²z)²⟩ = a²q⁴/2, times the filter's share.
        let (map, q, a) = cosine(64, 80, (3, 5));
        let spectrum = Spectrum::of(&map, Window::Hann);
        let cutoff = 1e-6;
        let passed = transmission(q, cutoff).powi(2);
        let found = spectrum.moments(cutoff);
        for (value, exact) in [
            (found.m0, 0.5 * a * a * passed),
            (found.m2, 0.25 * a * a * q * q * passed),
            (found.m4, 0.375 * 0.5 * a * a * q.powi(4) * passed),
        ] {
            assert!((value / exact - 1.0).abs() < 1e-10, "{value:e} {exact:e}");
        }
    }

    #[test]
    fn a_window_makes_up_for_edges() {
        // Quarters of periodic maps do not continue at their edges; on average slopes and
        // curvatures are those of the whole.
        let surface = SelfAffine { points: 1024, ..SelfAffine::default() };
        let cutoff = 2.0 * surface.shortest();
        let mean = |surface: SelfAffine, window: Window| {
            let of = |seed: u64| Spectrum::of(&surface.quarter(seed), window).moments(cutoff);
            let all: Vec<Moments> = (1..=4).map(of).collect();
            (all.iter().map(|m| m.m2).sum::<f64>() / 4.0, all.iter().map(|m| m.m4).sum::<f64>() / 4.0)
        };
        let (m2, m4) = (surface.sum(2, cutoff), surface.sum(4, cutoff));
        let found = mean(surface, Window::Hann);
        assert!((found.0 / m2 - 1.0).abs() < 0.05, "{} {m2}", found.0);
        assert!((found.1 / m4 - 1.0).abs() < 0.05, "{} {m4}", found.1);
        // Without roll-off the long waves jump most at the edges, and a jump has curvature.
        let rolling = SelfAffine { roll_off_pixels: 1024.0, ..surface };
        let m4 = rolling.sum(4, cutoff);
        let (tapered, edges) = (mean(rolling, Window::Hann), mean(rolling, Window::None));
        assert!((tapered.1 / m4 - 1.0).abs() < 0.05, "{} {m4}", tapered.1);
        assert!(edges.1 > 1.5 * m4, "the jumps at the edges count: {} {m4}", edges.1);
    }

    #[test]
    fn noise_is_seen_and_sampling_is_the_limit_without() {
        let surface = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() };
        let map = surface.map(5);
        let (limit, why) = Spectrum::of(&map, Window::Hann).reliability_limit();
        assert_eq!((limit, why), (4.0 * map.pixel(), Limit::Sampling));
        // Noise far below a spectrum that ends before the shortest waves contributes nothing to m4.
        let band_limited = SelfAffine::default();
        let faint = 1e-9 * band_limited.power(2.0 * PI / band_limited.shortest());
        let map = band_limited.with_noise(5, faint);
        let spectrum = Spectrum::of(&map, Window::Hann);
        assert!(spectrum.noise_floor(&spectrum.radial()).is_some());
        assert_eq!(spectrum.reliability_limit(), (4.0 * map.pixel(), Limit::Sampling));
        // White noise that meets the spectrum at a wavelength of 16 pixels.
        let power = surface.power(2.0 * PI / (16.0 * map.pixel()));
        let noisy = surface.with_noise(5, power);
        let (limit, why) = Spectrum::of(&noisy, Window::Hann).reliability_limit();
        assert_eq!(why, Limit::Noise);
        // Twice the noise is where they meet, four times a little before.
        let pixels = limit / map.pixel();
        assert!(pixels > 14.0 && pixels < 32.0, "{pixels}");
    }
}
