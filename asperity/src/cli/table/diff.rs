//! `asperity table diff`.

use serde_json::{Value, json};
use tables::numbers::plain;
use tables::table::comparison::{Comparison, OfKey};

use super::{DiffArguments, read};
use crate::{Display, Failure};

/// Compare two tables, print how they differ, fail if it is by more than allowed.
pub fn diff(arguments: &DiffArguments, display: &Display) -> Result<(), Failure> {
    let [here, there] = [&arguments.here, &arguments.there].map(|table| read(table, &arguments.at));
    let comparison = here?.compare(&*there?);
    display.printer().print(|| as_json(&comparison), || text(&comparison))?;
    let Some(tolerance) = arguments.tolerance else { return Ok(()) };
    match comparison.largest() {
        Some(worst) if worst.largest > tolerance => Err(Failure::Run(format!(
            "{} differs by {} at {}, more than {}",
            worst.quantity.descriptor().name,
            plain(worst.largest),
            worst.at,
            plain(tolerance)
        ))),
        _ => match comparison.states.first() {
            Some(OfKey { key, here, there }) => {
                Err(Failure::Run(format!("{key}: {here} in one, {there} in the other")))
            }
            None if comparison.only_here + comparison.only_there > 0 => Err(Failure::Run(format!(
                "{} cells are in the first only, {} in the second only",
                comparison.only_here, comparison.only_there
            ))),
            None => Ok(()),
        },
    }
}

fn text(comparison: &Comparison) -> String {
    let Comparison { metadata, common, only_here, only_there, states, quantities } = comparison;
    let mut text =
        format!("{common} cells in common, {only_here} in the first only, {only_there} in the second only\n");
    for OfKey { key, here, there } in metadata.iter().chain(states) {
        text += &format!("{key}: {here} and {there}\n");
    }
    if *common == 0 {
        return text + "no quantity is compared, as no cell is in common\n";
    }
    if quantities.is_empty() {
        return text + "no differences in the values that both have\n";
    }
    text += &format!(
        "\n{:17} {:6} {:>11} {:>12} {:>12}   {:24} {:>14}\n",
        "quantity", "unit", "largest", "first", "second", "at", "beyond errors"
    );
    for difference in quantities {
        let descriptor = difference.quantity.descriptor();
        text += &format!(
            "{:17} {:6} {:>9.3} % {:>12} {:>12}   {:24} {:>14}\n",
            descriptor.name,
            descriptor.units,
            100.0 * difference.largest,
            plain(difference.values.0),
            plain(difference.values.1),
            difference.at,
            format!("{} of {}", difference.beyond_errors, difference.compared),
        );
    }
    text
}

fn as_json(comparison: &Comparison) -> Value {
    let of_key = |OfKey { key, here, there }: &OfKey| json!({ "what": key, "first": here, "second": there });
    let [metadata, states] = [&comparison.metadata, &comparison.states]
        .map(|keys| keys.iter().map(of_key).collect::<Vec<Value>>());
    let quantities: Value = (comparison.quantities.iter())
        .map(|difference| {
            let entry = json!({
                "largest": difference.largest,
                "at": difference.at,
                "first": difference.values.0,
                "second": difference.values.1,
                "compared": difference.compared,
                "beyond_errors": difference.beyond_errors,
            });
            (difference.quantity.descriptor().name, entry)
        })
        .collect();
    json!({
        "common": comparison.common,
        "first_only": comparison.only_here,
        "second_only": comparison.only_there,
        "metadata": metadata,
        "states": states,
        "quantities": quantities,
    })
}
