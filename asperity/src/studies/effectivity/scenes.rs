//! The scenes of the study, from elastic to deeply plastic contact, from 0 to 10 m/s: three materials, used for two constants
//! of the estimates, and five others, used for none. No two scenes share interference and slip rate.

use crate::scene::Scene;
use crate::scene::file::parse_scene;

/// The first scenes of [`SCENES`], used for constants of the estimates.
pub const SEEN: usize = 21;

/// Preset, ω₀/ω_c, V (m/s). Beyond the first [`SEEN`], five materials and seven slip rates in turn
/// over growing interferences.
pub const SCENES: [(&str, f64, f64); 41] = [
    ("steel-4340", 0.1, 1.0),
    ("steel-4340", 0.5, 0.0),
    ("steel-4340", 2.0, 10.0),
    ("steel-4340", 5.0, 0.1),
    ("steel-4340", 20.0, 1.0),
    ("steel-4340", 50.0, 3.0),
    ("steel-4340", 100.0, 0.1),
    ("aluminium-6061", 0.1, 10.0),
    ("aluminium-6061", 1.0, 0.1),
    ("aluminium-6061", 3.0, 1.0),
    ("aluminium-6061", 10.0, 0.0),
    ("aluminium-6061", 20.0, 10.0),
    ("aluminium-6061", 50.0, 0.1),
    ("aluminium-6061", 100.0, 1.0),
    ("titanium-6al4v", 0.2, 0.1),
    ("titanium-6al4v", 1.0, 10.0),
    ("titanium-6al4v", 3.0, 0.0),
    ("titanium-6al4v", 10.0, 1.0),
    ("titanium-6al4v", 20.0, 0.1),
    ("titanium-6al4v", 50.0, 10.0),
    ("titanium-6al4v", 100.0, 0.0),
    ("copper", 0.15, 0.3),
    ("steel-304", 0.25, 3.0),
    ("steel-1045", 0.4, 0.0),
    ("brass-c26000", 0.7, 1.0),
    ("carbon-steel-en1993", 1.0, 10.0),
    ("copper", 1.5, 0.1),
    ("steel-304", 2.0, 5.0),
    ("steel-1045", 3.0, 0.3),
    ("brass-c26000", 4.0, 3.0),
    ("carbon-steel-en1993", 6.0, 0.0),
    ("copper", 8.0, 1.0),
    ("steel-304", 12.0, 10.0),
    ("steel-1045", 15.0, 0.1),
    ("brass-c26000", 20.0, 5.0),
    ("carbon-steel-en1993", 30.0, 0.3),
    ("copper", 40.0, 3.0),
    ("steel-304", 50.0, 0.0),
    ("steel-1045", 60.0, 1.0),
    ("brass-c26000", 80.0, 10.0),
    ("carbon-steel-en1993", 100.0, 0.1),
];

/// The scene at small strain, R = 1 mm, slid by two contact radii, with `elements_per_radius`
/// elements.
///
/// ```
/// use asperity::studies::effectivity::scenes::{SCENES, name, scene};
///
/// let (preset, interference, slip_rate) = SCENES[4];
/// let scene = scene(preset, interference, slip_rate, 8);
/// assert_eq!((scene.radius, scene.loading.slip_distance), (1e-3, 2.0));
/// assert_eq!(name(preset, interference, slip_rate), "steel-4340 20 ω_c 1 m/s");
/// ```
pub fn scene(preset: &str, interference: f64, slip_rate: f64, elements_per_radius: usize) -> Scene {
    let text = format!(
        "[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n\
         [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\n\
         [model]\nkinematics = \"small\"\n\
         [numerics]\nelements_per_radius = {elements_per_radius}\n"
    );
    parse_scene(&text, preset, &[]).expect("presets are valid")
}

/// Name of a scene in tables.
pub fn name(preset: &str, interference: f64, slip_rate: f64) -> String {
    format!("{preset} {interference} ω_c {slip_rate} m/s")
}
