//! Whole runs of the pipeline.

use tables::quantity::Quantity;

use super::{Unwatched, simulate};
use crate::heat::expected::HeatEffect;
use crate::scene::Scene;
use crate::scene::file::parse_scene;

/// An edge point that lifts off with friction and touches without it has no equilibrium for any increment. Without
/// removal of its friction the steps would be cut back indefinitely.
#[test]
fn chattering_points_do_not_cut_steps_back() {
    let text = "[material]\npreset = \"steel-304\"\n[asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 0.2\nslip_rate = 0\n[model]\nkinematics = \"small\"\n\
                [numerics]\nelements_per_radius = 8\nsectors = 8\naccuracy = 0.5\n";
    let scene = parse_scene(text, "this test", &[]).unwrap();
    let outcome = simulate(&scene, &Unwatched).unwrap();
    assert_eq!(outcome.account.cutbacks, 0);
    // The friction of such a point is far below the mesh error.
    let finer = parse_scene(text, "this test", &["numerics.elements_per_radius=12".into()]).unwrap();
    let finer = simulate(&finer, &Unwatched).unwrap().scalars[Quantity::Mu];
    let mu = outcome.scalars[Quantity::Mu];
    assert!((mu.value - finer.value).abs() < mu.error, "{mu:?} {finer:?}");
}

fn hot_scene(preset: &str, interference: f64, slip_rate: f64, heat: &str) -> Scene {
    let text = format!(
        "[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n\
         [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\n\
         [model]\nheat = \"{heat}\"\nkinematics = \"small\"\n\
         [numerics]\naccuracy = 0.5\nelements_per_radius = 6\nsectors = 4\n"
    );
    parse_scene(&text, "this test", &[]).unwrap()
}

/// On one mesh heat changes load and friction by about the expected effect, which decides whether it is neglected.
#[test]
fn the_expected_effect_of_heat_is_that_of_the_simulation() {
    for (preset, interference, slip_rate) in
        [("steel-4340", 0.5, 0.08), ("steel-1045", 5.0, 0.1), ("copper", 40.0, 2.0)]
    {
        let run = |heat| simulate(&hot_scene(preset, interference, slip_rate, heat), &Unwatched).unwrap();
        let (coupled, none) = (run("on").scalars, run("off").scalars);
        let radius = none[Quantity::ContactRadius].value;
        let effect =
            HeatEffect::expected(&hot_scene(preset, interference, slip_rate, "on"), slip_rate, radius);
        for (quantity, expected) in [(Quantity::Load, effect.load), (Quantity::Mu, effect.friction())] {
            let change = (coupled[quantity].value / none[quantity].value - 1.0).abs();
            assert!((0.2..1.5).contains(&(change / expected)), "{preset} {quantity:?}: {change} {expected}");
        }
    }
}

/// Negligible heat is left out: all but the temperatures is as without, and these have the expected rise as error.
#[test]
fn negligible_heat_is_left_out() {
    let run = |heat| simulate(&hot_scene("steel-4340", 2.0, 1e-5, heat), &Unwatched).unwrap();
    let (auto, off) = (run("auto"), run("off"));
    assert!(!auto.account.heat);
    assert_eq!(auto.slide, off.slide);
    let rise = auto.scalars[Quantity::TemperatureMax].value - off.scalars[Quantity::TemperatureMax].value;
    assert!(rise > 0.0 && auto.scalars[Quantity::TemperatureMax].error >= rise, "{rise}");
}
