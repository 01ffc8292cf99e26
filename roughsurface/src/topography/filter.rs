//! The short-wavelength cut-off: Gaussian filter of ISO 16610-21 and -61, as the S-filter of
//! ISO 25178 uses it.

use std::f64::consts::PI;

/// Amplitude that is left of a wave of wavenumber `q` (rad/m): 2^{−(λ_c/λ)²}, one half at the
/// `cutoff` λ_c (m), zero for much shorter waves.
pub fn transmission(q: f64, cutoff: f64) -> f64 {
    let ratio = cutoff * q / (2.0 * PI);
    (-std::f64::consts::LN_2 * ratio * ratio).exp()
}

/// What a wave of wavenumber `q` (rad/m) of a profile contributes to m0, m2 and m4 of the isotropic surface that has
/// the profile, after the filter T over the area, per power of the wave.
///
/// The profile sees waves at an angle to it as long ones. The spectrum of the surface is the inverse Abel transform
/// of that of the profile; integrated by parts, its moments are those of the profile with the weights
/// c d/dq ∫₀^q k^{n+1} T²(k) (q² − k²)^{−1/2} dk, c = 1, 1/2, 3/8, which are qⁿ without filter. With T² = e^{−bk²},
/// u = b q² and Dawson's integral D they follow from w0 = 1 − 2√u D(√u) by derivatives with respect to b.
pub(super) fn of_surface(q: f64, cutoff: f64) -> [f64; 3] {
    let u = 2.0 * std::f64::consts::LN_2 * (cutoff * q / (2.0 * PI)).powi(2);
    let ratio = dawson(u.sqrt()) / u.sqrt();
    let w0 = 1.0 - 2.0 * u * ratio;
    let first = w0 + ratio;
    [w0, 0.5 * q.powi(2) * first, 0.375 * q.powi(4) * (first - (w0 - ratio) / (2.0 * u))]
}

/// Dawson's integral e^{−x²} ∫₀ˣ e^{t²} dt as the sum of e^{−(x−nh)²}/(n√π) over odd n (Rybicki 1989,
/// doi 10.1063/1.4822832), with h = 1/5 to the precision of the numbers.
fn dawson(x: f64) -> f64 {
    let nearest = 2.0 * (2.5 * x).round() + 1.0;
    let terms = (-17..=17).map(|k| nearest + 2.0 * f64::from(k)).map(|n| (-(x - 0.2 * n).powi(2)).exp() / n);
    terms.sum::<f64>() / PI.sqrt()
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

    #[test]
    fn weights_of_a_profile_are_those_of_the_integral() {
        // With k = q sin θ, by the midpoint rule and a central difference.
        let cutoff = 2.0 * PI;
        let integral = |q: f64, n: i32| {
            let panels = 2000;
            let angle = |panel: i32| 0.5 * PI * (f64::from(panel) + 0.5) / f64::from(panels);
            let wave = |k: f64| k.powi(n + 1) * transmission(k, cutoff).powi(2);
            (0..panels).map(|panel| wave(q * angle(panel).sin())).sum::<f64>() * 0.5 * PI / f64::from(panels)
        };
        for q in [0.05, 0.3, 0.8, 1.5, 3.0, 10.0] {
            let step = 1e-4 * q;
            for (weight, (n, factor)) in
                of_surface(q, cutoff).into_iter().zip([(0, 1.0), (2, 0.5), (4, 0.375)])
            {
                let exact = factor * (integral(q + step, n) - integral(q - step, n)) / (2.0 * step);
                let scale = exact.abs().max(1e-3 * q.min(1.0).powi(n));
                assert!((weight - exact).abs() < 1e-4 * scale, "{q} {n}: {weight:e} {exact:e}");
            }
        }
    }
}
