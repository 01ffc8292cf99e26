//! Finite surfaces: friction of surfaces with a given number of asperities, their
//! heights drawn at random, and how much it scatters from one to the next.
//!
//! [`friction`](crate::friction) gives the mean of a surface without end; a specimen
//! of a few hundred asperities, of which a dozen touch, is one draw.

use crate::friction::{PredictionError, Settings};
use crate::integral::contact_state::ContactState;
use crate::integral::height_integral::{HeightIntegral, NEGLIGIBLE_SHARE};
use crate::integral::predictor::Start;
use crate::integral::separation::separation_for;
use crate::integral::surface_integral::{Asperities, ContactIntegral, SurfaceIntegral};
use crate::surface::heights::{Heights, Random, Sample};
use crate::surface::query::{Hold, Pressing, Query, Surface};
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use tables::law::{AsperityLaw, LookupError};

/// Finite surfaces asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Asperities of one surface, in contact or not.
    pub asperities: usize,
    /// Surfaces drawn.
    pub realizations: usize,
    /// Seed of the heights: the same seed gives the same surfaces.
    pub seed: u64,
    /// Slip at which friction is read, m.
    pub slip: f64,
}

/// One finite surface under one pressure at one slip rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Draw {
    /// Friction over load after the slip, 1; NaN if nothing touches.
    pub mu: f64,
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// Friction stress on the nominal area, Pa.
    pub shear: f64,
    /// Distance of the flat from the plane of the heights, m.
    pub separation: f64,
    /// Real over nominal contact area, 1.
    pub area_fraction: f64,
    /// Asperities in contact.
    pub contacts: f64,
    /// Share of the load beyond the range of the law, 1.
    pub outside: f64,
}

/// Mean and scatter of a quantity over the surfaces drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Scatter {
    pub mean: f64,
    /// Half width of the 95 % confidence interval of the mean.
    pub mean_error: f64,
    pub standard_deviation: f64,
    /// 2.5 and 97.5 % quantiles: where 95 % of the surfaces lie.
    pub lower: f64,
    pub upper: f64,
}

/// Half width of a 95 % interval in standard deviations, for many draws.
const NORMAL_95: f64 = 1.959_963_984_540_054;

impl Scatter {
    /// Of the values that are numbers; NaN throughout if there are none.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let standard_deviation = (squares / (count - 1.0)).sqrt();
        let quantile = |share: f64| {
            let Some(last) = values.len().checked_sub(1) else {
                return f64::NAN;
            };
            let place = share * last as f64;
            let below = place.floor() as usize;
            let next = values[(below + 1).min(last)];
            values[below] + (place - below as f64) * (next - values[below])
        };
        Self {
            mean,
            mean_error: NORMAL_95 * standard_deviation / count.sqrt(),
            standard_deviation,
            lower: quantile(0.025),
            upper: quantile(0.975),
        }
    }
}

/// Finite surfaces and what became of them.
#[derive(Clone, Debug)]
pub struct Samples {
    pub query: Query,
    pub sampling: Sampling,
    pub law: String,
    /// One row per pressure or separation, one column per slip rate, then the surfaces.
    pub draws: Vec<Vec<Vec<Draw>>>,
    pub warnings: Vec<String>,
}

impl Samples {
    /// Scatter of a quantity at one pressure or separation and slip rate.
    pub fn scatter(&self, row: usize, rate: usize, quantity: impl Fn(&Draw) -> f64) -> Scatter {
        Scatter::of(self.draws[row][rate].iter().map(quantity))
    }
}

