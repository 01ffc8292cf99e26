//! The summary of a prediction as JSON: the numbers of the file, without histories.

use crate::friction::Friction;
use crate::friction::flash_heating::{FlashHeating, NoFit};
use crate::friction::quantities::{QUANTITIES, Quantity, Source};
use crate::friction::regime::regime;
use crate::output::cutoffs;
use crate::output::friction_file::COMPARED;
use crate::output::results::Results;
use crate::sampling::uncertainty::outputs;
use crate::surface::query::NormalLoading;
use serde_json::{Map, Value, json};

/// Key of pressures or separations.
pub(super) fn row_key(loading: &NormalLoading) -> &'static str {
    match loading {
        NormalLoading::Pressure(_) => "pressure",
        NormalLoading::Separation(_) => "separation_at_rest",
    }
}

/// The prediction as JSON.
pub fn json(results: &Results) -> Value {
    let prediction = &results.prediction;
    let row = row_key(&prediction.query.loading);
    let loads = prediction.query.loading.values();
    let mut cells = Vec::new();
    for (index, (load, slip_rate, friction)) in prediction.cells().enumerate() {
        let mut cell = quantities(friction);
        cell.insert(row.into(), load.into());
        cell.insert("slip_rate".into(), slip_rate.into());
        if let Some(propagated) = &results.propagated {
            let std = |(output, quantity): (usize, &Quantity)| {
                (quantity.name.to_string(), Value::from(propagated.std(index, output)))
            };
            cell.insert("parameter_std".into(), outputs().enumerate().map(std).collect());
        }
        cells.push(Value::Object(cell));
    }
    let fits = loads.iter().zip(&prediction.flash_heating).map(|(load, fit)| flash_heating(row, *load, fit));
    let compared = results.comparisons.iter().flat_map(|comparison| {
        loads.iter().zip(&comparison.friction).map(|(load, friction)| {
            let mut cell = Map::from_iter([
                ("model".to_string(), comparison.model.as_str().into()),
                (row.to_string(), (*load).into()),
            ]);
            cell.extend(COMPARED.map(|name| (name.to_string(), json!(Quantity::named(name).of(friction)))));
            Value::Object(cell)
        })
    });
    let warnings: Vec<String> = prediction.warnings.iter().map(ToString::to_string).collect();
    json!({
        "law": prediction.law,
        "hold": prediction.query.control,
        "plasticity_index": prediction.plasticity_index,
        "regime": regime(prediction.plasticity_index),
        "friction": cells,
        "cutoffs": cutoffs::json(&results.cutoffs),
        "comparisons": compared.collect::<Vec<Value>>(),
        "flash_heating": fits.collect::<Vec<Value>>(),
        "warnings": warnings,
    })
}

/// Every quantity of a cell: value and error, a share as a number.
fn quantities(friction: &Friction) -> Map<String, Value> {
    let value = |quantity: &Quantity| match quantity.source {
        Source::Share(of) => json!(of(friction)),
        _ => json!(quantity.of(friction)),
    };
    let mut cell: Map<String, Value> =
        QUANTITIES.iter().map(|quantity| (quantity.name.to_string(), value(quantity))).collect();
    // Of this slip, value and error are two numbers.
    cell.insert("inception_slip".into(), json!(friction.inception_slip.value));
    cell.insert("inception_slip_error".into(), json!(friction.inception_slip.error));
    cell.insert("contacts".into(), json!(friction.shares));
    cell
}

fn flash_heating(row: &str, load: f64, fit: &Result<FlashHeating, NoFit>) -> Value {
    match fit {
        Ok(fit) => json!({
            row: load,
            "mu_0": fit.mu_0,
            "mu_w": fit.mu_w,
            "V_w": fit.v_w,
            "rms": fit.misfit,
            "r_squared": fit.r_squared,
        }),
        Err(reason) => json!({row: load, "not_fitted": reason.to_string()}),
    }
}
