//! From the history of a slide to the scalars that are reported, in SI units.

use std::f64::consts::PI;

use tables::quantity::Quantity;

use crate::outcome::InceptionCriterion;
use crate::press::Increment;
use crate::problem::Problem;
use crate::scene::Scene;
use crate::slide::{Instant, NO_STICK};

/// Sliding has begun when dQ/ds is below this share of its first value.
const STIFFNESS_SHARE: f64 = 0.01;
/// Relative change of μ over the last quarter of the slide below which it has levelled off.
const LEVEL: f64 = 0.02;
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
    values: [f64; QUANTITIES],
    /// What the state of sliding inception, between two states, leaves open.
    brackets: [f64; QUANTITIES],
    /// T₀, K.
    start: f64,
    /// Whether the press was elastic: less deep than first yield without friction.
    pub elastic: bool,
    pub inception: InceptionCriterion,
    pub levelled: bool,
}

const QUANTITIES: usize = Quantity::ALL.len();

impl Scalars {
    pub fn new(problem: &Problem, scene: &Scene, press: &[Increment], history: &[Instant]) -> Self {
        let units = problem.units;
        let last = history.last().expect("a history starts with the press");
        let pressed = press.last().expect("a press has increments");
        let inception = inception(history);
        let mu = |i: &Instant| {
            if i.load > 0.0 { i.friction / i.load } else { 0.0 }
        };
        let energy = units.stress * units.length;
        let start = scene.loading.temperature;
        let values = Quantity::ALL.map(|quantity| match quantity {
            Quantity::Mu => mu(last),
            Quantity::MuStatic if inception.load > 0.0 => inception.friction / inception.load,
            Quantity::MuStatic => 0.0,
            Quantity::MuPeak => history.iter().map(mu).fold(0.0, f64::max),
            Quantity::Friction => last.friction * units.force(),
            Quantity::FrictionStatic => inception.friction * units.force(),
            Quantity::Load => last.load * units.force(),
            Quantity::LoadPress => pressed.load * units.force(),
            Quantity::Area => last.area * units.area(),
            Quantity::AreaPress => pressed.area * units.area(),
            Quantity::ContactRadius => (pressed.area / PI).sqrt() * units.length,
            Quantity::EnergyRelease => inception.energy_release * energy,
            Quantity::EnergyWeakening => weakening(history) * energy,
            Quantity::TemperatureMax => start + history.iter().map(|i| i.rise_max).fold(0.0, f64::max),
            Quantity::TemperatureMean => start + last.rise_mean,
            Quantity::InceptionSlip => inception.slip * units.length,
        });
        let brackets = Quantity::ALL.map(|quantity| match quantity {
            Quantity::EnergyRelease => inception.energy_bracket * energy,
            Quantity::InceptionSlip => inception.slip_bracket * units.length,
            _ => 0.0,
        });
        let elastic = problem.interference < problem.critical_interference;
        Self { values, brackets, start, elastic, inception: inception.criterion, levelled: levelled(history) }
    }

    pub fn value(&self, quantity: Quantity) -> f64 {
        self.values[quantity as usize]
    }

    /// |value|; of a temperature, its rise.
    pub fn magnitude(&self, quantity: Quantity) -> f64 {
        let origin = if quantity.is_temperature() { self.start } else { 0.0 };
        (self.value(quantity) - origin).abs()
    }

    /// Half the difference between the states on both sides of sliding inception.
    pub fn bracket(&self, quantity: Quantity) -> f64 {
        self.brackets[quantity as usize]
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
