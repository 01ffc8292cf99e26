//! Regimes of the contacts: elastic, plastic or melting.

use crate::integral::asperity_at_slip::AsperityAtSlip;
use crate::integral::surface_integral::Asperities;
use crate::surface::heights::Heights;
use crate::surface::query::Surface;
use tables::functions::{Accuracy, root_of};
use tables::law::AsperityLaw;

/// ψ = √(σ_s/ω_c), σ_s the standard deviation of the summit heights and ω_c the interference of
/// first yield at the mean summit radius (Kogut & Etsion 2003, Tribol. Trans. 46, 383;
/// Greenwood & Williamson's index of 1966 with first yield in place of hardness).
pub fn plasticity_index(law: &dyn AsperityLaw, surface: &Surface) -> f64 {
    let critical = law.critical_interference(surface.asperity_radius.mean());
    (surface.heights.standard_deviation() / critical).sqrt()
}

/// The regime of a plasticity index, after Greenwood & Williamson (1966), fully plastic after Kogut & Etsion (2003).
pub fn regime(plasticity_index: f64) -> &'static str {
    match plasticity_index {
        ..0.6 => "elastic contact at any ordinary load",
        0.6..=1.0 => "elastic at light loads, plastic at heavy ones",
        1.0..8.0 => "elastic-plastic contact at any ordinary load",
        _ => "fully plastic contact at any ordinary load",
    }
}

/// Shares of the asperities in contact; those that are known are together 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegimeShares {
    /// Interference below first yield.
    pub elastic: f64,
    /// Interference of at least first yield, not known to melt.
    pub plastic: f64,
    /// Hottest point at the melting temperature; NaN where that is unknown.
    pub melting: f64,
}

impl RegimeShares {
    /// Shares of the `asperities` under a flat at `separation` (m); `melting` is a temperature in kelvin.
    pub fn of(asperities: &Asperities, heights: &dyn Heights, separation: f64, melting: Option<f64>) -> Self {
        let (mut touching, mut yielded, mut molten) = (0.0, 0.0, 0.0);
        for (share, asperity) in &asperities.classes {
            let above = |interference: f64| {
                share * heights.tail(separation + interference * asperity.critical_interference())
            };
            touching += above(0.0);
            yielded += above(1.0);
            if let Some(onset) = melting.and_then(|melting| melting_interference(asperity, melting)) {
                molten += above(onset);
            }
        }
        if touching <= 0.0 {
            return Self::default();
        }
        // A contact that melts before it yields counts as melting.
        let plastic = (yielded - molten).max(0.0);
        let elastic = (touching - yielded.max(molten)).max(0.0);
        let molten = if melting.is_some() { molten } else { f64::NAN };
        Self { elastic: elastic / touching, plastic: plastic / touching, melting: molten / touching }
    }
}

/// Interference, ω/ω_c, below which a contact that melts counts as melting from the start.
const SMALLEST: f64 = 1e-6;

/// ω/ω_c at which the hottest point of the contact reaches the `melting` temperature (K); larger
/// contacts are hotter. None if the range of the law ends below it.
fn melting_interference(asperity: &AsperityAtSlip, melting: f64) -> Option<f64> {
    let excess = |interference: f64| match asperity.response(interference) {
        Ok(state) => state.temperature_max.value - melting,
        // A contact without a response does not count as melting.
        Err(_) => -melting,
    };
    let limit = asperity.limit();
    if !limit.is_finite() || excess(limit) < 0.0 {
        return None;
    }
    if excess(SMALLEST) >= 0.0 {
        return Some(SMALLEST);
    }
    let accuracy = Accuracy { value: 0.0, width: 1e-12 };
    root_of(SMALLEST.ln(), limit.ln(), accuracy, |ln_omega| excess(ln_omega.exp())).map(f64::exp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::{PowerLaw, surface};
    use crate::surface::heights::Exponential;

    #[test]
    fn shares_of_exponential_heights() {
        // Of those that touch, e^{−ω/σ} are pressed beyond ω.
        let surface = surface(Exponential::new(2e-6));
        // T = 300 K + 100 K ω/ω_c with ω_c = 1 µm, up to 50 ω_c.
        let temperature = |interference: f64| 300.0 + 100.0 * interference;
        let law = PowerLaw { critical: 1e-6, limit: 50.0, temperature, ..PowerLaw::hertz() };
        let asperities = Asperities::new(&law, &surface, 1.0).unwrap();
        let shares = |melting| RegimeShares::of(&asperities, surface.heights.as_ref(), 3e-6, melting);
        let beyond = |interference: f64| (-interference / 2.0f64).exp();
        let cold = shares(None);
        assert!((cold.elastic - (1.0 - beyond(1.0))).abs() < 1e-12);
        assert!((cold.plastic - beyond(1.0)).abs() < 1e-12 && cold.melting.is_nan());
        let hot = shares(Some(700.0));
        assert!((hot.melting - beyond(4.0)).abs() < 1e-9, "{hot:?}");
        assert!((hot.plastic - (beyond(1.0) - beyond(4.0))).abs() < 1e-9);
        // Out of reach of the table.
        assert_eq!(shares(Some(6000.0)).melting, 0.0);
        // Molten before they yield.
        let soft = shares(Some(350.0));
        assert!((soft.melting - beyond(0.5)).abs() < 1e-9 && soft.plastic == 0.0);
        assert!((soft.elastic + soft.melting - 1.0).abs() < 1e-12);
    }

    #[test]
    fn every_index_has_a_regime() {
        assert!(regime(0.5).starts_with("elastic contact"));
        assert!(regime(0.6).starts_with("elastic at light"));
        assert!(regime(2.0).starts_with("elastic-plastic"));
        assert!(regime(10.0).starts_with("fully plastic"));
    }
}
