//! Common parts of the tests of whole programs.
//!
//! References that others published are rows of `asperity verify`, which `tests/verify.rs` runs. The other tests here
//! are of the programs from outside, of the book, and of input that is damaged. What can be tested on one module is
//! tested in its own folder.

pub mod programs;

use asperity::scene::Scene;
use asperity::simulate::outcome::Outcome;
use asperity::simulate::{Unwatched, simulate};
pub use asperity::studies::verification::setup::*;

/// Runs a scene that must converge.
pub fn run(scene: &Scene) -> Outcome {
    simulate(scene, &Unwatched).unwrap_or_else(|error| panic!("{error}: {scene:?}"))
}
