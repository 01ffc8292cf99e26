//! The scenes of the study: materials, interferences, slip rates, both controls, both strain measures; short slides
//! against an isothermal flat, and slides as in the shipped tables.

use tables::quantity::Quantity;

use crate::scene::Scene;
use crate::scene::file::{parse_request, parse_scene};
use crate::simulate::outcome::MAIN;

/// The first scenes, used for constants of the error estimates.
pub const USED: usize = 149;
/// Scenes with a slide of two contact radii against an isothermal flat.
pub const SHORT: usize = USED + 64;
/// All scenes; those after the short ones are as in the shipped tables.
pub const COUNT: usize = SHORT + 64;

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
/// ω₀/ω_c.
const SMALLEST: f64 = 0.1;
const GOLDEN_RATIO: f64 = 0.618_033_988_749_895;
/// Judged in scenes as in the shipped tables: what users read from these.
const OF_TABLES: [Quantity; 11] = [
    Quantity::Mu,
    Quantity::MuStatic,
    Quantity::MuMean,
    Quantity::Friction,
    Quantity::Load,
    Quantity::Area,
    Quantity::EnergyRelease,
    Quantity::InceptionSlip,
    Quantity::TemperatureMax,
    Quantity::TemperatureMean,
    Quantity::HeatPartition,
];

/// A scene of an asperity of R = 1 mm at the default accuracy.
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
    /// A slide by 20 contact radii against a body of the same metal that conducts heat; otherwise by two against an
    /// isothermal flat.
    pub as_in_tables: bool,
    /// Whether the scene has the rate law of the preset.
    pub rate_law: bool,
}

/// The scene at a position. Each property takes its values in turn, with periods that have no common factor; the
/// interferences, from 0.1 to 100 ω_c (to the largest of a table), are an additive sequence of the golden ratio.
///
/// ```
/// use asperity::studies::effectivity::scenes::{COUNT, SHORT, study_scene};
///
/// assert!((0.1..=100.0).contains(&study_scene(SHORT - 1).interference));
/// assert!((0.1..=9000.0).contains(&study_scene(COUNT - 1).interference));
/// assert_eq!(study_scene(COUNT - 1).scene().loading.slip_distance, 20.0);
/// ```
pub fn study_scene(position: usize) -> StudyScene {
    if position < SHORT { short(position) } else { as_in_tables(position - SHORT) }
}

/// The interferences of one material follow each other closely, and 18 scenes of it go once through the range. The scenes
/// used for no constant are 11 positions apart, so that eight of a material do.
fn short(position: usize) -> StudyScene {
    const STRIDE: usize = 11;
    let position = if position < USED { position } else { USED + STRIDE * (position - USED) };
    StudyScene {
        preset: PRESETS[position % PRESETS.len()],
        interference: interference(position, 1000.0),
        slip_rate: SLIP_RATES[position % SLIP_RATES.len()],
        load_held: position % 9 < 3,
        strain_by_press: position % 5 < 3,
        as_in_tables: false,
        rate_law: false,
    }
}

fn as_in_tables(position: usize) -> StudyScene {
    /// Position of the preset without constants of a rate law.
    const WITHOUT_RATE_LAW: usize = 7;
    let preset = PRESETS[position % PRESETS.len()];
    StudyScene {
        preset,
        interference: interference(position, largest_of_table(preset) / SMALLEST),
        slip_rate: [0.3, 10.0, 0.03, 1.0, 3.0, 0.1, 6.0][position % 7],
        load_held: position % 5 == 4,
        strain_by_press: true,
        as_in_tables: true,
        rate_law: position.is_multiple_of(3) && position % PRESETS.len() != WITHOUT_RATE_LAW,
    }
}

/// The largest interference of the default table of a metal, ω_c.
fn largest_of_table(preset: &str) -> f64 {
    let text = format!("[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n[table]\n");
    let request = parse_request(&text, preset, &[]).expect("presets are valid");
    request.interferences.into_iter().fold(SMALLEST, f64::max)
}

/// Interference of a position, from the smallest one over a `range`, to two digits.
fn interference(position: usize, range: f64) -> f64 {
    let fraction = (GOLDEN_RATIO * (position + 1) as f64).fract();
    let interference = SMALLEST * range.powf(fraction);
    let digits = 10f64.powf(1.0 - interference.log10().floor());
    (interference * digits).round() / digits
}

impl StudyScene {
    pub fn scene(&self) -> Scene {
        let Self { preset, interference, slip_rate, .. } = *self;
        let control = if self.load_held { "load" } else { "interference" };
        let kinematics = if self.strain_by_press { "auto" } else { "finite" };
        let rate = if self.rate_law { "rate = { law = \"johnson-cook\" }\n" } else { "" };
        let (slip_distance, counterface) = if self.as_in_tables {
            // As in the table of titanium, whose body shears in place of the interface beyond.
            let slip_distance = if preset == "titanium-6al4v" { 10.0 } else { 20.0 };
            (slip_distance, format!("[counterface]\npreset = \"{preset}\"\nelastic = false\n"))
        } else {
            (2.0, String::new())
        };
        let text = format!(
            "[material]\npreset = \"{preset}\"\n{rate}{counterface}[asperity]\nradius = 1e-3\n\
             [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\ncontrol = \"{control}\"\n\
             slip_distance = {slip_distance:?}\n[model]\nkinematics = \"{kinematics}\"\n"
        );
        parse_scene(&text, preset, &[]).expect("presets are valid")
    }

    /// Quantities that are judged.
    pub fn judged(&self) -> &'static [Quantity] {
        if self.as_in_tables { &OF_TABLES } else { &MAIN }
    }

    /// Name in tables.
    pub fn name(&self) -> String {
        let Self { preset, interference, slip_rate, load_held, .. } = *self;
        let held = if load_held { "P" } else { "ω" };
        let strain = if self.strain_by_press { "" } else { ", finite" };
        let rate = if self.rate_law { ", rate law" } else { "" };
        format!("{preset} {interference} ω_c {slip_rate} m/s, {held}{strain}{rate}")
    }
}
