//! Summary figures of a table.

use super::{Axis, Curve, Drawing, Figure, Map, Panel, Sheet};
use crate::interpolation::InterpolatedTable;
use crate::numbers::digits;
use crate::quantity::Quantity;
use crate::table::{Cell, Slice};

/// Curves that a panel can hold and stay legible.
const MOST_CURVES: usize = 6;

const INTERFERENCE_LABEL: &str = "interference ω₀/ω_c";
const RATE_LABEL: &str = "slip rate V (m/s)";

/// What a panel shows: title, axis, value and error of a cell, whether on a logarithmic scale.
type Shown = (&'static str, &'static str, fn(&Cell) -> (f64, f64), bool);

const SHOWN: [Shown; 3] = [
    ("Sliding friction", "friction coefficient Q/P", friction_coefficient, false),
    ("Friction stress", "friction stress Q/A (MPa)", friction_stress, false),
    ("Heating", "highest temperature (K)", temperature, false),
];

/// What a sheet of maps shows.
const MAPPED: [Shown; 4] = [
    SHOWN[0],
    SHOWN[1],
    ("Energy of stick to slip", "energy release G (J/m²)", energy_release, true),
    SHOWN[2],
];

/// Points of a map between two of the table.
const MAP_POINTS: usize = 6;

impl Slice {
    /// Friction, friction stress, energy release and temperature: a map over slip rate and
    /// interference next to curves against slip rate (or interference, where there are less than
    /// two positive slip rates, and no maps then).
    pub fn maps(&self) -> Sheet {
        let positive = self.axes().slip_rate.iter().filter(|rate| **rate > 0.0).count();
        let (table, _) = self.with_failed_cells_interpolated();
        let table = table.interpolated();
        let mut drawings = Vec::new();
        for shown in &MAPPED {
            if positive >= 2 && self.axes().interference.len() >= 2 {
                drawings.push(Drawing::Map(map(&table, shown)));
            }
            drawings.push(Drawing::Curves(match positive >= 2 {
                true => self.over_slip_rate(shown),
                false => self.over_interference(shown),
            }));
        }
        Sheet::new(self.metadata().title.clone(), drawings)
    }

    /// Sliding friction, friction stress and temperature against slip rate for a selection of
    /// interferences (against interference where there are less than two positive slip rates),
    /// and friction along the slide.
    pub fn figure(&self) -> Figure {
        let positive = self.axes().slip_rate.iter().filter(|rate| **rate > 0.0);
        let over_rate = positive.count() >= 2;
        let mut panels: Vec<Panel> = (SHOWN.iter())
            .map(|shown| match over_rate {
                true => self.over_slip_rate(shown),
                false => self.over_interference(shown),
            })
            .collect();
        panels.insert(2, self.along_the_slide());
        Figure { title: self.metadata().title.clone(), panels }
    }

    fn over_slip_rate(&self, (title, label, value, log): &Shown) -> Panel {
        let axes = self.axes();
        let curve = |i: usize| {
            let at = |j: usize| self.cell(i, j).map_or((f64::NAN, f64::NAN), value);
            let points = (0..axes.slip_rate.len()).map(at);
            let (y, error) = points.unzip();
            let label = format!("{} ω_c", digits(axes.interference[i], 3));
            Curve::new(label, axes.slip_rate.clone(), y).with_error(error)
        };
        Panel {
            title: title.to_string(),
            x: Axis::logarithmic(RATE_LABEL),
            y: Axis { label: label.to_string(), log: *log },
            curves: selection(axes.interference.len()).map(curve).collect(),
        }
    }

    fn over_interference(&self, (title, label, value, log): &Shown) -> Panel {
        let axes = self.axes();
        let curve = |j: usize| {
            let at = |i: usize| self.cell(i, j).map_or((f64::NAN, f64::NAN), value);
            let points = (0..axes.interference.len()).map(at);
            let (y, error) = points.unzip();
            let label = rate_label(axes.slip_rate[j]);
            Curve::new(label, axes.interference.clone(), y).with_error(error)
        };
        Panel {
            title: title.to_string(),
            x: Axis::logarithmic(INTERFERENCE_LABEL),
            y: Axis { label: label.to_string(), log: *log },
            curves: selection(axes.slip_rate.len()).map(curve).collect(),
        }
    }

