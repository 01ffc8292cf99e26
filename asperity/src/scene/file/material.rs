//! Section `[material]`: presets, properties over temperature, laws of hardening and softening.

use toml::{Table, Value};

use super::error::{SceneFileError, hint};
use super::reader::{NOT_NEGATIVE, POISSON, POSITIVE, Rule, Section, as_number};
use crate::scene::presets;
use crate::scene::{FractureData, Hardening, Material, Softening, TemperatureDependence, TemperatureTable};

const MATERIAL: [&str; 14] = [
    "preset",
    "youngs_modulus",
    "poisson_ratio",
    "yield_strength",
    "hardening",
    "density",
    "specific_heat",
    "thermal_conductivity",
    "thermal_expansion",
    "softening",
    "shear_fracture_energy",
    "fracture_toughness_mode_ii",
    "tensile_strength",
    "uniform_elongation",
];

/// Keys that may be left out.
const OPTIONAL: [&str; 7] = [
    "preset",
    "hardening",
    "softening",
    "shear_fracture_energy",
    "fracture_toughness_mode_ii",
    "tensile_strength",
    "uniform_elongation",
];

/// Section `[material]`: the preset, if any, with the given keys laid over it.
pub(super) fn material(root: &mut Section<'_>) -> Result<Material, SceneFileError> {
    let mut given = root.take_section("material", &MATERIAL)?;
    let mut table = preset(&mut given)?;
    for key in MATERIAL {
        match (given.take(key), table.get_mut(key)) {
            (Some(Value::Table(over)), Some(Value::Table(base))) => lay_over(base, over),
            (Some(value), _) => {
                table.insert(key.into(), value);
            }
            (None, _) => {}
        }
    }
    let mut section = Section::new("material", table, &MATERIAL, given.origin())?;
    let missing: Vec<&str> =
        MATERIAL.into_iter().filter(|key| !OPTIONAL.contains(key) && !section.has(key)).collect();
    if !missing.is_empty() {
        let names = presets::names().join(", ");
        let allowed = format!("given, or preset one of {names}");
        return Err(section.missing(&missing.join(", "), allowed));
    }
    let mut dependence = TemperatureDependence::default();
    // Zero switches expansion off.
    let mut property = |key: &str, unit: &str, rule: Rule| property(&mut section, key, unit, rule);
    let (youngs_modulus, table) = property("youngs_modulus", "Pa", POSITIVE)?;
    dependence.youngs_modulus = table;
    let (specific_heat, table) = property("specific_heat", "J/(kg K)", POSITIVE)?;
    dependence.specific_heat = table;
    let (thermal_conductivity, table) = property("thermal_conductivity", "W/(m K)", POSITIVE)?;
    dependence.thermal_conductivity = table;
    let (thermal_expansion, table) = property("thermal_expansion", "1/K", NOT_NEGATIVE)?;
    dependence.thermal_expansion = table;
    Ok(Material {
        youngs_modulus,
        specific_heat,
        thermal_conductivity,
        thermal_expansion,
        dependence,
        poisson_ratio: section.number("poisson_ratio", "1", POISSON, None)?,
        yield_strength: section.number("yield_strength", "Pa", POSITIVE, None)?,
        density: section.number("density", "kg/m3", POSITIVE, None)?,
        hardening: hardening(&mut section)?,
        softening: softening(&mut section)?,
        fracture: fracture(&mut section)?,
    })
}

