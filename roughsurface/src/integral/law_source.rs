//! The response of one asperity, by the name given with `--table`.

use std::collections::BTreeMap;
use tables::closed_forms::hertz::contact_modulus;
use tables::closed_forms::{ElasticPlastic, UnknownClosedForm, closed_form, partial_slip};
use tables::functions::interpolate;
use tables::law::AsperityLaw;
use tables::shipped::{self, TableSourceError};

/// Reason why a law cannot be used.
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
        "query.temperature = {temperature} K: a closed form (--table model:{name}) does not depend on temperature; leave it out"
    )]
    NoTemperature { name: String, temperature: f64 },
    #[error(
        "--table {table}: its counterface is {found}; the section [counterface] of the surface file {asked}"
    )]
    Counterface { table: String, found: String, asked: String },
    #[error(
        "--table {table}: closed forms are of a rigid counterface; leave out [counterface], and with an elastic one give in [material] \
         youngs_modulus = {combined:.4e}, with which the asperity on a rigid flat has the contact modulus of both bodies"
    )]
    RigidClosedForm { table: String, combined: f64 },
    #[error(
        "--table {table}: its slides hold the load (loading.control = \"load\"), while the summits of a surface slide at \
         constant interference; make the table with loading.control = \"interference\""
    )]
    LoadHeld { table: String },
}

/// Constants of the scene of a table, where it states them.
#[derive(Clone, Copy, Debug, Default)]
pub struct SceneConstants {
    /// Temperature from which on a contact counts as melting, K: key `melting` of the softening law.
    pub melting_temperature: Option<f64>,
    /// Time of sliding inception as in [`partial_slip::inception_time`].
    pub inception_time: Option<f64>,
    /// The smaller effusivity √(kρc) of asperities and counterface, J/(m² K √s).
    pub effusivity: Option<f64>,
}

/// The law of one asperity, and the material data of its source.
pub struct LawSource {
    pub law: Box<dyn AsperityLaw>,
    /// The asperities' material, for comparison with closed forms.
    pub material: ElasticPlastic,
    /// Young's modulus of the asperities alone, Pa: that of `material` contains an elastic counterface.
    pub youngs_modulus: f64,
    pub scene: SceneConstants,
    /// Initial temperature of a table, K.
    pub initial_temperature: Option<f64>,
    /// Cells of the table without results: interpolated around, or of an interference or a slip rate that is left out.
    pub missing_cells: Vec<String>,
    /// Interface of a table that is not as strong as the metal, by its key and value.
    pub other_interface: Option<String>,
    /// Counterface of a table.
    counterface: Option<Counterface>,
}

/// The body on the other side of a table: in words, and its constants.
struct Counterface {
    words: String,
    constants: BTreeMap<String, f64>,
}

impl LawSource {
    /// The law called `asked`: `model:NAME` is a closed form for `material`, anything else the file of a
    /// table or the name of a shipped one. `temperature` is the initial one, K: a table of several must be
    /// given it, for any other it can only be the table's own. Cells without results are interpolated
    /// around if `interpolate_missing`, and fail when looked up otherwise.
    pub fn open(
        asked: &str,
        material: Option<&ElasticPlastic>,
        temperature: Option<f64>,
        interpolate_missing: bool,
    ) -> Result<Self, LawSourceError> {
        if let Some(name) = asked.strip_prefix("model:") {
            return Self::closed_form(name, material, temperature);
        }
        let mut table = shipped::open(asked, temperature).map_err(LawSourceError::Table)?;
        let metadata = table.metadata();
        let scene: toml::Table = metadata.scene.parse().unwrap_or_default();
        let control = scene.get("loading").and_then(|loading| loading.get("control"));
        if control.and_then(toml::Value::as_str) == Some("load") {
            return Err(LawSourceError::LoadHeld { table: asked.to_owned() });
        }
        let nu = metadata.poisson_ratio;
        let material = ElasticPlastic {
            youngs_modulus: metadata.contact_modulus * (1.0 - nu * nu),
            poisson_ratio: nu,
            yield_strength: metadata.yield_strength,
        };
        let temperature = metadata.temperature;
        let youngs_modulus =
            number(&scene, &["material", "youngs_modulus"], temperature).unwrap_or(material.youngs_modulus);
        let counterface = Some(Counterface {
            words: metadata.counterface_in_words(),
            constants: metadata.counterface_constants(),
        });
        let mut missing_cells = Vec::new();
        if interpolate_missing {
            let (whole, passed) = table.with_failed_cells_interpolated();
            missing_cells = table.blocks(passed);
            table = whole.interpolated();
        }
        Ok(Self {
            law: Box::new(table),
            material,
            youngs_modulus,
            scene: SceneConstants {
                melting_temperature: melting_temperature(&scene),
                inception_time: inception_time(&scene, &material, temperature),
                effusivity: effusivity(&scene, temperature),
            },
            initial_temperature: Some(temperature),
            missing_cells,
            other_interface: other_interface(&scene),
            counterface,
        })
    }

