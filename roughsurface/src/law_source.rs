//! Finds the asperity law that `--table` names.

use std::path::Path;
use tables::closed_forms::{ElasticPlastic, UnknownClosedForm, closed_form};
use tables::dataset::DatasetError;
use tables::law::AsperityLaw;
use tables::table::Table;

/// Why there is no such law.
#[derive(Debug, thiserror::Error)]
pub enum LawSourceError {
    #[error("--table model:{name}: {reason}")]
    Unknown { name: String, reason: UnknownClosedForm },
    #[error(
        "--table model:{name} needs a section [material] in the surface file, with youngs_modulus (Pa), poisson_ratio and yield_strength (Pa)"
    )]
    NoMaterial { name: String },
    #[error("--table: {0}")]
    Table(DatasetError),
}

/// The law called `asked`: `model:NAME` is a closed form for `material`, anything
/// else the file of a table.
pub fn asperity_law(
    asked: &str,
    material: Option<&ElasticPlastic>,
) -> Result<Box<dyn AsperityLaw>, LawSourceError> {
    if let Some(name) = asked.strip_prefix("model:") {
        let unknown = |reason| LawSourceError::Unknown { name: name.to_string(), reason };
        let Some(material) = material else {
            return Err(LawSourceError::NoMaterial { name: name.to_string() });
        };
        return closed_form(name, material).map_err(unknown);
    }
    match Table::read(Path::new(asked)) {
        Ok(table) => Ok(Box::new(table)),
        Err(error) => Err(LawSourceError::Table(error)),
    }
}

/// What else the source of a law knows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background {
    /// The asperities' material, for comparison with closed forms.
    pub material: Option<ElasticPlastic>,
    /// Melting temperature, K: what the softening law of a table's scene calls `melting`.
    pub melting_temperature: Option<f64>,
}

/// What a table knows of its material; of a closed form, the `material` of the surface file.
pub fn background(asked: &str, material: Option<&ElasticPlastic>) -> Background {
    if asked.starts_with("model:") {
        return Background { material: material.copied(), melting_temperature: None };
    }
    let Ok(table) = Table::read(Path::new(asked)) else {
        return Background::default();
    };
    let metadata = table.metadata();
    let nu = metadata.poisson_ratio;
    let of_table = ElasticPlastic {
        youngs_modulus: metadata.contact_modulus * (1.0 - nu * nu),
        poisson_ratio: nu,
        yield_strength: metadata.yield_strength,
    };
    Background { material: Some(of_table), melting_temperature: melting_of(&metadata.scene) }
}

/// What holds for a closed form only under conditions that `material` does not meet.
pub fn caveat(asked: &str, material: &ElasticPlastic) -> Option<String> {
    let off = (material.poisson_ratio - 0.3).abs() > 0.02;
    (asked.ends_with("chang-etsion-bogy") && off).then(|| {
        format!(
            "chang-etsion-bogy: its static friction was published for a Poisson ratio of 0.3, not {}",
            material.poisson_ratio
        )
    })
}

fn melting_of(scene: &str) -> Option<f64> {
    let scene: toml::Table = scene.parse().ok()?;
    scene.get("material")?.get("softening")?.get("melting")?.as_float()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_of_a_table_knows_the_melting_temperature() {
        let scene = "[material]\nsoftening = { law = \"johnson-cook\", melting = 1793.0 }\n";
        assert_eq!(melting_of(scene), Some(1793.0));
        assert_eq!(melting_of("[material]\nsoftening = { law = \"none\" }\n"), None);
        assert_eq!(melting_of(""), None);
    }

    #[test]
    fn closed_forms_need_a_known_name_and_a_material() {
        let steel = ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 400e6 };
        assert_eq!(asperity_law("model:hertz", Some(&steel)).unwrap().name(), "hertz");
        let message = |asked: &str, material| match asperity_law(asked, material) {
            Ok(_) => panic!("{asked} was found"),
            Err(error) => error.to_string(),
        };
        assert!(message("model:herz", Some(&steel)).contains("kogut-etsion"));
        assert!(message("model:hertz", None).contains("[material]"));
        assert!(message("no-such-table.nc", None).starts_with("--table: cannot read no-such-table.nc"));
    }
}
