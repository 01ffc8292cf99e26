//! Where a slide stands, in words.

use std::fmt::Write;

use crate::loading::problem::Units;
use crate::loading::slide::SlideState;

/// One line on the last state of a slide.
pub fn in_words(units: &Units, history: &[SlideState]) -> String {
    let [start, .., now] = history else { return String::new() };
    // Radii of circles of the contact's area.
    let radius = |instant: &SlideState| (instant.area / std::f64::consts::PI).sqrt();
    let mut text = format!(
        "step {}, slip {:.3} a0, contact radius {:.3} a0, mu {:.3}, {:.0} % sticks",
        history.len() - 1,
        now.slip / radius(start),
        radius(now) / radius(start),
        now.friction / now.load,
        100.0 * now.stick_fraction,
    );
    if now.rise_max > 0.0 {
        // Writing to a String cannot fail.
        let _ = write!(text, ", up to {:.0} K", units.temperature + now.rise_max);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_state_is_described_relative_to_the_first() {
        let units = Units { length: 1e-3, stress: 1e9, time: 1.0, temperature: 298.0 };
        let start = SlideState { area: 4e-4, load: 2.0, stick_fraction: 1.0, ..SlideState::default() };
        assert_eq!(in_words(&units, &[start]), "");
        let radius = (4e-4 / std::f64::consts::PI).sqrt();
        let now = SlideState {
            slip: 0.25 * radius,
            area: 9e-4,
            friction: 0.6,
            stick_fraction: 0.125,
            rise_max: 100.4,
            ..start
        };
        assert_eq!(
            in_words(&units, &[start, now]),
            "step 1, slip 0.250 a0, contact radius 1.500 a0, mu 0.300, 12 % sticks, up to 398 K"
        );
    }
}
