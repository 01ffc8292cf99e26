//! Figure of a table.

use super::{Axis, Colors, Curve, Field, Figure, Panel};
use crate::interpolation::InterpolatedTable;
use crate::numbers::digits;
use crate::quantity::{Estimate, Quantity};
use crate::table::{Axes, Cell, Slice};

/// Curves that a panel can hold and stay legible.
const MOST_CURVES: usize = 6;

const INTERFERENCE_LABEL: &str = "Interference ω_{0}/ω_{c}";
const RATE_LABEL: &str = "Slip rate V (m/s)";
const FRICTION_LABEL: &str = "Friction coefficient μ = Q/P";

/// Names of the panels.
pub const PANELS: [&str; 9] = [
    "friction",
    "stress",
    "energy",
    "temperature",
    "slide",
    "friction-map",
    "stress-map",
    "energy-map",
    "temperature-map",
];

/// End of the names of maps.
const MAP: &str = "-map";

/// The panels of a table by its number of interferences and its slip rates (m/s).
pub fn panels(interferences: usize, slip_rates: &[f64]) -> Vec<&'static str> {
    let has_maps = is_mapped(interferences, slip_rates);
    PANELS.into_iter().filter(|name| has_maps || !name.ends_with(MAP)).collect()
}

/// Whether both axes have an extent, of the slip rates on a logarithmic scale.
fn is_mapped(interferences: usize, slip_rates: &[f64]) -> bool {
    interferences >= 2 && positive(slip_rates) >= 2
}

fn positive(slip_rates: &[f64]) -> usize {
    slip_rates.iter().filter(|rate| **rate > 0.0).count()
}

/// What a panel shows.
struct Shown {
    /// Name of the panel with the curves; that of the map adds [`MAP`].
    name: &'static str,
    title: &'static str,
    label: &'static str,
    /// Value and error of a cell.
    value: fn(&Cell) -> Estimate,
    log: bool,
}

const SHOWN: [Shown; 4] = [
    Shown {
        name: "friction",
        title: "Sliding friction",
        label: FRICTION_LABEL,
        value: |cell| cell[Quantity::Mu],
        log: false,
    },
    Shown {
        name: "stress",
        title: "Friction stress",
        label: "Friction stress Q/A (MPa)",
        value: |cell| cell[Quantity::Friction].over(cell[Quantity::Area]).scaled(1e-6),
        log: false,
    },
    Shown {
        name: "energy",
        title: "Energy of stick to slip",
        label: "Energy release G (J/m^{2})",
        value: |cell| cell[Quantity::EnergyRelease],
        log: true,
    },
    Shown {
        name: "temperature",
        title: "Heating",
        label: "Highest temperature T (K)",
        value: |cell| cell[Quantity::TemperatureMax],
        log: false,
    },
];

/// Points of a map between two of the table.
const MAP_POINTS: usize = 6;

impl Slice {
    /// Friction, friction stress, energy release and temperature: a map over slip rate and
    /// interference next to curves against slip rate (or interference, where there are less than
    /// two positive slip rates, and no maps then); friction along the slide.
    pub fn figure(&self) -> Figure {
        let axes = self.axes();
        let mapped = is_mapped(axes.interference.len(), &axes.slip_rate);
        let (table, _) = self.with_failed_cells_interpolated();
        let table = table.interpolated();
        let mut panels = Vec::new();
        for shown in &SHOWN {
            if mapped {
                panels.push(map(&table, axes, shown));
            }
            panels.push(self.over(positive(&axes.slip_rate) >= 2, shown));
        }
        panels.push(self.along_the_slide());
        Figure::new(self.metadata().title.replace("omega_c", "ω_{c}"), panels)
    }

    /// A quantity along one axis, a curve for each point of the other.
    fn over(&self, slip_rate: bool, shown: &Shown) -> Panel {
        let axes = self.axes();
        let (label, x, curves) = match slip_rate {
            true => (RATE_LABEL, &axes.slip_rate, axes.interference.len()),
            false => (INTERFERENCE_LABEL, &axes.interference, axes.slip_rate.len()),
        };
        let curve = |n: usize| {
            let cell = |m: usize| if slip_rate { self.cell(n, m) } else { self.cell(m, n) };
            let at = |m: usize| cell(m).map_or(Estimate::UNKNOWN, shown.value);
            let name = match slip_rate {
                true => interference_label(axes.interference[n]),
                false => rate_label(axes.slip_rate[n]),
            };
            Curve::with_errors(name, x.clone(), (0..x.len()).map(at))
        };
        let y = Axis { log: shown.log, ..Axis::linear(shown.label) };
        let curves = selection(curves).map(curve).collect();
        Panel::new(shown.name, shown.title, Axis::logarithmic(label), y, curves)
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
        let title = format!("Along the slide, {}", interference_label(axes.interference[middle]));
        let (x, y) = (Axis::logarithmic("Slip s/a_{0}"), Axis::linear(FRICTION_LABEL));
        Panel::new("slide", title, x, y, selection(axes.slip_rate.len()).map(curve).collect())
    }
}

/// A quantity over slip rate and interference.
fn map(table: &InterpolatedTable, axes: &Axes, shown: &Shown) -> Panel {
    let rates: Vec<f64> = axes.slip_rate.iter().copied().filter(|rate| *rate > 0.0).collect();
    let (rates, interferences) = (between(&rates), between(&axes.interference));
    let at = |omega: f64, rate: f64| {
        let mut cell = Cell::new();
        for quantity in Quantity::SCALARS {
            if let Ok(known) = table.estimate(quantity, table.metadata().asperity_radius, omega, rate) {
                cell[quantity] = known;
            }
        }
        let value = (shown.value)(&cell).value;
        [rate, omega, if shown.log { value.log10() } else { value }]
    };
    let rows: Vec<Vec<[f64; 3]>> =
        interferences.iter().map(|omega| rates.iter().map(|rate| at(*omega, *rate)).collect()).collect();
    let values = || rows.iter().flatten().map(|corner| corner[2]).filter(|value| value.is_finite());
    let label = if shown.log { format!("log_{{10}} {}", shown.label) } else { shown.label.to_string() };
    let colors = Colors::Bands {
        label,
        from: values().fold(f64::INFINITY, f64::min),
        to: values().fold(f64::NEG_INFINITY, f64::max),
    };
    let ends = |values: &[f64]| (values[0], values[values.len() - 1]);
    let axis = |label: &str, (from, to)| Axis::logarithmic(label).between(from, to);
    Panel {
        field: Some(Field { cells: Field::quadrilaterals(&rows), colors, arrow: None }),
        ..Panel::new(
            &format!("{}{MAP}", shown.name),
            shown.title,
            axis(RATE_LABEL, ends(&rates)),
            axis(INTERFERENCE_LABEL, ends(&interferences)),
            Vec::new(),
        )
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

/// Numbers of at most [`MOST_CURVES`] of the given number of curves, including the first and the last.
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

fn interference_label(interference: f64) -> String {
    format!("{} ω_{{c}}", digits(interference, 3))
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
