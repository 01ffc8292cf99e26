//! Frictionless elastic–plastic sphere with size-dependent hardness.
//!
//! R. L. Jackson & I. Green, *A finite element study of elasto-plastic hemispherical contact
//! against a rigid flat*, J. Tribol. 127, 343 (2005), doi 10.1115/1.1866166.
//!
//! Symbols: ω* = ω/ω_c; P_c, A_c load and area of first yield, all three with the authors'
//! C(ν); e_y = σ_Y/E*; a contact radius; R sphere radius; H hardness, Pa.
//! The published pieces do not quite join: at ω* = 1.9 the load jumps by 0.5 %.

/// ω* up to which the contact is taken as Hertzian.
pub const ELASTIC_LIMIT: f64 = 1.9;

/// C = 1.295 exp(0.736ν), the authors' fit of p₀/σ_Y at first yield.
pub fn yield_coefficient(poisson_ratio: f64) -> f64 {
    1.295 * (0.736 * poisson_ratio).exp()
}

/// A/A_c = ω* (ω*/1.9)^B with B = 0.14 exp(23 e_y); ω* below 1.9.
pub fn area(interference: f64, yield_strain: f64) -> f64 {
    if interference <= ELASTIC_LIMIT {
        return interference;
    }
    let exponent = 0.14 * (23.0 * yield_strain).exp();
    interference * (interference / ELASTIC_LIMIT).powf(exponent)
}

/// H/σ_Y = 2.84 [1 − exp(−0.82 (a/R)^{−0.7})].
pub fn hardness(contact_radius_over_radius: f64) -> f64 {
    2.84 * (1.0 - (-0.82 * contact_radius_over_radius.powf(-0.7)).exp())
}

/// P/P_c = exp(−ω*^{5/12}/4) ω*^{3/2} + (4H/(Cσ_Y)) [1 − exp(−ω*^{5/9}/25)] ω*; ω*^{3/2} below 1.9.
pub fn load(interference: f64, yield_strain: f64, poisson_ratio: f64) -> f64 {
    if interference <= ELASTIC_LIMIT {
        return interference.powf(1.5);
    }
    let coefficient = yield_coefficient(poisson_ratio);
    // A_c/(πR²) = ω_c/R = (πC e_y/2)².
    let critical_radius = std::f64::consts::FRAC_PI_2 * coefficient * yield_strain;
    let contact_radius = critical_radius * area(interference, yield_strain).sqrt();
    let elastic = (-interference.powf(5.0 / 12.0) / 4.0).exp() * interference.powf(1.5);
    let plastic = 4.0 * hardness(contact_radius) / coefficient
        * (1.0 - (-interference.powf(5.0 / 9.0) / 25.0).exp())
        * interference;
    elastic + plastic
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_values_for_nu_0_3() {
        // e_y, ω*, P/P_c, A/A_c.
        let reference = [
            (0.001, 2.0, 2.8291, 2.0148),
            (0.001, 5.0, 10.1344, 5.7434),
            (0.001, 10.0, 25.8854, 12.6860),
            (0.001, 20.0, 64.2269, 28.0207),
            (0.001, 100.0, 465.859, 176.434),
            (0.002, 10.0, 25.8853, 12.7564),
            (0.002, 100.0, 464.610, 178.780),
            (0.005, 5.0, 10.1341, 5.8206),
            (0.005, 20.0, 64.1022, 28.9462),
            (0.005, 100.0, 448.617, 186.356),
        ];
        for (yield_strain, omega, p, a) in reference {
            let (p_here, a_here) = (load(omega, yield_strain, 0.3), area(omega, yield_strain));
            assert!((p_here / p - 1.0).abs() < 2e-5, "{omega}: {p_here} {p}");
            assert!((a_here / a - 1.0).abs() < 3e-5, "{omega}: {a_here} {a}");
        }
    }

    #[test]
    fn pieces_meet_as_badly_as_published() {
        let above = load(ELASTIC_LIMIT * (1.0 + 1e-12), 0.001, 0.3);
        let jump = above / ELASTIC_LIMIT.powf(1.5) - 1.0;
        assert!(0.004 < jump && jump < 0.006, "{jump}");
    }
}
