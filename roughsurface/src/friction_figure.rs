//! Predictions at a glance.

use crate::friction::{Friction, Prediction};
use crate::query::Pressing;
use tables::figure::{Axis, Curve, Figure, Panel};
use tables::law::Estimate;

/// Curves that a panel can hold and stay legible.
const MOST_CURVES: usize = 6;

const FRICTION_LABEL: &str = "friction coefficient";

/// Friction against slip rate and against pressure, along the slide, and real contact area.
pub fn figure(prediction: &Prediction) -> Figure {
    Figure {
        title: title(&prediction.law),
        panels: vec![
            over_slip_rate(prediction),
            over_pressing(
                prediction,
                "Static and sliding friction",
                FRICTION_LABEL,
                &[("", |friction| friction.sliding.mu), ("static, ", |friction| friction.mu_static)],
            ),
            along_the_slide(prediction),
            Panel {
                y: Axis::logarithmic("real area fraction"),
                ..over_pressing(
                    prediction,
                    "Real contact area",
                    "",
                    &[("", |friction| friction.sliding.area_fraction)],
                )
            },
        ],
    }
}

/// Names the law where it is short: that of a table is a sentence, and too long for the sheet.
fn title(law: &str) -> String {
    match law.len() {
        ..=24 => format!("Friction of a rough surface ({law})"),
        _ => "Friction of a rough surface".into(),
    }
}

/// Evenly spread choice of at most `most` of `count`, first and last among them.
fn chosen(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|i| i * (count - 1) / (most - 1)).collect()
}

fn values_and_errors(estimates: impl Iterator<Item = Estimate>) -> (Vec<f64>, Vec<f64>) {
    estimates.map(|estimate| (estimate.value, estimate.error)).unzip()
}

fn row_label(prediction: &Prediction, row: usize) -> String {
    match &prediction.query.pressing {
        Pressing::Pressure(values) => format!("{} Pa", short(values[row])),
        Pressing::Separation(values) => format!("{} m", short(values[row])),
    }
}

/// At most four significant digits, no more than needed.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if value == 0.0 || (1e-2..1e4).contains(&value.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

fn over_slip_rate(prediction: &Prediction) -> Panel {
    let rates = &prediction.query.slip_rates;
    let curves = chosen(prediction.friction.len(), MOST_CURVES).into_iter().map(|row| {
        let mu = prediction.friction[row].iter().map(|cell| cell.sliding.mu);
        let (y, error) = values_and_errors(mu);
        Curve::new(row_label(prediction, row), rates.clone(), y).with_error(error)
    });
    Panel {
        title: "Sliding friction".into(),
        x: Axis::logarithmic("slip rate V (m/s)"),
        y: Axis::linear(FRICTION_LABEL),
        curves: curves.collect(),
    }
}

/// Prefix of the label and value of a family of curves.
type Shown = (&'static str, fn(&Friction) -> Estimate);

fn over_pressing(prediction: &Prediction, title: &str, label: &str, shown: &[Shown]) -> Panel {
    let values = prediction.query.pressing.values();
    let x = match prediction.query.pressing {
        Pressing::Pressure(_) => Axis::logarithmic("nominal pressure (Pa)"),
        Pressing::Separation(_) => Axis::linear("separation before the slide (m)"),
    };
    let mut curves = Vec::new();
    for (prefix, value) in shown {
        for rate in chosen(prediction.query.slip_rates.len(), MOST_CURVES / shown.len()) {
            let column = prediction.friction.iter().map(|cells| value(&cells[rate]));
            let (y, error) = values_and_errors(column);
            let label = format!("{prefix}{} m/s", prediction.query.slip_rates[rate]);
            curves.push(Curve::new(label, values.to_vec(), y).with_error(error));
        }
    }
    Panel { title: title.into(), x, y: Axis::linear(label), curves }
}

fn along_the_slide(prediction: &Prediction) -> Panel {
    let rates = chosen(prediction.query.slip_rates.len(), 3);
    let rows = chosen(prediction.friction.len(), (MOST_CURVES / rates.len()).min(2));
    let mut curves = Vec::new();
    for row in rows {
        for &rate in &rates {
            let history = prediction.friction[row][rate].mu_history.iter().copied();
            let (y, error) = values_and_errors(history);
            let slip_rate = prediction.query.slip_rates[rate];
            let label = format!("{}, {slip_rate} m/s", row_label(prediction, row));
            curves.push(Curve::new(label, prediction.slip.clone(), y).with_error(error));
        }
    }
    Panel {
        title: "Along the slide".into(),
        x: Axis::logarithmic("slip s (m)"),
        y: Axis::linear(FRICTION_LABEL),
        curves,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short() {
        assert_eq!(short(1e5), "1e5");
        assert_eq!(short(1234.56), "1235");
        assert_eq!(short(-2.5e-7), "-2.5e-7");
    }

    #[test]
    fn choices_keep_both_ends() {
        assert_eq!(chosen(3, 6), [0, 1, 2]);
        assert_eq!(chosen(11, 3), [0, 5, 10]);
        assert_eq!(chosen(20, 6), [0, 3, 7, 11, 15, 19]);
    }
}
