//! Materials that come with the program: every constant with its unit and its source.
//!
//! One file per material beside this one. To add a material, add its file; the tests check that it
//! is complete and that every constant names a source.

use std::sync::OnceLock;

use toml::{Table, Value};

use crate::scene::TemperatureTable;

// FILES: name and content of each material file, by name; made by build.rs.
include!(concat!(env!("OUT_DIR"), "/presets.rs"));

/// A number, a list of a law's points, or a property over temperature.
#[derive(Clone, Debug, PartialEq)]
pub enum ConstantValue {
    Number(f64),
    List(Vec<f64>),
    /// Temperatures in K.
    Table(TemperatureTable),
}

/// One constant of a preset.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Key below `[material]`, as in `hardening.modulus`.
    pub key: String,
    /// In `unit`.
    pub value: ConstantValue,
    /// SI unit; "1" for a pure number.
    pub unit: String,
    /// The publication that gives the value.
    pub source: String,
}

/// A material with published constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// As written in `material.preset`.
    pub name: &'static str,
    /// Designation and condition.
    pub title: String,
    /// Which constants were compared with what, other than their source.
    pub checked: String,
    /// Constants in the order of the file.
    pub constants: Vec<Constant>,
    /// Laws of hardening and softening: (`hardening` or `softening`, name of the law).
    pub laws: Vec<(String, String)>,
}

impl Preset {
    /// The section `[material]` that this preset stands for.
    pub fn section(&self) -> Table {
        let mut section = Table::new();
        for (group, law) in &self.laws {
            let mut table = Table::new();
            table.insert("law".into(), Value::String(law.clone()));
            section.insert(group.clone(), Value::Table(table));
        }
        for constant in &self.constants {
            let value = constant.value.as_toml();
            match constant.key.split_once('.') {
                None => section.insert(constant.key.clone(), value),
                Some((group, key)) => match section.get_mut(group) {
                    Some(Value::Table(table)) => table.insert(key.into(), value),
                    _ => None,
                },
            };
        }
        section
    }
}

/// All presets, by name.
pub fn all() -> &'static [Preset] {
    static PRESETS: OnceLock<Vec<Preset>> = OnceLock::new();
    PRESETS.get_or_init(|| {
        let read = |&(name, text): &(&'static str, &str)| {
            parse(name, text).unwrap_or_else(|error| panic!("preset {name}: {error}"))
        };
        FILES.iter().map(read).collect()
    })
}

/// The preset called `name`.
///
/// ```
/// let steel = asperity::scene::presets::find("steel-4340").unwrap();
/// let strength = steel.constants.iter().find(|constant| constant.key == "yield_strength").unwrap();
/// assert!(strength.source.contains("Johnson & Cook 1985"));
/// assert!(asperity::scene::presets::find("unobtainium").is_none());
/// ```
pub fn find(name: &str) -> Option<&'static Preset> {
    all().iter().find(|preset| preset.name == name)
}

/// Names of all presets.
pub fn names() -> Vec<&'static str> {
    FILES.iter().map(|&(name, _)| name).collect()
}

/// Constants that every material has, in the order in which they are listed; others follow.
pub const REQUIRED: [&str; 7] = [
    "youngs_modulus",
    "poisson_ratio",
    "yield_strength",
    "density",
    "specific_heat",
    "thermal_conductivity",
    "thermal_expansion",
];

fn parse(name: &'static str, text: &str) -> Result<Preset, String> {
    let mut table: Table = text.parse().map_err(|error| format!("{error}"))?;
    let mut text = |key: &str| match table.remove(key) {
        Some(Value::String(text)) => Ok(text),
        _ => Err(format!("no {key}")),
    };
    let (title, checked) = (text("title")?, text("checked")?);
    let mut preset = Preset { name, title, checked, constants: Vec::new(), laws: Vec::new() };
    for key in REQUIRED {
        let value = table.remove(key).ok_or(format!("no {key}"))?;
        preset.constants.push(constant(key, &value)?);
    }
    for (group, value) in table {
        let Value::Table(members) = value else {
            return Err(format!("{group} is not a law"));
        };
        for (key, value) in &members {
            match value {
                Value::String(law) if key == "law" => preset.laws.push((group.clone(), law.clone())),
                value => {
                    let key = format!("{group}.{key}");
                    preset.constants.push(constant(&key, value)?);
                }
            }
        }
    }
    Ok(preset)
}

fn constant(key: &str, value: &Value) -> Result<Constant, String> {
    let text = |member: &str| {
        let found = value.get(member).and_then(Value::as_str);
        found.map(str::to_owned).ok_or(format!("{key}: no {member}"))
    };
    Ok(Constant {
        key: key.to_owned(),
        value: constant_value(value).ok_or(format!("{key}: no value"))?,
        unit: text("unit")?,
        source: text("source")?,
    })
}

fn constant_value(constant: &Value) -> Option<ConstantValue> {
    let list =
        |value: &Value| -> Option<Vec<f64>> { value.as_array()?.iter().map(Value::as_float).collect() };
    let value = constant.get("value")?;
    Some(match (value, constant.get("temperature")) {
        (Value::Float(number), None) => ConstantValue::Number(*number),
        (value, None) => ConstantValue::List(list(value)?),
        (value, Some(temperature)) => {
            ConstantValue::Table(TemperatureTable { temperature: list(temperature)?, value: list(value)? })
        }
    })
}

