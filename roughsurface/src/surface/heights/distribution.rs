//! The interface of a distribution of summit heights.

use std::fmt::Debug;
use wide::f64x4;

/// Generator of the random heights: small, fast, and the same on every machine.
pub type Random = rand::rngs::Xoshiro256PlusPlus;

/// Distribution of the heights z of the summits, in metres above the plane from
/// which separations are measured.
///
/// Densities have one maximum, unless [`ln_peak`](Heights::ln_peak) and
/// [`step_between`](Heights::step_between) are implemented for several.
pub trait Heights: Debug + Send + Sync {
    /// Natural logarithm of the density φ(z), φ in 1/m; −∞ where there are no summits.
    fn ln_density(&self, height: f64) -> f64;
    /// Share of the summits that are higher than `height`, 0 to 1.
    fn tail(&self, height: f64) -> f64;
    /// Height at which the density is largest, m.
    fn mode(&self) -> f64;
    /// Largest value of [`ln_density`](Heights::ln_density) between two heights (m).
    fn ln_peak(&self, from: f64, to: f64) -> f64 {
        self.ln_density(self.mode().min(to).max(from))
    }
    /// A height (m) strictly between the two at which the density jumps, the ends of its
    /// support aside; where there are several, one in their middle.
    fn step_between(&self, _from: f64, _to: f64) -> Option<f64> {
        None
    }
    /// Heights (m) to densities (1/m), in place: the inner loop of the integrals.
    fn densities(&self, heights: &mut [f64]) {
        for height in heights.iter_mut() {
            *height = self.ln_density(*height);
        }
        let (lanes, rest) = heights.as_chunks_mut::<4>();
        lanes.iter_mut().for_each(|lane| *lane = f64x4::new(*lane).exp().to_array());
        rest.iter_mut().for_each(|value| *value = value.exp());
    }
    /// Lowest and highest summit, m.
    fn support(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }
    /// Standard deviation of the heights, m: the step of searches.
    fn standard_deviation(&self) -> f64;
    /// A random height, m.
    fn draw(&self, random: &mut Random) -> f64;
    /// The heights themselves where they are a finite set, m.
    fn finite_set(&self) -> Option<&[f64]> {
        None
    }
}
