//! Section `[counterface]` as in a file: a preset, and the choice between elastic and rigid, become constants.

use tables::quantity::hint;
use toml::{Table, Value};

use super::check::as_number;
use super::error::SceneFileError;
use super::source::Source;
use crate::scene::TemperatureTable;
use crate::scene::loading::default_temperature;
use crate::scene::presets::{self, Preset};

const ELASTIC: [&str; 2] = ["youngs_modulus", "poisson_ratio"];
const CONDUCTING: [&str; 3] = ["thermal_conductivity", "density", "specific_heat"];
/// Constants that may vary with temperature; others of a preset are those at the initial one.
const MAY_VARY: [&str; 2] = ["thermal_conductivity", "specific_heat"];
const EXPANSION: &str = "thermal_expansion";
/// Keys that a counterface has only if it conducts.
const IF_IT_CONDUCTS: [&str; 2] = [EXPANSION, "contact_conductance"];

/// Removes the key `preset` of a section.
pub fn take_preset(
    path: &str,
    section: &mut Table,
    source: &Source,
) -> Result<Option<&'static Preset>, SceneFileError> {
    let Some(name) = section.remove("preset") else {
        return Ok(None);
    };
    match name.as_str().and_then(presets::find) {
        Some(preset) => Ok(Some(preset)),
        None => {
            let hint = hint(name.as_str().unwrap_or_default(), &presets::names());
            let allowed = format!("the name of a material; {hint}");
            Err(source.invalid(&format!("{path}.preset"), name, allowed))
        }
    }
}

