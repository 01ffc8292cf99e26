//! One finite surface: its summits drawn at random.

use crate::surface::heights::{Random, Sample};
use crate::surface::query::Surface;
use rand::SeedableRng;

/// Heights of the summits of a finite surface.
pub(super) struct Drawn {
    pub all: Sample,
    /// Those of each radius; empty if there is one radius only.
    pub of_radius: Vec<Sample>,
}

/// That many summits of `surface`.
pub(super) fn draw(surface: &Surface, asperities: usize, seed: u64) -> Drawn {
    let mut random = Random::seed_from_u64(seed);
    let heights: Vec<f64> = (0..asperities).map(|_| surface.heights.draw(&mut random)).collect();
    let part = |heights| Sample::part(heights, surface.heights.standard_deviation());
    let radii = &surface.asperity_radius;
    let mut of_radius = Vec::new();
    if radii.classes.len() > 1 {
        let mut classes = vec![Vec::new(); radii.classes.len()];
        for &height in &heights {
            classes[radii.draw(&mut random)].push(height);
        }
        of_radius = classes.into_iter().map(part).collect();
    }
    Drawn { all: part(heights), of_radius }
}
