//! Integrals over heights and radii: the sum of those of single radii.

use crate::integral::asperity_at_slip::AsperityAtSlip;
use crate::integral::contact_state::{ContactState, Integral};
use crate::integral::height_integral::HeightIntegral;
use crate::surface::heights::Heights;
use crate::surface::query::Surface;
use crate::surface::radii::ByRadius;
use tables::law::{AsperityLaw, LookupError};

/// The asperities of each radius at one slip rate and slip.
pub type Asperities<'a> = ByRadius<AsperityAtSlip<'a>>;

impl<'a> Asperities<'a> {
    /// Asperities of `surface` that slide at `slip_rate` (m/s), before the slide.
    pub fn new(law: &'a dyn AsperityLaw, surface: &Surface, slip_rate: f64) -> Result<Self, LookupError> {
        surface.asperity_radius.try_map(|&radius| AsperityAtSlip::new(law, radius, slip_rate))
    }
}

/// A rough surface at one slip rate and slip, for any separation.
pub type SurfaceIntegral<'a> = ByRadius<HeightIntegral<'a>>;

impl<'a> SurfaceIntegral<'a> {
    /// `heights` of `asperity_density` (1/m²) summits; `tolerance` as in [`HeightIntegral::new`].
    pub fn new(
        asperities: &Asperities<'a>,
        heights: &'a dyn Heights,
        asperity_density: f64,
        tolerance: f64,
    ) -> Self {
        asperities.map(|asperity| HeightIntegral::new(asperity.clone(), heights, asperity_density, tolerance))
    }

    /// Relative error to which it is computed.
    pub fn tolerance(&self) -> f64 {
        self.classes[0].1.tolerance
    }

    /// Standard deviation of the heights, m, which is that of every radius.
    pub fn standard_deviation(&self) -> f64 {
        self.classes[0].1.heights.standard_deviation()
    }

    /// The state at `separation` (m).
    pub fn at(&mut self, separation: f64) -> Result<ContactState, LookupError> {
        sum(&mut self.classes, separation)
    }

    /// Adds to a state at `separation` (m) the errors that a search for the separation does not need.
    pub fn complete_errors(&mut self, separation: f64, state: &mut ContactState) -> Result<(), LookupError> {
        if let Some(coarse) = &mut self.coarse {
            let other = sum(coarse, separation)?;
            let widen = |integral: &mut Integral, other: Integral| {
                integral.quadrature_error += (integral.value - other.value).abs();
            };
            widen(&mut state.pressure, other.pressure);
            widen(&mut state.shear, other.shear);
            widen(&mut state.area_fraction, other.area_fraction);
            if let (Some(additional), Some(other)) = (&mut state.additional, other.additional) {
                widen(additional, other);
            }
        }
        Ok(())
    }
}

/// States of single radii in proportion to their share of the summits.
fn sum(classes: &mut [(f64, HeightIntegral)], separation: f64) -> Result<ContactState, LookupError> {
    if let [(_, only)] = classes {
        return only.at(separation);
    }
    let mut total = ContactState::default();
    for (share, integral) in classes {
        total.add(*share, &integral.at(separation)?);
    }
    Ok(total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::STEEL;
    use crate::surface::heights::Exponential;
    use crate::surface::radii::Radii;
    use tables::closed_forms::closed_form;

    /// State and its errors at `separation` (m) after a slip of 1 mm, for exponential heights of mean `std` (m).
    fn state(model: &str, asperity_radius: Radii, std: f64, separation: f64) -> ContactState {
        let law = closed_form(model, &STEEL).unwrap();
        let heights = Box::new(Exponential::new(std));
        let surface = Surface { asperity_density: 1e10, asperity_radius, heights };
        let asperities =
            Asperities::new(law.as_ref(), &surface, 1.0).unwrap().map(|asperity| asperity.after(1e-3));
        let mut integral = SurfaceIntegral::new(&asperities, surface.heights.as_ref(), 1e10, 1e-12);
        let mut state = integral.at(separation).unwrap();
        integral.complete_errors(separation, &mut state).unwrap();
        state
    }

    #[test]
    fn elastic_greenwood_williamson_with_distributed_radii() {
        // P = √π η E* σ^{3/2} E[√R] e^{−h} and A = π η σ E[R] e^{−h} for exponential heights.
        let radii = Radii::counted(&[20e-6, 100e-6, 300e-6], &[2.0, 5.0, 1.0]).unwrap();
        let mean = |power: f64| {
            (2.0 * 20e-6f64.powf(power) + 5.0 * 100e-6f64.powf(power) + 300e-6f64.powf(power)) / 8.0
        };
        let pi = std::f64::consts::PI;
        for h in [0.0, 2.0f64] {
            // Contacts far below 0.4 R.
            let state = state("hertz", radii.clone(), 1e-8, h * 1e-8);
            let area = pi * 1e10 * 1e-8 * mean(1.0) * (-h).exp();
            for (value, exact) in [
                (
                    state.pressure.value,
                    pi.sqrt() * 1e10 * STEEL.contact_modulus() * 1e-12 * mean(0.5) * (-h).exp(),
                ),
                (state.area_fraction.value, area),
                (state.shear.value, STEEL.shear_strength() * area),
                (state.contact_density, 1e10 * (-h).exp()),
            ] {
                assert!((value / exact - 1.0).abs() < 1e-11, "{h}: {value:e} {exact:e}");
            }
        }
    }

    #[test]
    fn the_error_of_the_radius_classes_covers_their_deviation() {
        let at = |radii: Radii| state("kogut-etsion", radii, 1e-6, 1e-6).pressure;
        let classes = at(Radii::log_normal(1e-4, 4e-5));
        // A thousand classes by the midpoint rule in ln R, cut alike: the distribution itself.
        let spread = (1.0f64 + 0.16).ln().sqrt();
        let t: Vec<f64> = (0..1000).map(|i| 3.0 * (2.0 * (f64::from(i) + 0.5) / 1000.0 - 1.0)).collect();
        let share: Vec<f64> = t.iter().map(|t| (-0.5 * t * t).exp()).collect();
        let radius: Vec<f64> = t.iter().map(|t| (spread * t).exp()).collect();
        let many = Radii::counted(&radius, &share).unwrap();
        let exact = at(many.map(|radius| radius * (1e-4 / many.mean()))).value;
        let off = (classes.value - exact).abs();
        assert!(off < 1e-5 * exact && off <= classes.quadrature_error + 1e-6 * exact, "{:e}", off / exact);
    }
}
