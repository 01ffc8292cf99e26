//! Tables of a prediction, heading first, for the summary and the report.

use crate::friction::Friction;
use crate::friction::quantities::{Quantity, Source};
use crate::sampling::case::Results;
use crate::sampling::uncertainty::outputs;
use tables::numbers;
use tables::quantity::Estimate;

/// A heading and rows of cells. A row with fewer cells ends with a remark.
pub(super) type Rows = Vec<Vec<String>>;

/// Quantities that are always shown with their error.
const WITH_ERROR: [&str; 6] = ["mu", "mu_steady", "mu_static", "dmu_dlnV", "G", "G_weakening"];
/// Shown in place of a number that is not known.
const NOT_AVAILABLE: &str = "n/a";

/// Value and error of a number without unit.
pub(super) fn estimate(estimate: Estimate) -> String {
    if estimate.value.is_finite() { numbers::with_error(estimate, "1") } else { NOT_AVAILABLE.into() }
}

/// A number with a given number of decimals.
fn plain(value: f64, decimals: usize) -> String {
    if value.is_finite() { format!("{value:.decimals$}") } else { NOT_AVAILABLE.into() }
}

/// A quantity of a cell; `errors` also of those with a unit.
fn shown(name: &str, cell: &Friction, errors: bool) -> String {
    let quantity = Quantity::named(name);
    match (&quantity.source, quantity.of(cell)) {
        (Source::Share(_), Some(Estimate { value, .. })) if value < 5e-5 => "-".into(),
        (Source::Share(_), Some(Estimate { value, .. })) => format!("{:.2} %", 100.0 * value),
        (_, Some(estimate)) if WITH_ERROR.contains(&name) => self::estimate(estimate),
        (_, Some(Estimate { value, error })) if value.is_finite() && quantity.unit == "K" => match errors {
            true => format!("{value:.1} ± {error:.1}"),
            false => format!("{value:.1}"),
        },
        (_, Some(Estimate { value, error })) if value.is_finite() => match errors {
            true => self::estimate(Estimate { value, error }),
            false => format!("{value:.3e}"),
        },
        _ => NOT_AVAILABLE.into(),
    }
}

pub(super) fn head<'a>(results: &Results, columns: impl IntoIterator<Item = &'a str>) -> Rows {
    let first = results.prediction.query.loading.heading();
    vec![std::iter::once(first).chain(columns).map(String::from).collect()]
}

/// The quantities in `columns`, with their headings, of every cell.
pub(super) fn quantities(results: &Results, columns: &[(&str, &str)], errors: bool) -> Rows {
    let heads = columns.iter().map(|(_, head)| *head);
    let mut rows = head(results, ["slip rate [m/s]"].into_iter().chain(heads));
    for (load, rate, cell) in results.prediction.cells() {
        let mut row = vec![format!("{load:.3e}"), numbers::digits(rate, 4)];
        row.extend(columns.iter().map(|(name, _)| shown(name, cell, errors)));
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
        row.extend((0..outputs().count()).map(|output| format!("{:.1e}", propagated.std(cell, output))));
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