    /// Refuses the table called `table` if its counterface has other constants than those `asked`, by more than their
    /// rounding in a file.
    pub fn check_counterface(
        &self,
        table: &str,
        asked: &BTreeMap<String, f64>,
    ) -> Result<(), LawSourceError> {
        const ROUNDING: f64 = 1e-3;
        let Some(Counterface { words, constants }) = &self.counterface else {
            let [youngs_modulus, ratio] =
                ["youngs_modulus", "poisson_ratio"].map(|key| asked.get(key).copied());
            let Some((youngs_modulus, ratio)) = youngs_modulus.zip(ratio) else { return Ok(()) };
            let own = self.material.contact_modulus();
            let combined = 1.0 / (1.0 / own + 1.0 / contact_modulus(youngs_modulus, ratio));
            let combined = self.youngs_modulus * combined / own;
            return Err(LawSourceError::RigidClosedForm { table: table.to_owned(), combined });
        };
        // No expansion is the same as none stated.
        let stated = |constants: &BTreeMap<String, f64>| {
            let mut constants = constants.clone();
            constants.retain(|key, value| key != "thermal_expansion" || *value != 0.0);
            constants
        };
        let (found, asked) = (stated(constants), stated(asked));
        let same = |(key, value): (&String, &f64)| {
            let found = found.get(key);
            found.is_some_and(|found| value == found || (value / found - 1.0).abs() <= ROUNDING)
        };
        if asked.len() == found.len() && asked.iter().all(same) {
            return Ok(());
        }
        let list: Vec<String> = asked.iter().map(|(key, value)| format!("{key} = {value:e}")).collect();
        let asked = match list.is_empty() {
            true => "is empty: rigid and isothermal".to_owned(),
            false => format!("has {}", list.join(", ")),
        };
        Err(LawSourceError::Counterface { table: table.to_owned(), found: words.clone(), asked })
    }

    fn closed_form(
        name: &str,
        material: Option<&ElasticPlastic>,
        temperature: Option<f64>,
    ) -> Result<Self, LawSourceError> {
        let name = name.to_string();
        if let Some(temperature) = temperature {
            return Err(LawSourceError::NoTemperature { name, temperature });
        }
        // An unknown name is reported before a missing material.
        const ANY: ElasticPlastic =
            ElasticPlastic { youngs_modulus: 200e9, poisson_ratio: 0.3, yield_strength: 1e9 };
        match (closed_form(&name, material.unwrap_or(&ANY)), material) {
            (Err(reason), _) => Err(LawSourceError::Unknown { name, reason }),
            (Ok(_), None) => Err(LawSourceError::NoMaterial { name }),
            (Ok(law), Some(material)) => Ok(Self {
                law,
                material: *material,
                youngs_modulus: material.youngs_modulus,
                scene: SceneConstants::default(),
                initial_temperature: None,
                missing_cells: Vec::new(),
                other_interface: None,
                counterface: None,
            }),
        }
    }
}

/// See [`LawSource::other_interface`].
fn other_interface(scene: &toml::Table) -> Option<String> {
    let interface = scene.get("interface")?;
    let given = |key: &str, usual: toml::Value| {
        let value = interface.get(key).filter(|value| **value != usual)?;
        Some(format!("{key} = {value}"))
    };
    given("law", "shear-strength".into())
        .or_else(|| given("strength", "initial".into()))
        .or_else(|| given("strength_factor", 1.0.into()))
}

/// A number of a scene, by its section and key; of a table over temperature, which is linear between its points and constant
/// outside, the value at `temperature`.
fn number(scene: &toml::Table, path: &[&str], temperature: f64) -> Option<f64> {
    let (section, keys) = path.split_first()?;
    let value = keys.iter().try_fold(scene.get(*section)?, |value, key| value.get(key))?;
    let column =
        |key: &str| value.get(key)?.as_array()?.iter().map(toml::Value::as_float).collect::<Option<Vec<_>>>();
    let Some((at, values)) = column("temperature").zip(column("value")) else { return value.as_float() };
    let is_curve = !at.is_empty() && at.len() == values.len();
    is_curve.then(|| interpolate(&at, &values, temperature).0)
}

