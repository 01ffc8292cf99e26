//! A profile of points, evenly spaced or not.

use crate::topography::Topography;
use crate::topography::warning::Warning;

/// Steps of a grid may differ by this much of one from an even grid.
pub(super) const EVEN: f64 = 0.02;

/// A profile through the points (x, z), m, resampled if they are not evenly spaced.
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