impl ConstantValue {
    /// As in a scene.
    fn as_toml(&self) -> Value {
        let list = |numbers: &[f64]| Value::Array(numbers.iter().copied().map(Value::Float).collect());
        match self {
            Self::Number(number) => Value::Float(*number),
            Self::List(numbers) => list(numbers),
            Self::Table(TemperatureTable { temperature, value }) => {
                let columns = [("temperature", temperature), ("value", value)];
                Value::Table(
                    columns.map(|(key, numbers)| (key.to_owned(), list(numbers))).into_iter().collect(),
                )
            }
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::scene::file;

    #[test]
    fn every_constant_has_a_unit_and_a_source() {
        for preset in all() {
            assert_eq!(preset.laws.len(), 2, "{}", preset.name);
            assert!(!preset.checked.is_empty());
            for constant in &preset.constants {
                assert!(!constant.unit.is_empty(), "{} {}", preset.name, constant.key);
                // A citation has a year.
                let digits = constant.source.chars().filter(char::is_ascii_digit).count();
                assert!(digits >= 4, "{} {}", preset.name, constant.key);
            }
        }
    }

    #[test]
    fn units_of_a_key_agree_between_materials() {
        for preset in all() {
            for (constant, first) in preset.constants.iter().zip(&all()[0].constants).take(REQUIRED.len()) {
                assert_eq!(constant.key, first.key);
                assert_eq!(constant.unit, first.unit);
            }
        }
    }

    #[test]
    fn every_preset_makes_a_valid_scene() {
        for name in names() {
            let text = format!(
                "[material]\npreset = \"{name}\"\n[asperity]\nradius = 1e-3\n\
                 [loading]\ninterference = 20\nslip_rate = 1\n"
            );
            file::parse_scene(&text, "scene.toml", &[]).unwrap();
        }
    }

    #[test]
    fn steel_4340_has_the_constants_of_johnson_and_cook_1985() {
        let preset = find("steel-4340").unwrap();
        let value = |key: &str| preset.constants.iter().find(|c| c.key == key).unwrap().value.clone();
        assert_eq!(value("yield_strength"), ConstantValue::Number(792e6));
        assert_eq!(value("hardening.modulus"), ConstantValue::Number(510e6));
        assert_eq!(value("hardening.exponent"), ConstantValue::Number(0.26));
        assert_eq!(value("softening.exponent"), ConstantValue::Number(1.03));
        assert_eq!(value("softening.melting"), ConstantValue::Number(1793.0));
    }

    /// At 20 °C.
    pub fn carbon_steel() -> crate::scene::Material {
        let text = "[material]\npreset = \"carbon-steel-en1993\"\n[asperity]\nradius = 1e-3\n\
                    [loading]\ninterference = 20\nslip_rate = 1\ntemperature = 293.15\n";
        file::parse_scene(text, "scene.toml", &[]).unwrap().material
    }

    /// Worked values of EN 1993-1-2: c(20 °C) = 440, k(20 °C) = 53.3, α of 3.4.1.1 and Table 3.1.
    #[test]
    fn carbon_steel_has_the_values_of_en_1993_1_2_at_20_degrees() {
        let steel = carbon_steel();
        assert!((steel.specific_heat - 439.8018).abs() < 0.05);
        assert!((steel.thermal_conductivity - 53.334).abs() < 1e-9);
        assert_eq!((steel.youngs_modulus, steel.yield_strength, steel.density), (210e9, 355e6, 7850.0));
        assert!((steel.thermal_expansion - 1.216e-5).abs() < 1e-12);
    }

    /// The standard's formulas, 3.4.1.1 to 3.4.1.3, beside the tables of the preset.
    #[test]
    fn carbon_steel_follows_the_formulas_of_en_1993_1_2() {
        let tables = carbon_steel().dependence;
        let capacity = |t: f64| match t {
            t if t < 600.0 => 425.0 + t * (0.773 + t * (-1.69e-3 + 2.22e-6 * t)),
            t if t < 735.0 => 666.0 + 13002.0 / (738.0 - t),
            t if t < 900.0 => 545.0 + 17820.0 / (t - 731.0),
            _ => 650.0,
        };
        let conductivity = |t: f64| if t < 800.0 { 54.0 - 3.33e-2 * t } else { 27.3 };
        let (c, k) = (tables.specific_heat.unwrap(), tables.thermal_conductivity.unwrap());
        for i in 0..11_800 {
            let t = 20.0 + 0.1 * i as f64 + 0.05;
            assert!((c.at(t + 273.15) / capacity(t) - 1.0).abs() < 0.01, "c({t})");
            assert!((k.at(t + 273.15) / conductivity(t) - 1.0).abs() < 1e-6, "k({t})");
        }
        // Elongation from 20 °C: 3.4.1.1, whose fall of 8.4e-6 at 750 °C is left out.
        let alpha = tables.thermal_expansion.unwrap().over_rise(293.15);
        for (t, elongation) in [
            (400.0, 1.2e-5 * 400.0 + 0.4e-8 * 400.0f64.powi(2) - 2.416e-4),
            (750.0, 1.1e-2 + 8.4e-6),
            (860.0, 1.1e-2 + 8.4e-6),
            (1200.0, 2e-5 * 1200.0 - 6.2e-3 + 8.4e-6),
        ] {
            assert!((alpha.integral(t - 20.0) - elongation).abs() < 1e-9, "{t}: {elongation}");
        }
        // Table 3.1, with the linear interpolation that it prescribes.
        let e = tables.youngs_modulus.unwrap();
        for (t, factor) in [(100.0, 1.0), (250.0, 0.85), (550.0, 0.455), (700.0, 0.13), (1100.0, 0.0225)] {
            assert!((e.at(t + 273.15) / 210e9 - factor).abs() < 1e-9, "k_E({t})");
        }
    }
}
