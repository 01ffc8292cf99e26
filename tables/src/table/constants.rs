//! Constants of the material over the initial temperature.

use std::collections::BTreeMap;

use super::{Attribute, Metadata};

/// The numbers of the metadata that change with the initial temperature, at temperatures closer than those of a table.
///
/// The response of an asperity in units of yield strength and contact modulus changes little with the temperature. These
/// constants, which may have kinks, need not be interpolated between the temperatures of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constants {
    /// K, rising.
    pub temperature: Vec<f64>,
    /// By the name of the attribute, in SI units.
    pub(crate) values: BTreeMap<&'static str, Vec<f64>>,
}

impl Constants {
    /// From metadata of one material at rising initial temperatures.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a Metadata>) -> Self {
        let mut constants = Self::default();
        for row in rows {
            constants.temperature.push(row.temperature);
            for attribute in Attribute::changing(row) {
                let value = (attribute.get)(row).unwrap_or(f64::NAN);
                constants.values.entry(attribute.name).or_default().push(value);
            }
        }
        constants
    }
}
