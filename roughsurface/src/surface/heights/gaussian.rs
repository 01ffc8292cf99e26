use super::distribution::{Heights, Random};
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{PI, SQRT_2};

/// Gaussian heights about the mean plane of the summits,
/// φ(z) = exp(−z²/2σ²)/(σ√2π).
#[derive(Clone, Debug)]
pub struct Gaussian {
    std: f64,
    /// 1/2σ², 1/m².
    half_precision: f64,
    ln_peak: f64,
}

impl Gaussian {
    /// Heights of standard deviation `std` (m).
    pub fn new(std: f64) -> Self {
        Self { std, half_precision: 0.5 / (std * std), ln_peak: -(std * (2.0 * PI).sqrt()).ln() }
    }
}

impl Heights for Gaussian {
    fn ln_density(&self, height: f64) -> f64 {
        self.ln_peak - self.half_precision * height * height
    }
    fn tail(&self, height: f64) -> f64 {
        0.5 * libm::erfc(height / (self.std * SQRT_2))
    }
    fn mode(&self) -> f64 {
        0.0
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        let standard: f64 = StandardNormal.sample(random);
        self.std * standard
    }
}
