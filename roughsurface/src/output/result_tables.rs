//! Tables of a prediction, heading first, for the summary and the report.

use crate::friction::Friction;
use crate::friction::quantities::{Source, SurfaceQuantity};
use crate::sampling::case::Results;
use crate::sampling::uncertainty::outputs;
use tables::numbers;
use tables::quantity::Estimate;

/// A heading and rows of cells. A row with fewer cells ends with a remark.
pub(super) type Rows = Vec<Vec<String>>;

/// Shown in place of a number that is not known.
pub(super) const NOT_AVAILABLE: &str = "n/a";
/// Shown in place of a share that is zero.
pub(super) const NO_SHARE: &str = "-";

/// Least error of a temperature that is shown, K.
const LEAST_SHOWN_KELVIN: f64 = 0.1;

/// Value and error of a number without unit.
pub(super) fn estimate(estimate: Estimate) -> String {
    if estimate.value.is_finite() { numbers::with_error(estimate, "1") } else { NOT_AVAILABLE.into() }
}

/// A number with a given number of decimals.
fn plain(value: f64, decimals: usize) -> String {
    if value.is_finite() { format!("{value:.decimals$}") } else { NOT_AVAILABLE.into() }
}

/// A quantity of a cell with its error; shares of the summits without.
fn shown(name: &str, cell: &Friction) -> String {
    let quantity = SurfaceQuantity::named(name);
    match (&quantity.source, quantity.of(cell)) {
        (Source::Share(_), Some(Estimate { value, .. })) if value < 5e-5 => NO_SHARE.into(),
        (Source::Share(_), Some(Estimate { value, .. })) => format!("{:.2} %", 100.0 * value),
        (_, Some(Estimate { value, error })) if value.is_finite() && quantity.unit == "K" => {
            let shown = if error > 0.0 { error.max(LEAST_SHOWN_KELVIN) } else { error };
            format!("{value:.1} ± {shown:.1}")
        }
        (_, Some(estimate)) => self::estimate(estimate),
        (_, None) => NOT_AVAILABLE.into(),
    }
}

pub(super) fn head<'a>(results: &Results, columns: impl IntoIterator<Item = &'a str>) -> Rows {
    let first = results.prediction.query.loading.heading();
    vec![std::iter::once(first).chain(columns).map(String::from).collect()]
}

/// The quantities in `columns`, with their headings, of every cell.
pub(super) fn quantities(results: &Results, columns: &[(&str, &str)]) -> Rows {
    let heads = columns.iter().map(|(_, head)| *head);
    let mut rows = head(results, ["slip rate [m/s]"].into_iter().chain(heads));
    for (load, rate, cell) in results.prediction.cells() {
        let mut row = vec![format!("{load:.3e}"), numbers::digits(rate, 4)];
        row.extend(columns.iter().map(|(name, _)| shown(name, cell)));
        rows.push(row);
    }
    rows
}

/// Standard deviations from uncertain parameters, and the parameter with the largest contribution to mu;
/// empty without such parameters.
pub(super) fn parameters(results: &Results) -> Rows {
    let Some(propagated) = &results.propagated else { return Rows::new() };
    let names = outputs().map(|output| output.name);
    let mut rows = head(results, ["slip rate [m/s]"].into_iter().chain(names).chain(["mu most by"]));
    for (cell, (load, rate)) in results.prediction.query.cells().enumerate() {
        let mut row = vec![format!("{load:.3e}"), numbers::digits(rate, 4)];
        let std = |output| match propagated.std(cell, output) {
            std if std.is_nan() => NOT_AVAILABLE.into(),
            std => format!("{std:.1e}"),
        };
        row.extend((0..outputs().count()).map(std));
        let changes = propagated.contributions[cell][0].iter().zip(&propagated.parameters);
        let most = changes.max_by(|one, other| one.0.abs().total_cmp(&other.0.abs()));
        row.push(most.map_or("-", |(_, varied)| varied.key.as_str()).to_string());
        rows.push(row);
    }
    rows
}

/// Results of the models of the literature; empty without them.
pub(super) fn compared(results: &Results) -> Rows {
    if results.comparisons.is_empty() {
        return Rows::new();
    }
    let mut rows = head(results, ["model", "mu_static", "mu", "area fraction", "validity", "asperities"]);
    for (row, load) in results.prediction.query.loading.values().iter().enumerate() {
        for comparison in &results.comparisons {
            let cell = &comparison.friction[row];
            rows.push(vec![
                format!("{load:.3e}"),
                comparison.model.clone(),
                plain(cell.mu_static.value, 4),
                plain(cell.sliding.mu.value, 4),
                format!("{:.3e}", cell.sliding.area_fraction.value),
                comparison.validity(row),
                comparison.description.to_string(),
            ]);
        }
    }
    rows
}
