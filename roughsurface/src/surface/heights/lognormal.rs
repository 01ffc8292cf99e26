use super::distribution::{Heights, Random};
use rand_distr::Distribution;
use std::f64::consts::{PI, SQRT_2};

/// Log-normal heights above the lowest summit: ln z is Gaussian with standard
/// deviation `shape`.
#[derive(Clone, Debug)]
pub struct LogNormal {
    std: f64,
    /// Mean of ln z, z in metres.
    mean_ln: f64,
    shape: f64,
}

impl LogNormal {
    /// Heights of standard deviation `std` (m); `shape` is the standard deviation of ln z.
    pub fn new(std: f64, shape: f64) -> Self {
        let square = shape * shape;
        Self { std, mean_ln: std.ln() - 0.5 * square - 0.5 * square.exp_m1().ln(), shape }
    }
}

impl Heights for LogNormal {
    fn ln_density(&self, height: f64) -> f64 {
        if height <= 0.0 {
            return f64::NEG_INFINITY;
        }
        let scaled = (height.ln() - self.mean_ln) / self.shape;
        -0.5 * scaled * scaled - (height * self.shape * (2.0 * PI).sqrt()).ln()
    }
    fn tail(&self, height: f64) -> f64 {
        if height <= 0.0 {
            return 1.0;
        }
        0.5 * libm::erfc((height.ln() - self.mean_ln) / (self.shape * SQRT_2))
    }
    fn mode(&self) -> f64 {
        (self.mean_ln - self.shape * self.shape).exp()
    }
    fn support(&self) -> (f64, f64) {
        (0.0, f64::INFINITY)
    }
    fn standard_deviation(&self) -> f64 {
        self.std
    }
    fn draw(&self, random: &mut Random) -> f64 {
        rand_distr::LogNormal::new(self.mean_ln, self.shape)
            .expect("shape is positive and finite")
            .sample(random)
    }
}
