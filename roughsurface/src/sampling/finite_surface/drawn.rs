//! One finite surface: its summits drawn at random.

use crate::friction::PredictionError;
use crate::integral::height_integral::HeightIntegral;
use crate::integral::surface_integral::{Asperities, SurfaceIntegral};
use crate::sampling::finite_surface::states::Summits;
use crate::surface::heights::{Heights, Random, Sample};
use crate::surface::query::Surface;
use rand::SeedableRng;

/// A finite surface.
pub(super) struct DrawnSurface {
    asperity_density: f64,
    asperities: usize,
    all: Sample,
    /// Heights of the summits of each radius; empty if there is one radius only.
    of_class: Vec<Sample>,
}

impl DrawnSurface {
    pub(super) fn new(surface: &Surface, asperities: usize, seed: u64) -> Result<Self, PredictionError> {
        let mut random = Random::seed_from_u64(seed);
        let heights: Vec<f64> = (0..asperities).map(|_| surface.heights.draw(&mut random)).collect();
        let mut of_class = Vec::new();
        let radii = &surface.asperity_radius;
        if radii.classes().len() > 1 {
            let mut classes = vec![Vec::new(); radii.classes().len()];
            for &height in &heights {
                classes[radii.draw(&mut random)].push(height);
            }
            of_class = classes.into_iter().map(Sample::part).collect();
        }
        // One asperity has no distribution of heights.
        let too_few =
            || PredictionError::NoContact { loading: "a surface of less than two asperities".into() };
        let all = Sample::new(heights).ok_or_else(too_few)?;
        Ok(Self { asperity_density: surface.asperity_density, asperities, all, of_class })
    }
}

impl Summits for DrawnSurface {
    fn heights(&self) -> &dyn Heights {
        &self.all
    }

    fn area(&self) -> f64 {
        self.asperities as f64 / self.asperity_density
    }

    fn integral<'a>(&'a self, asperities: &Asperities<'a>, tolerance: f64) -> SurfaceIntegral<'a> {
        let parts =
            if self.of_class.is_empty() { std::slice::from_ref(&self.all) } else { &self.of_class[..] };
        let integrals = parts.iter().zip(asperities.classes()).map(|(heights, (_, asperity))| {
            let count = heights.measured().map_or(0, <[f64]>::len);
            let share = count as f64 / self.asperities as f64;
            (share, HeightIntegral::new(asperity.clone(), heights, self.asperity_density, tolerance))
        });
        SurfaceIntegral::of_parts(integrals.filter(|(share, _)| *share > 0.0).collect())
    }
}
