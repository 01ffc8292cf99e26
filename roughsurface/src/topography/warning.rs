//! Warnings about a topography, with the numbers that they rest on; `Display` renders them.

use super::spectrum::Limit;
use tables::numbers::{beside, digits, plain, rounded};

/// How a unit is given that a file does not state.
pub(super) const UNIT_REMEDY: &str =
    "for text and npy --unit um changes that, or titles such as x [mm], z [um]";

/// A message about a topography with the options of the face on the other side.
pub fn options_of_other(message: &str) -> String {
    message.replace("--unit", "--other-unit").replace("--pixel", "--other-pixel")
}

/// Assumptions made in reading a topography, and limits of validity of its characterisation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Warning {
    #[error("the file states no unit; lengths are taken to be in metres ({})", UNIT_REMEDY)]
    NoUnit,
    #[error(
        "the file states no unit, and heights of {rms:.1e} m rms at points {pixel:.1e} m apart look like micrometres \
         read as metres ({})",
        UNIT_REMEDY
    )]
    Micrometres { rms: f64, pixel: f64 },
    #[error(
        "heights of {rms:.1e} m rms at points {pixel:.1e} m apart are long for roughness: are the units of heights and \
         positions those of the file?"
    )]
    Long { rms: f64, pixel: f64 },
    #[error("heights of {rms:.1e} m rms are shorter than atoms: is the unit of heights that of the file?")]
    Short { rms: f64 },
    #[error(
        "positions are whole numbers, one unit apart: if they count the points, --pixel gives their distance"
    )]
    CountedPositions,
    #[error("commas are read as decimal commas")]
    DecimalCommas,
    #[error("the profile is not evenly spaced and was resampled by straight lines")]
    Resampled,
    #[error(
        "{} % of the points have no height and were filled in from their neighbours", digits(100.0 * .share, 2)
    )]
    Filled { share: f64 },
    #[error(
        "opposite edges of the map fit together: if it is periodic, --periodic measures it without trend and window"
    )]
    SeemsPeriodic,
    #[error(
        "taken to continue at its other side, by --periodic, --window none or the file, the topography has a step there {ratio:.0} times \
         as high as between neighbouring points, which counts as slope and curvature"
    )]
    EdgesJump { ratio: f64 },
    #[error(
        "{count} points stand out from their neighbours by more than eight standard deviations: \
         spikes make R too small, and count as noise; a height of nan is filled in from its neighbours"
    )]
    Spikes { count: usize },
    #[error(
        "a paraboloid takes {:.0} % off the mean square of the heights: the specimen is curved; --detrend \
         quadratic removes this form", 100.0 * .share
    )]
    Form { share: f64 },
    #[error(
        "white noise, or waves shorter than two points, contribute {:.0} % of m4 at this cut-off: R without them is \
         larger by a factor of {:.2}; a longer cut-off reduces them",
        100.0 * .share,
        1.0 / (1.0 - .share).sqrt()
    )]
    Noise { share: f64 },
    #[error(
        "no cut-off was given and the reliability limit of {limit:.3e} m ({reason}) is used: summit radius and \
         density follow from it, {}; an instrument may \
         blur longer waves than that, give what it resolves with --cutoff",
        match .radius_at_twice {
            Some(ratio) => format!("twice the cut-off gives {ratio:.2} times the radius"),
            None => "twice the cut-off is more than the topography allows".to_owned(),
        }
    )]
    NoCutoff { limit: f64, reason: Limit, radius_at_twice: Option<f64> },
    #[error(
        "the cut-off of {} m is shorter than the reliability limit of {} m ({reason})",
        beside(*.cutoff, rounded(*.limit, 4), 4),
        plain(rounded(*.limit, 4))
    )]
    CutoffTooShort { cutoff: f64, limit: f64, reason: Limit },
    #[error(
        "the mean square slopes across the lay and along it, at {angle:.0} degrees to the rows, differ by a factor \
         of {ratio:.2}; summits are those of the isotropic surface with the geometric means of slopes and curvatures"
    )]
    Lay { ratio: f64, angle: f64 },
    #[error("the rms slope Sdq or Rdq is {slope:.1}: are heights and positions in the same unit?")]
    Steep { slope: f64 },
    #[error("bandwidth alpha = {alpha:.3}: that of an isotropic surface is at least 1.5")]
    NarrowBand { alpha: f64 },
    #[error(
        "a profile shows one direction only; summits are those of an isotropic surface with such profiles"
    )]
    Profile,
    #[error("{count} summits were found, too few for statistics")]
    FewSummits { count: usize },
    #[error("other face: {}", options_of_other(&.0.to_string()))]
    OtherFace(Box<Warning>),
    #[error(
        "the lays of both faces are taken to be parallel; at right angles the density of summits is {density:.2} and \
         their radius {radius:.2} times as large"
    )]
    ParallelLays { density: f64, radius: f64 },
    #[error(
        "summit heights have skewness {skewness:.2} and kurtosis {kurtosis:.2}, a Gaussian distribution 0 and 3; \
         of one face `roughsurface characterize --summits found` writes those that were found"
    )]
    NotGaussian { skewness: f64, kurtosis: f64 },
}

impl serde::Serialize for Warning {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
