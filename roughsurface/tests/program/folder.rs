//! Folders in which the program is run, and what is in them.

use crate::demonstration::{Weakening, table};
use std::path::{Path, PathBuf};
use tests::folder::Folder;

/// A topography that comes with the tests.
pub fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// A surface file of Gaussian summits with that density (1/m²), radius and standard deviation (m), and the lines of its query.
pub fn surface(density: f64, radius: f64, std: f64, query: &str) -> String {
    format!(
        "[surface]\nasperity_density = {density:e}\nasperity_radius = {radius:e}\n\
         heights = {{ distribution = \"gaussian\", std = {std:e} }}\n[query]\n{query}\n"
    )
}

/// The section of a surface file with the material of closed forms, that of the demonstration.
pub const MATERIAL: &str =
    "[material]\nyoungs_modulus = 200e9\npoisson_ratio = 0.3\nyield_strength = 400e6\n";

pub fn empty_folder() -> Folder {
    Folder::new(env!("CARGO_BIN_EXE_roughsurface"))
}

/// A folder with the file surface.toml.
pub fn folder_with(surface: &str) -> Folder {
    let folder = empty_folder();
    folder.write("surface.toml", surface);
    folder
}

/// The same with table.nc, a table of asperities that weaken with the slip rate.
pub fn folder_with_table(surface: &str) -> Folder {
    let folder = folder_with(surface);
    table(&Weakening::new()).write(&folder.path("table.nc")).unwrap();
    folder
}
