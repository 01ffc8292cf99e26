//! Distributions of summit heights.
//!
//! To add a distribution: write its file here, implement [`Heights`], name it above
//! [`DISTRIBUTIONS`] and add its entry there; the surface file, its help and its messages, the
//! integrals and the sampling pick it up from there. The battery of tests wants an example.

mod exponential;
mod gaussian;
mod histogram;
mod inverted_chi_squared;
mod lognormal;
mod sample;
mod text_file;
mod truncated_gaussian;
mod uniform;
mod vector_exp;
mod weibull;

pub use exponential::Exponential;
pub use gaussian::Gaussian;
pub use histogram::Histogram;
pub use inverted_chi_squared::InvertedChiSquared;
pub use lognormal::LogNormal;
pub use sample::Sample;
pub use truncated_gaussian::TruncatedGaussian;
pub use uniform::Uniform;
pub use weibull::Weibull;

use serde::Deserialize;
use std::fmt::Debug;
use std::path::{Path, PathBuf};

/// Generator of the random heights: small, fast, and the same on every machine.
pub type Random = rand::rngs::Xoshiro256PlusPlus;

/// Distribution of the heights z of the summits, in metres above the plane from
/// which separations are measured.
///
/// Densities have one maximum, or say otherwise in [`ln_peak`](Heights::ln_peak) and
/// [`step_between`](Heights::step_between): quadrature looks for their weight there.
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
        vector_exp::exp(heights);
    }
    /// Lowest and highest summit, m.
    fn support(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }
    /// Standard deviation of the heights, m: the step of searches.
    fn standard_deviation(&self) -> f64;
    /// A random height, m.
    fn draw(&self, random: &mut Random) -> f64;
    /// The heights themselves where they are a finite measured set, m.
    fn measured(&self) -> Option<&[f64]> {
        None
    }
}

/// Section `heights` of the surface file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeightsKeys {
    /// Name of the distribution, one of [`DISTRIBUTIONS`].
    pub distribution: String,
    /// Standard deviation of the heights, m.
    pub std: Option<f64>,
    /// Shape parameter or degrees of freedom, 1.
    pub shape: Option<f64>,
    /// Lowest height, m.
    pub lower: Option<f64>,
    /// Highest height, m.
    pub upper: Option<f64>,
    /// File of measured heights, or of the bins of a histogram.
    pub file: Option<PathBuf>,
}

/// A value of the section `heights` that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key}{}: {allowed}", .value.as_ref().map(|value| format!(" = {value}")).unwrap_or_default())]
pub struct HeightsError {
    /// Key within the section.
    pub key: &'static str,
    /// Value given, if any.
    pub value: Option<String>,
    /// What is allowed there.
    pub allowed: String,
}

/// A distribution, or what is wrong with its keys.
pub type Built = Result<Box<dyn Heights>, HeightsError>;

/// How one distribution is called and built.
pub struct Entry {
    /// Name in the surface file.
    pub name: &'static str,
    /// Keys it needs, all of them.
    pub keys: &'static [&'static str],
    build: fn(&HeightsKeys, &Path) -> Built,
}

