//! Spectral moments of filtered heights.

use super::Topography;
use super::edges::Continued;
use super::filter::{of_surface, transmission};
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
    /// Mean square curvatures across the lay and along it, 1/m²; of a profile, those of the isotropic surface.
    pub principal_curvatures: (f64, f64),
    /// Moments of the isotropic surface that has the same summits.
    pub isotropic: Isotropic,
}

/// Moments of an isotropic surface: with the geometric means of the slopes and curvatures across a lay and along it,
/// which do not change where a surface is stretched along the lay and compressed across it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Isotropic {
    /// m².
    pub m0: f64,
    /// 1.
    pub m2: f64,
    /// 1/m².
    pub m4: f64,
}

impl Moments {
    /// Moments of a topography without trend after the filter of that `cutoff` (m).
    ///
    /// Of a map m2 = ⟨|∇z|²⟩/2 and m4 = 3⟨(∇²z)²⟩/8, the means over all directions. Slopes and curvatures are those
    /// of the filtered heights a cut-off away from the edges; without a window the topography continues at its
    /// other side. m0 is that of all heights less what the filter takes off.
    pub fn of(topography: &Topography, window: Window, cutoff: f64) -> Self {
        let surface = Continued::of(topography, window.continues(topography), cutoff);
        let filtered = Filtered { topography, surface, cutoff };
        let m0 = filtered.mean_square_height();
        // ∂z/∂x + i ∂z/∂y with x along the rows.
        let slopes = filtered.field(|y, x| Complex::new(-y, x));
        let along = filtered.mean(|place| slopes[place].re.powi(2));
        if topography.is_profile() {
            let curvatures = filtered.field(|_, x| Complex::new(-x * x, 0.0));
            let m4 = filtered.mean(|place| curvatures[place].re.powi(2));
            return Self::of_profile(topography, window, cutoff, [m0, along, m4]);
        }
        let across = filtered.mean(|place| slopes[place].im.powi(2));
        let mixed = filtered.mean(|place| slopes[place].re * slopes[place].im);
        let (m2, half) = (0.5 * (across + along), (0.5 * (along - across)).hypot(mixed));
        let principal_slopes = (m2 + half, (m2 - half).max(0.0));
        // Of the steepest direction; the lay is across it.
        let steepest = 0.5 * (2.0 * mixed).atan2(along - across);
        let (laplacian, across, along) = filtered.curvatures(steepest);
        let (m4, principal_curvatures) = (0.375 * laplacian, (across, along));
        let angle = steepest.to_degrees();
        Self {
            m0,
            m2,
            m4,
            principal_slopes,
            lay_angle: if angle > 0.0 { angle - 90.0 } else { angle + 90.0 },
            principal_curvatures,
            isotropic: Isotropic::with_lay(m0, principal_slopes, (m4, principal_curvatures)),
        }
    }

    /// Moments of the isotropic surface with the summits of the sum of two independent heights, whose lays are parallel, or
    /// `crossed` at right angles: the mean squares of heights, slopes and curvatures add.
    pub(super) fn of_sum(&self, other: &Self, crossed: bool) -> Isotropic {
        let turned = |(across, along): (f64, f64)| if crossed { (along, across) } else { (across, along) };
        let add = |one: (f64, f64), two: (f64, f64)| (one.0 + two.0, one.1 + two.1);
        let slopes = add(self.areal_slopes(), turned(other.areal_slopes()));
        let curvatures = add(self.principal_curvatures, turned(other.principal_curvatures));
        let m4 = self.areal_m4() + other.areal_m4();
        Isotropic::with_lay(self.isotropic.m0 + other.isotropic.m0, slopes, (m4, curvatures))
    }

    /// Principal mean square slopes of the area; of a profile, those of the isotropic surface.
    fn areal_slopes(&self) -> (f64, f64) {
        let (across, along) = self.principal_slopes;
        let areal = self.isotropic.m2 / (across * along).sqrt();
        (areal * across, areal * along)
    }

    /// 3⟨(∇²z)²⟩/8, by the part that [`Isotropic::with_lay`] takes off.
    fn areal_m4(&self) -> f64 {
        self.isotropic.m4 + lost_to_lay(self.principal_curvatures)
    }

    /// Moments of the profile, and of the isotropic surface that has it after the filter over its area.
    fn of_profile(topography: &Topography, window: Window, cutoff: f64, [m0, m2, m4]: [f64; 3]) -> Self {
        let mut isotropic = [m0, m2, m4];
        for (_, q, power) in window.waves(topography).powers() {
            let passed = transmission(q, cutoff).powi(2);
            for (n, (moment, weight)) in isotropic.iter_mut().zip(of_surface(q, cutoff)).enumerate() {
                *moment += power * (weight - passed * q.powi(2 * n as i32));
            }
        }
        let [m0_isotropic, m2_isotropic, m4_isotropic] = isotropic;
        Self {
            m0,
            m2,
            m4,
            principal_slopes: (m2, m2),
            lay_angle: 0.0,
            principal_curvatures: (m4_isotropic, m4_isotropic),
            isotropic: Isotropic { m0: m0_isotropic, m2: m2_isotropic, m4: m4_isotropic },
        }
    }
}

