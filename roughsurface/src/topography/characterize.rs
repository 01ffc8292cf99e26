//! Parameters of a rough surface from a topography.

use super::nayak::{Nayak, SMALLEST_ALPHA};
use super::spectrum::{Limit, Moments, Spectrum, Window};
use super::summits::{self, Summits};
use super::{Topography, detrend};

pub use detrend::Detrend;

/// Settings of a characterisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Short-wavelength cut-off, m; the reliability limit unless given.
    pub cutoff: Option<f64>,
    pub detrend: Detrend,
    pub window: Window,
}

/// Result of a characterisation.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Characterization {
    /// Points across and along rows; (1, n) for a profile.
    pub points: (usize, usize),
    /// Longest step of the grid, m.
    pub pixel: f64,
    /// Extent across and along rows, m.
    pub size: (f64, f64),
    /// Cut-off used, m, and whether it was given.
    pub cutoff: f64,
    pub cutoff_asked: bool,
    /// Shortest wavelength resolved by the measurement, m, and its reason.
    pub reliability_limit: f64,
    pub limited_by: Limit,
    /// Root mean square height without trend and unfiltered (Sq, Rq), m.
    pub rms_height: f64,
    /// Root mean square slope along any direction, 1, and curvature, 1/m.
    pub rms_slope: f64,
    pub rms_curvature: f64,
    pub moments: Moments,
    /// Summits of the Gaussian surface with these moments.
    pub summits: Nayak,
    /// Summits found one by one, on a profile its peaks.
    pub found: Summits,
    /// R with twice the cut-off over R: the influence of the cut-off.
    pub radius_at_twice_the_cutoff: f64,
    /// (wavenumber in rad/m, mean power of a wave in m²).
    #[serde(skip)]
    pub spectrum: Vec<(f64, f64)>,
    pub warnings: Vec<String>,
}

/// Mean square slopes that differ by more than this factor make a surface with a lay.
const ISOTROPIC: f64 = 1.5;

/// Smallest number of summits whose statistics are not warned about.
const FEW_SUMMITS: usize = 100;

/// Skewness and excess kurtosis of summit heights that a Gaussian distribution does not describe.
const SKEWED: f64 = 0.5;
const HEAVY_TAILED: f64 = 1.0;

/// Moments and summits of `topography`, or the error in the cut-off.
pub fn characterize(mut topography: Topography, options: &Options) -> Result<Characterization, String> {
    options.detrend.subtract(&mut topography);
    let count = topography.heights.len() as f64;
    let rms_height = (topography.heights.iter().map(|z| z * z).sum::<f64>() / count).sqrt();
    let spectrum = Spectrum::of(&topography, options.window);
    let (reliability_limit, limited_by) = spectrum.reliability_limit();
    let cutoff = options.cutoff.unwrap_or(reliability_limit);

    let pixel = topography.pixel();
    let size = topography.size();
    let longest = if topography.is_profile() { size.1 } else { size.0.min(size.1) };
    if cutoff < 2.0 * pixel || cutoff > 0.25 * longest {
        return Err(format!(
            "cutoff = {cutoff:e} m: must lie between two points, {:e} m, and a quarter of the extent, {:e} m",
            2.0 * pixel,
            0.25 * longest
        ));
    }
    let moments = spectrum.moments(cutoff);
    let Some(nayak) = Nayak::of(&moments) else {
        return Err(format!(
            "bandwidth alpha = {:.3}: no random surface has one below 0.897; a single wave, or too long a cut-off?",
            moments.m0 * moments.m4 / moments.m2.powi(2)
        ));
    };
    let coarser = spectrum.moments(2.0 * cutoff);
    let found = summits::find(&topography, cutoff);
    let mut characterization = Characterization {
        points: (topography.rows, topography.columns),
        pixel,
        size,
        cutoff,
        cutoff_asked: options.cutoff.is_some(),
        reliability_limit,
        limited_by,
        rms_height,
        rms_slope: moments.m2.sqrt(),
        rms_curvature: moments.m4.sqrt(),
        moments,
        summits: nayak,
        found,
        radius_at_twice_the_cutoff: (moments.m4 / coarser.m4).sqrt(),
        spectrum: spectrum.radial(),
        warnings: topography.remarks.clone(),
    };
    let warnings = warnings(&characterization, topography.is_profile());
    characterization.warnings.extend(warnings);
    Ok(characterization)
}

