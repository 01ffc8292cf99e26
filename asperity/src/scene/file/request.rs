//! Table requests: a scene with a section `[table]` of interferences, slip rates and initial temperatures.

use std::path::Path;

use serde::{Deserialize, Serialize};
use tables::numbers::Spacing;
use tables::quantity::plausible;
use tables::refinement::Goal;
use toml::{Table, Value};

use super::default_grid::{self, SLIP_RATES, SMALLEST_INTERFERENCE};
use super::deserialise::read;
use super::document::{Document, name_of, text_of};
use super::error::SceneFileError;
use super::keys::{POSITIVE, POSITIVE_FOR_LOG, Range, SLIP_RATE, TABLE, range_keys};
use super::relations;
use super::source::{Source, join};
use crate::scene::{Control, Rate, Scene};

/// Steps of the constants of the material from one initial temperature of a table to the next.
const TEMPERATURE_DIVISIONS: u32 = 32;

/// A grid of scenes that differ in interference and slip rate, at one or at several initial temperatures.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// What the scenes share; its interference and slip rate are the first of the grid.
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
    /// What the scenes of each initial temperature share, the lowest first.
    pub fn templates(&self) -> Vec<Scene> {
        match self.temperatures.is_empty() {
            true => vec![self.template.clone()],
            false => self.temperatures.iter().map(|t| self.template.at_temperature(*t)).collect(),
        }
    }

    /// Initial temperatures for the constants of the material between those of the table, with the kinks of the laws; none for
    /// one temperature.
    pub fn material_temperatures(&self) -> Option<Vec<f64>> {
        let (first, last) = (*self.temperatures.first()?, *self.temperatures.last()?);
        let inner = self.temperatures.windows(2).flat_map(|pair| {
            (0..TEMPERATURE_DIVISIONS)
                .map(move |n| pair[0] + (pair[1] - pair[0]) * f64::from(n) / f64::from(TEMPERATURE_DIVISIONS))
        });
        let kinks = self.template.kinks_over_temperature();
        let kinks = kinks.into_iter().filter(|kelvin| (first..last).contains(kelvin));
        let mut all: Vec<f64> = inner.chain(kinks).chain([last]).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        Some(all)
    }

    /// Warnings about all cells, a sentence each; see [`Scene::remarks`].
    pub fn remarks(&self) -> Vec<String> {
        let of_template = self.template.remarks_with(&document(self));
        let lowest = self.temperatures.first().map(|lowest| self.template.at_temperature(*lowest));
        let of_lowest = lowest.and_then(|scene| scene.below_reference("table.temperature"));
        let of_load = self.of_held_load();
        of_template.into_iter().chain(of_lowest).chain(of_load).collect()
    }

    fn of_held_load(&self) -> Option<String> {
        (self.template.loading.control == Control::Load).then(|| {
            "loading.control = \"load\": `roughsurface` refuses such a table, as the summits of a surface slide at constant \
             interference; for a surface write \"interference\""
                .into()
        })
    }

    /// Remarks on values that are probably in another unit.
    pub fn implausible(&self) -> Vec<String> {
        plausible::remarks(&document(self))
    }

    /// The request restricted to one initial temperature, K.
    pub fn at_temperature(&self, temperature: f64) -> Self {
        Self { template: self.template.at_temperature(temperature), temperatures: Vec::new(), ..self.clone() }
    }
}

/// Section `[table]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TableSection {
    interference: Option<Vec<f64>>,
    slip_rate: Option<Vec<f64>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    temperature: Vec<f64>,
    tolerance: Option<f64>,
    max_cells: Option<usize>,
}

/// A range in place of a list.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PointRange {
    from: f64,
    to: f64,
    points: usize,
    spacing: Spacing,
}

/// Read a table request from a file, with `overrides` (`section.key=value`) laid over it.
pub fn read_request(path: &Path, overrides: &[String]) -> Result<Request, SceneFileError> {
    parse_request(&text_of(path)?, &name_of(path), overrides)
}

/// Read a table request from text; `file` is the name to use in messages.
pub fn parse_request(text: &str, file: &str, overrides: &[String]) -> Result<Request, SceneFileError> {
    let mut document = Document::parse(text, file, overrides)?;
    let Some(Value::Table(table)) = document.sections.remove("table") else {
        let allowed = "a section, which may be empty; without it this is a scene for `asperity run`";
        return Err(document.source.missing("table", allowed));
    };
    let source = &document.source;
    let section = table_section(table, source)?;
    let mut slip_rates = section.slip_rate.clone().unwrap_or(SLIP_RATES.to_vec());
    let smallest = section.interference.as_ref().map_or(SMALLEST_INTERFERENCE, |given| given[0]);
    leave_to_grid(
        &mut document.sections,
        [("interference", smallest), ("slip_rate", slip_rates[0])],
        source,
    )?;
    let mut template = document.scene()?;
    if template.loading.slip_distance <= 0.0 || template.loading.is_until_steady() {
        let allowed = "a positive number (contact radii): a table has histories over the same slips for all cells, and mu_steady beside \
                       them";
        let found = match template.loading.is_until_steady() {
            true => "\"steady\"".to_owned(),
            false => format!("{:?}", template.loading.slip_distance),
        };
        return Err(source.invalid("loading.slip_distance", found, allowed));
    }
    relations::check_heat(&template, &slip_rates, source)?;
    if section.slip_rate.is_none() && template.material.rate != Rate::None {
        slip_rates.retain(|rate| *rate > 0.0);
        template.loading.slip_rate = slip_rates[0];
    }
    relations::check_rates(&template, &slip_rates, source)?;
    for &temperature in &section.temperature {
        relations::check_temperature(&template, "table.temperature", temperature, source)?;
    }
    let mut request = Request {
        template,
        interferences: Vec::new(),
        slip_rates,
        temperatures: section.temperature,
        goal: None,
    };
    request.interferences =
        section.interference.unwrap_or_else(|| default_grid::interferences(&request.templates()));
    let cells = request.interferences.len() * request.slip_rates.len();
    if let Some(most) = section.max_cells.filter(|most| *most < cells) {
        let allowed = format!("a whole number from {cells} to 1000000");
        return Err(source.invalid("table.max_cells", most.to_string(), allowed));
    }
    let most_cells = section.max_cells.unwrap_or(MOST_CELLS.max(cells));
    request.goal = section.tolerance.map(|tolerance| Goal { tolerance, most_cells });
    Ok(request)
}