/// A number, or a table over temperature; of a table the first value, until the initial temperature
/// is known.
fn property(
    section: &mut Section<'_>,
    key: &str,
    unit: &str,
    rule: Rule,
) -> Result<(f64, Option<TemperatureTable>), SceneFileError> {
    let allowed = format!("{}, or {{ temperature = [… K], value = […] }}", rule.with_unit(unit));
    match section.take(key) {
        Some(Value::Table(table)) => {
            let known = ["temperature", "value"];
            let mut points = Section::new(section.full(key), table, &known, section.origin())?;
            let temperature = points.numbers("temperature", "K", NOT_NEGATIVE)?;
            let bad_pair = temperature.windows(2).find(|pair| pair[1] < pair[0]);
            let bad_three = temperature.windows(3).find(|three| three[0] == three[2]);
            if let Some(bad) = bad_pair.or(bad_three) {
                let allowed = "a list that does not fall; two equal temperatures make a jump";
                return Err(points.invalid("temperature", format!("[… {bad:?} …]"), allowed));
            }
            let value = points.numbers("value", unit, rule)?;
            if value.len() != temperature.len() {
                let allowed = format!("as long as temperature ({})", temperature.len());
                return Err(points.invalid("value", format!("{} numbers", value.len()), allowed));
            }
            Ok((value[0], Some(TemperatureTable { temperature, value })))
        }
        Some(value) => match as_number(&value) {
            Some(number) if rule.accepts(number) => Ok((number, None)),
            _ => Err(section.invalid(key, value, allowed)),
        },
        None => Err(section.missing(key, allowed)),
    }
}

/// The preset's section, empty without a preset.
fn preset(given: &mut Section<'_>) -> Result<Table, SceneFileError> {
    match given.take("preset") {
        None => Ok(Table::new()),
        Some(value) => match value.as_str().and_then(presets::find) {
            Some(preset) => Ok(preset.section()),
            None => {
                let hint = hint(value.as_str().unwrap_or_default(), &presets::names());
                Err(given.invalid("preset", value, format!("the name of a material; {hint}")))
            }
        },
    }
}

/// Keys of `over` replace those of `base`; another law replaces the whole.
fn lay_over(base: &mut Table, over: Table) {
    if over.get("law").is_some_and(|law| base.get("law") != Some(law)) {
        base.clear();
    }
    base.extend(over);
}

/// The law's name, checked before its keys are, since they depend on it.
fn law_name(
    parent: &Section<'_>,
    table: &Value,
    group: &str,
    laws: &[&str],
) -> Result<String, SceneFileError> {
    let quoted: Vec<String> = laws.iter().map(|law| format!("{law:?}")).collect();
    let allowed = format!("one of {}", quoted.join(", "));
    let key = format!("{group}.law");
    match table.get("law") {
        Some(Value::String(law)) if laws.contains(&law.as_str()) => Ok(law.clone()),
        Some(value) => Err(parent.invalid(&key, value, allowed)),
        None if table.is_table() => Err(parent.missing(&key, allowed)),
        None => Err(parent.invalid(group, table, format!("{{ law = … }}, {allowed}"))),
    }
}

fn law_section<'a>(
    parent: &Section<'a>,
    group: &str,
    table: Value,
    known: &[&str],
) -> Result<Section<'a>, SceneFileError> {
    let Value::Table(table) = table else {
        return Err(parent.invalid(group, table, "{ law = … }"));
    };
    Section::new(parent.full(group), table, known, parent.origin())
}

fn hardening(material: &mut Section<'_>) -> Result<Hardening, SceneFileError> {
    let Some(table) = material.take("hardening") else {
        return Ok(Hardening::None);
    };
    let laws = ["none", "linear", "johnson-cook", "table"];
    let law = law_name(material, &table, "hardening", &laws)?;
    let open = |known: &[&str]| law_section(material, "hardening", table.clone(), known);
    Ok(match law.as_str() {
        "linear" => Hardening::Linear {
            modulus: open(&["law", "modulus"])?.number("modulus", "Pa", NOT_NEGATIVE, None)?,
        },
        "johnson-cook" => {
            let mut section = open(&["law", "modulus", "exponent"])?;
            Hardening::JohnsonCook {
                modulus: section.number("modulus", "Pa", NOT_NEGATIVE, None)?,
                exponent: section.number("exponent", "1", POSITIVE, None)?,
            }
        }
        "table" => {
            let mut section = open(&["law", "plastic_strain", "factor"])?;
            let (plastic_strain, factor) = curve(&mut section, "plastic_strain", "1", POSITIVE)?;
            if (plastic_strain[0], factor[0]) != (0.0, 1.0) {
                return Err(section.invalid(
                    "plastic_strain",
                    format!("[{:?}, …], factor = [{:?}, …]", plastic_strain[0], factor[0]),
                    "a table that starts at plastic strain 0 with factor 1",
                ));
            }
            Hardening::Table { plastic_strain, factor }
        }
        _ => open(&["law"]).map(|_| Hardening::None)?,
    })
}

