//! Errors of a press, and presses within a time.

use super::*;
use crate::scene::tests::of_preset;
use crate::simulate::Unwatched;

/// Over strain rates far above the reference the factor of the strength is nearly constant, and the press that of a stronger
/// material.
#[test]
fn a_press_within_a_time_is_that_of_the_strength_at_its_strain_rate() {
    const C: f64 = 0.01;
    let mesh = ["model.kinematics=small", "numerics.elements_per_radius=6", "loading.slip_rate=1"];
    let of = |interference: f64, set: &[&str]| {
        let mut scene = of_preset("copper", &[&mesh[..], set].concat());
        scene.loading.interference = interference;
        scene
    };
    let load = |scene: &Scene| press(scene, &Unwatched).unwrap().contact().load.value;
    let rate = "material.rate={ law = \"johnson-cook\", coefficient = 0.01, reference = 1e-30 }";
    let within = of(100.0, &[rate, "loading.press_slip_distance=1"]);
    let still = load(&of(100.0, &[]));
    assert_eq!(load(&of(100.0, &[rate])), still);
    // ε̇ of 0.1 V/a.
    let radius = Problem::new(&within).expected_contact_radius() * within.radius;
    let factor = 1.0 + C * (0.1 / radius / 1e-30f64).ln();
    let mut stronger = of(100.0 / factor.powi(2), &[]);
    let modulus = stronger.material.hardening.modulus_mut().map(|modulus| *modulus *= factor);
    assert!(modulus.is_some());
    stronger.material.yield_strength *= factor;
    let (found, expected) = (load(&within), load(&stronger));
    assert!(expected > 1.3 * still, "{expected} {still}");
    assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected} {still}");
}

#[test]
fn the_errors_of_a_press_are_known_on_the_mesh_of_the_main_run() {
    let mut scene = of_preset("copper", &["model.kinematics=small", "numerics.elements_per_radius=6"]);
    (scene.loading.interference, scene.loading.slip_rate) = (2.0, 0.0);
    let pressed = press(&scene, &Unwatched).unwrap();
    let PressedContact { load, area, .. } = pressed.contact();
    let known = |quantity| pressed.relative_error(quantity, &pressed.resolution);
    assert_eq!(known(Quantity::LoadPress), Some(load.error / load.value));
    assert_eq!(known(Quantity::AreaPress), Some(area.error / area.value));
    assert_eq!(known(Quantity::ContactRadius), Some(0.5 * area.error / area.value));
    assert_eq!(known(Quantity::Load), None);
    assert_eq!(pressed.relative_error(Quantity::LoadPress, &pressed.resolution.coarse()), None);
    let coarse = press_coarsely(&scene, &Unwatched).unwrap();
    assert_eq!(coarse.relative_error(Quantity::LoadPress, &coarse.resolution), None);
}
