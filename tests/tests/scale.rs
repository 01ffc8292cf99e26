//! The same friction at every size.
//!
//! Problem: 4340 steel spheres of R = 10 nm, 1 mm and 10 mm at equal VR/κ (and equal h_gR/k).
//! Source: dimensional analysis: quasi-static, rate-independent plasticity with conduction has no
//! length of its own.

use asperity::scene::FrictionLaw;
use tables::quantity::Quantity;
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
    let expected = &reference.scalars;
    assert!(expected[Quantity::TemperatureMax].value > 350.0, "{expected:?}");
    for radius in [10e-9, 10e-3] {
        let outcome = at(radius);
        let found = &outcome.scalars;
        let scale = radius / 1e-3;
        for (name, value, reference) in [
            ("mu", found[Quantity::Mu].value, expected[Quantity::Mu].value),
            ("mu_static", found[Quantity::MuStatic].value, expected[Quantity::MuStatic].value),
            ("mu_peak", found[Quantity::MuPeak].value, expected[Quantity::MuPeak].value),
            ("Q", found[Quantity::Friction].value / scale.powi(2), expected[Quantity::Friction].value),
            ("P", found[Quantity::Load].value / scale.powi(2), expected[Quantity::Load].value),
            ("A", found[Quantity::Area].value / scale.powi(2), expected[Quantity::Area].value),
            ("G", found[Quantity::EnergyRelease].value / scale, expected[Quantity::EnergyRelease].value),
            (
                "T_max",
                found[Quantity::TemperatureMax].value - 298.0,
                expected[Quantity::TemperatureMax].value - 298.0,
            ),
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
