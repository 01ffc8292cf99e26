//! Materials with published constants: every constant with its unit and its source.
//!
//! One file per material in this folder. To add a material, add its file; the tests check that it
//! is complete and that every constant names a source.

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::scene::{Counterface, Material, TemperatureTable};

// FILES: name and content of each material file, by name; made by build.rs.
include!(concat!(env!("OUT_DIR"), "/presets.rs"));

/// A number, the points of a law, or a property over temperature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ConstantValue {
    Number(f64),
    List(Vec<f64>),
    /// Temperatures in K.
    Table(TemperatureTable),
}

/// One constant of a preset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// Key below `[material]`, as in `hardening.modulus`.
    #[serde(skip)]
    pub key: String,
    /// Value in `unit`.
    pub value: ConstantValue,
    /// SI unit; "1" for a pure number.
    pub unit: String,
    /// The publication that gives the value.
    pub source: String,
}

/// A material with published constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// Name as written in `material.preset`.
    pub name: &'static str,
    /// Designation and condition.
    pub title: String,
    /// Which constants were compared with which other source.
    pub checked: String,
    /// [`REQUIRED`] constants first.
    pub constants: Vec<Constant>,
    /// Laws of hardening, softening and, where it is known, strain rate: (`hardening`, `softening` or `rate`, name of the
    /// law).
    pub laws: Vec<(String, String)>,
}

impl Preset {
    /// Whether a material has the yield strength and the density of this preset.
    pub fn has_strength_of(&self, material: &Material) -> bool {
        self.number("yield_strength") == Some(material.yield_strength)
            && self.number("density") == Some(material.density)
    }

    /// Whether a material has the yield strength and the density of this preset, with rounded values of yield strength and
    /// hardening modulus.
    pub fn has_strength_near(&self, material: &Material) -> bool {
        const ROUNDING: f64 = 0.006;
        let near =
            |key: &str, value: f64| self.number(key).filter(|exact| (value / exact - 1.0).abs() <= ROUNDING);
        let modulus = material.hardening.clone().modulus_mut().map(|modulus| *modulus);
        let hardens_alike = modulus.is_none_or(|modulus| near("hardening.modulus", modulus).is_some());
        let strength = near("yield_strength", material.yield_strength).filter(|_| hardens_alike);
        strength.is_some_and(|yield_strength| {
            self.has_strength_of(&Material { yield_strength, ..material.clone() })
        })
    }

    /// The yield strength, Pa, if a counterface that conducts has the constants of this preset.
    pub(crate) fn strength_of(&self, counterface: &Counterface) -> Option<f64> {
        let (own, given) = (self.section(), Table::try_from(counterface).expect("plain data"));
        let keys = ["density", "specific_heat", "thermal_conductivity"];
        let alike = keys.into_iter().all(|key| own.get(key) == given.get(key));
        self.number("yield_strength").filter(|_| alike)
    }

    /// A constant that is one number.
    fn number(&self, key: &str) -> Option<f64> {
        match self.constants.iter().find(|constant| constant.key == key)?.value {
            ConstantValue::Number(value) => Some(value),
            _ => None,
        }
    }

