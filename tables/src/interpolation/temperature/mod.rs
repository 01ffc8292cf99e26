//! Tables at several initial temperatures of body and flat, and the table at one between them.
//!
//! Between the temperatures yield strength and contact modulus follow a monotone cubic in the
//! temperature. Forces, areas, lengths and energies are counted in units that are powers of the two, at
//! each temperature its own, in which they change little (of the elastic-plastic sphere without heat
//! not at all); in these units they follow a monotone cubic of the logarithm. Of temperatures it is the
//! rise above the initial one. Errors are those of the tables on both sides, interpolated linearly, and
//! an estimate of that of interpolation, which is zero at the temperatures of the series.

mod column;

use std::path::Path;

use crate::interpolation::steffen::locate;
use crate::interpolation::{blend_one, cubic};
use crate::netcdf::DatasetError;
use crate::numbers::plain;
use crate::table::first_difference;
use crate::table::fracture::FractureEnergy;
use crate::table::{Cell, Metadata, Status, Table, TableError, check_axis};
use column::{Column, Line, Units};

/// Temperatures closer than this, relatively, are the same.
const SAME: f64 = 1e-9;

/// Why there is no table at an initial temperature.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TemperatureError {
    /// The tables are several.
    #[error(
        "has initial temperatures from {from} to {to} K; choose one by --temperature, in a surface file by \
         query.temperature"
    )]
    NotChosen {
        /// The lowest, K.
        from: f64,
        /// The highest, K.
        to: f64,
    },
    /// Nothing is extrapolated.
    #[error("initial temperature {asked} K is outside the table, which goes from {from} to {to} K")]
    Outside {
        /// K.
        asked: f64,
        /// The lowest, K.
        from: f64,
        /// The highest, K.
        to: f64,
    },
    /// The table is one.
    #[error("is for an initial temperature of {own} K only, not {asked} K")]
    Other {
        /// K.
        asked: f64,
        /// Of the table, K.
        own: f64,
    },
}

/// Tables of one request at rising initial temperatures, with common axes.
#[derive(Clone, Debug, PartialEq)]
pub struct TemperatureSeries {
    members: Vec<Table>,
}

impl TemperatureSeries {
    /// Puts tables together. They must have the same axes and the same metadata but for initial
    /// temperature, yield strength, contact modulus, ω_c and fracture energy.
    pub fn new(members: Vec<Table>) -> Result<Self, TableError> {
        let series = Self { members };
        check_axis("temperature", &series.temperatures(), true)?;
        let first = &series.members[0];
        let common = |table: &Table| format!("{:#?}\n{:#?}", table.axes(), common(table.metadata()));
        for other in &series.members[1..] {
            let (here, there) = (common(first), common(other));
            if here != there {
                let (here, there) = first_difference(&here, &there);
                return Err(TableError::Different { what: "what they have in common", here, there });
            }
        }
        Ok(series)
    }

    /// Reads a series from a file that [`write`](Self::write) made.
    pub fn read(path: &Path) -> Result<Self, DatasetError> {
        match Tables::read(path)? {
            Tables::Series(series) => Ok(series),
            Tables::One(table) => Err(DatasetError::Content {
                path: path.display().to_string(),
                what: format!(
                    "is a table of one initial temperature, {} K",
                    plain(table.metadata().temperature)
                ),
            }),
        }
    }

