//! The contacts at the end of the slide: temperatures, and shares of the load by regime.

use crate::friction::hottest::highest_temperature;
use crate::friction::regime::RegimeShares;
use crate::integral::asperity_at_slip::Additional;
use crate::integral::contact_state::ContactState;
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::surface::query::Surface;
use tables::closed_forms::kogut_etsion;
use tables::law::{Estimate, LookupError, OptionalEstimate};

/// Interferences, in ω_c, of first yield and of the start of full plasticity (Kogut & Etsion 2002, doi
/// 10.1115/1.1490373).
const REGIMES: [f64; 2] = [kogut_etsion::BREAKS[0], kogut_etsion::BREAKS[2]];

/// The contacts of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contacts {
    /// Share of the contacts in each regime.
    pub shares: RegimeShares,
    /// Share of the load on contacts below first yield, 1.
    pub elastic_load: f64,
    /// Share of the load on contacts between first yield and 110 ω_c, 1.
    pub elastic_plastic_load: f64,
    /// Share of the load on contacts above 110 ω_c, 1.
    pub fully_plastic_load: f64,
    /// Share of the load on contacts below the range of the law, 1.
    pub below_law_load: f64,
    /// Share of the load on contacts whose slides end before sliding begins, 1.
    pub stuck_load: f64,
    /// Relative error of the slip at which a contact begins to slide, mean over the load, 1.
    pub inception_error: f64,
    /// Temperature of the contacts, mean over the real contact area, K; none if the law has no temperature.
    pub temperature_mean: Option<Estimate>,
    /// Temperature that the hottest point of one contact in a thousand exceeds, K; of fewer contacts that of the
    /// largest. None if the law has no temperature.
    pub temperature_max: Option<Estimate>,
}

impl Contacts {
    /// Contacts of `asperities` under a flat at `separation` (m), by integrals to a relative `tolerance`; the law has results
    /// from the interference `law_start` (ω/ω_c) on.
    pub(crate) fn of<'a>(
        asperities: &Asperities<'a>,
        surface: &'a Surface,
        separation: Estimate,
        (tolerance, law_start): (f64, f64),
        melting_temperature: Option<f64>,
    ) -> Result<Self, LookupError> {
        let heights = surface.heights.as_ref();
        // Where the pressure hardly depends on the separation, its error may be infinite.
        let error = separation.error.min(heights.standard_deviation());
        let separation = Estimate { error, ..separation };
        let integral = |additional: Additional, counted_above: f64| {
            let asperities = asperities.map(|one| one.with(additional).counted_above(counted_above));
            SurfaceIntegral::new(&asperities, heights, surface.asperity_density, tolerance)
        };
        let mut of_yielded = integral(Additional::TemperatureRise, REGIMES[0]);
        let yielded = of_yielded.at(separation.value)?;
        let flowed = integral(Additional::StuckLoad, REGIMES[1]).at(separation.value)?;
        let beginning = integral(Additional::InceptionError, law_start).at(separation.value)?;
        let (plastic, flowing) = (yielded.outside, flowed.outside);
        let temperature_mean = temperature_mean(asperities, &mut of_yielded, separation, yielded)?;
        let temperature_max = match temperature_mean {
            Some(_) => highest_temperature(asperities, heights, separation)?,
            None => None,
        };
        Ok(Self {
            shares: RegimeShares::of(asperities, heights, separation.value, melting_temperature),
            elastic_load: 1.0 - plastic,
            // Each of the two is exact to the tolerance of the integrals.
            elastic_plastic_load: (plastic - flowing).max(0.0),
            fully_plastic_load: flowing,
            below_law_load: (1.0 - beginning.outside).max(0.0),
            stuck_load: flowed.additional_share(),
            inception_error: beginning.additional_share(),
            temperature_mean,
            temperature_max,
        })
    }
}

