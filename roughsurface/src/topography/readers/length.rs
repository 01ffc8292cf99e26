//! Lengths with a unit.

/// Symbols of each unit of length, the first of which messages name, and metres in it.
const UNITS: [(&[&str], f64); 11] = [
    (&["km"], 1e3),
    (&["m"], 1.0),
    (&["cm"], 1e-2),
    (&["mm"], 1e-3),
    (&["um", "µm", "μm", "~m", "micron", "microns"], 1e-6),
    (&["nm"], 1e-9),
    (&["A", "\u{c5}", "\u{212b}", "Ang", "Angstrom", "angstrom"], 1e-10),
    (&["pm"], 1e-12),
    (&["in", "inch"], 25.4e-3),
    (&["mil", "thou"], 25.4e-6),
    (&["uin", "µin", "μin"], 25.4e-9),
];

/// Metres in a unit of length, by its usual symbols.
pub fn unit(symbol: &str) -> Option<f64> {
    let symbol = symbol.trim();
    UNITS.iter().find(|(symbols, _)| symbols.contains(&symbol)).map(|(_, metres)| *metres)
}

/// The known units, separated by commas.
pub fn known() -> String {
    UNITS.map(|(symbols, _)| symbols[0]).join(", ")
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
        for (text, metres) in [
            ("2e-6", 2e-6),
            ("2um", 2e-6),
            ("2.5 µm", 2.5e-6),
            ("1e3nm", 1e-6),
            ("3 Å", 3e-10),
            ("1m", 1.0),
            ("2mil", 50.8e-6),
            ("4 µin", 101.6e-9),
        ] {
            let found = parse(text).unwrap();
            assert!((found / metres - 1.0).abs() < 1e-14, "{text}: {found:e}");
        }
        for text in ["", "um", "-1e-6", "2 furlongs", "inf", "0"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
