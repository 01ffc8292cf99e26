//! The surface file: TOML that describes a surface and what is asked of it.
//!
//! ```toml
//! [surface]
//! asperity_density = 1e10        # summits per nominal area, 1/m²
//! asperity_radius = 100e-6       # m
//! heights = { distribution = "gaussian", std = 0.5e-6 }
//! radii = { distribution = "lognormal", std = 30e-6 }    # optional: asperity_radius is their mean;
//!                                # or { distribution = "classes", radius = [..], share = [..] }
//!
//! [query]
//! pressure = [1e5, 1e6, 1e7]     # nominal, Pa; or separation = [..] in m
//! slip_rate = [0.1, 1.0, 10.0]   # m/s
//! hold = "load"                  # or "separation"
//!
//! [material]                     # for closed forms only
//! youngs_modulus = 200e9         # Pa
//! poisson_ratio = 0.3
//! yield_strength = 400e6         # Pa
//! ```

use crate::heights::{self, HeightsKeys};
use crate::query::{Hold, Pressing, Query, Surface};
use crate::radii::{LARGEST_VARIATION, Radii};
use serde::Deserialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use tables::closed_forms::ElasticPlastic;

/// A surface file that has been read and checked.
#[derive(Debug)]
pub struct SurfaceFile {
    pub surface: Surface,
    pub query: Query,
    /// Needed by closed forms only.
    pub material: Option<ElasticPlastic>,
    /// The text of the file, kept with the results.
    pub text: String,
}

