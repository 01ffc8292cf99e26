//! Sections read by serde, its messages in terms of the file.

use serde::de::DeserializeOwned;
use tables::netcdf::input::Override;
use toml::{Table, Value};

use super::check::check;
use super::error::SceneFileError;
use super::keys::{Key, Kind, choices, find, one_of};
use super::load::{INTERFERENCE, LOAD};
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
        let inner = missing_in(quoted[0], inner, table, keys);
        let full = join(path, &inner);
        if full.starts_with("material.") && presets::REQUIRED.contains(&quoted[0]) {
            let given = table.get("material").and_then(Value::as_table);
            let lacks = |key: &&str| given.is_none_or(|given| !given.contains_key(*key));
            let missing: Vec<&str> = presets::REQUIRED.into_iter().filter(lacks).collect();
            let names = presets::names().join(", ");
            if missing.len() < presets::REQUIRED.len() {
                let allowed = format!("given, or preset one of {names}");
                return source.missing(join("material", &missing.join(", ")), allowed);
            }
            let allowed = format!("one of {names}; or {} given in its place", missing.join(", "));
            return source.missing("material.preset", allowed);
        }
        let mut allowed = allowed::<T>(&inner, table, keys);
        if full == INTERFERENCE {
            allowed.push_str(&format!(", or {LOAD} given (N)"));
        }
        return source.missing(full, allowed);
    }
    // The name of a law is that of the section for serde.
    let inner = match value_at(table, inner) {
        Some(Value::Table(_)) | None => join(inner, "law"),
        Some(_) => inner.to_owned(),
    };
    let (inner, allowed) = match choices(message) {
        Some(names) => (law_called(quoted[0], table, inner), one_of(&names)),
        None => {
            let allowed = allowed::<T>(&inner, table, keys);
            (inner, allowed)
        }
    };
    let value = value_at(table, &inner).map_or(String::new(), Value::to_string);
    source.invalid(&join(path, &inner), value, allowed)
}

/// The missing key of this name in the section at `path`: that of a law within the section, whose keys serde reads with it, if
/// only the law has such a key.
fn missing_in(name: &str, path: &str, table: &Table, keys: &[Key]) -> String {
    let own = join(path, name);
    let section = if path.is_empty() { Some(table) } else { value_at(table, path).and_then(Value::as_table) };
    let within = |(law, value): (&String, &Value)| {
        let key = join(&join(path, law), name);
        (value.get("law").is_some() && value.get(name).is_none() && find(keys, &key).is_some()).then_some(key)
    };
    match find(keys, &own) {
        None => section.and_then(|section| section.iter().find_map(within)).unwrap_or(own),
        Some(_) => own,
    }
}

/// The key `law` with this name: that at `path`, or of a law within the same section, whose keys serde reads with it.
fn law_called(name: &str, table: &Table, path: String) -> String {
    let has_name = |value: &Value| value.as_str() == Some(name);
    let section = path.rsplit_once('.').map_or("", |(section, _)| section);
    let own = value_at(table, &path).is_some_and(has_name);
    match value_at(table, section).and_then(Value::as_table) {
        Some(laws) if !own => {
            let within = laws.iter().find(|(_, value)| value.get("law").is_some_and(has_name));
            within.map_or(path.clone(), |(key, _)| format!("{section}.{key}.law"))
        }
        _ => path,
    }
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
    let error =
        serde_path_to_error::deserialize::<_, T>(unknown).err().filter(|_| matches!(kind, Kind::Name));
    match error.and_then(|error| choices(error.inner().message())) {
        Some(names) => one_of(&names),
        None => kind.allowed(),
    }
}

fn value_at<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    let mut names = path.split('.');
    let first = table.get(names.next()?)?;
    names.try_fold(first, |value, name| value.get(name))
}

#[cfg(test)]
mod tests {
    use crate::scene::tests::parse;

    /// Serde reads the laws of a film with those of its interface, and does not say which of them it means.
    #[test]
    fn the_unknown_law_of_a_film_is_not_that_of_its_interface() {
        let film =
            "interface = { law = \"briscoe-tabor\", film_strength = 6e7, film_softening = { law = \"x\" } }";
        let text =
            format!("material.preset = \"copper\"\nasperity.radius = 1e-3\nloading.interference = 1\n{film}");
        let refused = |sets: &[&str]| parse(&text, sets).unwrap_err();
        let allowed = "must be one of \"none\", \"johnson-cook\", \"table\"";
        let of_file = format!("scene.toml: line 4: interface.film_softening.law = \"x\": {allowed}");
        assert_eq!(refused(&["loading.slip_rate=1"]), of_file);
        let set = "interface.film_softening.law=y";
        let of_set = format!("--set {set}: interface.film_softening.law = \"y\": {allowed}");
        assert_eq!(refused(&[set, "loading.slip_rate=1"]), of_set);
        let own = refused(&["interface.law=briscoe", "loading.slip_rate=1"]);
        assert!(own.contains("interface.law = \"briscoe\""), "{own}");
    }

    #[test]
    fn a_missing_key_of_a_film_is_not_one_of_its_interface() {
        for (law, missing) in [
            (
                "{ law = \"johnson-cook\", reference = 298, melting = 1458 }",
                "exponent is missing; it must be a positive number",
            ),
            (
                "{ law = \"table\", temperature = [77, 298] }",
                "factor is missing; it must be a list, not empty, of: zero or a positive number",
            ),
        ] {
            let text = format!(
                "material.preset = \"copper\"\nasperity.radius = 1e-3\nloading = {{ interference = 1, slip_rate = 1 }}\n\
                 interface = {{ law = \"briscoe-tabor\", film_strength = 6e7, film_softening = {law} }}"
            );
            let refused = parse(&text, &[]).unwrap_err();
            assert_eq!(refused, format!("scene.toml: interface.film_softening.{missing}"));
        }
    }
}