    /// Writes the series; the file appears whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        crate::netcdf::write(path, &self.members, true)
    }

    /// The tables, of rising initial temperature.
    pub fn members(&self) -> &[Table] {
        &self.members
    }

    /// Initial temperatures, K, rising.
    pub fn temperatures(&self) -> Vec<f64> {
        self.members.iter().map(|table| table.metadata().temperature).collect()
    }

    /// Of all that a reader relies on, as in the attribute `checksum`.
    pub fn checksum(&self) -> String {
        crate::netcdf::schema::checksum_of_series(&self.members)
    }

    /// The table at an initial temperature, K: at one of the series its numbers bit for bit.
    ///
    /// A cell that a table on either side lacks has none in between, for the same reason. Title and
    /// comment are those of the temperature.
    pub fn at(&self, temperature: f64) -> Result<Table, TemperatureError> {
        let temperatures = self.temperatures();
        let same = |known: &f64| (known - temperature).abs() <= SAME * known;
        let mut table = match temperatures.iter().position(same) {
            Some(member) => self.members[member].clone(),
            None => {
                let (from, to) = (temperatures[0], temperatures[temperatures.len() - 1]);
                if !(from..=to).contains(&temperature) {
                    return Err(TemperatureError::Outside { asked: temperature, from, to });
                }
                self.between(&temperatures, temperature)
            }
        };
        let metadata = table.metadata().clone();
        table.set_metadata(Metadata {
            title: format!("{}, at {} K", metadata.title, plain(metadata.temperature)),
            comment: table.warnings().join("\n"),
            ..metadata
        });
        Ok(table)
    }

    fn between(&self, temperatures: &[f64], temperature: f64) -> Table {
        let place = locate(temperatures, temperature);
        let sides = [&self.members[place.index], &self.members[place.index + 1]];
        let known: Vec<&Metadata> = self.members.iter().map(Table::metadata).collect();
        let strength = Line::new(temperatures, place, |member| known[member].yield_strength, cubic);
        let modulus = Line::new(temperatures, place, |member| known[member].contact_modulus, cubic);
        let (strengths, moduli) = (strength.value(), modulus.value());
        // In its unit ω_c is the same at all temperatures, if it is that of one yield criterion.
        let of = |member: usize| (known[member].yield_strength / known[member].contact_modulus).powi(2);
        let critical = |member: usize| known[member].critical_interference / of(member);
        let critical = Line::new(temperatures, place, critical, blend_one).value();
        let fracture = |member: usize| known[member].fracture_energy.map_or(f64::NAN, |law| law.coefficient);
        let fracture = Line::new(temperatures, place, fracture, blend_one).value();
        let metadata = Metadata {
            temperature,
            critical_interference: critical * (strengths / moduli).powi(2),
            contact_modulus: moduli,
            yield_strength: strengths,
            fracture_energy: known[0]
                .fracture_energy
                .map(|law| FractureEnergy { coefficient: fracture, ..law }),
            ..known[0].clone()
        };
        let units = Units {
            members: known
                .iter()
                .map(|metadata| (metadata.yield_strength, metadata.contact_modulus))
                .collect(),
            here: (strengths, moduli),
            errors: (strength.error() / strengths, modulus.error() / moduli),
        };
        let mut table =
            Table::new(self.members[0].axes().clone(), metadata).expect("axes of a table are axes");
        for (i, j) in table.grid() {
            if let Some((side, reason)) = sides.iter().find_map(|side| match side.status(i, j) {
                Status::Failed(reason) => Some((side, reason)),
                _ => None,
            }) {
                let own = plain(side.metadata().temperature);
                table.mark_failed(i, j, format!("at {own} K: {reason}"));
            } else if sides.iter().all(|side| side.cell(i, j).is_some()) {
                let cells: Vec<Option<&Cell>> = self.members.iter().map(|table| table.cell(i, j)).collect();
                let cell = Column { temperatures, units: &units, cells }.at(place, temperature);
                table.set_cell(i, j, cell).expect("as long as its neighbours");
            }
        }
        table
    }

    /// Takes over what is done in `other`, as [`Table::merge`] does at each temperature.
    pub fn merge(&mut self, other: &TemperatureSeries) -> Result<(), TableError> {
        let (here, there) = (self.temperatures(), other.temperatures());
        if here != there {
            let [here, there] = [here, there].map(|axis| format!("{axis:?}"));
            return Err(TableError::Different { what: "their temperatures", here, there });
        }
        let mut merged = self.members.clone();
        for (member, other) in merged.iter_mut().zip(&other.members) {
            member.merge(other)?;
        }
        self.members = merged;
        self.summarise();
        Ok(())
    }

    /// Changes history and shard.
    pub fn set_provenance(&mut self, history: &str, shard: &str) {
        for member in &mut self.members {
            let metadata = member.metadata().clone();
            member.set_metadata(Metadata { history: history.into(), shard: shard.into(), ..metadata });
        }
    }

    /// Makes the comment of the tables that of all their warnings.
    pub fn summarise(&mut self) {
        let comment = self.warnings().join("\n");
        for member in &mut self.members {
            let metadata = member.metadata().clone();
            member.set_metadata(Metadata { comment: comment.clone(), ..metadata });
        }
    }

    /// Every warning once, with the initial temperature that it concerns unless these are all.
    pub fn warnings(&self) -> Vec<String> {
        let of_members: Vec<Vec<String>> = self.members.iter().map(Table::warnings).collect();
        let mut warnings: Vec<String> = Vec::new();
        for (member, own) in self.members.iter().zip(&of_members) {
            for warning in own {
                let text = match of_members.iter().all(|other| other.contains(warning)) {
                    true => warning.clone(),
                    false => format!("at {} K: {warning}", plain(member.metadata().temperature)),
                };
                if !warnings.contains(&text) {
                    warnings.push(text);
                }
            }
        }
        warnings
    }
}

