//! Scenes and table requests as TOML: overrides, presets, checks, reading and writing by serde.
//!
//! The types of [`crate::scene`] are the format: names, defaults, required keys. `keys.rs` adds unit and
//! range of each number. Overrides replace keys of the file, keys of the file replace those of the preset.
//!
//! A message about bad input is one line that names the file and the line (or the `--set`), the key, the
//! value and what is allowed. An unknown key is an error.

mod check;
mod counterface;
mod default_grid;
mod deserialise;
mod document;
mod error;
mod keys;
mod load;
mod programme;
mod relations;
mod request;
mod source;
mod synonyms;
#[cfg(test)]
mod tests;

use std::path::Path;

pub use error::SceneFileError;
pub use keys::{key_names, law_names};
pub use request::{Request, parse_request, read_request, write_request};

use crate::scene::Scene;
use document::Document;
pub(in crate::scene) use source::is_within;

/// Read a scene from a file, or the standard input for the path `-`, with `overrides` (`section.key=value`) laid over it.
///
/// ```no_run
/// use asperity::scene::file::read_scene;
///
/// let overrides = ["loading.slip_rate=10".to_owned()];
/// let scene = read_scene("scene.toml".as_ref(), &overrides)?;
/// # Ok::<(), asperity::scene::file::SceneFileError>(())
/// ```
pub fn read_scene(path: &Path, overrides: &[String]) -> Result<Scene, SceneFileError> {
    parse_scene(&document::text_of(path)?, &document::name_of(path), overrides)
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
    let document = Document::parse(text, file, overrides)?;
    if let Some(table) = document.sections.get("table") {
        let allowed = "left out of a scene; this is a request for `asperity tabulate`";
        return Err(document.source.invalid("table", table, allowed));
    }
    let scene = document.scene()?;
    relations::check_heat(&scene, &[scene.loading.slip_rate], &document.source)?;
    Ok(scene)
}

/// The whole scene as TOML, with every default filled in; reading it gives the same scene.
pub fn write_scene(scene: &Scene) -> String {
    const PLAIN: &str = "a scene is plain data";
    if scene.loading.steps.is_empty() && scene.loading.load.is_none() {
        return toml::to_string(scene).expect(PLAIN);
    }
    let mut sections = scene.document();
    if !scene.loading.steps.is_empty() {
        programme::leave_to_programme(&mut sections);
    }
    toml::to_string(&sections).expect(PLAIN)
}
