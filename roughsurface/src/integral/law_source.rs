//! Finds the asperity law that `--table` names.

use tables::closed_forms::{ElasticPlastic, UnknownClosedForm, closed_form};
use tables::law::AsperityLaw;
use tables::shipped::{self, TableSourceError};

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
    Table(TableSourceError),
    #[error(
        "query.temperature = {temperature} K: a closed form (--table model:{name}) knows no temperature; leave it out"
    )]
    NoTemperature { name: String, temperature: f64 },
}

/// The law called `asked`: `model:NAME` is a closed form for `material`, anything else the file of a
/// table or the name of a shipped one. `temperature` is the initial one, K: a table of several must be
/// given it, for any other it can only be the table's own.
///
/// ```
/// use roughsurface::integral::law_source::asperity_law;
/// use tables::closed_forms::ElasticPlastic;
///
/// let steel = ElasticPlastic { youngs_modulus: 205e9, poisson_ratio: 0.29, yield_strength: 792e6 };
/// assert!(asperity_law("model:kogut-etsion", Some(&steel), None).is_ok());
/// assert!(asperity_law("model:kogut-etsion", None, None).is_err());
/// assert!(asperity_law("model:no-such-law", None, None).err().unwrap().to_string().contains("jackson-green"));
/// assert!(asperity_law("steel-4340", None, None).is_ok());
/// assert!(asperity_law("steel-4340", None, Some(500.0)).is_err());
/// assert!(asperity_law("no-such-table.nc", None, None).is_err());
/// ```
pub fn asperity_law(
    asked: &str,
    material: Option<&ElasticPlastic>,
    temperature: Option<f64>,
) -> Result<Box<dyn AsperityLaw>, LawSourceError> {
    if let Some(name) = asked.strip_prefix("model:") {
        if let Some(temperature) = temperature {
            return Err(LawSourceError::NoTemperature { name: name.to_string(), temperature });
        }
        let unknown = |reason| LawSourceError::Unknown { name: name.to_string(), reason };
        // A name that no material would help is said to be one first.
        const ANY: ElasticPlastic =
            ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 1e9 };
        let law = closed_form(name, material.unwrap_or(&ANY)).map_err(unknown)?;
        return match material {
            Some(_) => Ok(law),
            None => Err(LawSourceError::NoMaterial { name: name.to_string() }),
        };
    }
    match shipped::open(asked, temperature) {
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

/// What a table knows of its material, at the initial temperature if it has several; of a closed form,
/// the `material` of the surface file.
pub fn background(asked: &str, material: Option<&ElasticPlastic>, temperature: Option<f64>) -> Background {
    if asked.starts_with("model:") {
        return Background { material: material.copied(), melting_temperature: None };
    }
    let Ok(table) = shipped::open(asked, temperature) else {
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

/// The law called `asked`, with missing points of a table interpolated around where that is
/// possible; and a warning if there are any.
pub fn asperity_law_without_gaps(
    asked: &str,
    material: Option<&ElasticPlastic>,
    temperature: Option<f64>,
) -> Result<(Box<dyn AsperityLaw>, Option<String>), LawSourceError> {
    if asked.starts_with("model:") {
        return Ok((asperity_law(asked, material, temperature)?, None));
    }
    let (table, filled) =
        shipped::open(asked, temperature).map_err(LawSourceError::Table)?.with_failed_cells_interpolated();
    let labels: Vec<String> = filled.iter().map(|(i, j)| table.label(*i, *j)).collect();
    let warning = (!labels.is_empty())
        .then(|| format!("cells without results, interpolated around: {}", labels.join("; ")));
    Ok((Box::new(table.interpolated()), warning))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tables::quantity::Quantity;
    use tables::table::{Slice, Table};

    #[test]
    fn gaps_of_a_table_are_filled_only_if_asked() {
        let axes = tables::table::Axes {
            interference: vec![1.0, 3.0, 9.0],
            slip_rate: vec![1.0],
            slip: vec![0.0, 1.0],
        };
        let metadata = tables::table::Metadata { asperity_radius: 1e-3, ..Default::default() };
        let mut table = Slice::new(axes, metadata).unwrap();
        for i in [0, 2] {
            let mut cell = tables::table::Cell::new().with(Quantity::ContactRadius, 1e-5, 0.0);
            for quantity in [Quantity::Load, Quantity::Friction, Quantity::Area] {
                cell = cell.with(quantity, 2.0, 0.1).with_history(quantity, vec![2.0, 2.0]);
            }
            table.set_cell(i, 0, cell).unwrap();
        }
        table.mark_failed(1, 0, "no convergence");
        let path = std::env::temp_dir().join(format!("roughsurface-gaps-{}.nc", std::process::id()));
        table.write(&path).unwrap();
        let asked = path.to_str().unwrap();
        let refusal = asperity_law(asked, None, None).unwrap().response(1e-3, 4.0, 1.0, 1e-5).unwrap_err();
        assert!(refusal.to_string().contains("no convergence"));
        let (law, warning) = asperity_law_without_gaps(asked, None, None).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert!((law.response(1e-3, 4.0, 1.0, 1e-5).unwrap().load.value - 2.0).abs() < 1e-12);
        assert_eq!(warning.unwrap(), "cells without results, interpolated around: 3 omega_c at 1 m/s");
    }

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
        assert_eq!(asperity_law("model:hertz", Some(&steel), None).unwrap().name(), "hertz");
        let message = |asked: &str, material| match asperity_law(asked, material, None) {
            Ok(_) => panic!("{asked} was found"),
            Err(error) => error.to_string(),
        };
        assert!(message("model:herz", Some(&steel)).contains("kogut-etsion"));
        assert!(message("model:hertz", None).contains("[material]"));
        assert!(message("no-such-table.nc", None).starts_with("--table: cannot read no-such-table.nc"));
    }
    #[test]
    fn a_table_is_read_at_the_temperature_asked_for() {
        let member = |temperature: f64| {
            let axes =
                tables::table::Axes { interference: vec![1.0], slip_rate: vec![1.0], slip: vec![0.0, 1.0] };
            let metadata = tables::table::Metadata {
                asperity_radius: 1e-3,
                temperature,
                yield_strength: 1e9 - 1e6 * temperature,
                contact_modulus: 2e11,
                ..Default::default()
            };
            let mut table = Slice::new(axes, metadata).unwrap();
            let mut cell = tables::table::Cell::new().with(Quantity::ContactRadius, 1e-5, 0.0);
            for quantity in [Quantity::Load, Quantity::Friction, Quantity::Area] {
                cell = cell.with(quantity, temperature, 0.1).with_history(quantity, vec![temperature; 2]);
            }
            cell = cell.with_history(Quantity::TemperatureMax, vec![temperature; 2]);
            table.set_cell(0, 0, cell).unwrap();
            table
        };
        let path = std::env::temp_dir().join(format!("roughsurface-series-{}.nc", std::process::id()));
        let several = Table::new([300.0, 400.0, 500.0].map(member).to_vec()).unwrap();
        several.write(&path).unwrap();
        let asked = path.to_str().unwrap();
        let law = |temperature| asperity_law(asked, None, temperature);
        let load = law(Some(400.0)).unwrap().response(1e-3, 1.0, 1.0, 1e-5).unwrap().load.value;
        let between = law(Some(450.0)).unwrap().response(1e-3, 1.0, 1.0, 1e-5).unwrap().load.value;
        let strength = background(asked, None, Some(400.0)).material.unwrap().yield_strength;
        let refused = |temperature| law(temperature).map(|_| ()).unwrap_err().to_string();
        let (open, outside) = (refused(None), refused(Some(600.0)));
        let gaps = asperity_law_without_gaps(asked, None, None).map(|_| ()).unwrap_err().to_string();
        std::fs::remove_file(&path).unwrap();
        assert!((load / 400.0 - 1.0).abs() < 1e-12 && (between / 450.0 - 1.0).abs() < 1e-2);
        assert_eq!(strength, 6e8);
        assert!(open.contains("from 300 to 500 K") && open.contains("query.temperature"), "{open}");
        assert_eq!(gaps, open);
        assert!(outside.contains("600 K is outside") && outside.contains("300 to 500 K"), "{outside}");
        let own = asperity_law("steel-4340", None, Some(500.0)).map(|_| ()).unwrap_err().to_string();
        assert!(own.contains("is for an initial temperature of 298 K only, not 500 K"), "{own}");
        let steel = ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 400e6 };
        let form =
            asperity_law("model:hertz", Some(&steel), Some(500.0)).map(|_| ()).unwrap_err().to_string();
        assert!(form.starts_with("query.temperature = 500 K: a closed form"), "{form}");
    }
}
