//! The scenes of the study: materials, interferences, slip rates, both controls, both strain measures.

use crate::scene::Scene;
use crate::scene::file::parse_scene;

/// The first scenes, used for constants of the error estimates.
pub const USED: usize = 149;
/// All scenes.
pub const COUNT: usize = USED + 64;

const PRESETS: [&str; 8] = [
    "steel-4340",
    "copper",
    "titanium-6al4v",
    "steel-304",
    "aluminium-6061",
    "brass-c26000",
    "steel-1045",
    "carbon-steel-en1993",
];
const SLIP_RATES: [f64; 7] = [0.3, 10.0, 0.0, 1.0, 3.0, 0.1, 6.0];

/// A slide by two contact radii of an asperity of R = 1 mm at the default accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyScene {
    pub preset: &'static str,
    /// ω₀/ω_c.
    pub interference: f64,
    /// m/s.
    pub slip_rate: f64,
    pub load_held: bool,
    /// Small strain where the expected strain is small; otherwise finite strain in any case.
    pub strain_by_press: bool,
}

/// The scene at a position. Each property takes its values in turn, with periods (8, 7, 9 and 5) that have no common factor;
/// the interferences from 0.1 to 100 ω_c are an additive sequence of the golden ratio. The interferences of one
/// material follow each other closely, and 18 scenes of it go once through the range. The scenes used for no constant are 11
/// positions apart, so that eight of a material do.
///
/// ```
/// use asperity::studies::effectivity::scenes::{COUNT, study_scene};
///
/// let scene = study_scene(COUNT - 1);
/// assert!((0.1..=100.0).contains(&scene.interference));
/// assert_eq!(scene.scene().radius, 1e-3);
/// ```
pub fn study_scene(position: usize) -> StudyScene {
    const GOLDEN_RATIO: f64 = 0.618_033_988_749_895;
    const STRIDE: usize = 11;
    let position = if position < USED { position } else { USED + STRIDE * (position - USED) };
    let place = (GOLDEN_RATIO * (position + 1) as f64).fract();
    let interference = 0.1 * 1000f64.powf(place);
    let digits = 10f64.powf(1.0 - interference.log10().floor());
    StudyScene {
        preset: PRESETS[position % PRESETS.len()],
        interference: (interference * digits).round() / digits,
        slip_rate: SLIP_RATES[position % SLIP_RATES.len()],
        load_held: position % 9 < 3,
        strain_by_press: position % 5 < 3,
    }
}

impl StudyScene {
    pub fn scene(&self) -> Scene {
        let Self { preset, interference, slip_rate, load_held, strain_by_press } = *self;
        let control = if load_held { "load" } else { "interference" };
        let kinematics = if strain_by_press { "auto" } else { "finite" };
        let text = format!(
            "[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n\
             [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\ncontrol = \"{control}\"\n\
             [model]\nkinematics = \"{kinematics}\"\n"
        );
        parse_scene(&text, preset, &[]).expect("presets are valid")
    }

    /// Name in tables.
    pub fn name(&self) -> String {
        let Self { preset, interference, slip_rate, load_held, strain_by_press } = *self;
        let held = if load_held { "P" } else { "ω" };
        let strain = if strain_by_press { "" } else { ", finite" };
        format!("{preset} {interference} ω_c {slip_rate} m/s, {held}{strain}")
    }
}
