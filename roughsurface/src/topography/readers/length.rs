//! Lengths with a unit.

/// Metres in a unit of length, by its usual symbols.
pub fn unit(symbol: &str) -> Option<f64> {
    Some(match symbol.trim() {
        "km" => 1e3,
        "m" => 1.0,
        "cm" => 1e-2,
        "mm" => 1e-3,
        "um" | "µm" | "μm" | "~m" | "micron" | "microns" => 1e-6,
        "nm" => 1e-9,
        "\u{c5}" | "\u{212b}" | "A" | "Ang" | "Angstrom" => 1e-10,
        "pm" => 1e-12,
        "in" => 25.4e-3,
        _ => return None,
    })
}

/// A positive length such as `2e-6`, in metres, or `2um`; in metres.
pub fn parse(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let metres = match text.parse::<f64>() {
        Ok(metres) => Some(metres),
        Err(_) => {
            // The unit follows the last digit.
            let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.').map_or(0, |place| place + 1);
            let (number, symbol) = text.split_at(end);
            number.parse::<f64>().ok().zip(unit(symbol)).map(|(number, unit)| number * unit)
        }
    };
    match metres {
        Some(metres) if metres > 0.0 && metres.is_finite() => Ok(metres),
        _ => Err("must be a positive length in metres, or with a unit: 2e-6, 2um, 500nm".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_with_and_without_unit() {
        for (text, metres) in
            [("2e-6", 2e-6), ("2um", 2e-6), ("2.5 µm", 2.5e-6), ("1e3nm", 1e-6), ("3 Å", 3e-10), ("1m", 1.0)]
        {
            let found = parse(text).unwrap();
            assert!((found / metres - 1.0).abs() < 1e-14, "{text}: {found:e}");
        }
        for text in ["", "um", "-1e-6", "2 furlongs", "inf", "0"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
