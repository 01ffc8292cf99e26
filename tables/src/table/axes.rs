//! Coordinates of a table.

use super::TableError;

/// Coordinates of a table, each strictly increasing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axes {
    /// ω₀/ω_c, positive.
    pub interference: Vec<f64>,
    /// V, m/s, at the radius of the table; a leading 0 is the isothermal limit.
    pub slip_rate: Vec<f64>,
    /// s/a₀ of the histories, a₀ being the contact radius at the end of the press; not negative.
    pub slip: Vec<f64>,
}

pub(crate) fn check_axis(axis: &'static str, values: &[f64], positive: bool) -> Result<(), TableError> {
    if values.is_empty() {
        return Err(TableError::AxisEmpty(axis));
    }
    for (position, &value) in values.iter().enumerate() {
        let rule = if !value.is_finite() {
            "be finite"
        } else if positive && value <= 0.0 {
            "be positive"
        } else if value < 0.0 {
            "not be negative"
        } else if position > 0 && value <= values[position - 1] {
            "increase"
        } else {
            continue;
        };
        return Err(TableError::Axis { axis, rule, value, position });
    }
    Ok(())
}
