//! Names of dimensions and attributes in the file of a table.

use crate::table::Metadata;

/// A table of one temperature lacks the first; only histories have the last.
pub(super) const DIMENSIONS: [&str; 4] = ["temperature", "interference", "slip_rate", "slip"];
/// G_IIc = coefficient·aⁿ in J m-2, contact radius a in m.
pub(super) const FRACTURE_ENERGY: &str = "fracture_energy_coefficient";
pub(super) const FRACTURE_EXPONENT: &str = "fracture_energy_radius_exponent";
/// Names of the states of a cell by [`code`](crate::table::Status::code).
pub(super) const STATUS_MEANINGS: [&str; 3] = ["done", "not_run", "failed"];

/// A number of the metadata as a global attribute, in SI units.
pub(super) type RealAttribute = (&'static str, fn(&mut Metadata) -> &mut f64);

const CRITICAL_INTERFERENCE: RealAttribute = ("critical_interference", |m| &mut m.critical_interference);
const CONTACT_MODULUS: RealAttribute = ("contact_modulus", |m| &mut m.contact_modulus);
const YIELD_STRENGTH: RealAttribute = ("yield_strength", |m| &mut m.yield_strength);

pub(super) const REAL_ATTRIBUTES: [RealAttribute; 8] = [
    ("asperity_radius", |m| &mut m.asperity_radius),
    CRITICAL_INTERFERENCE,
    CONTACT_MODULUS,
    ("poisson_ratio", |m| &mut m.poisson_ratio),
    YIELD_STRENGTH,
    ("temperature", |m| &mut m.temperature),
    ("heat_partition", |m| &mut m.heat_partition),
    ("gap_conductance", |m| &mut m.gap_conductance),
];

/// Numbers of the metadata that change with the initial temperature: at several they are variables over
/// it, in addition to the attributes, which are those of the lowest. Attribute, unit, meaning.
pub(super) const OVER_TEMPERATURE: [(RealAttribute, &str, &str); 3] = [
    (CRITICAL_INTERFERENCE, "m", "interference of first yield"),
    (CONTACT_MODULUS, "Pa", "contact modulus E/(1-nu^2) at the initial temperature"),
    (YIELD_STRENGTH, "Pa", "yield strength at the initial temperature"),
];

const FILM_STRENGTH: OptionalAttribute = ("film_strength", |m| &mut m.film_strength);
const PRESSURE_COEFFICIENT: OptionalAttribute = ("pressure_coefficient", |m| &mut m.pressure_coefficient);

/// Numbers of a film or of Coulomb's law that change with the initial temperature. A file of several temperatures may lack
/// them as variables. Attribute, unit, meaning.
pub(super) const FILM_OVER_TEMPERATURE: [(OptionalAttribute, &str, &str); 2] = [
    (FILM_STRENGTH, "Pa", "limit of the shear traction without pressure at the initial temperature"),
    (PRESSURE_COEFFICIENT, "1", "growth of that limit with the pressure at the initial temperature"),
];

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

/// A number of the metadata that need not be there.
pub(super) type OptionalAttribute = (&'static str, fn(&mut Metadata) -> &mut Option<f64>);

pub(super) const OPTIONAL_ATTRIBUTES: [OptionalAttribute; 6] = [
    ("strength_factor", |m| &mut m.strength_factor),
    FILM_STRENGTH,
    PRESSURE_COEFFICIENT,
    ("interpolation_tolerance", |m| &mut m.interpolation_tolerance),
    ("rate_coefficient", |m| &mut m.rate_coefficient),
    ("rate_reference", |m| &mut m.rate_reference),
];

/// Variable of the history of a quantity.
pub(super) fn history_name(name: &str) -> String {
    format!("{name}_history")
}
