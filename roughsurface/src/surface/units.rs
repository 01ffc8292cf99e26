//! Numbers with a unit.

/// Units of a quantity: symbols of each, the first of which messages name, and its value in SI units.
pub struct Units(&'static [(&'static [&'static str], f64)]);

pub static LENGTH: Units = Units(&[
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
]);
pub static PRESSURE: Units = Units(&[
    (&["Pa"], 1.0),
    (&["kPa"], 1e3),
    (&["MPa", "N/mm2", "N/mm²"], 1e6),
    (&["GPa"], 1e9),
    (&["bar"], 1e5),
    (&["psi"], 6894.757),
]);
pub static SLIP_RATE: Units = Units(&[
    (&["m/s"], 1.0),
    (&["mm/s"], 1e-3),
    (&["um/s", "µm/s", "μm/s"], 1e-6),
    (&["nm/s"], 1e-9),
    (&["m/min"], 1.0 / 60.0),
    (&["km/h"], 1.0 / 3.6),
]);

impl Units {
    /// A unit in SI units, by its usual symbols.
    pub fn factor(&self, symbol: &str) -> Option<f64> {
        let symbol = symbol.trim();
        self.0.iter().find(|(symbols, _)| symbols.contains(&symbol)).map(|(_, factor)| *factor)
    }

    /// The known units, separated by commas.
    pub fn known(&self) -> String {
        let names: Vec<&str> = self.0.iter().map(|(symbols, _)| symbols[0]).collect();
        names.join(", ")
    }

    /// A number in SI units such as `2e-6`, or with a unit behind its last digit, `2um`; whether there is one.
    pub fn number(&self, text: &str) -> Option<(f64, bool)> {
        let text = text.trim();
        if let Ok(number) = text.parse::<f64>() {
            return Some((number, false));
        }
        let symbols =
            self.0.iter().flat_map(|(symbols, factor)| symbols.iter().map(move |symbol| (*symbol, *factor)));
        let mut split =
            symbols.filter_map(|(symbol, factor)| Some((text.strip_suffix(symbol)?.trim_end(), factor)));
        let (number, factor) = split.find(|(number, _)| number.parse::<f64>().is_ok())?;
        let power = factor.log10().round();
        if format!("1e{power}").parse() != Ok(factor) {
            return Some((number.parse::<f64>().ok()? * factor, true));
        }
        // By the exponent 5um is the number that 5e-6 is; by the product it may be the one beside it.
        let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
        let exponent = exponent.parse::<i32>().ok()? + power as i32;
        Some((format!("{mantissa}e{exponent}").parse().ok()?, true))
    }

    /// Numbers that all are in SI units, or all have a unit; otherwise the rule, of numbers of the form `form`.
    pub fn numbers(&self, texts: &[&str], form: &str) -> Result<Vec<f64>, String> {
        let read: Option<Vec<(f64, bool)>> = texts.iter().map(|text| self.number(text)).collect();
        let read =
            read.ok_or_else(|| format!("{form}, each without unit or with one of {}", self.known()))?;
        match read.iter().all(|(_, has_unit)| *has_unit == read[0].1) {
            true => Ok(read.into_iter().map(|(number, _)| number).collect()),
            false => Err("must have a unit behind each number, or behind none".into()),
        }
    }
}

/// A length such as `2e-6`, in metres, or `2um`, not negative; in metres.
pub fn length_or_zero(text: &str) -> Result<f64, String> {
    match LENGTH.number(text) {
        Some((metres, _)) if metres >= 0.0 && metres.is_finite() => Ok(metres),
        _ => Err("must be a length in metres, or with a unit, not negative: 2e-6, 2um, 0".into()),
    }
}

/// A positive length such as `2e-6`, in metres, or `2um`; in metres.
pub fn length(text: &str) -> Result<f64, String> {
    match LENGTH.number(text) {
        Some((metres, _)) if metres > 0.0 && metres.is_finite() => Ok(metres),
        _ => Err("must be a positive length in metres, or with a unit: 2e-6, 2um, 500nm".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_may_end_with_a_digit() {
        assert_eq!(PRESSURE.numbers(&["2N/mm2", "0.5 N/mm²", "10 MPa"], ""), Ok(vec![2e6, 0.5e6, 1e7]));
        assert_eq!(SLIP_RATE.number("3 m/min"), Some((0.05, true)));
    }

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
            let found = length(text).unwrap();
            assert_eq!(found, metres, "{text}");
        }
        for text in ["", "um", "-1e-6", "2 furlongs", "inf", "0"] {
            assert!(length(text).is_err(), "{text}");
        }
    }
}
