//! The document that is read: the file, with the overrides above it and the preset below it.

use std::path::Path;

use tables::netcdf::input::{Override, STANDARD_INPUT, read_text, syntax_error};
use toml::{Table, Value};

use super::counterface::{resolve_counterface, take_preset};
use super::deserialise::read;
use super::error::SceneFileError;
use super::keys::SCENE;
use super::load::{expected_interference, resolve_load};
use super::programme::resolve_programme;
use super::relations;
use super::source::Source;
use crate::scene::{FrictionLaw, Scene};

/// Sections of a scene or request.
pub struct Document {
    pub sections: Table,
    pub source: Source,
}

/// A path as named in messages.
pub fn name_of(path: &Path) -> String {
    match path == Path::new(STANDARD_INPUT) {
        true => "standard input".into(),
        false => path.display().to_string(),
    }
}

/// The text of a file, or of the standard input for the path `-`.
pub fn text_of(path: &Path) -> Result<String, SceneFileError> {
    let unreadable =
        |error: std::io::Error| SceneFileError::Unreadable { file: name_of(path), reason: error.to_string() };
    read_text(path).map_err(unreadable)
}

impl Document {
    /// The sections of a file called `file` with the overrides, each `section.key=value`.
    pub fn parse(text: &str, file: &str, overrides: &[String]) -> Result<Self, SceneFileError> {
        let mut source = Source { file: file.into(), text: text.into(), overrides: Vec::new() };
        let mut sections: Table = text.parse().map_err(|error: toml::de::Error| SceneFileError::Syntax {
            file: file.into(),
            line: source.line(error.span().map_or(0, |span| span.start)),
            reason: syntax_error(text, &error),
        })?;
        if let Some((key, value)) = sections.iter().find(|(_, value)| !value.is_table()) {
            return Err(source.invalid(key, value, "a section, as in [loading]"));
        }
        for text in overrides {
            let path = lay_over(&mut sections, text)?;
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
        resolve_load(&mut sections, &self.source)?;
        if let Some(Value::Table(interface)) = sections.get_mut("interface") {
            // Serde has no default for the law of a section that has other keys too.
            let law = Table::try_from(FrictionLaw::default()).expect("plain data");
            interface.entry("law").or_insert_with(|| law["law"].clone());
        }
        let mut scene: Scene = read("", &sections, SCENE, &self.source)?;
        scene.evaluate_properties();
        relations::check_material(&scene, &self.source)?;
        if let Some(load) = scene.loading.load {
            scene.loading.interference = expected_interference(&scene, load);
        }
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

/// Applies one override to the sections; returns the key that it sets.
fn lay_over(sections: &mut Table, text: &str) -> Result<String, SceneFileError> {
    let refuse = |reason| SceneFileError::Override { text: text.into(), reason };
    let change: Override = text.parse().map_err(refuse)?;
    change.lay_over(sections).map_err(refuse)?;
    Ok(change.key())
}
