//! Equilibrium states: the separation at which a surface has a given nominal pressure.

use crate::integral::contact_state::ContactState;
use crate::integral::predictor::{Predictor, SHARED_UNCERTAINTY, Sensitivity};
use crate::integral::surface_integral::SurfaceIntegral;
use tables::functions::{Accuracy, root_between};
use tables::law::LookupError;

/// Reason why no separation has the given pressure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SeparationError {
    #[error(transparent)]
    Lookup(#[from] LookupError),
    #[error("no separation between {from:e} and {to:e} m has a nominal pressure of {pressure:e} Pa")]
    NotFound { pressure: f64, from: f64, to: f64 },
    #[error(
        "no effective separation between {separation:e} and {farthest:e} m agrees with the displacement of the mean plane"
    )]
    NoMeanPlane { separation: f64, farthest: f64 },
    #[error(
        "query.interaction = \"mean-pressure\" needs the contact modulus, which the asperity law {law} does not state"
    )]
    NoModulus { law: String },
    #[error("query.interaction = \"mean-pressure\" needs query.nominal_size")]
    NoNominalSize,
}

/// A state in equilibrium with a nominal pressure, and how it changes with separation.
#[derive(Clone, Copy, Debug)]
pub struct EquilibriumState {
    /// Distance of the flat from the plane of the heights, m.
    pub separation: f64,
    pub state: ContactState,
    pub sensitivity: Sensitivity,
    /// Whether the sensitivity was computed here, not taken from a neighbour.
    pub(crate) own_sensitivity: bool,
}

impl EquilibriumState {
    /// The state at `separation` (m), with its sensitivity to separation.
    pub fn at(integral: &mut SurfaceIntegral, separation: f64) -> Result<Self, LookupError> {
        let state = integral.at(separation)?;
        Self::with_own_sensitivity(integral, separation, state)
    }

    fn with_own_sensitivity(
        integral: &mut SurfaceIntegral,
        separation: f64,
        mut state: ContactState,
    ) -> Result<Self, LookupError> {
        integral.complete_errors(separation, &mut state)?;
        // Wide against the rounding of the integrals, narrow against their curvature.
        let step = -1e-4 * integral.standard_deviation();
        let closer = integral.at(separation + step)?;
        let sensitivity = Sensitivity::between(&state, &closer, step);
        Ok(Self { separation, state, sensitivity, own_sensitivity: true })
    }

    /// Start of the search for a neighbouring state.
    pub fn predictor(&self) -> Predictor {
        let sensitivity = Some(self.sensitivity);
        Predictor { separation: self.separation, slope: self.sensitivity.pressure, sensitivity }
    }

    /// Error of the separation (m): of the pressure, through its slope, and of the root, whose pressure
    /// differs from the `asked` one.
    pub fn separation_error(&self, asked: f64) -> f64 {
        let pressure = self.state.pressure.estimate();
        let wrong = pressure.error + (pressure.value - asked).abs();
        let slope = (self.sensitivity.pressure * pressure.value).abs();
        if slope > 0.0 { wrong / slope } else { f64::INFINITY }
    }
}

/// Secant steps, in two standard deviations of the heights, from which a sensitivity can be taken: long
/// against the rounding of the integrals and short against their curvature.
const SENSITIVITY_STEP: std::ops::Range<f64> = 1e-5..0.02;

/// Number of secant steps after which the bracketing method is used.
const SECANT_STEPS: usize = 8;

/// Finds the separation at which the nominal pressure is `pressure` (Pa) to the tolerance of the integral,
/// starting from a predictor.
///
/// ln p falls almost linearly with separation, so that a secant in ln p from a neighbouring state takes a
/// step or two. Where it does not converge, at the ends of the heights, a
/// bracketing method is used.
pub fn separation_for(
    integral: &mut SurfaceIntegral,
    pressure: f64,
    predictor: Predictor,
) -> Result<EquilibriumState, SeparationError> {
    let (tolerance, longest) = (integral.tolerance(), 2.0 * integral.standard_deviation());
    let (mut here, mut slope) = (predictor.separation, predictor.slope);
    let mut last: Option<(f64, f64, ContactState)> = None;
    for _ in 0..SECANT_STEPS {
        let state = integral.at(here)?;
        let excess = (state.pressure.value / pressure).ln();
        if let (Some(shared), true) = (predictor.sensitivity, last.is_none())
            && tolerance < excess.abs()
            && SHARED_UNCERTAINTY * excess.abs() <= tolerance
            && shared.pressure < 0.0
        {
            return Ok(corrected(integral, here, &state, shared, (pressure, excess))?);
        }
        if excess.abs() <= tolerance {
            // A secant step gives the sensitivity without another integral.
            let step = last.map(|(before, _, beside)| (before - here, beside));
            let step = step.filter(|(step, _)| SENSITIVITY_STEP.contains(&(step.abs() / longest)));
            let own = step.map(|(step, beside)| Sensitivity::between(&state, &beside, step));
            let Some(sensitivity) = own.or(predictor.sensitivity) else {
                return Ok(EquilibriumState::with_own_sensitivity(integral, here, state)?);
            };
            let own_sensitivity = own.is_some();
            let mut found = EquilibriumState { separation: here, state, sensitivity, own_sensitivity };
            integral.complete_errors(here, &mut found.state)?;
            return Ok(found);
        }
        if let Some((before, excess_before, _)) = last {
            slope = (excess - excess_before) / (here - before);
        }
        // Without contact, or where the pressure does not fall, there is no secant.
        if !(slope < 0.0 && excess.is_finite() && slope.is_finite()) {
            break;
        }
        last = Some((here, excess, state));
        here -= (excess / slope).clamp(-longest, longest);
    }
    bracketed(integral, pressure, predictor.separation)
}

