//! A sheet of panels of any kind, in rows, as a file.

use std::io::Write;
use std::path::Path;

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::figure::Figure as Drawn;

use super::draw::Medium;
use super::{Cells, Extension, FigureError, Map, PIXELS, Panel, extension};
use crate::netcdf::write_atomically;

/// Width and height of a panel, in points.
const PANEL_SIZE: (f64, f64) = (560.0, 380.0);

/// What a panel of a sheet shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawing {
    Curves(Panel),
    Map(Map),
    Cells(Cells),
}

/// Panels of curves, maps and cells, in rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Above the panels; may be empty.
    pub title: String,
    /// The panels.
    pub drawings: Vec<Drawing>,
    /// Panels in a row, at least one.
    pub columns: usize,
}

impl Sheet {
    /// Two panels in a row.
    pub fn new(title: impl Into<String>, drawings: Vec<Drawing>) -> Self {
        Self { title: title.into(), drawings, columns: 2 }
    }

    /// Draws the sheet into a file, which appears whole or not at all.
    pub fn save(&self, path: &Path) -> Result<(), FigureError> {
        let failed = |reason: String| FigureError::Write { path: path.display().to_string(), reason };
        let bytes = match extension(path)? {
            Extension::Svg => self.svg().into_bytes(),
            Extension::Png => {
                let backend = PngBackend::new().with_scale(PIXELS);
                backend.render_scene(&self.drawn(Medium::Raster).render()).map_err(failed)?
            }
        };
        write_atomically(path, |file| file.write_all(&bytes)).map_err(|error| failed(error.to_string()))
    }

    /// The sheet as SVG.
    pub fn svg(&self) -> String {
        renumbered(&SvgBackend::new().render_scene(&self.drawn(Medium::Vector).render()))
    }

    fn drawn(&self, medium: Medium) -> Drawn {
        let number = self.drawings.len();
        let columns = number.clamp(1, self.columns.max(1));
        let rows = number.div_ceil(columns).max(1);
        let draw = |drawing: &Drawing| match drawing {
            Drawing::Curves(panel) => panel.draw(medium),
            Drawing::Map(map) => map.draw(),
            Drawing::Cells(cells) => cells.draw(),
        };
        let (plots, layouts): (Vec<_>, Vec<_>) = self.drawings.iter().map(draw).unzip();
        // The last panel takes what is left of its row.
        let mut cells: Vec<Vec<usize>> = (0..number.max(1)).map(|cell| vec![cell]).collect();
        if let Some(last) = cells.last_mut() {
            last.extend(number.max(1)..rows * columns);
        }
        let mut sheet = Drawn::new(rows, columns)
            .with_structure(cells)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_cell_size(PANEL_SIZE.0, PANEL_SIZE.1)
            .with_padding(18.0)
            .with_spacing(22.0);
        if !self.title.is_empty() {
            sheet = sheet.with_title(self.title.as_str());
        }
        sheet
    }
}

/// The library numbers clipping paths through the life of the program; here they are numbered
/// through the figure, so that equal figures are equal files.
fn renumbered(svg: &str) -> String {
    const PREFIX: &str = "kuva-clip-";
    let mut known: Vec<&str> = Vec::new();
    let mut pieces = svg.split(PREFIX);
    let mut result = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let digits = piece.find(|c: char| !c.is_ascii_digit()).unwrap_or(piece.len());
        let (id, rest) = piece.split_at(digits);
        let number = known.iter().position(|k| *k == id).unwrap_or_else(|| {
            known.push(id);
            known.len() - 1
        });
        result.push_str(&format!("{PREFIX}{number}{rest}"));
    }
    result
}