/// Draws finite surfaces and slides them by [`Sampling::slip`].
///
/// Each surface has a seed of its own, drawn in order, so the result does not depend
/// on the number of threads; the same surfaces meet every pressure and slip rate.
/// With the load held the separation is that of the end of the slide; with the
/// separation held it is that of the pressure before the slide.
///
/// ```
/// use roughsurface::friction::Settings;
/// use roughsurface::surface::heights::Gaussian;
/// use roughsurface::sampling::finite_surface::{Sampling, sample};
/// use roughsurface::surface::query::{Hold, Pressing, Query, Surface};
/// use tables::closed_forms::{ElasticPlastic, closed_form};
///
/// let steel = ElasticPlastic { youngs_modulus: 205e9, poisson_ratio: 0.29, yield_strength: 792e6 };
/// let law = closed_form("jackson-green", &steel)?;
/// let surface = Surface {
///     asperity_density: 1e8,
///     asperity_radius: 1e-3.into(),
///     heights: Box::new(Gaussian::new(0.4e-6)),
/// };
/// let query = Query { pressing: Pressing::Pressure(vec![1e7]), slip_rates: vec![1.0], hold: Hold::Load };
/// let sampling = Sampling { asperities: 300, realizations: 5, seed: 1, slip: 10e-6 };
/// let draws = || sample(law.as_ref(), &surface, &query, &sampling, &Settings::default(), &|_, _| ());
/// // The same seed gives the same surfaces, on any number of threads.
/// let (one, other) = (draws()?.scatter(0, 0, |draw| draw.mu), draws()?.scatter(0, 0, |draw| draw.mu));
/// assert_eq!(one.mean, other.mean);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn sample(
    law: &dyn AsperityLaw,
    surface: &Surface,
    query: &Query,
    sampling: &Sampling,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Samples, PredictionError> {
    query.check_slip_rates(law, &surface.asperity_radius)?;
    let with_rate = |&rate: &f64| {
        let before = Asperities::new(law, surface, rate)?;
        Ok(Laws { slip_rate: rate, after: before.after(sampling.slip), before })
    };
    let laws: Vec<Laws> = query.slip_rates.iter().map(with_rate).collect::<Result<_, LookupError>>()?;
    let starts = starts(&laws, surface, query, settings);
    let mut seeds = Random::seed_from_u64(sampling.seed);
    let seeds: Vec<u64> = (0..sampling.realizations).map(|_| seeds.random()).collect();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let surfaces = seeds
        .into_par_iter()
        .map(|seed| {
            let drawn = DrawnSurface::new(surface, sampling.asperities, seed)
                .and_then(|drawn| drawn.answer(&laws, &starts, law.interference_limit(), query, settings));
            let count = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
            progress(count, sampling.realizations);
            drawn
        })
        .collect::<Vec<_>>();
    let surfaces = surfaces.into_iter().collect::<Result<Vec<_>, _>>()?;

    let rates = query.slip_rates.len();
    let draws: Vec<Vec<Vec<Draw>>> = (0..query.pressing.values().len())
        .map(|row| {
            (0..rates).map(|rate| surfaces.iter().map(|drawn| drawn[row * rates + rate]).collect()).collect()
        })
        .collect();
    let warnings = warnings(query, &draws);
    Ok(Samples { query: query.clone(), sampling: *sampling, law: law.name(), draws, warnings })
}

/// The asperities at one slip rate.
struct Laws<'a> {
    slip_rate: f64,
    before: Asperities<'a>,
    after: Asperities<'a>,
}

/// Where finite surfaces look for their separation: at that of the surface without end, for every
/// pressure or separation and slip rate, row by row.
fn starts(laws: &[Laws], surface: &Surface, query: &Query, settings: &Settings) -> Vec<Start> {
    let heights = surface.heights.as_ref();
    let mut start = Start::at(heights.mode(), heights);
    let mut starts = Vec::new();
    for &value in query.pressing.values() {
        for law in laws {
            let asperities = if query.hold == Hold::Load { &law.after } else { &law.before };
            let mut integral =
                SurfaceIntegral::new(asperities, heights, surface.asperity_density, settings.tolerance);
            start = match query.pressing {
                Pressing::Separation(_) => Start::at(value, heights),
                // A surface that has none may be drawn all the same: it starts where the last did.
                Pressing::Pressure(_) => {
                    separation_for(&mut integral, heights, value, start, settings.tolerance)
                        .map_or(start, |carried| carried.start())
                }
            };
            starts.push(Start { sensitivity: None, ..start });
        }
    }
    starts
}

