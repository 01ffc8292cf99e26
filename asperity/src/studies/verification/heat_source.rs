//! Frictional heat of constant strength on an elastic sphere that is a half space to the contact.
//!
//! Disc source on an insulated half space, Fo = κt/a²: H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in Solids*
//! (1959), §10.5. Steady source that is cooled through the gap to the flat: the body conducts between (3π²/8)ka per
//! mean rise (uniform flux) and 4ka (uniform temperature), §8.2 there.

use std::f64::consts::PI;

use tables::quantity::{Quantity, State};

use super::setup::{Hertz, interpolated, last, mesh, plain_material, scene, shear_strength};
use super::{Case, Cost, Reference, Row, Rows, Tolerance, joined};
use crate::scene::{Counterface, FrictionLaw, Scene, Softening, Switch};
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, simulate};

/// ΔT_m, K.
pub(super) const RANGE: f64 = 1000.0;
/// Initial temperature, K.
pub(super) const START: f64 = 298.0;

const DISC: &str = "Carslaw & Jaeger 1959, sec. 10.5";
const CONDUCTANCE: &str = "Carslaw & Jaeger 1959, sec. 8.2: uniform flux and uniform temperature";

/// Fo, mean rise over qa/k of a disc source, rise of its centre, tolerance of the history: heat begins with gross slip,
/// after 1/2000 of the slide (Fo = 10), which takes 0.0025/Fo off a rise that goes like √t; the history is linear in √t
/// between steps of Δt/t = 0.2, which leaves (Δt/t)²/32 = 0.00125.
const RISES: [(f64, f64, f64, f64); 5] = [
    (0.1, 0.293981, 0.352882, 0.02625),
    (0.25, 0.410448, 0.513935, 0.01125),
    (1.0, 0.587630, 0.729097, 0.00375),
    (2.0, 0.657178, 0.804583, 0.0025),
    (10.0, 0.760354, 0.911164, 0.0015),
];

pub const CASES: [Case; 3] = [
    Case::new("disc source, 8 elements", Cost::Quick, |watch| disc(8, 0.022, watch)),
    Case::new("contact cooled through the gap", Cost::Medium, |watch| {
        joined([1.0, 10.0].map(|biot| cooled(biot, watch)))
    }),
    Case::new("disc source, 16 elements", Cost::Long, |watch| disc(16, 0.008, watch)),
];

/// A slide and its scales.
pub(super) struct Heated {
    pub outcome: Outcome,
    /// τ₀, Pa.
    pub strength: f64,
    /// τ₀Va/k, K.
    pub rise: f64,
    /// a²/κ, s.
    pub time: f64,
    /// m.
    pub distance: f64,
}

/// A slide at softening number L = τ₀Va/(kΔT_m) that ends at Fo; τ = τ₀(1 − T/ΔT_m) if it `softens`, else τ₀.
///
/// ν = 0.499, ω₀ = 10⁻⁴ ω_c and f_τ = 0.005, so that the body stays elastic; the flat slides 2000 times as far as gross
/// slip takes; the heat capacity is what gives Fo at the end.
pub(super) fn slide(
    softening: f64,
    fourier: f64,
    softens: bool,
    elements: usize,
    watch: &dyn Watch,
) -> Result<Heated, SimulationError> {
    slide_beside(&|_| Counterface::default(), (softening, fourier, softens), elements, watch)
}

/// Slide beside the counterface of a scene.
pub(super) fn slide_beside(
    counterface: &dyn Fn(&Scene) -> Counterface,
    (softening, fourier, softens): (f64, f64, bool),
    elements: usize,
    watch: &dyn Watch,
) -> Result<Heated, SimulationError> {
    let (mut scene, [strength, distance, time]) = source(softening, fourier, elements);
    if softens {
        scene.material.softening =
            Softening::JohnsonCook { reference: START, melting: START + RANGE, exponent: 1.0 };
    }
    scene.counterface = counterface(&scene);
    let outcome = simulate(&scene, watch)?;
    Ok(Heated { outcome, strength, rise: softening * RANGE, time: time / fourier, distance })
}

