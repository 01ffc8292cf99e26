//! Slip at which all of the contact slips, from the share of its shear strength that is not yet mobilised.
//!
//! The place and the slip of the last point that sticks depend on mesh and angles; the share r of the shear strength that
//! is not mobilised is an integral over the contact and does not. As the stick area shrinks to a point in proportion to
//! s_i − s, r falls as (s_i − s)^{3/2}: exactly so in Coulomb friction of a Hertzian contact (Mindlin 1949), for small r under
//! a uniform strength (Savkoor 1987), where the extrapolated slip is 0.1 to 0.5 % too large; see
//! [`tables::closed_forms::partial_slip`].

use tables::interpolation::steffen::Steffen;

use super::state::SlideState;

/// Values of r from which the slip is extrapolated to r = 0; the second is the last r before full slip where that is larger,
/// up to half of the first.
const UNMOBILISED: [f64; 2] = [0.08, 0.01];
/// Of c²/a², which is proportional to the power 2/3 of r.
const EXPONENT: f64 = 2.0 / 3.0;
/// r of full slip, by rounding.
const NOTHING: f64 = 1e-6;

/// s_i, if states before full slip are close enough to it.
pub fn slip_of_full_mobilisation(history: &[SlideState]) -> Option<f64> {
    // r and the slip; states in which r rises again are passed over.
    let mut falling: Vec<(f64, f64)> = Vec::new();
    for state in history {
        let rest = 1.0 - state.mobilised;
        if rest < NOTHING {
            break;
        }
        if falling.last().is_none_or(|&(last, slip)| rest < last && state.slip > slip) {
            falling.push((rest, state.slip));
        }
    }
    let [more, less] = UNMOBILISED;
    let less = less.max(falling.last()?.0);
    if less > 0.5 * more {
        return None;
    }
    let (rest, slips) = falling.into_iter().rev().map(|(rest, slip)| (rest.powf(EXPONENT), slip)).unzip();
    let slip = Steffen::new(rest, slips);
    let [more, less] = [more, less].map(|rest| rest.powf(EXPONENT));
    let [early, late] = [more, less].map(|rest| slip.value(rest));
    Some(late + (late - early) * less / (more - less))
}

#[cfg(test)]
mod tests {
    use tables::closed_forms::partial_slip::{constant_shear, mindlin};

    use super::*;

    /// States that approach the gross slip (1) by half of the way, as those of a slide, and one beyond it.
    #[test]
    fn closed_forms_are_extrapolated_to_their_gross_slip() {
        for (mobilised, exact, tolerance) in [
            (mindlin::force_fraction as fn(f64) -> f64, 1.0, 1e-3),
            (constant_shear::force_fraction, 1.0025, 2.5e-3),
        ] {
            let at = |slip: f64| SlideState { slip, mobilised: mobilised(slip), ..SlideState::default() };
            for last in [0.94, 0.97, 0.99] {
                let slips = [0.0, 0.1, 0.2, 0.3, 0.4, 0.52, 0.63, 0.76, 0.88, last, 1.01, 1.2];
                let history = slips.map(at);
                let found = slip_of_full_mobilisation(&history).unwrap();
                assert!((found - exact).abs() < tolerance, "{exact} {last}: {found}");
                assert_eq!(slip_of_full_mobilisation(&history[..8]), None);
            }
        }
    }

    #[test]
    fn an_infinite_strength_is_never_mobilised() {
        let stuck = [0.0, 0.5, 1.0].map(|slip| SlideState { slip, ..SlideState::default() });
        assert_eq!(slip_of_full_mobilisation(&stuck), None);
    }
}
