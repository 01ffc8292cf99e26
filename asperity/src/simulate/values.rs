//! From the histories of press and slide to the scalars of a run, in SI units: one formula each.

use std::f64::consts::PI;

use tables::quantity::{Estimate, Quantity};

use crate::loading::inception::{Inception, InceptionCriterion, between, inception};
use crate::loading::press::Increment;
use crate::loading::problem::{Problem, Units};
use crate::loading::state::SlideState;
use crate::simulate::steady::{last_slip, steady_friction};

/// Relative change of μ over the last quarter of the slide below which it is steady.
const STEADY_CHANGE: f64 = 0.02;

/// Share of ∫τ̄ ds below which its loss by weakening is a rounding error.
const ROUNDING: f64 = 1e-9;

/// The scalars of one run, SI, without errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    values: [f64; QUANTITIES],
    /// Uncertainties that no finer resolution removes, see [`Values::bracket`].
    brackets: [f64; QUANTITIES],
    /// T₀, K.
    start: f64,
    pub inception: InceptionCriterion,
    /// Whether μ is steady at the end of the slide.
    pub steady: bool,
    /// Sum of the relative residuals of stagnant steps.
    pub residual: f64,
}

const QUANTITIES: usize = Quantity::SCALARS.len();

impl Values {
    pub fn new(problem: &Problem, press: &[Increment], history: &[SlideState]) -> Self {
        let units = problem.units;
        let last = history.last().expect("a history starts with the press");
        let pressed = press.last().expect("a press has increments");
        // Without friction the values are rounding errors, without a slide there are none.
        let slides = history.len() > 1;
        let has_friction = problem.interface.law.has_friction() && slides;
        let none = if slides { 0.0 } else { f64::NAN };
        let (first, latest) = (first_step(history), last_slip(history));
        let inception = if has_friction { inception(first) } else { Inception::none(history) };
        let friction = if has_friction { last.friction } else { none };
        let mu = |i: &SlideState| if has_friction { i.mu() } else { none };
        let steady = if has_friction { steady_friction(&latest) } else { Estimate::exact(none) };
        let energy = units.stress * units.length;
        let start = units.temperature;
        let values = Quantity::SCALARS.map(|quantity| match quantity {
            Quantity::Mu => mu(last),
            Quantity::MuPeak if has_friction => history.iter().map(|i| mu(i).abs()).fold(0.0, f64::max),
            Quantity::MuMean if has_friction => mean_friction(history),
            Quantity::MuPeak | Quantity::MuMean => none,
            Quantity::Friction => friction * units.force(),
            Quantity::Load => last.load * units.force(),
            Quantity::LoadPress => pressed.load * units.force(),
            Quantity::Area => last.area * units.area(),
            Quantity::AreaPress => pressed.area * units.area(),
            Quantity::ContactRadius => (pressed.area / PI).sqrt() * units.length,
            Quantity::EnergyWeakening if has_friction => weakening(first) * energy,
            Quantity::EnergyWeakening => none,
            Quantity::TemperatureMax => start + history.iter().map(|i| i.rise_max).fold(0.0, f64::max),
            Quantity::TemperatureMean => start + last.rise_mean,
            Quantity::MuSteady => steady.value,
            Quantity::HeatPartition => last.heat_partition,
            quantity => match of_inception(&inception, quantity, &units) {
                Some(value) if slides => value,
                Some(_) => none,
                None => unreachable!("{quantity:?} is not a scalar"),
            },
        });
        let others = inception.by_other_thresholds(first);
        let brackets = Quantity::SCALARS.map(|quantity| {
            let bracket = match quantity {
                Quantity::FrictionStatic => inception.friction_bracket * units.force(),
                Quantity::MuStatic if inception.load > 0.0 => inception.friction_bracket / inception.load,
                Quantity::EnergyRelease => inception.energy_bracket * energy,
                Quantity::InceptionSlip => inception.slip_bracket * units.length,
                Quantity::MuSteady => steady.error,
                _ => 0.0,
            };
            let other = others.iter().filter_map(|other| of_inception(other, quantity, &units));
            let here = of_inception(&inception, quantity, &units).unwrap_or_default();
            bracket + other.map(|other| (other - here).abs()).fold(0.0, f64::max)
        });
        let inception = inception.criterion;
        Self { values, brackets, start, inception, steady: slides && is_steady(&latest), residual: 0.0 }
    }

    /// The same value for every quantity.
    #[cfg(test)]
    pub fn all(value: f64) -> Self {
        Self {
            values: [value; QUANTITIES],
            brackets: [0.0; QUANTITIES],
            start: 0.0,
            inception: InceptionCriterion::None,
            steady: false,
            residual: 0.0,
        }
    }

    /// These values with the temperature rise (K) to expect of a slide without heat.
    pub fn with_expected_rise(mut self, rise: f64) -> Self {
        for quantity in [Quantity::TemperatureMax, Quantity::TemperatureMean] {
            self.values[quantity as usize] += rise;
        }
        self
    }

    /// Takes the steady friction by its ratio to that at the end of the slide.
    pub fn set_steady_friction(&mut self, ratio: Estimate) {
        let steady = ratio.scaled(self.value(Quantity::Mu));
        self.values[Quantity::MuSteady as usize] = steady.value;
        self.brackets[Quantity::MuSteady as usize] = steady.error;
    }

