//! The numbers of the metadata, which files state as global attributes and the checksum of a table covers.

use super::Metadata;

/// Numbers that the checksum covers together, if the table has the first of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Group {
    Table,
    /// Film or Coulomb's law.
    Film,
    RateLaw,
    Press,
}

/// A number of the metadata, in SI units.
pub(crate) struct Attribute {
    /// Of the attribute, and of the variable over the initial temperature.
    pub name: &'static str,
    /// Whether every table has it.
    pub required: bool,
    pub group: Group,
    /// Unit and meaning of a number that changes with the initial temperature: at several it is a variable over it, in
    /// addition to the attribute, which is that of the lowest.
    pub over_temperature: Option<(&'static str, &'static str)>,
    pub get: fn(&Metadata) -> Option<f64>,
    pub set: fn(&mut Metadata, f64),
}

macro_rules! required {
    ($field:ident) => {
        Attribute {
            name: stringify!($field),
            required: true,
            group: Group::Table,
            over_temperature: None,
            get: |metadata| Some(metadata.$field),
            set: |metadata, value| metadata.$field = value,
        }
    };
}

macro_rules! optional {
    ($field:ident, $group:ident) => {
        Attribute {
            name: stringify!($field),
            required: false,
            group: Group::$group,
            over_temperature: None,
            get: |metadata| metadata.$field,
            set: |metadata, value| metadata.$field = Some(value),
        }
    };
}

/// In the order of the checksum within a group, and of files within those that are required or not.
pub(crate) static ATTRIBUTES: [Attribute; 15] = [
    required!(asperity_radius),
    required!(critical_interference).over_temperature("m", "interference of first yield"),
    required!(contact_modulus)
        .over_temperature("Pa", "contact modulus E/(1-nu^2) at the initial temperature"),
    required!(poisson_ratio),
    required!(yield_strength).over_temperature("Pa", "yield strength at the initial temperature"),
    optional!(strength_factor, Table),
    required!(temperature),
    required!(heat_partition),
    required!(gap_conductance),
    optional!(film_strength, Film)
        .over_temperature("Pa", "limit of the shear traction without pressure at the initial temperature"),
    optional!(pressure_coefficient, Film)
        .over_temperature("1", "growth of that limit with the pressure at the initial temperature"),
    optional!(interpolation_tolerance, Table),
    optional!(rate_coefficient, RateLaw),
    optional!(rate_reference, RateLaw),
    optional!(press_slip_distance, Press),
];

impl Attribute {
    const fn over_temperature(self, unit: &'static str, meaning: &'static str) -> Self {
        Self { over_temperature: Some((unit, meaning)), ..self }
    }

    /// Numbers that change with the initial temperature, of those that this table has.
    pub fn changing(metadata: &Metadata) -> impl Iterator<Item = &'static Self> {
        ATTRIBUTES
            .iter()
            .filter(|attribute| attribute.over_temperature.is_some() && (attribute.get)(metadata).is_some())
    }
}