    /// Friction against slip at the middle interference, a curve for each slip rate.
    fn along_the_slide(&self) -> Panel {
        let axes = self.axes();
        let middle = axes.interference.len() / 2;
        let curve = |j: usize| {
            let history = |cell: &Cell| cell.history(Quantity::Mu).to_vec();
            let y = self.cell(middle, j).map(history).unwrap_or_default();
            Curve::new(rate_label(axes.slip_rate[j]), axes.slip.clone(), y)
        };
        Panel {
            title: format!("Along the slide, {} ω_c", digits(axes.interference[middle], 3)),
            x: Axis::linear("slip s/a₀"),
            y: Axis::linear("friction coefficient Q/P"),
            curves: selection(axes.slip_rate.len()).map(curve).collect(),
        }
    }
}

/// A quantity over slip rate and interference.
fn map(table: &InterpolatedTable, (title, label, value, log): &Shown) -> Map {
    let axes = table.axes();
    let rates: Vec<f64> = axes.slip_rate.iter().copied().filter(|rate| *rate > 0.0).collect();
    let (x_values, y_values) = (between(&rates), between(&axes.interference));
    let at = |omega: f64, rate: f64| {
        let mut cell = Cell::new();
        for quantity in Quantity::SCALARS {
            if let Ok(known) = table.estimate(quantity, table.metadata().asperity_radius, omega, rate) {
                cell[quantity] = known;
            }
        }
        if *log { value(&cell).0.log10() } else { value(&cell).0 }
    };
    let row = |omega: &f64| x_values.iter().map(|rate| at(*omega, *rate)).collect();
    Map {
        title: title.to_string(),
        label: if *log { format!("log₁₀ of {label}") } else { label.to_string() },
        x: Axis::logarithmic(RATE_LABEL),
        y: Axis::logarithmic(INTERFERENCE_LABEL),
        values: y_values.iter().map(row).collect(),
        x_values,
        y_values,
    }
}

/// Positive points with [`MAP_POINTS`] − 1 between each two, evenly in the logarithm.
fn between(points: &[f64]) -> Vec<f64> {
    let step = |pair: &[f64], n: usize| pair[0] * (pair[1] / pair[0]).powf(n as f64 / MAP_POINTS as f64);
    let mut all: Vec<f64> =
        points.windows(2).flat_map(|pair| (0..MAP_POINTS).map(move |n| step(pair, n))).collect();
    all.extend(points.last());
    all
}

/// At most [`MOST_CURVES`] of the given number of curves, including the first and the last.
fn selection(number: usize) -> impl Iterator<Item = usize> {
    let shown = number.min(MOST_CURVES);
    let last = number.saturating_sub(1);
    (0..shown).map(move |n| match shown {
        1 => 0,
        _ => (n * last + (shown - 1) / 2) / (shown - 1),
    })
}

fn rate_label(rate: f64) -> String {
    match rate {
        0.0 => "isothermal".to_string(),
        rate => format!("{} m/s", digits(rate, 3)),
    }
}

fn friction_coefficient(cell: &Cell) -> (f64, f64) {
    let estimate = cell[Quantity::Mu];
    (estimate.value, estimate.error)
}

fn friction_stress(cell: &Cell) -> (f64, f64) {
    let (force, area) = (cell[Quantity::Friction], cell[Quantity::Area]);
    let stress = 1e-6 * force.value / area.value;
    let relative = (force.error / force.value).abs() + (area.error / area.value).abs();
    (stress, stress * relative)
}

fn energy_release(cell: &Cell) -> (f64, f64) {
    let estimate = cell[Quantity::EnergyRelease];
    (estimate.value, estimate.error)
}

fn temperature(cell: &Cell) -> (f64, f64) {
    let estimate = cell[Quantity::TemperatureMax];
    (estimate.value, estimate.error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selection_spans_the_axis() {
        let chosen = |number| selection(number).collect::<Vec<_>>();
        assert_eq!(chosen(0), [0; 0]);
        assert_eq!(chosen(1), [0]);
        assert_eq!(chosen(4), [0, 1, 2, 3]);
        assert_eq!(chosen(12), [0, 2, 4, 7, 9, 11]);
    }

    #[test]
    fn legends_are_short() {
        assert_eq!(rate_label(0.123456), "0.123 m/s");
        assert_eq!(rate_label(0.0), "isothermal");
    }
}
