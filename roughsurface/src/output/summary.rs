//! Predictions for people (a table of text) and for programs (JSON).

use crate::friction::regime::regime;
use crate::friction::{Friction, Prediction};
use crate::sampling::uncertainty::{OUTPUTS, Propagated};
use crate::surface::query::Pressing;
use serde_json::{Value, json};
use std::fmt::Write;
use tables::law::Estimate;

/// The value with as many digits as its error allows, at most four significant
/// ones, and the error with two.
pub fn with_error(estimate: Estimate) -> String {
    let Estimate { value, error } = estimate;
    if !value.is_finite() {
        return "-".into();
    }
    let magnitude = value.abs().max(error.min(1e300)).log10().floor();
    if value != 0.0 && !(-3.0..5.0).contains(&magnitude) {
        return format!("{value:.3e} ±{error:.0e}");
    }
    let of_error = if error > 0.0 && error.is_finite() { 1.0 - error.log10().floor() } else { f64::INFINITY };
    let digits = of_error.min(3.0 - magnitude.max(-3.0)).clamp(0.0, 6.0) as usize;
    let shown = format!("{error:.digits$}");
    // An error that would be shown as zero is shown by its size.
    if error > 0.0 && shown.bytes().all(|byte| matches!(byte, b'0' | b'.')) {
        format!("{value:.digits$} ±{error:.0e}")
    } else {
        format!("{value:.digits$} ±{shown}")
    }
}

type Column = (&'static str, fn(&Friction) -> String);

const COLUMNS: [Column; 8] = [
    ("mu_static", |f| with_error(f.mu_static)),
    ("mu", |f| with_error(f.sliding.mu)),
    ("Q [Pa]", |f| format!("{:.3e}", f.sliding.shear.value)),
    ("G [J/m2]", |f| f.energy_release.map_or("-".into(), |energy| format!("{:.3e}", energy.value))),
    ("G_weakening", |f| format!("{:.3e}", f.weakening_energy.value)),
    ("area fraction", |f| format!("{:.3e}", f.sliding.area_fraction.value)),
    ("separation [m]", |f| format!("{:.3e}", f.pressed.separation.value)),
    ("outside table", |f| {
        if f.outside_table < 5e-5 { "-".into() } else { format!("{:.2} %", 100.0 * f.outside_table) }
    }),
];

/// What stands above pressures or separations.
pub(crate) fn row_head(pressing: &Pressing) -> &'static str {
    match pressing {
        Pressing::Pressure(_) => "pressure [Pa]",
        Pressing::Separation(_) => "at rest [m]",
    }
}

/// What pressures or separations are called in JSON.
pub(crate) fn row_key(pressing: &Pressing) -> &'static str {
    match pressing {
        Pressing::Pressure(_) => "pressure",
        Pressing::Separation(_) => "separation_at_rest",
    }
}

/// The prediction as lines of text.
pub fn text(prediction: &Prediction) -> String {
    let row_head = row_head(&prediction.query.pressing);
    let mut rows = vec![vec![row_head.to_string(), "slip rate [m/s]".to_string()]];
    rows[0].extend(COLUMNS.iter().map(|(head, _)| head.to_string()));
    let pressing = prediction.query.pressing.values();
    for (value, cells) in pressing.iter().zip(&prediction.friction) {
        for (rate, cell) in prediction.query.slip_rates.iter().zip(cells) {
            let mut row = vec![format!("{value:.3e}"), format!("{rate}")];
            row.extend(COLUMNS.iter().map(|(_, show)| show(cell)));
            rows.push(row);
        }
    }
    let mut text = format!(
        "Plasticity index {:.3}: {}\n\n",
        prediction.plasticity_index,
        regime(prediction.plasticity_index)
    );
    text.push_str(&aligned(&rows));
    if let Some(propagated) = &prediction.propagated {
        text.push_str(&parameters(prediction, propagated));
    }
    if !prediction.comparisons.is_empty() {
        text.push_str("\nWith asperities after models of the literature:\n");
        let head = [row_head, "model", "mu_static", "mu", "area fraction"].map(String::from);
        let mut rows = vec![head.to_vec()];
        for (row, value) in pressing.iter().enumerate() {
            for comparison in &prediction.comparisons {
                let cell = &comparison.friction[row];
                rows.push(vec![
                    format!("{value:.3e}"),
                    comparison.model.clone(),
                    format!("{:.4}", cell.mu_static.value),
                    format!("{:.4}", cell.sliding.mu.value),
                    format!("{:.3e}", cell.sliding.area_fraction.value),
                ]);
            }
        }
        text.push_str(&aligned(&rows));
    }
    if prediction.query.slip_rates.len() > 1 {
        text.push('\n');
        text.push_str("Flash heating, mu = mu_w + (mu_0 - mu_w)/[1 + (V/V_w)^8]^(1/8):\n");
        let mut rows = vec![[row_head, "mu_0", "mu_w", "V_w [m/s]", "R2"].map(String::from).to_vec()];
        for (value, fit) in pressing.iter().zip(&prediction.flash_heating) {
            let mut row = vec![format!("{value:.3e}")];
            match fit {
                Ok(fit) => {
                    row.extend([fit.mu_0, fit.mu_w, fit.v_w].map(with_error));
                    row.push(format!("{:.4}", fit.r_squared));
                }
                Err(reason) => row.push(format!("not fitted: {reason}")),
            }
            rows.push(row);
        }
        text.push_str(&aligned(&rows));
    }
    text
}

