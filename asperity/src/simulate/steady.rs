//! Steady friction: the value that μ tends to as the slide goes on.
//!
//! The contact is a heat source at rest in the asperity. Its temperature rise approaches that of the steady state as
//! 1/√t (Carslaw & Jaeger 1959, section 10.4), and so does the strength of the interface:
//!
//! μ(s) = μ_∞ + c/√s,   μ_∞ = 2μ(s) − μ(s/4)
//!
//! While heat has not yet diffused through the contact, Fo = κt/a² < 4 at s, the rise grows as √t at most, and a change by
//! Δμ from s/4 to s is one by up to 2Δμ/√Fo from s to the steady state. Friction that falls ends between its present
//! value and zero.

use std::f64::consts::PI;

use tables::quantity::Estimate;

use crate::loading::inception::between;
use crate::loading::state::SlideState;

/// μ_∞ of a slide up to its last state. The uncertainty is the change from there to the steady state, and the difference
/// to the value of a slide half as long: thermal expansion changes friction with the logarithm of slip,
/// which the two cover for a tenfold slip.
pub fn steady_friction(history: &[SlideState]) -> Estimate {
    let Some(last) = history.last() else { return Estimate::UNKNOWN };
    let mu = |slip: f64| between(history, slip).mu();
    let tends_to = |slip: f64| 2.0 * mu(slip) - mu(0.25 * slip);
    let value = tends_to(last.slip);
    // Without heat friction does not depend on time.
    let fourier = if last.area > 0.0 && last.heat_in != 0.0 { PI * last.time / last.area } else { 0.0 };
    let early = if fourier > 0.0 { (2.0 / fourier.sqrt()).max(1.0) } else { 1.0 };
    let now = mu(last.slip);
    let found = Estimate::with_errors(value, [early * (value - now), value - tends_to(0.5 * last.slip)]);
    match value / now {
        share if share < 0.0 => Estimate { value: 0.5 * now, error: 0.5 * now.abs() },
        share if share < 1.0 => {
            Estimate { error: found.error.min(value.abs().max((now - value).abs())), ..found }
        }
        _ => found,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// μ of a slip, at slips that grow by a tenth.
    fn slide(end: f64, mu: impl Fn(f64) -> f64) -> Vec<SlideState> {
        let slips = (0..).map(|n| 1e-3 * 1.1f64.powi(n)).take_while(|slip| *slip < end).chain([end]);
        slips
            .map(|slip| SlideState { slip, load: 2.0, friction: 2.0 * mu(slip), ..SlideState::default() })
            .collect()
    }

    #[test]
    fn friction_of_a_source_at_rest_is_extrapolated() {
        let found = steady_friction(&slide(20.0, |slip| 0.1 + 0.05 / slip.sqrt()));
        // Linear between states a tenth apart: up to 3/32 of 0.01 of the transient part.
        assert!((found.value - 0.1).abs() < 1e-4, "{found:?}");
        assert!((found.error - 0.05 / 20f64.sqrt()).abs() < 3e-4, "{found:?}");
    }

    /// Before heat has diffused through the contact.
    #[test]
    fn friction_that_falls_with_the_square_root_of_slip_is_not_steady() {
        let (fourier, end) = (0.01f64, 2.0f64);
        let history: Vec<SlideState> = slide(end, |slip| 0.3 - 0.01 * (slip / end).sqrt())
            .into_iter()
            .map(|state| SlideState { area: PI, heat_in: 1.0, time: fourier * state.slip / end, ..state })
            .collect();
        // Up to Fo = 1 it falls to 0.2.
        let found = steady_friction(&history);
        assert!((found.value - 0.2).abs() < found.error, "{found:?}");
    }

    /// It cannot fall below zero, nor rise again; also after a reversal.
    #[test]
    fn friction_that_falls_ends_between_its_present_value_and_zero() {
        for direction in [1.0, -1.0] {
            let of = |fall: f64| {
                let mut history = slide(2.0, |slip| direction * (0.3 - fall * (slip / 2.0).sqrt()));
                for state in &mut history {
                    (state.area, state.heat_in, state.time) = (PI, 1.0, 1e-4 * state.slip / 2.0);
                }
                steady_friction(&history)
            };
            let (slow, fast) = (of(0.1), of(0.18));
            // 2 × 0.2 − 0.25 and 2 × 0.12 − 0.21.
            assert!(
                (slow.value - direction * 0.15).abs() < 1e-3 && (slow.error - 0.15).abs() < 1e-3,
                "{slow:?}"
            );
            assert!(
                (fast.value - direction * 0.03).abs() < 1e-3 && (fast.error - 0.09).abs() < 1e-3,
                "{fast:?}"
            );
            let faster = of(0.25);
            assert!((faster.value - direction * 0.025).abs() < 1e-12 && (faster.error - 0.025).abs() < 1e-12);
        }
    }

    #[test]
    fn a_steady_slide_has_no_uncertainty() {
        let found = steady_friction(&slide(2.0, |_| 0.3));
        assert!((found.value - 0.3).abs() < 1e-15 && found.error < 1e-15);
    }

    #[test]
    fn friction_that_falls_with_the_logarithm_of_slip_is_covered_for_a_tenfold_slip() {
        let mu = |slip: f64| 0.3 - 0.02 * (1.0 + slip).ln();
        let found = steady_friction(&slide(20.0, mu));
        assert!((found.value - mu(200.0)).abs() < found.error, "{found:?}, {}", mu(200.0));
    }
}
