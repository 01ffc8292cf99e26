//! Checks of the plausibility of the heights of a topography, before anything is computed from them.

use super::Topography;
use super::detrend::Detrend;
use super::spectrum::Window;
use super::warning::Warning;
use tables::numbers::digits;

/// Lengths (m) above which a rough surface was hardly measured: those of machined ones are micrometres.
const LONG: f64 = 1e-3;

/// Root mean square heights (m) below which none was measured: a tenth of an atom.
const SHORT: f64 = 1e-11;

/// Standard deviations of a spike; one of 1e15 Gaussian heights lies beyond.
const SPIKE: f64 = 8.0;

/// Range of all other heights over that with a mark of missing ones.
const MARKED: f64 = 0.05;

/// The same where at least three heights have exactly the value of the mark, and so few that they could be filled in: more
/// may be dimples or lands.
const MARKED_OFTEN: f64 = 0.3;

/// Share of the mean square without plane that a paraboloid takes off: at most 0.69 in 192 self-affine maps
/// of Hurst exponents from 0.3 to 1 and roll-offs up to twice their size.
const FORM: f64 = 0.7;

/// A warning if heights or distances are those of another unit: of micrometres read as metres where none was stated.
pub(super) fn units(topography: &Topography) -> Option<Warning> {
    let (rms, pixel) = (mean_square_about_mean(&topography.heights).sqrt(), topography.pixel());
    if rms < SHORT {
        return Some(Warning::Short { rms });
    }
    (rms.max(pixel) > LONG).then_some(match topography.remarks.contains(&Warning::NoUnit) {
        true => Warning::Micrometres { rms, pixel },
        false => Warning::Long { rms, pixel },
    })
}

/// Mean square steps from the last line to the first and between neighbouring lines, across rows and across columns; of a
/// profile across columns alone.
fn steps(topography: &Topography) -> Vec<[f64; 2]> {
    let Topography { rows, columns, heights, .. } = topography;
    let (rows, columns) = (*rows, *columns);
    let step = |from: usize, to: usize| (heights[to] - heights[from]).powi(2);
    let of = |lines: usize, length: usize, place: &dyn Fn(usize, usize) -> usize| {
        let mean = |from: usize, to: usize| {
            (0..length).map(|i| step(place(from, i), place(to, i))).sum::<f64>() / length as f64
        };
        let neighbours = (1..lines).map(|line| mean(line - 1, line)).sum::<f64>() / (lines - 1) as f64;
        [mean(lines - 1, 0), neighbours]
    };
    let across_columns = of(columns, rows, &|column, i| i * columns + column);
    match topography.is_profile() {
        true => vec![across_columns],
        false => vec![of(rows, columns, &|row, i| row * columns + i), across_columns],
    }
}

/// A warning if a map that is not said to be periodic continues at its other side: heights at opposite edges
/// differ no more than those of neighbours, and these much less than those of distant points.
pub(super) fn seems_periodic(topography: &Topography) -> Option<Warning> {
    if topography.periodic || topography.is_profile() {
        return None;
    }
    let distant = 2.0 * mean_square_about_mean(&topography.heights);
    let fits = |[across, neighbours]: &[f64; 2]| *across < 1.5 * neighbours && *neighbours < 0.25 * distant;
    steps(topography).iter().all(fits).then_some(Warning::SeemsPeriodic)
}

/// A warning if a topography that is taken to continue at its other side, periodic or without a window, has a step there.
pub(super) fn edges_jump(topography: &Topography, window: Window) -> Option<Warning> {
    if !window.continues(topography) {
        return None;
    }
    // One step of a profile varies more than the mean of those along an edge.
    let limit = if topography.is_profile() { 4.0 } else { 2.0 };
    let ratios = steps(topography).into_iter().map(|[across, neighbours]| (across / neighbours).sqrt());
    let ratio = ratios.fold(0.0, f64::max);
    (ratio > limit).then_some(Warning::EdgesJump { ratio })
}

