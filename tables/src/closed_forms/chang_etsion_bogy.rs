//! Elastic–plastic sphere of constant volume, and static friction without plastic strength.
//!
//! W. R. Chang, I. Etsion & D. B. Bogy, *An elastic-plastic model for the contact of rough
//! surfaces*, J. Tribol. 109, 257 (1987), doi 10.1115/1.3261348 (load, area); *Static friction
//! coefficient model for metallic rough surfaces*, J. Tribol. 110, 57 (1988),
//! doi 10.1115/1.3261575 (static friction), the latter in the form that M. Eriten et al. gave it,
//! for ν = 0.3.
//!
//! Symbols: ω* = ω/ω_c with the authors' first yield at a peak pressure of KH, H = 2.8 σ_Y.
//! Volume conservation makes the load jump by a half at ω* = 1, as published.

use std::f64::consts::PI;

/// H/σ_Y.
pub const HARDNESS: f64 = 2.8;

/// ω* at which the pieces of load, area and static friction meet.
pub const BREAKS: [f64; 2] = [0.951169009951161, 1.0];

/// K, peak pressure of first yield over hardness: 0.454 + 0.41ν.
pub fn hardness_coefficient(poisson_ratio: f64) -> f64 {
    0.454 + 0.41 * poisson_ratio
}

/// p₀/σ_Y of first yield, 2.8 K.
pub fn yield_coefficient(poisson_ratio: f64) -> f64 {
    HARDNESS * hardness_coefficient(poisson_ratio)
}

/// P/P_c = ω*^{3/2}, and 3(2ω* − 1)/2 above first yield: πRω(2 − 1/ω*)KH.
pub fn load(interference: f64) -> f64 {
    if interference <= 1.0 { interference.powf(1.5) } else { 1.5 * area(interference) }
}

/// A/A_c = ω*, and 2ω* − 1 above first yield.
pub fn area(interference: f64) -> f64 {
    if interference <= 1.0 { interference } else { 2.0 * interference - 1.0 }
}

/// Q_max/P at ν = 0.3: the tangential load that makes the sphere yield below its surface or at
/// the edge of the contact, whichever is less, and 0 once it has yielded.
pub fn static_friction(interference: f64) -> f64 {
    if interference >= 1.0 {
        return 0.0;
    }
    const NU: f64 = 0.3;
    /// Depth of first yield over contact radius.
    const DEPTH: f64 = 0.48;
    let k = hardness_coefficient(NU);
    let c1 = -1.0 + 1.5 * DEPTH * (1.0 / DEPTH).atan() - DEPTH * DEPTH / (2.0 * (1.0 + DEPTH * DEPTH));
    let below = 0.2045 / (k * c1.abs()) * (1.0 / interference - 1.0).sqrt();
    let c3 = 9.0 * PI * PI / 16.0 * (2.0 - NU / 2.0 + 7.0 * NU * NU / 8.0);
    let c4 = 9.0 * PI / 4.0 * (1.0 - 2.0 * NU) * (1.0 - NU / 2.0);
    let c5 = 1.5 * (1.0 - 2.0 * NU).powi(2) - 0.56 / (k * k * interference);
    let edge = (-c4 + (c4 * c4 - 4.0 * c3 * c5).sqrt()) / (2.0 * c3);
    below.min(edge)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn static_friction_as_tabulated_from_the_published_form() {
        for (omega, mu) in [(0.1, 1.137), (0.3, 0.605), (0.5, 0.439), (0.8, 0.320)] {
            assert!((static_friction(omega) - mu).abs() < 6e-4, "{omega}: {}", static_friction(omega));
        }
        assert_eq!((static_friction(1.0), static_friction(3.0)), (0.0, 0.0));
    }

    #[test]
    fn the_two_places_of_yield_trade_at_the_break() {
        let slope = |omega: f64| (static_friction(omega + 1e-6) - static_friction(omega - 1e-6)) / 2e-6;
        let kink = BREAKS[0];
        assert!((static_friction(kink * (1.0 + 1e-12)) - static_friction(kink)).abs() < 1e-10);
        assert!(slope(kink + 1e-4) < 3.0 * slope(kink - 1e-4));
    }

    #[test]
    fn volume_is_conserved() {
        // The flat takes ω − ω_c more from twice the area: A = πR(2ω − ω_c).
        assert_eq!((area(1.0), area(10.0)), (1.0, 19.0));
        assert_eq!((load(1.0), load(10.0)), (1.0, 28.5));
    }
}
