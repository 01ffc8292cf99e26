//! Materials that come with the program: every constant with its unit and its source.
//!
//! One file per material beside this one. To add a material, add its file and its line in
//! `FILES`; the tests check that it is complete and that every constant names a source.

use std::sync::OnceLock;

use toml::{Table, Value};

/// Name and data of every preset, in the order in which they are listed.
const FILES: [(&str, &str); 6] = [
    ("steel-4340", include_str!("steel-4340.toml")),
    ("steel-1045", include_str!("steel-1045.toml")),
    ("steel-304", include_str!("steel-304.toml")),
    ("aluminium-6061", include_str!("aluminium-6061.toml")),
    ("copper", include_str!("copper.toml")),
    ("titanium-6al4v", include_str!("titanium-6al4v.toml")),
];

/// One constant of a preset.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Key below `[material]`, as in `hardening.modulus`.
    pub key: String,
    /// In `unit`.
    pub value: f64,
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
            let value = Value::Float(constant.value);
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

/// All presets.
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

/// Names of all presets, in the order in which they are listed.
pub fn names() -> Vec<&'static str> {
    FILES.iter().map(|&(name, _)| name).collect()
}

/// Order in which constants are listed; what is not named here follows.
const ORDER: [&str; 7] = [
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
    let title = match table.remove("title") {
        Some(Value::String(title)) => title,
        _ => return Err("no title".into()),
    };
    let mut preset = Preset { name, title, constants: Vec::new(), laws: Vec::new() };
    for key in ORDER {
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
        value: value.get("value").and_then(Value::as_float).ok_or(format!("{key}: no value"))?,
        unit: text("unit")?,
        source: text("source")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file;

    #[test]
    fn every_constant_has_a_unit_and_a_source() {
        for preset in all() {
            assert_eq!(preset.laws.len(), 2, "{}", preset.name);
            assert_eq!(preset.constants.len(), 12, "{}", preset.name);
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
            for (constant, first) in preset.constants.iter().zip(&all()[0].constants) {
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
            scene_file::parse_scene(&text, "scene.toml", &[]).unwrap();
        }
    }

    #[test]
    fn steel_4340_has_the_constants_of_johnson_and_cook_1985() {
        let preset = find("steel-4340").unwrap();
        let value = |key: &str| preset.constants.iter().find(|c| c.key == key).unwrap().value;
        assert_eq!(value("yield_strength"), 792e6);
        assert_eq!(value("hardening.modulus"), 510e6);
        assert_eq!(value("hardening.exponent"), 0.26);
        assert_eq!(value("softening.exponent"), 1.03);
        assert_eq!(value("softening.melting"), 1793.0);
    }
}