/// Fails if the lowest or the highest height, of one point or of several, is far from all others: the mark of missing heights,
/// as −9999, of many instruments.
pub(super) fn none_is_marked(topography: &Topography) -> Result<(), String> {
    let heights = &topography.heights;
    let range = |heights: &mut dyn Iterator<Item = f64>| {
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (z.min(low), z.max(high)))
    };
    let (low, high) = range(&mut heights.iter().copied());
    for extreme in [low, high] {
        let count = heights.iter().filter(|height| **height == extreme).count();
        let (next_low, next_high) = range(&mut heights.iter().copied().filter(|height| *height != extreme));
        let marked = if count < 3 || 10 * count > heights.len() { MARKED } else { MARKED_OFTEN };
        let distant = next_high - next_low < marked * (high - low);
        // Two levels alone may be a grating.
        if distant && next_high > next_low && 2 * count < heights.len() {
            return Err(format!(
                "{count} heights are {} m and all others between {} and {} m: if that marks missing heights, give them as nan, \
                 which is filled in from the neighbours",
                digits(extreme, 6),
                digits(next_low, 3),
                digits(next_high, 3)
            ));
        }
    }
    Ok(())
}

/// A warning if points stand out from their neighbours, or on a map from the points around these, all but one: along a lay
/// two of them are as high as a ridge, and spikes may be two points wide.
pub(super) fn spikes(topography: &Topography) -> Option<Warning> {
    let Topography { rows, columns, heights, .. } = topography;
    let (rows, columns, profile) = (*rows, *columns, topography.is_profile());
    // Of a map the square at that distance, of a profile those on both sides.
    let around = |row: usize, column: usize, distance: usize| {
        let lines = if profile { 0..1 } else { row - distance..row + distance + 1 };
        let places = lines.flat_map(|r| (column - distance..=column + distance).map(move |c| (r, c)));
        let ring = places.filter(|&(r, c)| match profile {
            true => c != column,
            false => row.abs_diff(r).max(column.abs_diff(c)) == distance,
        });
        let mut ring: Vec<f64> = ring.map(|(r, c)| heights[r * columns + c]).collect();
        ring.sort_by(f64::total_cmp);
        ring
    };
    let beyond = |height: f64, ring: &[f64]| (height - ring[ring.len() - 2]).max(ring[1] - height);
    let edge = if profile { 2 } else { 1 };
    let lines = if profile { 0..1 } else { edge..rows - edge };
    let (mut deviations, mut spreads, mut farthest) = (Vec::new(), Vec::new(), Vec::new());
    for (row, column) in lines.flat_map(|row| (edge..columns - edge).map(move |column| (row, column))) {
        let (height, ring) = (heights[row * columns + column], around(row, column, edge));
        deviations.push((height - ring[ring.len() / 2]).abs());
        spreads.push(ring[ring.len() - 2] - ring[1]);
        let has_second = !profile && row.min(column) > 1 && row + 2 < rows && column + 2 < columns;
        let second = has_second.then(|| beyond(height, &around(row, column, 2)));
        farthest.push(beyond(height, &ring).max(second.unwrap_or(f64::NEG_INFINITY)));
    }
    // Two estimates of a standard deviation. 95 % of the deviations are below 1.96 of it; their median is not of use, as it is far
    // smaller across a lay. More than one spike in twenty increases this one, but not the spread of the neighbours, which is the
    // expected difference of the second and the last but one of eight, or four, normal numbers.
    let spread = if profile { 0.594 } else { 1.704 };
    let std = (quantile(0.95, &mut deviations) / 1.96).min(quantile(0.5, &mut spreads) / spread);
    let count = farthest.iter().filter(|beyond| **beyond > SPIKE * std).count();
    (std > 0.0 && count > 0).then_some(Warning::Spikes { count })
}