/// What is wrong with a surface file, in one line.
#[derive(Debug, thiserror::Error)]
pub enum SurfaceFileError {
    #[error("{}: cannot be read: {reason}", .file.display())]
    Unreadable { file: PathBuf, reason: String },
    #[error("{}{}: {what}", .file.display(), .line.map(|line| format!(":{line}")).unwrap_or_default())]
    Content { file: PathBuf, line: Option<usize>, what: String },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileKeys {
    surface: SurfaceKeys,
    query: QueryKeys,
    material: Option<ElasticPlastic>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceKeys {
    asperity_density: f64,
    asperity_radius: Option<f64>,
    radii: Option<RadiiKeys>,
    heights: HeightsKeys,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RadiiKeys {
    distribution: RadiiDistribution,
    std: Option<f64>,
    radius: Option<Vec<f64>>,
    share: Option<Vec<f64>>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum RadiiDistribution {
    LogNormal,
    Classes,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QueryKeys {
    pressure: Option<Vec<f64>>,
    separation: Option<Vec<f64>>,
    slip_rate: Vec<f64>,
    #[serde(default = "held_load")]
    hold: Hold,
}

fn held_load() -> Hold {
    Hold::Load
}

impl SurfaceFile {
    /// Reads and checks a surface file.
    pub fn read(file: &Path) -> Result<Self, SurfaceFileError> {
        let text = std::fs::read_to_string(file).map_err(|reason| SurfaceFileError::Unreadable {
            file: file.to_path_buf(),
            reason: reason.to_string(),
        })?;
        Self::parse(file, text)
    }

    /// Checks the `text` of a surface file; `file` is named in errors, and measured
    /// heights are looked for beside it.
    pub fn parse(file: &Path, text: String) -> Result<Self, SurfaceFileError> {
        let content = |line: Option<usize>, what: String| SurfaceFileError::Content {
            file: file.to_path_buf(),
            line,
            what,
        };
        let line_of = |span: Option<std::ops::Range<usize>>| {
            span.map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count())
        };
        let deserializer = toml::Deserializer::parse(&text)
            .map_err(|error| content(line_of(error.span()), one_line(error.message())))?;
        let keys: FileKeys = serde_path_to_error::deserialize(deserializer).map_err(|error| {
            let inner = error.inner();
            let what = explain(&error.path().to_string(), inner.message());
            content(line_of(inner.span()), what)
        })?;
        let folder = file.parent().unwrap_or(Path::new("."));
        build(keys, folder, &text).map_err(|what| content(None, what))
    }
}

fn build(keys: FileKeys, folder: &Path, text: &str) -> Result<SurfaceFile, String> {
    let SurfaceKeys { asperity_density, asperity_radius, radii, heights } = keys.surface;
    positive("surface.asperity_density", asperity_density, "1/m2")?;
    let asperity_radius = radii_of(asperity_radius, radii)?;
    let heights = heights::build(&heights, folder).map_err(|error| format!("surface.heights.{error}"))?;

    let pressing = match (keys.query.pressure, keys.query.separation) {
        (Some(values), None) => Pressing::Pressure(list("query.pressure", values, "Pa", |p| p > 0.0)?),
        (None, Some(values)) => Pressing::Separation(list("query.separation", values, "m", |_| true)?),
        (None, None) => {
            return Err("query.pressure: is missing; give pressure in Pa, or separation in m".into());
        }
        (Some(_), Some(_)) => {
            return Err("query.separation: cannot be given together with pressure".into());
        }
    };
    // Zero is the isothermal limit, which tables may have.
    let slip_rates = list("query.slip_rate", keys.query.slip_rate, "m/s", |v| v >= 0.0)?;

    if let Some(material) = &keys.material {
        positive("material.youngs_modulus", material.youngs_modulus, "Pa")?;
        positive("material.yield_strength", material.yield_strength, "Pa")?;
        let nu = material.poisson_ratio;
        if !(0.0..0.5).contains(&nu) {
            return Err(allowed("material.poisson_ratio", nu, "must be at least 0 and below 0.5"));
        }
    }
    Ok(SurfaceFile {
        surface: Surface { asperity_density, asperity_radius, heights },
        query: Query { pressing, slip_rates, hold: keys.query.hold },
        material: keys.material,
        text: text.to_string(),
    })
}

/// One radius, or the distribution that the keys describe.
fn radii_of(mean: Option<f64>, keys: Option<RadiiKeys>) -> Result<Radii, String> {
    let mean = || {
        let mean = mean.ok_or("surface.asperity_radius: is missing")?;
        positive("surface.asperity_radius", mean, "m").map(|()| mean)
    };
    let Some(RadiiKeys { distribution, std, radius, share }) = keys else {
        return Ok(Radii::from(mean()?));
    };
    let useless = |key: &str, given: bool, name: &str| match given {
        true => Err(format!("surface.radii.{key}: has no meaning for the distribution {name}")),
        false => Ok(()),
    };
    match distribution {
        RadiiDistribution::LogNormal => {
            useless("radius", radius.is_some(), "lognormal")?;
            useless("share", share.is_some(), "lognormal")?;
            let mean = mean()?;
            let std = std.ok_or("surface.radii.std: is missing")?;
            positive("surface.radii.std", std, "m")?;
            if std > LARGEST_VARIATION * mean {
                return Err(allowed(
                    "surface.radii.std",
                    format!("{std:e}"),
                    &format!("must not exceed asperity_radius = {mean:e} m"),
                ));
            }
            Ok(Radii::log_normal(mean, std))
        }
        RadiiDistribution::Classes => {
            useless("std", std.is_some(), "classes")?;
            if mean().is_ok() {
                return Err("surface.asperity_radius: follows from surface.radii.radius; leave it out".into());
            }
            let (radius, share) = (radius.unwrap_or_default(), share.unwrap_or_default());
            Radii::counted(&radius, &share).ok_or_else(|| {
                "surface.radii: radius (m) and share must be lists of as many positive numbers".into()
            })
        }
    }
}

fn allowed(key: &str, value: impl Display, rule: &str) -> String {
    format!("{key} = {value}: {rule}")
}

fn positive(key: &str, value: f64, unit: &str) -> Result<(), String> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(allowed(key, value, &format!("must be a positive number ({unit})")))
    }
}

/// A list for a coordinate of the result: ascending, each value once.
fn list(key: &str, mut values: Vec<f64>, unit: &str, rule: fn(f64) -> bool) -> Result<Vec<f64>, String> {
    if values.is_empty() {
        return Err(format!("{key}: must hold at least one value ({unit})"));
    }
    for (index, &value) in values.iter().enumerate() {
        if !value.is_finite() || !rule(value) {
            let what = if rule(-1.0) {
                "finite"
            } else if rule(0.0) {
                "finite and not negative"
            } else {
                "finite and positive"
            };
            let key = format!("{key}[{index}]");
            return Err(allowed(&key, format!("{value:e}"), &format!("must be {what} ({unit})")));
        }
    }
    values.sort_by(f64::total_cmp);
    values.dedup();
    Ok(values)
}

/// Says what serde means, with the known key nearest to an unknown one.
fn explain(path: &str, message: &str) -> String {
    let message = one_line(message);
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let parent = |key: &str| {
        let path = path.strip_suffix(key).unwrap_or(path);
        path.trim_end_matches('.').to_string()
    };
    let joined = |key: &str| match parent(key).as_str() {
        "" | "." => key.to_string(),
        section => format!("{section}.{key}"),
    };
    if message.starts_with("unknown field") && !quoted.is_empty() {
        let (unknown, known) = (quoted[0], &quoted[1..]);
        let suggestion = match nearest(unknown, known) {
            Some(near) => format!("did you mean {near}? "),
            None => String::new(),
        };
        let known = known.join(", ");
        return format!("{}: is not a key; {suggestion}known here: {known}", joined(unknown));
    }
    if message.starts_with("missing field") && !quoted.is_empty() {
        return format!("{}: is missing", joined(quoted[0]));
    }
    match path {
        "" | "." => message,
        path => format!("{path}: {message}"),
    }
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The known word nearest to a misspelt one, if near enough to suggest.
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    known
        .iter()
        .map(|candidate| {
            let likeness = strsim::normalized_damerau_levenshtein(word, candidate);
            (likeness, *candidate)
        })
        .filter(|(likeness, _)| *likeness >= 0.5)
        .max_by(|one, other| one.0.total_cmp(&other.0))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
[surface]
asperity_density = 1e10
asperity_radius = 100e-6
heights = { distribution = "gaussian", std = 0.5e-6 }
[query]
pressure = [1e7, 1e5]
slip_rate = [0.1, 1.0]
hold = "separation"
[material]
youngs_modulus = 200e9
poisson_ratio = 0.3
yield_strength = 400e6
"#;

    fn parse(text: &str) -> Result<SurfaceFile, SurfaceFileError> {
        SurfaceFile::parse(Path::new("surface.toml"), text.to_string())
    }

    fn message(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from), "{from}");
        parse(&GOOD.replace(from, to)).unwrap_err().to_string()
    }

