//! The influence of the cut-off of a topography, in `friction.nc`, in JSON and as rows of a table.

use crate::friction::Friction;
use crate::friction::cutoff::PredictionAtCutoff;
use crate::friction::quantities::SurfaceQuantity;
use crate::output::figure::chosen;
use crate::output::result_tables::{Rows, head};
use crate::sampling::case::Results;
use serde_json::{Value, json};
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter, described};

/// Results at each cut-off.
const SHOWN: [&str; 2] = ["mu_static", "mu"];

/// A parameter of the summits: name, unit, meaning, formula.
type Summit = (&'static str, &'static str, &'static str, fn(&PredictionAtCutoff) -> f64);
const SUMMITS: [Summit; 3] = [
    ("asperity_density", "m-2", "summits per nominal area", |at| at.asperity_density),
    ("asperity_radius", "m", "radius of the summits", |at| at.asperity_radius),
    ("heights_std", "m", "standard deviation of the summit heights", |at| at.heights_std),
];

/// Text in place of results at a slip rate that the table does not cover at the radius of another cut-off.
const OUTSIDE: &str = "outside table";

/// Values of a quantity in all cells, row by row; unknown where there are none.
fn estimates(quantity: &SurfaceQuantity, at: &PredictionAtCutoff, rates: usize) -> Vec<Estimate> {
    let of =
        |cell: &Option<Friction>| cell.as_ref().map_or(Estimate::UNKNOWN, |cell| quantity.estimate(cell));
    let row = |row: &Result<Vec<Option<Friction>>, _>| match row {
        Ok(cells) => cells.iter().map(of).collect(),
        Err(_) => vec![Estimate::UNKNOWN; rates],
    };
    at.friction.iter().flat_map(row).collect()
}

/// Variables over the dimension `cutoff`.
pub(super) fn write(
    file: &mut DatasetWriter,
    cutoffs: &[PredictionAtCutoff],
    grid: &[&str; 2],
    rates: usize,
) -> Result<(), DatasetError> {
    if cutoffs.is_empty() {
        return Ok(());
    }
    let lengths: Vec<f64> = cutoffs.iter().map(|at| at.cutoff).collect();
    file.coordinate("cutoff", &lengths, &described("m", "short-wavelength cut-off of the topography"))?;
    for (name, unit, long_name, of) in SUMMITS {
        let values: Vec<f64> = cutoffs.iter().map(of).collect();
        let long_name = format!("{long_name}, by cut-off");
        file.reals(&format!("{name}_cutoff"), &["cutoff"], &values, &described(unit, &long_name))?;
    }
    for quantity in SHOWN.map(SurfaceQuantity::named) {
        let of = |at: &PredictionAtCutoff| estimates(quantity, at, rates);
        let values: Vec<f64> = cutoffs.iter().flat_map(of).map(|estimate| estimate.value).collect();
        let name = format!("{}_cutoff", quantity.name);
        let long_name = format!("{}, by cut-off", quantity.long_name);
        file.reals(&name, &["cutoff", grid[0], grid[1]], &values, &described(quantity.unit, &long_name))?;
    }
    Ok(())
}

/// Results at other cut-offs as JSON, each number with its unit: the summits, whose errors are unknown, and the results of every cell in the order
/// of `friction`, and why there are none in some.
pub(super) fn json(cutoffs: &[PredictionAtCutoff], rates: usize) -> Value {
    let of = |at: &PredictionAtCutoff| {
        let exact = Estimate::exact;
        let mut entry = json!({ "cutoff": exact(at.cutoff).in_unit("m") });
        for (name, unit, _, value) in SUMMITS {
            entry[name] = json!(Estimate { value: value(at), error: f64::NAN }.in_unit(unit));
        }
        for quantity in SHOWN.map(SurfaceQuantity::named) {
            let all = estimates(quantity, at, rates).into_iter();
            entry[quantity.name] = all.map(|estimate| json!(estimate.in_unit(quantity.unit))).collect();
        }
        if let Some(Err(reason)) = at.friction.iter().find(|row| row.is_err()) {
            entry["refused"] = reason.to_string().into();
        }
        entry
    };
    cutoffs.iter().map(of).collect()
}

/// Rows for each pressure or separation and cut-off, at the lowest and the highest slip rate; empty for a
/// surface file.
pub(super) fn rows(results: &Results) -> Rows {
    if results.cutoffs.is_empty() {
        return Rows::new();
    }
    let query = &results.prediction.query;
    let rates = chosen(query.slip_rates.len(), 2);
    let mut rows = head(results, ["cut-off [m]", "eta [1/m2]", "R [m]", "sigma_s [m]"]);
    for &rate in &rates {
        rows[0].extend(SHOWN.map(|name| format!("{name} at {} m/s", query.slip_rates[rate])));
    }
    for (index, load) in query.loading.values().iter().enumerate() {
        for at in &results.cutoffs {
            let mut row = vec![format!("{load:.3e}"), format!("{:.3e}", at.cutoff)];
            row.extend(SUMMITS.map(|(_, _, _, of)| format!("{:.3e}", of(at))));
            match &at.friction[index] {
                Ok(cells) => {
                    for &rate in &rates {
                        let shown = |name| match &cells[rate] {
                            Some(cell) => format!("{:.4}", SurfaceQuantity::named(name).estimate(cell).value),
                            None => OUTSIDE.into(),
                        };
                        row.extend(SHOWN.map(shown));
                    }
                }
                Err(reason) => row.push(reason.to_string()),
            }
            rows.push(row);
        }
    }
    rows
}