/// A state so near to equilibrium that one step with a shared sensitivity is as accurate as a new integral.
fn corrected(
    integral: &mut SurfaceIntegral,
    here: f64,
    state: &ContactState,
    sensitivity: Sensitivity,
    (pressure, excess): (f64, f64),
) -> Result<EquilibriumState, LookupError> {
    let change = -excess / sensitivity.pressure;
    let (separation, mut state) = (here + change, sensitivity.moved(state, change));
    integral.complete_errors(separation, &mut state)?;
    state.pressure.quadrature_error += SHARED_UNCERTAINTY * excess.abs() * pressure;
    Ok(EquilibriumState { separation, state, sensitivity, own_sensitivity: false })
}

/// Doubled strides of the search for a bracket: they reach any separation of interest.
const MOST_STRIDES: usize = 200;

/// Magnitude of ln p in place of that of a zero pressure.
const NO_PRESSURE: f64 = 1e3;

/// Equilibrium at a `pressure` (Pa), by a bracket around `start` (m).
fn bracketed(
    integral: &mut SurfaceIntegral,
    pressure: f64,
    start: f64,
) -> Result<EquilibriumState, SeparationError> {
    let (tolerance, std) = (integral.tolerance(), integral.standard_deviation());
    let mut excess = |separation: f64| -> Result<f64, LookupError> {
        let excess = (integral.at(separation)?.pressure.value / pressure).ln();
        Ok(excess.clamp(-NO_PRESSURE, NO_PRESSURE))
    };
    let value = excess(start)?;
    let (mut closer, mut farther) = ((start, value), (start, value));
    let mut stride = 0.25 * std;
    for _ in 0..MOST_STRIDES {
        if closer.1 < 0.0 {
            farther = closer;
            let separation = closer.0 - stride;
            closer = (separation, excess(separation)?);
        } else if farther.1 > 0.0 {
            closer = farther;
            let separation = farther.0 + stride;
            farther = (separation, excess(separation)?);
        } else {
            break;
        }
        stride *= 2.0;
    }
    let width = 4.0 * f64::EPSILON * closer.0.abs().max(farther.0.abs()).max(std);
    let accuracy = Accuracy { value: tolerance, width };
    let found = root_between(closer.0, farther.0, accuracy, excess)?;
    let not_found = SeparationError::NotFound { pressure, from: closer.0, to: farther.0 };
    Ok(EquilibriumState::at(integral, found.ok_or(not_found)?)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{PowerLaw, asperity};
    use crate::surface::heights::{Empirical, Exponential, Gaussian, Heights, Uniform};
    use crate::surface::radii::ByRadius;

    #[test]
    fn the_separation_of_a_pressure_is_found_again() {
        let law = PowerLaw::hertz();
        let asperities = ByRadius::of_classes(vec![(1.0, asperity(&law))]);
        let std = 1e-6;
        let heights: [&dyn Heights; 3] = [&Gaussian::new(std), &Exponential::new(std), &Uniform::new(std)];
        for heights in heights {
            let mut integral = SurfaceIntegral::new(&asperities, heights, 1e10, 1e-12);
            let origin = Predictor::at(0.0, heights);
            for place in [-3.0, -0.5, 0.1, 1.0, 1.6] {
                let wanted = place * std;
                let pressure = integral.at(wanted).unwrap().pressure.value;
                for found in [
                    separation_for(&mut integral, pressure, origin).unwrap(),
                    bracketed(&mut integral, pressure, 0.0).unwrap(),
                ] {
                    // d(ln p)/dd is of order 1/std, so 1e-12 in ln p is 1e-12 std in d; a factor of 100
                    // for the flat ends.
                    let off = (found.separation - wanted).abs();
                    assert!(off < 1e-10 * std, "{place}: {:e} against {wanted:e}", found.separation);
                }
            }
        }
    }

    #[test]
    fn the_highest_of_a_few_measured_heights_carries_a_light_load() {
        let law = PowerLaw::hertz();
        let asperities = ByRadius::of_classes(vec![(1.0, asperity(&law))]);
        let heights = Empirical::new(vec![0.0, 1e-6, 2.5e-6]).unwrap();
        let mut integral = SurfaceIntegral::new(&asperities, &heights, 1e10, 1e-10);
        let origin = Predictor::at(0.0, &heights);
        let found = separation_for(&mut integral, 1e-3, origin).unwrap();
        assert!(found.separation < 2.5e-6 && found.separation > 2.4e-6);
        // The interference is 1e-14 m of a height of 2.5e-6 m: eight digits are left.
        assert!((found.state.pressure.value - 1e-3).abs() < 1e-10);
    }
}
