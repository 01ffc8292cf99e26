//! One panel: frame with ticks, field, curves, legend.

use super::axis::{Range, Ticks, signed};
use super::canvas::{Anchor, BLACK, CURVE_WIDTH, GAP, Group, Mark, Point, SMALL, width};
use super::field::{Band, bands, scale};
use super::legend::{Legend, STYLES, marker};
use super::{Arrow, Curve, Drawn, Panel};

/// Width and height of a panel in points: 85 mm, a column of a journal, and 66 mm.
pub(super) const SIZE: Point = (241.0, 187.0);

/// Size of the texts of axes, in points.
const LABEL: f64 = 8.0;
const TICK: f64 = 4.0;
const BAR_WIDTH: f64 = 8.0;

/// Curves with more points than this have a few markers and error bars only.
const FEW_POINTS: usize = 25;
/// Markers on a curve of many points.
const SPARSE_MARKERS: usize = 7;

/// Plotting area with the ranges of its axes.
struct Frame {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
    x: Range,
    y: Range,
}

/// A curve as drawn: place of its points, and half lengths of their error bars below and above.
struct Drawing<'a> {
    curve: &'a Curve,
    style: usize,
    points: Vec<Value>,
}

/// A point of a curve with the error of its ordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Value {
    pub x: f64,
    pub y: f64,
    pub error: f64,
}

pub(super) fn draw(panel: &Panel, at: Point) -> Group {
    let mut group = Group { name: format!("panel {}", panel.name), at, marks: Vec::new() };
    let drawings = drawings(panel);
    let legend = Legend::new(drawings.iter().map(|d| (d.style, d.curve)), panel.field.as_ref());
    let inside = Frame::new(panel, &drawings, 0.0);
    let (frame, corner) = match legend.size() {
        None => (inside, None),
        Some(size) => match inside.free_corner(size, panel, &drawings) {
            Some(corner) => (inside, Some(corner)),
            None => {
                let beside = Frame::new(panel, &drawings, size.0 + GAP);
                let corner = (beside.right + GAP, beside.top);
                (beside, Some(corner))
            }
        },
    };
    frame.field(panel, &mut group);
    for drawing in &drawings {
        frame.curve(drawing, &mut group);
    }
    frame.axes(panel, &mut group);
    if let Some(corner) = corner {
        legend.draw(corner, &mut group);
    }
    group
}

fn drawings<'a>(panel: &'a Panel) -> Vec<Drawing<'a>> {
    let drawing = |(number, curve): (usize, &'a Curve)| {
        let style = curve.style.unwrap_or(number) % STYLES.len();
        Drawing { curve, style, points: panel.visible(curve) }
    };
    let all = panel.curves.iter().enumerate().map(drawing);
    all.filter(|drawing| !drawing.points.is_empty()).collect()
}

impl Panel {
    /// The points that can be drawn.
    pub(super) fn visible(&self, curve: &Curve) -> Vec<Value> {
        let on_axis = |value: f64, log: bool| value.is_finite() && (value > 0.0 || !log);
        let error = |n: usize| {
            let error = curve.error.as_ref().and_then(|error| error.get(n).copied());
            error.filter(|error| error.is_finite()).unwrap_or(0.0)
        };
        (curve.x.iter().zip(&curve.y).enumerate())
            .filter(|(_, (x, y))| on_axis(**x, self.x.log) && on_axis(**y, self.y.log))
            .map(|(n, (x, y))| Value { x: *x, y: *y, error: error(n) })
            .collect()
    }
}

impl Frame {
    fn new(panel: &Panel, drawings: &[Drawing], legend: f64) -> Self {
        let points = || drawings.iter().flat_map(|drawing| &drawing.points);
        let corners = || panel.field.iter().flat_map(|field| field.cells.iter().flatten());
        let x = points().map(|point| point.x).chain(corners().map(|corner| corner[0]));
        // Bars that reach to zero would take a logarithmic axis with them.
        let below = |point: &Value| point.y - if panel.y.log { 0.0 } else { point.error };
        let ends = points().flat_map(|point| [below(point), point.y + point.error]);
        let y = ends.chain(corners().map(|corner| corner[1]));
        let (x, y) = (Range::new(&panel.x, x), Range::new(&panel.y, y));
        let bar = match panel.field.as_ref().and_then(|field| scale(&field.colors)) {
            Some((_, range)) => 2.0 * GAP + BAR_WIDTH + range.ticks().widest() + GAP + LABEL,
            None => 0.0,
        };
        let last_label = 0.5 * x.ticks().labelled.last().map_or(0.0, |(_, label)| width(label, SMALL));
        let mut frame = Self {
            left: LABEL + 2.0 * GAP + y.ticks().widest(),
            top: if panel.title.is_empty() { 2.0 * GAP } else { LABEL + 2.5 * GAP },
            right: SIZE.0 - bar - legend - (last_label + 1.0).max(2.0 * GAP),
            bottom: SIZE.1 - SMALL - LABEL - 3.0 * GAP,
            x,
            y,
        };
        if panel.equal {
            let (width, height) = (frame.right - frame.left, frame.bottom - frame.top);
            let scale = (width / (x.to - x.from)).min(height / (y.to - y.from));
            let spare = width - scale * (x.to - x.from);
            frame.left += 0.5 * spare;
            frame.right -= 0.5 * spare;
            frame.top = frame.bottom - scale * (y.to - y.from);
        }
        frame
    }

