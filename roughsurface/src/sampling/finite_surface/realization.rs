//! One finite surface: its summits drawn at random.

use crate::surface::heights::{Empirical, Random};
use crate::surface::query::Surface;
use rand::SeedableRng;

/// Heights of the summits of one finite surface.
pub(super) struct Realization {
    pub heights: Empirical,
    /// Heights of the summits of each radius; empty if all summits have one radius.
    pub heights_by_radius: Vec<Empirical>,
}

impl Realization {
    /// Draws the heights and radii of a number of `asperities` from the distributions of `surface`.
    pub fn draw(surface: &Surface, asperities: usize, seed: u64) -> Self {
        let mut random = Random::seed_from_u64(seed);
        let heights: Vec<f64> = (0..asperities).map(|_| surface.heights.draw(&mut random)).collect();
        let part = |heights| Empirical::part(heights, surface.heights.standard_deviation());
        let radii = &surface.asperity_radius;
        let mut heights_by_radius = Vec::new();
        if radii.classes.len() > 1 {
            let mut classes = vec![Vec::new(); radii.classes.len()];
            for &height in &heights {
                classes[radii.draw(&mut random)].push(height);
            }
            heights_by_radius = classes.into_iter().map(part).collect();
        }
        Self { heights: part(heights), heights_by_radius }
    }
}