    /// The section `[material]` of this preset; a scene takes `rate` from it only where it names that law.
    pub fn section(&self) -> Table {
        let mut section = Table::new();
        for (group, law) in &self.laws {
            let law = [("law".to_owned(), Value::from(law.as_str()))];
            section.insert(group.clone(), Value::Table(law.into_iter().collect()));
        }
        for constant in &self.constants {
            let value = Value::try_from(&constant.value).expect("plain data");
            match constant.key.split_once('.') {
                None => section.insert(constant.key.clone(), value),
                Some((group, key)) => {
                    section[group].as_table_mut().and_then(|law| law.insert(key.into(), value))
                }
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
pub fn find(name: &str) -> Option<&'static Preset> {
    all().iter().find(|preset| preset.name == name)
}

/// Names of all presets.
pub fn names() -> Vec<&'static str> {
    FILES.iter().map(|&(name, _)| name).collect()
}

/// Constants that every material has, in the order in which they are listed.
pub const REQUIRED: [&str; 7] = [
    "youngs_modulus",
    "poisson_ratio",
    "yield_strength",
    "density",
    "specific_heat",
    "thermal_conductivity",
    "thermal_expansion",
];

/// A material file: below the texts, constants and laws of constants.
#[derive(Deserialize)]
struct PresetFile {
    title: String,
    checked: String,
    #[serde(flatten)]
    entries: Table,
}

fn parse(name: &'static str, text: &str) -> Result<Preset, toml::de::Error> {
    let PresetFile { title, checked, entries } = toml::from_str(text)?;
    let (mut constants, mut laws) = (Vec::new(), Vec::new());
    for (key, value) in entries {
        match value {
            Value::Table(members) if members.contains_key("law") => {
                for (member, value) in members {
                    match value {
                        Value::String(law) => laws.push((key.clone(), law)),
                        value => constants.push(constant(format!("{key}.{member}"), value)?),
                    }
                }
            }
            value => constants.push(constant(key, value)?),
        }
    }
    constants.sort_by_key(|constant| {
        REQUIRED.iter().position(|key| constant.key == *key).unwrap_or(REQUIRED.len())
    });
    Ok(Preset { name, title, checked, constants, laws })
}

/// A constant of a material file. A property over temperature has the keys `temperature` and `value` of a scene file, beside
/// its unit and source.
fn constant(key: String, mut entry: Value) -> Result<Constant, toml::de::Error> {
    if let Value::Table(members) = &mut entry
        && let Some(temperature) = members.remove("temperature")
    {
        let mut points = Table::from_iter([("temperature".to_owned(), temperature)]);
        points.extend(members.remove("value").map(|value| ("value".to_owned(), value)));
        members.insert("value".to_owned(), Value::Table(points));
    }
    Ok(Constant { key, ..entry.try_into()? })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::scene::Rate;
    use crate::scene::tests::of_preset;

    #[test]
    fn every_constant_has_a_unit_and_a_source() {
        for preset in all() {
            let laws = |group: &str| preset.laws.iter().filter(|(of, _)| of == group).count();
            let rate = usize::from(preset.name != "carbon-steel-en1993");
            assert_eq!(["hardening", "softening", "rate"].map(laws), [1, 1, rate], "{}", preset.name);
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
    fn a_preset_lends_its_rate_law_to_a_scene_that_names_it() {
        let rate = |changes: &[&str]| of_preset("copper", changes).material.rate;
        let law = |coefficient| Rate::JohnsonCook { coefficient, reference: 1.0 };
        assert_eq!(rate(&[]), Rate::None);
        assert_eq!(rate(&["material.rate={ law = \"johnson-cook\" }"]), law(0.025));
        assert_eq!(rate(&["material.rate={ law = \"johnson-cook\", coefficient = 0.01 }"]), law(0.01));
    }

    #[test]
    fn steel_4340_has_the_constants_of_johnson_and_cook_1985() {
        let preset = find("steel-4340").unwrap();
        assert_eq!(preset.number("yield_strength"), Some(792e6));
        assert_eq!(preset.number("hardening.modulus"), Some(510e6));
        assert_eq!(preset.number("hardening.exponent"), Some(0.26));
        assert_eq!(preset.number("softening.exponent"), Some(1.03));
        assert_eq!(preset.number("softening.melting"), Some(1793.0));
    }

    /// At 20 °C.
    pub fn carbon_steel() -> crate::scene::Material {
        of_preset("carbon-steel-en1993", &["loading.temperature=293.15"]).material
    }

    /// Worked values of EN 1993-1-2: c(20 °C) = 440, k(20 °C) = 53.3, α of 3.4.1.1 and Table 3.1.
    #[test]
    fn carbon_steel_has_the_values_of_en_1993_1_2_at_20_degrees() {
        let steel = carbon_steel();
        assert!((steel.specific_heat.value - 439.8018).abs() < 0.05);
        assert!((steel.thermal_conductivity.value - 53.334).abs() < 1e-9);
        assert_eq!((steel.youngs_modulus.value, steel.yield_strength, steel.density), (210e9, 355e6, 7850.0));
        assert!((steel.thermal_expansion.value - 1.216e-5).abs() < 1e-12);
    }

    /// The standard's formulas, 3.4.1.1 to 3.4.1.3, against the tables of the preset.
    #[test]
    fn carbon_steel_follows_the_formulas_of_en_1993_1_2() {
        let steel = carbon_steel();
        let capacity = |t: f64| match t {
            t if t < 600.0 => 425.0 + t * (0.773 + t * (-1.69e-3 + 2.22e-6 * t)),
            t if t < 735.0 => 666.0 + 13002.0 / (738.0 - t),
            t if t < 900.0 => 545.0 + 17820.0 / (t - 731.0),
            _ => 650.0,
        };
        let conductivity = |t: f64| if t < 800.0 { 54.0 - 3.33e-2 * t } else { 27.3 };
        let (c, k) = (steel.specific_heat.table.unwrap(), steel.thermal_conductivity.table.unwrap());
        for i in 0..11_800 {
            let t = 20.0 + 0.1 * i as f64 + 0.05;
            assert!((c.at(t + 273.15) / capacity(t) - 1.0).abs() < 0.01, "c({t})");
            assert!((k.at(t + 273.15) / conductivity(t) - 1.0).abs() < 1e-6, "k({t})");
        }
        // Elongation from 20 °C: 3.4.1.1, whose fall of 8.4e-6 at 750 °C is left out.
        let alpha = steel.thermal_expansion.table.unwrap().over_rise(293.15);
        for (t, elongation) in [
            (400.0, 1.2e-5 * 400.0 + 0.4e-8 * 400.0f64.powi(2) - 2.416e-4),
            (750.0, 1.1e-2 + 8.4e-6),
            (860.0, 1.1e-2 + 8.4e-6),
            (1200.0, 2e-5 * 1200.0 - 6.2e-3 + 8.4e-6),
        ] {
            assert!((alpha.integral(t - 20.0) - elongation).abs() < 1e-9, "{t}: {elongation}");
        }
        // Table 3.1, with the linear interpolation that it prescribes.
        let e = steel.youngs_modulus.table.unwrap();
        for (t, factor) in [(100.0, 1.0), (250.0, 0.85), (550.0, 0.455), (700.0, 0.13), (1100.0, 0.0225)] {
            assert!((e.at(t + 273.15) / 210e9 - factor).abs() < 1e-9, "k_E({t})");
        }
    }
}
