//! Scenes and table requests as TOML: reading with checks, overrides, writing back.
//!
//! A message about bad input is one line that names the file (or the `--set`), the key, the
//! value and what is allowed. Nothing is guessed: an unknown key is an error.

mod error;
mod material;
mod overrides;
mod reader;
mod request;
mod sections;
#[cfg(test)]
mod tests;
mod write;

use std::path::Path;

use toml::{Table, Value};

pub use error::SceneFileError;
pub use request::Request;
pub use write::{write_request, write_scene};

use crate::scene::Scene;
use reader::{Origin, Section};

const SECTIONS: [&str; 6] = ["material", "asperity", "interface", "loading", "model", "numerics"];

/// Read a scene from a file, with `overrides` (`section.key=value`) laid over it.
///
/// ```no_run
/// use asperity::scene::file::read_scene;
///
/// let overrides = ["loading.slip_rate=10".to_owned()];
/// let scene = read_scene("scene.toml".as_ref(), &overrides)?;
/// # Ok::<(), asperity::scene::file::SceneFileError>(())
/// ```
pub fn read_scene(path: &Path, overrides: &[String]) -> Result<Scene, SceneFileError> {
    parse_scene(&read(path)?, &path.display().to_string(), overrides)
}

/// Read a table request from a file, with `overrides` (`section.key=value`) laid over it.
pub fn read_request(path: &Path, overrides: &[String]) -> Result<Request, SceneFileError> {
    parse_request(&read(path)?, &path.display().to_string(), overrides)
}

/// Read a scene from text; `file` is the name to use in messages.
///
/// ```
/// use asperity::scene::file::{parse_scene, write_scene};
///
/// let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-6\n\
///             [loading]\ninterference = 5\nslip_rate = 1\n";
/// let scene = parse_scene(text, "scene.toml", &["loading.slip_rate=10".to_owned()])?;
/// assert_eq!((scene.radius, scene.loading.slip_rate), (1e-6, 10.0));
/// // Written out, it has every value, and means the same.
/// assert_eq!(parse_scene(&write_scene(&scene), "written", &[])?, scene);
///
/// let error = parse_scene(text, "scene.toml", &["loading.slip_rte=10".to_owned()]).unwrap_err();
/// assert!(error.to_string().contains("did you mean slip_rate?"));
/// # Ok::<(), asperity::scene::file::SceneFileError>(())
/// ```
pub fn parse_scene(text: &str, file: &str, overrides: &[String]) -> Result<Scene, SceneFileError> {
    let (document, origin) = parse_document(text, file, overrides)?;
    if let Some(table) = document.get("table") {
        let table = table.to_string();
        let allowed = "left out of a scene; this is a request for `asperity tabulate`";
        return Err(origin.invalid("table", table, allowed));
    }
    let mut root = Section::new("", document, &SECTIONS, &origin)?;
    let scene = scene(&mut root, None)?;
    sections::check_together(&scene, &[scene.loading.slip_rate], &origin)?;
    Ok(scene)
}

/// Read a table request from text; `file` is the name to use in messages.
pub fn parse_request(text: &str, file: &str, overrides: &[String]) -> Result<Request, SceneFileError> {
    let (document, origin) = parse_document(text, file, overrides)?;
    let known: Vec<&str> = SECTIONS.into_iter().chain(["table"]).collect();
    let mut root = Section::new("", document, &known, &origin)?;
    if !root.has("table") {
        return Err(root.missing("table", "a section with interference and slip_rate"));
    }
    let request::Grid { interferences, slip_rates, temperatures, goal } = request::table(&mut root)?;
    let template = scene(&mut root, Some((interferences[0], slip_rates[0])))?;
    sections::check_together(&template, &slip_rates, &origin)?;
    for &temperature in &temperatures {
        sections::check_temperature(&template, "table.temperature", temperature, &origin)?;
    }
    Ok(Request { template, interferences, slip_rates, temperatures, goal })
}

fn scene(root: &mut Section<'_>, point: Option<(f64, f64)>) -> Result<Scene, SceneFileError> {
    let mut scene = Scene {
        material: material::material(root)?,
        radius: sections::radius(root)?,
        interface: sections::interface(root)?,
        loading: sections::loading(root, point)?,
        model: sections::model(root)?,
        numerics: sections::numerics(root)?,
    };
    scene.material.evaluate_at_temperature(scene.loading.temperature);
    Ok(scene)
}

fn read(path: &Path) -> Result<String, SceneFileError> {
    use std::io::Read;

    /// Far more than anyone writes, and less than a device that never ends.
    const MOST: u64 = 16 << 20;
    let unreadable = |reason: String| SceneFileError::Unreadable { file: path.display().to_string(), reason };
    let mut text = String::new();
    let file = std::fs::File::open(path).map_err(|error| unreadable(error.to_string()))?;
    file.take(MOST + 1).read_to_string(&mut text).map_err(|error| unreadable(error.to_string()))?;
    match text.len() as u64 > MOST {
        true => Err(unreadable(format!("is longer than {} MB", MOST >> 20))),
        false => Ok(text),
    }
}

fn parse_document(text: &str, file: &str, overrides: &[String]) -> Result<(Table, Origin), SceneFileError> {
    let mut document: Table = text.parse().map_err(|error| syntax(file, text, &error))?;
    let mut origin = Origin { file: file.to_owned(), overrides: Vec::new() };
    for (key, value) in &document {
        if !matches!(value, Value::Table(_)) {
            let allowed = "a section, as in [loading]";
            return Err(origin.invalid(key, value, allowed));
        }
    }
    for text in overrides {
        let path = overrides::apply(&mut document, text)?;
        origin.overrides.push((path, text.clone()));
    }
    Ok((document, origin))
}

fn syntax(file: &str, text: &str, error: &toml::de::Error) -> SceneFileError {
    let start = error.span().map_or(0, |span| span.start);
    SceneFileError::Syntax {
        file: file.to_owned(),
        line: 1 + text.bytes().take(start).filter(|&byte| byte == b'\n').count(),
        // The parser's message may be several lines long.
        reason: error.message().split_whitespace().collect::<Vec<_>>().join(" "),
    }
}
