//! Input as Python gives it: a path, TOML, or a dictionary as JSON; numbers as a list or as text.

use pyo3::prelude::*;
use roughsurface::surface::file::Values;
use roughsurface::surface::units::Units;

use crate::errors;

/// A scene, a request or a surface.
#[derive(FromPyObject)]
pub struct Given {
    /// "path"; of TOML "text" or "dict", which is its name in messages.
    pub kind: String,
    /// The path or the TOML.
    pub content: String,
}

impl Given {
    pub fn is_path(&self) -> bool {
        self.kind == "path"
    }
}

/// Numbers as a list, or as the programs take them (`1e5..1e7:9`, `1MPa`).
#[derive(FromPyObject)]
pub enum Numbers {
    Text(String),
    List(Vec<f64>),
}

impl Numbers {
    pub fn values(self, key: &str, units: &Units) -> PyResult<Values> {
        match self {
            Self::Text(text) => Values::parse(&text, units).map_err(|reason| errors::refused(key, reason)),
            Self::List(list) => Ok(Values(list)),
        }
    }
}
