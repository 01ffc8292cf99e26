//! The scenes of the study: three materials, from elastic to deeply plastic contact, from rest to
//! 10 m/s. No two share interference and slip rate, so that none counts twice.

use crate::scene::Scene;
use crate::scene_file::parse_scene;

/// Preset, ω₀/ω_c, V (m/s).
pub const SCENES: [(&str, f64, f64); 21] = [
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
];

/// The scene at small strain, R = 1 mm, slid by two contact radii, with `elements_per_radius`
/// elements.
///
/// ```
/// use asperity::honesty::scenes::{SCENES, name, scene};
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

/// How a scene is called in tables.
pub fn name(preset: &str, interference: f64, slip_rate: f64) -> String {
    format!("{preset} {interference} ω_c {slip_rate} m/s")
}
