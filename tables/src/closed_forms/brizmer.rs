//! Elastic–plastic sphere in full stick: first yield, load, area and static friction.
//!
//! V. Brizmer, Y. Kligerman & I. Etsion, Int. J. Solids Struct. 43, 5736 (2006),
//! doi 10.1016/j.ijsolstr.2005.07.034 (first yield); V. Brizmer, Y. Zait, Y. Kligerman &
//! I. Etsion, J. Mech. Mater. Struct. 1, 865 (2006), doi 10.2140/jomms.2006.1.865 (load, area);
//! V. Brizmer, Y. Kligerman & I. Etsion, Tribol. Lett. 25, 61 (2007) (static friction);
//! D. Cohen, Y. Kligerman & I. Etsion, J. Tribol. 130, 031401 (2008) (the same against ω).
//! Recalled from the literature; the yield fits agree with an independent computation to 8 %
//! at ν = 0.3 and better elsewhere.
//!
//! Symbols: δ* = ω/δ_c and P* = P/L_c with δ_c, L_c interference and load of first yield in
//! full stick.

/// δ* up to which the fits were made.
pub const LARGEST_INTERFERENCE: f64 = 150.0;

/// p₀/σ_Y of first yield without friction, the authors' fit: 1.234 + 1.256ν.
pub fn slip_yield_coefficient(poisson_ratio: f64) -> f64 {
    1.234 + 1.256 * poisson_ratio
}

/// δ_c(stick)/δ_c(slip) = 6.82ν − 7.83(ν² + 0.0586); both with the authors' slip values.
pub fn critical_interference_ratio(poisson_ratio: f64) -> f64 {
    6.82 * poisson_ratio - 7.83 * (poisson_ratio * poisson_ratio + 0.0586)
}

/// L_c(stick)/L_c(slip) = 8.88ν − 10.13(ν² + 0.089); both with the authors' slip values.
pub fn critical_load_ratio(poisson_ratio: f64) -> f64 {
    8.88 * poisson_ratio - 10.13 * (poisson_ratio * poisson_ratio + 0.089)
}

/// P/L_c = δ*^{3/2} {1 − exp[1/(1 − δ*^β)]}, β = 0.174 + 0.08ν; δ*^{3/2} below first yield.
pub fn load(interference: f64, poisson_ratio: f64) -> f64 {
    let elastic = interference.powf(1.5);
    let exponent = 0.174 + 0.08 * poisson_ratio;
    elastic * (1.0 - softening(interference, exponent))
}

/// A/(πRδ_c) = δ* {1 + exp[1/(1 − δ*^α)]}, α = 0.25 + 0.125ν; δ* below first yield.
pub fn area(interference: f64, poisson_ratio: f64) -> f64 {
    let exponent = 0.25 + 0.125 * poisson_ratio;
    interference * (1.0 + softening(interference, exponent))
}

/// exp[1/(1 − δ*^n)], which vanishes with all its derivatives at δ* = 1.
fn softening(interference: f64, exponent: f64) -> f64 {
    if interference <= 1.0 {
        return 0.0;
    }
    (1.0 / (1.0 - interference.powf(exponent))).exp()
}

/// μ_s = 0.27 coth(0.27 P*^0.35): the asperity slips when its tangential stiffness vanishes.
pub fn static_friction(load: f64) -> f64 {
    0.27 / (0.27 * load.powf(0.35)).tanh()
}

/// μ_s = 0.26 coth(0.27 δ*^0.46): the form of Cohen et al. (2008), within 4 % for 1 ≤ δ* ≤ 150.
pub fn static_friction_of_interference(interference: f64) -> f64 {
    0.26 / (0.27 * interference.powf(0.46)).tanh()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn load_and_area_for_nu_0_3() {
        for (omega, p, a) in [(1.0, 1.0, 1.0), (10.0, 26.02, 13.45), (100.0, 489.1, 169.6)] {
            assert!((load(omega, 0.3) / p - 1.0).abs() < 5e-4, "{omega}");
            assert!((area(omega, 0.3) / a - 1.0).abs() < 5e-4, "{omega}");
        }
    }

    #[test]
    fn yield_ratios_of_the_fit() {
        for (nu, load, interference) in
            [(0.20, 0.4692, 0.5920), (0.30, 0.8507, 0.8825), (0.40, 1.0296, 1.0164), (0.50, 1.006, 0.994)]
        {
            assert!((critical_load_ratio(nu) - load).abs() < 5e-4, "{nu}");
            let ratio = critical_interference_ratio(nu);
            assert!((ratio - interference).abs() < 5e-4, "{nu}: {ratio}");
        }
    }

    #[test]
    fn static_friction_in_both_forms() {
        for (p, mu) in [(1.0, 1.02), (2.83, 0.730), (10.4, 0.494), (63.0, 0.330), (489.0, 0.275)] {
            assert!((static_friction(p) - mu).abs() < 0.006, "{p}");
        }
        for step in 0..=20 {
            let omega = 150f64.powf(step as f64 / 20.0);
            let ratio = static_friction(load(omega, 0.3)) / static_friction_of_interference(omega);
            assert!((ratio - 1.0).abs() < 0.045, "{omega}: {ratio}");
        }
    }
}
