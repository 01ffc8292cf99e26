//! The surface file: TOML that describes a surface and what is asked of it.
//!
//! ```toml
//! [surface]
//! asperity_density = 1e10        # summits per nominal area, 1/m²
//! asperity_radius = 100e-6       # m
//! heights = { distribution = "gaussian", std = 0.5e-6 }
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
    asperity_radius: f64,
    heights: HeightsKeys,
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
    let SurfaceKeys { asperity_density, asperity_radius, heights } = keys.surface;
    positive("surface.asperity_density", asperity_density, "1/m2")?;
    positive("surface.asperity_radius", asperity_radius, "m")?;
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
        assert_eq!(file.surface.asperity_radius, 1e-4);
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
