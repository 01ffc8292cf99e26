//! The separation at which a surface carries a nominal pressure.

use crate::integral::contact_state::ContactState;
use crate::integral::predictor::{SHARED_DOUBT, Sensitivity, Start};
use crate::integral::surface_integral::ContactIntegral;
use crate::surface::heights::Heights;
use tables::law::LookupError;

/// Why no separation carries the pressure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SeparationError {
    #[error(transparent)]
    Lookup(#[from] LookupError),
    #[error("no separation between {from:e} and {to:e} m carries a nominal pressure of {pressure:e} Pa")]
    NotFound { pressure: f64, from: f64, to: f64 },
}

/// A state that carries the asked pressure, and how it changes with separation.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// Distance of the flat from the plane of the heights, m.
    pub separation: f64,
    pub state: ContactState,
    pub sensitivity: Sensitivity,
    /// Whether the sensitivity was computed here, not taken from a neighbour.
    pub(crate) own_sensitivity: bool,
}

impl Carried {
    /// The state at `separation` (m), with its sensitivity to separation.
    pub fn at(
        integral: &mut impl ContactIntegral,
        heights: &dyn Heights,
        separation: f64,
    ) -> Result<Self, LookupError> {
        let state = integral.at(separation)?;
        Self::of(integral, heights, separation, state)
    }

    /// As [`at`](Self::at), the state at `separation` (m) being known.
    fn of(
        integral: &mut impl ContactIntegral,
        heights: &dyn Heights,
        separation: f64,
        mut state: ContactState,
    ) -> Result<Self, LookupError> {
        integral.complete_errors(separation, &mut state)?;
        // Wide against the rounding of the integrals, narrow against their curvature.
        let step = -1e-4 * heights.standard_deviation();
        let closer = integral.at(separation + step)?;
        Ok(Self::beside(separation, state, Sensitivity::between(&state, &closer, step)))
    }

    fn beside(separation: f64, state: ContactState, sensitivity: Sensitivity) -> Self {
        Self { separation, state, sensitivity, own_sensitivity: true }
    }

    /// Where the search for a neighbouring state starts.
    pub fn start(&self) -> Start {
        let sensitivity = Some(self.sensitivity);
        Start { separation: self.separation, slope: self.sensitivity.pressure, sensitivity }
    }

    /// Error of the separation (m): of the pressure, through its slope, and of the
    /// root, whose pressure differs from the `asked` one.
    pub fn separation_error(&self, asked: f64) -> f64 {
        let pressure = self.state.pressure.estimate();
        let wrong = pressure.error + (pressure.value - asked).abs();
        let slope = (self.sensitivity.pressure * pressure.value).abs();
        if slope > 0.0 { wrong / slope } else { f64::INFINITY }
    }
}

/// Steps of the bracketing and of the root search: doubling reaches any
/// separation of interest in a few, halving any accuracy in sixty.
const MOST_STEPS: usize = 200;

/// Steps of the search, in two standard deviations of the heights, that are long against the
/// rounding of the integrals and short against their curvature.
const USEFUL: std::ops::Range<f64> = 1e-5..0.02;

/// Steps after which the secant gives way to the bracket.
const SECANT_STEPS: usize = 8;

/// Finds the separation at which the nominal pressure is `pressure` (Pa) to a
/// relative `tolerance`, starting from a guess.
///
/// Pressure falls with separation, in its logarithm almost linearly, so a
/// secant in ln(p) from a neighbouring state takes a step or two. Where it loses its way, at the
/// ends of the heights, a bracket does not.
pub fn separation_for(
    integral: &mut impl ContactIntegral,
    heights: &dyn Heights,
    pressure: f64,
    start: Start,
    tolerance: f64,
) -> Result<Carried, SeparationError> {
    let longest = 2.0 * heights.standard_deviation();
    let mut here = start.separation;
    let mut slope = start.slope;
    let mut last: Option<(f64, f64, ContactState)> = None;
    for _ in 0..SECANT_STEPS {
        let state = integral.at(here)?;
        let excess = (state.pressure.value / pressure).ln();
        if let (Some(known), true) = (start.sensitivity, last.is_none())
            && tolerance < excess.abs()
            && SHARED_DOUBT * excess.abs() <= tolerance
            && known.pressure < 0.0
        {
            // So near, a step along what the neighbours know is as good as computing anew.
            let change = -excess / known.pressure;
            let mut carried = Carried::beside(here + change, known.moved(&state, change), known);
            carried.own_sensitivity = false;
            integral.complete_errors(carried.separation, &mut carried.state)?;
            carried.state.pressure.quadrature_error += SHARED_DOUBT * excess.abs() * pressure;
            return Ok(carried);
        }
        if excess.abs() <= tolerance {
            // A step of the search is as good for the sensitivity as one made for it.
            let step = last.map(|(before, _, beside)| (before - here, beside));
            let useful = step.filter(|(step, _)| USEFUL.contains(&(step.abs() / longest)));
            let sensitivity = useful.map(|(step, beside)| Sensitivity::between(&state, &beside, step));
            let Some(known) = sensitivity.or(start.sensitivity) else {
                return Ok(Carried::of(integral, heights, here, state)?);
            };
            let mut carried = Carried::beside(here, state, known);
            carried.own_sensitivity = sensitivity.is_some();
            integral.complete_errors(here, &mut carried.state)?;
            return Ok(carried);
        }
        if let Some((before, excess_before, _)) = last {
            slope = (excess - excess_before) / (here - before);
        }
        // Neither where nothing touches nor where the pressure does not fall is there a secant.
        if !(slope < 0.0 && excess.is_finite() && slope.is_finite()) {
            break;
        }
        last = Some((here, excess, state));
        here -= (excess / slope).clamp(-longest, longest);
    }
    bracketed(integral, heights, pressure, start.separation, tolerance)
}