fn warnings(found: &Characterization, profile: bool) -> Vec<String> {
    let mut warnings = Vec::new();
    let limit = found.reliability_limit;
    let why = match found.limited_by {
        Limit::Sampling => "four points a wave",
        Limit::Noise => "below, the spectrum is that of noise",
    };
    if !found.cutoff_asked {
        warnings.push(format!(
            "no cut-off was given and the reliability limit of {limit:.3e} m ({why}) is used: summit radius and \
             density follow from it, twice the cut-off gives {:.2} times the radius; an instrument may blur \
             longer waves than that, give what it resolves with --cutoff",
            found.radius_at_twice_the_cutoff
        ));
    } else if found.cutoff < limit {
        warnings.push(format!(
            "the cut-off of {:.3e} m is shorter than the reliability limit of {limit:.3e} m ({why})",
            found.cutoff
        ));
    }
    let (across, along) = found.moments.m2_directions;
    let lay = (across / along).max(along / across);
    if lay > ISOTROPIC {
        warnings.push(format!(
            "the mean square slopes across and along the rows differ by a factor of {lay:.2}; summits are those \
             of an isotropic surface"
        ));
    }
    if found.summits.alpha < SMALLEST_ALPHA {
        warnings.push(format!(
            "bandwidth alpha = {:.3}: that of an isotropic surface is at least 1.5",
            found.summits.alpha
        ));
    }
    if profile {
        warnings.push("a profile shows one direction only; summits are those of an isotropic surface".into());
    }
    if found.found.count < FEW_SUMMITS {
        warnings.push(format!("{} summits were found, too few for statistics", found.found.count));
    } else if found.found.skewness.abs() > SKEWED || (found.found.kurtosis - 3.0).abs() > HEAVY_TAILED {
        warnings.push(format!(
            "summit heights have skewness {:.2} and kurtosis {:.2}, a Gaussian distribution 0 and 3; --summits \
             found writes those that were found",
            found.found.skewness, found.found.kurtosis
        ));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::SelfAffine;
    use super::*;

    #[test]
    fn the_cutoff_is_never_the_pixel_without_a_warning() {
        let map = SelfAffine::default().map(1);
        let found = characterize(map.clone(), &Options::default()).unwrap();
        assert_eq!(found.cutoff, 4.0 * map.pixel());
        assert!(found.warnings[0].starts_with("no cut-off was given"), "{:?}", found.warnings);
        assert!(found.radius_at_twice_the_cutoff > 1.0);
        let asked = |cutoff: f64| {
            let options = Options { cutoff: Some(cutoff), ..Options::default() };
            characterize(map.clone(), &options)
        };
        assert!(asked(8.0 * map.pixel()).unwrap().warnings.is_empty());
        let fine = asked(3.0 * map.pixel()).unwrap();
        assert!(fine.warnings[0].contains("shorter than the reliability limit"));
        assert!(asked(map.pixel()).unwrap_err().starts_with("cutoff = 1e-7 m: must lie between"));
        assert!(asked(1.0).is_err());
    }

    #[test]
    fn a_surface_with_a_lay_is_called_one() {
        let mut map = SelfAffine::default().map(1);
        map.row_step *= 2.0;
        let cutoff = Some(8.0 * map.pixel());
        let found = characterize(map, &Options { cutoff, ..Options::default() }).unwrap();
        assert!(found.warnings.iter().any(|warning| warning.contains("isotropic surface")));
    }
}
