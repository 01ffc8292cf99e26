//! Tables in memory: axes, cells and their state, merging of parts, comparison.
//!
//! A [`Table`] is a grid over initial temperature, interference, slip rate and slip. At one initial temperature it
//! is a [`Slice`], made of [`Cell`]s: scalars with errors, and histories over the slip axis. A table of one temperature
//! is one slice.
//!
//! Depends on `quantity`, `law` and `closed_forms`. `interpolation` reads a table between its points, `netcdf` stores it.

mod attributes;
mod axes;
mod cell;
pub mod comparison;
mod constants;
pub mod fracture;
mod merge;
mod metadata;
pub mod sentences;
mod slice;

pub(crate) use attributes::{ATTRIBUTES, Attribute, Group};
pub use axes::Axes;
pub use cell::{Cell, Status};
pub use constants::Constants;
pub use fracture::FractureEnergy;
pub use merge::{LABEL_DIGITS, label};
pub use metadata::Metadata;
pub use slice::Slice;

use std::borrow::Cow;

use axes::check_axis;
use merge::first_difference;

use crate::numbers::plain;

/// Reason why parts do not form a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    #[error("axis \"{axis}\" must {rule}, but has {value} at position {position}")]
    Axis { axis: &'static str, rule: &'static str, value: f64, position: usize },
    #[error("axis \"{0}\" is empty")]
    AxisEmpty(&'static str),
    #[error("history of {quantity} has {found} values, the slip axis {expected}")]
    HistoryLength { quantity: &'static str, expected: usize, found: usize },
    #[error("the tables differ in {what}: {here} and {there}")]
    Different { what: &'static str, here: String, there: String },
    #[error("the tables have different results at interference {interference} and slip rate {slip_rate} m/s")]
    Disagree { interference: f64, slip_rate: f64 },
    #[error(transparent)]
    Temperature(#[from] TemperatureError),
}

/// Reason why there is no table at an initial temperature.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TemperatureError {
    #[error(
        "has initial temperatures from {from} to {to} K; choose one: asperity by --temperature, roughsurface by \
         query.temperature in the surface file or --set query.temperature=VALUE, Python by temperature=VALUE"
    )]
    NotChosen { from: f64, to: f64 },
    #[error("initial temperature {asked} K is outside the table, which goes from {from} to {to} K{}", of_celsius(*.asked, *.from, *.to))]
    Outside { asked: f64, from: f64, to: f64 },
    #[error(
        "is for an initial temperature of {own} K only, not {asked} K; leave the temperature out, or \
         make a table with table.temperature in its request"
    )]
    Other { asked: f64, own: f64 },
}

/// A hint where a temperature is outside a range that it is in if it is in degrees Celsius.
fn of_celsius(asked: f64, from: f64, to: f64) -> String {
    let kelvin = asked + 273.15;
    match (from..=to).contains(&kelvin) {
        true => format!("; if it is in degrees Celsius, write {}", plain(kelvin)),
        false => String::new(),
    }
}

/// Results of one asperity over initial temperature, interference and slip rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Slices by rising initial temperature, at least one.
    slices: Vec<Slice>,
    /// Constants of the material between the temperatures, if they are known there.
    pub(crate) constants: Option<Constants>,
}

impl From<Slice> for Table {
    fn from(slice: Slice) -> Self {
        Self { slices: vec![slice], constants: None }
    }
}

impl Table {
    /// Puts slices of rising initial temperature together. They must have the same axes and the same metadata but
    /// for initial temperature, yield strength, strength of a film, contact modulus, ω_c and fracture energy.
    pub fn new(slices: Vec<Slice>) -> Result<Self, TableError> {
        let table = Self { slices, constants: None };
        if table.slices.len() != 1 {
            check_axis("temperature", &table.temperatures(), true)?;
        }
        let first = &table.slices[0];
        let common = |slice: &Slice| format!("{:#?}\n{:#?}", slice.axes(), common(slice.metadata()));
        for other in &table.slices[1..] {
            let (here, there) = (common(first), common(other));
            if here != there {
                let (here, there) = first_difference(&here, &there);
                return Err(TableError::Different { what: "what they have in common", here, there });
            }
        }
        Ok(table)
    }

    /// With the constants of the material between the initial temperatures; of a table of one they are not used.
    pub fn with_constants(mut self, constants: Constants) -> Result<Self, TableError> {
        if self.slices.len() > 1 {
            check_axis("material_temperature", &constants.temperature, true)?;
            self.constants = Some(constants);
        }
        Ok(self)
    }

