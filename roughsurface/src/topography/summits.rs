//! Summits found one by one, in addition to those of the moments.

use super::Topography;
use super::edges::Continued;
use super::filter::transmission;
use super::spectrum::Window;
use rustfft::num_complex::Complex;

/// Summits of a map, or peaks of a profile, after the short-wavelength filter.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Summits {
    /// Found.
    pub count: usize,
    /// Per area, 1/m²; of a profile per length, 1/m.
    pub density: f64,
    /// Radius of the mean curvature of the summits, m.
    pub radius: f64,
    /// Mean height above the mean plane, m.
    pub mean: f64,
    /// Standard deviation of the heights, m.
    pub std: f64,
    /// Skewness of the heights, 1; 0 for a Gaussian distribution.
    pub skewness: f64,
    /// Kurtosis of the heights, 1; 3 for a Gaussian distribution.
    pub kurtosis: f64,
    /// Each above the mean plane, highest first, m.
    #[serde(skip)]
    pub heights: Vec<f64>,
}

/// Points per cut-off of the grid that is searched: with four, 23 % of the summits of a self-affine surface lie
/// between points none of which is above its neighbours, with sixteen up to 3 %, the lowest ones.
const POINTS_PER_CUTOFF: f64 = 16.0;

/// Points of the refined grid at most: 1 GB.
const MOST_POINTS: usize = 1 << 26;

/// Finds the points above their eight neighbours (of a profile, two) in a topography without trend
/// after the filter of that `cutoff` (m), interpolated by its waves to a sixteenth of the cut-off. Heights are
/// those of the paraboloid through the neighbourhood, curvatures are exact derivatives of the filtered heights.
/// Without periodicity the filter has no data beyond the edges, and summits nearer to them than a cut-off are
/// not counted.
pub fn find(topography: &Topography, window: Window, cutoff: f64) -> Summits {
    let profile = topography.is_profile();
    let surface = Continued::of(topography, window.continues(topography), cutoff);
    let (more_rows, more_columns) = refinement(topography, surface.size.0 * surface.size.1, cutoff);
    let (rows, columns) = (surface.size.0 * more_rows, surface.size.1 * more_columns);
    // The mean curvature −∇²z/2, of a profile −z'', times the square of the cut-off: as large as the height.
    let scale = if profile { cutoff * cutoff } else { 0.5 * cutoff * cutoff };
    let fields = surface.waves.sum((more_rows, more_columns), |y, x| {
        let square = y * y + x * x;
        transmission(square.sqrt(), cutoff) * Complex::new(1.0, scale * square)
    });

    let at = |row: isize, column: isize| {
        let wrap = |index: isize, count: usize| index.rem_euclid(count as isize) as usize;
        fields[wrap(row, rows) * columns + wrap(column, columns)].re
    };
    let around = if profile { 0..=0 } else { -1..=1 };
    let (mut heights, mut curvatures) = (Vec::new(), 0.0);
    for row in surface.rows.start * more_rows..surface.rows.end * more_rows {
        for column in surface.columns.start * more_columns..surface.columns.end * more_columns {
            let (r, c) = (row as isize, column as isize);
            let here = at(r, c);
            // Of equal neighbours the later one counts.
            let higher = around.clone().all(|dr| {
                (-1..=1).all(|dc| match (dr, dc) {
                    (0, 0) => true,
                    _ if (dr, dc) < (0, 0) => here >= at(r + dr, c + dc),
                    _ => here > at(r + dr, c + dc),
                })
            });
            if higher {
                heights.push(here + rise(&at, r, c, profile));
                curvatures += fields[row * columns + column].im / (cutoff * cutoff);
            }
        }
    }
    heights.sort_by(|one, other| other.total_cmp(one));
    let along = surface.columns.len() as f64 * topography.column_step;
    let extent = along * if profile { 1.0 } else { surface.rows.len() as f64 * topography.row_step };
    statistics(heights, curvatures, extent)
}

/// Factors by which the rows and columns of a grid of that many `points` are refined.
fn refinement(topography: &Topography, points: usize, cutoff: f64) -> (usize, usize) {
    let factors = |points: f64| {
        let factor = |step: f64| (points * step / cutoff - 1e-9).ceil().max(1.0) as usize;
        let across = if topography.is_profile() { 1 } else { factor(topography.row_step) };
        (across, factor(topography.column_step))
    };
    let mut per_cutoff = POINTS_PER_CUTOFF;
    while factors(per_cutoff) != (1, 1)
        && points * factors(per_cutoff).0 * factors(per_cutoff).1 > MOST_POINTS
    {
        per_cutoff -= 1.0;
    }
    factors(per_cutoff)
}

