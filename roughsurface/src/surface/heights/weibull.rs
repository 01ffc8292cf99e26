use super::distribution::{Heights, Random};
use rand_distr::Distribution;

/// Weibull heights above the lowest summit, φ(z) = (k/λ)(z/λ)^(k−1) exp(−(z/λ)^k).
///
/// k = 1 is exponential, k = 3.6 nearly Gaussian, larger k skewed downwards as on
/// worn surfaces.
#[derive(Clone, Debug)]
pub struct Weibull {
    std: f64,
    scale: f64,
    shape: f64,
}

impl Weibull {
    /// Heights of standard deviation `std` (m) and shape k ≥ 1.
    pub fn new(std: f64, shape: f64) -> Self {
        let mean = libm::tgamma(1.0 + 1.0 / shape);
        let square = libm::tgamma(1.0 + 2.0 / shape);
        Self { std, scale: std / (square - mean * mean).sqrt(), shape }
    }
}

impl Heights for Weibull {
    fn ln_density(&self, height: f64) -> f64 {
        if height < 0.0 {
            return f64::NEG_INFINITY;
        }
        let scaled = height / self.scale;
        // 0 ln 0 would spoil the exponential case at its start.
        let power = if self.shape == 1.0 { 0.0 } else { (self.shape - 1.0) * scaled.ln() };
        (self.shape / self.scale).ln() + power - scaled.powf(self.shape)
    }
    fn tail(&self, height: f64) -> f64 {
        (-(height.max(0.0) / self.scale).powf(self.shape)).exp()
    }
    fn mode(&self) -> f64 {
        self.scale * (1.0 - 1.0 / self.shape).powf(1.0 / self.shape)
    }
    fn support(&self) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        rand_distr::Weibull::new(self.scale, self.shape).expect("scale and shape are positive").sample(random)
    }
}
