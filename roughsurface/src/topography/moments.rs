//! Spectral moments of filtered heights.

use super::Topography;
use super::edges::Continued;
use super::filter::transmission;
use super::spectrum::Window;
use rustfft::num_complex::Complex;

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

impl Moments {
    /// Of a topography without trend after the filter of that `cutoff` (m).
    ///
    /// Of a map m2 = ⟨|∇z|²⟩/2 and m4 = 3⟨(∇²z)²⟩/8, the means over all directions. Slopes and curvatures are those
    /// of the filtered heights a cut-off away from the edges; without a window the topography continues at its
    /// other side. m0 is that of all heights less what the filter takes off.
    pub fn of(topography: &Topography, window: Window, cutoff: f64) -> Self {
        let surface = Continued::of(topography, topography.periodic || window == Window::None, cutoff);
        let fields = |factor: &dyn Fn(f64, f64) -> Complex<f64>| {
            surface.waves.sum((1, 1), |y, x| transmission(y.hypot(x), cutoff) * factor(y, x))
        };
        let (rows, columns) = (surface.rows.clone(), surface.columns.clone());
        let places = || rows.clone().flat_map(|row| columns.clone().map(move |column| (row, column)));
        let count = (rows.len() * columns.len()) as f64;
        let mean = |of: &dyn Fn(usize) -> f64| {
            places().map(|(row, column)| of(row * surface.size.1 + column)).sum::<f64>() / count
        };

        let heights = fields(&|_, _| Complex::new(1.0, 0.0));
        let filtered = mean(&|place| heights[place].re.powi(2));
        let measured = |(row, column): (usize, usize)| topography.heights[row * topography.columns + column];
        let unfiltered = places().map(|place| measured(place).powi(2)).sum::<f64>() / count;
        let all = topography.heights.iter().map(|z| z * z).sum::<f64>() / topography.heights.len() as f64;
        let m0 = all - (unfiltered - filtered);

        // ∂z/∂x + i ∂z/∂y with x along the rows.
        let slopes = fields(&|y, x| Complex::new(-y, x));
        let along = mean(&|place| slopes[place].re.powi(2));
        let across = mean(&|place| slopes[place].im.powi(2));
        let mixed = mean(&|place| slopes[place].re * slopes[place].im);
        let laplacian = fields(&|y, x| Complex::new(-(y * y + x * x), 0.0));
        let m4 = mean(&|place| laplacian[place].re.powi(2));
        if topography.is_profile() {
            return Self { m0, m2: along, m4, principal_slopes: (along, along), lay_angle: 0.0 };
        }
        let (m2, half) = (0.5 * (across + along), (0.5 * (along - across)).hypot(mixed));
        // Of the steepest direction; the lay is across it.
        let steepest = 0.5 * (2.0 * mixed).atan2(along - across).to_degrees();
        Self {
            m0,
            m2,
            m4: 0.375 * m4,
            principal_slopes: (m2 + half, m2 - half),
            lay_angle: if steepest > 0.0 { steepest - 90.0 } else { steepest + 90.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{SelfAffine, cosine};
    use super::*;

    #[test]
    fn moments_of_a_wave() {
        // z = a cos(q·r): m0 = a²/2, ⟨|∇z|²⟩ = a²q²/2, ⟨(∇²z)²⟩ = a²q⁴/2, times the filter's share.
        let (map, q, a) = cosine(64, 80, (3, 5));
        let cutoff = 1e-6;
        let passed = transmission(q, cutoff).powi(2);
        let found = Moments::of(&map, Window::Hann, cutoff);
        for (value, exact) in [
            (found.m0, 0.5 * a * a * passed),
            (found.m2, 0.25 * a * a * q * q * passed),
            (found.m4, 0.375 * 0.5 * a * a * q.powi(4) * passed),
        ] {
            assert!((value / exact - 1.0).abs() < 1e-10, "{value:e} {exact:e}");
        }
    }

    #[test]
    fn moments_of_a_part_are_those_of_the_whole_there() {
        for (hurst, roll_off_pixels) in [(0.5, 512.0), (0.8, 512.0), (1.0, 512.0), (0.8, 64.0)] {
            let surface = SelfAffine { points: 512, hurst, roll_off_pixels, shortest_pixels: 1.4 };
            for (seed, pixels) in [(1, 4.0), (2, 8.0)] {
                let (whole, part) = (surface.map(seed), surface.quarter(seed));
                let cutoff = pixels * whole.pixel();
                let filtered = Continued::of(&whole, true, cutoff);
                let mean_square = |factor: &dyn Fn(f64, f64) -> Complex<f64>| {
                    let field =
                        filtered.waves.sum((1, 1), |y, x| transmission(y.hypot(x), cutoff) * factor(y, x));
                    let inside = (0..part.heights.len())
                        .map(|place| place / part.columns * whole.columns + place % part.columns);
                    inside.map(|place| field[place].norm_sqr()).sum::<f64>() / part.heights.len() as f64
                };
                let exact = [
                    mean_square(&|_, _| Complex::new(1.0, 0.0)),
                    0.5 * mean_square(&|y, x| Complex::new(-y, x)),
                    0.375 * mean_square(&|y, x| Complex::new(y * y + x * x, 0.0)),
                ];
                let Moments { m0, m2, m4, .. } = Moments::of(&part, Window::Hann, cutoff);
                for (n, (found, exact)) in [m0, m2, m4].into_iter().zip(exact).enumerate() {
                    assert!((found / exact - 1.0).abs() < 0.03, "H {hurst}: m{} {}", 2 * n, found / exact);
                }
                // Without a window the jumps at the edges count.
                let jumps = Moments::of(&part, Window::None, cutoff).m4;
                assert!(roll_off_pixels < 100.0 || jumps > 1.2 * exact[2], "H {hurst}: {}", jumps / exact[2]);
            }
        }
    }
}
