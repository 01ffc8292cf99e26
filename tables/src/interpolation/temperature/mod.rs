//! Tables at several initial temperatures of body and flat, and the table at one between them.
//!
//! Yield strength and contact modulus between the temperatures are those of the file, or follow a monotone cubic through
//! the temperatures where it does not state them. Forces, areas, lengths and energies are counted in units that are powers of the two, at
//! each temperature its own, in which they change little (of the elastic-plastic sphere without heat
//! not at all); in these units they follow a monotone cubic of the logarithm. Of temperatures it is the
//! rise above the initial one. Errors are those of the tables on both sides, interpolated linearly, and, added
//! as a square, that of interpolation, which is zero at the temperatures of the series.
//!
//! Depends on `table`, `closed_forms` and the cubic of `steffen`. Chapter "Tables" of the book.

mod column;

use super::steffen::locate;
use super::{InterpolatedTable, blend_one, cubic};
use crate::numbers::plain;
use crate::table::{Attribute, Cell, FractureEnergy, Metadata, Slice, Table, TemperatureError};
use column::{Column, Line, Units};

/// Temperatures closer than this, relatively, are the same.
const SAME: f64 = 1e-9;

impl Table {
    /// The table at an initial temperature, K: at one of its own bit for bit. Where it has several one must be
    /// given, where it has one it can only be that.
    ///
    /// A cell that a slice on either side lacks has none in between, for the same reason. Title and
    /// comment are those of the temperature.
    pub fn at(&self, temperature: impl Into<Option<f64>>) -> Result<InterpolatedTable, TemperatureError> {
        let temperatures = self.temperatures();
        let Some(asked) = temperature.into() else {
            return Ok(self.only()?.clone().interpolated());
        };
        let same = |known: &f64| (known - asked).abs() <= SAME * known;
        let own = temperatures.iter().position(same).map(|position| self.slices()[position].clone());
        if let [only] = temperatures[..] {
            let other = TemperatureError::Other { asked, own: only };
            return own.map(Slice::interpolated).ok_or(other);
        }
        let (from, to) = (temperatures[0], temperatures[temperatures.len() - 1]);
        let mut slice = match own {
            Some(slice) => slice,
            None if (from..=to).contains(&asked) => self.between(&temperatures, asked),
            None => return Err(TemperatureError::Outside { asked, from, to }),
        };
        let comment = slice.warnings().join("\n");
        let metadata = slice.metadata_mut();
        metadata.title += &format!(", at {} K", plain(metadata.temperature));
        metadata.comment = comment;
        Ok(slice.interpolated())
    }

    fn between(&self, temperatures: &[f64], temperature: f64) -> Slice {
        let place = locate(temperatures, temperature);
        let sides = [&self.slices()[place.index], &self.slices()[place.index + 1]];
        let known: Vec<&Metadata> = self.slices().iter().map(Slice::metadata).collect();
        let constants = self.constants();
        let rows = &constants.temperature[..];
        let constant = |name: &str, row: usize| constants.values[name][row];
        let line = |name: &'static str| {
            Line::new(rows, locate(rows, temperature), move |row| constant(name, row), cubic)
        };
        let (strength, modulus) = (line("yield_strength"), line("contact_modulus"));
        let (strengths, moduli) = (strength.value(), modulus.value());
        // In its unit ω_c is the same at all temperatures, if it is that of one yield criterion.
        let of = |row: usize| (constant("yield_strength", row) / constant("contact_modulus", row)).powi(2);
        let critical = |row: usize| constant("critical_interference", row) / of(row);
        let critical = Line::new(rows, locate(rows, temperature), critical, blend_one).value();
        let fracture = |member: usize| known[member].fracture_energy.map_or(f64::NAN, |law| law.coefficient);
        let fracture = Line::new(temperatures, place, fracture, blend_one).value();
        let mut metadata = Metadata {
            temperature,
            critical_interference: critical * (strengths / moduli).powi(2),
            contact_modulus: moduli,
            yield_strength: strengths,
            fracture_energy: known[0]
                .fracture_energy
                .map(|law| FractureEnergy { coefficient: fracture, ..law }),
            ..known[0].clone()
        };
        for attribute in Attribute::changing(known[0]).filter(|attribute| !attribute.required) {
            let value = |row: usize| constant(attribute.name, row);
            let here = Line::new(rows, locate(rows, temperature), value, blend_one).value();
            (attribute.set)(&mut metadata, here);
        }
        let units = Units {
            members: known
                .iter()
                .map(|metadata| (metadata.yield_strength, metadata.contact_modulus))
                .collect(),
            here: (strengths, moduli),
            errors: (strength.error() / strengths, modulus.error() / moduli),
        };
        let mut table = Slice::new(self.axes().clone(), metadata).expect("axes of a table are axes");
        for (i, j) in table.grid() {
            let failed = sides.iter().find_map(|side| Some((side, side.status(i, j).reason()?)));
            if let Some((side, reason)) = failed {
                let own = plain(side.metadata().temperature);
                table.mark_failed(i, j, format!("at {own} K: {reason}"));
            } else if sides.iter().all(|side| side.cell(i, j).is_some()) {
                let cells: Vec<Option<&Cell>> = self.slices().iter().map(|slice| slice.cell(i, j)).collect();
                let cell = Column { temperatures, units: &units, cells }.at(place, temperature);
                table.set_cell(i, j, cell).expect("as long as its neighbours");
            }
        }
        table
    }
}

#[cfg(test)]
mod tests;
