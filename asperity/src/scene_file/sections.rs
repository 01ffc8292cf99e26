//! The sections of a scene but `[material]`, one function each, and the checks between them.

use super::error::SceneFileError;
use super::reader::{ACCURACY, NOT_NEGATIVE, Origin, POSITIVE, SHARE, Section};
use crate::curve::interpolate;
use crate::scene::{
    Control, FrictionLaw, Interface, InterfaceStrength, Kinematics, Loading, Model, Numerics, Softening,
    Switch,
};

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
    let bad_temperature =
        |allowed: String| Err(origin.invalid("loading.temperature", format!("{temperature:?}"), allowed));
    match &scene.material.softening {
        Softening::JohnsonCook { melting, .. } if temperature >= *melting => {
            return bad_temperature(format!("below material.softening.melting = {melting:?} K"));
        }
        Softening::Table { temperature: knots, factor }
            if interpolate(knots, factor, temperature).0 <= 0.0 =>
        {
            return bad_temperature("one at which material.softening.factor is above 0".into());
        }
        _ => {}
    }
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
