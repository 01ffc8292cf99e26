//! The sections of a scene but `[material]`, one function each, and the checks between them.

use super::error::SceneFileError;
use super::reader::{ACCURACY, NOT_NEGATIVE, Origin, POSITIVE, SHARE, Section};
use crate::interface::friction_law::{Entry, LAWS, Parameter, Value};
use crate::scene::{
    Control, ELEMENTS_PER_RADIUS, FrictionLaw, Interface, InterfaceStrength, Kinematics, Loading, Model,
    Numerics, Softening, Switch,
};

/// Section `[asperity]`: the radius, m.
pub(super) fn radius(root: &mut Section<'_>) -> Result<f64, SceneFileError> {
    root.take_section("asperity", &["radius"])?.number("radius", "m", POSITIVE, None)
}

/// Section `[interface]`.
pub(super) fn interface(root: &mut Section<'_>) -> Result<Interface, SceneFileError> {
    let mut known =
        vec!["law", "strength", "strength_factor", "heat_partition", "gap_conductance", "taylor_quinney"];
    known.extend(LAWS.iter().flat_map(|entry| entry.parameters).map(|parameter| parameter.key));
    let mut section = root.take_section("interface", &known)?;
    let strengths = [("initial", InterfaceStrength::Initial), ("current", InterfaceStrength::Current)];
    Ok(Interface {
        law: friction_law(&mut section)?,
        strength: section.choice("strength", &strengths, Some(InterfaceStrength::Initial))?,
        strength_factor: section.number("strength_factor", "1", POSITIVE, Some(1.0))?,
        heat_partition: section.number("heat_partition", "1", SHARE, Some(0.5))?,
        gap_conductance: section.number("gap_conductance", "W/(m2 K)", NOT_NEGATIVE, Some(0.0))?,
        taylor_quinney: section.number("taylor_quinney", "1", SHARE, Some(0.9))?,
    })
}

/// The law and its parameters; those of other laws are refused, as ignored silently they would look
/// as if they had been used.
fn friction_law(section: &mut Section<'_>) -> Result<FrictionLaw, SceneFileError> {
    let names: Vec<(&str, usize)> = LAWS.iter().enumerate().map(|(n, entry)| (entry.name, n)).collect();
    let entry = &LAWS[section.choice("law", &names, Some(0))?];
    let takes = |entry: &Entry, key: &str| entry.parameters.iter().any(|parameter| parameter.key == key);
    for parameter in LAWS.iter().flat_map(|other| other.parameters) {
        let key = parameter.key;
        if !takes(entry, key)
            && let Some(value) = section.take(key)
        {
            let takers = LAWS.iter().filter(|entry| takes(entry, key));
            let takers: Vec<String> = takers.map(|entry| format!("law = {:?}", entry.name)).collect();
            return Err(section.invalid(key, value, format!("left out unless {}", takers.join(" or "))));
        }
    }
    let value = |parameter: &Parameter| match parameter.default {
        Value::Flag(default) => section.flag(parameter.key, default).map(Value::Flag),
        Value::Number(default) => {
            let default = (!default.is_nan()).then_some(default);
            section.number(parameter.key, parameter.unit, NOT_NEGATIVE, default).map(Value::Number)
        }
    };
    let values: Result<Vec<Value>, SceneFileError> = entry.parameters.iter().map(value).collect();
    Ok(entry.build(&values?))
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
        // A table needs a slide for its histories, a single run does not.
        slip_distance: section.number(
            "slip_distance",
            "contact radii",
            if point.is_some() { POSITIVE } else { NOT_NEGATIVE },
            Some(2.0),
        )?,
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
        elements_per_radius: section
            .count("elements_per_radius", (*ELEMENTS_PER_RADIUS.start(), *ELEMENTS_PER_RADIUS.end(), 1))?,
        sectors: section.count("sectors", (4, 256, 4))?,
    })
}

/// Checks that concern more than one section.
pub(super) fn check_together(
    scene: &crate::scene::Scene,
    slip_rates: &[f64],
    origin: &Origin,
) -> Result<(), SceneFileError> {
    check_temperature(scene, "loading.temperature", scene.loading.temperature, origin)?;
    let material = &scene.material;
    if material.yield_strength >= material.youngs_modulus {
        return Err(origin.invalid(
            "material.yield_strength",
            format!("{:?}", material.yield_strength),
            format!("below youngs_modulus = {:?} (both in Pa)", material.youngs_modulus),
        ));
    }
    if scene.model.heat == Switch::On && slip_rates.contains(&0.0) {
        let allowed = "\"auto\" or \"off\" where the slip rate is 0, the isothermal limit";
        return Err(origin.invalid("model.heat", "\"on\"", allowed));
    }
    Ok(())
}

/// Whether the material of a scene has strength at the initial temperature that `key` says.
pub(super) fn check_temperature(
    scene: &crate::scene::Scene,
    key: &str,
    temperature: f64,
    origin: &Origin,
) -> Result<(), SceneFileError> {
    let softening = &scene.material.softening;
    let allowed = match softening {
        Softening::JohnsonCook { melting, .. } if temperature >= *melting => {
            format!("below material.softening.melting = {melting:?} K")
        }
        Softening::Table { .. } if softening.factor(temperature) <= 0.0 => {
            "one at which material.softening.factor is above 0".into()
        }
        _ => return Ok(()),
    };
    Err(origin.invalid(key, format!("{temperature:?}"), allowed))
}
