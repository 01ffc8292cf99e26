//! Figures of both programs: panels of curves, maps and cells, as SVG or PNG by the extension of the file.
//!
//! Curves differ in colour (palette of Okabe & Ito, for colour-blind readers), dash and marker, so that they are
//! distinct in grey as well. No fonts of the system are used; equal figures give equal bytes.
//!
//! The sheet of a table is in `table.rs`. Depends on `interpolation`, `table`, `quantity`, and on `netcdf` for the
//! atomic write.

mod cells;
mod draw;
mod map;
mod sheet;
mod table;

use std::path::Path;

pub use cells::{Cell, Cells, Scale};
pub use map::Map;
pub use sheet::{Drawing, Sheet};

/// A sheet of panels, two in a row.
#[derive(Clone, Debug, Default, PartialEq)]
/// ```
/// use tables::figures::{Axis, Curve, Figure, Panel};
///
/// let curve = Curve::new("a curve", vec![0.1, 1.0, 10.0], vec![0.3, 0.25, 0.2]).with_error(vec![0.01; 3]);
/// let panel = Panel {
///     title: "Friction".into(),
///     x: Axis::logarithmic("slip rate (m/s)"),
///     y: Axis::linear("friction coefficient"),
///     curves: vec![curve],
/// };
/// let svg = Figure { title: String::new(), panels: vec![panel] }.svg();
/// assert!(svg.contains("slip rate (m/s)"));
/// ```
pub struct Figure {
    /// Above the drawing; may be empty.
    pub title: String,
    /// Two in a row.
    pub panels: Vec<Panel>,
}

/// One pair of axes with its curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Above the drawing; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// In the order of the legend.
    pub curves: Vec<Curve>,
}

/// Label, with the unit, and scale of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// With the unit.
    pub label: String,
    /// Whether logarithmic.
    pub log: bool,
}

/// A line through points; points that are not finite, or not positive on a logarithmic axis,
/// are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Empty: not in the legend.
    pub label: String,
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates, as many.
    pub y: Vec<f64>,
    /// Absolute errors of `y`, drawn as bars on few points and as a band on many.
    pub error: Option<Vec<f64>>,
    /// Line, markers or both.
    pub drawn: Drawn,
    /// Number of the colour, dash and marker; by default the place among the curves.
    pub style: Option<usize>,
}

/// What of a curve is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Drawn {
    #[default]
    LineAndMarkers,
    /// Measured points.
    Markers,
    /// What was fitted to them.
    Line,
}

/// Why a figure was not made.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    #[error("cannot draw {path}: the extension must be one of svg, png")]
    Extension { path: String },
    #[error("cannot write {path}: {reason}")]
    Write { path: String, reason: String },
}

/// Pixels per point of a PNG.
const PIXELS: f32 = 2.0;

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: false }
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: true }
    }
}

impl Curve {
    /// A curve without errors.
    pub fn new(label: impl Into<String>, x: Vec<f64>, y: Vec<f64>) -> Self {
        Self { label: label.into(), x, y, ..Self::default() }
    }

    /// The curve with absolute errors of `y`.
    pub fn with_error(mut self, error: Vec<f64>) -> Self {
        self.error = Some(error);
        self
    }

    /// Only a part of it, in the style of that number.
    pub fn drawn_as(mut self, drawn: Drawn, style: usize) -> Self {
        self.drawn = drawn;
        self.style = Some(style);
        self
    }
}

impl Figure {
    /// Whether `path` has an extension that [`Figure::save`] supports: to be checked before a long
    /// computation.
    pub fn check_extension(path: &Path) -> Result<(), FigureError> {
        extension(path).map(|_| ())
    }

    /// Draws the figure into a file.
    pub fn save(&self, path: &Path) -> Result<(), FigureError> {
        self.sheet().save(path)
    }

    /// The figure as SVG.
    pub fn svg(&self) -> String {
        self.sheet().svg()
    }

    fn sheet(&self) -> Sheet {
        let panels = self.panels.iter().cloned().map(Drawing::Curves).collect();
        Sheet::new(self.title.clone(), panels)
    }
}

enum Extension {
    Svg,
    Png,
}

fn extension(path: &Path) -> Result<Extension, FigureError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("svg") => Ok(Extension::Svg),
        Some("png") => Ok(Extension::Png),
        _ => Err(FigureError::Extension { path: path.display().to_string() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure() -> Figure {
        let x: Vec<f64> = (0..9).map(|n| 10f64.powf(n as f64 / 4.0 - 1.0)).collect();
        let curve = |n: usize| {
            let y: Vec<f64> = x.iter().map(|x| 0.3 / (1.0 + x / n as f64)).collect();
            let error = y.iter().map(|y| 0.05 * y).collect();
            Curve::new(format!("{n} ω_c"), x.clone(), y).with_error(error)
        };
        Figure {
            title: "Friction".to_string(),
            panels: vec![Panel {
                title: "weakening".to_string(),
                x: Axis::logarithmic("slip rate V (m/s)"),
                y: Axis::linear("friction coefficient"),
                curves: (1..4).map(curve).collect(),
            }],
        }
    }

    #[test]
    fn svg_and_png_are_written_and_reproducible() {
        for extension in ["svg", "PNG"] {
            let name = format!("tables-figure-{}.{extension}", std::process::id());
            let path = std::env::temp_dir().join(name);
            figure().save(&path).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            figure().save(&path).unwrap();
            assert!(bytes == std::fs::read(&path).unwrap(), "{extension}");
            assert!(bytes.len() > 2000);
            std::fs::remove_file(&path).unwrap();
        }
    }

    #[test]
    fn labels_and_units_are_in_the_figure() {
        let svg = figure().svg();
        for text in ["slip rate V (m/s)", "friction coefficient", "3 ω_c"] {
            assert!(svg.contains(text), "{text}");
        }
    }

    #[test]
    fn points_and_their_fit_share_a_colour() {
        let (x, y) = (vec![1.0, 2.0, 3.0], vec![1.0, 3.0, 2.0]);
        let svg = |drawn: Drawn| {
            let panel = Panel {
                curves: vec![Curve::new("", x.clone(), y.clone()).drawn_as(drawn, 1)],
                ..Panel::default()
            };
            Figure { panels: vec![panel], ..Figure::default() }.svg()
        };
        let [both, points, line] = [Drawn::LineAndMarkers, Drawn::Markers, Drawn::Line].map(svg);
        for picture in [&both, &points, &line] {
            assert!(picture.contains("#0072b2") && !picture.contains("#d55e00"));
        }
        assert!(both.len() > points.len() && both.len() > line.len());
        assert!(line.contains("stroke-dasharray") && !points.contains("stroke-dasharray"));
    }

    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let mut figure = figure();
        figure.panels[0].curves = vec![
            Curve::new("zero", vec![0.0, 1.0, 2.0], vec![1.0, f64::NAN, 3.0]),
            Curve::new("nothing", vec![0.0], vec![1.0]),
        ];
        let points = figure.panels[0].visible(&figure.panels[0].curves[0]);
        assert_eq!(points, [(2.0, 3.0, 0.0)]);
        figure.svg();
        figure.panels.clear();
        figure.svg();
    }

    #[test]
    fn other_extensions_are_refused() {
        let error = figure().save(Path::new("plot.pdf")).unwrap_err();
        assert_eq!(error.to_string(), "cannot draw plot.pdf: the extension must be one of svg, png");
    }
}
