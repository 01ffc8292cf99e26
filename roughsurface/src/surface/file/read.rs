//! Reads and checks a surface file.

use super::keys::{FileKeys, SurfaceKeys, check_nominal_size, positive, radii_of, rate_step_of};
use super::parameter::{Parameter, Uncertain};
use super::values::Values;
use crate::surface::heights;
use crate::surface::messages::{allowed, explain, short};
use crate::surface::query::{NormalLoading, Query, Surface};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tables::closed_forms::ElasticPlastic;
use tables::netcdf::input::{Override, read_text, syntax_error};

/// A surface file that has been read and checked.
#[derive(Debug)]
pub struct SurfaceFile {
    pub surface: Surface,
    pub query: Query,
    /// Initial temperature, K, at which a table of several is read.
    pub temperature: Option<f64>,
    /// Needed by closed forms only.
    pub material: Option<ElasticPlastic>,
    /// Constants of the counterface that a table must have, SI; empty for a rigid and isothermal one.
    pub counterface: Option<BTreeMap<String, f64>>,
    /// Parameters given with a standard deviation.
    pub uncertain: Vec<Uncertain>,
    /// Tables of a material of which one constant is raised by its standard deviation.
    pub uncertain_tables: Vec<(String, PathBuf)>,
    /// File of measured heights, if there is one.
    pub heights_file: Option<PathBuf>,
    /// The text of the file with the overrides, stored with the results.
    pub text: String,
    /// Keys laid over the file.
    overrides: Vec<Override>,
    /// The file itself, named in errors.
    file: PathBuf,
}

/// An error in a surface file, in one line.
#[derive(Debug, thiserror::Error)]
pub enum SurfaceFileError {
    #[error("{}: cannot be read: {reason}", .file.display())]
    Unreadable { file: PathBuf, reason: String },
    #[error("{}{}: {}", .file.display(), .line.map(|line| format!(":{line}")).unwrap_or_default(), short(.what))]
    Content { file: PathBuf, line: Option<usize>, what: String },
}

impl SurfaceFileError {
    /// The key that the error is about, as `query.pressure`, if it is about one.
    pub fn key(&self) -> Option<&str> {
        let Self::Content { what, .. } = self else { return None };
        let end = what.find([':', ' ', '[']).unwrap_or(what.len());
        what[..end].contains('.').then_some(&what[..end])
    }
}

impl SurfaceFile {
    /// Reads and checks a surface file, or the standard input for the path `-`.
    pub fn read(file: &Path) -> Result<Self, SurfaceFileError> {
        Self::read_with(file, &[])
    }

    /// Reads and checks a surface file as [`read`](Self::read) does, with `overrides` laid over its keys.
    pub fn read_with(file: &Path, overrides: &[Override]) -> Result<Self, SurfaceFileError> {
        let unreadable = |error: std::io::Error| SurfaceFileError::Unreadable {
            file: file.to_path_buf(),
            reason: error.to_string(),
        };
        Self::parse_with(file, read_text(file).map_err(unreadable)?, overrides)
    }

    /// Checks the `text` of a surface file; `file` is named in errors, and measured
    /// heights are looked for in its folder.
    pub fn parse(file: &Path, text: String) -> Result<Self, SurfaceFileError> {
        Self::parse_with(file, text, &[])
    }

    /// Checks the `text` of a surface file as [`parse`](Self::parse) does, with `overrides` laid over its keys.
    pub fn parse_with(file: &Path, text: String, overrides: &[Override]) -> Result<Self, SurfaceFileError> {
        if overrides.is_empty() {
            return Self::parse_moved(file, text, None);
        }
        // An error of the file itself is reported with its line.
        let mut sections: toml::Table = text.parse().map_err(|error: toml::de::Error| {
            content(file, line_of(&text, error.span()), syntax_error(&text, &error))
        })?;
        for change in overrides {
            let explained = |what| content(file, None, format!("{}: {what}", change.key()));
            change.lay_over(&mut sections).map_err(explained)?;
        }
        let text = toml::to_string(&sections).map_err(|error| content(file, None, error.to_string()))?;
        let parsed =
            Self::parse_moved(file, text, None).map(|file| Self { overrides: overrides.to_vec(), ..file });
        parsed.map_err(|error| match error {
            // Lines have other numbers now.
            SurfaceFileError::Content { what, .. } => {
                let given = overrides.iter().any(|change| what.starts_with(&change.key()));
                content(if given { Path::new("the command line") } else { file }, None, what)
            }
            other => other,
        })
    }

    /// The same surface, query and material with one parameter moved by `change`.
    pub fn varied(&self, parameter: &Parameter, change: f64) -> Result<Self, SurfaceFileError> {
        Self::parse_moved(&self.file, self.text.clone(), Some((parameter, change))).map_err(|error| {
            match error {
                SurfaceFileError::Content { file, line, what } => {
                    let what = format!(
                        "uncertainty.{}: with one standard deviation of {:e}, {what}",
                        parameter.key,
                        change.abs()
                    );
                    SurfaceFileError::Content { file, line, what }
                }
                other => other,
            }
        })
    }

