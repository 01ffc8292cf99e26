//! Schema of tables: kind and version of a file, and the checksum of its content.
//!
//! The checksum is the SHA-256 of all that a reader relies on: coordinates, numbers with their
//! errors, histories, states, warnings, and the constants and the request that they hold for.
//! Title, history, comment and the shear fracture energy with the ratio to it are not covered: other programs may change
//! them.

use sha2::{Digest, Sha256};

use crate::netcdf::{DatasetError, DatasetReader, DatasetWriter};
use crate::quantity::Quantity;
use crate::table::{ATTRIBUTES, Cell, Group, Metadata, Slice, Status, Table};

/// Kind of file, in the attribute `schema`.
pub const SCHEMA: &str = "asperity-table";

/// Version of the schema of a table of one initial temperature. A change by which a program for this version would misread
/// tables needs a new number.
pub const SCHEMA_VERSION: i32 = 1;

/// Version of the schema of a table of several initial temperatures.
pub const TEMPERATURES_VERSION: i32 = 2;

const CHECKSUM: &str = "checksum";
const ALGORITHM: &str = "sha256:";

/// Names kind, version and checksum in a file that is being written.
pub(super) fn stamp(file: &mut DatasetWriter, table: &Table) -> Result<(), DatasetError> {
    file.attribute("schema", SCHEMA)?;
    file.attribute("schema_version", table.schema_version())?;
    file.attribute(CHECKSUM, table.checksum())
}

/// Refuses files that are no tables, or tables of another version; whether it has a dimension `temperature`.
pub(super) fn has_temperatures(file: &DatasetReader) -> Result<bool, DatasetError> {
    match file.optional_text("schema")?.as_deref() {
        Some(SCHEMA) => {}
        Some(other) => {
            let what = format!("is of the kind \"{other}\", not a table (\"{SCHEMA}\")");
            return Err(file.content(what));
        }
        None => {
            let title =
                file.optional_text("title")?.map(|title| format!(" but \"{title}\"")).unwrap_or_default();
            let what = "global attribute \"schema\" is missing (a table is written by `asperity tabulate`)";
            return Err(file.content(format!("is not a table{title}: {what}")));
        }
    }
    let version = file.attribute_real("schema_version")?;
    let known = [SCHEMA_VERSION, TEMPERATURES_VERSION].map(f64::from);
    if !known.contains(&version) {
        let what = format!(
            "is a table of schema version {version}, this program reads versions {SCHEMA_VERSION} and \
             {TEMPERATURES_VERSION}; make it anew with `asperity tabulate`"
        );
        return Err(file.content(what));
    }
    Ok(version == known[1])
}

/// Compares what was read with the checksum in its file.
pub(super) fn check_content(file: &DatasetReader, table: &Table) -> Result<(), DatasetError> {
    let (stored, found) = (file.attribute_text(CHECKSUM)?, table.checksum());
    if stored == found {
        return Ok(());
    }
    let what = format!(
        "content does not agree with its checksum: damaged, or changed since it was written \
         (stored {stored}, found {found})"
    );
    Err(file.content(what))
}

impl Slice {
    /// Whether the file of the table has a scalar: an optional scalar is left out where it is known in no cell.
    pub fn holds(&self, quantity: Quantity) -> bool {
        let known = |(i, j)| self.cell(i, j).is_some_and(|cell| !cell[quantity].value.is_nan());
        !quantity.descriptor().optional || self.grid().any(known)
    }

    /// Checksum of all of the slice that a reader relies on.
    pub fn checksum(&self) -> String {
        let mut content = Content(Sha256::new());
        content.metadata(self.metadata());
        let axes = self.axes();
        for axis in [&axes.interference, &axes.slip_rate, &axes.slip] {
            content.reals(axis);
        }
        let held: Vec<Quantity> = Quantity::SCALARS.into_iter().filter(|q| self.holds(*q)).collect();
        for (i, j) in self.grid() {
            match self.status(i, j) {
                Status::Done(cell) => content.cell(cell, &held),
                Status::NotRun => content.text("not run"),
                Status::Failed(reason) => {
                    content.text("failed");
                    content.text(reason);
                }
            }
        }
        content.finish()
    }
}

impl Table {
    /// Checksum of all of the table that a reader relies on, as in the attribute `checksum`: of one slice that of the slice,
    /// of several that of the checksums of the slices, which cover their temperatures, and of the constants between these.
    pub fn checksum(&self) -> String {
        if let [only] = self.slices() {
            return only.checksum();
        }
        let mut content = Content(Sha256::new());
        self.slices().iter().for_each(|slice| content.text(&slice.checksum()));
        if let Some(constants) = &self.constants {
            content.reals(&constants.temperature);
            constants.values.values().for_each(|values| content.reals(values));
        }
        content.finish()
    }

    /// Version of the schema of its file.
    pub fn schema_version(&self) -> i32 {
        if self.slices().len() > 1 { TEMPERATURES_VERSION } else { SCHEMA_VERSION }
    }
}

/// Lengths go before texts and lists, so that the division into items is covered as well.
struct Content(Sha256);

impl Content {
    fn finish(self) -> String {
        format!("{ALGORITHM}{:x}", self.0.finalize())
    }

    fn real(&mut self, value: f64) {
        // One bit pattern for all NaN: a file does not store their payload.
        let value = if value.is_nan() { f64::NAN } else { value };
        self.0.update(value.to_bits().to_le_bytes());
    }

    fn reals(&mut self, values: &[f64]) {
        self.0.update((values.len() as u64).to_le_bytes());
        values.iter().for_each(|value| self.real(*value));
    }

    fn text(&mut self, text: &str) {
        self.0.update((text.len() as u64).to_le_bytes());
        self.0.update(text);
    }

    fn metadata(&mut self, metadata: &Metadata) {
        for text in [&metadata.source, &metadata.fingerprint, &metadata.shard, &metadata.scene] {
            self.text(text);
        }
        // No text states a rigid and isothermal counterface.
        if !metadata.counterface.is_empty() {
            self.text(&metadata.counterface);
        }
        for group in [Group::Table, Group::Film, Group::RateLaw, Group::Press] {
            let of_group = ATTRIBUTES.iter().filter(|attribute| attribute.group == group);
            let values: Vec<Option<f64>> = of_group.map(|attribute| (attribute.get)(metadata)).collect();
            if values[0].is_some() {
                self.reals(&values.iter().map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<f64>>());
            }
        }
    }

    fn cell(&mut self, cell: &Cell, held: &[Quantity]) {
        self.text("done");
        for quantity in held {
            self.real(cell[*quantity].value);
            self.real(cell[*quantity].error);
        }
        for quantity in Quantity::TABLE_HISTORIES {
            self.reals(cell.history(quantity));
        }
        self.real(f64::from(u8::from(cell.steady)));
        self.real(cell.wall_time);
        self.text(&cell.warnings.join("\n"));
    }
}
