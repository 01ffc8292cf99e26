use super::distribution::{Heights, Random};
use super::gaussian::Gaussian;
use tables::functions::{Accuracy, root_of};

/// A Gaussian surface whose summits below `lower` and above `upper` are missing,
/// as after polishing or running-in.
#[derive(Clone, Debug)]
pub struct TruncatedGaussian {
    parent: Gaussian,
    lower: f64,
    upper: f64,
    /// Share of the parent's summits that is left.
    share: f64,
}

impl TruncatedGaussian {
    /// Parent of standard deviation `std`, bounds counted from its mean plane (m);
    /// none if less than 1e-12 of the parent is left.
    pub fn new(std: f64, lower: f64, upper: f64) -> Option<Self> {
        let parent = Gaussian::new(std);
        let share = parent.tail(lower) - parent.tail(upper);
        (lower.is_finite() && upper.is_finite() && share > 1e-12).then_some(Self {
            parent,
            lower,
            upper,
            share,
        })
    }
}

impl Heights for TruncatedGaussian {
    fn ln_density(&self, height: f64) -> f64 {
        if (self.lower..=self.upper).contains(&height) {
            self.parent.ln_density(height) - self.share.ln()
        } else {
            f64::NEG_INFINITY
        }
    }
    fn tail(&self, height: f64) -> f64 {
        let height = height.clamp(self.lower, self.upper);
        (self.parent.tail(height) - self.parent.tail(self.upper)) / self.share
    }
    fn mode(&self) -> f64 {
        0f64.clamp(self.lower, self.upper)
    }
    fn support(&self) -> (f64, f64) {
        (self.lower, self.upper)
    }
    fn standard_deviation(&self) -> f64 {
        // var = σ² [1 + (αφ(α) − βφ(β))/Z − ((φ(α) − φ(β))/Z)²], α and β the scaled bounds.
        let std = self.parent.standard_deviation();
        let weighted = |height: f64| std * self.parent.ln_density(height).exp() / self.share;
        let (low, high) = (weighted(self.lower), weighted(self.upper));
        let spread = (self.lower * low - self.upper * high) / std - (low - high).powi(2);
        // Cancellation for narrow windows, where the heights are spread evenly.
        let even = (self.upper - self.lower) / 12f64.sqrt();
        (std * (1.0 + spread).max(0.0).sqrt()).min(even).max(1e-3 * even)
    }
    fn draw(&self, random: &mut Random) -> f64 {
        // Rejection, unless the window is so far in the tail that the tail is inverted instead.
        if self.share > 1e-3 {
            loop {
                let height = self.parent.draw(random);
                if (self.lower..=self.upper).contains(&height) {
                    return height;
                }
            }
        }
        let wanted = rand::RngExt::random::<f64>(random);
        let accuracy = Accuracy { value: 0.0, width: 1e-15 * (self.upper - self.lower) };
        let excess = |height: f64| self.tail(height) - wanted;
        root_of(self.lower, self.upper, accuracy, excess).unwrap_or(self.lower)
    }
}
