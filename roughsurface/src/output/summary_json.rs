//! The summary of a prediction as JSON: the numbers of the file, without histories.

use crate::friction::Friction;
use crate::friction::quantities::{QUANTITIES, Source, SurfaceQuantity};
use crate::friction::rate_law::RateLaws;
use crate::friction::regime::regime;
use crate::output::cutoffs;
use crate::output::friction_file::COMPARED;
use crate::output::rate_laws;
use crate::output::rate_step;
use crate::sampling::case::Results;
use crate::sampling::uncertainty::outputs;
use crate::surface::query::NormalLoading;
use serde_json::{Map, Value, json};
use tables::law::Estimate;

/// Key of pressures or separations.
pub(super) fn row_key(loading: &NormalLoading) -> &'static str {
    match loading {
        NormalLoading::Pressure(_) => "pressure",
        NormalLoading::Separation(_) => "separation_before_sliding",
    }
}

/// The prediction as JSON.
pub fn json(results: &Results) -> Value {
    let prediction = &results.prediction;
    let row = row_key(&prediction.query.loading);
    let loads = prediction.query.loading.values();
    let mut cells = Vec::new();
    for (index, (load, slip_rate, friction)) in prediction.cells().enumerate() {
        let mut cell = quantities(&QUANTITIES, friction);
        cell.insert(row.into(), load.into());
        cell.insert("slip_rate".into(), slip_rate.into());
        if let Some(propagated) = &results.propagated {
            for (output, quantity) in outputs().enumerate() {
                if let Some(Value::Object(value)) = cell.get_mut(quantity.name) {
                    value.insert("parameter_std".into(), propagated.std(index, output).into());
                }
            }
        }
        cells.push(Value::Object(cell));
    }
    let by_load = |json: fn(&str, f64, &RateLaws) -> Value| -> Value {
        loads.iter().zip(&prediction.rate_laws).map(|(load, laws)| json(row, *load, laws)).collect()
    };
    let compared = results.comparisons.iter().flat_map(|comparison| {
        loads.iter().zip(&comparison.friction).map(|(load, friction)| {
            let mut cell = Map::from_iter([
                ("model".to_string(), comparison.model.as_str().into()),
                (row.to_string(), (*load).into()),
            ]);
            cell.extend(quantities(COMPARED.map(SurfaceQuantity::named), friction));
            Value::Object(cell)
        })
    });
    let warnings: Vec<String> = prediction.warnings.iter().map(ToString::to_string).collect();
    json!({
        "law": prediction.law,
        "hold": prediction.query.control,
        "contact_life": prediction.query.contact_life,
        "interaction": prediction.query.interaction,
        "plasticity_index": prediction.plasticity_index,
        "regime": regime(prediction.plasticity_index),
        "friction": cells,
        "cutoffs": cutoffs::json(&results.cutoffs, prediction.query.slip_rates.len()),
        "comparisons": compared.collect::<Vec<Value>>(),
        "rate_law": by_load(rate_laws::json),
        "flash_heating": by_load(rate_laws::flash_heating_json),
        "rate_step": rate_step::json(prediction.rate_step.as_ref()),
        "warnings": warnings,
    })
}

/// Quantities of a cell with errors and units; null where the law does not state them. The error of a share is null.
fn quantities<'a>(
    list: impl IntoIterator<Item = &'a SurfaceQuantity>,
    friction: &Friction,
) -> Map<String, Value> {
    let value = |quantity: &SurfaceQuantity| {
        let error = |known: Estimate| match quantity.source {
            Source::Share(_) => f64::NAN,
            _ => known.error,
        };
        let known = quantity.of(friction).map(|known| Estimate { error: error(known), ..known });
        json!(known.map(|known| known.in_unit(quantity.unit)))
    };
    list.into_iter().map(|quantity| (quantity.name.to_string(), value(quantity))).collect()
}
