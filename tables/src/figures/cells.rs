//! A quantity over a plane, cell by cell: shades with their scale, or a few named classes.
//!
//! Shades grow darker evenly from low to high, so that they are distinct in grey as well.

use kuva::plot::colormap::ColorMap;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::plot::{ContourPlot, LegendPosition, LinePlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use super::Axis;
use super::draw::styled;
use super::map::dark_for_high;

/// Cells of a plane with a value each. A length is as long on one axis as on the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// Above the panel.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Ends of both axes, which are linear.
    pub x_range: (f64, f64),
    /// Ends of the vertical axis.
    pub y_range: (f64, f64),
    /// Polygons with their values.
    pub cells: Vec<Cell>,
    /// Colour scale.
    pub scale: Scale,
}

/// A polygon and its value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// Corners (x, y) of the polygon.
    pub corners: Vec<(f64, f64)>,
    /// Not drawn if it is not finite.
    pub value: f64,
}

/// Meaning of the values.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Shades between two values; the label, with the unit, is next to the scale.
    Shades { label: String, from: f64, to: f64 },
    /// The value is the place of a name in this list; shades go from light to dark.
    Classes(Vec<String>),
}

impl Default for Scale {
    fn default() -> Self {
        Self::Classes(Vec::new())
    }
}

/// Of a cell's outline in its own colour, so that no background shows between cells.
const SEAM: f64 = 1.5;

impl Cells {
    pub(super) fn draw(&self) -> (Vec<Plot>, Layout) {
        let colors = dark_for_high();
        let drawn = self.cells.iter().filter(|cell| cell.value.is_finite() && cell.corners.len() > 2);
        let mut plots: Vec<Plot> =
            drawn.map(|cell| polygon(cell, colors.map(self.shade(cell.value)))).collect();
        if let Scale::Shades { label, from, to } = &self.scale
            && from < to
        {
            plots.push(scale(label, *from, *to, colors.clone()));
        }
        let mut layout = styled(Layout::auto_from_plots(&plots), &self.title, &self.x, &self.y)
            .with_x_axis_min(self.x_range.0)
            .with_x_axis_max(self.x_range.1)
            .with_y_axis_min(self.y_range.0)
            .with_y_axis_max(self.y_range.1)
            .with_clamp_axis()
            .with_equal_aspect();
        if let Scale::Classes(names) = &self.scale {
            let entry = |(n, name): (usize, &String)| LegendEntry {
                label: name.clone(),
                color: colors.map(self.shade(n as f64)),
                shape: LegendShape::Rect,
                dasharray: None,
            };
            layout = layout
                .with_legend_entries(names.iter().enumerate().map(entry).collect())
                .with_legend_position(LegendPosition::OutsideRightTop)
                .with_legend_box(false);
        }
        (plots, layout)
    }

    /// Position of a value on the scale, 0 to 1.
    fn shade(&self, value: f64) -> f64 {
        let (from, to) = match &self.scale {
            Scale::Shades { from, to, .. } => (*from, *to),
            Scale::Classes(names) => (0.0, names.len().saturating_sub(1) as f64),
        };
        if from < to { ((value - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

fn polygon(cell: &Cell, color: String) -> Plot {
    let closed = cell.corners.iter().chain(cell.corners.first()).copied();
    let line = LinePlot::new().with_data(closed).with_color(color).with_stroke_width(SEAM);
    Plot::Line(line.with_fill().with_fill_opacity(1.0))
}

/// A plot of the scale of shades only: a contour map without levels.
fn scale(label: &str, from: f64, to: f64, colors: ColorMap) -> Plot {
    let plot = ContourPlot::new()
        .with_grid(vec![vec![from, to]; 2], vec![0.0, 1.0], vec![0.0, 1.0])
        .with_n_levels(0)
        .with_filled()
        .with_colormap(colors)
        .with_legend(label);
    Plot::Contour(plot)
}

#[cfg(test)]
mod tests {
    use super::super::{Drawing, Sheet};
    use super::*;

    fn cells(scale: Scale) -> Cells {
        let square = |n: usize| {
            let x = n as f64;
            Cell { corners: vec![(x, 0.0), (x + 1.0, 0.0), (x + 1.0, 1.0), (x, 1.0)], value: x }
        };
        Cells {
            title: "a title".into(),
            x: Axis::linear("x"),
            y: Axis::linear("y"),
            x_range: (0.0, 3.0),
            y_range: (0.0, 3.0),
            cells: (0..3).map(square).collect(),
            scale,
        }
    }

    fn svg(cells: Cells) -> String {
        Sheet { drawings: vec![Drawing::Cells(cells)], ..Sheet::default() }.svg()
    }

    #[test]
    fn shades_go_from_light_to_dark_and_have_their_scale() {
        let map = cells(Scale::Shades { label: "pressure (GPa)".into(), from: 0.0, to: 2.0 });
        let colors = dark_for_high();
        for value in 0..3 {
            let shade = colors.map(map.shade(f64::from(value)));
            assert!(svg(map.clone()).contains(&shade), "{shade}");
        }
        assert!(svg(map).contains("pressure (GPa)"));
    }

    #[test]
    fn classes_have_their_names_and_what_is_not_finite_is_left_out() {
        let mut map = cells(Scale::Classes(["open", "sticks", "slips"].map(String::from).to_vec()));
        let with_all = svg(map.clone());
        for name in ["open", "sticks", "slips"] {
            assert!(with_all.contains(name), "{name}");
        }
        map.cells[1].value = f64::NAN;
        assert!(svg(map).len() < with_all.len());
    }

    #[test]
    fn a_single_value_needs_no_scale() {
        let map = cells(Scale::Shades { label: "temperature (K)".into(), from: 298.0, to: 298.0 });
        assert!(!svg(map).contains("temperature (K)"));
    }
}
