//! Input as Python gives it: a path, TOML, or a dictionary as JSON; numbers as a list or as text.

use std::path::PathBuf;

use pyo3::prelude::*;
use roughsurface::surface::file::Values;

use crate::errors;

/// A scene, a request or a surface.
#[derive(FromPyObject)]
pub struct Given {
    /// "path", "text" or "dict".
    kind: String,
    /// The path or the text.
    content: String,
}

/// What was given.
pub enum Source {
    Path(PathBuf),
    /// TOML, and the name that messages have for it.
    Text(String, &'static str),
}

impl Given {
    pub fn source(self) -> Source {
        match self.kind.as_str() {
            "path" => Source::Path(self.content.into()),
            "text" => Source::Text(self.content, "text"),
            _ => Source::Text(self.content, "dict"),
        }
    }
}

/// Numbers as a list, or as the programs take them (`1e5..1e7:9`).
#[derive(FromPyObject)]
pub enum Numbers {
    Text(String),
    List(Vec<f64>),
}

impl Numbers {
    pub fn values(self, key: &str) -> PyResult<Values> {
        match self {
            Self::Text(text) => text.parse().map_err(|reason: String| errors::refused(key, reason)),
            Self::List(list) => Ok(Values(list)),
        }
    }
}
