//! Section `[table]` of a request: lists or ranges of interference, slip rate and initial temperature.

use tables::refinement::Goal;
use toml::Value;

use super::error::SceneFileError;
use super::reader::{ACCURACY, FOR_LOGARITHMS, NOT_NEGATIVE, POSITIVE, Rule, Section};
use crate::scene::Scene;

/// A grid of scenes that differ in interference and slip rate, at one or at several initial temperatures.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// All that the scenes share; its interference and slip rate are the first of the grid.
    pub template: Scene,
    /// ω₀/ω_c, rising.
    pub interferences: Vec<f64>,
    /// V, m/s, rising.
    pub slip_rates: Vec<f64>,
    /// Initial temperatures, K, rising; none for that of the template alone.
    pub temperatures: Vec<f64>,
    /// Interpolation to be reached by adding points to these, if any; not at several temperatures.
    pub goal: Option<Goal>,
}

impl Request {
    /// The scene of one cell of the grid.
    pub fn scene(&self, interference: usize, slip_rate: usize) -> Scene {
        let mut scene = self.template.clone();
        scene.loading.interference = self.interferences[interference];
        scene.loading.slip_rate = self.slip_rates[slip_rate];
        scene
    }

    /// What the scenes of each initial temperature share, the lowest first.
    pub fn templates(&self) -> Vec<Scene> {
        match self.temperatures.is_empty() {
            true => vec![self.template.clone()],
            false => self.temperatures.iter().map(|t| self.template.at_temperature(*t)).collect(),
        }
    }

    /// The same grid at one initial temperature, K.
    pub fn at_temperature(&self, temperature: f64) -> Self {
        Self { template: self.template.at_temperature(temperature), temperatures: Vec::new(), ..self.clone() }
    }
}

/// A range has at most this many points.
const MOST_POINTS: usize = 1000;

/// A grid that is to be refined may have so many cells unless `max_cells` says otherwise.
const MOST_CELLS: usize = 400;

/// What section `[table]` says.
pub(super) struct Grid {
    pub interferences: Vec<f64>,
    pub slip_rates: Vec<f64>,
    pub temperatures: Vec<f64>,
    pub goal: Option<Goal>,
}

/// Section `[table]`.
pub(super) fn table(root: &mut Section<'_>) -> Result<Grid, SceneFileError> {
    let known = ["interference", "slip_rate", "temperature", "tolerance", "max_cells"];
    let mut section = root.take_section("table", &known)?;
    let interferences = points(&mut section, "interference", "omega_0/omega_c", POSITIVE, LOGARITHMIC)?;
    let slip_rates = points(&mut section, "slip_rate", "m/s", NOT_NEGATIVE, LOGARITHMIC)?;
    let temperatures = temperatures(&mut section)?;
    let cells = interferences.len() * slip_rates.len();
    let refined = section.has("tolerance");
    if !temperatures.is_empty()
        && let Some(value) = section.take("tolerance")
    {
        let allowed = "left out where table.temperature is given: points are added to a table of one \
                       initial temperature only";
        return Err(section.invalid("tolerance", value, allowed));
    }
    if !refined && let Some(value) = section.take("max_cells") {
        return Err(section.invalid("max_cells", value, "left out unless tolerance is given"));
    }
    let goal = match refined {
        false => None,
        true => Some(Goal {
            tolerance: section.number("tolerance", "1", ACCURACY, None)?,
            most_cells: (section.count("max_cells", (cells, MOST_POINTS * MOST_POINTS, 1))?)
                .unwrap_or(MOST_CELLS.max(cells)),
        }),
    };
    Ok(Grid { interferences, slip_rates, temperatures, goal })
}

/// Initial temperatures, K; none unless there is such a key.
fn temperatures(section: &mut Section<'_>) -> Result<Vec<f64>, SceneFileError> {
    if !section.has("temperature") {
        return Ok(Vec::new());
    }
    let temperatures = points(section, "temperature", "K", POSITIVE, !LOGARITHMIC)?;
    match temperatures[..] {
        [only] => {
            let allowed = "two or more temperatures; a single one is loading.temperature";
            Err(section.invalid("temperature", format!("{only:?}"), allowed))
        }
        _ => Ok(temperatures),
    }
}

/// Spacing of a range that does not say it.
const LOGARITHMIC: bool = true;

/// A number, a rising list or a range.
fn points(
    section: &mut Section<'_>,
    key: &str,
    unit: &str,
    rule: Rule,
    logarithmic: bool,
) -> Result<Vec<f64>, SceneFileError> {
    match section.take(key) {
        Some(Value::Table(range)) => {
            let known = ["from", "to", "points", "spacing"];
            let range = Section::new(section.full(key), range, &known, section.origin())?;
            self::range(range, unit, rule, logarithmic)
        }
        Some(value) => {
            let list = match value {
                Value::Array(_) => value,
                number => Value::Array(vec![number]),
            };
            let table = [(key.to_owned(), list)].into_iter().collect();
            let path = section.full("");
            let path = path.trim_end_matches('.');
            Section::new(path, table, &[key], section.origin())?.rising(key, unit, rule)
        }
        None => Err(section.missing(
            key,
            format!(
                "a list such as [1, 10] or a range such as \
                 {{ from = 1, to = 100, points = 8, spacing = \"log\" }} ({unit})"
            ),
        )),
    }
}

fn range(
    mut range: Section<'_>,
    unit: &str,
    rule: Rule,
    logarithmic: bool,
) -> Result<Vec<f64>, SceneFileError> {
    let logarithmic = range.choice("spacing", &[("log", true), ("linear", false)], Some(logarithmic))?;
    let rule = if logarithmic { FOR_LOGARITHMS } else { rule };
    let from = range.number("from", unit, rule, None)?;
    let to = range.number("to", unit, rule, None)?;
    if to <= from {
        return Err(range.invalid("to", format!("{to:?}"), format!("above from = {from:?}")));
    }
    let Some(count) = range.count("points", (2, MOST_POINTS, 1))? else {
        return Err(range.missing("points", format!("a whole number from 2 to {MOST_POINTS}")));
    };
    Ok((0..count)
        .map(|i| match i as f64 / (count - 1) as f64 {
            // The ends exactly as given.
            0.0 => from,
            1.0 => to,
            share if logarithmic => from * (to / from).powf(share),
            share => from + (to - from) * share,
        })
        .collect())
}
