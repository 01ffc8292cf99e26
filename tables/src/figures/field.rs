//! A field over a plane, in bands of equal colour between round values, or in classes.

use super::Range;
use super::axis::steps;
use super::canvas::{Color, Point};

/// Polygons with a value at each corner, linear in between, and the meaning of the values.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Corners (x, y, value) of convex polygons; those with a value that is not finite are left out.
    pub cells: Vec<Vec<[f64; 3]>>,
    /// Colours.
    pub colors: Colors,
    /// Arrow in the direction of a motion.
    pub arrow: Option<Arrow>,
}

/// A direction with a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrow {
    /// What moves.
    pub text: String,
    /// Towards −x, not +x.
    pub backwards: bool,
}

/// Meaning of the values of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Colors {
    /// Bands between two values; the label, with the unit, is next to the scale. Dark for low and
    /// bright for high; where there are values of both signs, blue below zero and red above.
    Bands { label: String, from: f64, to: f64 },
    /// The value is the place of a name in this list.
    Classes(Vec<String>),
}

/// "Inferno" of S. van der Walt and N. Smith (matplotlib, CC0): lightness rises evenly.
const SEQUENTIAL: [u32; 11] = [
    0x000004, 0x160b39, 0x420a68, 0x6a176e, 0x932667, 0xbc3754, 0xdd513a, 0xf3771a, 0xfca50a, 0xf6d645,
    0xfcffa4,
];

/// "RdBu" of C. Brewer, from blue to red.
const DIVERGING: [u32; 11] = [
    0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b,
    0x67001f,
];

/// Light orange and blue of Okabe and Ito, distinct in grey, for two classes.
const CLASSES: [u32; 2] = [0xf0c05a, 0x0072b2];

/// Parts of a labelled interval of the scale, each a band.
const PARTS: f64 = 2.0;

/// Values of one colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Band {
    pub from: f64,
    pub to: f64,
    pub color: Color,
}

/// Bands from low to high.
pub(super) fn bands(from: f64, to: f64) -> Vec<Band> {
    if !(from < to && (to - from).is_finite()) {
        return Vec::new();
    }
    let step = steps(to - from).0 / PARTS;
    let inner = ((from / step + 1e-6).floor() as i64 + 1..).map(|n| n as f64 * step);
    let mut ends = vec![from];
    ends.extend(inner.take_while(|end| *end < to - 1e-6 * step));
    ends.push(to);
    let (map, low, high) = match signed(from, to) {
        true => (&DIVERGING, -to.max(-from), to.max(-from)),
        false => (&SEQUENTIAL, from, to),
    };
    let color = |pair: &[f64]| color(map, (0.5 * (pair[0] + pair[1]) - low) / (high - low));
    ends.windows(2).map(|pair| Band { from: pair[0], to: pair[1], color: color(pair) }).collect()
}

/// Whether values of both signs are more than a tenth of the range each.
fn signed(from: f64, to: f64) -> bool {
    to.min(-from) > 0.1 * (to - from)
}

/// Colours of classes.
pub(super) fn class(number: usize) -> Color {
    rgb(CLASSES[number % CLASSES.len()])
}

fn rgb(code: u32) -> Color {
    [16, 8, 0].map(|shift| (code >> shift) as u8)
}

/// The colour at a share of a map, linear between its colours.
fn color(map: &[u32], share: f64) -> Color {
    let place = share.clamp(0.0, 1.0) * (map.len() - 1) as f64;
    let lower = (place as usize).min(map.len() - 2);
    let (low, high, share) = (rgb(map[lower]), rgb(map[lower + 1]), place - lower as f64);
    std::array::from_fn(|n| (f64::from(low[n]) * (1.0 - share) + f64::from(high[n]) * share).round() as u8)
}

/// The part of a convex polygon where a component of its corners, linear between them, is at least `level`.
pub fn above<const N: usize>(polygon: &[[f64; N]], component: usize, level: f64) -> Vec<[f64; N]> {
    let mut part = Vec::new();
    for (n, corner) in polygon.iter().enumerate() {
        let next = polygon[(n + 1) % polygon.len()];
        let (here, there) = (corner[component] - level, next[component] - level);
        if here >= 0.0 {
            part.push(*corner);
        }
        if (here >= 0.0) != (there >= 0.0) {
            let share = here / (here - there);
            part.push(std::array::from_fn(|k| corner[k] + share * (next[k] - corner[k])));
        }
    }
    part
}

impl Field {
    /// The cells of a plane, `rows` by rows of corners: a quadrilateral between each four neighbours.
    pub fn quadrilaterals<const N: usize>(rows: &[Vec<[f64; N]>]) -> Vec<Vec<[f64; N]>> {
        let quadrilaterals = |pair: &[Vec<[f64; N]>]| -> Vec<Vec<[f64; N]>> {
            let sides = pair[0].windows(2).zip(pair[1].windows(2));
            sides.map(|(low, high)| vec![low[0], high[0], high[1], low[1]]).collect()
        };
        rows.windows(2).flat_map(quadrilaterals).collect()
    }

