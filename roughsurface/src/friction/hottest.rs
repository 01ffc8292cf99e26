//! The highest temperature of the contacts: that which one in a thousand exceeds.

use crate::integral::asperity_at_slip::AsperityAtSlip;
use crate::integral::surface_integral::Asperities;
use crate::surface::heights::Heights;
use tables::functions::{Accuracy, root_between, root_of};
use tables::law::{Estimate, LookupError, OptionalEstimate};

/// Share of the contacts that may be hotter than the highest temperature: heights without an upper end have no hottest
/// contact.
const HOTTER: f64 = 1e-3;

/// Relative number of contacts below which a radius has none hotter than a temperature.
const NONE: f64 = 1e-9;

/// Temperature (K) that the hottest point of one contact in a thousand exceeds, over all radii together, under a flat at
/// `separation` (m). None without contacts.
///
/// Errors of the law are taken to have the same sign in all asperities.
pub(crate) fn highest_temperature(
    asperities: &Asperities,
    heights: &dyn Heights,
    separation: Estimate,
) -> OptionalEstimate {
    let of = |classes, with_law_error: bool, closer: f64| {
        Contacts { classes, heights, separation: separation.value, with_law_error, closer }.temperature()
    };
    let classes = &asperities.classes[..];
    let Some(value) = of(classes, false, 0.0)? else { return Ok(None) };
    let changed = [(classes, true, 0.0), (classes, false, separation.error)];
    let coarse = asperities.coarse.iter().map(|coarse| (&coarse[..], false, 0.0));
    let mut errors = Vec::new();
    for (classes, with_law_error, closer) in changed.into_iter().chain(coarse) {
        errors.extend(of(classes, with_law_error, closer)?.map(|other| other - value));
    }
    Ok(Some(Estimate::with_errors(value, errors)))
}

struct Contacts<'s, 'a> {
    /// Share of the summits and asperity of each radius.
    classes: &'s [(f64, AsperityAtSlip<'a>)],
    heights: &'s dyn Heights,
    separation: f64,
    /// Whether temperatures are higher by their error, and by how much (m) summits are pressed more, to see what an error
    /// amounts to.
    with_law_error: bool,
    closer: f64,
}

impl Contacts<'_, '_> {
    fn temperature(&self) -> Result<Option<f64>, LookupError> {
        let hotter = HOTTER * self.heights.tail(self.separation);
        let excess = |height: f64| (self.heights.tail(height) / hotter).ln().max(-1e3);
        let from = self.separation;
        let Some(height) = height_of(excess, from, self.heights.standard_deviation()) else {
            return Ok(None);
        };
        // Radii and heights are independent: above this height is the same share of the contacts of every radius, and
        // what is sought lies between the temperatures there.
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (_, asperity) in self.classes {
            let temperature = self.at(asperity, height)?;
            (lowest, highest) = (lowest.min(temperature), highest.max(temperature));
        }
        let excess = |temperature: f64| -> Result<f64, LookupError> {
            Ok((self.hotter_than(temperature, height)? / hotter).ln().max(-1e3))
        };
        let accuracy = Accuracy { value: 1e-9, width: 1e-9 * (highest - lowest) };
        if lowest == highest || excess(lowest)? <= 0.0 {
            return Ok(Some(lowest));
        }
        Ok(Some(root_between(lowest, highest, accuracy, excess)?.unwrap_or(highest)))
    }

    /// Highest temperature of the contact of a summit at `height` (m).
    fn at(&self, asperity: &AsperityAtSlip, height: f64) -> Result<f64, LookupError> {
        let pressed = (height - self.separation + self.closer) / asperity.critical_interference();
        let Estimate { value, error } = asperity.response(pressed)?.temperature_max;
        Ok(if self.with_law_error { value + error } else { value })
    }

