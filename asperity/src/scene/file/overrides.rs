//! `--set section.key=value`: values of the command line laid over those of the file.

use toml::{Table, Value};

use super::error::SceneFileError;

/// Lay one override over `document`; returns the path that it sets.
///
/// The value is read as TOML (`1e-3`, `[1, 2]`, `{ law = "none" }`, `"on"`); what is not
/// TOML is taken as text, so that `--set model.heat=on` needs no quotes.
pub(super) fn apply(document: &mut Table, text: &str) -> Result<String, SceneFileError> {
    let refuse = |reason: &str| SceneFileError::Override { text: text.to_owned(), reason: reason.to_owned() };
    const FORM: &str = "must be of the form section.key=value";
    let (path, value) = text.split_once('=').ok_or_else(|| refuse(FORM))?;
    let (path, value) = (path.trim(), value.trim());
    let keys: Vec<&str> = path.split('.').map(str::trim).collect();
    // Deeper than any key, and not deep enough for the recursion of those who read the document.
    const DEEPEST: usize = 8;
    if !(2..=DEEPEST).contains(&keys.len()) || keys.iter().any(|key| key.is_empty()) || value.is_empty() {
        return Err(refuse(FORM));
    }
    let (last, sections) = keys.split_last().expect("at least two keys");
    let mut table = document;
    for &key in sections {
        let entry = table.entry(key).or_insert_with(|| Value::Table(Table::new()));
        table = entry.as_table_mut().ok_or_else(|| refuse(&format!("{key} is a value, not a section")))?;
    }
    table.insert((*last).to_owned(), parse_value(value));
    Ok(keys.join("."))
}

fn parse_value(text: &str) -> Value {
    let parsed: Option<Value> = format!("value = {text}")
        .parse::<Table>()
        .ok()
        // A second key would come from a line break within the text.
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("value"));
    parsed.unwrap_or_else(|| Value::String(text.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn applied(text: &str) -> Table {
        let mut document: Table = "[loading]\nslip_rate = 1.0".parse().unwrap();
        apply(&mut document, text).unwrap();
        document
    }

    #[test]
    fn replaces_adds_and_descends() {
        let rate = |table: &Table| table["loading"]["slip_rate"].clone();
        assert_eq!(rate(&applied("loading.slip_rate=2")), Value::Integer(2));
        assert_eq!(applied("model.heat=on")["model"]["heat"].as_str(), Some("on"));
        assert_eq!(
            applied("material.hardening.modulus=1e9")["material"]["hardening"]["modulus"].as_float(),
            Some(1e9)
        );
        assert_eq!(
            applied("table.interference=[1, 2]")["table"]["interference"].as_array().unwrap().len(),
            2
        );
    }

    #[test]
    fn malformed_overrides_are_refused() {
        let mut document: Table = "[loading]\nslip_rate = 1.0".parse().unwrap();
        for text in ["loading", "loading=1", "loading.slip_rate", "a..b=1", "a.b=", ".=1"] {
            let error = apply(&mut document, text).unwrap_err().to_string();
            assert!(error.contains("section.key=value"), "{error}");
        }
        let error = apply(&mut document, "loading.slip_rate.x=1").unwrap_err();
        assert!(error.to_string().contains("not a section"));
    }
}
