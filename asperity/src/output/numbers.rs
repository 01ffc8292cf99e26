//! Numbers with their errors and units, as text and as JSON.

use serde_json::{Value, json};
pub use tables::numbers::{plain, with_error};
use tables::quantity::Estimate;

/// The same as JSON; `null` for numbers that are not finite.
pub fn as_json(estimate: Estimate, unit: &str) -> Value {
    json!(estimate.in_unit(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_values_are_null() {
        assert_eq!(as_json(Estimate { value: f64::NAN, error: 1.0 }, "N")["value"], Value::Null);
    }
}
