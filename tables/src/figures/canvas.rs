//! What is drawn, as marks in points (1/72 inch) from the upper left corner, and the lengths of texts.
//!
//! Texts have two marks of LaTeX: `_{...}` and `^{...}`.

use std::sync::LazyLock;

use ttf_parser::Face;

/// Subset of DejaVu Sans: Latin, Greek, Cyrillic, mathematical signs. Licence in `font/LICENSE`.
pub(super) const FONT: &[u8] = include_bytes!("font/DejaVuSans.ttf");

static FACE: LazyLock<Face> =
    LazyLock::new(|| Face::parse(FONT, 0).expect("the font of the program is valid"));

/// (x, y) in points.
pub(super) type Point = (f64, f64);

/// Red, green, blue.
pub(super) type Color = [u8; 3];

pub(super) const BLACK: Color = [0; 3];

/// Size of the small texts, those of ticks and legends, in points.
pub(super) const SMALL: f64 = 7.0;
/// Between texts and what they belong to, in points.
pub(super) const GAP: f64 = 3.5;
pub(super) const CURVE_WIDTH: f64 = 1.0;

/// Position of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
    /// Centred, and read upwards.
    Upwards,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Mark {
    /// Closed polygons with an outline in the same colour, so that no background shows between neighbours.
    Fill {
        outlines: Vec<Vec<Point>>,
        color: Color,
        seam: f64,
    },
    Line {
        points: Vec<Point>,
        color: Color,
        width: f64,
        dashes: &'static [f64],
    },
    Text {
        at: Point,
        text: String,
        size: f64,
        anchor: Anchor,
    },
}

/// Marks of one panel, or of the title.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Group {
    pub name: String,
    /// Upper left corner on the page.
    pub at: Point,
    pub marks: Vec<Mark>,
}

/// A figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Page {
    pub width: f64,
    pub height: f64,
    pub groups: Vec<Group>,
}

impl Group {
    pub fn line(&mut self, points: Vec<Point>, width: f64) {
        self.marks.push(Mark::Line { points, color: BLACK, width, dashes: &[] });
    }

    pub fn fill(&mut self, outline: Vec<Point>, color: Color) {
        self.marks.push(Mark::Fill { outlines: vec![outline], color, seam: 0.0 });
    }

    pub fn text(&mut self, at: Point, text: impl Into<String>, size: f64, anchor: Anchor) {
        let text = text.into();
        if !text.is_empty() {
            self.marks.push(Mark::Text { at, text, size, anchor });
        }
    }
}

/// A part of a text on one level.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub text: String,
    /// Size relative to the text.
    pub scale: f64,
    /// Height of the base line above that of the text, in sizes of the text.
    pub rise: f64,
}

/// The parts of a text with its subscripts and superscripts.
pub(super) fn runs(text: &str) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut add = |text: &str, scale, rise| {
        if !text.is_empty() {
            runs.push(Run { text: text.into(), scale, rise });
        }
    };
    let mut rest = text;
    while let Some(start) = rest.find("_{").into_iter().chain(rest.find("^{")).min() {
        let Some(length) = rest[start..].find('}') else { break };
        add(&rest[..start], 1.0, 0.0);
        let rise = if rest[start..].starts_with('_') { -0.2 } else { 0.35 };
        add(&rest[start + 2..start + length], 0.7, rise);
        rest = &rest[start + length + 1..];
    }
    add(rest, 1.0, 0.0);
    runs
}

/// Length of a text.
pub(super) fn width(text: &str, size: f64) -> f64 {
    // At size 1; of a character that the font lacks that of its replacement.
    let advance = |character: char| {
        let glyph = FACE.glyph_index(character).unwrap_or_default();
        f64::from(FACE.glyph_hor_advance(glyph).unwrap_or(0)) / f64::from(FACE.units_per_em())
    };
    runs(text).iter().map(|run| size * run.scale * run.text.chars().map(advance).sum::<f64>()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subscripts_and_superscripts_are_parts_of_a_text() {
        let parts = |text| runs(text).into_iter().map(|run| (run.text, run.rise)).collect::<Vec<_>>();
        let expected = [("ω", 0.0), ("c", -0.2), (" in 10", 0.0), ("−9", 0.35), (" m", 0.0)];
        assert_eq!(parts("ω_{c} in 10^{−9} m"), expected.map(|(text, rise)| (text.to_string(), rise)));
        assert_eq!(parts("a_{b"), [("a_{b".to_string(), 0.0)]);
    }

    #[test]
    fn the_font_has_the_characters_of_labels() {
        for character in "abcXYZ0189 µμωτσθ₀²³⁻¹·×±−–—°≤≥→%()/_Å".chars() {
            assert!(FACE.glyph_index(character).is_some(), "{character}");
        }
        // 0.636 em a digit (DejaVu Sans).
        assert!((width("00", 10.0) - 12.72).abs() < 0.01);
    }
}