/// Standard deviations from uncertain parameters, and the parameter that matters most.
fn parameters(prediction: &Prediction, propagated: &Propagated) -> String {
    let mut rows = vec![vec![row_head(&prediction.query.pressing).to_string(), "slip rate [m/s]".into()]];
    rows[0].extend(OUTPUTS.iter().map(|output| output.name.to_string()));
    rows[0].push("mu most by".into());
    let mut cell = 0;
    for value in prediction.query.pressing.values() {
        for rate in &prediction.query.slip_rates {
            let mut row = vec![format!("{value:.3e}"), format!("{rate}")];
            row.extend((0..OUTPUTS.len()).map(|output| format!("{:.1e}", propagated.std(cell, output))));
            let changes = propagated.contributions[cell][0].iter().zip(&propagated.parameters);
            let most = changes.max_by(|one, other| one.0.abs().total_cmp(&other.0.abs()));
            row.push(most.map_or("-", |(_, uncertain)| uncertain.key.as_str()).to_string());
            rows.push(row);
            cell += 1;
        }
    }
    format!("\nStandard deviations from uncertain parameters:\n{}", aligned(&rows))
}

/// Columns as wide as their widest cell, numbers to the right.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows[0].len();
    let width = |column: usize| {
        // A remark in place of numbers may run over the columns to its right.
        let complete = rows.iter().filter(|row| row.len() == columns);
        let cells = complete.map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let gap = if column == 0 { "" } else { "   " };
            let width = width(column);
            if row.len() < columns && column == row.len() - 1 {
                let _ = write!(line, "{gap}{cell}");
            } else {
                let _ = write!(line, "{gap}{cell:>width$}");
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// The prediction as JSON: the same numbers as in the file, without histories.
pub fn json(prediction: &Prediction) -> Value {
    let row = row_key(&prediction.query.pressing);
    let pressing = prediction.query.pressing.values();
    let mut cells = Vec::new();
    for (value, friction) in pressing.iter().zip(&prediction.friction) {
        for (rate, cell) in prediction.query.slip_rates.iter().zip(friction) {
            cells.push(json!({
                row: value,
                "slip_rate": rate,
                "mu_static": cell.mu_static,
                "inception_slip": cell.inception_slip.value,
                "inception_slip_error": cell.inception_slip.error,
                "mu": cell.sliding.mu,
                "Q": cell.sliding.shear,
                "G": cell.energy_release,
                "G_weakening": cell.weakening_energy,
                "G_real_area": cell.release_of_real_area(),
                "G_weakening_real_area": cell.weakening_of_real_area(),
                "weakening_distance": cell.weakening_distance,
                "dmu_dlnV": cell.rate_sensitivity,
                "contacts": cell.shares,
                "pressure_sliding": cell.sliding.pressure,
                "separation": cell.pressed.separation,
                "separation_sliding": cell.sliding.separation,
                "real_area_fraction": cell.sliding.area_fraction,
                "contact_density": cell.sliding.contact_density,
                "outside_table_fraction": cell.outside_table,
            }));
        }
    }
    let fits: Vec<Value> = pressing
        .iter()
        .zip(&prediction.flash_heating)
        .map(|(value, fit)| match fit {
            Ok(fit) => json!({
                row: value,
                "mu_0": fit.mu_0,
                "mu_w": fit.mu_w,
                "V_w": fit.v_w,
                "rms": fit.misfit,
                "r_squared": fit.r_squared,
            }),
            Err(reason) => json!({row: value, "not_fitted": reason.to_string()}),
        })
        .collect();
    if let Some(propagated) = &prediction.propagated {
        for (index, cell) in cells.iter_mut().enumerate() {
            let stds = OUTPUTS
                .iter()
                .enumerate()
                .map(|(output, line)| (line.name.to_string(), Value::from(propagated.std(index, output))));
            cell["parameter_std"] = Value::Object(stds.collect());
        }
    }
    let comparisons: Vec<Value> = prediction
        .comparisons
        .iter()
        .flat_map(|comparison| {
            pressing.iter().zip(&comparison.friction).map(move |(value, cell)| {
                json!({
                    "model": comparison.model,
                    row: value,
                    "mu_static": cell.mu_static,
                    "mu": cell.sliding.mu,
                    "real_area_fraction": cell.sliding.area_fraction,
                })
            })
        })
        .collect();
    json!({
        "law": prediction.law,
        "hold": prediction.query.hold,
        "plasticity_index": prediction.plasticity_index,
        "regime": regime(prediction.plasticity_index),
        "friction": cells,
        "comparisons": comparisons,
        "flash_heating": fits,
        "warnings": prediction.warnings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_error() {
        let show = |value, error| with_error(Estimate { value, error });
        assert_eq!(show(0.403912, 0.0081), "0.4039 ±0.0081");
        assert_eq!(show(0.403912, 0.08), "0.404 ±0.080");
        assert_eq!(show(0.403912, 1e-9), "0.4039 ±1e-9");
        assert_eq!(show(0.403912, 0.0), "0.4039 ±0.0000");
        assert_eq!(show(1.23456e7, 2e5), "1.235e7 ±2e5");
        assert_eq!(show(f64::NAN, 0.0), "-");
        assert_eq!(show(0.0, 0.0), "0.000000 ±0.000000");
    }

    #[test]
    fn columns_line_up() {
        let row = |cells: &[&str]| cells.iter().map(|cell| cell.to_string()).collect();
        let text = aligned(&[row(&["a", "bbb"]), row(&["cc", "d"])]);
        assert_eq!(text, " a   bbb\ncc     d\n");
    }
}
