//! Whole runs of the pipeline.

use tables::quantity::Quantity;

use super::{Unwatched, simulate};
use crate::scene::file::parse_scene;

/// A point at the edge that its own friction lifts off the flat, and that returns without it: there is no equilibrium
/// between the two for any increment, and without damping steps are cut back indefinitely.
#[test]
fn chattering_points_do_not_cut_steps_back() {
    let text = "[material]\npreset = \"steel-304\"\n[asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 0.2\nslip_rate = 0\n[model]\nkinematics = \"small\"\n\
                [numerics]\nelements_per_radius = 8\nsectors = 8\naccuracy = 0.5\n";
    let scene = parse_scene(text, "this test", &[]).unwrap();
    let outcome = simulate(&scene, &Unwatched).unwrap();
    assert_eq!(outcome.account.cutbacks, 0);
    // What such a point loses is far below what the mesh leaves open.
    let finer = parse_scene(text, "this test", &["numerics.elements_per_radius=12".into()]).unwrap();
    let finer = simulate(&finer, &Unwatched).unwrap().scalars[Quantity::Mu];
    let mu = outcome.scalars[Quantity::Mu];
    assert!((mu.value - finer.value).abs() < mu.error, "{mu:?} {finer:?}");
}
