//! The formats as text. SI units and kelvin.

use super::{FittedLaw, FrictionTable, Layer};
use crate::friction::rate_law::RateLaw;
use serde_json::{Value, json};
use std::fmt::Write;

/// Columns or axes, and lines of the origin, each after `mark`.
fn head(table: &FrictionTable, mark: &str, lines: &[&str]) -> String {
    let mut text = format!(
        "{mark} Friction coefficient of a rough surface, roughsurface {}\n",
        env!("CARGO_PKG_VERSION")
    );
    let _ = writeln!(text, "{mark} from {}", table.sources().join(", "));
    lines.iter().for_each(|line| text.push_str(&format!("{mark} {line}\n")));
    table.warnings().iter().for_each(|warning| add_warning(&mut text, mark, warning));
    text
}

/// Adds a warning in comment lines that are not too long for Abaqus.
fn add_warning(text: &mut String, mark: &str, warning: &str) {
    const LONGEST: usize = 200;
    let mut line = format!("{mark} Warning:");
    for word in warning.split(' ') {
        if line.len() + word.len() > LONGEST {
            text.push_str(&format!("{line}\n"));
            line = format!("{mark}  ");
        }
        line.push_str(&format!(" {word}"));
    }
    text.push_str(&format!("{line}\n"));
}

impl FrictionTable {
    /// Layer, pressure, its row, slip rate and cell of every value; slip rates vary fastest.
    fn cells(&self) -> impl Iterator<Item = (&Layer, f64, f64, usize)> {
        let rates = self.slip_rates.len();
        let cells = 0..self.pressures.len() * rates;
        self.layers.iter().flat_map(move |layer| {
            cells
                .clone()
                .map(move |cell| (layer, self.pressures[cell / rates], self.slip_rates[cell % rates], cell))
        })
    }
}

/// Data lines of `*FRICTION`: coefficient, slip rate, contact pressure, average temperature.
pub(super) fn abaqus(table: &FrictionTable) -> String {
    let mut text = head(
        table,
        "**",
        &[
            "Friction coefficient (1), slip rate (m/s), contact pressure (Pa), and temperature (K) if there is one: SI units",
            "Below *SURFACE INTERACTION; Abaqus holds the values constant outside the table",
        ],
    );
    for layer in &table.layers {
        for (law, pressure) in layer.laws.iter().zip(&table.pressures) {
            let kelvin = layer.temperature.map_or(String::new(), |kelvin| format!(", {kelvin} K"));
            let _ = write!(text, "** Rate law at {pressure:e} Pa{kelvin}: ");
            let (law, limitation) = match law {
                Ok(fitted) => fitted,
                Err(reason) => {
                    let _ = writeln!(text, "none; {reason}");
                    continue;
                }
            };
            let RateLaw { form, mu_0, plateau, velocity, exponent, .. } = law;
            let _ = writeln!(
                text,
                "{}, mu_0 = {:.5}, mu_inf = {:.5}, V* = {:.4e} m/s, n = {:.4}",
                form.formula, mu_0.value, plateau.value, velocity.value, exponent.value
            );
            if !limitation.is_empty() {
                let _ = writeln!(text, "** not reliable: {limitation}");
            }
        }
    }
    text.push_str("*FRICTION\n");
    for (layer, pressure, rate, cell) in table.cells() {
        let temperature = layer.temperature.map_or(String::new(), |kelvin| format!(", {kelvin:.9e}"));
        let _ = writeln!(text, "{:.9e}, {rate:.9e}, {pressure:.9e}{temperature}", layer.mu[cell].value);
    }
    text
}

/// Axes of the slip rate, the pressure and, of several, the temperature, then a line for each pressure.
pub(super) fn comsol(table: &FrictionTable) -> String {
    let row = |values: &[f64]| {
        format!("{}\n", values.iter().map(|value| format!("{value:.9e}")).collect::<Vec<_>>().join(" "))
    };
    let mut text = head(
        table,
        "%",
        &["Arguments: slip rate (m/s), pressure (Pa), and temperature (K) if there are several"],
    );
    text.push_str("% Grid\n");
    text.push_str(&row(&table.slip_rates));
    text.push_str(&row(&table.pressures));
    if table.layers.len() > 1 {
        text.push_str(&row(&table.layers.iter().filter_map(|layer| layer.temperature).collect::<Vec<_>>()));
    }
    text.push_str("% Data\n");
    for layer in &table.layers {
        let values: Vec<f64> = layer.mu.iter().map(|mu| mu.value).collect();
        values.chunks(table.slip_rates.len()).for_each(|pressure| text.push_str(&row(pressure)));
    }
    text
}

/// One line for each temperature, pressure and slip rate.
pub(super) fn csv(table: &FrictionTable) -> String {
    let mut text = String::from("temperature_K,pressure_Pa,slip_rate_m_per_s,mu,mu_error\n");
    for (layer, pressure, rate, cell) in table.cells() {
        let temperature = layer.temperature.map_or("NaN".into(), |kelvin| kelvin.to_string());
        let mu = layer.mu[cell];
        let _ = writeln!(text, "{temperature},{pressure},{rate},{},{}", mu.value, mu.error);
    }
    text
}

/// The rate law of each temperature and pressure.
pub(super) fn json(table: &FrictionTable) -> String {
    let mut laws = Vec::new();
    for layer in &table.layers {
        for ((law, heating), pressure) in layer.laws.iter().zip(&layer.flash_heating).zip(&table.pressures) {
            let mut both = entry(law, "mu_inf", "V_star");
            both["temperature"] = json!(layer.temperature);
            both["pressure"] = json!(pressure);
            both["flash_heating"] = entry(heating, "mu_w", "V_w");
            laws.push(both);
        }
    }
    let positive = table.slip_rates.iter().find(|rate| **rate > 0.0);
    let document = json!({
        "title": "Rate law of the friction coefficient of a rough surface",
        "source": format!("roughsurface {}", env!("CARGO_PKG_VERSION")),
        "files": table.sources(),
        "variables": {"V": "slip rate, m/s", "pressure": "nominal, Pa", "temperature": "initial, K"},
        "warnings": table.warnings(),
        "fitted_between": [positive, table.slip_rates.last()],
        "laws": laws,
    });
    format!("{document:#}\n")
}

/// A law, with the names of its plateau and of its slip rate.
fn entry(law: &FittedLaw, plateau: &str, velocity: &str) -> Value {
    let mut entry = json!({"form": law.as_ref().map_or("none", |(law, _)| law.form.name)});
    let limitation = law.as_ref().map_or_else(|reason| reason, |(_, limitation)| limitation);
    if !limitation.is_empty() {
        entry["limitation"] = limitation.as_str().into();
    }
    if let Ok((law, limitation)) = law {
        entry["formula"] = law.form.formula.into();
        entry["mu_0"] = json!(law.mu_0.in_unit("1"));
        entry[plateau] = json!(law.plateau.in_unit("1"));
        entry[velocity] = json!(law.velocity.in_unit("m s-1"));
        entry["n"] = json!(law.exponent.in_unit("1"));
        entry["rms"] = law.misfit.into();
        entry["reliable"] = limitation.is_empty().into();
    }
    entry
}