    /// The trend of a slide that did not finish is not one towards a steady state.
    pub fn forget_steady_friction(&mut self) {
        // Without friction it is 0.
        if self.value(Quantity::MuSteady) != 0.0 {
            self.set_steady_friction(Estimate::UNKNOWN);
            self.steady = false;
        }
    }

    pub fn value(&self, quantity: Quantity) -> f64 {
        self.values[quantity as usize]
    }

    /// |value|; of a temperature, its rise.
    pub fn magnitude(&self, quantity: Quantity) -> f64 {
        let origin = if quantity.is_temperature() { self.start } else { 0.0 };
        (self.value(quantity) - origin).abs()
    }

    /// Change of the value over the uncertainty of sliding inception between two states, and where the stiffness
    /// decides on it by another threshold; of the steady friction, its uncertainty by the length of the slide.
    pub fn bracket(&self, quantity: Quantity) -> f64 {
        self.brackets[quantity as usize]
    }
}

/// Values of sliding inception, SI; none of other quantities.
fn of_inception(inception: &Inception, quantity: Quantity, units: &Units) -> Option<f64> {
    Some(match quantity {
        Quantity::MuStatic if inception.load > 0.0 => inception.friction / inception.load,
        Quantity::MuStatic => 0.0,
        Quantity::FrictionStatic => inception.friction * units.force(),
        Quantity::EnergyRelease => inception.energy_release * units.stress * units.length,
        Quantity::InceptionSlip => inception.slip * units.length,
        _ => return None,
    })
}

/// The states of the first step of the programme.
fn first_step(history: &[SlideState]) -> &[SlideState] {
    &history[..history.iter().take_while(|state| state.step == 0).count()]
}

/// ∫Q ds/∫P |ds| over the slide, trapezoidal; 0 without load. Q reverses with slip.
fn mean_friction(history: &[SlideState]) -> f64 {
    let integral = |of: fn(&SlideState) -> f64, length: fn(f64) -> f64| -> f64 {
        history.windows(2).map(|w| 0.5 * (of(&w[0]) + of(&w[1])) * length(w[1].slip - w[0].slip)).sum()
    };
    let load = integral(|state| state.load, f64::abs);
    if load > 0.0 { integral(|state| state.friction, |slip| slip) / load } else { 0.0 }
}

/// ∫(τ̄ − τ̄_end) ds from the peak of τ̄ = Q/A to the end, trapezoidal; 0 where it is a rounding error of ∫τ̄ ds, as at
/// constant strength: interpolation takes the logarithm of what is positive.
fn weakening(history: &[SlideState]) -> f64 {
    let stress = |i: &SlideState| {
        if i.area > 0.0 { i.friction / i.area } else { 0.0 }
    };
    let peak =
        (0..history.len()).max_by(|&a, &b| stress(&history[a]).total_cmp(&stress(&history[b]))).unwrap_or(0);
    let end = history.last().map_or(0.0, stress);
    let (mut total, mut lost) = (0.0_f64, 0.0_f64);
    for w in history[peak..].windows(2) {
        let mean = 0.5 * (stress(&w[0]) + stress(&w[1]));
        total += mean * (w[1].slip - w[0].slip);
        lost += (mean - end) * (w[1].slip - w[0].slip);
    }
    if lost.abs() > ROUNDING * total.abs() { lost } else { 0.0 }
}

fn is_steady(history: &[SlideState]) -> bool {
    let last = history.last().expect("not empty");
    let earlier = between(history, 0.75 * last.slip);
    let change = (earlier.mu() - last.mu()).abs();
    last.load > 0.0 && earlier.load > 0.0 && change <= STEADY_CHANGE * last.mu().abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Step, displacement, time, Q/P: forwards at μ = 0.3 and 0.4, a hold, backwards at 0.2, a hold.
    fn programme() -> Vec<SlideState> {
        let states = [
            (0, 0.0, 0.0, 0.3),
            (0, 1.0, 1.0, 0.3),
            (1, 1.0, 1.0, 0.4),
            (1, 3.0, 2.0, 0.4),
            (2, 3.0, 9.0, 0.4),
            (3, 3.0, 9.0, -0.2),
            (3, 1.0, 10.0, -0.2),
            (4, 1.0, 20.0, -0.1),
        ];
        let state = |(step, slip, time, friction)| SlideState {
            step,
            slip,
            time,
            friction,
            load: 1.0,
            ..SlideState::default()
        };
        states.map(state).to_vec()
    }

    #[test]
    fn scalars_of_a_programme_are_of_its_first_and_of_its_last_slip() {
        let history = programme();
        assert_eq!(first_step(&history).len(), 2);
        let latest: Vec<_> = last_slip(&history).iter().map(|i| (i.slip, i.time, i.friction)).collect();
        assert_eq!(latest, [(0.0, 0.0, 0.4), (0.0, 0.0, -0.2), (2.0, 1.0, -0.2)]);
        // 0.3 over 1, 0.4 over 2 and 0.2 over 2.
        assert!((mean_friction(&history) - 1.5 / 5.0).abs() < 1e-15);
        // Without a programme both are the slide itself.
        let single = &history[..2];
        assert_eq!((first_step(single), &last_slip(single)[..]), (single, single));
    }
}
