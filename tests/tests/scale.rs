//! The same friction at every size.
//!
//! Problem: 4340 steel spheres of R = 10 nm, 1 mm and 10 mm at equal VR/κ (and equal h_gR/k).
//! Source: dimensional analysis: quasi-static, rate-independent plasticity with conduction has no
//! length of its own.

use asperity::scene::FrictionLaw;
use tests::{mesh, relative, run, scene, steel_4340};

#[test]
fn friction_does_not_depend_on_the_radius() {
    let at = |radius: f64| {
        let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 5.0, mesh(4, 4));
        scene.radius = radius;
        scene.interface.taylor_quinney = 0.9;
        scene.interface.gap_conductance = 10.0 / radius;
        scene.loading.slip_rate = 5e-3 / radius;
        scene.loading.slip_distance = 0.3;
        run(&scene)
    };
    let reference = at(1e-3);
    let expected = &reference.summary;
    assert!(expected.temperature_max.value > 350.0, "{expected:?}");
    for radius in [10e-9, 10e-3] {
        let outcome = at(radius);
        let found = &outcome.summary;
        let scale = radius / 1e-3;
        for (name, value, reference) in [
            ("mu", found.mu.value, expected.mu.value),
            ("mu_static", found.mu_static.value, expected.mu_static.value),
            ("mu_peak", found.mu_peak.value, expected.mu_peak.value),
            ("Q", found.friction.value / scale.powi(2), expected.friction.value),
            ("P", found.load.value / scale.powi(2), expected.load.value),
            ("A", found.area.value / scale.powi(2), expected.area.value),
            ("G", found.energy_release.value / scale, expected.energy_release.value),
            ("T_max", found.temperature_max.value - 298.0, expected.temperature_max.value - 298.0),
        ] {
            println!("R = {radius:e}: {name} {:e}", relative(value, reference));
            // Rounding differs with the unit; iterations that end at a tolerance may differ by one.
            assert!(
                relative(value, reference).abs() <= 1e-6,
                "R = {radius:e}: {name} {value:e} {reference:e}"
            );
        }
    }
}
