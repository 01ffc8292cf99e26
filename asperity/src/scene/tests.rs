//! A scene at another initial temperature is the same body.

use super::*;
use crate::scene::file::{Request, parse_request, parse_scene, write_scene};

/// The scene of a text with other values by key, or the message.
pub(crate) fn parse(text: &str, changes: &[&str]) -> Result<Scene, String> {
    let changes: Vec<String> = changes.iter().map(|change| change.to_string()).collect();
    parse_scene(text, "scene.toml", &changes).map_err(|error| error.to_string())
}

/// The request of a text with other values by key, or the message.
pub(crate) fn request(text: &str, changes: &[&str]) -> Result<Request, String> {
    let changes: Vec<String> = changes.iter().map(|change| change.to_string()).collect();
    parse_request(text, "request.toml", &changes).map_err(|error| error.to_string())
}

/// The sections of a shipped material on a sphere of 1 mm.
pub(crate) fn sphere(preset: &str) -> String {
    format!("[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n")
}

/// A shipped material on a sphere of 1 mm at 20 ω_c and 1 m/s, with other values by key.
pub(crate) fn of_preset(preset: &str, changes: &[&str]) -> Scene {
    let loading = "[loading]\ninterference = 20\nslip_rate = 1\n";
    parse(&format!("{}{loading}", sphere(preset)), changes).unwrap()
}

/// That a scene, written and read, is the same; returns the text.
pub(crate) fn assert_written_is_read(scene: &Scene) -> String {
    let text = write_scene(scene);
    assert_eq!(parse(&text, &[]).as_ref(), Ok(scene), "{text}");
    text
}

/// At 300 K, with properties over temperature.
fn scene(softening: &str, hardening: &str) -> Scene {
    let text = format!(
        "[material]\npreset = \"carbon-steel-en1993\"\nsoftening = {{ {softening} }}\n\
         hardening = {{ {hardening} }}\n[asperity]\nradius = 1e-3\n\
         [loading]\ninterference = 5\nslip_rate = 1\ntemperature = 300\n"
    );
    parse(&text, &[]).unwrap()
}

const SOFTENINGS: [&str; 4] = [
    "law = \"none\"",
    "law = \"johnson-cook\", reference = 298, melting = 1793, exponent = 0.8",
    "law = \"johnson-cook\", reference = 500, melting = 1793, exponent = 1.03",
    "law = \"table\", temperature = [250, 400, 900], factor = [1.1, 0.9, 0.2]",
];
const HARDENINGS: [&str; 4] = [
    "law = \"none\"",
    "law = \"linear\", modulus = 1e9",
    "law = \"johnson-cook\", modulus = 5e8, exponent = 0.3",
    "law = \"table\", plastic_strain = [0, 0.1], factor = [1, 1.4]",
];

/// [σ_Y + h(ε_p)] f(T)/f(T₀), Pa, at an absolute temperature.
fn strength(scene: &Scene, strain: f64, temperature: f64) -> f64 {
    let Material { yield_strength, hardening, softening, .. } = &scene.material;
    let hardened = match hardening {
        Hardening::None => *yield_strength,
        Hardening::Linear { modulus } => yield_strength + modulus * strain,
        Hardening::JohnsonCook { modulus, exponent } => yield_strength + modulus * strain.powf(*exponent),
        Hardening::Table { plastic_strain, factor } => {
            yield_strength * tables::functions::interpolate(plastic_strain, factor, strain).0
        }
    };
    hardened * softening.factor(temperature) / softening.factor(scene.loading.temperature)
}

#[test]
fn strength_and_moduli_are_the_same_functions_of_absolute_temperature() {
    for softening in SOFTENINGS {
        for hardening in HARDENINGS {
            let cold = scene(softening, hardening);
            for initial in [280.0, 450.0, 850.0] {
                let hot = cold.at_temperature(initial);
                for temperature in [260.0, 300.0, 470.0, 700.0, 1000.0] {
                    for strain in [0.0, 0.02, 0.3] {
                        let [one, other] = [&cold, &hot].map(|scene| strength(scene, strain, temperature));
                        let what = format!("{softening} {hardening} {initial} {temperature}: {one} {other}");
                        assert!((one - other).abs() < 1e-12 * cold.material.yield_strength, "{what}");
                    }
                }
            }
        }
    }
}

#[test]
fn at_its_own_temperature_a_scene_is_itself() {
    for softening in SOFTENINGS {
        let scene = scene(softening, HARDENINGS[2]);
        assert_eq!(scene.at_temperature(300.0), scene);
        // By way of another temperature, but for rounding.
        let (direct, detour) =
            (scene.at_temperature(700.0), scene.at_temperature(420.0).at_temperature(700.0));
        let [one, other] = [&direct, &detour].map(|scene| scene.material.yield_strength);
        assert!((one / other - 1.0).abs() < 1e-14);
        let rest = |scene: &Scene| {
            let mut scene = scene.clone();
            (scene.material.yield_strength, scene.material.hardening) = (0.0, Hardening::None);
            scene
        };
        assert_eq!(rest(&direct), rest(&detour));
    }
}

#[test]
fn constants_are_those_at_the_temperature() {
    let cold = scene(SOFTENINGS[1], HARDENINGS[2]);
    let hot = cold.at_temperature(800.0);
    let ratio = hot.material.softening.factor(800.0) / hot.material.softening.factor(300.0);
    assert!(ratio < 0.7);
    assert_eq!(hot.material.yield_strength, cold.material.yield_strength * ratio);
    assert_eq!(hot.material.hardening, Hardening::JohnsonCook { modulus: 5e8 * ratio, exponent: 0.3 });
    let at_800 = |property: &Property| property.table.as_ref().unwrap().at(800.0);
    assert_eq!(hot.material.youngs_modulus.value, at_800(&cold.material.youngs_modulus));
    assert!(hot.material.youngs_modulus.value < cold.material.youngs_modulus.value);
    assert_eq!(hot.material.specific_heat.value, at_800(&cold.material.specific_heat));
    assert_eq!((hot.radius, &hot.interface), (cold.radius, &cold.interface));
}
