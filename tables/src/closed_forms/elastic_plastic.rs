//! The material of a closed form.

use super::hertz;
use super::partial_slip::tangential_modulus;

/// Elastic–perfectly plastic body.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElasticPlastic {
    /// E, Pa.
    pub youngs_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// σ_Y, Pa.
    pub yield_strength: f64,
}

/// A mild steel, of which examples and tests are.
pub const STEEL: ElasticPlastic =
    ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 400e6 };

impl ElasticPlastic {
    /// E* = E/(1−ν²), Pa.
    pub fn contact_modulus(&self) -> f64 {
        hertz::contact_modulus(self.youngs_modulus, self.poisson_ratio)
    }

    /// G* = G/(2−ν), Pa.
    pub fn tangential_modulus(&self) -> f64 {
        tangential_modulus(self.youngs_modulus, self.poisson_ratio)
    }

    /// τ₀ = σ_Y/√3, Pa.
    pub fn shear_strength(&self) -> f64 {
        self.yield_strength / 3f64.sqrt()
    }

    /// e_y = σ_Y/E*.
    pub fn yield_strain(&self) -> f64 {
        self.yield_strength / self.contact_modulus()
    }

    /// ω_c in metres for a sphere of `radius` metres.
    pub fn critical_interference(&self, radius: f64) -> f64 {
        let e_star = self.contact_modulus();
        hertz::critical_interference(e_star, self.poisson_ratio, self.yield_strength, radius)
    }
}