    /// Colours with the outlines that they fill.
    pub(super) fn painted(&self, placed: impl Fn(f64, f64) -> Point) -> Vec<(Color, Vec<Vec<Point>>)> {
        let cells = || self.cells.iter().filter(|cell| cell.iter().all(|corner| corner[2].is_finite()));
        let outline = |cell: &[[f64; 3]]| cell.iter().map(|[x, y, _]| placed(*x, *y)).collect();
        match &self.colors {
            Colors::Classes(names) => (0..names.len())
                .map(|n| {
                    let of_class = cells().filter(|cell| cell.first().is_some_and(|c| c[2] == n as f64));
                    (class(n), merged(of_class.map(|cell| outline(cell)).collect()))
                })
                .collect(),
            Colors::Bands { from, to, .. } => {
                let mut bands = bands(*from, *to);
                // Values on the ends, and by rounding beyond them, are in the last bands.
                bands.first_mut().into_iter().for_each(|first| first.from = f64::NEG_INFINITY);
                bands.last_mut().into_iter().for_each(|last| last.to = f64::INFINITY);
                let outlines =
                    |band: &Band| cells().map(|cell| outline(&between(cell, band.from, band.to))).collect();
                bands.iter().map(|band| (band.color, merged(outlines(band)))).collect()
            }
        }
    }
}

/// The part of a polygon with values from `low` to `high`.
fn between(polygon: &[[f64; 3]], low: f64, high: f64) -> Vec<[f64; 3]> {
    let outside = |corner: &[f64; 3]| corner[2] < low || corner[2] > high;
    if !polygon.iter().any(outside) {
        return polygon.to_vec();
    }
    let flipped =
        |polygon: Vec<[f64; 3]>| polygon.into_iter().map(|[x, y, v]| [x, y, -v]).collect::<Vec<_>>();
    let upper = above(polygon, 2, low);
    flipped(above(&flipped(upper), 2, -high))
}

/// Neighbours of a row of quadrilaterals in one outline.
fn merged(outlines: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    let mut strips: Vec<(Vec<Point>, Vec<Point>)> = Vec::new();
    let mut others = Vec::new();
    for outline in outlines.into_iter().filter(|outline| outline.len() > 2) {
        let &[low, high, next_high, next_low] = outline.as_slice() else {
            others.push(outline);
            continue;
        };
        match strips.last_mut() {
            Some((lows, highs)) if lows.last() == Some(&low) && highs.last() == Some(&high) => {
                lows.push(next_low);
                highs.push(next_high);
            }
            _ => strips.push((vec![low, next_low], vec![high, next_high])),
        }
    }
    let closed =
        strips.into_iter().map(|(lows, highs)| highs.into_iter().chain(lows.into_iter().rev()).collect());
    closed.chain(others).collect()
}

/// The range of the scale of a field.
pub(super) fn scale(colors: &Colors) -> Option<(&str, Range)> {
    match colors {
        Colors::Bands { label, from, to } if from < to => {
            Some((label, Range { from: *from, to: *to, log: false }))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance (sRGB, IEC 61966-2-1).
    fn luminance(color: Color) -> f64 {
        let linear = |part: u8| (f64::from(part) / 255.0).powf(2.2);
        0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2])
    }

    #[test]
    fn hot_is_bright_and_signs_are_blue_and_red() {
        let colors: Vec<Color> = bands(300.0, 1000.0).iter().map(|band| band.color).collect();
        assert!(colors.len() > 5 && colors.windows(2).all(|pair| luminance(pair[0]) < luminance(pair[1])));
        // Next to zero.
        assert_eq!(bands(-0.01, 3.0)[0].color, color(&SEQUENTIAL, 0.5 * 0.01 / 3.01));
        let signed = bands(-2.0, 1.0);
        let (lowest, highest) = (signed[0].color, signed[signed.len() - 1].color);
        assert!(lowest[2] > lowest[0] && highest[0] > highest[2]);
    }

    #[test]
    fn bands_end_at_round_values() {
        let ends: Vec<f64> = bands(290.0, 800.0).iter().map(|band| band.from).collect();
        assert_eq!(ends, [290.0, 300.0, 350.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 750.0]);
        assert_eq!(bands(1.0, 1.0), []);
    }

    /// Area of a polygon, positive whichever way its corners go round.
    fn area(corners: impl Iterator<Item = Point>) -> f64 {
        let corners: Vec<Point> = corners.collect();
        let next = |n: usize| corners[(n + 1) % corners.len()];
        let twice = |n: usize| corners[n].0 * next(n).1 - corners[n].1 * next(n).0;
        0.5 * (0..corners.len()).map(twice).sum::<f64>().abs()
    }

    #[test]
    fn a_square_is_cut_at_a_level() {
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 0.0]];
        let area = |polygon: Vec<[f64; 3]>| area(polygon.into_iter().map(|[x, y, _]| (x, y)));
        assert!((area(above(&square, 2, 0.3)) - 0.7).abs() < 1e-12);
        assert!((area(between(&square, 0.3, 0.8)) - 0.5).abs() < 1e-12);
        assert!(above(&square, 2, 1.5).is_empty());
    }

    #[test]
    fn the_parts_of_a_field_cover_it_once() {
        let rows: Vec<Vec<[f64; 3]>> = (0..9)
            .map(|i| (0..9).map(|j| [f64::from(j), f64::from(i), f64::from(i * i + 3 * j)]).collect())
            .collect();
        let colors = Colors::Bands { label: String::new(), from: 0.0, to: 88.0 };
        let field = Field { cells: Field::quadrilaterals(&rows), colors, arrow: None };
        assert_eq!(field.cells.len(), 64);
        let painted = field.painted(|x, y| (x, y));
        let outlines = || painted.iter().flat_map(|(_, outlines)| outlines);
        let whole: f64 = outlines().map(|outline| area(outline.iter().copied())).sum();
        assert!((whole - 64.0).abs() < 1e-9, "{whole}");
        assert!(outlines().count() < 250, "{}", outlines().count());
    }
}
