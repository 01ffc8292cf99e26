//! Processor time to expect of a run, from its scene alone, and of a refinement, from the run before it.
//!
//! The formula and its data are stated beside its constants, `scene::fitted_constants::processor_time`. Light contacts,
//! whose friction scatters more, and deep ones, whose G does, take finer meshes. Increments grow with the slip. Each step of a
//! programme takes as long as a slide.

use crate::heat::expected::{HeatEffect, choose_heat};
use crate::loading::problem::Problem;
use crate::scene::fitted_constants::processor_time::{
    COARSE_SHARE, CONDUCTION, DEEP, DEPTH_POWER, HOT_PROPERTIES, LEAST, LIGHT, MESH_POWER, MOST, MOST_SHEAR,
    NEWTON_ITERATION, PROPERTIES, REFERENCE_ACCURACY, REFERENCE_ELEMENTS, REFERENCE_SECTORS, REFERENCE_SLIP,
    SECONDS, SHEAR_DEPTH, SHEAR_POWER, SLIP_POWER, UNLIMITED_SHEAR,
};
use crate::scene::{FrictionLaw, Scene};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::steady::LONGEST;

/// Factor within which the expected time holds on the machine of the fit.
pub const EXPECTED_TIME_FACTOR: f64 = 3.0;
/// Processor time up to which a run is refined whatever time was expected, s.
pub const SHORT: f64 = 20.0;

/// Processor time of press, slide and auxiliary runs, s.
pub fn expected_time(scene: &Scene) -> f64 {
    (expected_time_but_for_hot_properties(scene) * of_hot_properties(scene)).min(MOST)
}

/// Factor for thermal properties that depend on temperature in a contact that is hot enough to melt at its full strength:
/// conduction then takes most of the time, and friction falls so far that a finer run follows.
fn of_hot_properties(scene: &Scene) -> f64 {
    let slip_rate = scene.loading.slip_rate;
    let radius = Problem::new(scene).expected_contact_radius() * scene.radius;
    let effect = HeatEffect::expected(scene, slip_rate, radius);
    let is_hot = choose_heat(scene, slip_rate, &effect).is_coupled() && effect.softening >= 1.0;
    if is_hot && has_variable_properties(scene) { HOT_PROPERTIES } else { 1.0 }
}

/// Processor time without the factor of hot properties, as in the time of a refinement from counts, [`time_of`].
pub(super) fn expected_time_but_for_hot_properties(scene: &Scene) -> f64 {
    let numerics = &scene.numerics;
    let interference = scene.loading.interference;
    let sectors = numerics.sectors.map_or(1.0, |sectors| (sectors as f64 / REFERENCE_SECTORS).max(1.0));
    let seconds = match numerics.elements_per_radius {
        Some(elements) => SECONDS * (elements as f64 / REFERENCE_ELEMENTS).powf(MESH_POWER),
        None if may_shear_without_limit(scene) => {
            let deeper = (interference / SHEAR_DEPTH).powf(SHEAR_POWER);
            return (UNLIMITED_SHEAR * deeper).clamp(UNLIMITED_SHEAR, MOST_SHEAR) * of_heat(scene);
        }
        None => {
            let chosen = Resolution::choose(numerics);
            let finer = time_ratio(&chosen.for_scatter(numerics, interference), &chosen);
            // A limit in proportion to the pressure is as small as the pressure of a light contact, which then slips smoothly.
            let is_coulomb = matches!(scene.interface.law, FrictionLaw::Coulomb { .. });
            let lighter = if is_coulomb { 1.0 } else { (LIGHT / interference).max(1.0) };
            let deeper = (interference / DEEP).max(1.0).powf(DEPTH_POWER);
            SECONDS * (REFERENCE_ACCURACY / numerics.accuracy).powi(2) * finer * lighter * deeper
        }
    };
    let longer = (scene.loading.slip_distance.min(LONGEST) / REFERENCE_SLIP).max(1.0).powf(SLIP_POWER);
    let steps = scene.loading.steps.len().max(1) as f64;
    ((seconds * sectors * longer).max(LEAST) * of_heat(scene) * steps).min(MOST)
}