/// The scene of such a slide at constant strength, τ₀ (Pa), and slip (m) and time (s) of the slide.
pub(super) fn source(softening: f64, fourier: f64, elements: usize) -> (Scene, [f64; 3]) {
    let mut scene = scene(plain_material(0.499), FrictionLaw::ShearStrength, 1e-4, mesh(elements, 4));
    scene.interface.strength_factor = 0.005;
    scene.model.heat = Switch::On;
    let strength = shear_strength(&scene);
    let hertz = Hertz::of(&scene);
    let (a, k) = (hertz.contact_radius, scene.material.thermal_conductivity.value);
    let gross = strength / (2.0 * hertz.tangential_modulus);
    scene.loading.slip_distance = 2000.0 * gross;
    scene.loading.slip_rate = softening * k * RANGE / (strength * a);
    let distance = scene.loading.slip_distance * a;
    let time = distance / scene.loading.slip_rate;
    scene.material.density = 1.0;
    scene.material.specific_heat = (k * time / (fourier * a * a)).into();
    (scene, [strength, distance, time])
}

/// A history at Fo, linear in √t.
fn at(heated: &Heated, fourier: f64, value: fn(State<'_>) -> f64) -> f64 {
    interpolated(&heated.outcome, (Quantity::Time, fourier * heated.time), f64::sqrt, value)
}

fn disc(elements: usize, of_mesh: f64, watch: &dyn Watch) -> Rows {
    const WHY: &str = "mesh, 0.5 n_c^-1.5; late start and interpolation, 0.0025/Fo + 0.00125";
    let heated = slide(1.0, 10.0, false, elements, watch)?;
    let mut rows = Vec::new();
    for (fourier, mean, centre, of_history) in RISES {
        let mut row = |name: &str, value: fn(State<'_>) -> f64, reference: f64| {
            let rise = at(&heated, fourier, value) / heated.rise;
            let name = format!("{name} rise over qa/k at Fo = {fourier}, {elements} elements");
            let reference = Reference::exact(reference, DISC).known_to(of_history);
            rows.push(Row::new(name, rise, reference, Tolerance::relative(of_mesh + of_history, WHY)));
        };
        row("mean", |step| step[Quantity::TemperatureMean] - START, mean);
        row("largest", |step| step[Quantity::TemperatureMax] - START, centre);
    }
    Ok(rows)
}

/// Elastic contact at ω_c/2 without softening, Bi = h_g a/k, slid until Fo = 10⁴: the mean rise is Q V/(h_g A + G) with
/// G/(ka) between 3π²/8 and 4, and h_g A times it goes to the flat.
fn cooled(biot: f64, watch: &dyn Watch) -> Rows {
    const WHY: &str = "half of the distance between the bounds; area, 0.5 %";
    let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 0.5, mesh(8, 4));
    // Slips everywhere at once and leaves the body elastic.
    scene.interface.strength_factor = 0.01;
    scene.model.heat = Switch::On;
    let hertz = Hertz::of(&scene);
    let (radius, k) = (hertz.contact_radius, scene.material.thermal_conductivity.value);
    let conductance = biot * k / radius;
    scene.interface.gap_conductance = conductance;
    scene.loading.slip_distance = 2.0;
    scene.loading.slip_rate = 2.0 * scene.material.diffusivity() / (1e4 * radius);
    let outcome = simulate(&scene, watch)?;
    let end = last(&outcome);
    let a = (end[Quantity::Area] / PI).sqrt();
    let gap = conductance * end[Quantity::Area];
    let [most, least] = [3.0 * PI * PI / 8.0, 4.0].map(|factor| 1.0 / (gap + factor * k * a));
    let row = |name: &str, computed: f64, scale: f64| {
        let middle = 0.5 * scale * (least + most);
        let share = (most - least) / (most + least);
        let reference = Reference::exact(middle, CONDUCTANCE).known_to(share);
        let name = format!("{name}, h_g a/k = {biot}");
        Row::new(name, computed, reference, Tolerance::relative(share + 0.005, WHY))
    };
    let rise = end[Quantity::TemperatureMean] - START;
    // Of the heat of the last step: the far field is not yet steady.
    let before = outcome.slide.state(outcome.slide.len() - 2);
    let share = (end[Quantity::HeatOut] - before[Quantity::HeatOut])
        / (end[Quantity::HeatIn] - before[Quantity::HeatIn]);
    let stated = outcome.scalars[Quantity::TemperatureMean].error;
    let power = end[Quantity::Friction] * scene.loading.slip_rate;
    Ok(vec![
        Row { stated_error: Some(stated), ..row("steady mean rise", rise, power).unit("K") },
        row("share of the heat that leaves through the gap", share, gap),
    ])
}
