//! From the history of a slide to the scalars that are reported, in SI units.

use std::f64::consts::PI;

use tables::law::Estimate;

use crate::contact::Contact;
use crate::outcome::{
    Account, ContactGrid, InceptionCriterion, Outcome, PressStep, SlideStep, Snapshot, Summary,
};
use crate::press::Increment;
use crate::problem::Problem;
use crate::scene::{FrictionLaw, Hardening, InterfaceStrength, Scene};
use crate::slide::{Fields, Instant};

/// Sticking share of the contact that counts as none: points that have just touched stick until
/// they have slipped once.
const NO_STICK: f64 = 0.01;
/// Sliding has begun when dQ/ds is below this share of its first value.
const STIFFNESS_SHARE: f64 = 0.01;
/// Relative change of μ over the last quarter of the slide below which it has levelled off.
const LEVEL: f64 = 0.02;
/// Top-layer strains above this are beyond small-strain kinematics.
const LARGE_STRAIN: f64 = 0.2;

/// Sliding inception.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Inception {
    criterion: InceptionCriterion,
    slip: f64,
    friction: f64,
    load: f64,
    /// (work of the flat − change of elastic energy)/A, per area.
    energy_release: f64,
    /// Half the differences between the states on both sides of it.
    slip_bracket: f64,
    energy_bracket: f64,
}

/// The scalars of one history, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scalars {
    mu: f64,
    mu_static: f64,
    mu_peak: f64,
    friction: f64,
    friction_static: f64,
    load: f64,
    load_press: f64,
    area: f64,
    area_press: f64,
    contact_radius: f64,
    energy_release: f64,
    energy_weakening: f64,
    temperature_max: f64,
    temperature_mean: f64,
    inception_slip: f64,
    inception_slip_bracket: f64,
    energy_release_bracket: f64,
    inception: InceptionCriterion,
    levelled: bool,
}

impl Scalars {
    pub fn new(problem: &Problem, scene: &Scene, press: &[Increment], history: &[Instant]) -> Self {
        let units = problem.units;
        let last = history.last().expect("a history starts with the press");
        let pressed = press.last().expect("a press has increments");
        let inception = inception(history);
        let mu = |i: &Instant| {
            if i.load > 0.0 { i.friction / i.load } else { 0.0 }
        };
        Self {
            mu: mu(last),
            mu_static: if inception.load > 0.0 { inception.friction / inception.load } else { 0.0 },
            mu_peak: history.iter().map(mu).fold(0.0, f64::max),
            friction: last.friction * units.force(),
            friction_static: inception.friction * units.force(),
            load: last.load * units.force(),
            load_press: pressed.load * units.force(),
            area: last.area * units.area(),
            area_press: pressed.area * units.area(),
            contact_radius: (pressed.area / PI).sqrt() * units.length,
            energy_release: inception.energy_release * units.stress * units.length,
            energy_weakening: weakening(history) * units.stress * units.length,
            temperature_max: scene.loading.temperature
                + history.iter().map(|i| i.rise_max).fold(0.0, f64::max),
            temperature_mean: scene.loading.temperature + last.rise_mean,
            inception_slip: inception.slip * units.length,
            inception_slip_bracket: inception.slip_bracket * units.length,
            energy_release_bracket: inception.energy_bracket * units.stress * units.length,
            inception: inception.criterion,
            levelled: levelled(history),
        }
    }
}

/// Where the sticking share of the contact falls to nothing, or the secant stiffness of the
/// increments falls below the given share of the first; both interpolated between increments.
fn inception(history: &[Instant]) -> Inception {
    let stiffness: Vec<(f64, f64)> = history
        .windows(2)
        .map(|w| (0.5 * (w[0].slip + w[1].slip), (w[1].friction - w[0].friction) / (w[1].slip - w[0].slip)))
        .collect();
    let first = stiffness.first().map_or(0.0, |s| s.1);
    for n in 1..history.len() {
        let (before, now) = (history[n - 1], history[n]);
        if now.stick_fraction < NO_STICK && now.friction > 0.0 {
            let fallen = before.stick_fraction - now.stick_fraction;
            let share = if fallen > 0.0 { (before.stick_fraction - NO_STICK) / fallen } else { 1.0 };
            let slip = before.slip + share.clamp(0.0, 1.0) * (now.slip - before.slip);
            return Inception::at(history, slip, n, InceptionCriterion::FullSlip);
        }
        let (at, now) = stiffness[n - 1];
        if now < STIFFNESS_SHARE * first {
            let (before_at, before) = if n >= 2 { stiffness[n - 2] } else { (0.0, first) };
            let share = ((before - STIFFNESS_SHARE * first) / (before - now)).clamp(0.0, 1.0);
            let slip = before_at + share * (at - before_at);
            return Inception::at(history, slip, n, InceptionCriterion::Stiffness);
        }
    }
    let last = history.len() - 1;
    Inception::at(history, history[last].slip, last, InceptionCriterion::None)
}

