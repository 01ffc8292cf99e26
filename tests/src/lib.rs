//! Comparisons that the verification tests share; their scenes are those of `asperity verify`.
//!
//! The tests compare the whole program with references that this project did not write: closed
//! forms and fits of the literature (`tables::closed_forms` and numbers quoted with their source),
//! and properties that follow from the equations alone. What can be tested on one module is
//! tested beside it.

pub mod programs;

use asperity::scene::Scene;
use asperity::simulate::outcome::Outcome;
use asperity::simulate::{Unwatched, simulate};
pub use asperity::studies::verification::setup::*;

/// Runs a scene that must converge.
pub fn run(scene: &Scene) -> Outcome {
    let outcome = simulate(scene, &Unwatched).unwrap_or_else(|error| panic!("{error}: {scene:?}"));
    println!(
        "n_c {} N_theta {}: {} steps, {} Newton, {:.1} s",
        outcome.account.elements_per_radius,
        outcome.account.sectors,
        outcome.account.steps,
        outcome.account.newton_iterations,
        outcome.account.wall_time
    );
    outcome
}

/// Runs only the press of a scene.
pub fn press(scene: &Scene) -> Outcome {
    let mut scene = scene.clone();
    scene.loading.slip_distance = 0.0;
    run(&scene)
}

/// Limit of a sequence that converges with `order`, from its values at a step and half that step.
pub fn richardson(coarse: f64, fine: f64, order: f64) -> f64 {
    fine + (fine - coarse) / (2f64.powf(order) - 1.0)
}

/// Relative difference of a value from its reference.
pub fn relative(value: f64, reference: f64) -> f64 {
    value / reference - 1.0
}

/// Asserts that `value` is within `tolerance` of `reference`, relative, and prints both.
#[track_caller]
pub fn assert_close(what: &str, value: f64, reference: f64, tolerance: f64) {
    let off = relative(value, reference);
    println!("{what}: {value:.6e}, reference {reference:.6e}, {:+.3} %", 100.0 * off);
    assert!(
        off.abs() <= tolerance,
        "{what}: {value:e} is {:+.3} % off the reference {reference:e}, allowed {:.3} %",
        100.0 * off,
        100.0 * tolerance
    );
}