/// Height of the maximum of the paraboloid through the neighbourhood above the point itself.
fn rise(at: &impl Fn(isize, isize) -> f64, r: isize, c: isize, profile: bool) -> f64 {
    let here = at(r, c);
    let second = |before: f64, after: f64| before - 2.0 * here + after;
    let gx = 0.5 * (at(r, c + 1) - at(r, c - 1));
    let xx = second(at(r, c - 1), at(r, c + 1));
    if profile {
        return if xx < 0.0 { -0.5 * gx * gx / xx } else { 0.0 };
    }
    let gy = 0.5 * (at(r + 1, c) - at(r - 1, c));
    let yy = second(at(r - 1, c), at(r + 1, c));
    let xy = 0.25 * (at(r + 1, c + 1) - at(r + 1, c - 1) - at(r - 1, c + 1) + at(r - 1, c - 1));
    let determinant = xx * yy - xy * xy;
    if determinant <= 0.0 || xx >= 0.0 {
        return 0.0;
    }
    -0.5 * (gx * gx * yy - 2.0 * gx * gy * xy + gy * gy * xx) / determinant
}

fn statistics(heights: Vec<f64>, curvatures: f64, extent: f64) -> Summits {
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    let central = |power: i32| heights.iter().map(|z| (z - mean).powi(power)).sum::<f64>() / count;
    let variance = central(2);
    Summits {
        count: heights.len(),
        density: count / extent,
        radius: count / curvatures,
        mean,
        std: variance.sqrt(),
        skewness: central(3) / variance.powf(1.5),
        kurtosis: central(4) / (variance * variance),
        heights,
    }
}

#[cfg(test)]
mod tests {
    use super::super::moments::Moments;
    use super::super::nayak::Nayak;
    use super::super::spectrum::Window;
    use super::super::synthetic::{SelfAffine, egg_box};
    use super::*;

    #[test]
    fn an_egg_box_has_one_summit_a_cell() {
        // z = a cos(qx) cos(qy): two summits a cell, of height a and curvature a q².
        let (map, q, a) = egg_box(128, 4);
        let found = find(&map, Window::Hann, map.pixel() * 4.0);
        assert_eq!(found.count, 2 * 4 * 4);
        // A map that ends is taken to continue without a window.
        let ending = Topography { periodic: false, ..map.clone() };
        assert_eq!(find(&ending, Window::None, map.pixel() * 4.0).count, found.count);
        assert!(find(&ending, Window::Hann, map.pixel() * 4.0).count < found.count);
        let left = transmission(q * 2f64.sqrt(), map.pixel() * 4.0);
        assert!((found.mean / (a * left) - 1.0).abs() < 1e-6, "{:e}", found.mean);
        assert!((found.radius * a * left * q * q - 1.0).abs() < 1e-6);
        assert!(found.std < 1e-6 * a);
    }

    #[test]
    fn summits_between_the_points_are_found_at_the_default_cutoff() {
        // Roughness down to two points a wave, cut-off of four: on the grid itself 23 % are missed.
        let surface = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() };
        let map = surface.map(1);
        let cutoff = 4.0 * map.pixel();
        let theory = Nayak::of(&Moments::of(&map, Window::None, cutoff).isotropic).unwrap();
        let found = find(&map, Window::Hann, cutoff);
        assert!((found.density / theory.density - 1.0).abs() < 0.03, "{} {}", found.density, theory.density);
        assert!((found.radius / theory.radius - 1.0).abs() < 0.02, "{} {}", found.radius, theory.radius);
    }

    #[test]
    fn large_maps_are_refined_as_far_as_memory_allows() {
        let refined = |points: usize, cutoff: f64| {
            let map = Topography::map((points, 1.0), (points, 0.5), Vec::new());
            refinement(&map, points * points, cutoff)
        };
        assert_eq!(refined(64, 4.0), (4, 2));
        assert_eq!(refined(64, 40.0), (1, 1));
        let (across, along) = refined(3000, 2.0);
        assert!(across > 1 && 9_000_000 * across * along <= MOST_POINTS, "{across} {along}");
    }

    #[test]
    fn summits_of_a_gaussian_surface_are_those_of_its_moments() {
        // Nayak's theory, independent of the search.
        for (surface, seed) in [
            (SelfAffine { points: 1024, ..SelfAffine::default() }, 1),
            (SelfAffine { points: 1024, hurst: 0.5, ..SelfAffine::default() }, 2),
        ] {
            let map = surface.map(seed);
            let cutoff = surface.shortest();
            let theory = Nayak::of(&Moments::of(&map, Window::Hann, cutoff).isotropic).unwrap();
            let found = find(&map, Window::Hann, cutoff);
            let off = |value: f64, exact: f64| (value / exact - 1.0).abs();
            // A few thousand summits, correlated over the longest waves.
            assert!(found.count > 1500, "{}", found.count);
            assert!(off(found.density, theory.density) < 0.03, "{} {}", found.density, theory.density);
            assert!(off(found.radius, theory.radius) < 0.03, "{} {}", found.radius, theory.radius);
            assert!(off(found.std, theory.std) < 0.04, "{} {}", found.std, theory.std);
            assert!(off(found.mean, theory.mean_summit) < 0.1, "{} {}", found.mean, theory.mean_summit);
            assert!(found.skewness.abs() < 0.3 && (found.kurtosis - 3.0).abs() < 0.5, "{found:?}");
        }
    }
}
