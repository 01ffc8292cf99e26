//! The section `heights` of a surface file: every distribution by name, with the keys that it takes.

use super::distribution::Heights;
use super::empirical::Empirical;
use super::exponential::Exponential;
use super::gaussian::Gaussian;
use super::histogram::Histogram;
use super::inverted_chi_squared::InvertedChiSquared;
use super::lognormal::LogNormal;
use super::truncated_gaussian::TruncatedGaussian;
use super::uniform::Uniform;
use super::weibull::Weibull;
use crate::surface::messages::allowed;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use tables::quantity::nearest;

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

/// A distribution, or the error in its keys.
pub type Built = Result<Box<dyn Heights>, String>;

/// Name, keys and constructor of a distribution.
pub struct Entry {
    /// Name in the surface file.
    pub name: &'static str,
    /// Keys it needs, all of them.
    pub keys: &'static [&'static str],
    build: fn(&HeightsKeys, &Path) -> Built,
}

/// Every distribution of a surface file.
pub const DISTRIBUTIONS: &[Entry] = &[
    Entry { name: "gaussian", keys: &["std"], build: |keys, _| Ok(Box::new(Gaussian::new(std(keys)?))) },
    Entry {
        name: "exponential",
        keys: &["std"],
        build: |keys, _| Ok(Box::new(Exponential::new(std(keys)?))),
    },
    Entry { name: "uniform", keys: &["std"], build: |keys, _| Ok(Box::new(Uniform::new(std(keys)?))) },
    Entry { name: "truncated-gaussian", keys: &["std", "lower", "upper"], build: truncated_gaussian },
    Entry {
        name: "weibull",
        keys: &["std", "shape"],
        build: |keys, _| Ok(Box::new(Weibull::new(std(keys)?, shape(keys, 1.0, 50.0)?))),
    },
    Entry {
        name: "lognormal",
        keys: &["std", "shape"],
        build: |keys, _| Ok(Box::new(LogNormal::new(std(keys)?, shape(keys, 1e-3, 2.0)?))),
    },
    Entry {
        name: "inverted-chi-squared",
        keys: &["std", "shape"],
        build: |keys, _| Ok(Box::new(InvertedChiSquared::new(std(keys)?, shape(keys, 4.0, 1000.0)?))),
    },
    Entry {
        name: "sample",
        keys: &["file"],
        build: |keys, folder| Ok(Box::new(Empirical::read(&file(keys, folder))?)),
    },
    Entry {
        name: "histogram",
        keys: &["file"],
        build: |keys, folder| Ok(Box::new(Histogram::read(&file(keys, folder))?)),
    },
];

fn file(keys: &HeightsKeys, folder: &Path) -> PathBuf {
    folder.join(keys.file.clone().unwrap_or_default())
}

fn truncated_gaussian(keys: &HeightsKeys, _folder: &Path) -> Built {
    let parent = std(keys)?;
    let (lower, upper) = (keys.lower.unwrap_or(f64::NAN), keys.upper.unwrap_or(f64::NAN));
    match TruncatedGaussian::new(parent, lower, upper) {
        Some(heights) => Ok(Box::new(heights)),
        None => {
            let rule = format!(
                "must be finite and above lower = {lower:e} m, with more than 1e-12 of the parent's summits in between"
            );
            Err(allowed("upper", format!("{upper:e}"), &rule))
        }
    }
}

/// Builds the distribution that the keys describe; a relative `file` is looked
/// for in `folder`.
pub fn build(keys: &HeightsKeys, folder: &Path) -> Built {
    let names: Vec<&str> = DISTRIBUTIONS.iter().map(|entry| entry.name).collect();
    let Some(entry) = DISTRIBUTIONS.iter().find(|entry| entry.name == keys.distribution) else {
        let nearest = nearest(&keys.distribution, &names)
            .map(|name| format!(" (did you mean \"{name}\"?)"))
            .unwrap_or_default();
        let rule = format!("must be one of {}{nearest}", names.join(", "));
        return Err(allowed("distribution", format!("\"{}\"", keys.distribution), &rule));
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
            let all = entry.keys.join(", ");
            return Err(format!("{key}: {what}; the {} distribution takes {all}", entry.name));
        }
    }
    (entry.build)(keys, folder)
}

fn std(keys: &HeightsKeys) -> Result<f64, String> {
    let std = keys.std.unwrap_or(f64::NAN);
    match std > 0.0 && std.is_finite() {
        true => Ok(std),
        false => Err(allowed("std", format!("{std:e}"), "must be a positive length in metres")),
    }
}

fn shape(keys: &HeightsKeys, from: f64, to: f64) -> Result<f64, String> {
    let shape = keys.shape.unwrap_or(f64::NAN);
    match (from..=to).contains(&shape) {
        true => Ok(shape),
        false => Err(allowed("shape", shape, &format!("must lie between {from} and {to}"))),
    }
}
