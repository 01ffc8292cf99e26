//! Predictors of the separation: where the search for the next equilibrium state starts.

use crate::integral::contact_state::{ContactState, Integral};
use crate::surface::heights::Heights;

/// How a state changes with separation: d ln(quantity)/d(separation), 1/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensitivity {
    pub pressure: f64,
    pub friction_coefficient: f64,
    pub area_fraction: f64,
    pub contact_density: f64,
    pub additional: f64,
}

impl Sensitivity {
    /// Sensitivity by the difference of a state and another one `step` (m) farther from the surface.
    pub(crate) fn between(state: &ContactState, farther: &ContactState, step: f64) -> Self {
        let relative = |quantity: fn(&ContactState) -> f64| {
            let (here, there) = (quantity(state), quantity(farther));
            // Zero at both, its logarithm does not exist; it does not change.
            if here == there { 0.0 } else { (there - here) / (here * step) }
        };
        Self {
            pressure: relative(|state| state.pressure.value),
            friction_coefficient: relative(|state| state.friction_coefficient().value),
            area_fraction: relative(|state| state.area_fraction.value),
            contact_density: relative(|state| state.contact_density),
            additional: relative(|state| state.additional.map_or(0.0, |additional| additional.value)),
        }
    }

    /// The state `change` (m) farther from the surface, to first order.
    pub(crate) fn moved(&self, state: &ContactState, change: f64) -> ContactState {
        let scaled = |integral: Integral, slope: f64| {
            let factor = 1.0 + slope * change;
            Integral {
                value: integral.value * factor,
                law_error: integral.law_error * factor,
                quadrature_error: integral.quadrature_error * factor,
            }
        };
        let of_shear = 1.0 + (self.pressure + self.friction_coefficient) * change;
        ContactState {
            pressure: scaled(state.pressure, self.pressure),
            shear: scaled(state.shear, self.pressure + self.friction_coefficient),
            area_fraction: scaled(state.area_fraction, self.area_fraction),
            additional: state.additional.map(|additional| scaled(additional, self.additional)),
            contact_density: state.contact_density * (1.0 + self.contact_density * change),
            coefficient_error: state.coefficient_error * of_shear,
            shear_by_load_error: state.shear_by_load_error * of_shear,
            ..*state
        }
    }
}

/// Start of the search for a separation.
#[derive(Clone, Copy, Debug)]
pub struct Predictor {
    /// m.
    pub separation: f64,
    /// d ln(pressure)/d(separation) there, 1/m: negative.
    pub slope: f64,
    /// Sensitivity of a neighbouring state, near enough to be used in place of a new one.
    pub(crate) sensitivity: Option<Sensitivity>,
}

impl Predictor {
    /// A start at `separation` (m), without a neighbouring state: in the tails of most distributions the pressure
    /// falls by about e within a standard deviation.
    pub fn at(separation: f64, heights: &dyn Heights) -> Self {
        Self { separation, slope: -1.0 / heights.standard_deviation(), sensitivity: None }
    }
}

/// Consecutive slips that may share one sensitivity.
const SHARED_STEPS: usize = 4;

/// Relative uncertainty of a shared sensitivity.
pub(crate) const SHARED_UNCERTAINTY: f64 = 0.05;

/// Order of the polynomial through the last separations that predicts the next.
const ORDER: usize = 3;

/// The last separations of a slide in even steps of ln s, and the prediction of the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PredictorHistory {
    last: Predictor,
    /// Backward differences of the separations, m: first, second, third.
    differences: [f64; ORDER],
    steps: usize,
    /// Steps since the sensitivity was computed.
    age: usize,
}

impl From<Predictor> for PredictorHistory {
    fn from(predictor: Predictor) -> Self {
        Self { last: predictor, differences: [0.0; ORDER], steps: 0, age: 0 }
    }
}

impl PredictorHistory {
    /// Prediction of the next separation.
    pub(crate) fn next(&self) -> Predictor {
        let sensitivity = self.last.sensitivity.filter(|_| self.steps > 0 && self.age < SHARED_STEPS);
        let separation = self.last.separation + self.differences.iter().sum::<f64>();
        Predictor { separation, sensitivity, ..self.last }
    }

    /// Adds the state found, and whether its sensitivity was computed there.
    pub(crate) fn add(&mut self, found: Predictor, own_sensitivity: bool) {
        let mut difference = found.separation - self.last.separation;
        for (order, known) in self.differences.iter_mut().enumerate() {
            // The first predictor is for another slip and does not enter the differences.
            let next = difference - *known;
            *known = if order < self.steps { difference } else { 0.0 };
            difference = next;
        }
        self.age = if own_sensitivity { 0 } else { self.age + 1 };
        self.last = found;
        self.steps += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_predicted_exactly_and_a_sensitivity_is_shared_for_four_steps() {
        let known = Sensitivity { pressure: -1.0, ..Sensitivity::default() };
        let at = |separation| Predictor { separation, slope: -1.0, sensitivity: Some(known) };
        let mut history = PredictorHistory::from(at(5.0));
        assert_eq!(history.next().separation, 5.0);
        assert!(history.next().sensitivity.is_none(), "that of another slip");
        let cubic = |n: f64| 1.0 - 2.0 * n + 0.5 * n * n - 0.125 * n * n * n;
        for n in 0..4 {
            history.add(at(cubic(f64::from(n))), true);
        }
        for n in 4..4 + SHARED_STEPS as i32 {
            assert!((history.next().separation - cubic(f64::from(n))).abs() < 1e-13);
            assert_eq!(history.next().sensitivity, Some(known));
            history.add(at(cubic(f64::from(n))), false);
        }
        assert!(history.next().sensitivity.is_none());
    }

    #[test]
    fn sensitivities_are_relative() {
        let mut state = ContactState { contact_density: 2.0, ..ContactState::default() };
        state.pressure.value = 10.0;
        let mut farther = state;
        farther.pressure.value = 9.0;
        let found = Sensitivity::between(&state, &farther, 0.5);
        assert!((found.moved(&state, 0.25).pressure.value - 9.5).abs() < 1e-14);
        assert!((found.pressure + 0.2).abs() < 1e-15);
        assert_eq!((found.contact_density, found.area_fraction), (0.0, 0.0));
    }
}
