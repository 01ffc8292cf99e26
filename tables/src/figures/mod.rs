//! Figures of both programs: panels of curves and fields, as SVG, PNG or PDF by the extension of the file.
//!
//! A panel is as wide as a column of a journal (85 mm). Curves differ in colour (palette of Okabe & Ito, for
//! colour-blind readers), dash and marker, so that they are distinct in grey as well. No fonts of the system are
//! used; equal figures give equal bytes.
//!
//! `panel.rs` places the marks of `canvas.rs`, which `svg.rs` writes and `export.rs` converts. The figure of a table is
//! in `table.rs`. Depends on `interpolation`, `table`, `quantity`, and on `netcdf` for the atomic write.

mod axis;
mod canvas;
mod export;
mod field;
mod legend;
mod panel;
mod svg;
mod table;

use std::io;
use std::path::Path;

use crate::netcdf::write_atomically;
use crate::quantity::Estimate;
use axis::Range;
use canvas::{Anchor, Group, Page};
pub use field::{Arrow, Colors, Field, above};
pub use svg::escaped;
pub use table::{PANELS as TABLE_PANELS, panels as table_panels};

/// Panels in rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Above the panels; may be empty.
    pub title: String,
    pub panels: Vec<Panel>,
    /// Panels in a row, at least one.
    pub columns: usize,
}

/// One pair of axes with a field and curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Name by which the panel is chosen; several may have the same.
    pub name: String,
    /// Title above the panel; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Whether it begins a row.
    pub new_row: bool,
    /// Whether lengths are equal on both axes.
    pub equal: bool,
    /// Field below the curves.
    pub field: Option<Field>,
    /// Curves in the order of the legend.
    pub curves: Vec<Curve>,
}

/// Label, with the unit, and scale of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Label with the unit; subscripts and superscripts as `_{...}` and `^{...}`.
    pub label: String,
    /// Whether logarithmic.
    pub log: bool,
    /// Ends; by default around the values.
    pub ends: Option<(f64, f64)>,
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
    /// Absolute errors of `y`, drawn as bars at the markers.
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
#[error("{0}")]
pub struct FigureError(String);

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: true, ends: None }
    }

    /// The axis between given ends.
    pub fn between(mut self, from: f64, to: f64) -> Self {
        self.ends = Some((from, to));
        self
    }
}

impl Curve {
    /// A curve without errors.
    pub fn new(label: impl Into<String>, x: Vec<f64>, y: Vec<f64>) -> Self {
        Self { label: label.into(), x, y, ..Self::default() }
    }

    /// A curve with the errors of `y`.
    pub fn with_errors(label: impl Into<String>, x: Vec<f64>, y: impl IntoIterator<Item = Estimate>) -> Self {
        let (y, error) = y.into_iter().map(|y| (y.value, y.error)).unzip();
        Self { error: Some(error), ..Self::new(label, x, y) }
    }

    /// Only a part of it, in the style of that number.
    pub fn drawn_as(mut self, drawn: Drawn, style: usize) -> Self {
        self.drawn = drawn;
        self.style = Some(style);
        self
    }
}

impl Panel {
    /// A panel of curves.
    pub fn new(name: &str, title: impl Into<String>, x: Axis, y: Axis, curves: Vec<Curve>) -> Self {
        Self { name: name.into(), title: title.into(), x, y, curves, ..Self::default() }
    }
}

impl Figure {
    /// Two panels in a row.
    pub fn new(title: impl Into<String>, panels: Vec<Panel>) -> Self {
        Self { title: title.into(), panels, columns: 2 }
    }

    /// The panels of these names without the title of the figure, and a single one without its own; all
    /// where no names are given.
    pub fn only(mut self, names: &[String]) -> Result<Self, FigureError> {
        if names.is_empty() {
            return Ok(self);
        }
        let mut panels: Vec<&str> = Vec::new();
        for panel in &self.panels {
            // A name may be that of a column of panels.
            if !panels.contains(&panel.name.as_str()) {
                panels.push(&panel.name);
            }
        }
        Self::check_panels(names, &panels)?;
        self.panels.retain(|panel| names.contains(&panel.name));
        self.panels.iter_mut().for_each(|panel| panel.new_row = false);
        self.title.clear();
        if let [panel] = self.panels.as_mut_slice() {
            panel.title.clear();
        }
        Ok(self)
    }

    /// Whether a figure of these panels has all that are asked for by `names`: to be checked before a long computation.
    pub fn check_panels(names: &[String], panels: &[&str]) -> Result<(), FigureError> {
        match names.iter().find(|name| !panels.contains(&name.as_str())) {
            Some(name) => {
                Err(FigureError(format!("the figure has no panel {name}: it has {}", panels.join(", "))))
            }
            None => Ok(()),
        }
    }

    /// Whether `path` has an extension that [`Figure::save`] supports: to be checked before a long
    /// computation.
    pub fn check_extension(path: &Path) -> Result<(), FigureError> {
        format(path).map(drop)
    }

    /// Draws the figure into a file, which appears whole or not at all.
    pub fn save(&self, path: &Path) -> Result<(), FigureError> {
        let written = format(path)?(&self.page()).and_then(|bytes| write_atomically(path, &bytes));
        written.map_err(|error| FigureError(format!("cannot write {}: {error}", path.display())))
    }

    /// The figure as SVG. Every panel is a group with the classes `panel` and the name of the panel.
    pub fn svg(&self) -> String {
        svg::svg(&self.page())
    }

    fn page(&self) -> Page {
        const BETWEEN: f64 = 12.0;
        const TITLE: f64 = 10.0;
        let columns = self.columns.clamp(1, self.panels.len().max(1));
        let (mut row, mut column) = (0, 0);
        let mut places = Vec::new();
        for (n, panel) in self.panels.iter().enumerate() {
            if column == columns || (panel.new_row && n > 0) {
                (row, column) = (row + 1, 0);
            }
            places.push((row, column));
            column += 1;
        }
        let top = if self.title.is_empty() { 0.0 } else { 2.0 * TITLE };
        let start = |count: usize, size: f64| count as f64 * (size + BETWEEN);
        let width = start(columns, panel::SIZE.0) - BETWEEN;
        let height = top + start(row + 1, panel::SIZE.1) - BETWEEN;
        let mut title = Group { name: "title".into(), ..Group::default() };
        let size = panel::fitting(&self.title, TITLE, width);
        title.text((0.5 * width, 1.4 * TITLE), &self.title, size, Anchor::Middle);
        let panels = self.panels.iter().zip(places).map(|(panel, (row, column))| {
            panel::draw(panel, (start(column, panel::SIZE.0), top + start(row, panel::SIZE.1)))
        });
        Page { width, height, groups: std::iter::once(title).chain(panels).collect() }
    }
}

/// The bytes of a page in one of the formats.
type Format = fn(&Page) -> io::Result<Vec<u8>>;

/// The format of the extension of `path`.
fn format(path: &Path) -> Result<Format, FigureError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("svg") => Ok(|page| Ok(svg::svg(page).into_bytes())),
        Some("png") => Ok(export::png),
        Some("pdf") => Ok(export::pdf),
        _ => {
            let rule = "the extension must be one of svg, png, pdf";
            Err(FigureError(format!("cannot draw {}: {rule}", path.display())))
        }
    }
}

#[cfg(test)]
mod tests;
