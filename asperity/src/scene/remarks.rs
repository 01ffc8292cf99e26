//! What is worth knowing about a scene before it is run: implausible values, strengths that make the result depend on
//! the mesh, defaults in effect.

use std::collections::HashMap;

use tables::closed_forms::hertz::yield_coefficient;
use tables::numbers::{digits, plain, rounded};
use tables::quantity::{plausible, values_by_path};
use toml::{Table, Value};

use crate::scene::fitted_constants::localised_shear;
use crate::scene::loading::{default_slip_distance, default_temperature};
use crate::scene::{
    FractureData, FrictionLaw, Hardening, Interface, InterfaceStrength, Loading, Material, Model, Numerics,
    Rate, Scene, Softening, presets,
};

/// Linear hardening modulus over yield strength that is suggested where none is given: within the range 0.35 to 4.5 of
/// B/A of Johnson and Cook's law for the metals among the presets.
const MODULUS_SUGGESTED: f64 = 1.5;

/// Paths of the optional keys, or of their sections.
const OPTIONAL: [&str; 9] = [
    "material.hardening",
    "material.rate",
    "material.softening",
    "interface",
    "loading.slip_distance",
    "loading.control",
    "loading.temperature",
    "model",
    "numerics",
];

impl Scene {
    /// Warnings, a sentence each.
    pub fn remarks(&self) -> Vec<String> {
        let document = Table::try_from(self).expect("a scene is plain data");
        self.remarks_with(&document)
    }

    /// Those of values that are probably in another unit.
    pub fn implausible(&self) -> Vec<String> {
        plausible::remarks(&Table::try_from(self).expect("a scene is plain data"))
    }

    /// All, with the implausible values of a document made from the scene.
    pub(crate) fn remarks_with(&self, document: &Table) -> Vec<String> {
        let strength = self.equal_strength().into_iter().chain(self.reference_temperature());
        let strength = strength.chain(self.tensile_strength());
        strength.chain(self.without_effect()).chain(plausible::remarks(document)).collect()
    }

    /// A tensile strength below the yield strength.
    fn tensile_strength(&self) -> Option<String> {
        let yielding = self.material.yield_strength;
        match self.material.fracture {
            Some(FractureData::Tensile { tensile_strength: strength, .. }) if strength < yielding => {
                Some(format!(
                    "material.tensile_strength = {} Pa is below yield_strength = {} Pa: an engineering tensile strength is not",
                    plain(strength),
                    plain(yielding)
                ))
            }
            _ => None,
        }
    }

    /// Values other than the default that change nothing in this scene.
    fn without_effect(&self) -> Vec<String> {
        let Interface { ref law, strength_factor, heat_partition, .. } = self.interface;
        let default = Interface::default();
        let unlimited = !matches!(law, FrictionLaw::ShearStrength) && !law.has_cap();
        let strength = (unlimited && strength_factor != default.strength_factor).then(|| {
            format!(
                "interface.strength_factor = {strength_factor} has no effect: the strength of the material does not limit \
                 friction by the law of this scene"
            )
        });
        let partition = (self.partition_is_result() && heat_partition != default.heat_partition).then(|| {
            format!(
                "interface.heat_partition = {heat_partition} has no effect: beside a counterface that conducts heat without \
                 a finite contact_conductance the heat partition is a result"
            )
        });
        strength.into_iter().chain(partition).collect()
    }

    /// Whether the temperature is continuous at a conducting counterface.
    fn partition_is_result(&self) -> bool {
        self.counterface.conduction().is_some() && self.counterface.contact_conductance.is_infinite()
    }

    /// Body and interface are equally strong, and the body does not harden.
    fn equal_strength(&self) -> Option<String> {
        let perfect = self.material.hardening.plateau() == f64::INFINITY;
        let law = &self.interface.law;
        let weaker = match law.has_cap() || law.film(self.loading.temperature).is_none() {
            true => "[interface] strength_factor below 1",
            false => "an interface weaker than the material",
        };
        (perfect && self.interface_as_strong()).then(|| {
            let modulus = digits(MODULUS_SUGGESTED * self.material.yield_strength, 1);
            format!(
                "the material does not harden and the interface is as strong as the material: shear may localise in \
                 one layer of elements, mu then follows the mesh and is accurate to 10 % at best; give [material] \
                 hardening = {{ law = \"linear\", modulus = {modulus} }} (Pa; a plausible value for this yield \
                 strength), or {weaker}"
            )
        })
    }

