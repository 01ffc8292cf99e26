//! Keys of the section `[query]` given on the command line in place of those of the file.

use super::values::Values;
use serde::Serialize;
use tables::netcdf::input::Override;
use toml::Value;

/// Another value of a key of the section `[query]`; none leaves it out.
fn of_query(key: &str, value: Option<Value>) -> Override {
    Override { path: vec!["query".into(), key.into()], value }
}

/// Another value of a key of the section `[query]`: a number, a text or what a surface file has there.
pub fn query_key(key: &str, value: impl Serialize) -> Override {
    of_query(key, Some(Value::try_from(value).expect("a TOML value")))
}

/// Numbers in place of those of the section `[query]`; a pressure or a separation replaces the other.
pub fn query_values(
    pressure: Option<&Values>,
    separation: Option<&Values>,
    slip_rate: Option<&Values>,
) -> Vec<Override> {
    let loadings = [("pressure", pressure, "separation"), ("separation", separation, "pressure")];
    let mut overrides = Vec::new();
    for (key, values, other) in loadings {
        if let Some(values) = values {
            overrides.extend([query_key(key, &values.0), of_query(other, None)]);
        }
    }
    overrides.extend(slip_rate.map(|rates| query_key("slip_rate", &rates.0)));
    overrides
}
