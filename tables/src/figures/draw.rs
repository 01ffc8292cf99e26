//! How panels and curves look.

use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LegendPosition, LinePlot, LineStyle, ScatterPlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;

use super::{Axis, Curve, Drawn, PIXELS, Panel};

/// Curves with more points than this get a few markers only, and a band instead of bars.
const FEW_POINTS: usize = 25;

/// Markers on a curve of many points.
const SPARSE_MARKERS: usize = 7;

/// Width of the lines of curves, in points.
const LINE_WIDTH: f64 = 1.8;

/// Colour, lengths of dashes and gaps in points, marker.
type Style = (&'static str, &'static [f64], MarkerShape);

#[rustfmt::skip]
const STYLES: [Style; 8] = [
    ("#000000", &[],                             MarkerShape::Circle),
    ("#0072B2", &[8.0, 4.0],                     MarkerShape::Square),
    ("#D55E00", &[2.5, 3.0],                     MarkerShape::Triangle),
    ("#009E73", &[9.0, 3.0, 2.5, 3.0],           MarkerShape::Diamond),
    ("#CC79A7", &[14.0, 4.0],                    MarkerShape::TriangleDown),
    ("#E69F00", &[5.0, 2.5],                     MarkerShape::Star),
    ("#56B4E9", &[9.0, 3.0, 2.5, 3.0, 2.5, 3.0], MarkerShape::Cross),
    ("#666666", &[2.0, 5.0],                     MarkerShape::Plus),
];

/// What the figure is drawn for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Medium {
    Vector,
    /// Here the library takes dash lengths for pixels, rounds their ends, and starts them anew
    /// at every point of the curve (dense curves come out solid; their markers tell them apart).
    Raster,
}

impl Medium {
    fn line_style(self, dashes: &[f64]) -> LineStyle {
        if dashes.is_empty() {
            return LineStyle::Solid;
        }
        let scale = f64::from(PIXELS);
        let length = |(n, length): (usize, &f64)| match self {
            Self::Vector => *length,
            Self::Raster if n % 2 == 0 => (scale * (length - LINE_WIDTH)).max(0.5),
            Self::Raster => scale * (length + LINE_WIDTH),
        };
        let lengths = dashes.iter().enumerate().map(length);
        let texts: Vec<String> = lengths.map(|length| format!("{length:.1}")).collect();
        LineStyle::Custom(texts.join(" "))
    }
}

impl Panel {
    pub(super) fn draw(&self, medium: Medium) -> (Vec<Plot>, Layout) {
        let mut plots = Vec::new();
        let mut shown = Vec::new();
        for (number, curve) in self.curves.iter().enumerate() {
            let points = self.visible(curve);
            if !points.is_empty() {
                draw_curve(curve, number, &points, self.y.log, medium, &mut plots);
                shown.extend(points);
            }
        }
        let layout = styled(Layout::auto_from_plots(&plots), &self.title, &self.x, &self.y)
            .with_legend_position(LegendPosition::OutsideRightTop)
            .with_legend_box(false);
        let x_range = logarithmic_range(shown.iter().map(|(x, _, _)| *x));
        let y_range = logarithmic_range(shown.iter().map(|(_, y, _)| *y));
        (plots, axes(layout, (&self.x, x_range), (&self.y, y_range)))
    }

    /// (x, y, error) of the points that can be drawn.
    pub(super) fn visible(&self, curve: &Curve) -> Vec<(f64, f64, f64)> {
        let on_axis = |value: f64, axis: &Axis| value.is_finite() && (value > 0.0 || !axis.log);
        let error = |n: usize| {
            let error = curve.error.as_ref().and_then(|error| error.get(n).copied());
            error.filter(|error| error.is_finite()).unwrap_or(0.0)
        };
        (curve.x.iter().zip(&curve.y).enumerate())
            .filter(|(_, (x, y))| on_axis(**x, &self.x) && on_axis(**y, &self.y))
            .map(|(n, (x, y))| (*x, *y, error(n)))
            .collect()
    }
}

/// Title, labels and sizes that all panels share.
pub(super) fn styled(layout: Layout, title: &str, x: &Axis, y: &Axis) -> Layout {
    layout
        .with_title(title)
        .with_x_label(x.label.as_str())
        .with_y_label(y.label.as_str())
        .with_title_size(15)
        .with_label_size(14)
        .with_tick_size(12)
        .with_body_size(12)
        .with_box_axes()
        // Clear of tick labels with a decimal point.
        .with_y_label_offset(-8.0, 0.0)
}

/// Ticks; of logarithmic axes also their range: by default the library ends
/// them at the decades around the data.
pub(super) fn axes(mut layout: Layout, x: (&Axis, (f64, f64)), y: (&Axis, (f64, f64))) -> Layout {
    layout = match x {
        (Axis { log: true, .. }, (from, to)) => {
            (layout.with_log_x().with_x_tick_format(power_of_ten())).with_x_axis_min(from).with_x_axis_max(to)
        }
        _ => layout.with_x_tick_format(plain()),
    };
    match y {
        (Axis { log: true, .. }, (from, to)) => {
            (layout.with_log_y().with_y_tick_format(power_of_ten())).with_y_axis_min(from).with_y_axis_max(to)
        }
        _ => layout.with_y_tick_format(plain()),
    }
}