/// Replaces the keys `preset` and `elastic` of the section `[counterface]` by constants, and checks that these are complete.
pub fn resolve_counterface(sections: &mut Table, source: &Source) -> Result<(), SceneFileError> {
    let temperature =
        sections.get("loading").and_then(|loading| loading.get("temperature")).and_then(as_number);
    let conductance =
        sections.get("interface").and_then(|interface| interface.get("gap_conductance")).cloned();
    let Some(Value::Table(section)) = sections.get_mut("counterface") else {
        return Ok(());
    };
    let elastic = section.remove("elastic");
    if let Some(preset) = take_preset("counterface", section, source)? {
        let mut constants = preset.section();
        for key in ELASTIC.into_iter().chain(CONDUCTING).chain([EXPANSION]) {
            let value = constants.remove(key).expect("every preset has it");
            let value = match value.clone().try_into::<TemperatureTable>() {
                Ok(table) if !MAY_VARY.contains(&key) => {
                    Value::Float(table.at(temperature.unwrap_or(default_temperature())))
                }
                _ => value,
            };
            section.entry(key).or_insert(value);
        }
    }
    let missing = |keys: &[&'static str], section: &Table| {
        keys.iter().find(|key| !section.contains_key(**key)).copied()
    };
    let path = |key: &str| format!("counterface.{key}");
    match elastic {
        None => {}
        Some(Value::Boolean(false)) => ELASTIC.into_iter().for_each(|key| {
            section.remove(key);
        }),
        Some(Value::Boolean(true)) => {
            if let Some(key) = missing(&ELASTIC, section) {
                return Err(source.missing(path(key), "given, or a preset, where elastic = true"));
            }
        }
        Some(value) => return Err(source.invalid(&path("elastic"), value, "true or false")),
    }
    for keys in [&ELASTIC[..], &CONDUCTING] {
        if let (Some(key), true) = (missing(keys, section), keys.iter().any(|key| section.contains_key(*key)))
        {
            return Err(source.missing(path(key), format!("given together with {}", keys.join(", "))));
        }
    }
    let conducts = missing(&CONDUCTING, section).is_none();
    if let Some((key, value)) = IF_IT_CONDUCTS.iter().find_map(|key| Some((key, section.get(*key)?)))
        && !conducts
    {
        let allowed = format!("left out unless {} are given", CONDUCTING.join(", "));
        return Err(source.invalid(&path(key), value, allowed));
    }
    if section.get(EXPANSION).and_then(as_number) == Some(0.0) {
        section.remove(EXPANSION);
    }
    match conductance {
        Some(value) if conducts && as_number(&value).is_some_and(|value| value > 0.0) => {
            let allowed = "0 where the counterface conducts; its key is counterface.contact_conductance";
            Err(source.invalid("interface.gap_conductance", value, allowed))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Counterface;
    use crate::scene::tests::{assert_written_is_read, parse, sphere};

    fn read(section: &str) -> Result<Counterface, String> {
        let sphere = sphere("steel-4340");
        let text = format!("{sphere}[loading]\ninterference = 20\nslip_rate = 1\n{section}\n");
        let scene = parse(&text, &[])?;
        assert_written_is_read(&scene);
        Ok(scene.counterface)
    }

    #[test]
    fn a_preset_is_elastic_and_conducts() {
        let steel = read("[counterface]\npreset = \"steel-4340\"").unwrap();
        assert_eq!((steel.youngs_modulus, steel.poisson_ratio), (Some(205e9), Some(0.29)));
        assert_eq!(steel.conduction(), Some([44.5, 7850.0 * 475.0]));
        assert!(steel.contact_conductance.is_infinite());
        assert_eq!(steel.thermal_expansion, Some(1.23e-5));
        let rigid = read(
            "[counterface]\npreset = \"steel-4340\"\nelastic = false\ndensity = 8000\nthermal_expansion = 0",
        )
        .unwrap();
        assert_eq!((rigid.youngs_modulus, rigid.thermal_expansion), (None, None));
        assert_eq!(rigid.conduction(), Some([44.5, 8000.0 * 475.0]));
        assert!(read("").unwrap().is_absent());
        // Tables over temperature have their value at 298 K; those of k and c stay.
        let carbon = read("[counterface]\npreset = \"carbon-steel-en1993\"").unwrap();
        assert!((carbon.thermal_conductivity.as_ref().unwrap().value - 53.17).abs() < 0.01);
        assert!(carbon.to_string().ends_with(", with temperature: specific_heat and thermal_conductivity"));
        let table = "{ temperature = [300, 500], value = [10, 20] }";
        let constants = "density = 2\nspecific_heat = 3\n";
        let varying = read(&format!("[counterface]\nthermal_conductivity = {table}\n{constants}")).unwrap();
        assert_eq!(varying.conduction(), Some([10.0, 6.0]));
        let constants = "thermal_conductivity = 1\ndensity = 2\nspecific_heat = 3\n";
        let some = read(&format!("[counterface]\n{constants}contact_conductance = 1e6")).unwrap();
        assert_eq!((some.conduction(), some.contact_conductance), (Some([1.0, 6.0]), 1e6));
        assert!(read(&format!("[counterface]\n{constants}contact_conductance = inf")).is_ok());
    }

    #[test]
    fn incomplete_and_contradictory_sections_are_refused() {
        for (section, parts) in [
            ("preset = \"steel\"", ["counterface.preset", "steel-"]),
            ("youngs_modulus = 2e11", ["counterface.poisson_ratio", "given together with"]),
            ("density = 1\nspecific_heat = 1", ["counterface.thermal_conductivity", "given together with"]),
            ("elastic = true", ["counterface.youngs_modulus", "elastic = true"]),
            ("elastic = 1", ["counterface.elastic", "true or false"]),
            ("contact_conductance = 1e6", ["counterface.contact_conductance", "left out unless"]),
            ("thermal_expansion = 1e-5", ["counterface.thermal_expansion", "left out unless"]),
            (
                "preset = \"copper\"\ncontact_conductance = 0",
                ["contact_conductance", "a positive number or inf"],
            ),
            (
                "preset = \"copper\"\n[interface]\ngap_conductance = 5",
                ["interface.gap_conductance", "0 where"],
            ),
            ("melting = 1", ["counterface.melting", "unknown key"]),
        ] {
            let message = read(&format!("[counterface]\n{section}")).unwrap_err();
            assert!(parts.iter().all(|part| message.contains(part)), "{message}");
        }
    }
}