    fn place(&self, x: f64, y: f64) -> Point {
        (
            self.left + (self.right - self.left) * self.x.place(x),
            self.bottom - (self.bottom - self.top) * self.y.place(y),
        )
    }

    /// Ends of the error bar of a point, inside of the frame.
    fn bar(&self, Value { x, y, error }: Value) -> [Point; 2] {
        let lower = if self.y.log { (y - error).max(self.y.from) } else { y - error };
        [self.place(x, lower), self.place(x, y + error)]
    }

    fn axes(&self, panel: &Panel, group: &mut Group) {
        let Self { left, top, right, bottom, .. } = *self;
        let (x, y) = (self.x.ticks(), self.y.ticks());
        group.line(
            vec![(left, top), (right, top), (right, bottom), (left, bottom), (left, top), (right, top)],
            0.6,
        );
        for (value, length) in x.all() {
            let along = self.place(value, self.y.from).0;
            group.line(vec![(along, bottom), (along, bottom - length)], 0.5);
            group.line(vec![(along, top), (along, top + length)], 0.5);
        }
        for (value, length) in y.all() {
            let height = self.place(self.x.from, value).1;
            group.line(vec![(left, height), (left + length, height)], 0.5);
            group.line(vec![(right, height), (right - length, height)], 0.5);
        }
        for (value, label) in &x.labelled {
            let along = self.place(*value, self.y.from).0;
            group.text((along, bottom + SMALL + 0.5 * GAP), label, SMALL, Anchor::Middle);
        }
        for (value, label) in &y.labelled {
            let height = self.place(self.x.from, *value).1;
            group.text((left - 0.7 * GAP, height + 0.36 * SMALL), label, SMALL, Anchor::End);
        }
        if y.exponent != 0 {
            group.text((left, top - 0.5 * GAP), multiplied(y.exponent), SMALL, Anchor::Start);
        }
        if x.exponent != 0 {
            let at = (SIZE.0 - 1.0, bottom + SMALL + LABEL + 1.5 * GAP);
            group.text(at, multiplied(x.exponent), SMALL, Anchor::End);
        }
        let middle = (0.5 * (left + right), 0.5 * (top + bottom));
        let below = bottom + SMALL + LABEL + 1.5 * GAP;
        group.text((middle.0, below), &panel.x.label, LABEL, Anchor::Middle);
        let size = fitting(&panel.y.label, LABEL, 2.0 * middle.1.min(SIZE.1 - middle.1));
        group.text((left - y.widest() - 1.5 * GAP, middle.1), &panel.y.label, size, Anchor::Upwards);
        let size = fitting(&panel.title, LABEL, 2.0 * middle.0.min(SIZE.0 - middle.0));
        group.text((middle.0, top - 1.2 * GAP), &panel.title, size, Anchor::Middle);
    }

    fn field(&self, panel: &Panel, group: &mut Group) {
        let Some(field) = &panel.field else { return };
        for (color, outlines) in field.painted(|x, y| self.place(x, y)) {
            group.marks.push(Mark::Fill { outlines, color, seam: 0.3 });
        }
        if let Some((label, range)) = scale(&field.colors) {
            self.color_bar(label, &range, group);
        }
        if let Some(arrow) = &field.arrow {
            self.arrow(arrow, group);
        }
    }

    fn arrow(&self, arrow: &Arrow, group: &mut Group) {
        const LENGTH: f64 = 16.0;
        let (left, y) = (self.left + GAP, self.bottom - GAP);
        let (right, height) = (left + LENGTH, y - 0.35 * SMALL);
        let (start, tip, forwards) = if arrow.backwards { (right, left, -1.0) } else { (left, right, 1.0) };
        group.line(vec![(start, height), (tip - 3.0 * forwards, height)], 0.8);
        let barbs = tip - 4.5 * forwards;
        group.fill(vec![(tip, height), (barbs, height - 1.8), (barbs, height + 1.8)], BLACK);
        group.text((right + 2.0, y), &arrow.text, SMALL, Anchor::Start);
    }

    fn color_bar(&self, label: &str, range: &Range, group: &mut Group) {
        let (left, right) = (self.right + 2.0 * GAP, self.right + 2.0 * GAP + BAR_WIDTH);
        let height = |value: f64| self.bottom - (self.bottom - self.top) * range.place(value);
        let outline = |low, high| {
            vec![(left, height(low)), (right, height(low)), (right, height(high)), (left, height(high))]
        };
        for Band { from, to, color } in bands(range.from, range.to) {
            group.fill(outline(from, to), color);
        }
        let mut frame = outline(range.from, range.to);
        frame.extend_from_within(..2);
        group.line(frame, 0.5);
        let ticks = range.ticks();
        for (value, text) in &ticks.labelled {
            group.line(vec![(right, height(*value)), (right - 2.0, height(*value))], 0.5);
            group.text((right + 0.5 * GAP, height(*value) + 0.36 * SMALL), text, SMALL, Anchor::Start);
        }
        if ticks.exponent != 0 {
            group.text((left, self.top - 0.5 * GAP), multiplied(ticks.exponent), SMALL, Anchor::Start);
        }
        let middle = 0.5 * (self.top + self.bottom);
        group.text((right + GAP + ticks.widest() + 0.9 * LABEL, middle), label, LABEL, Anchor::Upwards);
    }

