//! Tables at several initial temperatures of body and flat, and the table at one between them.
//!
//! Between the temperatures every number of a cell follows a monotone cubic in the temperature, of
//! the logarithm of positive quantities, of temperatures the rise above the initial one. So do the
//! points of the histories, and yield strength, contact modulus and ω_c: a load that is a power of
//! these stays one. Errors are those of the tables on both sides, interpolated linearly, and an
//! estimate of that of interpolation, which is zero at the temperatures of the series.

use std::path::Path;

use crate::assembly::{first_difference, six_digits};
use crate::dataset::DatasetError;
use crate::fracture::FractureEnergy;
use crate::interpolation::blend_one;
use crate::law::Estimate;
use crate::netcdf_file;
use crate::quantity::Quantity;
use crate::steffen::{Location, locate};
use crate::table::{Cell, Metadata, Status, Table, TableError, check_axis};

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
                    six_digits(table.metadata().temperature)
                ),
            }),
        }
    }

    /// Writes the series; the file appears whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), DatasetError> {
        netcdf_file::write(path, &self.members, true)
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
        crate::schema::checksum_of_series(&self.members)
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
            title: format!("{}, at {} K", metadata.title, six_digits(metadata.temperature)),
            comment: table.warnings().join("\n"),
            ..metadata
        });
        Ok(table)
    }

    fn between(&self, temperatures: &[f64], temperature: f64) -> Table {
        let place = locate(temperatures, temperature);
        let sides = [&self.members[place.index], &self.members[place.index + 1]];
        let of = |number: fn(&Metadata) -> f64| {
            blend(temperatures, place, |member| number(self.members[member].metadata()))
        };
        let first = self.members[0].metadata();
        let metadata = Metadata {
            temperature,
            critical_interference: of(|metadata| metadata.critical_interference),
            contact_modulus: of(|metadata| metadata.contact_modulus),
            yield_strength: of(|metadata| metadata.yield_strength),
            fracture_energy: first.fracture_energy.map(|law| FractureEnergy {
                coefficient: of(|metadata| metadata.fracture_energy.map_or(f64::NAN, |law| law.coefficient)),
                ..law
            }),
            ..first.clone()
        };
        let mut table =
            Table::new(self.members[0].axes().clone(), metadata).expect("axes of a table are axes");
        for (i, j) in table.grid() {
            if let Some((side, reason)) = sides.iter().find_map(|side| match side.status(i, j) {
                Status::Failed(reason) => Some((side, reason)),
                _ => None,
            }) {
                let own = six_digits(side.metadata().temperature);
                table.mark_failed(i, j, format!("at {own} K: {reason}"));
            } else if sides.iter().all(|side| side.cell(i, j).is_some()) {
                let cells: Vec<Option<&Cell>> = self.members.iter().map(|table| table.cell(i, j)).collect();
                let cell = Column { temperatures, cells }.at(place, temperature);
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
                    false => format!("at {} K: {warning}", six_digits(member.metadata().temperature)),
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

/// The cells of one point of the grid at all temperatures.
struct Column<'a> {
    temperatures: &'a [f64],
    cells: Vec<Option<&'a Cell>>,
}

impl Column<'_> {
    /// The cell between two that are there.
    fn at(&self, place: Location, temperature: f64) -> Cell {
        let mut cell = Cell::new();
        for quantity in Quantity::ALL {
            let base = if quantity.is_temperature() { temperature } else { 0.0 };
            let value = |member: usize| self.rise(member, quantity, |cell| cell[quantity].value);
            let [e, f] = [place.index, place.index + 1]
                .map(|member| self.cells[member].map_or(f64::NAN, |cell| cell[quantity].error));
            let found = blend(self.temperatures, place, value);
            let error = (1.0 - place.t) * e + place.t * f + self.interpolation(place, found, value);
            cell[quantity] = Estimate { value: base + found, error };
        }
        for quantity in Quantity::HISTORIES {
            let base = if quantity.is_temperature() { temperature } else { 0.0 };
            let points = self.cells[place.index].map_or(0, |cell| cell.history(quantity).len());
            let point = |k: usize| {
                let value = |member: usize| self.rise(member, quantity, |cell| cell.history(quantity)[k]);
                base + blend(self.temperatures, place, value)
            };
            cell = cell.with_history(quantity, (0..points).map(point).collect());
        }
        let sides = [self.cells[place.index], self.cells[place.index + 1]];
        cell.levelled = sides.iter().flatten().all(|side| side.levelled);
        cell.wall_time = 0.0;
        for warning in sides.iter().flatten().flat_map(|side| &side.warnings) {
            if !cell.warnings.contains(warning) {
                cell.warnings.push(warning.clone());
            }
        }
        cell
    }

    /// A number of the cell of a member; of a temperature the rise above the initial one.
    fn rise(&self, member: usize, quantity: Quantity, of: impl Fn(&Cell) -> f64) -> f64 {
        let base = if quantity.is_temperature() { self.temperatures[member] } else { 0.0 };
        self.cells[member].map_or(f64::NAN, of) - base
    }

    /// Error of interpolation of a number that was `found` at a place.
    ///
    /// Each inner temperature next to the place is left out and predicted from the others; the larger
    /// relative misfit is the error in the middle, though the gap that made it was wider. It falls to
    /// zero at both ends as a square root, since softening laws may begin with an infinite slope. What
    /// the cubic differs by from the straight line comes on top. Where nothing can be left out the error
    /// in the middle is a quarter of the difference of both sides: as far as a parabola that is level at
    /// one end departs from the straight line.
    fn interpolation(&self, place: Location, found: f64, value: impl Fn(usize) -> f64) -> f64 {
        let x = self.temperatures;
        let (one, other) = (place.index, place.index + 1);
        let misfit = |own: usize| -> Option<f64> {
            if own == 0 || own + 1 == x.len() {
                return None;
            }
            let rest: Vec<f64> = x.iter().copied().filter(|t| *t != x[own]).collect();
            let gap = x[own + 1] - x[own - 1];
            let place = Location { index: own - 1, t: (x[own] - x[own - 1]) / gap };
            let predicted = blend(&rest, place, |member| value(member + usize::from(member >= own)));
            let actual = value(own);
            let misfit = (predicted - actual).abs();
            let relative = if misfit == 0.0 { 0.0 } else { misfit / predicted.abs().max(actual.abs()) };
            relative.is_finite().then_some(relative)
        };
        let middle = match [one, other].into_iter().filter_map(misfit).reduce(f64::max) {
            Some(relative) => relative * found.abs(),
            None => 0.25 * (value(one) - value(other)).abs(),
        };
        let straight = blend(&x[one..=other], Location { index: 0, t: place.t }, |side| value(one + side));
        2.0 * (place.t * (1.0 - place.t)).sqrt() * middle + (found - straight).abs()
    }
}

/// Monotone cubic at a place on the axis `x`, through the values around it that are known.
fn blend(x: &[f64], place: Location, value: impl Fn(usize) -> f64) -> f64 {
    let Location { index, t } = place;
    let known = |member: usize| Some(value(member)).filter(|value| value.is_finite());
    let before = index.checked_sub(1).and_then(known);
    let after = (index + 2 < x.len()).then(|| known(index + 2)).flatten();
    let gaps = [before.map(|_| x[index] - x[index - 1]), after.map(|_| x[index + 2] - x[index + 1])];
    blend_one(gaps, x[index + 1] - x[index], t, [before, after], [value(index), value(index + 1)])
}

/// What a file or a request gives: one table, or one for each of several initial temperatures.
#[derive(Clone, Debug, PartialEq)]
pub enum Tables {
    One(Table),
    Series(TemperatureSeries),
}

impl Tables {
    /// Reads a file of either kind.
    pub fn read(path: &Path) -> Result<Self, DatasetError> {
        netcdf_file::read(path)
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
            Self::One(table) => std::slice::from_ref(table),
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
            Self::Series(_) => format!("{label} from {} K", six_digits(table.metadata().temperature)),
        }
    }

    /// The table at an initial temperature, K; of a series one must be given, of a single table it
    /// can only be its own.
    pub fn at(self, temperature: Option<f64>) -> Result<Table, TemperatureError> {
        match (self, temperature) {
            (Self::Series(series), Some(temperature)) => series.at(temperature),
            (Self::Series(series), None) => Err(not_chosen(&series.temperatures())),
            (Self::One(table), None) => Ok(table),
            (Self::One(table), Some(asked)) => {
                let own = table.metadata().temperature;
                match (own - asked).abs() <= SAME * own {
                    true => Ok(table),
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
