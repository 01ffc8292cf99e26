//! Summits of a random surface from its spectral moments m0, m2, m4.

use super::moments::Isotropic;
use std::f64::consts::PI;

/// Summits of an isotropic Gaussian surface (Nayak 1971, doi 10.1115/1.3451608; McCool 1987,
/// doi 10.1115/1.3261349).
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Nayak {
    /// Bandwidth α = m0 m4/m2², 1; 1.5 for a single wavelength, large for many.
    pub alpha: f64,
    /// Summits per area η = m4/(6π√3 m2), 1/m².
    pub density: f64,
    /// Radius of the mean summit curvature R = (3/8)√(π/m4), m.
    pub radius: f64,
    /// Standard deviation of the summit heights σ_s = √(m0 (1 − 0.8968/α)), m.
    pub std: f64,
    /// Mean summit plane above the mean plane of the surface, 4√(m0/(πα)), m.
    pub mean_summit: f64,
}

/// Smallest bandwidth of an isotropic surface.
pub const SMALLEST_ALPHA: f64 = 1.5;

impl Nayak {
    /// Summits of a surface with those moments; none where they are not positive, which estimates from a profile can be, or where α
    /// is too small for any distribution of summits.
    pub fn of(moments: &Isotropic) -> Option<Self> {
        let Isotropic { m0, m2, m4 } = *moments;
        let alpha = m0 * m4 / (m2 * m2);
        let is_positive = [m0, m2, m4].iter().all(|moment| *moment > 0.0);
        (is_positive && alpha > 0.8968 && alpha.is_finite()).then(|| Self {
            alpha,
            density: m4 / (6.0 * PI * 3f64.sqrt() * m2),
            radius: 0.375 * (PI / m4).sqrt(),
            std: (m0 * (1.0 - 0.8968 / alpha)).sqrt(),
            mean_summit: 4.0 * (m0 / (PI * alpha)).sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_constants_of_chang_etsion_and_bogy_are_the_same_statement() {
        // y_s = 0.045944/(ηR) and σ_s² = σ² − 3.717e-4/(ηR)² (CEB 1987), and ηRσ = 0.02035844 √α.
        for (m0, m2, m4) in [(1e-12, 0.01, 1e9), (4e-14, 0.003, 5e10)] {
            let moments = Isotropic { m0, m2, m4 };
            let summits = Nayak::of(&moments).unwrap();
            let product = summits.density * summits.radius;
            assert!((product * m0.sqrt() / summits.alpha.sqrt() / 0.02035844 - 1.0).abs() < 1e-6);
            assert!((summits.mean_summit * product / 0.045944 - 1.0).abs() < 1e-4);
            let lost = (m0 - summits.std.powi(2)) * product * product;
            assert!((lost / 3.717e-4 - 1.0).abs() < 1e-4, "{lost}");
            assert!(Nayak::of(&Isotropic { m4: 0.89 * m2 * m2 / m0, ..moments }).is_none());
            // With a positive bandwidth.
            assert!(Nayak::of(&Isotropic { m0: -m0, m2, m4: -m4 }).is_none());
            assert!(Nayak::of(&Isotropic { m2: -m2, ..moments }).is_none());
        }
    }
}