    fn curve(&self, drawing: &Drawing, group: &mut Group) {
        let (color, dashes, _) = STYLES[drawing.style];
        let line = |points, dashes, width| Mark::Line { points, color, width, dashes };
        if drawing.curve.drawn != Drawn::Markers {
            let points = drawing.points.iter().map(|point| self.place(point.x, point.y)).collect();
            group.marks.push(line(points, dashes, CURVE_WIDTH));
        }
        if drawing.curve.drawn == Drawn::Line {
            return;
        }
        for point in drawing.marked() {
            if point.error > 0.0 {
                let ends = self.bar(point);
                group.marks.push(line(ends.to_vec(), &[], 0.6));
                for (x, y) in ends {
                    group.marks.push(line(vec![(x - 1.5, y), (x + 1.5, y)], &[], 0.6));
                }
            }
            group.fill(marker(drawing.style, self.place(point.x, point.y)), color);
        }
    }

    /// Points of a curve and its bars, close to each other.
    fn occupied(&self, drawing: &Drawing) -> Vec<Point> {
        const DISTANCE: f64 = 3.0;
        let between = |(from, to): (Point, Point)| {
            let parts = ((to.0 - from.0).hypot(to.1 - from.1) / DISTANCE).ceil().max(1.0) as usize;
            (0..=parts).map(move |n| {
                let share = n as f64 / parts as f64;
                (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
            })
        };
        let points: Vec<Point> = drawing.points.iter().map(|point| self.place(point.x, point.y)).collect();
        let lines = points.windows(2).map(|pair| (pair[0], pair[1]));
        let bars = drawing.marked().map(|point| self.bar(point)).map(|[from, to]| (from, to));
        lines.chain(bars).chain(points.first().map(|point| (*point, *point))).flat_map(between).collect()
    }

    /// Upper left corner of a legend of this size that covers no curve and no field.
    fn free_corner(&self, (width, height): Point, panel: &Panel, drawings: &[Drawing]) -> Option<Point> {
        const CLEAR: f64 = 3.0;
        let margin = TICK + CLEAR;
        let (left, right) = (self.left + margin, self.right - margin - width);
        let (top, bottom) = (self.top + margin, self.bottom - margin - height);
        let (centre, middle) = (0.5 * (left + right), 0.5 * (top + bottom));
        let corners = [
            (right, top),
            (left, top),
            (right, bottom),
            (left, bottom),
            (centre, top),
            (right, middle),
            (left, middle),
            (centre, bottom),
        ];
        let occupied: Vec<Point> = drawings.iter().flat_map(|drawing| self.occupied(drawing)).collect();
        let covers = |(x, y): Point| {
            occupied.iter().any(|point| {
                (x - CLEAR..=x + width + CLEAR).contains(&point.0)
                    && (y - CLEAR..=y + height + CLEAR).contains(&point.1)
            })
        };
        let fits = panel.field.is_none()
            && width < self.right - self.left - 2.0 * margin
            && height < self.bottom - self.top - 2.0 * margin;
        corners.into_iter().find(|corner| fits && !covers(*corner))
    }
}

impl Drawing<'_> {
    /// Points with a marker.
    fn marked(&self) -> impl Iterator<Item = Value> {
        let count = if self.curve.drawn == Drawn::Line { 0 } else { self.points.len() };
        let step = if count <= FEW_POINTS { 1 } else { count.div_ceil(SPARSE_MARKERS) };
        // Shifted from curve to curve, so that markers of close curves do not hide each other.
        let first = self.style * step / STYLES.len();
        self.points.iter().take(count).skip(first).step_by(step).copied()
    }
}

/// Size, at most `largest`, at which a text is not longer than `room`.
pub(super) fn fitting(text: &str, largest: f64, room: f64) -> f64 {
    largest.min(largest * room / width(text, largest))
}

impl Ticks {
    /// Values and lengths, those with labels first.
    fn all(&self) -> impl Iterator<Item = (f64, f64)> {
        let labelled = self.labelled.iter().map(|(value, _)| (*value, TICK));
        labelled.chain(self.minor.iter().map(|value| (*value, 0.5 * TICK)))
    }

    /// Length of the longest label.
    fn widest(&self) -> f64 {
        self.labelled.iter().map(|(_, label)| width(label, SMALL)).fold(0.0, f64::max)
    }
}

fn multiplied(exponent: i32) -> String {
    format!("×10^{{{}}}", signed(&exponent.to_string()))
}
