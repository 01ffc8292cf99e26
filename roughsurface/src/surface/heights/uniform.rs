use super::distribution::{Heights, Random};
use rand::RngExt;

/// Heights spread evenly over ±√3 σ about their mean plane.
#[derive(Clone, Debug)]
pub struct Uniform {
    half_width: f64,
}

impl Uniform {
    /// Heights of standard deviation `std` (m).
    pub fn new(std: f64) -> Self {
        Self { half_width: 3f64.sqrt() * std }
    }
}

impl Heights for Uniform {
    fn ln_density(&self, height: f64) -> f64 {
        if height.abs() > self.half_width { f64::NEG_INFINITY } else { -(2.0 * self.half_width).ln() }
    }
    fn tail(&self, height: f64) -> f64 {
        (0.5 - 0.5 * height / self.half_width).clamp(0.0, 1.0)
    }
    fn mode(&self) -> f64 {
        0.0
    }
    fn support(&self) -> (f64, f64) {
        (-self.half_width, self.half_width)
    }
    fn standard_deviation(&self) -> f64 {
        self.half_width / 3f64.sqrt()
    }
    fn draw(&self, random: &mut Random) -> f64 {
        self.half_width * (2.0 * random.random::<f64>() - 1.0)
    }
}
