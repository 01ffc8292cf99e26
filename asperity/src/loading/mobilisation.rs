//! Slip of full mobilisation, extrapolated from the share r of the shear strength that is not mobilised.
//!
//! The position and the slip of the last point that sticks depend on mesh and angles; r is an integral over the contact and
//! depends on them less. As the stick area shrinks to a point in proportion to s_i − s, r falls as (s_i − s)^{3/2}: exactly so
//! in Coulomb friction of a Hertzian contact (Mindlin 1949), for small r under a uniform strength (Savkoor 1987); see
//! [`tables::closed_forms::partial_slip`]. Where heat or plastic flow lets points stick close to their strength over a long slip,
//! r has a tail; s_i is then a convention.

use tables::interpolation::steffen::Steffen;

use super::state::SlideState;
use crate::scene::fitted_constants::sliding_inception::UNMOBILISED;

/// r^{2/3} is proportional to the stick area, which is linear in s near s_i.
const EXPONENT: f64 = 2.0 / 3.0;
/// r below this is rounding: all points slip.
const NOTHING: f64 = 1e-6;

/// s_i from the slips at which r has the two values of [`UNMOBILISED`]. If the smallest r before full slip exceeds the second,
/// it replaces it, and s_i is at most the slip of the first state of full slip; above half of the first value there is no s_i,
/// nor beyond the end of the slide.
pub fn slip_of_full_mobilisation(history: &[SlideState]) -> Option<f64> {
    // r and the slip; states in which r rises again, or the shear tractions of the press are not yet turned, are passed over.
    let mut falling: Vec<(f64, f64)> = Vec::new();
    let mut end = history.last()?.slip;
    for state in history {
        let rest = 1.0 - state.mobilised;
        if rest < NOTHING && state.is_along_motion() {
            end = state.slip;
            break;
        }
        let later = |&(last, slip): &(f64, f64)| rest < last && state.slip > slip && state.is_along_motion();
        if falling.last().is_none_or(later) {
            falling.push((rest, state.slip));
        }
    }
    let [more, less] = UNMOBILISED;
    let last = falling.last()?.0;
    if last > 0.5 * more {
        return None;
    }
    let (rest, slips) = falling.into_iter().rev().map(|(rest, slip)| (rest.powf(EXPONENT), slip)).unzip();
    let slip = Steffen::new(rest, slips);
    let [more, least] = [more, less.max(last)].map(|rest| rest.powf(EXPONENT));
    let [early, late] = [more, least].map(|rest| slip.value(rest));
    let found = late + (late - early) * least / (more - least);
    if last > less {
        return Some(found.min(end));
    }
    (found <= history.last()?.slip).then_some(found)
}

#[cfg(test)]
mod tests {
    use tables::closed_forms::partial_slip::{constant_shear, mindlin};

    use super::*;

    /// States that approach the gross slip (1) by half of the way, as those of a slide, and one beyond it.
    #[test]
    fn closed_forms_are_extrapolated_to_their_gross_slip() {
        for mobilised in [mindlin::force_fraction, constant_shear::force_fraction] {
            let at = |slip: f64| SlideState { slip, mobilised: mobilised(slip), ..SlideState::default() };
            for last in [0.96, 0.98, 0.99] {
                let slips = [0.0, 0.1, 0.2, 0.3, 0.4, 0.52, 0.63, 0.76, 0.88, last, 1.01, 1.2];
                let history = slips.map(at);
                let found = slip_of_full_mobilisation(&history).unwrap();
                assert!((found - 1.0).abs() < 1e-3, "{last}: {found}");
                assert_eq!(slip_of_full_mobilisation(&history[..8]), None);
            }
        }
    }

    /// The strength is mobilised at once by the shear tractions of the press, which turn into the motion.
    #[test]
    fn released_tractions_of_the_press_are_passed_over() {
        let at = |slip: f64| {
            let mobilised = constant_shear::force_fraction(slip);
            let released = slip > 0.0 && slip < 0.4;
            let transverse = if released { 0.9 } else { 0.1 };
            let mobilised = if released { 1.0 } else { mobilised };
            SlideState { slip, mobilised, transverse, ..SlideState::default() }
        };
        let slips = [0.0, 0.01, 0.1, 0.2, 0.3, 0.4, 0.52, 0.63, 0.76, 0.88, 0.98, 1.01, 1.2];
        let found = slip_of_full_mobilisation(&slips.map(at)).unwrap();
        assert!((found - 1.0).abs() < 1e-3, "{found}");
    }

    #[test]
    fn an_infinite_strength_is_never_mobilised() {
        let stuck = [0.0, 0.5, 1.0].map(|slip| SlideState { slip, ..SlideState::default() });
        assert_eq!(slip_of_full_mobilisation(&stuck), None);
    }
}
