//! Checks that concern more than one key.

use tables::quantity::plausible;
use toml::{Table, Value};

use super::error::SceneFileError;
use super::source::Source;
use crate::scene::{Hardening, Rate, Scene, Softening, Switch};

/// Fracture data are given in one way: the shear fracture energy, the mode-II toughness, or both numbers
/// of a tensile test.
pub fn check_fracture(material: &Table, source: &Source) -> Result<(), SceneFileError> {
    let refuse =
        |key: &str, allowed: &str| Err(source.invalid(&format!("material.{key}"), &material[key], allowed));
    let ways = ["shear_fracture_energy", "fracture_toughness_mode_ii", "tensile_strength"];
    let given: Vec<&str> = ways.into_iter().filter(|key| material.contains_key(*key)).collect();
    if let [first, second, ..] = given[..] {
        return refuse(second, &format!("left out where {first} is given"));
    }
    match ["tensile_strength", "uniform_elongation"].map(|key| material.contains_key(key)) {
        [true, false] => Err(source.missing(
            "material.uniform_elongation",
            "given together with tensile_strength: zero or a positive number",
        )),
        [false, true] => refuse("uniform_elongation", "left out, or given together with tensile_strength"),
        _ => Ok(()),
    }
}

/// The material of a scene, at its initial temperature, and the softening of a film.
pub fn check_material(scene: &Scene, source: &Source) -> Result<(), SceneFileError> {
    let material = &scene.material;
    if let Hardening::Table { plastic_strain, factor } = &material.hardening
        && (plastic_strain[0], factor[0]) != (0.0, 1.0)
    {
        let found = format!("[{:?}, …], factor = [{:?}, …]", plastic_strain[0], factor[0]);
        let allowed = "a table that starts at plastic strain 0 with factor 1";
        return Err(source.invalid("material.hardening.plastic_strain", found, allowed));
    }
    for (section, softening) in scene.softenings() {
        if let Softening::JohnsonCook { reference, melting, .. } = softening
            && melting <= reference
        {
            let allowed = format!("a temperature above reference = {reference:?} K");
            return Err(source.invalid(&format!("{section}.melting"), format!("{melting:?}"), allowed));
        }
    }
    check_temperature(scene, "loading.temperature", scene.loading.temperature, source)?;
    if let Some(distance) = scene.loading.press_slip_distance
        && material.rate == Rate::None
    {
        let allowed =
            "left out without a rate law (material.rate): the press then does not depend on its time";
        return Err(source.invalid("loading.press_slip_distance", format!("{distance:?}"), allowed));
    }
    let modulus = material.youngs_modulus.value;
    if material.yield_strength >= modulus {
        let mut allowed = format!("below youngs_modulus = {modulus:?} (both in Pa)");
        if let Some(remark) = plausible::remark("material.youngs_modulus", modulus) {
            allowed = format!("{allowed}; {remark}");
        }
        let found = format!("{:?}", material.yield_strength);
        return Err(source.invalid("material.yield_strength", found, allowed));
    }
    Ok(())
}

/// Checks that the material of a scene has strength at the initial temperature given by `key`.
pub fn check_temperature(
    scene: &Scene,
    key: &str,
    temperature: f64,
    source: &Source,
) -> Result<(), SceneFileError> {
    if scene.interface.law.film_softening().factor(temperature) <= 0.0 {
        let allowed = "one at which the film has strength (interface.film_softening)";
        return Err(source.invalid(key, format!("{temperature:?}"), allowed));
    }
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
    Err(source.invalid(key, format!("{temperature:?}"), allowed))
}

/// Checks that heat is not switched on in the isothermal limit.
pub fn check_heat(scene: &Scene, slip_rates: &[f64], source: &Source) -> Result<(), SceneFileError> {
    match scene.model.heat == Switch::On && slip_rates.contains(&0.0) {
        true => {
            let allowed = "\"auto\" or \"off\" where the slip rate is 0, the isothermal limit";
            Err(source.invalid("model.heat", Value::from("on"), allowed))
        }
        false => Ok(()),
    }
}

/// Checks that a table of a strength that grows with the logarithm of the slip rate is not interpolated down to 0.
pub fn check_rates(scene: &Scene, slip_rates: &[f64], source: &Source) -> Result<(), SceneFileError> {
    match scene.material.rate != Rate::None && slip_rates.len() > 1 && slip_rates[0] == 0.0 {
        true => {
            let allowed = "without 0 where material.rate is given: the strength grows with the logarithm of the slip \
                           rate (m/s); give the smallest that is needed";
            Err(source.invalid("table.slip_rate", format!("{slip_rates:?}"), allowed))
        }
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Rate;
    use crate::scene::tests::{parse, request, sphere};

    #[test]
    fn mistakes_in_a_rate_law_are_named() {
        let refused = |preset: &str, rate: &str| {
            let text = format!("{}[loading]\ninterference = 20\nslip_rate = 1\n", sphere(preset));
            parse(&text, &[&format!("material.rate={rate}")]).unwrap_err()
        };
        for (rate, message) in [
            ("{ law = \"johnson-cook\", coefficient = -0.1 }", "zero or a positive number"),
            ("{ law = \"johnson-cook\", reference = 0 }", "a positive number (1/s)"),
            ("{ law = \"johnson-cook\", coeficient = 0.1 }", "did you mean coefficient?"),
            ("{ law = \"johnson\" }", "johnson-cook"),
            ("{ law = \"johnson\", slope = 1 }", "johnson-cook"),
            ("{ law = \"none\", coefficient = 0.1 }", "left out unless law = \"johnson-cook\""),
        ] {
            let error = refused("copper", rate);
            assert!(error.contains("material.rate") && error.contains(message), "{error}");
        }
        // A press within a time has no effect without one.
        let set = ["loading.press_slip_distance=1"];
        let text = format!("{}[loading]\ninterference = 20\nslip_rate = 1\n", sphere("copper"));
        let error = parse(&text, &set).unwrap_err();
        assert!(error.contains("left out without a rate law"), "{error}");
        // The standard has no rate law that the scene could take.
        let error = refused("carbon-steel-en1993", "{ law = \"johnson-cook\" }");
        assert!(error.contains("material.rate.coefficient is missing"), "{error}");
    }

    #[test]
    fn tables_with_a_rate_law_do_not_reach_down_to_slip_rate_0() {
        let of = |keys: &str| {
            let rate = "material.rate={ law = \"johnson-cook\" }";
            request(&format!("{}[table]\n{keys}\n", sphere("copper")), &[rate])
        };
        let request = of("").unwrap();
        assert_eq!(request.template.material.rate, Rate::JohnsonCook { coefficient: 0.025, reference: 1.0 });
        assert!(request.slip_rates[0] > 0.0);
        assert_eq!(request.template.loading.slip_rate, request.slip_rates[0]);
        let error = of("slip_rate = [0.0, 1.0]").unwrap_err();
        assert!(error.contains("table.slip_rate") && error.contains("without 0"), "{error}");
        assert!(of("slip_rate = [0.0]").is_ok() && of("slip_rate = [0.1, 1.0]").is_ok());
    }
}
