//! Elastic–plastic sphere, frictionless press and static friction.
//!
//! L. Kogut & I. Etsion, *Elastic-plastic contact analysis of a sphere and a rigid flat*,
//! J. Appl. Mech. 69, 657 (2002), doi 10.1115/1.1490373 (load, area); *A semi-analytical
//! solution for the sliding inception of a spherical contact*, J. Tribol. 125, 499 (2003),
//! doi 10.1115/1.1538190 (static friction).
//!
//! Symbols: ω* = ω/ω_c; P_c, A_c load and area of first yield, all three with a peak pressure of KH at first yield, as
//! Chang, Etsion & Bogy 1987: H = 2.8 σ_Y, K = 0.454 + 0.41ν.
//! The published pieces do not join: at ω* = 6 the load jumps by 1.7 % and the area by 2.9 %,
//! at ω* = 110 the load by 8 %.

pub use super::chang_etsion_bogy::HARDNESS;
use super::chang_etsion_bogy::hardness_coefficient;

/// ω* at which the pieces of the fits meet.
pub const BREAKS: [f64; 3] = [1.0, 6.0, 110.0];

/// ω* above which there is no formula of friction.
pub const FRICTION_LIMIT: f64 = BREAKS[1];

/// P/P_c = ω*^{3/2}, 1.03 ω*^1.425, 1.40 ω*^1.263, and 2πRωH/P_c = (3/K) ω* above 110.
pub fn load(interference: f64, poisson_ratio: f64) -> f64 {
    match interference {
        w if w <= BREAKS[0] => w.powf(1.5),
        w if w <= BREAKS[1] => 1.03 * w.powf(1.425),
        w if w <= BREAKS[2] => 1.40 * w.powf(1.263),
        w => 3.0 / hardness_coefficient(poisson_ratio) * w,
    }
}

/// A/A_c = ω*, 0.93 ω*^1.136, 0.94 ω*^1.146, and 2ω* above 110.
pub fn area(interference: f64) -> f64 {
    match interference {
        w if w <= BREAKS[0] => w,
        w if w <= BREAKS[1] => 0.93 * w.powf(1.136),
        w if w <= BREAKS[2] => 0.94 * w.powf(1.146),
        w => 2.0 * w,
    }
}

/// Q_max/P of 2003: 0.52 ω*^0.982 P_c/P up to first yield, then
/// −0.007ω*³ + 0.085ω*² − 0.389ω* + 0.822 up to ω* = 6, and none above.
///
/// Recalled from the literature; the pieces differ by 2 % at ω* = 1.
pub fn static_friction(interference: f64) -> f64 {
    match interference {
        w if w <= BREAKS[0] => 0.52 * w.powf(0.982 - 1.5),
        w if w <= BREAKS[1] => ((-0.007 * w + 0.085) * w - 0.389) * w + 0.822,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_meet_as_badly_as_published() {
        let jump = |f: &dyn Fn(f64) -> f64, at: f64| (f(at), f(at * (1.0 + 1e-12)));
        let (below, above) = jump(&|w| load(w, 0.3), 6.0);
        assert!((below - 13.23).abs() < 0.01 && (above - 13.46).abs() < 0.01);
        let (below, above) = jump(&area, 6.0);
        assert!((below - 7.12).abs() < 0.01 && (above - 7.33).abs() < 0.01);
        let (below, above) = jump(&|w| load(w, 0.3), 110.0);
        assert!((below - 530.2).abs() < 0.1 && (above - 571.9).abs() < 0.1);
    }

    #[test]
    fn static_friction_falls_to_nothing_at_six() {
        assert!((static_friction(1.0) - 0.52).abs() < 1e-12);
        assert!((static_friction(6.0) - 0.036).abs() < 1e-12);
        assert_eq!(static_friction(6.1), 0.0);
    }
}