impl Isotropic {
    /// Moments of an isotropic surface with the geometric means of the slopes and of the curvatures across a lay and along it; `m4` is 3⟨(∇²z)²⟩/8.
    fn with_lay(m0: f64, slopes: (f64, f64), (m4, curvatures): (f64, (f64, f64))) -> Self {
        Self { m0, m2: (slopes.0 * slopes.1).sqrt(), m4: m4 - lost_to_lay(curvatures) }
    }
}

/// What the geometric for the arithmetic mean of two mean square curvatures takes off 3⟨(∇²z)²⟩/8.
fn lost_to_lay((across, along): (f64, f64)) -> f64 {
    0.375 * (across.sqrt() - along.sqrt()).powi(2)
}

/// A topography after the filter.
struct Filtered<'a> {
    topography: &'a Topography,
    surface: Continued,
    cutoff: f64,
}

impl Filtered<'_> {
    /// Its waves, each times a `factor` of its (q_y, q_x); with a complex factor two fields.
    fn field(&self, factor: impl Fn(f64, f64) -> Complex<f64>) -> Vec<Complex<f64>> {
        self.surface.waves.sum((1, 1), |y, x| transmission(y.hypot(x), self.cutoff) * factor(y, x))
    }

    /// Mean over the rows and columns that the filter lets through without a continuation.
    fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        let Continued { size, rows, columns, .. } = &self.surface;
        let places = rows.clone().flat_map(|row| columns.clone().map(move |column| row * size.1 + column));
        places.map(of).sum::<f64>() / (rows.len() * columns.len()) as f64
    }

    fn mean_square_height(&self) -> f64 {
        let Topography { columns, heights, .. } = self.topography;
        let filtered = self.field(|_, _| Complex::new(1.0, 0.0));
        let width = self.surface.size.1;
        let removed = self.mean(|place| {
            heights[place / width * columns + place % width].powi(2) - filtered[place].re.powi(2)
        });
        self.topography.mean_square() - removed
    }

    /// ⟨(∇²z)²⟩, and the mean squares of the curvatures along a direction at that angle to the rows and across it.
    fn curvatures(&self, angle: f64) -> (f64, f64, f64) {
        let (sine, cosine) = angle.sin_cos();
        // ∇²z + i ∂²z/∂s², s along the direction.
        let fields = self.field(|y, x| Complex::new(-(y * y + x * x), -(sine * y + cosine * x).powi(2)));
        (
            self.mean(|place| fields[place].re.powi(2)),
            self.mean(|place| fields[place].im.powi(2)),
            self.mean(|place| (fields[place].re - fields[place].im).powi(2)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::nayak::Nayak;
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

    #[test]
    fn stretching_a_surface_does_not_change_its_summits() {
        let surface = SelfAffine { points: 512, shortest_pixels: 32.0, ..SelfAffine::default() };
        let map = surface.map(1);
        let factor = 1.5;
        for turned in [false, true] {
            let (down, right) = if turned { (factor, 1.0 / factor) } else { (1.0 / factor, factor) };
            let stretched = Topography {
                row_step: down * map.row_step,
                column_step: right * map.column_step,
                ..map.clone()
            };
            let cutoff = 2.0 * stretched.pixel();
            let [plain, stretched] = [&map, &stretched].map(|map| Moments::of(map, Window::Hann, cutoff));
            let ratio = stretched.principal_slopes.0 / stretched.principal_slopes.1;
            assert!((ratio / factor.powi(4) - 1.0).abs() < 0.05, "{ratio}");
            let off = |value: f64, exact: f64| (value / exact - 1.0).abs();
            assert!(off(plain.isotropic.m4, plain.m4) < 1e-3 && off(plain.isotropic.m2, plain.m2) < 1e-3);
            assert!(off(stretched.isotropic.m2, plain.m2) < 0.03, "{stretched:?} {plain:?}");
            assert!(off(stretched.isotropic.m4, plain.m4) < 0.05, "{stretched:?} {plain:?}");
            // The arithmetic means are those of the waves across the lay.
            assert!(stretched.m2 > 1.2 * plain.m2 && stretched.m4 > 1.8 * plain.m4);
        }
    }

    /// Density, mean of the two curvatures and of √(κ₁κ₂) of the summits among the points of a periodic map.
    fn counted(map: &Topography, cutoff: f64) -> [f64; 3] {
        let surface = Continued::of(map, true, cutoff);
        let filtered = Filtered { topography: map, surface, cutoff };
        let heights = filtered.field(|_, _| Complex::new(1.0, 0.0));
        let second = filtered.field(|y, x| Complex::new(-x * x, -y * y));
        let mixed = filtered.field(|y, x| Complex::new(-y * x, 0.0));
        let (rows, columns) = (map.rows, map.columns);
        let is_summit = |place: &usize| {
            let (row, column) = (place / columns, place % columns);
            (0..9).filter(|i| *i != 4).all(|i| {
                let (row, column) =
                    ((row + rows + i / 3 - 1) % rows, (column + columns + i % 3 - 1) % columns);
                heights[*place].re > heights[row * columns + column].re
            })
        };
        let summits: Vec<usize> = (0..rows * columns).filter(is_summit).collect();
        let mean = |of: &dyn Fn(usize) -> f64| {
            summits.iter().map(|place| of(*place)).sum::<f64>() / summits.len() as f64
        };
        let (down, right) = map.size();
        [
            summits.len() as f64 / (down * right),
            mean(&|place| -0.5 * (second[place].re + second[place].im)),
            mean(&|place| (second[place].re * second[place].im - mixed[place].re.powi(2)).max(0.0).sqrt()),
        ]
    }

    /// The numbers of the table in the chapter "Rough surfaces".
    #[test]
    fn summits_of_a_lay_are_those_of_geometric_means() {
        // Over those of an isotropic surface.
        let errors = |factor: f64| {
            let of_seed = |seed: u64| {
                let surface = SelfAffine {
                    points: 1024,
                    roll_off_pixels: 256.0,
                    shortest_pixels: 1.4,
                    ..SelfAffine::default()
                };
                let map = surface.map(seed);
                let (row_step, column_step) = (map.row_step / factor.sqrt(), map.column_step * factor.sqrt());
                let map = Topography { row_step, column_step, ..map };
                let cutoff = 16.0 * map.pixel();
                let moments = Moments::of(&map, Window::Hann, cutoff);
                let arithmetic = Isotropic { m0: moments.m0, m2: moments.m2, m4: moments.m4 };
                let [density, mean, gauss] = counted(&map, cutoff);
                let of = |summits: Nayak| {
                    [summits.density / density, 1.0 / (summits.radius * mean), 1.0 / (summits.radius * gauss)]
                };
                let ratio = moments.principal_slopes.0 / moments.principal_slopes.1;
                [
                    of(Nayak::of(&moments.isotropic).unwrap()),
                    of(Nayak::of(&arithmetic).unwrap()),
                    [ratio, 0.0, 0.0],
                ]
            };
            let seeds: Vec<_> = (1..=3).map(of_seed).collect();
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| seeds.iter().map(|seed| seed[i][j]).sum::<f64>() / 3.0))
        };
        let isotropic = errors(1.0)[0];
        assert!((isotropic[0] - 1.0).abs() < 0.02 && (isotropic[1] - 1.0).abs() < 0.02, "{isotropic:?}");
        for (factor, ratio, geometric, arithmetic) in [
            (2.25, 4.0, [0.00, -0.11, 0.00], [0.13, 0.05, 0.18]),
            (4.0, 10.0, [0.01, -0.26, 0.01], [0.40, 0.15, 0.57]),
            (10.0, 36.0, [0.06, -0.53, -0.04], [1.31, 0.21, 1.50]),
        ] {
            let found = errors(factor);
            assert!((found[2][0] / ratio - 1.0).abs() < 0.05, "{:?}", found[2]);
            for (found, expected) in found.into_iter().zip([geometric, arithmetic]) {
                let found = [0, 1, 2].map(|i| found[i] / isotropic[i] - 1.0);
                let near =
                    found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 0.02);
                assert!(near, "{ratio}: {found:?}");
            }
        }
    }

    #[test]
    fn a_profile_has_the_moments_of_its_surface() {
        for hurst in [0.3, 0.8, 1.0] {
            let surface = SelfAffine { points: 512, hurst, shortest_pixels: 1.4, ..SelfAffine::default() };
            for (pixels, periodic, allowed) in [(4.0, true, 0.02), (16.0, true, 0.02), (6.0, false, 0.06)] {
                let seeds = if periodic { 1..=1 } else { 1..=3 };
                let count = (seeds.clone().count() * surface.points) as f64;
                let (mut plain, mut found) = ([0.0; 2], [0.0; 3]);
                let mut cutoff = 0.0;
                for map in seeds.map(|seed| surface.map(seed)) {
                    cutoff = pixels * map.pixel();
                    for row in map.heights.chunks_exact(map.columns) {
                        let profile = Topography::profile(map.column_step, row.to_vec());
                        let profile = Topography { periodic, ..profile };
                        let moments = Moments::of(&profile, Window::Hann, cutoff);
                        let Isotropic { m0, m2, m4 } = moments.isotropic;
                        (0..3).for_each(|n| found[n] += [m0, m2, m4][n] / count);
                        (0..2).for_each(|n| plain[n] += [moments.m2, moments.m4][n] / count);
                    }
                }
                for (n, moment) in found.into_iter().enumerate() {
                    let exact = surface.sum(2 * n as i32, cutoff);
                    assert!(
                        (moment / exact - 1.0).abs() < allowed,
                        "H {hurst} m{} {}",
                        2 * n,
                        moment / exact
                    );
                }
                // Waves that are short across the profile are in it.
                assert!(plain[1] > 1.2 * found[2] && plain[0] > found[1], "{plain:?} {found:?}");
            }
        }
    }
}