/// Temperature (K) from which on the metal of a scene has no strength.
fn melting_temperature(scene: &toml::Table) -> Option<f64> {
    let softening = scene.get("material")?.get("softening")?;
    let last = |key: &str| softening.get(key)?.as_array()?.last()?.as_float();
    let of_table = || last("temperature").filter(|_| last("factor") == Some(0.0));
    softening.get("melting").and_then(toml::Value::as_float).or_else(of_table)
}

/// The smaller one of the effusivities of asperity and counterface.
fn effusivity(scene: &toml::Table, temperature: f64) -> Option<f64> {
    let of = |body: &str| {
        let constants = ["thermal_conductivity", "density", "specific_heat"]
            .map(|key| number(scene, &[body, key], temperature));
        constants.into_iter().product::<Option<f64>>().map(f64::sqrt)
    };
    of("material").into_iter().chain(of("counterface")).reduce(f64::min)
}

/// Time of sliding inception as in [`partial_slip::inception_time`]; `combined` has the modulus of the elastic counterface too.
fn inception_time(scene: &toml::Table, combined: &ElasticPlastic, temperature: f64) -> Option<f64> {
    let [youngs, density] =
        ["youngs_modulus", "density"].map(|key| number(scene, &["material", key], temperature));
    let compliance = youngs? / combined.youngs_modulus;
    Some(compliance * partial_slip::inception_time(youngs?, combined.poisson_ratio, density?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integral::test_laws::STEEL;
    use tables::quantity::Quantity;
    use tables::table::{Axes, Cell, Metadata, Slice};

    /// A table over `interference` at one slip rate, every quantity of the cells `done` equal to `value`.
    fn table(interference: &[f64], done: &[usize], value: f64, metadata: Metadata) -> Slice {
        let axes = Axes { interference: interference.to_vec(), slip_rate: vec![1.0], slip: vec![0.0, 1.0] };
        let mut table = Slice::new(axes, Metadata { asperity_radius: 1e-3, ..metadata }).unwrap();
        for &i in done {
            let mut cell = Cell::new().with(Quantity::ContactRadius, 1e-5, 0.0);
            for quantity in [Quantity::Load, Quantity::Friction, Quantity::Area] {
                cell = cell.with(quantity, value, 0.1).with_history(quantity, vec![value; 2]);
            }
            cell = cell.with_history(Quantity::TemperatureMax, vec![value; 2]);
            table.set_cell(i, 0, cell).unwrap();
        }
        table
    }

    fn refused(asked: &str, material: Option<&ElasticPlastic>, temperature: Option<f64>) -> String {
        match LawSource::open(asked, material, temperature, false) {
            Ok(_) => panic!("{asked} was found"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn missing_cells_are_interpolated_only_if_asked() {
        let mut gap = table(&[1.0, 3.0, 9.0], &[0, 2], 2.0, Metadata::default());
        gap.mark_failed(1, 0, "no convergence");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gaps.nc");
        gap.write(&path).unwrap();
        let open = |interpolate| LawSource::open(path.to_str().unwrap(), None, None, interpolate).unwrap();
        let (strict, whole) = (open(false), open(true));
        let refusal = strict.law.response(1e-3, 4.0, 1.0, 1e-5).unwrap_err();
        assert!(refusal.to_string().contains("no convergence"));
        assert!((whole.law.response(1e-3, 4.0, 1.0, 1e-5).unwrap().load.value - 2.0).abs() < 1e-12);
        assert_eq!(whole.missing_cells, ["3 omega_c at 1 m/s"]);
    }

    #[test]
    fn the_scene_of_a_table_states_the_melting_temperature() {
        let melting = |softening: &str| {
            melting_temperature(&format!("[material]\nsoftening = {{ {softening} }}\n").parse().unwrap())
        };
        assert_eq!(melting(r#"law = "johnson-cook", melting = 1793.0"#), Some(1793.0));
        assert_eq!(
            melting(r#"law = "table", temperature = [293.0, 1473.0], factor = [1.0, 0.0]"#),
            Some(1473.0)
        );
        assert_eq!(melting(r#"law = "table", temperature = [293.0, 1473.0], factor = [1.0, 0.1]"#), None);
        assert_eq!(melting(r#"law = "none""#), None);
        assert_eq!(melting_temperature(&toml::Table::new()), None);
    }

    #[test]
    fn properties_over_temperature_have_a_value_at_the_initial_one() {
        let scene = "[material]\nyoungs_modulus = { temperature = [300.0, 500.0], value = [20e9, 10e9] }\n";
        let at = |temperature| number(&scene.parse().unwrap(), &["material", "youngs_modulus"], temperature);
        for (temperature, modulus) in
            [(200.0, 20e9), (300.0, 20e9), (350.0, 17.5e9), (500.0, 10e9), (600.0, 10e9)]
        {
            assert_eq!(at(temperature), Some(modulus), "{temperature}");
        }
    }

    /// E = 124 GPa, ν = 0.34 and 8960 kg/m³ give √(ρG) = 20.361 MPa s/m: 0.5·1.66/20.361e6 = 4.0764e-8, and 2.118 m/s over
    /// the slip rate at a shear strength of 90/√3 MPa.
    #[test]
    fn the_scene_of_a_table_gives_the_time_of_inception() {
        let copper = LawSource::open("copper", None, None, false).unwrap();
        let time = copper.scene.inception_time.unwrap();
        assert!((time / 4.0764e-8 - 1.0).abs() < 1e-4, "{time:e}");
    }

    #[test]
    fn refusals_name_what_is_missing() {
        for (asked, material, temperature, expected) in [
            ("model:herz", Some(&STEEL), None, "kogut-etsion"),
            ("model:hertz", None, None, "[material]"),
            ("model:hertz", Some(&STEEL), Some(500.0), "query.temperature = 500 K: a closed form"),
            ("no-such-table.nc", None, None, "--table: cannot read no-such-table.nc"),
            ("steel-4340", None, Some(500.0), "is for an initial temperature of 298 K only, not 500 K"),
        ] {
            let message = refused(asked, material, temperature);
            assert!(message.contains(expected), "{message}");
        }
    }

    /// Of like bodies half of the modulus.
    #[test]
    fn closed_forms_are_of_a_rigid_counterface() {
        let source = LawSource::open("model:hertz", Some(&STEEL), None, false).unwrap();
        let refusal = |asked: &[(&str, f64)]| {
            let asked = asked.iter().map(|&(key, value)| (key.to_owned(), value)).collect();
            source.check_counterface("model:hertz", &asked).err().map(|error| error.to_string())
        };
        assert_eq!(refusal(&[]), None);
        assert_eq!(refusal(&[("thermal_conductivity", 40.0)]), None);
        let said = refusal(&[("youngs_modulus", 200e9), ("poisson_ratio", 0.3)]).unwrap();
        assert!(said.contains("youngs_modulus = 1.0000e11"), "{said}");
    }

    #[test]
    fn an_interface_that_is_not_as_strong_as_the_metal_is_named() {
        let found = |keys: &str| other_interface(&format!("[interface]\n{keys}").parse().unwrap());
        let usual = "law = \"shear-strength\"\nstrength = \"initial\"\nstrength_factor = 1.0\ncap = true";
        assert_eq!(found(usual), None);
        assert_eq!(found("law = \"coulomb\"\nfriction = 0.1"), Some("law = \"coulomb\"".into()));
        assert_eq!(found("strength_factor = 0.5"), Some("strength_factor = 0.5".into()));
    }

    #[test]
    fn a_table_of_another_counterface_is_refused() {
        let like = "youngs_modulus = 205000000000.0, poisson_ratio = 0.29, contact_conductance = inf";
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("counterface.nc");
        let refusal = |counterface: &str, asked: &[(&str, f64)]| {
            let metadata = Metadata { counterface: counterface.into(), ..Metadata::default() };
            table(&[1.0], &[0], 2.0, metadata).write(&path).unwrap();
            let source = LawSource::open(path.to_str().unwrap(), None, None, false).unwrap();
            let asked = asked.iter().map(|&(key, value)| (key.to_owned(), value)).collect();
            source.check_counterface("it", &asked).err().map(|error| error.to_string())
        };
        let steel = [("youngs_modulus", 205.1e9), ("poisson_ratio", 0.29)];
        assert_eq!(refusal(like, &steel), None);
        assert_eq!(refusal("", &[]), None);
        let without_expansion = [steel[0], steel[1], ("thermal_expansion", 0.0)];
        assert_eq!(refusal(like, &without_expansion), None);
        assert_eq!(refusal(&format!("{like}, thermal_expansion = 0.0"), &steel), None);
        assert!(refusal(&format!("{like}, thermal_expansion = 1.2e-5"), &steel).is_some());
        for (counterface, asked, expected) in [
            (
                like,
                &[][..],
                "poisson_ratio = 0.29, contact_conductance = inf; the section [counterface] of the surface file is empty",
            ),
            (like, &steel[..1], "file has youngs_modulus = 2.051e11"),
            (like, &[("youngs_modulus", 200e9), ("poisson_ratio", 0.29)], "youngs_modulus = 2e11"),
            (like, &[steel[0], steel[1], ("density", 7850.0)], "density = 7.85e3"),
            ("", &steel, "--table it: its counterface is rigid and isothermal; "),
        ] {
            let message = refusal(counterface, asked).unwrap();
            assert!(message.contains(expected), "{message}");
        }
    }
}
