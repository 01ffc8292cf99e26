//! Where the values of a document come from: the file, a line of it, or an override.

use std::ops::Range;

use tables::numbers::exact;
use toml::de::{DeTable, DeValue};

use super::error::SceneFileError;

/// A file with the overrides laid over it.
#[derive(Debug, Default)]
pub struct Source {
    /// Name of the file in messages.
    pub file: String,
    pub text: String,
    /// Path and text of every `--set`.
    pub overrides: Vec<(String, String)>,
}

impl Source {
    /// The override that set the key at `path`, or the file with the line of the key.
    pub fn location(&self, path: &str) -> String {
        let sets = |set: &str| is_within(set, path) || is_within(path, set);
        if let Some((_, text)) = self.overrides.iter().rev().find(|(set, _)| sets(set)) {
            return format!("--set {text}");
        }
        match self.span(path) {
            Some(span) => format!("{}: line {}", self.file, self.line(span.start)),
            None => self.file.clone(),
        }
    }

    /// Line of a position in the file, from 1.
    pub fn line(&self, position: usize) -> usize {
        1 + self.text.bytes().take(position).filter(|&byte| byte == b'\n').count()
    }

    /// The key at `path` in the text; none where it comes from a preset.
    fn span(&self, path: &str) -> Option<Range<usize>> {
        let document = DeTable::parse(&self.text).ok()?;
        let mut table = document.get_ref();
        let mut span = None;
        for name in path.split('.') {
            let (name, index) = name.split_once('[').unwrap_or((name, ""));
            let (key, value) = table.iter().find(|(key, _)| key.get_ref() == name)?;
            span = Some(key.span());
            let value = match (value.get_ref(), index.trim_end_matches(']').parse::<usize>()) {
                (DeValue::Array(list), Ok(index)) => list.get(index)?.get_ref(),
                (value, _) => value,
            };
            match value {
                DeValue::Table(inner) => table = inner,
                _ => break,
            }
        }
        span
    }

    pub fn invalid(&self, key: &str, value: impl ToString, allowed: impl Into<String>) -> SceneFileError {
        SceneFileError::Invalid {
            location: self.location(key),
            key: key.to_owned(),
            // A message is one line, whatever the value.
            value: readable(value.to_string()),
            allowed: allowed.into(),
        }
    }

    pub fn missing(&self, key: impl Into<String>, allowed: impl Into<String>) -> SceneFileError {
        SceneFileError::Missing { location: self.file.clone(), key: key.into(), allowed: allowed.into() }
    }
}

/// A value in one line; a number of many digits in powers of ten.
fn readable(value: String) -> String {
    const MOST_DIGITS: usize = 20;
    match value.parse() {
        Ok(number) if value.len() > MOST_DIGITS => exact(number),
        _ => value.replace('\n', " "),
    }
}

/// Whether the key `path` is that of the section `section`, or one in it.
pub fn is_within(path: &str, section: &str) -> bool {
    path.strip_prefix(section).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// Path of a key of the section at `path`.
pub fn join(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}
