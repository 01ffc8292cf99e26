//! A profile of points, evenly spaced or not.

use crate::topography::Topography;
use crate::topography::warning::Warning;

/// Steps of a grid may differ by this much of one from an even grid.
pub(super) const EVEN: f64 = 0.02;

/// Largest part of a raster whose points are left out: more than can be filled in.
const MOST_LEFT_OUT: f64 = 0.9;

/// A profile through the points (x, z), m. Points that are left out of an even raster have no height; a profile without one is
/// resampled.
pub(super) fn profile(x: &[f64], z: &[f64], mut remarks: Vec<Warning>) -> Result<Topography, String> {
    let last = x.len().saturating_sub(1);
    if last == 0 {
        return Err("holds one point".into());
    }
    if let Some(place) = (0..last).find(|&i| x[i + 1].partial_cmp(&x[i]) != Some(std::cmp::Ordering::Greater))
    {
        return Err(format!(
            "positions must grow along the profile; point {} does not lie after the one before",
            place + 2
        ));
    }
    let step = (x[last] - x[0]) / last as f64;
    let even = (0..=last).all(|i| (x[i] - x[0] - step * i as f64).abs() <= EVEN * step);
    let heights = if even {
        z.to_vec()
    } else if let Some((step, places)) = raster(x) {
        let mut heights = vec![f64::NAN; places[last] + 1];
        places.iter().zip(z).for_each(|(place, z)| heights[*place] = *z);
        return Ok(Topography { remarks, ..Topography::profile(step, heights) });
    } else {
        remarks.push(Warning::Resampled);
        let mut segment = 0;
        (0..=last)
            .map(|i| {
                let at = x[0] + step * i as f64;
                while segment + 2 <= last && x[segment + 1] < at {
                    segment += 1;
                }
                let share = ((at - x[segment]) / (x[segment + 1] - x[segment])).clamp(0.0, 1.0);
                z[segment] + share * (z[segment + 1] - z[segment])
            })
            .collect()
    };
    Ok(Topography { remarks, ..Topography::profile(step, heights) })
}

/// Step of an even raster that has these positions, and the place of each on it.
fn raster(x: &[f64]) -> Option<(f64, Vec<usize>)> {
    let mut steps: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let length = x.last()? - x.first()?;
    // Of most points the next one is there.
    let count = (length / steps[steps.len() / 2]).round();
    if (x.len() as f64) < (1.0 - MOST_LEFT_OUT) * count {
        return None;
    }
    let step = length / count;
    let place = |x_i: &f64| {
        let place = (x_i - x[0]) / step;
        ((place - place.round()).abs() <= EVEN).then_some(place.round() as usize)
    };
    let places: Vec<usize> = x.iter().map(place).collect::<Option<_>>()?;
    places.windows(2).all(|pair| pair[1] > pair[0]).then_some((step, places))
}
