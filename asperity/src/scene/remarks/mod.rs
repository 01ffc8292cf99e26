//! What is worth knowing about a scene before it is run: implausible values, strengths that make the result depend on
//! the mesh, defaults in effect.

use std::collections::HashMap;

use tables::closed_forms::adhesion::{ATOMIC_SPACING, CONTAMINATED_METALS, pull_off_force};
use tables::closed_forms::hertz::hertz_load;
use tables::numbers::{digits, plain, rounded};
use tables::quantity::{plausible, values_by_path};
use toml::{Table, Value};

use crate::scene::file::is_within;
use crate::scene::fitted_constants::localised_shear;
use crate::scene::loading::{default_slip_distance, default_temperature};
use crate::scene::presets::Preset;
use crate::scene::{
    Control, FractureData, Interface, InterfaceStrength, Loading, Scene, ShearLimit, Softening, Switch,
    presets,
};

/// Linear hardening modulus over yield strength that is suggested where none is given: within the range 0.35 to 4.5 of
/// B/A of Johnson and Cook's law for the metals among the presets.
const MODULUS_SUGGESTED: f64 = 1.5;

/// Over ω_c; the least that is plausible.
const SMALLEST_INTERFERENCE: f64 = 1e-4;

/// Interference over the radius beyond the contacts that the model describes.
const DEEP: f64 = 0.1;

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
    /// Sections of the scene as in a file: without the interference that follows from a load.
    pub(super) fn document(&self) -> Table {
        let mut sections = Table::try_from(self).expect("a scene is plain data");
        if self.loading.load.is_some()
            && let Some(Value::Table(loading)) = sections.get_mut("loading")
        {
            loading.remove("interference");
        }
        sections
    }

    /// Warnings, a sentence each.
    pub fn remarks(&self) -> Vec<String> {
        self.remarks_with(&self.document()).into_iter().chain(self.too_small()).collect()
    }

    /// Remarks on values that are probably in another unit.
    pub fn implausible(&self) -> Vec<String> {
        plausible::remarks(&self.document())
    }

    /// All, with the implausible values of a document made from the scene.
    pub(crate) fn remarks_with(&self, document: &Table) -> Vec<String> {
        let strength = self.equal_strength().into_iter().chain(self.reference_temperature());
        let strength =
            strength.chain(self.below_reference("loading.temperature")).chain(self.tensile_strength());
        strength
            .chain(self.softer_counterface())
            .chain(self.isothermal_counterface())
            .chain(self.without_effect())
            .chain(plausible::remarks(document))
            .chain(self.interference_in_metres())
            .chain(self.never_yields())
            .collect()
    }

    /// An interference so small that it is probably in metres.
    pub(super) fn interference_in_metres(&self) -> Option<String> {
        let Loading { interference, load: None, .. } = self.loading else { return None };
        let body = self.with_combined_modulus().material.elastic_plastic();
        let critical = body.critical_interference(self.radius);
        let written = interference / critical;
        (interference < SMALLEST_INTERFERENCE && written >= 1.0).then(|| {
            format!(
                "omega_c is {} m here; if loading.interference is in metres, write {}",
                digits(critical, 3),
                plain(rounded(written, 3))
            )
        })
    }

    /// A contact so small that surface forces govern it. The load at an interference is about that of an elastic sphere, or less.
    fn too_small(&self) -> Option<String> {
        let Loading { interference, load, .. } = self.loading;
        let body = self.with_combined_modulus().material.elastic_plastic();
        let depth = interference * body.critical_interference(self.radius);
        let load = load.unwrap_or(hertz_load(body.contact_modulus(), self.radius, depth));
        let pull_off = pull_off_force(CONTAMINATED_METALS, self.radius);
        if self.interference_in_metres().is_some() {
            return None;
        }
        if depth < ATOMIC_SPACING {
            return Some(format!(
                "the interference, about {} m, is below the distance between atoms, {} m: surface forces and atomic roughness, \
                 which the model leaves out, govern the contact",
                digits(depth, 2),
                plain(ATOMIC_SPACING)
            ));
        }
        (load < pull_off).then(|| {
            format!(
                "the load, about {} N, is below the pull-off force 2 pi w R = {} N with an energy of adhesion w of {} J/m2, that \
                 of contaminated metals: adhesion, which the model leaves out, presses the contact more than the load",
                digits(load, 2),
                digits(pull_off, 2),
                plain(CONTAMINATED_METALS)
            )
        })
    }

    /// A material that is elastic in every contact that the model describes.
    fn never_yields(&self) -> Option<String> {
        let critical = self.with_combined_modulus().material.elastic_plastic().critical_interference(1.0);
        (critical > DEEP).then(|| {
            format!(
                "the asperity would yield at an interference omega_c of {} of its radius, beyond the small contacts of the \
                 model: it stays elastic, and a counterface does not yield either, whatever its strength",
                digits(critical, 2)
            )
        })
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

    /// A metal that yields before the asperity does, taken for the counterface, which does not yield.
    fn softer_counterface(&self) -> Option<String> {
        let own = self.material.yield_strength;
        let of_preset = |preset: &Preset| Some((preset.name, preset.strength_of(&self.counterface)?));
        let (name, strength) =
            presets::all().iter().find_map(of_preset).filter(|(_, strength)| *strength < own)?;
        Some(format!(
            "the counterface has the constants of {name}, which yields at {} MPa, before the asperity, at {} MPa; no \
             counterface yields in this model, and pressure and friction are those of the harder body: make the softer one \
             the asperity",
            digits(1e-6 * strength, 3),
            digits(1e-6 * own, 3)
        ))
    }

    /// A counterface with elastic constants only.
    fn isothermal_counterface(&self) -> Option<String> {
        let heat = self.model.heat != Switch::Off && self.loading.first_slip_rate() != 0.0;
        let isothermal = !self.counterface.is_absent() && self.counterface.conduction().is_none();
        (heat && isothermal).then(|| {
            format!(
                "[counterface] stays at loading.temperature, and heat_partition = {} of the frictional heat enters the \
                 asperity: it has elastic constants only; with thermal_conductivity, density and specific_heat both \
                 are results",
                plain(self.interface.heat_partition)
            )
        })
    }

    /// Values other than the default that change nothing in this scene.
    fn without_effect(&self) -> Vec<String> {
        let Interface { ref law, strength_factor, heat_partition, .. } = self.interface;
        let default = Interface::default();
        let unlimited = !law.limit().capped;
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
        let weaker = match law.limit() {
            ShearLimit { capped: true, .. } => "[interface] strength_factor below 1",
            ShearLimit { film: Some(_), .. } => "an interface weaker than the material",
            ShearLimit { film: None, .. } => "law = \"shear-strength\" with strength_factor below 1",
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

    /// Whether the interface is as strong as the body below it, which then shears.
    pub(crate) fn interface_as_strong(&self) -> bool {
        let has_friction = self.interface.law.has_friction();
        has_friction && self.interface_strength(1.0) >= self.material.elastic_plastic().shear_strength()
    }

    /// Whether the interface hardens with the body.
    fn interface_hardens(&self) -> bool {
        let Interface { ref law, strength, .. } = self.interface;
        let hardens = self.material.hardening.plateau().is_finite();
        strength == InterfaceStrength::Current && hardens && law.limit().capped
    }

    /// Plastic strain up to which a body does not harden beyond an interface of its own initial strength.
    pub(crate) fn plateau_below_interface(&self) -> f64 {
        match self.interface.strength {
            InterfaceStrength::Initial => self.material.hardening.plateau(),
            InterfaceStrength::Current => f64::INFINITY,
        }
    }

    /// Bounds of the errors where shear localises in one layer of elements under the interface at the plastic strain of a contact
    /// that sticks: the body yields, does not harden beyond the strength of the interface, and is no stronger than that.
    pub(crate) fn localised_shear(&self, plastic_strain: f64) -> Option<&'static localised_shear::Bounds> {
        let plateau = self.plateau_below_interface();
        let localises = self.interface_as_strong() && plastic_strain > 0.0 && plastic_strain <= plateau;
        localises.then_some(match self.interface.strength {
            InterfaceStrength::Current if self.interface_hardens() => &localised_shear::HARDENING_INTERFACE,
            InterfaceStrength::Initial if plateau.is_finite() => &localised_shear::ON_PLATEAU,
            _ => &localised_shear::PERFECTLY_PLASTIC,
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
        // Where a user has followed the remark, to its digits.
        let mut as_written = self.material.clone();
        as_written.yield_strength /= factor;
        as_written.hardening.modulus_mut().into_iter().for_each(|modulus| *modulus /= factor);
        if presets::all().iter().any(|preset| preset.has_strength_near(&as_written)) {
            return None;
        }
        let said = format!(
            "yield_strength is taken to hold at loading.temperature = {temperature} K, where the softening factor is {factor:.3}"
        );
        let here = |constant: f64| plain(rounded(factor * constant, 3));
        let modulus = self.material.hardening.clone().modulus_mut().map(|modulus| here(*modulus));
        let modulus = modulus.map_or(String::new(), |modulus| format!(" and hardening.modulus = {modulus}"));
        let remedy = format!("write yield_strength = {}{modulus}", here(self.material.yield_strength));
        Some(match presets::all().iter().find(|preset| preset.has_strength_of(&self.material)) {
            Some(preset) => format!(
                "{said}; its value, that of the preset \"{}\", holds where it is 1: {remedy}, or use a table with three or more \
                 values of table.temperature",
                preset.name
            ),
            None => {
                let strength = plain(self.material.yield_strength);
                format!(
                    "{said}, as one measured at this temperature does; if {strength} Pa is the strength where the factor is 1, \
                     {remedy}"
                )
            }
        })
    }

    /// An initial temperature below that of the law of Johnson & Cook, which is constant there, as one in degrees Celsius is.
    pub(crate) fn below_reference(&self, key: &str) -> Option<String> {
        const FAR: f64 = 50.0;
        // Lower ones are implausible under any law.
        const LEAST: f64 = 77.0;
        let temperature = self.loading.temperature;
        let Softening::JohnsonCook { reference, .. } = self.material.softening else { return None };
        (LEAST..reference - FAR).contains(&temperature).then(|| {
            format!(
                "{key} = {} K is far below softening.reference = {} K and takes the strength there; if it is in \
                 degrees Celsius, write {}",
                plain(temperature),
                plain(reference),
                plain(temperature + 273.15)
            )
        })
    }

    /// Optional keys that have their default value, as in `material.softening.law = "none"`.
    pub fn defaults_in_effect(&self) -> Vec<String> {
        let mut default = self.clone();
        let Scene { material, interface, loading, model, numerics, .. } = &mut default;
        (material.hardening, material.rate, material.softening) = Default::default();
        (*interface, *model, *numerics) = Default::default();
        // A programme has its own.
        loading.slip_distance = if loading.steps.is_empty() { default_slip_distance() } else { f64::NAN };
        (loading.control, loading.temperature) = (Control::default(), default_temperature());
        let [here, default] = [self, &default].map(|scene| Table::try_from(scene).expect("plain data"));
        let default: HashMap<String, &Value> = values_by_path(&default).into_iter().collect();
        let without_effect = |path: &str| path == "interface.heat_partition" && self.partition_is_result();
        let unchanged = |(path, here): (String, &Value)| {
            let default = default.get(&path).filter(|default| **default == here)?;
            let is_optional = OPTIONAL.iter().any(|section| is_within(&path, section));
            (is_optional && !without_effect(&path)).then(|| format!("{path} = {default}"))
        };
        values_by_path(&here).into_iter().filter_map(unchanged).collect()
    }
}

#[cfg(test)]
mod tests;
