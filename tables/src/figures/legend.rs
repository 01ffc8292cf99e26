//! Styles of curves, and the legend that names them.

use std::f64::consts::PI;

use super::canvas::{Anchor, CURVE_WIDTH, Color, GAP, Group, Mark, Point, SMALL, width};
use super::field::class;
use super::{Colors, Curve, Drawn, Field};

/// Width of a legend key.
const KEY_WIDTH: f64 = 20.0;
/// Radius of a marker.
const MARKER: f64 = 2.1;

/// Colour, dashes, and marker: number of points, their inner radius, rotation in parts of π.
type Style = (Color, &'static [f64], (usize, f64, f64));

/// Colours of M. Okabe and K. Ito, Color Universal Design (2008).
#[rustfmt::skip]
pub(super) const STYLES: [Style; 8] = [
    ([0x00, 0x00, 0x00], &[],                             (12, 0.97, 0.0)),
    ([0x00, 0x72, 0xb2], &[4.0, 2.0],                     (4, 0.71, 0.25)),
    ([0xd5, 0x5e, 0x00], &[1.2, 1.6],                     (3, 0.5, 0.5)),
    ([0x00, 0x9e, 0x73], &[5.0, 1.5, 1.2, 1.5],           (4, 0.71, 0.0)),
    ([0xcc, 0x79, 0xa7], &[8.0, 2.0],                     (3, 0.5, 1.5)),
    ([0xe6, 0x9f, 0x00], &[2.5, 1.2],                     (5, 0.4, 0.5)),
    ([0x56, 0xb4, 0xe9], &[5.0, 1.5, 1.2, 1.5, 1.2, 1.5], (4, 0.35, 0.25)),
    ([0x66, 0x66, 0x66], &[1.2, 3.0],                     (4, 0.35, 0.0)),
];

/// A star around a point.
pub(super) fn marker(style: usize, (x, y): Point) -> Vec<Point> {
    let (points, inner, rotation) = STYLES[style].2;
    let corner = |n: usize| {
        let angle = PI * (n as f64 / points as f64 - rotation);
        let radius = MARKER * if n.is_multiple_of(2) { 1.0 } else { inner };
        (x + radius * angle.cos(), y + radius * angle.sin())
    };
    (0..2 * points).map(corner).collect()
}

/// Legend keys with their texts.
pub(super) struct Legend<'a>(Vec<(LegendKey, &'a str)>);

/// What the legend shows before a text.
enum LegendKey {
    Curve(usize, Drawn),
    Class(Color),
}

/// Height of a line.
const LINE: f64 = SMALL + 2.5;

impl<'a> Legend<'a> {
    /// The legend of curves with the numbers of their styles, and of a field of classes.
    pub fn new(curves: impl Iterator<Item = (usize, &'a Curve)>, field: Option<&'a Field>) -> Self {
        let labelled = curves.filter(|(_, curve)| !curve.label.is_empty());
        let curves =
            labelled.map(|(style, curve)| (LegendKey::Curve(style, curve.drawn), curve.label.as_str()));
        let classes = field.iter().flat_map(|field| match &field.colors {
            Colors::Classes(names) => names.as_slice(),
            Colors::Bands { .. } => &[],
        });
        let classes = classes.enumerate().map(|(n, name)| (LegendKey::Class(class(n)), name.as_str()));
        Self(curves.chain(classes).collect())
    }

    /// Width and height; none of an empty one.
    pub fn size(&self) -> Option<Point> {
        let widest = self.0.iter().map(|(_, text)| width(text, SMALL)).reduce(f64::max)?;
        Some((KEY_WIDTH + GAP + widest, LINE * self.0.len() as f64))
    }

    pub fn draw(&self, (left, top): Point, group: &mut Group) {
        for (n, (key, text)) in self.0.iter().enumerate() {
            let middle = top + LINE * (n as f64 + 0.5);
            match *key {
                LegendKey::Curve(style, drawn) => {
                    let (color, dashes, _) = STYLES[style];
                    if drawn != Drawn::Markers {
                        let points = vec![(left, middle), (left + KEY_WIDTH, middle)];
                        group.marks.push(Mark::Line { points, color, width: CURVE_WIDTH, dashes });
                    }
                    if drawn != Drawn::Line {
                        group.fill(marker(style, (left + 0.5 * KEY_WIDTH, middle)), color);
                    }
                }
                LegendKey::Class(color) => {
                    let (right, above, below) =
                        (left + KEY_WIDTH, middle - 0.35 * LINE, middle + 0.35 * LINE);
                    group.fill(vec![(left, above), (right, above), (right, below), (left, below)], color);
                }
            }
            group.text((left + KEY_WIDTH + GAP, middle + 0.36 * SMALL), *text, SMALL, Anchor::Start);
        }
    }
}