/// ∫T̄Aφ dz/∫Aφ dz by the `integral` of the temperature rise, which has the `state` at the separation (m). Errors of the
/// area, with one sign in all asperities, cancel.
fn temperature_mean(
    asperities: &Asperities,
    integral: &mut SurfaceIntegral,
    separation: Estimate,
    mut state: ContactState,
) -> OptionalEstimate {
    let mean = |state: &ContactState| Some(state.additional?.value / state.area_fraction.value);
    integral.complete_errors(separation.value, &mut state)?;
    let closer = integral.at(separation.value - separation.error)?;
    let (Some(rise), Some(value), Some(moved)) = (state.additional, mean(&state), mean(&closer)) else {
        return Ok(None);
    };
    let area = state.area_fraction;
    let of_area = value * area.quadrature_error;
    let errors = [rise.law_error, rise.quadrature_error, of_area].map(|error| error / area.value);
    let initial = asperities.classes[0].1.initial_temperature()?;
    Ok(Some(Estimate::with_errors(initial + value, errors.into_iter().chain([moved - value]))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{PowerLaw, surface};
    use crate::surface::heights::{Empirical, Exponential};

    /// ω/ω_c.
    const LAW_START: f64 = 0.3;

    /// T = 300 K + 100 K √(ω/ω_c), the mean rise 0.6 of that; ω_c = 1 µm.
    fn law(relative_error: f64) -> PowerLaw {
        let temperature = |interference: f64| 300.0 + 100.0 * interference.sqrt();
        PowerLaw { critical: 1e-6, temperature, mean_rise: Some(0.6), relative_error, ..PowerLaw::hertz() }
    }

    fn contacts(surface: &Surface, law: &PowerLaw, separation: Estimate) -> Contacts {
        let asperities = Asperities::new(law, surface, 1.0).unwrap().map(|asperity| asperity.after(1.0));
        Contacts::of(&asperities, surface, separation, (1e-10, LAW_START), None).unwrap()
    }

    #[test]
    fn temperatures_and_loads_of_exponential_heights_in_closed_form() {
        let std = 2e-6;
        let surface = surface(Exponential::new(std));
        let exact = Estimate::exact(3e-6);
        let found = contacts(&surface, &law(0.0), exact);
        // x = ω/ω_c with mean 2: ∫ √x x e^{−x/2} dx/∫ x e^{−x/2} dx = √2 Γ(5/2).
        let mean = 300.0 + 60.0 * 2f64.sqrt() * libm::tgamma(2.5);
        let temperature = found.temperature_mean.unwrap();
        assert!((temperature.value / mean - 1.0).abs() < 1e-9, "{temperature:?} {mean}");
        assert!(temperature.error < 1e-6, "{temperature:?}");
        // One contact in a thousand is pressed by more than σ ln 1000.
        let highest = 300.0 + 100.0 * (2.0 * 1000f64.ln()).sqrt();
        assert!((found.temperature_max.unwrap().value / highest - 1.0).abs() < 1e-8);
        // P ∝ x^{3/2}: shares of an incomplete gamma function of 5/2 at 1/2 and 55.
        let below = |x: f64| statrs::function::gamma::gamma_lr(2.5, x);
        assert!((found.elastic_load - below(0.5)).abs() < 1e-8, "{found:?}");
        assert!((found.below_law_load - below(0.5 * LAW_START)).abs() < 1e-8, "{found:?}");
        assert!((found.elastic_plastic_load - (below(55.0) - below(0.5))).abs() < 1e-8);
        assert!((found.fully_plastic_load - (1.0 - below(55.0))).abs() < 1e-12);
        // The mean does not depend on the separation, nor on errors of the area that are in proportion to it.
        let uncertain = contacts(&surface, &law(0.01), Estimate { error: 0.1e-6, ..exact });
        assert!((uncertain.temperature_mean.unwrap().error / (0.01 * (mean - 300.0)) - 1.0).abs() < 1e-6);
        let moved = 100.0 * ((2.0 * 1000f64.ln() + 0.1).sqrt() - (2.0 * 1000f64.ln()).sqrt());
        assert!((uncertain.temperature_max.unwrap().error / moved - 1.0).abs() < 1e-3);
    }

    #[test]
    fn temperatures_of_a_few_summits_are_those_of_their_sum() {
        let heights: Vec<f64> = (0..40).map(|i| 0.17e-6 * f64::from(i * i % 41)).collect();
        let separation = 1.3e-6;
        let touching = heights.iter().filter(|height| **height > separation);
        let interference: Vec<f64> = touching.map(|height| (height - separation) / 1e-6).collect();
        let sum = |of: fn(f64) -> f64| interference.iter().copied().map(of).sum::<f64>();
        let mean = 300.0 + 60.0 * sum(|x| x * x.sqrt()) / sum(|x| x);
        let elastic = sum(|x| if x <= 1.0 { x.powf(1.5) } else { 0.0 }) / sum(|x| x.powf(1.5));
        let highest = interference.iter().copied().fold(0.0, f64::max);
        let surface = surface(Empirical::new(heights).unwrap());
        let found = contacts(&surface, &law(0.0), Estimate::exact(separation));
        assert!((found.temperature_mean.unwrap().value / mean - 1.0).abs() < 1e-12, "{found:?} {mean}");
        assert!((found.temperature_max.unwrap().value / (300.0 + 100.0 * highest.sqrt()) - 1.0).abs() < 1e-9);
        assert!((found.elastic_load - elastic).abs() < 1e-12, "{found:?} {elastic}");
    }

    #[test]
    fn a_law_without_temperature_has_none() {
        let surface = surface(Exponential::new(2e-6));
        let law = PowerLaw { mean_rise: None, ..law(0.0) };
        let found = contacts(&surface, &law, Estimate::exact(0.0));
        assert_eq!((found.temperature_mean, found.temperature_max), (None, None));
    }
}