impl Inception {
    /// At `slip`, somewhere between the states n − 1 and n.
    fn at(history: &[Instant], slip: f64, n: usize, criterion: InceptionCriterion) -> Self {
        let state = between(history, slip);
        let release = |i: &Instant| if i.area > 0.0 { 2.0 * (i.work - i.elastic) / i.area } else { 0.0 };
        let (low, high) = (history[n.saturating_sub(1)], history[n]);
        Self {
            criterion,
            slip,
            friction: state.friction,
            load: state.load,
            energy_release: release(&state),
            slip_bracket: 0.5 * (high.slip - low.slip),
            energy_bracket: 0.5 * (release(&high) - release(&low)).abs(),
        }
    }
}

/// History interpolated linearly in slip.
fn between(history: &[Instant], slip: f64) -> Instant {
    if history.len() < 2 {
        return history[0];
    }
    let after = history.partition_point(|i| i.slip < slip).clamp(1, history.len() - 1);
    let (a, b) = (history[after - 1], history[after]);
    let t = ((slip - a.slip) / (b.slip - a.slip)).clamp(0.0, 1.0);
    let mix = |x: f64, y: f64| x + t * (y - x);
    Instant {
        slip,
        friction: mix(a.friction, b.friction),
        load: mix(a.load, b.load),
        area: mix(a.area, b.area),
        work: mix(a.work, b.work),
        elastic: mix(a.elastic, b.elastic),
        ..a
    }
}

/// ∫(τ̄ − τ̄_end) ds from the peak of τ̄ = Q/A to the end, trapezoidal.
fn weakening(history: &[Instant]) -> f64 {
    let stress = |i: &Instant| {
        if i.area > 0.0 { i.friction / i.area } else { 0.0 }
    };
    let peak =
        (0..history.len()).max_by(|&a, &b| stress(&history[a]).total_cmp(&stress(&history[b]))).unwrap_or(0);
    let end = history.last().map_or(0.0, stress);
    history[peak..]
        .windows(2)
        .map(|w| (0.5 * (stress(&w[0]) + stress(&w[1])) - end) * (w[1].slip - w[0].slip))
        .sum()
}

fn levelled(history: &[Instant]) -> bool {
    let last = history.last().expect("not empty");
    if last.load <= 0.0 {
        return false;
    }
    let earlier = between(history, 0.75 * last.slip);
    let mu = last.friction / last.load;
    earlier.load > 0.0 && (earlier.friction / earlier.load - mu).abs() <= LEVEL * mu.abs()
}

/// Values with the difference from the coarse run as their error.
///
/// A second-order method is off by a third of that difference, a first-order one by all of it.
/// Sliding inception lies between two states, which adds its own part.
pub fn estimate(fine: &Scalars, coarse: Option<&Scalars>) -> Summary {
    let of = |pick: fn(&Scalars) -> f64| Estimate {
        value: pick(fine),
        error: coarse.map_or(pick(fine).abs(), |c| (pick(fine) - pick(c)).abs()),
    };
    let bracketed = |e: Estimate, bracket: f64| Estimate { error: e.error + bracket, ..e };
    Summary {
        mu: of(|s| s.mu),
        mu_static: of(|s| s.mu_static),
        mu_peak: of(|s| s.mu_peak),
        friction: of(|s| s.friction),
        friction_static: of(|s| s.friction_static),
        load: of(|s| s.load),
        load_press: of(|s| s.load_press),
        area: of(|s| s.area),
        area_press: of(|s| s.area_press),
        contact_radius: of(|s| s.contact_radius),
        energy_release: bracketed(of(|s| s.energy_release), fine.energy_release_bracket),
        energy_weakening: of(|s| s.energy_weakening),
        temperature_max: of(|s| s.temperature_max),
        temperature_mean: of(|s| s.temperature_mean),
        inception_slip: bracketed(of(|s| s.inception_slip), fine.inception_slip_bracket),
        inception: fine.inception,
        levelled: fine.levelled,
    }
}