fn has_variable_properties(scene: &Scene) -> bool {
    [&scene.material.specific_heat, &scene.material.thermal_conductivity]
        .iter()
        .any(|property| property.table.is_some())
}

/// Factor for heat that is more than linear conduction in the asperity.
fn of_heat(scene: &Scene) -> f64 {
    let counterface = if scene.counterface.conduction().is_some() { CONDUCTION } else { 1.0 };
    let properties = if has_variable_properties(scene) { PROPERTIES } else { 1.0 };
    counterface * properties
}

/// Processor time of a run that took so many Newton iterations, with its coarse run, s. From counts, so that what is
/// decided by it is the same on every machine.
pub fn time_of(newton: usize, unknowns: usize) -> f64 {
    (1.0 + COARSE_SHARE) * NEWTON_ITERATION * newton as f64 * unknowns as f64
}

/// Ratio of the times of runs at two resolutions.
pub fn time_ratio(finer: &Resolution, now: &Resolution) -> f64 {
    let elements = finer.elements_per_radius as f64 / now.elements_per_radius as f64;
    let sectors = finer.sectors as f64 / now.sectors as f64;
    elements.powf(MESH_POWER) * sectors * now.increment_growth / finer.increment_growth
}

/// Whether the body yields, does not harden, and is no stronger than the interface; decided again after the press.
fn may_shear_without_limit(scene: &Scene) -> bool {
    scene.material.hardening.plateau() == f64::INFINITY
        && scene.interface_as_strong()
        && scene.loading.interference > 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Numerics;
    use crate::scene::tests::{of_preset, parse};

    /// Preset, ω₀/ω_c, V in m/s, accuracy, and processor time in s.
    const MEASURED: [(&str, f64, f64, f64, f64); 39] = [
        ("steel-4340", 3.0, 0.3, 0.02, 0.83),
        ("steel-4340", 60.0, 7.0, 0.02, 1.2),
        ("steel-1045", 0.5, 2.0, 0.02, 0.84),
        ("steel-1045", 35.0, 0.0, 0.02, 0.75),
        ("steel-304", 8.0, 5.0, 0.02, 2.8),
        ("steel-304", 0.2, 1.0, 0.02, 2.2),
        ("aluminium-6061", 15.0, 3.0, 0.02, 1.2),
        ("aluminium-6061", 1.5, 10.0, 0.02, 0.99),
        ("copper", 25.0, 1.0, 0.02, 0.88),
        ("copper", 200.0, 6.0, 0.02, 3.8),
        ("steel-4340", 0.1, 0.5, 0.02, 1.8),
        ("steel-4340", 0.1, 0.5, 0.01, 20.6),
        ("steel-4340", 0.05, 0.5, 0.02, 8.8),
        ("steel-4340", 0.02, 0.5, 0.02, 15.0),
        ("steel-4340", 0.01, 0.5, 0.02, 23.0),
        ("copper", 0.03, 0.5, 0.02, 5.8),
        ("titanium-6al4v", 12.0, 0.7, 0.02, 2.1),
        ("titanium-6al4v", 45.0, 10.0, 0.02, 5.2),
        ("titanium-6al4v", 0.8, 8.0, 0.02, 1.9),
        ("steel-4340", 3.0, 0.3, 0.2, 0.38),
        ("steel-4340", 3.0, 0.3, 0.1, 0.40),
        ("steel-4340", 3.0, 0.3, 0.05, 0.40),
        ("steel-4340", 3.0, 0.3, 0.01, 2.9),
        ("steel-4340", 3.0, 0.3, 0.005, 16.0),
        ("aluminium-6061", 1.5, 10.0, 0.2, 0.41),
        ("aluminium-6061", 1.5, 10.0, 0.1, 0.42),
        ("aluminium-6061", 1.5, 10.0, 0.05, 0.42),
        ("aluminium-6061", 1.5, 10.0, 0.01, 3.2),
        ("aluminium-6061", 1.5, 10.0, 0.005, 20.5),
        ("steel-1045", 0.5, 2.0, 0.2, 0.27),
        ("steel-1045", 0.5, 2.0, 0.1, 0.29),
        ("steel-1045", 0.5, 2.0, 0.05, 0.37),
        ("steel-1045", 0.5, 2.0, 0.01, 2.7),
        ("steel-1045", 0.5, 2.0, 0.005, 16.0),
        ("copper", 60.0, 0.5, 0.2, 0.46),
        ("copper", 60.0, 0.5, 0.1, 0.46),
        ("copper", 60.0, 0.5, 0.05, 0.45),
        ("copper", 60.0, 0.5, 0.01, 3.1),
        ("copper", 60.0, 0.5, 0.005, 16.2),
    ];

    /// Preset, ω₀/ω_c, V in m/s, slip in contact radii, and processor time in s of `asperity run --threads 1`, divided by the
    /// ratio of the times of [`MEASURED`] on that machine to those stated, 3.3 in the median of ten.
    const SLIDES: [(&str, f64, f64, f64, f64); 22] = [
        ("aluminium-6061", 180.0, 3.0, 2.0, 2.1),
        ("aluminium-6061", 180.0, 3.0, 20.0, 3.0),
        ("copper", 10.0, 1.0, 2.0, 0.99),
        ("copper", 10.0, 1.0, 20.0, 1.1),
        ("copper", 400.0, 1.0, 2.0, 1.6),
        ("copper", 400.0, 1.0, 20.0, 2.1),
        ("steel-1045", 1.0, 3.0, 2.0, 1.3),
        ("steel-1045", 1.0, 3.0, 20.0, 1.3),
        ("steel-1045", 300.0, 0.5, 2.0, 2.2),
        ("steel-1045", 300.0, 0.5, 20.0, 2.2),
        ("steel-304", 700.0, 2.0, 2.0, 11.2),
        ("steel-304", 700.0, 2.0, 20.0, 14.2),
        ("steel-4340", 20.0, 10.0, 2.0, 1.1),
        ("steel-4340", 20.0, 10.0, 20.0, 1.7),
        ("steel-4340", 100.0, 3.0, 2.0, 2.9),
        ("steel-4340", 100.0, 3.0, 20.0, 4.1),
        ("steel-4340", 250.0, 0.0, 2.0, 1.5),
        ("steel-4340", 250.0, 0.0, 20.0, 1.8),
        ("titanium-6al4v", 5.0, 5.0, 2.0, 2.8),
        ("titanium-6al4v", 5.0, 5.0, 20.0, 5.7),
        ("titanium-6al4v", 90.0, 1.0, 2.0, 4.6),
        ("titanium-6al4v", 90.0, 1.0, 20.0, 6.8),
    ];

    /// ω₀/ω_c, V in m/s and processor time in s of a bronze that does not harden (E 110 GPa, σ_Y 350 MPa); from 60 ω_c on the
    /// slides end early, as the elements are distorted.
    const UNHARDENED: [(f64, f64, f64); 9] = [
        (3.0, 0.5, 0.56),
        (3.0, 3.0, 0.65),
        (10.0, 0.5, 0.95),
        (10.0, 3.0, 1.2),
        (30.0, 0.5, 1.7),
        (30.0, 3.0, 2.4),
        (60.0, 3.0, 7.2),
        (120.0, 3.0, 6.2),
        (250.0, 3.0, 3.9),
    ];

    /// Asserts that a measured time, s, is within the stated factor of the expected one.
    fn assert_expected(scene: &Scene, seconds: f64) {
        let ratio = expected_time(scene) / seconds;
        let within = (1.0 / EXPECTED_TIME_FACTOR..=EXPECTED_TIME_FACTOR).contains(&ratio);
        assert!(within, "expected over measured {ratio}, {seconds} s: {scene:?}");
    }

    #[test]
    fn measured_times_are_within_the_stated_factor() {
        const BRONZE: &str = "youngs_modulus = 110e9\npoisson_ratio = 0.34\nyield_strength = 350e6\n\
                              thermal_conductivity = 60.0\nspecific_heat = 380.0\ndensity = 8800.0\n\
                              thermal_expansion = 1.8e-5";
        let bronze = UNHARDENED.map(|(omega, rate, seconds)| (BRONZE.to_owned(), omega, rate, 0.02, seconds));
        let presets = MEASURED.map(|(preset, omega, rate, accuracy, seconds)| {
            (format!("preset = \"{preset}\""), omega, rate, accuracy, seconds)
        });
        for (material, interference, slip_rate, accuracy, seconds) in bronze.into_iter().chain(presets) {
            let text = format!(
                "[material]\n{material}\n[asperity]\nradius = 1e-3\n[loading]\n\
                 interference = {interference:?}\nslip_rate = {slip_rate:?}\n[numerics]\naccuracy = {accuracy:?}\n"
            );
            assert_expected(&parse(&text, &[]).unwrap(), seconds);
        }
    }

    #[test]
    fn measured_times_of_long_slides_are_within_the_stated_factor() {
        for (preset, interference, slip_rate, slip, seconds) in SLIDES {
            let loading = [("interference", interference), ("slip_rate", slip_rate), ("slip_distance", slip)];
            let set = loading.map(|(key, value)| format!("loading.{key}={value:?}"));
            assert_expected(&of_preset(preset, &set.each_ref().map(String::as_str)), seconds);
        }
    }

    /// A programme of six steps beside a conducting counterface, at two accuracies, and of seven steps without one.
    #[test]
    fn measured_times_of_programmes_are_within_the_stated_factor() {
        let contact = "counterface.preset=\"steel-1045\"";
        let seven = "loading.steps=[{ slip_rate = 1e-2, slip_distance = 0.5 }, { slip_rate = 1.0, slip_distance = 1.0 }, \
                     { slip_rate = 1e-2, slip_distance = 0.2 }, { slip_rate = 1.0, slip_distance = 0.5 }, { hold = 1e-3 }, \
                     { slip_rate = 1.0, slip_distance = 0.5 }, { slip_rate = -1.0, slip_distance = 1.0 }]";
        let six = "loading.steps=[{ slip_rate = 1e-2, slip_distance = 1 }, { slip_rate = 10.0, slip_distance = 1 }, \
                   { hold = 1e-6 }, { slip_rate = 10.0, slip_distance = 0.5 }, { hold = 10 }, \
                   { slip_rate = -1.0, slip_distance = 1.0 }]";
        for (steps, counterface, accuracy, seconds) in [
            (six, contact, 0.05, 6.2),
            (six, contact, 0.02, 11.8),
            (seven, "asperity.radius=1e-3", 0.05, 2.0),
        ] {
            let accuracy = format!("numerics.accuracy={accuracy}");
            let scene = of_preset("steel-4340", &[steps, counterface, "loading.interference=10", &accuracy]);
            assert_expected(&scene, seconds);
        }
    }

    /// Cast iron on a ceramic at 8 ω_c, at an accuracy of 0.1: R in m, V in m/s, what is changed, and processor time in s.
    #[test]
    fn measured_times_of_hot_contacts_are_within_the_stated_factor() {
        const IRON: &str = "
            material = { youngs_modulus = 118e9, poisson_ratio = 0.26, yield_strength = 310e6, density = 7150.0, \
            thermal_expansion = 1.1e-5, hardening = { law = \"johnson-cook\", modulus = 620e6, exponent = 0.35 }, \
            softening = { law = \"johnson-cook\", reference = 293.0, melting = 1450.0, exponent = 0.9 }, \
            specific_heat = { temperature = [293.0, 800.0], value = [490.0, 680.0] }, \
            thermal_conductivity = { temperature = [293.0, 800.0], value = [52.0, 38.0] } }
            interface = { law = \"briscoe-tabor\", film_strength = 60e6, pressure_coefficient = 0.08, film_softening = \
            { law = \"table\", temperature = [300.0, 600.0, 900.0, 1200.0], factor = [1.0, 0.85, 0.4, 0.1] } }
            counterface = { youngs_modulus = 330e9, poisson_ratio = 0.17, density = 2650.0, specific_heat = 800.0, \
            thermal_conductivity = 40.0, contact_conductance = 2e8 }
            loading = { interference = 8.0, slip_rate = 5.0, temperature = 420.0 }
            numerics = { accuracy = 0.1 }
            asperity = { radius = 60e-6 }";
        const CONSTANT: [&str; 2] = ["material.specific_heat=490", "material.thermal_conductivity=52"];
        for (radius, slip_rate, change, seconds) in [
            (60e-6, 5.0, &[][..], 1.2),
            (3e-3, 5.0, &[], 1.5),
            (0.05, 5.0, &[], 3.1),
            (0.005, 50.0, &[], 2.8),
            (0.05, 50.0, &[], 7.4),
            (0.05, 50.0, &CONSTANT, 2.9),
        ] {
            let loading = [format!("asperity.radius={radius}"), format!("loading.slip_rate={slip_rate}")];
            let set = [&loading.each_ref().map(String::as_str)[..], change].concat();
            assert_expected(&parse(IRON, &set).unwrap(), seconds);
        }
    }

    /// Twice as many elements, angles or increments.
    #[test]
    fn refinements_take_longer_by_their_resolution() {
        let numerics = Numerics { accuracy: 0.02, elements_per_radius: Some(10), sectors: Some(4) };
        let now = Resolution::choose(&numerics);
        let ratio = |finer: Resolution| time_ratio(&finer, &now);
        assert!((ratio(now.shorter_steps(2)) - 2.0).abs() < 1e-12);
        assert!((ratio(now.other_sectors()) - 2.0).abs() < 1e-12);
        assert!((ratio(now.finer_mesh(2)) - 2f64.powf(MESH_POWER)).abs() < 1e-12);
        // Titanium at 40 ω_c and 10 m/s took 3.3 s with its auxiliary runs.
        let ratio = time_of(608, 17_472) / 3.3;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }

    /// 4340 steel with Coulomb friction of 0.3 at 1 m/s: ω₀/ω_c and processor time in s.
    #[test]
    fn measured_times_of_light_contacts_with_coulomb_friction_are_within_the_stated_factor() {
        for (interference, seconds) in [(0.01, 4.4), (0.1, 3.8), (0.5, 1.2)] {
            let interference = format!("loading.interference={interference}");
            let law = ["interface.law=coulomb", "interface.friction=0.3", &interference];
            assert_expected(&of_preset("steel-4340", &law), seconds);
        }
    }

    /// The fixed mesh decides alone; twice the angles take twice the time.
    #[test]
    fn a_fixed_mesh_costs_the_same_at_any_accuracy() {
        let time = |change: &str| {
            let mesh = "numerics.elements_per_radius=20";
            expected_time(&of_preset("copper", &["loading.interference=5", mesh, change]))
        };
        assert_eq!(time("numerics.accuracy=0.02"), time("numerics.accuracy=0.001"));
        assert_eq!(time("numerics.sectors=16"), 2.0 * time("numerics.sectors=8"));
        assert_eq!(time("counterface.preset=\"copper\""), CONDUCTION * time("numerics.sectors=4"));
    }
}
