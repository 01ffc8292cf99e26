//! Steady state of a contact that is heated by friction and cooled through the gap.
//!
//! Problem: elastic contact at ω_c/2 without plastic or softening heat, friction heat f_h τ_c V over
//! the contact, conductance h_g to the flat at the initial temperature, Bi = h_g a/k of order one,
//! slid until Fo = κt/a² is of order 10⁴.
//! Source: the body conducts between (3π²/8)·k·a per mean rise of the contact (uniform flux) and
//! 4·k·a (uniform temperature) (Carslaw & Jaeger, 2nd ed., §8.2); the true share of it lies between.
//! Hence the mean rise is f_h Q V/(h_g A + G) with G between these, and h_g A times it goes to the
//! flat.

use asperity::scene::{FrictionLaw, Switch};
use asperity::simulate::outcome::Outcome;
use std::f64::consts::PI;
use tables::quantity::Quantity;
use tests::{Hertz, last, mesh, plain_material, run, scene};

/// Outcome of a slide and what its heat depends on, SI.
struct Cooled {
    outcome: Outcome,
    conductivity: f64,
    conductance: f64,
    slip_rate: f64,
}

fn slide(biot: f64) -> Cooled {
    let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 0.5, mesh(8, 4));
    // Slips everywhere at once and leaves the body elastic.
    scene.interface.strength_factor = 0.01;
    scene.model.heat = Switch::On;
    let hertz = Hertz::of(&scene);
    let (a, k) = (hertz.contact_radius, scene.material.thermal_conductivity);
    scene.interface.gap_conductance = biot * k / a;
    scene.loading.slip_distance = 2.0;
    let diffusivity = k / (scene.material.density * scene.material.specific_heat);
    // t = 2a/V.
    scene.loading.slip_rate = 2.0 * diffusivity / (1e4 * a);
    let outcome = run(&scene);
    assert_eq!(last(&outcome)[Quantity::PlasticStrainMax], 0.0);
    Cooled {
        outcome,
        conductivity: k,
        conductance: scene.interface.gap_conductance,
        slip_rate: scene.loading.slip_rate,
    }
}

#[test]
fn steady_rise_is_that_of_body_and_gap_in_parallel() {
    // Allowed beyond the bounds: the discrete area and the smeared edge of the flux.
    let tolerance = 0.005;
    for biot in [1.0, 10.0] {
        let cooled = slide(biot);
        let end = last(&cooled.outcome);
        let a = (end[Quantity::Area] / PI).sqrt();
        let power = end[Quantity::Friction] * cooled.slip_rate;
        let body = cooled.conductivity * a;
        let [most, least] = [3.0 * PI * PI / 8.0, 4.0]
            .map(|factor| power / (cooled.conductance * end[Quantity::Area] + factor * body));
        let rise = end[Quantity::TemperatureMean] - 298.0;
        println!("Bi {biot}: rise {rise:.4e} K, between {least:.4e} and {most:.4e}");
        assert!(rise > least * (1.0 - tolerance) && rise < most * (1.0 + tolerance));
        // Of the heat of the last step the gap takes its share; the far body still warms up.
        let before = cooled.outcome.slide.state(cooled.outcome.slide.len() - 2);
        let share = (end[Quantity::HeatOut] - before[Quantity::HeatOut])
            / (end[Quantity::HeatIn] - before[Quantity::HeatIn]);
        let [most, least] = [3.0 * PI * PI / 8.0, 4.0].map(|factor| {
            cooled.conductance * end[Quantity::Area]
                / (cooled.conductance * end[Quantity::Area] + factor * body)
        });
        println!("share of the gap {share:.4}, between {least:.4} and {most:.4}");
        assert!(share > least * (1.0 - tolerance) && share < most * (1.0 + tolerance));
    }
}