/// What the reader must know.
pub fn warn(scene: &Scene, history: &[Instant], warnings: &mut Vec<String>) {
    let equal_strength = scene.interface.strength_factor >= 1.0
        && matches!(scene.interface.law, FrictionLaw::ShearStrength | FrictionLaw::FullStick);
    let plastic = history.last().is_some_and(|i| i.plastic_strain_max > 0.0);
    if equal_strength && scene.material.hardening == Hardening::None && plastic {
        warnings.push(
            "body and interface are equally strong and the body does not harden: shear may localise \
             in one layer of elements, and mu then follows the mesh"
                .into(),
        );
    }
    if equal_strength && scene.interface.strength == InterfaceStrength::Current && plastic {
        warnings.push(
            "the interface is as strong as the hardened body: the top layer of elements shears before \
             the contact slips, and mu then follows the mesh; a strength_factor below 1 lets it slip"
                .into(),
        );
    }
    let strain = history.last().map_or(0.0, |i| i.plastic_strain_max);
    if strain > LARGE_STRAIN {
        warnings.push(format!(
            "plastic strain reaches {strain:.2}: beyond about {LARGE_STRAIN} small-strain kinematics is in doubt"
        ));
    }
}

/// The whole outcome in SI units.
#[allow(clippy::too_many_arguments)]
pub fn outcome(
    problem: &Problem,
    contact: &Contact,
    angles: &[f64],
    press: &[Increment],
    history: &[Instant],
    fields: &[Fields],
    summary: Summary,
    account: Account,
) -> Outcome {
    let units = problem.units;
    // Work and heat are of the half body.
    let energy = |x: f64| 2.0 * x * units.energy();
    let slide = history
        .iter()
        .map(|i| SlideStep {
            slip: i.slip * units.length,
            time: i.time * units.time,
            friction: i.friction * units.force(),
            load: i.load * units.force(),
            mu: if i.load > 0.0 { i.friction / i.load } else { 0.0 },
            area: i.area * units.area(),
            stick_fraction: i.stick_fraction,
            temperature_max: units.temperature + i.rise_max,
            temperature_mean: units.temperature + i.rise_mean,
            plastic_strain_max: i.plastic_strain_max,
            work: energy(i.work),
            energy_elastic: energy(i.elastic + i.springs),
            dissipation_plastic: energy(i.plastic),
            dissipation_friction: energy(i.friction_work),
            work_thermal_expansion: energy(i.thermal_expansion),
            energy_moduli_softening: energy(i.moduli_softening),
            heat_in: energy(i.heat_in),
            heat_stored: energy(i.heat_stored),
            heat_out: energy(i.heat_out),
        })
        .collect();
    let rings = contact.radii.len();
    let columns = angles.len();
    // Stored ring by ring; reported angle by angle.
    let turn = |v: &[f64], scale: f64| -> Vec<f64> {
        (0..columns)
            .flat_map(|j| (0..rings).map(move |k| (k, j)))
            .map(|(k, j)| scale * v[k * columns + j])
            .collect()
    };
    let snapshots = fields
        .iter()
        .map(|f| Snapshot {
            slip: f.slip * units.length,
            pressure: turn(&f.pressure, units.stress),
            shear: turn(&f.shear, units.stress),
            temperature: turn(&f.rise, 1.0).iter().map(|t| units.temperature + t).collect(),
            slip_distance: turn(&f.path, units.length),
        })
        .collect();
    Outcome {
        critical_interference: problem.critical_interference * units.length,
        press: press
            .iter()
            .map(|i| PressStep {
                interference: i.interference / problem.critical_interference,
                load: i.load * units.force(),
                area: i.area * units.area(),
            })
            .collect(),
        slide,
        summary,
        grid: ContactGrid {
            theta: angles.to_vec(),
            r: contact.radii.iter().map(|r| r * units.length).collect(),
        },
        snapshots,
        account,
    }
}