/// The range of positive values and a little more, so that markers are not cut.
fn logarithmic_range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let ends = |(from, to): (f64, f64), value: f64| (from.min(value), to.max(value));
    let (from, to) = values.fold((f64::INFINITY, 0.0), ends);
    if to <= 0.0 {
        return (0.1, 10.0);
    }
    let margin = (to / from).powf(0.04).max(1.1);
    (from / margin, to * margin)
}

/// Ticks of a linear axis with all their digits: 0.0175 is not 0.018.
fn plain() -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(|value: f64| match value.abs() {
        // Rounding of the steps from tick to tick.
        ..1e-9 => "0".into(),
        1e-4..1e6 => format!("{}", (value * 1e6).round() / 1e6),
        _ => scientific(value),
    }))
}

/// Decades as powers, other ticks as they are.
fn power_of_ten() -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(|value: f64| match value {
        0.009..=1001.0 => format!("{}", (value * 1e6).round() / 1e6),
        _ => scientific(value),
    }))
}

fn scientific(value: f64) -> String {
    let exponent = (value.abs().log10() + 1e-9).floor();
    let mantissa = (value / 10f64.powf(exponent) * 1e6).round() / 1e6;
    let superscript: String = format!("{exponent}").chars().map(raised).collect();
    if mantissa == 1.0 { format!("10{superscript}") } else { format!("{mantissa}·10{superscript}") }
}

fn raised(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32(0x2070 + digit as u32 - '0' as u32).unwrap_or(digit),
        other => other,
    }
}

fn draw_curve(
    curve: &Curve,
    number: usize,
    points: &[(f64, f64, f64)],
    log: bool,
    medium: Medium,
    plots: &mut Vec<Plot>,
) {
    let number = curve.style.unwrap_or(number);
    let (color, dashes, marker) = STYLES[number % STYLES.len()];
    let few = points.len() <= FEW_POINTS;
    let mut line = LinePlot::new()
        .with_data(points.iter().map(|(x, y, _)| (*x, *y)))
        .with_color(color)
        .with_stroke_width(LINE_WIDTH)
        .with_line_style(medium.line_style(dashes));
    // A bar or band must not reach below zero on a logarithmic axis.
    let lower = |y: f64, error: f64| if log { error.min(0.95 * y) } else { error };
    let with_errors = points.iter().any(|(_, _, error)| *error > 0.0);
    if with_errors && !few {
        line = line.with_band(
            points.iter().map(|(_, y, error)| y - lower(*y, *error)),
            points.iter().map(|(_, y, error)| y + error),
        );
    }
    if curve.drawn != Drawn::Markers {
        plots.push(Plot::Line(line));
    }
    if curve.drawn == Drawn::Line {
        return;
    }

    let step = if few { 1 } else { points.len().div_ceil(SPARSE_MARKERS) };
    // Shifted from curve to curve, so that markers of close curves do not hide each other.
    let first = (number % STYLES.len()) * step / STYLES.len();
    let marked = || points.iter().skip(first).step_by(step);
    let mut markers = ScatterPlot::new()
        .with_data(marked().map(|(x, y, _)| (*x, *y)))
        .with_color(color)
        .with_size(4.0)
        .with_marker(marker);
    if with_errors && few {
        let bars = marked().map(|(_, y, error)| (lower(*y, *error), *error));
        markers = markers.with_y_err_asymmetric(bars);
    }
    if !curve.label.is_empty() {
        markers = markers.with_legend(curve.label.as_str());
    }
    plots.push(Plot::Scatter(markers));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_of_linear_axes_keep_their_digits() {
        let label = |value: f64| plain().format(value);
        for (value, expected) in
            [(0.0175, "0.0175"), (2.0, "2"), (-1.5, "-1.5"), (3e-17, "0"), (0.1 + 0.2, "0.3"), (2e7, "2·10⁷")]
        {
            assert_eq!(label(value), expected);
        }
    }

    #[test]
    fn ticks_are_powers_of_ten_and_their_multiples() {
        let TickFormat::Custom(format) = power_of_ten() else { panic!() };
        let shown = [1e-12, 5e-3, 0.02, 1.0, 1000.0, 2e6, 1e8].map(|value| format(value));
        assert_eq!(shown, ["10⁻¹²", "5·10⁻³", "0.02", "1", "1000", "2·10⁶", "10⁸"]);
    }

    #[test]
    fn logarithmic_axes_end_at_the_data() {
        let (from, to) = logarithmic_range([0.1, 10.0, 3.0].into_iter());
        assert!(0.08 < from && from < 0.1 && 10.0 < to && to < 12.5);
        assert_eq!(logarithmic_range([].into_iter()), (0.1, 10.0));
    }
}