/// A finite surface.
struct DrawnSurface {
    asperity_density: f64,
    asperities: usize,
    all: Sample,
    /// Heights of the summits of each radius; empty if there is one radius only.
    of_class: Vec<Sample>,
}

impl DrawnSurface {
    fn new(surface: &Surface, asperities: usize, seed: u64) -> Result<Self, PredictionError> {
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
        // A single asperity, or none, has no distribution to speak of.
        let nothing =
            || PredictionError::NoContact { pressing: "a surface of less than two asperities".into() };
        let all = Sample::new(heights).ok_or_else(nothing)?;
        Ok(Self { asperity_density: surface.asperity_density, asperities, all, of_class })
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

    /// Every pressure or separation and slip rate, row by row.
    fn answer(
        &self,
        laws: &[Laws],
        starts: &[Start],
        limit: f64,
        query: &Query,
        settings: &Settings,
    ) -> Result<Vec<Draw>, PredictionError> {
        let tolerance = settings.tolerance;
        let mut draws = Vec::new();
        for (row, &value) in query.pressing.values().iter().enumerate() {
            for (law, start) in laws.iter().zip(&starts[row * laws.len()..]) {
                let mut before = self.integral(&law.before, tolerance);
                let mut after = self.integral(&law.after, tolerance);
                let pressed = match query.pressing {
                    Pressing::Pressure(_) => None,
                    Pressing::Separation(_) => Some((value, before.at(value)?)),
                };
                let find = |integral: &mut SurfaceIntegral, pressure: f64| {
                    separation_for(integral, &self.all, pressure, *start, tolerance)
                };
                let (separation, state) = match (query.hold, pressed) {
                    (Hold::Separation, Some((separation, _))) => (separation, after.at(separation)?),
                    (Hold::Separation, None) => {
                        let separation = find(&mut before, value)?.separation;
                        (separation, after.at(separation)?)
                    }
                    (Hold::Load, pressed) => {
                        let pressure = pressed.map_or(value, |(_, state)| state.pressure.value);
                        if pressure > 0.0 {
                            let carried = find(&mut after, pressure)?;
                            (carried.separation, carried.state)
                        } else {
                            (value, ContactState::default())
                        }
                    }
                };
                if state.outside > NEGLIGIBLE_SHARE && !settings.extrapolate {
                    return Err(PredictionError::OutsideTable {
                        pressing: query.pressing.describe(row),
                        slip_rate: law.slip_rate,
                        limit,
                        reach: state.reach,
                        share: state.outside,
                    });
                }
                draws.push(Draw {
                    mu: state.friction_coefficient().value,
                    pressure: state.pressure.value,
                    shear: state.shear.value,
                    separation,
                    area_fraction: state.area_fraction.value,
                    contacts: state.contact_density / self.asperity_density * self.asperities as f64,
                    outside: state.outside,
                });
            }
        }
        Ok(draws)
    }
}

fn warnings(query: &Query, draws: &[Vec<Vec<Draw>>]) -> Vec<String> {
    let mut warnings = Vec::new();
    for (row, columns) in draws.iter().enumerate() {
        for (slip_rate, surfaces) in query.slip_rates.iter().zip(columns) {
            let place = format!("{}, {slip_rate} m/s", query.pressing.describe(row));
            let count = surfaces.len();
            let outside = surfaces.iter().map(|draw| draw.outside).fold(0.0, f64::max);
            if outside > NEGLIGIBLE_SHARE {
                warnings.push(format!(
                    "{place}: up to {:.2} % of the load of a surface lies beyond the table and is extrapolated",
                    100.0 * outside
                ));
            }
            let idle = surfaces.iter().filter(|draw| draw.mu.is_nan()).count();
            if idle > 0 {
                warnings.push(format!(
                    "{place}: {idle} of {count} surfaces have no asperity in contact and no friction coefficient"
                ));
            }
        }
    }
    warnings
}

#[cfg(test)]
mod tests;