/// Every distribution that a surface file can ask for.
pub const DISTRIBUTIONS: &[Entry] = &[
    Entry {
        name: "gaussian",
        keys: &["std"],
        build: |keys, _| Ok(Box::new(Gaussian::new(positive("std", keys.std)?))),
    },
    Entry {
        name: "exponential",
        keys: &["std"],
        build: |keys, _| Ok(Box::new(Exponential::new(positive("std", keys.std)?))),
    },
    Entry {
        name: "uniform",
        keys: &["std"],
        build: |keys, _| Ok(Box::new(Uniform::new(positive("std", keys.std)?))),
    },
    Entry {
        name: "truncated-gaussian",
        keys: &["std", "lower", "upper"],
        build: |keys, _| {
            let parent = positive("std", keys.std)?;
            let (lower, upper) = (keys.lower.unwrap_or(f64::NAN), keys.upper.unwrap_or(f64::NAN));
            match TruncatedGaussian::new(parent, lower, upper) {
                Some(heights) => Ok(Box::new(heights)),
                None => Err(HeightsError {
                    key: "upper",
                    value: Some(format!("{upper:e}")),
                    allowed: format!(
                        "must be finite and above lower = {lower:e} m, with more than 1e-12 of the parent's summits in between"
                    ),
                }),
            }
        },
    },
    Entry {
        name: "weibull",
        keys: &["std", "shape"],
        build: |keys, _| {
            let shape = within("shape", keys.shape, 1.0, 50.0)?;
            Ok(Box::new(Weibull::new(positive("std", keys.std)?, shape)))
        },
    },
    Entry {
        name: "lognormal",
        keys: &["std", "shape"],
        build: |keys, _| {
            let shape = within("shape", keys.shape, 1e-3, 2.0)?;
            Ok(Box::new(LogNormal::new(positive("std", keys.std)?, shape)))
        },
    },
    Entry {
        name: "inverted-chi-squared",
        keys: &["std", "shape"],
        build: |keys, _| {
            let degrees = within("shape", keys.shape, 4.0, 1000.0)?;
            Ok(Box::new(InvertedChiSquared::new(positive("std", keys.std)?, degrees)))
        },
    },
    Entry {
        name: "sample",
        keys: &["file"],
        build: |keys, folder| {
            let file = folder.join(keys.file.clone().unwrap_or_default());
            Ok(Box::new(Sample::read(&file)?))
        },
    },
    Entry {
        name: "histogram",
        keys: &["file"],
        build: |keys, folder| {
            let file = folder.join(keys.file.clone().unwrap_or_default());
            Ok(Box::new(Histogram::read(&file)?))
        },
    },
];

/// Builds the distribution that the keys describe; a relative `file` is looked
/// for in `folder`.
///
/// ```
/// use roughsurface::surface::heights::{HeightsKeys, build};
///
/// let keys = HeightsKeys { distribution: "weibull".into(), std: Some(1e-6), shape: Some(10.0), ..Default::default() };
/// let heights = build(&keys, ".".as_ref())?;
/// assert_eq!(heights.standard_deviation(), 1e-6);
/// # Ok::<(), roughsurface::surface::heights::HeightsError>(())
/// ```
pub fn build(keys: &HeightsKeys, folder: &Path) -> Built {
    let names: Vec<&str> = DISTRIBUTIONS.iter().map(|entry| entry.name).collect();
    let Some(entry) = DISTRIBUTIONS.iter().find(|entry| entry.name == keys.distribution) else {
        let nearest = crate::surface::file::nearest(&keys.distribution, &names)
            .map(|name| format!(" (did you mean \"{name}\"?)"))
            .unwrap_or_default();
        return Err(HeightsError {
            key: "distribution",
            value: Some(format!("\"{}\"", keys.distribution)),
            allowed: format!("must be one of {}{nearest}", names.join(", ")),
        });
    };
    let given = [
        ("std", keys.std.is_some()),
        ("shape", keys.shape.is_some()),
        ("lower", keys.lower.is_some()),
        ("upper", keys.upper.is_some()),
        ("file", keys.file.is_some()),
    ];
    for (key, is_given) in given {
        let wanted = entry.keys.contains(&key);
        if is_given != wanted {
            let what = if wanted { "is missing" } else { "has no meaning here" };
            return Err(HeightsError {
                key,
                value: None,
                allowed: format!("{what}; the {} distribution takes {}", entry.name, entry.keys.join(", ")),
            });
        }
    }
    (entry.build)(keys, folder)
}

fn positive(key: &'static str, value: Option<f64>) -> Result<f64, HeightsError> {
    match value {
        Some(value) if value > 0.0 && value.is_finite() => Ok(value),
        other => Err(HeightsError {
            key,
            value: other.map(|value| format!("{value:e}")),
            allowed: "must be a positive length in metres".into(),
        }),
    }
}

fn within(key: &'static str, value: Option<f64>, from: f64, to: f64) -> Result<f64, HeightsError> {
    match value {
        Some(value) if (from..=to).contains(&value) => Ok(value),
        other => Err(HeightsError {
            key,
            value: other.map(|value| value.to_string()),
            allowed: format!("must lie between {from} and {to}"),
        }),
    }
}

#[cfg(test)]
mod tests;
