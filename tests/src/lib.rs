//! Common parts of the tests of whole programs.
//!
//! References that others published are rows of `asperity verify`, which `tests/verify.rs` runs. The other tests here
//! are of the programs from outside, of the book, and of input that is damaged. What can be tested on one module is
//! tested in its own folder.

pub mod folder;
pub mod programs;

use std::path::{Path, PathBuf};

use asperity::scene::Scene;
use asperity::simulate::outcome::Outcome;
use asperity::simulate::{Unwatched, simulate};
pub use asperity::studies::verification::setup::*;

/// Runs a scene that must converge.
pub fn run(scene: &Scene) -> Outcome {
    simulate(scene, &Unwatched).unwrap_or_else(|error| panic!("{error}: {scene:?}"))
}

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_path_buf()
}

/// Files below `folder` whose name ends so, in order, those of builds left out.
pub fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            found.extend(files(&path, extension));
        } else if name.ends_with(extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}
