//! Isotropic linear elasticity.

/// Elastic moduli, in units of the problem's stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    pub bulk: f64,
    pub shear: f64,
}

impl Moduli {
    pub fn new(youngs_modulus: f64, poisson_ratio: f64) -> Self {
        Self {
            bulk: youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)),
            shear: youngs_modulus / (2.0 * (1.0 + poisson_ratio)),
        }
    }
}
