//! Input of a simulation: material, asperity, interface, loading, model and numerics, as plain data.
//!
//! - [`Scene`]: one run. SI units and kelvin throughout.
//! - [`presets`]: materials with published constants and their sources.
//! - [`file`](mod@file): scenes and table requests as TOML, read and written by serde.
//!
//! Depends on no other room of the crate. Chapters "Scene" and "Request of a table" of the book.

mod counterface;
pub(crate) mod curve;
pub mod file;
pub(crate) mod fitted_constants;
mod friction_law;
pub(crate) mod loading;
mod material;
pub mod presets;
mod remarks;
mod table_ranges;

use serde::{Deserialize, Serialize};
use tables::closed_forms::hertz::yield_coefficient;

pub use counterface::Counterface;
pub use friction_law::FrictionLaw;
pub(crate) use friction_law::{REMEDY_OF_LIGHT_CONTACT, ShearLimit};
pub use loading::{Control, Loading, LoadingStep};
pub use material::{FractureData, Hardening, Material, Property, Rate, Softening, TemperatureTable};

/// Which yield strength of the material the interface shears at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InterfaceStrength {
    /// Strength of the virgin material at the temperature of the contact: σ_Y(T).
    #[default]
    Initial,
    /// The flow stress σ_y(ε_p, T), with the mean plastic strain of the surface elements around
    /// the contact point: an interface that work-hardens with the metal below it.
    Current,
}

/// Section `[interface]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Interface {
    #[serde(flatten)]
    pub law: FrictionLaw,
    pub strength: InterfaceStrength,
    /// f_τ.
    pub strength_factor: f64,
    /// f_h, share of the frictional heat that enters the asperity.
    pub heat_partition: f64,
    /// h_g, conductance from the contact to a flat that does not conduct, W/(m² K).
    pub gap_conductance: f64,
    /// β, share of the plastic work that becomes heat.
    pub taylor_quinney: f64,
}

impl Default for Interface {
    fn default() -> Self {
        Self {
            law: FrictionLaw::default(),
            strength: InterfaceStrength::default(),
            strength_factor: 1.0,
            heat_partition: 0.5,
            gap_conductance: 0.0,
            taylor_quinney: 0.9,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Switch {
    #[default]
    Auto,
    On,
    Off,
}

/// Strain measure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kinematics {
    #[default]
    Auto,
    Small,
    Finite,
}

/// Section `[model]`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Model {
    pub heat: Switch,
    pub kinematics: Kinematics,
}

/// Range of n_c. The upper limit catches misprints before they exhaust the memory.
pub const ELEMENTS_PER_RADIUS: std::ops::RangeInclusive<usize> = 4..=256;

/// Section `[numerics]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Numerics {
    /// Relative; determines the settings that are not given.
    pub accuracy: f64,
    /// n_c.
    pub elements_per_radius: Option<usize>,
    /// N_θ over the half circle; a multiple of 4.
    pub sectors: Option<usize>,
}

impl Default for Numerics {
    fn default() -> Self {
        Self { accuracy: 0.02, elements_per_radius: None, sectors: None }
    }
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    pub material: Material,
    /// R, m.
    #[serde(rename = "asperity", with = "asperity_section")]
    pub radius: f64,
    pub interface: Interface,
    #[serde(skip_serializing_if = "Counterface::is_absent")]
    pub counterface: Counterface,
    pub loading: Loading,
    pub model: Model,
    pub numerics: Numerics,
}

/// Section `[asperity]`.
mod asperity_section {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Asperity {
        radius: f64,
    }

    pub fn serialize<S: Serializer>(radius: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        Asperity { radius: *radius }.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Asperity::deserialize(deserializer).map(|asperity| asperity.radius)
    }
}

impl Scene {
    /// Temperature that neither friction nor plastic flow heats the asperity beyond, as body and interface have no
    /// strength there, K; none where there is no such temperature.
    pub fn highest_temperature(&self) -> Option<f64> {
        let melting = self.material.softening.melting();
        melting.filter(|melting| {
            self.interface.law.heating_ends_at_melting() && *melting > self.loading.temperature
        })
    }

    /// Sections of the laws of softening, of metal and film.
    pub(crate) fn softenings(&self) -> [(&'static str, &Softening); 2] {
        [
            ("material.softening", &self.material.softening),
            ("interface.film_softening", self.interface.law.film_softening()),
        ]
    }

    /// Larger relative change of the strengths of metal and film from one temperature rise to another, K.
    pub fn softening_between(&self, from: f64, to: f64) -> f64 {
        let metal = |rise: f64| self.material.softening.factor(self.loading.temperature + rise);
        let film = |rise: f64| self.interface.law.film_softening().factor(self.loading.temperature + rise);
        let change = |before: f64, after: f64| if before > 0.0 { (1.0 - after / before).abs() } else { 0.0 };
        change(metal(from), metal(to)).max(change(film(from), film(to)))
    }

    /// Limit of the shear traction at the initial temperature, Pa: at the highest pressure, that of Hertz or the hardness of 3σ_Y
    /// (Tabor 1951), where it depends on it; that of the metal where no film limits it, which grows with the strain rate by `rate_factor`,
    /// and is that of the body where nothing limits it.
    pub(crate) fn interface_strength(&self, rate_factor: f64) -> f64 {
        const HARDNESS: f64 = 3.0;
        let Interface { ref law, strength_factor, .. } = self.interface;
        let factor = if law.limit().capped { strength_factor } else { 1.0 };
        let of_metal = factor * rate_factor * self.material.elastic_plastic().shear_strength();
        let Some((film, coefficient)) = law.film(self.loading.temperature) else { return of_metal };
        let elastic = yield_coefficient(self.material.poisson_ratio) * self.loading.interference.sqrt();
        let limit = film + coefficient * elastic.min(HARDNESS) * self.material.yield_strength;
        if law.limit().capped { limit.min(of_metal) } else { limit }
    }

    /// The scene with body and flat at another initial temperature, K: yield strength and hardening
    /// moduli are multiplied by the ratio of the softening factors (a table of hardening factors stays),
    /// properties with a table take their value there. Both softening factors must be above 0.
    ///
    /// Everything else is unchanged, including the fracture data and the strength of a film.
    pub fn at_temperature(&self, temperature: f64) -> Self {
        let mut scene = self.clone();
        let known = self.loading.temperature;
        if temperature == known {
            return scene;
        }
        let material = &mut scene.material;
        let ratio = material.softening.factor(temperature) / material.softening.factor(known);
        material.yield_strength *= ratio;
        if let Some(modulus) = material.hardening.modulus_mut() {
            *modulus *= ratio;
        }
        scene.loading.temperature = temperature;
        scene.evaluate_properties();
        scene
    }

    /// Sets the values of the properties that have a table to those at the initial temperature.
    fn evaluate_properties(&mut self) {
        let of_counterface = self.counterface.properties_mut().map(|(_, property)| property);
        for property in self.material.properties_mut().into_iter().chain(of_counterface) {
            if let Some(table) = &property.table {
                property.value = table.at(self.loading.temperature);
            }
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