    /// Whether the interface is as strong as the body below it, which then shears: at the highest pressure, that of Hertz
    /// or the hardness of 3σ_Y (Tabor 1951), where its strength depends on it.
    pub(crate) fn interface_as_strong(&self) -> bool {
        const HARDNESS: f64 = 3.0;
        let Interface { ref law, strength_factor, .. } = self.interface;
        let body = self.material.elastic_plastic().shear_strength();
        let of_metal = strength_factor * body;
        let limit = match law.film(self.loading.temperature) {
            Some((film, coefficient)) => {
                let elastic =
                    yield_coefficient(self.material.poisson_ratio) * self.loading.interference.sqrt();
                let limit = film + coefficient * elastic.min(HARDNESS) * self.material.yield_strength;
                if law.has_cap() { limit.min(of_metal) } else { limit }
            }
            None if law.has_friction() => of_metal,
            None => 0.0,
        };
        limit >= body
    }

    /// Bounds of the errors where shear localises in one layer of elements under the interface at the plastic strain of a contact
    /// that sticks: the body yields, does not harden beyond the strength of the interface, and is no stronger than that.
    pub(crate) fn localised_shear(&self, plastic_strain: f64) -> Option<&'static localised_shear::Bounds> {
        let plateau = match self.interface.strength {
            InterfaceStrength::Initial => self.material.hardening.plateau(),
            InterfaceStrength::Current => f64::INFINITY,
        };
        let localises = self.interface_as_strong() && plastic_strain > 0.0 && plastic_strain <= plateau;
        localises.then_some(match plateau.is_finite() {
            true => &localised_shear::ON_PLATEAU,
            false => &localised_shear::WITHOUT_LIMIT,
        })
    }

    /// The yield strength, which of a preset holds where the softening factor is 1, is taken to hold at an initial temperature
    /// where it is not.
    fn reference_temperature(&self) -> Option<String> {
        const TOLERANCE: f64 = 0.01;
        let temperature = self.loading.temperature;
        let factor = self.material.softening.factor(temperature);
        if (factor - 1.0).abs() <= TOLERANCE {
            return None;
        }
        let said = format!(
            "yield_strength is taken to hold at loading.temperature = {temperature} K, where the softening factor is {factor:.3}"
        );
        let strength = plain(rounded(factor * self.material.yield_strength, 3));
        Some(match presets::all().iter().find(|preset| preset.has_strength_of(&self.material)) {
            Some(preset) => format!(
                "{said}; the constants of the preset \"{}\" hold where it is 1: use a table with table.temperature = [..] \
                 for other temperatures",
                preset.name
            ),
            None => format!("{said}; if it is the strength where that is 1, write {strength}"),
        })
    }

    /// Optional keys that have their default value, as in `material.softening.law = "none"`.
    pub fn defaults_in_effect(&self) -> Vec<String> {
        let (material, loading) = (self.material.clone(), self.loading.clone());
        let default = Scene {
            material: Material {
                hardening: Hardening::None,
                rate: Rate::None,
                softening: Softening::None,
                ..material
            },
            interface: Interface::default(),
            loading: Loading {
                // A programme has its own.
                slip_distance: if self.loading.steps.is_empty() { default_slip_distance() } else { f64::NAN },
                control: Default::default(),
                temperature: default_temperature(),
                ..loading
            },
            model: Model::default(),
            numerics: Numerics::default(),
            ..self.clone()
        };
        let [here, default] = [self, &default].map(|scene| Table::try_from(scene).expect("plain data"));
        let default: HashMap<String, &Value> = values_by_path(&default).into_iter().collect();
        let without_effect = |path: &str| path == "interface.heat_partition" && self.partition_is_result();
        let unchanged = |(path, here): (String, &Value)| {
            let default = default.get(&path).filter(|default| **default == here)?;
            (is_optional(&path) && !without_effect(&path)).then(|| format!("{path} = {default}"))
        };
        values_by_path(&here).into_iter().filter_map(unchanged).collect()
    }
}

