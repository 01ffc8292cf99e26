//! Warnings about a topography, with the numbers that they rest on; `Display` renders them.

use super::spectrum::Limit;

/// Assumptions made in reading a topography, and limits of validity of its characterisation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    #[error(
        "the file states no unit; lengths are taken to be in metres (for text and npy --unit changes that)"
    )]
    NoUnit,
    #[error(
        "heights of {rms:.1e} m rms at points {pixel:.1e} m apart: these lengths look like micrometres read as \
         metres (--unit um, for text and npy)"
    )]
    Micrometres { rms: f64, pixel: f64 },
    #[error("commas are read as decimal commas")]
    DecimalCommas,
    #[error("the profile is not evenly spaced and was resampled by straight lines")]
    Resampled,
    #[error(
        "{:.2} % of the points have no height and were filled in from their neighbours", 100.0 * .share
    )]
    Filled { share: f64 },
    #[error(
        "opposite edges of the map fit together: if it is periodic, --periodic measures it without trend and window"
    )]
    SeemsPeriodic,
    #[error(
        "{count} points stand out from the median of their neighbours by more than eight standard deviations: \
         spikes make R too small; remove them"
    )]
    Spikes { count: usize },
    #[error(
        "a paraboloid takes {:.0} % off the mean square of the heights: the specimen is curved; --detrend \
         quadratic removes this form", 100.0 * .share
    )]
    Form { share: f64 },
    #[error(
        "below {limit:.3e} m the spectrum is that of noise, which contributes {:.0} % of m4 at this cut-off: R \
         without it is larger by a factor of {:.2}; a longer cut-off reduces it",
        100.0 * .share,
        1.0 / (1.0 - .share).sqrt()
    )]
    Noise { limit: f64, share: f64 },
    #[error(
        "no cut-off was given and the reliability limit of {limit:.3e} m ({reason}) is used: summit radius and \
         density follow from it, twice the cut-off gives {radius_at_twice:.2} times the radius; an instrument may \
         blur longer waves than that, give what it resolves with --cutoff"
    )]
    NoCutoff { limit: f64, reason: Limit, radius_at_twice: f64 },
    #[error(
        "the cut-off of {cutoff:.3e} m is shorter than the reliability limit of {limit:.3e} m ({reason})"
    )]
    CutoffTooShort { cutoff: f64, limit: f64, reason: Limit },
    #[error(
        "the mean square slopes across the lay and along it, at {angle:.0} degrees to the rows, differ by a factor \
         of {ratio:.2}; summits are those of an isotropic surface"
    )]
    Lay { ratio: f64, angle: f64 },
    #[error("the rms slope Sdq or Rdq is {slope:.1}: are heights and positions in the same unit?")]
    Steep { slope: f64 },
    #[error("bandwidth alpha = {alpha:.3}: that of an isotropic surface is at least 1.5")]
    NarrowBand { alpha: f64 },
    #[error("a profile shows one direction only; summits are those of an isotropic surface")]
    Profile,
    #[error("{count} summits were found, too few for statistics")]
    FewSummits { count: usize },
    #[error(
        "summit heights have skewness {skewness:.2} and kurtosis {kurtosis:.2}, a Gaussian distribution 0 and 3; \
         --summits found writes those that were found"
    )]
    NotGaussian { skewness: f64, kurtosis: f64 },
}

impl serde::Serialize for Warning {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