/// As [`separation_for`], by a bracketed secant from a guess `start` (m).
fn bracketed(
    integral: &mut impl ContactIntegral,
    heights: &dyn Heights,
    pressure: f64,
    start: f64,
    tolerance: f64,
) -> Result<Carried, SeparationError> {
    let mut excess = |separation: f64| -> Result<f64, LookupError> {
        let carried = integral.at(separation)?.pressure.value;
        Ok((carried / pressure).ln())
    };
    let std = heights.standard_deviation();
    let value = excess(start)?;
    let mut closer = (start, value);
    let mut farther = (start, value);
    let mut stride = 0.25 * std;
    for _ in 0..MOST_STEPS {
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
    let not_found = SeparationError::NotFound { pressure, from: closer.0, to: farther.0 };
    if closer.1 < 0.0 || farther.1 > 0.0 || closer.1.is_nan() || farther.1.is_nan() {
        return Err(not_found);
    }

    // Illinois: the value kept at an end that does not move is halved, so that both close in.
    let (mut weight_closer, mut weight_farther) = (closer.1, farther.1);
    let mut width = f64::INFINITY;
    let mut best = if closer.1.abs() < farther.1.abs() { closer } else { farther };
    for step in 0..MOST_STEPS {
        if best.1.abs() <= tolerance {
            break;
        }
        let gap = farther.0 - closer.0;
        if gap <= 4.0 * f64::EPSILON * closer.0.abs().max(farther.0.abs()).max(std) {
            break;
        }
        // No contact at the far end has no logarithm; and a secant that does not
        // halve the bracket in three steps has lost its way.
        let secant = closer.0 + gap * weight_closer / (weight_closer - weight_farther);
        let lost = step % 3 == 2 && gap > 0.5 * width;
        if step % 3 == 2 {
            width = gap;
        }
        let next = if secant.is_finite() && secant > closer.0 && secant < farther.0 && !lost {
            secant
        } else {
            0.5 * (closer.0 + farther.0)
        };
        let value = excess(next)?;
        if value >= 0.0 {
            closer = (next, value);
            weight_closer = value;
            weight_farther *= 0.5;
        } else {
            farther = (next, value);
            weight_farther = value;
            weight_closer *= 0.5;
        }
        if value.abs() < best.1.abs() {
            best = (next, value);
        }
    }
    if !best.1.is_finite() {
        return Err(not_found);
    }
    Ok(Carried::at(integral, heights, best.0)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::asperity_at_slip::AsperityAtSlip;
    use crate::integral::height_integral::HeightIntegral;
    use crate::integral::test_laws::PowerLaw;
    use crate::surface::heights::{Exponential, Gaussian, Sample, Uniform};

    #[test]
    fn the_pressure_of_a_separation_leads_back_to_it() {
        let law = PowerLaw::hertz();
        let asperity = AsperityAtSlip::new(&law, 1e-4, 1.0, 0.0).unwrap();
        let std = 1e-6;
        let heights: [Box<dyn Heights>; 3] =
            [Box::new(Gaussian::new(std)), Box::new(Exponential::new(std)), Box::new(Uniform::new(std))];
        for heights in heights {
            let heights = heights.as_ref();
            let mut integral = HeightIntegral::new(asperity.clone(), heights, 1e10, 1e-12);
            let origin = Start::at(0.0, heights);
            for place in [-3.0, -0.5, 0.1, 1.0, 1.6] {
                let wanted = place * std;
                let pressure = integral.at(wanted).unwrap().pressure.value;
                let found = separation_for(&mut integral, heights, pressure, origin, 1e-12).unwrap();
                // d(ln p)/dd is of order 1/std, so 1e-12 in ln p is 1e-12 std in d;
                // hundredfold for the flat ends.
                assert!(
                    (found.separation - wanted).abs() < 1e-10 * std,
                    "{place}: {:e} against {wanted:e}",
                    found.separation
                );
            }
        }
    }

    #[test]
    fn few_measured_heights_carry_a_light_load_too() {
        let law = PowerLaw::hertz();
        let asperity = AsperityAtSlip::new(&law, 1e-4, 1.0, 0.0).unwrap();
        let heights = Sample::new(vec![0.0, 1e-6, 2.5e-6]).unwrap();
        let mut integral = HeightIntegral::new(asperity.clone(), &heights, 1e10, 1e-10);
        let found = separation_for(&mut integral, &heights, 1e-3, Start::at(0.0, &heights), 1e-10).unwrap();
        assert!(found.separation < 2.5e-6 && found.separation > 2.4e-6);
        // The interference is 1e-14 m of a height of 2.5e-6 m: eight digits are left.
        assert!((found.state.pressure.value - 1e-3).abs() < 1e-10);
    }
}