fn is_optional(path: &str) -> bool {
    let within = |section: &&str| {
        path.strip_prefix(*section).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    OPTIONAL.iter().any(within)
}

#[cfg(test)]
mod tests {
    use crate::scene::file::parse_scene;
    use crate::scene::tests::of_preset;
    use tables::numbers::{plain, rounded};

    /// Brass from seven constants.
    const BRASS: &str = "[material]\nyoungs_modulus = 105e9\npoisson_ratio = 0.34\nyield_strength = 300e6\n\
                         thermal_conductivity = 120\nspecific_heat = 380\ndensity = 8500\nthermal_expansion = 2e-5\n\
                         [asperity]\nradius = 50e-6\n[loading]\ninterference = 10\nslip_rate = 2\n";

    fn scene_with(overrides: &[&str]) -> super::Scene {
        let overrides: Vec<String> = overrides.iter().map(|text| text.to_string()).collect();
        parse_scene(BRASS, "brass", &overrides).unwrap()
    }

    fn remarks(overrides: &[&str]) -> Vec<String> {
        scene_with(overrides).remarks()
    }

    #[test]
    fn a_material_without_hardening_draws_the_hardening_line_to_give() {
        let said = remarks(&[]);
        assert!(said.len() == 1 && said[0].contains("does not harden"), "{said:?}");
        let (_, line) = said[0].split_once("hardening = ").unwrap();
        let (line, _) = line.split_once(" (Pa").unwrap();
        for cure in [
            &*format!("material.hardening={line}"),
            "interface.strength_factor=0.9",
            "interface.law=frictionless",
        ] {
            assert_eq!(remarks(&[cure]), Vec::<String>::new(), "{cure}");
        }
        assert_eq!(remarks(&["interface.law=full-stick"]).len(), 1);
    }

    #[test]
    fn values_without_effect_are_named() {
        let hardens = "material.hardening={law=\"linear\", modulus=1e9}";
        let of = |more: &[&str]| remarks(&[&[hardens], more].concat());
        for law in ["full-stick", "frictionless"] {
            let said = of(&[&format!("interface.law={law}"), "interface.strength_factor=0.9"]);
            assert!(said.len() == 1 && said[0].contains("strength_factor = 0.9 has no effect"), "{said:?}");
        }
        let capped = of(&["interface.law=coulomb", "interface.strength_factor=0.9"]);
        assert_eq!(capped, Vec::<String>::new());
        let beside = ["counterface.preset=copper", "interface.heat_partition=0.3"];
        let said = of(&beside);
        assert!(said.len() == 1 && said[0].contains("heat_partition = 0.3 has no effect"), "{said:?}");
        let resistance = [&beside[..], &["counterface.contact_conductance=1e6"]].concat();
        assert_eq!(of(&resistance), Vec::<String>::new());
        let defaults = |more: &[&str]| scene_with(more).defaults_in_effect().join("\n");
        assert!(defaults(&[]).contains("interface.heat_partition"));
        assert!(!defaults(&beside[..1]).contains("interface.heat_partition"));
    }

    /// Those of a preset are of its reference temperature; own ones may be of any, which is asked.
    #[test]
    fn constants_of_a_preset_at_another_temperature_are_noticed() {
        let own = [
            "material.softening={law=\"johnson-cook\", reference=298, melting=1200, exponent=1}",
            "loading.temperature=700",
            "interface.strength_factor=0.9",
        ];
        let found = remarks(&own);
        assert!(found.len() == 1 && found[0].contains("= 700 K, where the softening"), "{found:?}");
        // (1200 - 700)/(1200 - 298) of the yield strength.
        let strength = scene_with(&own).material.yield_strength * 500.0 / 902.0;
        assert!(found[0].ends_with(&format!("write {}", plain(rounded(strength, 3)))), "{found:?}");
        let said = |set: &[&str]| of_preset("copper", set).remarks();
        assert!(
            said(&["loading.temperature=700"])[0].contains("of the preset \"copper\" hold where it is 1")
        );
        assert_eq!(said(&["loading.temperature=298"]), Vec::<String>::new());
        assert!(
            said(&["loading.temperature=700", "material.yield_strength=70e6"])[0]
                .contains("where that is 1, write")
        );
    }

    /// An engineering tensile strength is that at the largest load.
    #[test]
    fn a_tensile_strength_below_yield_is_noticed() {
        let of = |strength: &str| {
            remarks(&[
                "material.hardening={law=\"linear\", modulus=1e9}",
                &format!("material.tensile_strength={strength}"),
                "material.uniform_elongation=0.2",
            ])
        };
        assert_eq!(of("400e6"), Vec::<String>::new());
        let said = of("200e6");
        assert!(said.len() == 1 && said[0].contains("below yield_strength = 3e8 Pa"), "{said:?}");
    }

    /// Plateau of the hardening, and plastic strains up to which shear localises.
    #[test]
    fn shear_localises_where_the_body_does_not_harden() {
        let table = "material.hardening={ law = \"table\", plastic_strain = [0, 0.01, 0.02, 0.1], factor = [1, 1, 1, 1.2] }";
        for (set, plateau) in [
            (vec![], f64::INFINITY),
            (vec![table], 0.02),
            // It falls and recovers; 1 % is no hardening.
            (
                vec![
                    "material.hardening={ law = \"table\", plastic_strain = [0, 0.01, 0.03, 0.1], factor = [1, 0.9, 1.01, 1.2] }",
                ],
                0.03,
            ),
            (vec!["material.hardening={ law = \"linear\", modulus = 1e9 }"], 0.0),
            (
                vec!["material.hardening={ law = \"linear\", modulus = 1e9 }", "interface.strength=current"],
                0.0,
            ),
        ] {
            let scene = scene_with(&set);
            assert_eq!(scene.material.hardening.plateau(), plateau, "{set:?}");
            let localises = |strain| scene.localised_shear(strain).is_some();
            let grows = set.len() == 2;
            assert_eq!(
                [0.0, 0.015, 0.5].map(localises),
                [false, plateau > 0.015 || grows, plateau > 0.5 || grows]
            );
        }
        assert!(scene_with(&["interface.strength_factor=0.9"]).localised_shear(0.01).is_none());
    }

    /// A film of 10 GPa with the strength of the metal as its limit is that strength; Coulomb's law reaches it where the
    /// pressure is high enough.
    #[test]
    fn other_laws_are_as_strong_as_the_body_where_their_limit_is() {
        let strong = |law: &[String], interference: f64| {
            let law = law.iter().map(String::as_str);
            let at = format!("loading.interference={interference}");
            scene_with(&law.chain([&*at]).collect::<Vec<_>>()).interface_as_strong()
        };
        let film = |strength: &str| {
            ["interface.law=briscoe-tabor".into(), format!("interface.film_strength={strength}")]
        };
        let coulomb =
            |friction: f64| ["interface.law=coulomb".to_owned(), format!("interface.friction={friction}")];
        assert!(strong(&film("1e10"), 1.0) && !strong(&film("1e7"), 1.0));
        // At first yield p0 is 1.6 and in a deep contact 3 times the yield strength: 1/sqrt(3) of it at 0.36 and 0.19.
        for (friction, interference, expected) in [
            (0.33, 1.0, false),
            (0.37, 1.0, true),
            (0.3, 0.5, false),
            (0.3, 100.0, true),
            (0.18, 100.0, false),
        ] {
            assert_eq!(strong(&coulomb(friction), interference), expected, "{friction} at {interference}");
        }
    }

    #[test]
    fn values_in_another_unit_are_named() {
        let said =
            remarks(&["material.density=8.5", "loading.temperature=25", "interface.strength_factor=0.9"]);
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(said[0].contains("g/cm3") && said[1].contains("degrees Celsius"), "{said:?}");
    }

    #[test]
    fn presets_are_plausible_and_their_hardening_spans_the_suggested_one() {
        let mut ratios = Vec::new();
        for name in crate::scene::presets::names() {
            let scene = of_preset(name, &[]);
            let said = scene.remarks();
            assert!(!said.iter().any(|said| said.contains("implausible")), "{name}: {said:?}");
            if let super::Hardening::JohnsonCook { modulus, .. } = scene.material.hardening {
                ratios.push(modulus / scene.material.yield_strength);
            }
        }
        assert!(ratios.iter().any(|ratio| *ratio < super::MODULUS_SUGGESTED));
        assert!(ratios.iter().any(|ratio| *ratio > super::MODULUS_SUGGESTED));
    }
}
