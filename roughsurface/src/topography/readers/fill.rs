//! Undefined points filled in from the defined ones around them.
//!
//! The filled heights minimise the sum of the squared differences between neighbours, each over the mean square of the
//! differences of the map in its direction, less that of their mean: on a surface with a lay along rows, columns or diagonals
//! heights are continued along it. Of equal mean squares they are harmonic. The sum is minimised by conjugate gradients. Opposite
//! edges of a periodic map are not neighbours here.

use super::Topography;
use rayon::prelude::*;

/// Neighbours of a point on one side, in rows and columns.
const DIRECTIONS: [(isize, isize); 4] = [(0, 1), (1, 0), (1, 1), (1, -1)];
/// Residual, over the first one in the norm of the preconditioner, at which the heights are final.
const TOLERANCE: f64 = 1e-6;
/// Iterations at most: some ten times the width of a hole, or the root of 1/[`LEAST`], are needed.
const ITERATIONS: usize = 20_000;
/// Mean square of differences, over the largest, that counts as the smallest.
const LEAST: f64 = 1e-4;
/// Points that a thread takes at once.
const CHUNK: usize = 1 << 12;
/// Mark of a defined point, in place of the number of an undefined one.
const DEFINED: u32 = u32::MAX;

/// Gives undefined points heights; at least one must be defined.
pub(super) fn fill(topography: &mut Topography) {
    let defined = || topography.heights.iter().filter(|height| !height.is_nan());
    let mean = defined().sum::<f64>() / defined().count() as f64;
    let system = System::of(topography);
    let filled = system.solve(mean);
    let places = system.places;
    for (place, height) in places.into_iter().zip(filled) {
        topography.heights[place] = height;
    }
}

/// The point `direction` from a place of the map.
fn next(topography: &Topography, place: usize, (down, right): (isize, isize)) -> Option<usize> {
    let &Topography { rows, columns, .. } = topography;
    let (row, column) = (place / columns, place % columns);
    let (row, column) = (row.checked_add_signed(down)?, column.checked_add_signed(right)?);
    (row < rows && column < columns).then_some(row * columns + column)
}

/// The equations of the undefined points.
struct System<'a> {
    topography: &'a Topography,
    /// Weight of each of [`DIRECTIONS`].
    weights: [f64; DIRECTIONS.len()],
    places: Vec<usize>,
    /// Number of the undefined point at each place of the map, or [`DEFINED`].
    numbers: Vec<u32>,
}

impl<'a> System<'a> {
    fn of(topography: &'a Topography) -> Self {
        let heights = &topography.heights;
        let squares = DIRECTIONS.map(|direction| {
            let difference = |place| Some(heights[place] - heights[next(topography, place, direction)?]);
            let differences = (0..heights.len()).filter_map(difference).filter(|value| !value.is_nan());
            let (sum, squares, count) = differences.fold((0.0, 0.0, 0.0), |(sum, squares, count), value| {
                (sum + value, squares + value * value, count + 1.0)
            });
            if count > 0.0 { squares / count - (sum / count).powi(2) } else { f64::INFINITY }
        });
        let largest = squares.into_iter().filter(|square| square.is_finite()).fold(0.0, f64::max);
        // Without differences all directions are alike.
        let weights =
            squares.map(|square| if largest > 0.0 { largest / square.max(LEAST * largest) } else { 1.0 });
        let places: Vec<usize> = (0..heights.len()).filter(|place| heights[*place].is_nan()).collect();
        let mut numbers = vec![DEFINED; heights.len()];
        for (number, place) in (0..).zip(&places) {
            numbers[*place] = number;
        }
        Self { topography, weights, places, numbers }
    }

    /// Σ w (h − `own`) over the neighbours of the n-th undefined point: h is `of_undefined` of one of these, `known` times
    /// the height of a defined one.
    fn differences(&self, n: usize, own: f64, known: f64, of_undefined: &[f64]) -> f64 {
        let mut sum = 0.0;
        for ((down, right), weight) in DIRECTIONS.into_iter().zip(self.weights) {
            for direction in [(down, right), (-down, -right)] {
                let Some(place) = next(self.topography, self.places[n], direction) else { continue };
                let height = match self.numbers[place] {
                    DEFINED => known * self.topography.heights[place],
                    number => of_undefined[number as usize],
                };
                sum += weight * (height - own);
            }
        }
        sum
    }