    /// Share of the summits hotter than `temperature` (K), which the one at `start` (m) or others around it have.
    fn hotter_than(&self, temperature: f64, start: f64) -> Result<f64, LookupError> {
        let touching = self.heights.tail(self.separation);
        let mut hotter = 0.0;
        for (share, asperity) in self.classes {
            let excess =
                |height: f64| -> Result<f64, LookupError> { Ok(self.at(asperity, height)? - temperature) };
            let (mut low, mut high) = (self.separation, start);
            while excess(high)? < 0.0 && self.heights.tail(high) > NONE * touching {
                (low, high) = (high, high + (high - self.separation));
            }
            let accuracy = Accuracy { value: 0.0, width: 1e-9 * (high - self.separation) };
            // A radius that does not get as hot has no such height, nor one that is hotter from the start.
            let height = match excess(high)? < 0.0 {
                true => f64::INFINITY,
                false => root_between(low, high, accuracy, excess)?.unwrap_or(low),
            };
            hotter += if height.is_finite() { share * self.heights.tail(height) } else { 0.0 };
        }
        Ok(hotter)
    }
}

/// Height (m) above `from` at which `excess`, which falls, is zero; none if it is negative from the start.
fn height_of(excess: impl Fn(f64) -> f64, from: f64, standard_deviation: f64) -> Option<f64> {
    let mut stride = standard_deviation;
    while excess(from + stride) > 0.0 {
        stride *= 2.0;
    }
    // Measured heights have steps in place of a zero.
    let accuracy = Accuracy { value: 1e-9, width: 1e-12 * stride };
    root_of(from, from + stride, accuracy, excess)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{PowerLaw, surface};
    use crate::surface::heights::Exponential;
    use crate::surface::query::Surface;
    use crate::surface::radii::Radii;

    const STD: f64 = 2e-6;

    /// T = 300 K + 100 K √(ω/ω_c), ω_c = 1 µm at a radius of 0.1 mm and in proportion to it.
    fn highest(radii: Radii, relative_error: f64, separation: Estimate) -> Estimate {
        let temperature = |interference: f64| 300.0 + 100.0 * interference.sqrt();
        let law = PowerLaw { critical: 1e-6, reference: Some(1e-4), temperature, ..PowerLaw::hertz() };
        let law = PowerLaw { relative_error, ..law };
        let surface = Surface { asperity_radius: radii, ..surface(Exponential::new(STD)) };
        let asperities = Asperities::new(&law, &surface, 1.0).unwrap().map(|asperity| asperity.after(1.0));
        highest_temperature(&asperities, surface.heights.as_ref(), separation).unwrap().unwrap()
    }

    #[test]
    fn two_radii_together_have_one_contact_in_a_thousand_above_it() {
        // At x = ω/ω_c the share y = exp(−x/2) of the small ones and y² of the large ones is hotter: (y + y²)/2 = 1/1000.
        let radii = Radii::counted(&[1e-4, 2e-4], &[1.0, 1.0]).unwrap();
        let share: f64 = 0.5 * (1.008f64.sqrt() - 1.0);
        let exact = 300.0 + 100.0 * (-2.0 * share.ln()).sqrt();
        let found = highest(radii, 0.0, Estimate::exact(3e-6));
        assert!((found.value / exact - 1.0).abs() < 1e-8 && found.error < 1e-6, "{found:?} {exact}");
    }

    #[test]
    fn radii_without_spread_are_one_radius() {
        let separation = Estimate { value: 3e-6, error: 1e-7 };
        let one = highest(Radii::from(1e-4), 0.0, separation);
        let narrow = highest(Radii::log_normal(1e-4, 1e-12), 0.0, separation);
        assert!(
            (narrow.value - one.value).abs() < 1e-5 && (narrow.error - one.error).abs() < 1e-4,
            "{narrow:?}"
        );
        // 16 classes and 10 of a wide distribution.
        let wide = highest(Radii::log_normal(1e-4, 5e-5), 0.0, separation);
        assert!(wide.value > one.value && wide.error < 0.1 * (wide.value - 300.0), "{wide:?} {one:?}");
    }
}
