//! Powers of ten in the labels of figures.

/// What values up to `largest` are divided by for display, and their label with the unit that is left.
pub fn scaled(largest: f64, label: &str, unit: &str) -> (f64, String) {
    let (exponent, label) = match (unit, thousands(largest)) {
        ("", _) => (0, label.to_owned()),
        (unit, 0) => (0, format!("{label} ({unit})")),
        (unit, exponent) => (exponent, format!("{label} (10^{{{exponent}}} {unit})").replace('-', "−")),
    };
    (10_f64.powi(exponent), label)
}

/// Multiple of three that leaves a number from 1 to 1000, or 0 if it needs no scaling.
fn thousands(largest: f64) -> i32 {
    match largest {
        0.0 | 0.1..1e4 => 0,
        largest => 3 * (largest.log10() / 3.0).floor() as i32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_powers_of_a_thousand() {
        assert_eq!([0.0, 0.3, 9e3, 2e4, 5e-9].map(thousands), [0, 0, 0, 3, -9]);
        assert_eq!(scaled(4e9, "Pressure p", "Pa").1, "Pressure p (10^{9} Pa)");
        assert_eq!(scaled(4e-9, "Area A", "m²").1, "Area A (10^{−9} m²)");
    }
}
