//! Numbers as text: with errors and units, with a number of significant digits, or exactly; ranges of numbers.

use serde::Deserialize;

use super::Estimate;

/// Least error that is shown, over the value: those of closed forms, of quadrature alone, are often far smaller.
const LEAST_SHOWN: f64 = 1e-5;

/// `value ± error unit`, with two digits of the error, or of a hundred-thousandth of the value if that is larger.
///
/// ```
/// use tables::numbers::with_error;
/// use tables::quantity::Estimate;
///
/// assert_eq!(with_error(Estimate { value: 0.23498, error: 0.00351 }, "1"), "0.2350 ± 0.0035");
/// assert_eq!(with_error(Estimate { value: 7.888e-9, error: 4.3e-11 }, "m2"), "7.888e-9 ± 0.043e-9 m2");
/// assert_eq!(with_error(Estimate { value: 0.231704055379, error: 1e-12 }, "1"), "0.2317041 ± 0.0000023");
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
        // More digits would promise an accuracy that nobody knows.
        return format!("{} ± ? (error unknown){unit}", digits(value, 3));
    }
    let size = value.abs().max(error);
    if size == 0.0 {
        return format!("0 ± 0{unit}");
    }
    let error = if error > 0.0 { error.max(LEAST_SHOWN * size) } else { error };
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
    let [value, error] = [value, error].map(|number| decimal(number / scale, decimals));
    format!("{value}{suffix} ± {error}{suffix}{unit}")
}

/// A number with a given number of `decimals`; a zero has no sign.
pub fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(magnitude) if magnitude.bytes().all(|digit| matches!(digit, b'0' | b'.')) => {
            magnitude.to_owned()
        }
        _ => text,
    }
}

/// A number with at most `digits` significant digits, or more where the value would be rounded to `limit` or past it: for sentences
/// that say on which side of a limit a value lies.
///
/// ```
/// use tables::numbers::beside;
///
/// assert_eq!(beside(0.515, 0.5, 1), "0.52");
/// assert_eq!(beside(4.97, 5.0, 2), "4.97");
/// assert_eq!(beside(0.003, 5.0, 2), "0.003");
/// ```
pub fn beside(value: f64, limit: f64, digits: usize) -> String {
    const MOST: usize = 9;
    let is_beside = |digits: &usize| rounded(value, *digits).partial_cmp(&limit) == value.partial_cmp(&limit);
    self::digits(value, (digits..=MOST).find(is_beside).unwrap_or(digits))
}

/// Numbers that stand beside each other, at most `digits` significant digits each: all as multiples of a power of ten
/// where one of them is.
///
/// ```
/// use tables::numbers::alike;
///
/// assert_eq!(alike(&[1e5, 1e6], 4), ["1e5", "1e6"]);
/// assert_eq!(alike(&[1e5, 2.5e5], 4), ["100000", "250000"]);
/// ```
pub fn alike(values: &[f64], digits: usize) -> Vec<String> {
    let texts: Vec<String> = values.iter().map(|value| self::digits(*value, digits)).collect();
    match texts.iter().any(|text| text.contains('e')) {
        true => values.iter().map(|value| format!("{:e}", rounded(*value, digits))).collect(),
        false => texts,
    }
}

/// Six significant digits, without trailing zeros.
pub fn plain(value: f64) -> String {
    digits(value, 6)
}

/// A number with at most `digits` significant digits, without trailing zeros.
///
/// ```
/// use tables::numbers::digits;
///
/// assert_eq!(digits(0.123456, 3), "0.123");
/// assert_eq!(digits(1.5e-7, 3), "1.5e-7");
/// ```
pub fn digits(value: f64, digits: usize) -> String {
    exact(rounded(value, digits))
}

/// To that number of significant digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// The shortest text that reads back as the same number.
pub fn exact(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        1e-3..1e6 => format!("{value}"),
        magnitude if magnitude.is_finite() => format!("{value:e}"),
        _ => format!("{value}"),
    }
}

/// Spacing of the numbers of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Spacing {
    /// Equal ratios.
    Log,
    /// Equal differences.
    Linear,
}

impl Spacing {
    /// `points` numbers, two or more, from one end to the other, which are exactly as given.
    pub fn range(self, from: f64, to: f64, points: usize) -> Vec<f64> {
        let number = |i| match i as f64 / (points - 1) as f64 {
            0.0 => from,
            1.0 => to,
            share if self == Self::Log => from * (to / from).powf(share),
            share => from + (to - from) * share,
        };
        (0..points).map(number).collect()
    }
}

/// Rows as lines, their columns as wide as the widest cell and this far apart; those of `is_text` are set to the left. A
/// row that ends early ends with a remark, which may run over the columns to its right. The first row is complete.
pub fn aligned(rows: &[Vec<String>], gap: &str, is_text: impl Fn(usize) -> bool) -> String {
    let columns = rows[0].len();
    let is_remark = |row: &[String], column: usize| row.len() < columns && column + 1 == row.len();
    let width = |column: usize| {
        let cells = rows.iter().filter(|row| !is_remark(row, column)).filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cell = |(column, cell): (usize, &String)| match (is_remark(row, column), is_text(column)) {
            (true, _) => cell.clone(),
            (false, true) => format!("{cell:<width$}", width = widths[column]),
            (false, false) => format!("{cell:>width$}", width = widths[column]),
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        format!("{}\n", cells.join(gap).trim_end())
    };
    rows.iter().map(line).collect()
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
        assert_eq!(shown(-1e-7, 0.0021, "1"), "0.0000 ± 0.0021");
    }

    #[test]
    fn missing_values_and_errors_are_said() {
        assert_eq!(shown(f64::NAN, 1.0, "N"), "not available");
        assert_eq!(shown(0.5, f64::NAN, "1"), "0.5 ± ? (error unknown)");
        assert_eq!(shown(-0.0138216, f64::NAN, "m"), "-0.0138 ± ? (error unknown) m");
    }

    #[test]
    fn digits_are_significant_ones() {
        for (value, places, text) in [
            (1234.5678, 6, "1234.57"),
            (0.0, 6, "0"),
            (-0.0, 6, "0"),
            (-2.5e-9, 6, "-2.5e-9"),
            (999999.7, 6, "1e6"),
            (0.00099999, 6, "9.9999e-4"),
            (f64::INFINITY, 6, "inf"),
            (100.0, 3, "100"),
            (2.5, 3, "2.5"),
            (1234.0, 3, "1230"),
        ] {
            assert_eq!(digits(value, places), text);
        }
        assert_eq!(exact(0.1 + 0.2).parse::<f64>().unwrap(), 0.1 + 0.2);
        assert_eq!(exact(f64::NAN), "NaN");
    }

    #[test]
    fn a_value_keeps_its_side_of_a_limit() {
        for (value, limit, places, text) in [
            (0.515, 0.5, 2, "0.52"),
            (0.5004, 0.5, 2, "0.5004"),
            (4.996, 5.0, 2, "4.996"),
            (4.2, 5.0, 2, "4.2"),
            (5.0, 5.0, 2, "5"),
            (f64::NAN, 5.0, 2, "NaN"),
        ] {
            assert_eq!(beside(value, limit, places), text);
        }
    }

    #[test]
    fn zeros_have_no_sign() {
        assert_eq!(
            [decimal(-0.00004, 4), decimal(-0.00006, 4), decimal(-2.0, 0)],
            ["0.0000", "-0.0001", "-2"]
        );
    }
}