    #[test]
    fn a_good_file_is_understood() {
        let file = parse(GOOD).unwrap();
        assert_eq!(file.query.pressing, Pressing::Pressure(vec![1e5, 1e7]));
        assert_eq!(file.query.hold, Hold::Separation);
        assert_eq!(file.surface.asperity_radius, Radii::from(1e-4));
        assert_eq!(file.material.unwrap().poisson_ratio, 0.3);
        assert_eq!(file.text, GOOD);
        let short = parse(&GOOD.replace("hold = \"separation\"", "")).unwrap();
        assert_eq!(short.query.hold, Hold::Load);
    }

    #[test]
    fn errors_are_one_line_with_file_key_value_and_rule() {
        for (from, to, expected) in [
            (
                "pressure =",
                "presure =",
                "surface.toml:7: query.presure: is not a key; did you mean pressure? known here: pressure, separation, slip_rate, hold",
            ),
            (
                "std = 0.5e-6",
                "sdt = 0.5e-6",
                "surface.toml:5: surface.heights.sdt: is not a key; did you mean std? known here: distribution, std, shape, lower, upper, file",
            ),
            (
                "poisson_ratio",
                "poison_ratio",
                "surface.toml:12: material.poison_ratio: is not a key; did you mean poisson_ratio? known here: youngs_modulus, poisson_ratio, yield_strength",
            ),
            (
                "[1e7, 1e5]",
                "[1e7, -1e5]",
                "surface.toml: query.pressure[1] = -1e5: must be finite and positive (Pa)",
            ),
            ("[0.1, 1.0]", "[]", "surface.toml: query.slip_rate: must hold at least one value (m/s)"),
            (
                "pressure = [1e7, 1e5]",
                "pressure = [1e7]\nseparation = [0.0]",
                "surface.toml: query.separation: cannot be given together with pressure",
            ),
            (
                "asperity_radius = 100e-6",
                "asperity_radius = 0.0",
                "surface.toml: surface.asperity_radius = 0: must be a positive number (m)",
            ),
            (
                "= 0.3",
                "= 0.5",
                "surface.toml: material.poisson_ratio = 0.5: must be at least 0 and below 0.5",
            ),
            (
                "\"gaussian\"",
                "\"gausian\"",
                "surface.toml: surface.heights.distribution = \"gausian\": must be one of gaussian, exponential, uniform, truncated-gaussian, weibull, lognormal, sample, histogram (did you mean \"gaussian\"?)",
            ),
        ] {
            assert_eq!(message(from, to), expected);
        }
    }

    #[test]
    fn radii_may_be_distributed() {
        let radii = |line: &str, radius: &str| {
            let line = format!("{radius}\nradii = {{ {line} }}");
            parse(&GOOD.replace("asperity_radius = 100e-6", &line)).map(|file| file.surface.asperity_radius)
        };
        let mean = "asperity_radius = 100e-6";
        let found = radii("distribution = \"lognormal\", std = 30e-6", mean).unwrap();
        assert_eq!(found, Radii::log_normal(1e-4, 3e-5));
        let classes = "distribution = \"classes\", radius = [1e-5, 2e-5], share = [1.0, 1.0]";
        assert!((radii(classes, "").unwrap().mean() - 1.5e-5).abs() < 1e-18);
        for (line, radius, expected) in [
            (classes, mean, "surface.asperity_radius: follows from"),
            ("distribution = \"lognormal\", std = 3e-4", mean, "surface.radii.std = 3e-4: must not exceed"),
            ("distribution = \"lognormal\"", mean, "surface.radii.std: is missing"),
            ("distribution = \"lognormal\", std = 3e-5", "", "surface.asperity_radius: is missing"),
            ("distribution = \"classes\", radius = [1e-5]", "", "as many positive numbers"),
            ("distribution = \"gamma\"", mean, "unknown variant"),
        ] {
            let message = radii(line, radius).unwrap_err().to_string();
            assert!(message.contains(expected) && message.lines().count() == 1, "{message}");
        }
    }

    #[test]
    fn types_syntax_and_missing_keys_are_explained() {
        let wrong_type = message("[1e7, 1e5]", "[\"many\"]");
        assert!(wrong_type.starts_with("surface.toml:7: query.pressure[0]: invalid type"), "{wrong_type}");
        let hold = message("hold = \"separation\"", "hold = \"distance\"");
        assert!(hold.starts_with("surface.toml:9: query.hold: unknown variant"), "{hold}");
        let missing = message("asperity_radius = 100e-6", "");
        assert!(missing.ends_with("surface.asperity_radius: is missing"), "{missing}");
        let syntax = message("[query]", "[query");
        assert!(syntax.starts_with("surface.toml:6: "), "{syntax}");
        assert_eq!(syntax.lines().count(), 1);
    }
}
