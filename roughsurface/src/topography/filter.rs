//! The short-wavelength cut-off: Gaussian filter of ISO 16610-21 and -61, as the S-filter of
//! ISO 25178 uses it.

use std::f64::consts::PI;

/// Amplitude that is left of a wave of wavenumber `q` (rad/m): 2^{−(λ_c/λ)²}, one half at the
/// `cutoff` λ_c (m), zero for much shorter waves.
pub fn transmission(q: f64, cutoff: f64) -> f64 {
    let ratio = cutoff * q / (2.0 * PI);
    (-std::f64::consts::LN_2 * ratio * ratio).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_half_at_the_cutoff() {
        let q = |wavelength: f64| 2.0 * PI / wavelength;
        assert!((transmission(q(3e-6), 3e-6) - 0.5).abs() < 1e-15);
        assert!((transmission(q(6e-6), 3e-6) - 0.5f64.powf(0.25)).abs() < 1e-15);
        assert!(transmission(q(1e-6), 3e-6) < 0.002);
    }
}