/// One of: the shear fracture energy, the mode-II toughness, both numbers of a tensile test.
fn fracture(material: &mut Section<'_>) -> Result<Option<FractureData>, SceneFileError> {
    let ways = ["shear_fracture_energy", "fracture_toughness_mode_ii", "tensile_strength"];
    let given: Vec<&str> = ways.into_iter().filter(|key| material.has(key)).collect();
    if let [first, second, ..] = given[..] {
        let value = material.take(second).expect("given");
        return Err(material.invalid(second, value, format!("left out where {first} is given")));
    }
    if !material.has("tensile_strength") && material.has("uniform_elongation") {
        let value = material.take("uniform_elongation").expect("given");
        let allowed = "left out, or given together with tensile_strength";
        return Err(material.invalid("uniform_elongation", value, allowed));
    }
    Ok(match given.first() {
        Some(&key @ "shear_fracture_energy") => {
            Some(FractureData::Energy(material.number(key, "J/m2", POSITIVE, None)?))
        }
        Some(&key @ "fracture_toughness_mode_ii") => {
            Some(FractureData::Toughness(material.number(key, "Pa sqrt(m)", POSITIVE, None)?))
        }
        Some(&key) => Some(FractureData::Tensile {
            strength: material.number(key, "Pa", POSITIVE, None)?,
            uniform_elongation: material.number("uniform_elongation", "1", NOT_NEGATIVE, None)?,
        }),
        None => None,
    })
}

fn softening(material: &mut Section<'_>) -> Result<Softening, SceneFileError> {
    let Some(table) = material.take("softening") else {
        return Ok(Softening::None);
    };
    let law = law_name(material, &table, "softening", &["none", "johnson-cook", "table"])?;
    let open = |known: &[&str]| law_section(material, "softening", table.clone(), known);
    Ok(match law.as_str() {
        "johnson-cook" => {
            let mut section = open(&["law", "reference", "melting", "exponent"])?;
            let reference = section.number("reference", "K", POSITIVE, None)?;
            let melting = section.number("melting", "K", POSITIVE, None)?;
            if melting <= reference {
                let allowed = format!("a temperature above reference = {reference:?} K");
                return Err(section.invalid("melting", format!("{melting:?}"), allowed));
            }
            Softening::JohnsonCook {
                reference,
                melting,
                exponent: section.number("exponent", "1", POSITIVE, None)?,
            }
        }
        "table" => {
            let mut section = open(&["law", "temperature", "factor"])?;
            let (temperature, factor) = curve(&mut section, "temperature", "K", NOT_NEGATIVE)?;
            Softening::Table { temperature, factor }
        }
        _ => open(&["law"]).map(|_| Softening::None)?,
    })
}

/// A curve given by points: a rising list of abscissae and as many factors that obey `rule`.
fn curve(
    section: &mut Section<'_>,
    key: &str,
    unit: &str,
    rule: Rule,
) -> Result<(Vec<f64>, Vec<f64>), SceneFileError> {
    let abscissae = section.rising(key, unit, NOT_NEGATIVE)?;
    let factors = section.numbers("factor", "1", rule)?;
    if factors.len() != abscissae.len() {
        return Err(section.invalid(
            "factor",
            format!("{} numbers", factors.len()),
            format!("as long as {key} ({})", abscissae.len()),
        ));
    }
    Ok((abscissae, factors))
}
