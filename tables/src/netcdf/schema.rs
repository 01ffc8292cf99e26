//! What makes a file a table of this schema, and whether its content is as it was written.
//!
//! The checksum is the SHA-256 of all that a reader relies on: coordinates, numbers with their
//! errors, histories, states, warnings, and the constants and the request that they hold for.
//! Title, history and comment are left out, so that tools which add to them do no harm.

use sha2::{Digest, Sha256};

use crate::netcdf::{DatasetError, DatasetReader, DatasetWriter};
use crate::quantity::Quantity;
use crate::table::{Cell, Metadata, Status, Table};

/// Kind of file, in the attribute `schema`.
pub const SCHEMA: &str = "asperity-table";

/// To be raised with every change that would make an older program misread a table.
pub const SCHEMA_VERSION: i32 = 1;

/// The same of a series over initial temperatures, which a program that knows version 1 only refuses.
pub const SERIES_VERSION: i32 = 2;

const CHECKSUM: &str = "checksum";
const ALGORITHM: &str = "sha256:";

/// Names kind, version and checksum in a file that is being written.
pub(crate) fn stamp(file: &mut DatasetWriter, tables: &[Table], series: bool) -> Result<(), DatasetError> {
    file.attribute("schema", SCHEMA)?;
    file.attribute("schema_version", if series { SERIES_VERSION } else { SCHEMA_VERSION })?;
    file.attribute(CHECKSUM, checksum(tables, series))
}

fn checksum(tables: &[Table], series: bool) -> String {
    if series { checksum_of_series(tables) } else { tables[0].checksum() }
}

/// Refuses files that are no tables, or tables of another version; whether it is a series.
pub(crate) fn is_series(file: &DatasetReader) -> Result<bool, DatasetError> {
    let again = "make it anew with `asperity tabulate`";
    match file.optional_text("schema")?.as_deref() {
        Some(SCHEMA) => {}
        Some(other) => {
            let what = format!("is of the kind \"{other}\", not a table (\"{SCHEMA}\")");
            return Err(file.content(what));
        }
        None => {
            let what = format!(
                "is not a table: global attribute \"schema\" is missing (if it is a table of before \
                 schema version 1, {again})"
            );
            return Err(file.content(what));
        }
    }
    let version = file.attribute_real("schema_version")?;
    let known = [SCHEMA_VERSION, SERIES_VERSION].map(f64::from);
    if !known.contains(&version) {
        let what = format!(
            "is a table of schema version {version}, this program reads versions {SCHEMA_VERSION} and \
             {SERIES_VERSION}; {again}"
        );
        return Err(file.content(what));
    }
    Ok(version == known[1])
}

/// Compares what was read with the checksum in its file.
pub(crate) fn check_content(
    file: &DatasetReader,
    tables: &[Table],
    series: bool,
) -> Result<(), DatasetError> {
    let (stored, found) = (file.attribute_text(CHECKSUM)?, checksum(tables, series));
    if stored == found {
        return Ok(());
    }
    let what = format!(
        "content does not agree with its checksum: damaged, or changed since it was written \
         (stored {stored}, found {found})"
    );
    Err(file.content(what))
}

impl Table {
    /// Whether the table has a scalar. Those of the first minor version of the schema are always there; one
    /// that came later only if it is known in any cell: older files lack it.
    pub fn holds(&self, quantity: Quantity) -> bool {
        let known = |(i, j)| self.cell(i, j).is_some_and(|cell| !cell[quantity].value.is_nan());
        quantity.descriptor().since == 0 || self.grid().any(known)
    }

    /// Of all that a reader relies on, as in the attribute `checksum`.
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

/// Of the checksums of the members, which cover their temperatures.
pub(crate) fn checksum_of_series(members: &[Table]) -> String {
    let mut content = Content(Sha256::new());
    members.iter().for_each(|member| content.text(&member.checksum()));
    content.finish()
}

/// Lengths go before texts and lists, so that nothing can move from one to the next unseen.
struct Content(Sha256);

impl Content {
    fn finish(self) -> String {
        let digits: String = self.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{ALGORITHM}{digits}")
    }

    fn real(&mut self, value: f64) {
        // One pattern for all NaN: a file keeps only that there was one.
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
        let optional = |value: Option<f64>| value.unwrap_or(f64::NAN);
        self.reals(&[
            metadata.asperity_radius,
            metadata.critical_interference,
            metadata.contact_modulus,
            metadata.poisson_ratio,
            metadata.yield_strength,
            optional(metadata.strength_factor),
            metadata.temperature,
            metadata.heat_partition,
            metadata.gap_conductance,
            optional(metadata.interpolation_tolerance),
        ]);
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
        self.real(f64::from(u8::from(cell.levelled)));
        self.real(cell.wall_time);
        self.text(&cell.warnings.join("\n"));
    }
}
