use super::distribution::{Heights, Random};
use rand_distr::{Distribution, Exp1};

/// Exponential heights above the lowest summit, φ(z) = exp(−z/σ)/σ for z ≥ 0.
#[derive(Clone, Debug)]
pub struct Exponential {
    std: f64,
}

impl Exponential {
    /// Heights of standard deviation, and mean, `std` (m).
    pub fn new(std: f64) -> Self {
        Self { std }
    }
}

impl Heights for Exponential {
    fn ln_density(&self, height: f64) -> f64 {
        if height < 0.0 { f64::NEG_INFINITY } else { -height / self.std - self.std.ln() }
    }
    fn tail(&self, height: f64) -> f64 {
        (-height.max(0.0) / self.std).exp()
    }
    fn mode(&self) -> f64 {
        0.0
    }
    fn support(&self) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        let standard: f64 = Exp1.sample(random);
        self.std * standard
    }
}
