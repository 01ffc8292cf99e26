//! Numbers with their errors and units, for people and for programs.

use serde_json::{Value, json};
use tables::law::Estimate;

/// `value ± error unit`, with two digits of the error.
///
/// ```
/// use asperity::output::numbers::with_error;
/// use tables::law::Estimate;
///
/// assert_eq!(with_error(Estimate { value: 0.23498, error: 0.00351 }, "1"), "0.2350 ± 0.0035");
/// assert_eq!(with_error(Estimate { value: 7.888e-9, error: 4.3e-11 }, "m2"), "7.888e-9 ± 0.043e-9 m2");
/// ```
pub fn with_error(estimate: Estimate, unit: &str) -> String {
    let Estimate { value, error } = estimate;
    let unit = match unit {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    if value.is_nan() {
        return "not available".into();
    }
    if !error.is_finite() {
        return format!("{}{} (error unknown){unit}", plain(value), " ± ?");
    }
    let size = value.abs().max(error);
    if size == 0.0 {
        return format!("0 ± 0{unit}");
    }
    let exponent = size.log10().floor() as i32;
    // Numbers that need many zeros are shown as multiples of a power of ten.
    let (scale, suffix) = match exponent {
        -3..=4 => (1.0, String::new()),
        exponent => (10_f64.powi(exponent), format!("e{exponent}")),
    };
    let error_exponent = match error / scale {
        0.0 => exponent - 5,
        error => error.log10().floor() as i32,
    };
    let decimals = usize::try_from(1 - error_exponent).unwrap_or(0).min(12);
    format!("{:.decimals$}{suffix} ± {:.decimals$}{suffix}{unit}", value / scale, error / scale)
}

/// Six digits without trailing zeros.
pub fn plain(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match (1e-3..1e6).contains(&magnitude) {
        true => format!("{rounded}"),
        false => format!("{rounded:e}"),
    }
}

/// The same for programs: `null` for what is not a finite number.
pub fn as_json(estimate: Estimate, unit: &str) -> Value {
    json!({ "value": estimate.value, "error": estimate.error, "unit": unit })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(value: f64, error: f64, unit: &str) -> String {
        with_error(Estimate { value, error }, unit)
    }

    #[test]
    fn error_has_two_digits_and_the_value_as_many_places() {
        assert_eq!(shown(0.31751, 0.0021, "1"), "0.3175 ± 0.0021");
        assert_eq!(shown(9.1234e7, 4.6e5, "N"), "9.123e7 ± 0.046e7 N");
        assert_eq!(shown(3.1e-5, 1e-6, "m"), "3.10e-5 ± 0.10e-5 m");
        assert_eq!(shown(1234.5, 67.0, "K"), "1234 ± 67 K");
        assert_eq!(shown(298.0, 0.0, "K"), "298.0000 ± 0.0000 K");
        assert_eq!(shown(0.0, 0.0, "K"), "0 ± 0 K");
        assert_eq!(shown(1.0, 250.0, "N"), "1 ± 250 N");
    }

    #[test]
    fn missing_values_and_errors_are_said() {
        assert_eq!(shown(f64::NAN, 1.0, "N"), "not available");
        assert_eq!(shown(0.5, f64::NAN, "1"), "0.5 ± ? (error unknown)");
        assert_eq!(as_json(Estimate { value: f64::NAN, error: 1.0 }, "N")["value"], Value::Null);
    }
}