    /// Constants of the material over the initial temperature: those between the temperatures of the table if they are known,
    /// or those of the table.
    pub fn constants(&self) -> Cow<'_, Constants> {
        match &self.constants {
            Some(constants) => Cow::Borrowed(constants),
            None => Cow::Owned(Constants::of(self.slices.iter().map(Slice::metadata))),
        }
    }

    /// The table at each of its initial temperatures.
    pub fn slices(&self) -> &[Slice] {
        &self.slices
    }

    /// Initial temperatures of body and flat, K, rising.
    pub fn temperatures(&self) -> Vec<f64> {
        self.slices.iter().map(|slice| slice.metadata().temperature).collect()
    }

    /// The other axes.
    pub fn axes(&self) -> &Axes {
        self.slices[0].axes()
    }

    /// Origin and constants; those of the material are those at the lowest temperature.
    pub fn metadata(&self) -> &Metadata {
        self.slices[0].metadata()
    }

    /// The only slice of a table of one initial temperature.
    pub fn only(&self) -> Result<&Slice, TemperatureError> {
        match &self.slices[..] {
            [slice] => Ok(slice),
            [first, .., last] => Err(TemperatureError::NotChosen {
                from: first.metadata().temperature,
                to: last.metadata().temperature,
            }),
            [] => unreachable!("a table has at least one slice"),
        }
    }

    /// Takes the cells done in `other`, as [`Slice::merge`] does at each temperature.
    pub fn merge(&mut self, other: &Self) -> Result<(), TableError> {
        let (here, there) = (self.temperatures(), other.temperatures());
        if here.len() != there.len() {
            let [here, there] = [here, there].map(|axis| axis.len().to_string());
            return Err(TableError::Different { what: "the number of their temperatures", here, there });
        }
        if here != there && here.len() > 1 {
            let [here, there] = [here, there].map(|axis| format!("{axis:?}"));
            return Err(TableError::Different { what: "their temperatures", here, there });
        }
        let mut merged = self.slices.clone();
        for (slice, other) in merged.iter_mut().zip(&other.slices) {
            slice.merge(other)?;
        }
        self.slices = merged;
        self.summarise();
        Ok(())
    }

    /// Changes history and shard.
    pub fn set_provenance(&mut self, history: &str, shard: &str) {
        for slice in &mut self.slices {
            let metadata = slice.metadata_mut();
            (metadata.history, metadata.shard) = (history.into(), shard.into());
        }
    }

    /// Makes the comment that of all warnings.
    pub fn summarise(&mut self) {
        self.set_comment(&self.warnings().join("\n"));
    }

    /// Changes the comment.
    pub fn set_comment(&mut self, comment: &str) {
        self.slices.iter_mut().for_each(|slice| slice.metadata_mut().comment = comment.into());
    }

    /// Every warning once, with the initial temperature that it concerns unless these are all.
    pub fn warnings(&self) -> Vec<String> {
        let temperature = |slice: &Slice| Some(slice.metadata().temperature);
        let of_slices: Vec<Vec<String>> = self.slices.iter().map(Slice::warnings).collect();
        let by_slice = self.slices.iter().map(temperature).zip(of_slices.iter().map(Vec::as_slice));
        sentences::by_temperature(&by_slice.collect::<Vec<_>>())
    }

    /// Grid points that have not been run, by their coordinates.
    pub fn missing(&self) -> Vec<String> {
        let of = |slice: &Slice| -> Vec<String> {
            slice.missing().into_iter().map(|(i, j)| self.label(slice, slice.label(i, j))).collect()
        };
        self.slices.iter().flat_map(of).collect()
    }

    /// Grid points that failed, by their coordinates, and why.
    pub fn failures(&self) -> Vec<(String, &str)> {
        let of = |slice| Slice::failures(slice).map(move |(at, why)| (self.label(slice, at), why));
        self.slices.iter().flat_map(of).collect()
    }

    fn label(&self, slice: &Slice, label: String) -> String {
        match self.slices.len() {
            1 => label,
            _ => format!("{label} from {} K", plain(slice.metadata().temperature)),
        }
    }
}

/// The metadata without what changes with the initial temperature.
fn common(metadata: &Metadata) -> Metadata {
    let fracture_energy = metadata.fracture_energy.map(|law| FractureEnergy { coefficient: 0.0, ..law });
    let mut common = Metadata { temperature: 0.0, fracture_energy, ..metadata.clone() };
    Attribute::changing(metadata).for_each(|attribute| (attribute.set)(&mut common, 0.0));
    common
}

#[cfg(test)]
mod tests;