/// The metadata without what changes with the initial temperature.
fn common(metadata: &Metadata) -> Metadata {
    Metadata {
        temperature: 0.0,
        critical_interference: 0.0,
        contact_modulus: 0.0,
        yield_strength: 0.0,
        fracture_energy: metadata.fracture_energy.map(|law| FractureEnergy { coefficient: 0.0, ..law }),
        ..metadata.clone()
    }
}

/// What a file or a request gives: one table, or one for each of several initial temperatures.
#[derive(Clone, Debug, PartialEq)]
pub enum Tables {
    One(Box<Table>),
    Series(TemperatureSeries),
}

impl Tables {
    /// Reads a file of either kind.
    pub fn read(path: &Path) -> Result<Self, DatasetError> {
        crate::netcdf::read(path)
    }

    /// Writes a file of either kind; it appears whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        match self {
            Self::One(table) => table.write(path),
            Self::Series(series) => series.write(path),
        }
    }

    /// The tables, of rising initial temperature.
    pub fn members(&self) -> &[Table] {
        match self {
            Self::One(table) => std::slice::from_ref(&**table),
            Self::Series(series) => series.members(),
        }
    }

    /// Takes over what is done in `other`, see [`Table::merge`].
    pub fn merge(&mut self, other: &Self) -> Result<(), TableError> {
        match (self, other) {
            (Self::One(table), Self::One(other)) => table.merge(other),
            (Self::Series(series), Self::Series(other)) => series.merge(other),
            (one, other) => {
                let [here, there] = [&*one, other].map(|tables| format!("{}", tables.members().len()));
                Err(TableError::Different { what: "the number of their temperatures", here, there })
            }
        }
    }

    /// Changes history and shard.
    pub fn set_provenance(&mut self, history: &str, shard: &str) {
        match self {
            Self::Series(series) => series.set_provenance(history, shard),
            Self::One(table) => {
                let metadata = table.metadata().clone();
                table.set_metadata(Metadata { history: history.into(), shard: shard.into(), ..metadata });
            }
        }
    }

    /// Grid points that have not been run, by their coordinates.
    pub fn missing(&self) -> Vec<String> {
        let of = |table: &Table| -> Vec<String> {
            table.missing().into_iter().map(|(i, j)| self.of_member(table, table.label(i, j))).collect()
        };
        self.members().iter().flat_map(of).collect()
    }

    /// Grid points that failed, by their coordinates, and why.
    pub fn failures(&self) -> Vec<(String, &str)> {
        let of = |table| Table::failures(table).map(move |(at, why)| (self.of_member(table, at), why));
        self.members().iter().flat_map(of).collect()
    }

    fn of_member(&self, table: &Table, label: String) -> String {
        match self {
            Self::One(_) => label,
            Self::Series(_) => format!("{label} from {} K", plain(table.metadata().temperature)),
        }
    }

    /// The table at an initial temperature, K; of a series one must be given, of a single table it
    /// can only be its own.
    pub fn at(self, temperature: Option<f64>) -> Result<Table, TemperatureError> {
        match (self, temperature) {
            (Self::Series(series), Some(temperature)) => series.at(temperature),
            (Self::Series(series), None) => Err(not_chosen(&series.temperatures())),
            (Self::One(table), None) => Ok(*table),
            (Self::One(table), Some(asked)) => {
                let own = table.metadata().temperature;
                match (own - asked).abs() <= SAME * own {
                    true => Ok(*table),
                    false => Err(TemperatureError::Other { asked, own }),
                }
            }
        }
    }
}

pub(crate) fn not_chosen(temperatures: &[f64]) -> TemperatureError {
    TemperatureError::NotChosen { from: temperatures[0], to: temperatures[temperatures.len() - 1] }
}

#[cfg(test)]
mod tests;