/// The value that this share of the values do not exceed.
fn quantile(share: f64, values: &mut [f64]) -> f64 {
    let place = (share * (values.len() - 1) as f64) as usize;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// A warning if most of the heights of `topography`, without plane, are those of a paraboloid.
pub(super) fn form(topography: &Topography) -> Option<Warning> {
    let mut flat = topography.clone();
    Detrend::Quadratic.subtract(&mut flat);
    let share = 1.0 - mean_square_about_mean(&flat.heights) / mean_square_about_mean(&topography.heights);
    (share > FORM).then_some(Warning::Form { share })
}

fn mean_square_about_mean(heights: &[f64]) -> f64 {
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    heights.iter().map(|height| (height - mean).powi(2)).sum::<f64>() / count
}

#[cfg(test)]
mod tests {
    use super::super::characterize::{Options, characterize};
    use super::super::synthetic::SelfAffine;
    use super::*;

    #[test]
    fn spikes_form_and_units_are_noticed_where_they_are() {
        let map = SelfAffine::default().quarter(1);
        for warning in [units, seems_periodic, spikes, form].map(|check| check(&map)) {
            assert_eq!(warning, None);
        }
        let jump = edges_jump(&map, Window::None);
        assert!(matches!(jump, Some(Warning::EdgesJump { ratio }) if ratio > 3.0), "{jump:?}");
        assert_eq!(edges_jump(&map, Window::Hann), None);
        assert_eq!(edges_jump(&SelfAffine::default().map(1), Window::None), None);
        let mut spiked = map.clone();
        for place in [20 * map.columns + 30, 90 * map.columns + 77] {
            spiked.heights[place] += 1e-6;
        }
        assert_eq!(spikes(&spiked), Some(Warning::Spikes { count: 2 }));
        // Two by two points, and one point in twelve.
        let mut blob = map.clone();
        for (row, column) in [(20, 30), (20, 31), (21, 30), (21, 31)] {
            blob.heights[row * map.columns + column] += 1e-6;
        }
        assert_eq!(spikes(&blob), Some(Warning::Spikes { count: 4 }));
        let mut many = map.clone();
        many.heights.iter_mut().step_by(12).for_each(|height| *height += 1e-6);
        assert!(
            matches!(spikes(&many), Some(Warning::Spikes { count }) if count > 1000),
            "{:?}",
            spikes(&many)
        );

        let profile = Topography::profile(map.column_step, map.heights[..map.columns].to_vec());
        assert_eq!(spikes(&profile), None);
        let mut spiked = profile.clone();
        for (place, spike) in [(40, 1e-6), (41, 1e-6), (90, -1e-6)] {
            spiked.heights[place] += spike;
        }
        assert_eq!(spikes(&spiked), Some(Warning::Spikes { count: 3 }));

        // A ground face: rows of a profile that are alike but for a thousandth.
        let fine = SelfAffine { points: 512, shortest_pixels: 2.0, ..SelfAffine::default() }.map(2);
        let smooth = SelfAffine { points: 512, shortest_pixels: 64.0, ..SelfAffine::default() }.map(1);
        let mut ground = fine.clone();
        for (place, height) in ground.heights.iter_mut().enumerate() {
            *height = smooth.heights[place % fine.columns] + 1e-3 * *height;
        }
        assert_eq!(spikes(&ground), None);
        ground.heights[200 * fine.columns + 77] += 20.0 * mean_square_about_mean(&ground.heights).sqrt();
        assert_eq!(spikes(&ground), Some(Warning::Spikes { count: 1 }));

        let mut curved = map.clone();
        for (place, height) in curved.heights.iter_mut().enumerate() {
            *height += 1e-10 * ((place % map.columns) as f64 - 64.0).powi(2);
        }
        assert!(matches!(form(&curved), Some(Warning::Form { share }) if share > 0.9));

        let scaled = |lengths: f64, heights: f64| {
            let scaled = map.heights.iter().map(|height| heights * height).collect();
            let step = lengths * map.row_step;
            Topography::map((map.rows, step), (map.columns, step), scaled)
        };
        for (lengths, heights) in [(1e6, 1e6), (1.0, 1e6), (1e6, 1.0), (1.0, 1e-6)] {
            assert!(units(&scaled(lengths, heights)).is_some());
        }
        let refused = characterize(scaled(1.0, 1e200), &Options::default()).unwrap_err();
        assert!(refused.contains("slopes are not finite"), "{refused}");
    }

    #[test]
    fn marks_of_missing_heights_are_refused() {
        let map = SelfAffine::default().quarter(1);
        let with = |mark: f64, places: &[usize]| {
            let mut marked = map.clone();
            places.iter().for_each(|place| marked.heights[*place] = mark);
            none_is_marked(&marked)
        };
        assert_eq!(with(0.0, &[]), Ok(()));
        // Pits twice as deep as the surface is rough.
        let [low, high] = [f64::min, f64::max].map(|of| map.heights.iter().copied().reduce(of).unwrap());
        assert_eq!(with(3.0 * low - 2.0 * high, &[500, 501]), Ok(()));
        let above = high + 3.0 * (high - low);
        for (mark, places) in [(-9999.0, &[500, 501, 502][..]), (32767.0, &[7]), (above, &[7, 8, 9])] {
            let refused = with(mark, places).unwrap_err();
            assert!(
                refused.contains(&format!("{} heights are {} m", places.len(), digits(mark, 6))),
                "{refused}"
            );
        }
        let grating = (0..400).map(|place| f64::from(place / 10 % 2)).collect();
        assert_eq!(none_is_marked(&Topography::map((20, 1.0), (20, 1.0), grating)), Ok(()));
    }
}