/// Enters the first values of the grid in the section `[loading]`, which gives none of its own.
fn leave_to_grid(
    sections: &mut Table,
    first: [(&str, f64); 2],
    source: &Source,
) -> Result<(), SceneFileError> {
    let Some(Value::Table(loading)) = sections.get_mut("loading") else {
        return Ok(());
    };
    for (key, allowed) in [
        ("steps", "left out of a request: the cells of a table slide at one slip rate each"),
        (
            "load",
            "left out of a request, which has table.interference: surfaces find the loads of their contacts",
        ),
    ] {
        if let Some(value) = loading.get(key) {
            return Err(source.invalid(&join("loading", key), value, allowed));
        }
    }
    for (key, first) in first {
        if let Some(value) = loading.insert(key.to_owned(), Value::Float(first)) {
            let allowed = format!("left out of a request, which has table.{key}");
            return Err(source.invalid(&join("loading", key), value, allowed));
        }
    }
    Ok(())
}

/// A grid that is to be refined has at most this number of cells by default; `max_cells` overrides it.
const MOST_CELLS: usize = 400;

fn table_section(mut table: Table, source: &Source) -> Result<TableSection, SceneFileError> {
    for (key, unit, range, spacing) in [
        ("interference", "omega_0/omega_c", POSITIVE, Spacing::Log),
        ("slip_rate", "m/s", SLIP_RATE, Spacing::Log),
        ("temperature", "K", POSITIVE, Spacing::Linear),
    ] {
        match table.get_mut(key) {
            Some(value @ Value::Table(_)) => *value = points(value, key, (unit, range, spacing), source)?,
            Some(value @ (Value::Float(_) | Value::Integer(_))) => *value = Value::Array(vec![value.clone()]),
            _ => {}
        }
    }
    let section: TableSection = read("table", &table, TABLE, source)?;
    let refuse =
        |key: &str, allowed: &str| Err(source.invalid(&format!("table.{key}"), &table[key], allowed));
    match (&section.temperature[..], section.tolerance, section.max_cells) {
        ([_], ..) => refuse("temperature", "two or more temperatures; a single one is loading.temperature"),
        ([_, ..], Some(_), _) => refuse(
            "tolerance",
            "left out where table.temperature is given: points are added to a table of one initial temperature only",
        ),
        (_, None, Some(_)) => refuse("max_cells", "left out unless tolerance is given"),
        _ => Ok(section),
    }
}

/// The numbers of a range, for the key `key`.
fn points(
    value: &Value,
    key: &str,
    (unit, range, spacing): (&'static str, Range, Spacing),
    source: &Source,
) -> Result<Value, SceneFileError> {
    let mut table = value.as_table().cloned().unwrap_or_default();
    let default = if spacing == Spacing::Log { "log" } else { "linear" };
    let spacing = table.entry("spacing").or_insert_with(|| default.into());
    let is_log = spacing.as_str() == Some("log");
    let range = if is_log && range.accepts(0.0) { POSITIVE_FOR_LOG } else { range };
    let path = format!("table.{key}");
    let PointRange { from, to, points, spacing } = read(&path, &table, &range_keys(unit, range), source)?;
    if to <= from {
        return Err(source.invalid(
            &format!("{path}.to"),
            format!("{to:?}"),
            format!("above from = {from:?}"),
        ));
    }
    Ok(Value::Array(spacing.range(from, to, points).into_iter().map(Value::Float).collect()))
}

/// The whole request as TOML, with every default filled in; reading it gives the same request.
pub fn write_request(request: &Request) -> String {
    toml::to_string(&document(request)).expect(PLAIN)
}

const PLAIN: &str = "a request is plain data";

fn document(request: &Request) -> Table {
    let mut document = Table::try_from(&request.template).expect(PLAIN);
    if let Some(Value::Table(loading)) = document.get_mut("loading") {
        loading.remove("interference");
        loading.remove("slip_rate");
    }
    let table = TableSection {
        interference: Some(request.interferences.clone()),
        slip_rate: Some(request.slip_rates.clone()),
        temperature: request.temperatures.clone(),
        tolerance: request.goal.map(|goal| goal.tolerance),
        max_cells: request.goal.map(|goal| goal.most_cells),
    };
    document.insert("table".into(), Value::try_from(table).expect(PLAIN));
    document
}
