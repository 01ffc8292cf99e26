//! The document that is read: the file, with the overrides above it and the preset below it.

use std::io::Read;
use std::path::Path;

use toml::{Table, Value};

use super::counterface::{resolve_counterface, take_preset};
use super::deserialise::{read, set_at};
use super::error::SceneFileError;
use super::keys::SCENE;
use super::programme::resolve_programme;
use super::relations;
use super::source::Source;
use crate::scene::{FrictionLaw, Scene};

/// Sections of a scene or request.
pub struct Document {
    pub sections: Table,
    pub source: Source,
}

/// Path that stands for the standard input.
const STANDARD_INPUT: &str = "-";

/// A path as named in messages.
pub fn name_of(path: &Path) -> String {
    match path == Path::new(STANDARD_INPUT) {
        true => "standard input".into(),
        false => path.display().to_string(),
    }
}

/// The text of a file, or of the standard input for the path `-`.
pub fn text_of(path: &Path) -> Result<String, SceneFileError> {
    /// Above the size of any scene file; bounds the read from an endless device.
    const LONGEST: u64 = 16 << 20;
    let unreadable = |reason: String| SceneFileError::Unreadable { file: name_of(path), reason };
    let mut text = String::new();
    let file: Box<dyn Read> = match path == Path::new(STANDARD_INPUT) {
        true => Box::new(std::io::stdin()),
        false => Box::new(std::fs::File::open(path).map_err(|error| unreadable(error.to_string()))?),
    };
    file.take(LONGEST + 1).read_to_string(&mut text).map_err(|error| unreadable(error.to_string()))?;
    match text.len() as u64 > LONGEST {
        true => Err(unreadable(format!("is longer than {} MB", LONGEST >> 20))),
        false => Ok(text),
    }
}

impl Document {
    /// The sections of a file called `file` with the overrides, each `section.key=value`.
    pub fn parse(text: &str, file: &str, overrides: &[String]) -> Result<Self, SceneFileError> {
        let mut source = Source { file: file.into(), text: text.into(), overrides: Vec::new() };
        let mut sections: Table = text.parse().map_err(|error: toml::de::Error| SceneFileError::Syntax {
            file: file.into(),
            line: source.line(error.span().map_or(0, |span| span.start)),
            // The parser's message may be several lines long.
            reason: error.message().split_whitespace().collect::<Vec<_>>().join(" "),
        })?;
        if let Some((key, value)) = sections.iter().find(|(_, value)| !value.is_table()) {
            return Err(source.invalid(key, value, "a section, as in [loading]"));
        }
        for text in overrides {
            let path = lay_over_document(&mut sections, text)?;
            source.overrides.push((path, text.clone()));
        }
        // A section that is left out is an empty one.
        for key in SCENE {
            sections.entry(key.name).or_insert_with(|| Value::Table(Table::new()));
        }
        Ok(Self { sections, source })
    }

    /// The scene that the sections describe, but for those of a request.
    pub fn scene(&self) -> Result<Scene, SceneFileError> {
        let mut sections = self.sections.clone();
        if let Some(Value::Table(material)) = sections.get_mut("material") {
            lay_over_preset(material, &self.source)?;
            relations::check_fracture(material, &self.source)?;
        }
        resolve_counterface(&mut sections, &self.source)?;
        resolve_programme(&mut sections, &self.source)?;
        if let Some(Value::Table(interface)) = sections.get_mut("interface") {
            // Serde has no default for the law of a section that has other keys too.
            let law = Table::try_from(FrictionLaw::default()).expect("plain data");
            interface.entry("law").or_insert_with(|| law["law"].clone());
        }
        let mut scene: Scene = read("", &sections, SCENE, &self.source)?;
        scene.material.evaluate_at_temperature(scene.loading.temperature);
        relations::check_material(&scene, &self.source)?;
        Ok(scene)
    }
}

/// Replaces the key `preset` by the keys of that preset that are not given.
fn lay_over_preset(material: &mut Table, source: &Source) -> Result<(), SceneFileError> {
    let Some(preset) = take_preset("material", material, source)? else {
        return Ok(());
    };
    for (key, below) in preset.section() {
        match (material.get_mut(&key), below) {
            // Off unless the scene names it.
            (None, _) if key == "rate" => {}
            (None, below) => {
                material.insert(key, below);
            }
            (Some(Value::Table(given)), Value::Table(below))
                if given.get("law").is_none_or(|law| below.get("law") == Some(law)) =>
            {
                for (key, value) in below {
                    given.entry(key).or_insert(value);
                }
            }
            // A number, or another law, replaces the whole.
            _ => {}
        }
    }
    Ok(())
}

/// Applies one override to the sections; returns the path that it sets.
///
/// The value is read as TOML (`1e-3`, `[1, 2]`, `{ law = "none" }`, `"on"`); what is not
/// TOML is taken as text, so that `--set model.heat=on` needs no quotes.
fn lay_over_document(sections: &mut Table, text: &str) -> Result<String, SceneFileError> {
    /// Deeper than any key, and not deep enough for the recursion of the parsers.
    const DEEPEST: usize = 8;
    let refuse = |reason: &str| SceneFileError::Override { text: text.into(), reason: reason.into() };
    let form = || refuse("must be of the form section.key=value");
    let (path, value) = text.split_once('=').ok_or_else(form)?;
    let names: Vec<&str> = path.split('.').map(str::trim).collect();
    let value = value.trim();
    if !(2..=DEEPEST).contains(&names.len()) || names.iter().any(|name| name.is_empty()) || value.is_empty() {
        return Err(form());
    }
    let path = names.join(".");
    match set_at(sections, &path, parse_value(value)) {
        None => Ok(path),
        Some(name) => Err(refuse(&format!("{name} is a value, not a section"))),
    }
}

fn parse_value(text: &str) -> Value {
    let parsed: Option<Table> = format!("value = {text}").parse().ok();
    match parsed {
        // A second key would come from a line break within the text.
        Some(mut table) if table.len() == 1 => table.remove("value").expect("its only key"),
        _ => Value::String(text.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laid_over(text: &str) -> Result<Table, SceneFileError> {
        let text = [text.to_owned()];
        Document::parse("[loading]\nslip_rate = 1.0", "file", &text).map(|document| document.sections)
    }

    #[test]
    fn overrides_replace_add_and_descend() {
        let sections = |text: &str| laid_over(text).unwrap();
        assert_eq!(sections("loading.slip_rate=2")["loading"]["slip_rate"], Value::Integer(2));
        assert_eq!(sections("model.heat=on")["model"]["heat"].as_str(), Some("on"));
        let modulus = &sections("material.hardening.modulus=1e9")["material"]["hardening"]["modulus"];
        assert_eq!(modulus.as_float(), Some(1e9));
        let list = &sections("table.interference=[1, 2]")["table"]["interference"];
        assert_eq!(list.as_array().unwrap().len(), 2);
    }

    #[test]
    fn malformed_overrides_are_refused() {
        for text in ["loading", "loading=1", "loading.slip_rate", "a..b=1", "a.b=", ".=1"] {
            let error = laid_over(text).unwrap_err().to_string();
            assert!(error.contains("section.key=value"), "{error}");
        }
        let error = laid_over("loading.slip_rate.x=1").unwrap_err().to_string();
        assert!(error.contains("slip_rate is a value, not a section"), "{error}");
    }
}
