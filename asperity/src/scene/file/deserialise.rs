//! Sections read by serde, its messages in terms of the file.

use serde::de::DeserializeOwned;
use tables::netcdf::input::Override;
use toml::{Table, Value};

use super::check::check;
use super::error::SceneFileError;
use super::keys::{Key, Kind, find};
use super::source::{Source, join};
use crate::scene::presets;

/// Read the section at `path`: its keys must be among `keys`, its numbers within their ranges.
pub fn read<T: DeserializeOwned>(
    path: &str,
    table: &Table,
    keys: &[Key],
    source: &Source,
) -> Result<T, SceneFileError> {
    check(path, table, keys, source)?;
    serde_path_to_error::deserialize(table.clone()).map_err(|error| {
        let inner = match error.path().to_string() {
            inner if inner == "." => String::new(),
            inner => inner,
        };
        explain::<T>((path, &inner), error.inner().message(), table, keys, source)
    })
}

/// serde's message for the key `inner` of the section at `path`.
fn explain<T: DeserializeOwned>(
    (path, inner): (&str, &str),
    message: &str,
    table: &Table,
    keys: &[Key],
    source: &Source,
) -> SceneFileError {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if message.starts_with("missing field") && !quoted.is_empty() {
        let inner = join(inner, quoted[0]);
        let full = join(path, &inner);
        if full.starts_with("material.") && presets::REQUIRED.contains(&quoted[0]) {
            let given = table.get("material").and_then(Value::as_table);
            let lacks = |key: &&str| given.is_none_or(|given| !given.contains_key(*key));
            let missing: Vec<&str> = presets::REQUIRED.into_iter().filter(lacks).collect();
            let allowed = format!("given, or preset one of {}", presets::names().join(", "));
            return source.missing(join("material", &missing.join(", ")), allowed);
        }
        return source.missing(full, allowed::<T>(&inner, table, keys));
    }
    // The name of a law is that of the section for serde.
    let inner = match value_at(table, inner) {
        Some(Value::Table(_)) | None => join(inner, "law"),
        Some(_) => inner.to_owned(),
    };
    let value = value_at(table, &inner).map_or(String::new(), Value::to_string);
    let allowed = match message.starts_with("unknown variant") {
        true => one_of(&quoted[1..]),
        false => allowed::<T>(&inner, table, keys),
    };
    source.invalid(&join(path, &inner), value, allowed)
}

fn one_of(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    format!("one of {}", names.join(", "))
}

/// What the key `inner` may be; the names of a choice are known to its type only, which lists them
/// where a name is unknown.
fn allowed<T: DeserializeOwned>(inner: &str, table: &Table, keys: &[Key]) -> String {
    let kind = find(keys, inner).unwrap_or(Kind::Name);
    let mut unknown = table.clone();
    let path = inner.split('.').map(String::from).collect();
    let name = Override { path, value: Some(Value::String("?".into())) };
    // A name on the way that is a value has been refused before.
    let _ = name.lay_over(&mut unknown);
    match (kind, serde_path_to_error::deserialize::<_, T>(unknown)) {
        (Kind::Name, Err(error)) if error.inner().message().starts_with("unknown variant") => {
            let names: Vec<&str> = error.inner().message().split('`').skip(3).step_by(2).collect();
            one_of(&names)
        }
        _ => kind.allowed(),
    }
}

fn value_at<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    let mut names = path.split('.');
    let first = table.get(names.next()?)?;
    names.try_fold(first, |value, name| value.get(name))
}
