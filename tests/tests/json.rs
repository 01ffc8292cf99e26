//! Summaries as JSON: both programs write a number as `{"value": …, "error": …, "unit": …}`.

use serde_json::Value;
use tables::quantity::Quantity;
use tests::programs::done;

const SCENE: &str = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
                     [loading]\ninterference = 2\nslip_rate = 1\nslip_distance = 0.05\n\
                     [numerics]\nelements_per_radius = 4\nsectors = 4\n";

const SURFACE: &str = "[surface]\nasperity_density = 1e9\nasperity_radius = 1e-4\n\
                       heights = { distribution = \"gaussian\", std = 0.1e-6 }\n\
                       [query]\npressure = [1e5, 1e6]\nslip_rate = [0.1, 1.0, 3.0, 10.0]\n\
                       [uncertainty]\nasperity_radius = 1e-6\n";

fn summary(program: &str, arguments: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    std::fs::write(folder.path().join("surface.toml"), SURFACE).unwrap();
    done(program, folder.path(), &format!("{arguments} --json")).json()
}

/// Whether it is a number with its error and unit: null where unknown, no negative error.
fn is_measured(value: &Value) -> bool {
    let number = |key: &str| value.get(key).is_some_and(|number| number.is_f64() || number.is_null());
    number("value")
        && number("error")
        && value["error"].as_f64().is_none_or(|error| error >= 0.0)
        && value["unit"].is_string()
}

/// Numbers with errors and units anywhere below `value`.
fn measured(value: &Value) -> usize {
    let below = match value {
        Value::Object(entries) => entries.values().map(measured).sum(),
        Value::Array(items) => items.iter().map(measured).sum(),
        _ => 0,
    };
    if value.get("value").is_some() {
        assert!(is_measured(value), "{value}");
        return below + 1;
    }
    below
}

#[test]
fn numbers_of_both_programs_have_one_shape() {
    let run = summary("asperity", "run scene.toml -o run.nc");
    for quantity in Quantity::SCALARS {
        let descriptor = quantity.descriptor();
        let value = &run["summary"][descriptor.name];
        assert!(is_measured(value) && value["unit"] == descriptor.units, "{}: {value}", descriptor.name);
    }

    let predicted =
        summary("roughsurface", "predict surface.toml --table steel-4340 --compare all -o friction.nc");
    let cells = predicted["friction"].as_array().unwrap();
    assert_eq!(cells.len(), 8);
    let quantities = &roughsurface::friction::quantities::QUANTITIES;
    for cell in cells {
        assert!(cell["slip_rate"].is_f64() && cell["pressure"].is_f64());
        for quantity in quantities.iter().filter(|quantity| quantity.name != "pressure") {
            let value = &cell[quantity.name];
            assert!(is_measured(value) && value["unit"] == quantity.unit, "{}: {value}", quantity.name);
            assert_eq!(value["parameter_std"].is_f64(), quantity.propagated, "{}", quantity.name);
        }
    }
    assert!(measured(&predicted["comparisons"]) == 4 * predicted["comparisons"].as_array().unwrap().len());
    assert!(
        measured(&predicted["flash_heating"]) > 0 || predicted["flash_heating"][0]["not_fitted"].is_string()
    );

    let sampled = summary(
        "roughsurface",
        "sample surface.toml --table steel-4340 --asperities 300 --realizations 5 -o mc.nc",
    );
    assert_eq!(measured(&sampled["friction"]), 2 * 8);
}
