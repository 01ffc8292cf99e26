//! Keys given on the command line in place of those of the file.

use super::values::Values;
use crate::surface::query::{ContactLife, LoadingControl};
use std::str::FromStr;
use toml::{Table, Value};

/// A key and its value in place of that of the file, as `section.key=value`; without a value the key is left out.
///
/// The value is read as TOML; what is not TOML is taken as text, so that `query.hold=separation` needs no quotes.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    path: Vec<String>,
    value: Option<Value>,
}

impl Override {
    /// Numbers in place of those of the section `[query]`; a pressure or a separation replaces the other.
    pub fn of_query(
        pressure: Option<&Values>,
        separation: Option<&Values>,
        slip_rate: Option<&Values>,
    ) -> Vec<Self> {
        let of = |key: &str, value| Self { path: vec!["query".into(), key.into()], value };
        let list = |values: &Values| Value::Array(values.0.iter().copied().map(Value::Float).collect());
        let loadings = [("pressure", pressure, "separation"), ("separation", separation, "pressure")];
        let mut overrides = Vec::new();
        for (key, values, other) in loadings {
            if let Some(values) = values {
                overrides.extend([of(key, Some(list(values))), of(other, None)]);
            }
        }
        overrides.extend(slip_rate.map(|rates| of("slip_rate", Some(list(rates)))));
        overrides
    }

    /// The quantity held.
    pub fn hold(control: LoadingControl) -> Self {
        let value = Value::try_from(control).ok();
        Self { path: vec!["query".into(), "hold".into()], value }
    }

    /// Text or a number in place of that of a key of the section `[query]`.
    pub fn query_key(key: &str, value: impl Into<Value>) -> Self {
        Self { path: vec!["query".into(), key.into()], value: Some(value.into()) }
    }

    /// Slip rates before and after a step, m/s.
    pub fn rate_step(rates: [f64; 2]) -> [Self; 2] {
        let of = |(key, rate): (&str, f64)| Self {
            path: ["query", "rate_step", key].map(String::from).to_vec(),
            value: Some(Value::Float(rate)),
        };
        [("before", rates[0]), ("after", rates[1])].map(of)
    }

    /// Slip over which a contact lasts.
    pub fn contact_life(life: ContactLife) -> Self {
        let value = Value::try_from(life).ok();
        Self { path: vec!["query".into(), "contact_life".into()], value }
    }
}

impl FromStr for Override {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        /// Deeper than any key.
        const DEEPEST: usize = 8;
        let form = || "must be of the form section.key=value".to_owned();
        let (path, value) = text.split_once('=').ok_or_else(form)?;
        let path: Vec<String> = path.split('.').map(|name| name.trim().to_owned()).collect();
        let value = value.trim();
        if !(2..=DEEPEST).contains(&path.len()) || path.iter().any(String::is_empty) || value.is_empty() {
            return Err(form());
        }
        let parsed: Option<Table> = format!("value = {value}").parse().ok();
        // A second key would come from a line break within the text.
        let parsed = parsed.filter(|table| table.len() == 1).and_then(|mut table| table.remove("value"));
        Ok(Self { path, value: Some(parsed.unwrap_or_else(|| Value::String(value.to_owned()))) })
    }
}

/// Sets or removes the key, with sections on the way as needed.
pub(super) fn lay_over(sections: &mut Table, change: &Override) -> Result<(), String> {
    let Some((last, names)) = change.path.split_last() else { return Ok(()) };
    let mut table = sections;
    for name in names {
        match table.entry(name).or_insert_with(|| Value::Table(Table::new())) {
            Value::Table(inner) => table = inner,
            _ => return Err(format!("{}: {name} is a value, not a section", change.path.join("."))),
        }
    }
    match &change.value {
        Some(value) => table.insert(last.clone(), value.clone()),
        None => table.remove(last),
    };
    Ok(())
}