    /// Heights of the undefined points, from `start`: conjugate gradients, preconditioned by the diagonal.
    fn solve(&self, start: f64) -> Vec<f64> {
        let count = self.places.len();
        let zeros = vec![0.0; count];
        let each = |own: &[f64], known: f64, of_undefined: &[f64]| -> Vec<f64> {
            let points = own.par_iter().enumerate().with_min_len(CHUNK);
            points.map(|(n, own)| self.differences(n, *own, known, of_undefined)).collect()
        };
        let diagonal = each(&vec![-1.0; count], 0.0, &zeros);
        let mut x = vec![start; count];
        let mut residual = each(&x, 1.0, &x);
        let norm = |residual: &[f64]| residual.iter().zip(&diagonal).map(|(r, d)| r * r / d).sum::<f64>();
        let (first, mut before) = (norm(&residual), f64::INFINITY);
        let mut direction = zeros;
        for _ in 0..ITERATIONS {
            let size = norm(&residual);
            if size <= TOLERANCE * TOLERANCE * first {
                break;
            }
            for n in 0..count {
                direction[n] = residual[n] / diagonal[n] + size / before * direction[n];
            }
            let change = each(&direction, 0.0, &direction);
            let length = -size / direction.iter().zip(&change).map(|(p, q)| p * q).sum::<f64>();
            for n in 0..count {
                x[n] += length * direction[n];
                residual[n] += length * change[n];
            }
            before = size;
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 60 x 80 points with a hole of 20 x 30 and one at a corner.
    fn with_holes(height: impl Fn(f64, f64) -> f64) -> (Topography, Vec<f64>) {
        let (rows, columns) = (60, 80);
        let whole: Vec<f64> =
            (0..rows * columns).map(|p| height((p / columns) as f64, (p % columns) as f64)).collect();
        let mut map = Topography::map((rows, 1e-6), (columns, 1e-6), whole.clone());
        for (row, column) in (10..30).flat_map(|r| (20..50).map(move |c| (r, c))).chain([(0, 0), (0, 1)]) {
            map.heights[row * columns + column] = f64::NAN;
        }
        (map, whole)
    }

    fn largest_error(height: impl Fn(f64, f64) -> f64) -> f64 {
        let (mut map, whole) = with_holes(height);
        fill(&mut map);
        map.heights.iter().zip(&whole).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max)
    }

    /// To what [`LEAST`] leaves; the mean of the neighbours is off by the amplitude.
    #[test]
    fn a_lay_is_continued_across_holes() {
        let error = largest_error(|_, column| 1e-6 * (0.9 * column).sin());
        assert!(error < 5e-8, "{error:e}");
        let error = largest_error(|row, column| 1e-6 * (0.9 * (row - column)).sin());
        assert!(error < 5e-8, "{error:e}");
    }

    /// x² − y² is harmonic; its mean squares along rows and columns are similar and not equal.
    #[test]
    fn surfaces_without_a_lay_are_harmonic() {
        let saddle = |row: f64, column: f64| 1e-9 * ((column - 35.0).powi(2) - (row - 20.0).powi(2));
        let (map, _) = with_holes(saddle);
        let range = map.heights.iter().copied().fold(0.0, f64::max);
        let error = largest_error(saddle);
        assert!(error < 0.05 * range, "{error:e} {range:e}");
    }

    #[test]
    fn planes_stay_as_they_are_and_single_heights_spread() {
        let mut flat = Topography::profile(1e-6, vec![f64::NAN, 2e-9, f64::NAN, 2e-9, f64::NAN, f64::NAN]);
        fill(&mut flat);
        assert!(flat.heights.iter().all(|height| (height / 2e-9 - 1.0).abs() < 1e-9), "{:?}", flat.heights);
        let mut line = Topography::profile(1e-6, vec![1.0, f64::NAN, f64::NAN, 4.0]);
        fill(&mut line);
        assert!((line.heights[1] - 2.0).abs() < 1e-5 && (line.heights[2] - 3.0).abs() < 1e-5);
    }
}