    /// Another surface file with the same keys laid over it.
    pub fn with_text(&self, text: String) -> Result<Self, SurfaceFileError> {
        Self::parse_with(&self.file, text, &self.overrides)
    }

    fn parse_moved(
        file: &Path,
        text: String,
        moved: Option<(&Parameter, f64)>,
    ) -> Result<Self, SurfaceFileError> {
        let content = |line: Option<usize>, what: String| content(file, line, what);
        if text.trim().is_empty() {
            return Err(content(None, "is empty".into()));
        }
        let deserializer = toml::Deserializer::parse(&text)
            .map_err(|error| content(line_of(&text, error.span()), syntax_error(&text, &error)))?;
        let keys: FileKeys = serde_path_to_error::deserialize(deserializer).map_err(|error| {
            let inner = error.inner();
            match section_of_scene(&text) {
                Some(section) => content(None, format!("has [{section}]: it is a scene or a request of `asperity`, not a surface file, which has [surface] and [query]")),
                None => content(line_of(&text, inner.span()), explain(&error.path().to_string(), inner.message())),
            }
        })?;
        build(keys, moved, file, &text).map_err(|what| content(None, what))
    }
}

/// A section that scenes and requests have and surface files do not.
fn section_of_scene(text: &str) -> Option<&'static str> {
    let sections: toml::Table = text.parse().ok()?;
    ["asperity", "loading", "table"].into_iter().find(|section| sections.contains_key(*section))
}

fn content(file: &Path, line: Option<usize>, what: String) -> SurfaceFileError {
    SurfaceFileError::Content { file: file.to_path_buf(), line, what }
}

/// The line, from one, in which a span begins.
fn line_of(text: &str, span: Option<std::ops::Range<usize>>) -> Option<usize> {
    span.map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count())
}

fn build(
    mut keys: FileKeys,
    moved: Option<(&Parameter, f64)>,
    file: &Path,
    text: &str,
) -> Result<SurfaceFile, String> {
    let folder = file.parent().unwrap_or(Path::new("."));
    let uncertain_tables = keys.uncertain_tables(folder);
    let uncertain = keys.uncertain()?;
    if let Some((parameter, change)) = moved
        && let Some(value) = (parameter.value)(&mut keys)
    {
        *value += change;
    }
    let SurfaceKeys { asperity_density, asperity_radius, radii, heights } = keys.surface;
    positive("surface.asperity_density", asperity_density, "1/m2")?;
    let asperity_radius = radii_of(asperity_radius, radii)?;
    let heights_file = heights.file.as_ref().map(|name| folder.join(name));
    let heights = heights::build(&heights, folder).map_err(|error| format!("surface.heights.{error}"))?;

    let loading = match (keys.query.pressure, keys.query.separation) {
        (Some(values), None) => NormalLoading::Pressure(list("query.pressure", values, "Pa", |p| p > 0.0)?),
        (None, Some(values)) => NormalLoading::Separation(list("query.separation", values, "m", |_| true)?),
        (None, None) => {
            return Err("query.pressure: is missing; give pressure in Pa, or separation in m".into());
        }
        (Some(_), Some(_)) => {
            return Err("query.separation: cannot be given together with pressure".into());
        }
    };
    // Zero is the isothermal limit, which tables may have.
    let slip_rates = list("query.slip_rate", keys.query.slip_rate, "m/s", |v| v >= 0.0)?;

    if let Some(temperature) = keys.query.temperature {
        positive("query.temperature", temperature, "K")?;
    }
    if let Some(material) = &keys.material {
        positive("material.youngs_modulus", material.youngs_modulus, "Pa")?;
        positive("material.yield_strength", material.yield_strength, "Pa")?;
        let nu = material.poisson_ratio;
        if !(0.0..0.5).contains(&nu) {
            return Err(allowed("material.poisson_ratio", nu, "must be at least 0 and below 0.5"));
        }
    }
    check_nominal_size(keys.query.interaction, keys.query.nominal_size)?;
    Ok(SurfaceFile {
        surface: Surface { asperity_density, asperity_radius, heights },
        query: Query {
            loading,
            slip_rates,
            control: keys.query.hold,
            contact_life: keys.query.contact_life,
            interaction: keys.query.interaction,
            nominal_size: keys.query.nominal_size,
            rate_step: rate_step_of(keys.query.rate_step, keys.query.contact_life)?,
        },
        temperature: keys.query.temperature,
        material: keys.material,
        counterface: keys.counterface,
        uncertain,
        uncertain_tables,
        heights_file,
        text: text.to_string(),
        overrides: Vec::new(),
        file: file.to_path_buf(),
    })
}

/// A list for a coordinate of the result: ascending, each value once.
fn list(
    key: &str,
    Values(mut values): Values,
    unit: &str,
    rule: fn(f64) -> bool,
) -> Result<Vec<f64>, String> {
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
