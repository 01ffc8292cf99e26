//! The sections of a scene, one function each, and the checks between them.

use toml::{Table, Value};

use super::error::{SceneFileError, hint};
use super::reader::{ACCURACY, NOT_NEGATIVE, Origin, POISSON, POSITIVE, SHARE, Section};
use crate::presets;
use crate::scene::{
    Control, FrictionLaw, Hardening, Interface, InterfaceStrength, Kinematics, Loading, Material, Model,
    Numerics, Softening, Switch,
};

const MATERIAL: [&str; 10] = [
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
    let optional = ["preset", "hardening", "softening"];
    let missing: Vec<&str> =
        MATERIAL.into_iter().filter(|key| !optional.contains(key) && !section.has(key)).collect();
    if !missing.is_empty() {
        let names = presets::names().join(", ");
        let allowed = format!("given, or preset one of {names}");
        return Err(section.missing(&missing.join(", "), allowed));
    }
    let material = Material {
        youngs_modulus: section.number("youngs_modulus", "Pa", POSITIVE, None)?,
        poisson_ratio: section.number("poisson_ratio", "1", POISSON, None)?,
        yield_strength: section.number("yield_strength", "Pa", POSITIVE, None)?,
        density: section.number("density", "kg/m3", POSITIVE, None)?,
        specific_heat: section.number("specific_heat", "J/(kg K)", POSITIVE, None)?,
        thermal_conductivity: section.number("thermal_conductivity", "W/(m K)", POSITIVE, None)?,
        // Zero switches expansion off.
        thermal_expansion: section.number("thermal_expansion", "1/K", NOT_NEGATIVE, None)?,
        hardening: hardening(&mut section)?,
        softening: softening(&mut section)?,
    };
    if material.yield_strength >= material.youngs_modulus {
        return Err(section.invalid(
            "yield_strength",
            format!("{:?}", material.yield_strength),
            format!("below youngs_modulus = {:?} (both in Pa)", material.youngs_modulus),
        ));
    }
    Ok(material)
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
    rule: super::reader::Rule,
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

/// Section `[asperity]`: the radius, m.
pub(super) fn radius(root: &mut Section<'_>) -> Result<f64, SceneFileError> {
    root.take_section("asperity", &["radius"])?.number("radius", "m", POSITIVE, None)
}

/// Section `[interface]`.
pub(super) fn interface(root: &mut Section<'_>) -> Result<Interface, SceneFileError> {
    #[derive(Clone, Copy, PartialEq)]
    enum Law {
        ShearStrength,
        Coulomb,
        FullStick,
        Frictionless,
    }
    let known = [
        "law",
        "strength",
        "strength_factor",
        "heat_partition",
        "gap_conductance",
        "taylor_quinney",
        "friction",
        "cap",
    ];
    let mut section = root.take_section("interface", &known)?;
    let laws = [
        ("shear-strength", Law::ShearStrength),
        ("coulomb", Law::Coulomb),
        ("full-stick", Law::FullStick),
        ("frictionless", Law::Frictionless),
    ];
    let law = section.choice("law", &laws, Some(Law::ShearStrength))?;
    for key in ["friction", "cap"] {
        // Ignored silently, it would look as if it had been used.
        if law != Law::Coulomb && section.has(key) {
            let value = section.take(key).expect("checked");
            return Err(section.invalid(key, value, "left out unless law = \"coulomb\""));
        }
    }
    let strengths = [("initial", InterfaceStrength::Initial), ("current", InterfaceStrength::Current)];
    Ok(Interface {
        strength: section.choice("strength", &strengths, Some(InterfaceStrength::Initial))?,
        law: match law {
            Law::ShearStrength => FrictionLaw::ShearStrength,
            Law::Coulomb => FrictionLaw::Coulomb {
                friction: section.number("friction", "1", NOT_NEGATIVE, Some(0.3))?,
                cap: section.flag("cap", true)?,
            },
            Law::FullStick => FrictionLaw::FullStick,
            Law::Frictionless => FrictionLaw::Frictionless,
        },
        strength_factor: section.number("strength_factor", "1", POSITIVE, Some(1.0))?,
        heat_partition: section.number("heat_partition", "1", SHARE, Some(0.5))?,
        gap_conductance: section.number("gap_conductance", "W/(m2 K)", NOT_NEGATIVE, Some(0.0))?,
        taylor_quinney: section.number("taylor_quinney", "1", SHARE, Some(0.9))?,
    })
}

/// Section `[loading]`; a request has interference and slip rate in `[table]` instead, whose
/// first points are `point`.
pub(super) fn loading(root: &mut Section<'_>, point: Option<(f64, f64)>) -> Result<Loading, SceneFileError> {
    let known = ["interference", "slip_rate", "slip_distance", "control", "temperature"];
    let mut section = root.take_section("loading", &known)?;
    if point.is_some() {
        for key in ["interference", "slip_rate"] {
            if let Some(value) = section.take(key) {
                let allowed = format!("left out of a request, which has table.{key}");
                return Err(section.invalid(key, value, allowed));
            }
        }
    }
    let controls = [("interference", Control::Interference), ("load", Control::Load)];
    Ok(Loading {
        interference: section.number(
            "interference",
            "omega_0/omega_c",
            POSITIVE,
            point.map(|(interference, _)| interference),
        )?,
        slip_rate: section.number(
            "slip_rate",
            "m/s, 0 is the isothermal limit",
            NOT_NEGATIVE,
            point.map(|(_, slip_rate)| slip_rate),
        )?,
        slip_distance: section.number("slip_distance", "contact radii", POSITIVE, Some(2.0))?,
        control: section.choice("control", &controls, Some(Control::Interference))?,
        temperature: section.number("temperature", "K", POSITIVE, Some(298.0))?,
    })
}

/// Section `[model]`.
pub(super) fn model(root: &mut Section<'_>) -> Result<Model, SceneFileError> {
    let mut section = root.take_section("model", &["heat", "kinematics"])?;
    let switches = [("auto", Switch::Auto), ("on", Switch::On), ("off", Switch::Off)];
    let kinematics =
        [("auto", Kinematics::Auto), ("small", Kinematics::Small), ("finite", Kinematics::Finite)];
    Ok(Model {
        heat: section.choice("heat", &switches, Some(Switch::Auto))?,
        kinematics: section.choice("kinematics", &kinematics, Some(Kinematics::Auto))?,
    })
}

/// Section `[numerics]`.
pub(super) fn numerics(root: &mut Section<'_>) -> Result<Numerics, SceneFileError> {
    let known = ["accuracy", "elements_per_radius", "sectors"];
    let mut section = root.take_section("numerics", &known)?;
    Ok(Numerics {
        accuracy: section.number("accuracy", "1", ACCURACY, Some(0.02))?,
        // The upper limits catch slips of the pen before they exhaust the memory.
        elements_per_radius: section.count("elements_per_radius", (4, 256, 1))?,
        sectors: section.count("sectors", (4, 256, 4))?,
    })
}

/// Checks that concern more than one section.
pub(super) fn check_together(
    scene: &crate::scene::Scene,
    slip_rates: &[f64],
    origin: &Origin,
) -> Result<(), SceneFileError> {
    let temperature = scene.loading.temperature;
    if let Softening::JohnsonCook { melting, .. } = scene.material.softening
        && temperature >= melting
    {
        let allowed = format!("below material.softening.melting = {melting:?} K");
        return Err(origin.invalid("loading.temperature", format!("{temperature:?}"), allowed));
    }
    if scene.model.heat == Switch::On && slip_rates.contains(&0.0) {
        let allowed = "\"auto\" or \"off\" where the slip rate is 0, the isothermal limit";
        return Err(origin.invalid("model.heat", "\"on\"", allowed));
    }
    Ok(())
}
