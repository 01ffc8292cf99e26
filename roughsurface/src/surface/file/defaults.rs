//! Optional keys of the query with their default values.

use super::read::SurfaceFile;
use crate::surface::query::{ContactLife, Interaction, LoadingControl};
use serde::Serialize;
use toml::Value;

/// A key with its value where that is the default.
fn at_default<T: Serialize + PartialEq>(key: &str, value: T, default: T) -> Option<String> {
    let text = || Value::try_from(&value).map_or_else(|_| String::new(), |value| value.to_string());
    (value == default).then(|| format!("query.{key} = {}", text()))
}

impl SurfaceFile {
    /// Optional keys that have their default value, as in `query.hold = "load"`.
    pub fn defaults_in_effect(&self) -> Vec<String> {
        let query = &self.query;
        let defaults = [
            at_default("hold", query.control, LoadingControl::default()),
            at_default("contact_life", query.contact_life, ContactLife::default()),
            at_default("interaction", query.interaction, Interaction::default()),
        ];
        defaults.into_iter().flatten().collect()
    }
}
