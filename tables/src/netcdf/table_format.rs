//! Names of dimensions and attributes in the file of a table.

use crate::table::Metadata;

/// A table of one temperature lacks the first; only histories have the last.
pub(super) const DIMENSIONS: [&str; 4] = ["temperature", "interference", "slip_rate", "slip"];
/// Initial temperatures of the constants of the material.
pub(super) const MATERIAL_TEMPERATURE: &str = "material_temperature";
/// G_IIc = coefficient·aⁿ in J m-2, contact radius a in m.
pub(super) const FRACTURE_ENERGY: &str = "fracture_energy_coefficient";
pub(super) const FRACTURE_EXPONENT: &str = "fracture_energy_radius_exponent";
/// Names of the states of a cell by [`code`](crate::table::Status::code).
pub(super) const STATUS_MEANINGS: [&str; 3] = ["done", "not_run", "failed"];

/// A text of the metadata as a global attribute; the title is written by the dataset itself.
pub(super) type TextAttribute = (&'static str, fn(&mut Metadata) -> &mut String);

pub(super) const TEXT_ATTRIBUTES: [TextAttribute; 8] = [
    ("title", |m| &mut m.title),
    ("history", |m| &mut m.history),
    ("source", |m| &mut m.source),
    ("fingerprint", |m| &mut m.fingerprint),
    ("shard", |m| &mut m.shard),
    ("comment", |m| &mut m.comment),
    ("scene", |m| &mut m.scene),
    ("counterface", |m| &mut m.counterface),
];

/// Variable of a constant of the material over its own temperatures.
pub(super) fn material_name(name: &str) -> String {
    format!("material_{name}")
}

/// Variable of the history of a quantity.
pub(super) fn history_name(name: &str) -> String {
    format!("{name}_history")
}
