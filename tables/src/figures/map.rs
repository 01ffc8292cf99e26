//! A quantity over two axes, as bands of equal shade between black lines.
//!
//! The shades grow darker evenly from low to high, so that they are distinct in grey as well.

use kuva::plot::ContourPlot;
use kuva::plot::colormap::ColorMap;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

use super::Axis;
use super::draw::{axes, styled};

/// Values over a product of two axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Map {
    /// Above the panel.
    pub title: String,
    /// Of the values, with the unit; next to the scale of shades.
    pub label: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Rising coordinates, at least two on each axis.
    pub x_values: Vec<f64>,
    /// Rising coordinates of the rows.
    pub y_values: Vec<f64>,
    /// `values[row][column]` at `y_values[row]` and `x_values[column]`; NaN where unknown.
    pub values: Vec<Vec<f64>>,
}

/// Lines to aim at.
const LINES: f64 = 8.0;

impl Map {
    pub(super) fn draw(&self) -> (Vec<Plot>, Layout) {
        let known = || self.values.iter().flatten().copied().filter(|value| value.is_finite());
        let (from, to) = (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
        let plot = |filled: bool| {
            let plot = ContourPlot::new()
                .with_grid(self.values.clone(), self.x_values.clone(), self.y_values.clone())
                .with_levels(&levels(from, to))
                .with_colormap(dark_for_high());
            match filled {
                true => plot.with_filled().with_legend(self.label.as_str()),
                false => plot.with_line_color("#000000").with_line_width(0.8),
            }
        };
        let drawable = from < to && self.x_values.len() > 1 && self.y_values.len() > 1;
        let plots = match drawable {
            true => vec![Plot::Contour(plot(true)), Plot::Contour(plot(false))],
            false => Vec::new(),
        };
        let layout = styled(Layout::auto_from_plots(&plots), &self.title, &self.x, &self.y);
        let ends = |values: &[f64]| match values {
            [first, .., last] => (*first, *last),
            _ => (0.1, 10.0),
        };
        (plots, axes(layout, (&self.x, ends(&self.x_values)), (&self.y, ends(&self.y_values))))
    }
}

pub(super) fn dark_for_high() -> ColorMap {
    ColorMap::Custom(std::sync::Arc::new(|share: f64| {
        // Of Cividis, which is even in lightness for all kinds of sight, without its darkest part:
        // black lines must stand out.
        ColorMap::Cividis.map(1.0 - 0.75 * share.clamp(0.0, 1.0))
    }))
}

/// Round values between two: 1, 2 or 5 times a power of ten apart.
fn levels(from: f64, to: f64) -> Vec<f64> {
    let aim = (to - from) / LINES;
    if !(aim > 0.0 && aim.is_finite()) {
        return Vec::new();
    }
    let power = 10f64.powf(aim.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|digit| digit * power).find(|step| *step >= aim);
    let step = step.unwrap_or(aim);
    let (first, last) = ((from / step).floor() as i64 + 1, (to / step).ceil() as i64 - 1);
    (first..=last).map(|n| n as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_round_and_inside() {
        assert_eq!(levels(0.0, 8.0), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        assert_eq!(levels(290.0, 1510.0), [400.0, 600.0, 800.0, 1000.0, 1200.0, 1400.0]);
        assert_eq!(levels(1.0, 1.0), []);
    }

    #[test]
    fn a_map_is_drawn_with_its_scale_and_one_without_values_is_empty() {
        let values = (0..5).map(|i| (0..4).map(|j| f64::from(i * j)).collect()).collect();
        let map = Map {
            title: "heat".into(),
            label: "temperature (K)".into(),
            x: Axis::logarithmic("V (m/s)"),
            y: Axis::logarithmic("ω"),
            x_values: vec![0.1, 1.0, 10.0, 100.0],
            y_values: vec![1.0, 2.0, 4.0, 8.0, 16.0],
            values,
        };
        let svg = |map: &Map| {
            let drawings = vec![super::super::Drawing::Map(map.clone())];
            super::super::Sheet { drawings, ..Default::default() }.svg()
        };
        assert!(svg(&map).contains("temperature (K)"));
        let flat = Map { values: vec![vec![1.0; 4]; 5], ..map };
        assert!(!svg(&flat).contains("temperature (K)"));
    }
}
