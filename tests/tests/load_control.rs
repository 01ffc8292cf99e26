//! Sliding at constant load against sliding at constant interference.
//!
//! Problem: 4340 steel pressed to 20 ω_c and slid without heat.
//! Sources: equilibrium (the load stays what it was, to the solver's tolerance); the first law of
//! thermodynamics, with the flat's work on its sinking; X. Shi, A. Wu, C. Zhu & S. Qu, Tribol. Int.
//! (2013): the largest static friction is lower under displacement than under force control at
//! equal preload. Elastic contact without friction: sinking costs nothing and changes nothing.

use asperity::scene::{Control, FrictionLaw};
use tables::quantity::Quantity;
use tests::{assert_close, last, mesh, plain_material, pressed, run, scene, steel_4340};

#[test]
fn the_load_is_held_and_friction_is_higher() {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 20.0, mesh(8, 4));
    scene.loading.slip_distance = 0.1;
    let fixed = run(&scene);
    scene.loading.control = Control::Load;
    let held = run(&scene);

    let load = pressed(&held)[Quantity::Load];
    assert_close("preload", load, pressed(&fixed)[Quantity::Load], 1e-12);
    for step in held.slide.states() {
        assert!((step[Quantity::Load] / load - 1.0).abs() < 1e-5, "{step:?}");
    }
    // At constant interference a plastic contact loses load while it slides; held, it sinks.
    assert!(last(&fixed)[Quantity::Load] < 0.96 * load);
    assert!(last(&held)[Quantity::Interference] > 20.3 && last(&fixed)[Quantity::Interference] == 20.0);
    let sinks =
        held.slide.column(Quantity::Interference).windows(2).all(|pair| pair[1] >= pair[0] * (1.0 - 1e-6));
    assert!(sinks, "the flat rises");

    let (low, high) =
        (fixed.scalars[Quantity::FrictionStatic].value, held.scalars[Quantity::FrictionStatic].value);
    println!("Q_static {low} at constant interference, {high} at constant load");
    assert!(high > 1.02 * low);

    for step in held.slide.states().skip(1) {
        let spent = step[Quantity::EnergyElastic]
            + step[Quantity::DissipationPlastic]
            + step[Quantity::DissipationFriction];
        assert!((step[Quantity::Work] - spent).abs() < 1e-6 * step[Quantity::Work], "{step:?}");
    }
}

/// Without friction nothing pulls the contact down.
#[test]
fn nothing_sinks_without_friction() {
    let mut scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(6, 4));
    scene.loading.control = Control::Load;
    scene.loading.slip_distance = 0.05;
    let outcome = run(&scene);
    for step in outcome.slide.states() {
        assert!((step[Quantity::Interference] / 0.3 - 1.0).abs() < 1e-5, "{}", step[Quantity::Interference]);
    }
}
