//! The response to a step of the slip rate, in `friction.nc`, in JSON, as rows of a table and as a panel.

use crate::friction::rate_step::{RateStepResponse, Stepped};
use crate::output::origin::with_error;
use crate::output::result_tables::{Rows, estimate, head};
use crate::sampling::case::Results;
use serde_json::{Value, json};
use tables::law::Estimate;
use tables::netcdf::{DatasetError, DatasetWriter, described};

/// A number of each pressure or separation: name, unit, meaning, formula.
type Number = (&'static str, &'static str, &'static str, fn(&Stepped, &[f64]) -> Estimate);
const NUMBERS: [Number; 4] = [
    ("mu_before_step", "1", "sliding friction coefficient before the step of the slip rate", |row, _| {
        row.before
    }),
    ("mu_after_step", "1", "steady sliding friction coefficient after the step", |row, _| row.after),
    ("direct_effect", "1", "change of the friction coefficient at the step itself", |row, _| {
        row.direct_effect()
    }),
    (
        "evolution_distance",
        "m",
        "slip in which half of the change of friction from just after the step to steady sliding is done",
        Stepped::evolution_distance,
    ),
];

/// Variables over the pressures or separations, and over the slips since the step.
pub(super) fn write(
    file: &mut DatasetWriter,
    response: Option<&RateStepResponse>,
    row: &str,
) -> Result<(), DatasetError> {
    let Some(RateStepResponse { rates, slip, rows }) = response else { return Ok(()) };
    file.attribute("rate_step", format!("from {} to {} m s-1", rates[0], rates[1]).as_str())?;
    file.coordinate(
        "slip_since_step",
        slip,
        &described("m", "slip of the flat since the step of the slip rate"),
    )?;
    for (name, unit, long_name, of) in NUMBERS {
        let values: Vec<Estimate> = rows.iter().map(|stepped| of(stepped, slip)).collect();
        with_error(file, name, &[row], (unit, long_name), &values)?;
    }
    let mu: Vec<Estimate> = rows.iter().flat_map(|stepped| stepped.mu.iter().copied()).collect();
    let meaning = ("1", "friction coefficient since the step of the slip rate");
    with_error(file, "mu_since_step", &[row, "slip_since_step"], meaning, &mu)
}

/// The response to a step of the slip rate as JSON: both slip rates, and the numbers of each pressure or separation in their
/// order.
pub(super) fn json(response: Option<&RateStepResponse>) -> Value {
    let Some(RateStepResponse { rates: [before, after], slip, rows }) = response else { return Value::Null };
    let entry = |stepped: &Stepped| -> Value {
        let of = |(name, unit, _, of): &Number| (name.to_string(), json!(of(stepped, slip).in_unit(unit)));
        Value::Object(NUMBERS.iter().map(of).collect())
    };
    json!({ "before": before, "after": after, "unit": "m s-1", "rows": rows.iter().map(entry).collect::<Vec<_>>() })
}

/// Rows for each pressure or separation; empty without a step.
pub(super) fn rows(results: &Results) -> Rows {
    let Some(RateStepResponse { slip, rows, .. }) = &results.prediction.rate_step else { return Rows::new() };
    let mut table = head(results, ["mu before", "direct effect", "mu after", "evolution distance [m]"]);
    for (load, stepped) in results.prediction.query.loading.values().iter().zip(rows) {
        let distance = stepped.evolution_distance(slip);
        let numbers = [stepped.before, stepped.direct_effect(), stepped.after, distance].map(estimate);
        table.push([format!("{load:.3e}")].into_iter().chain(numbers).collect());
    }
    table
}
