//! Section `[material]`: constants, and laws of hardening, softening and fracture.

use serde::{Deserialize, Serialize};
use tables::closed_forms::ElasticPlastic;
use tables::functions::interpolate;

use crate::scene::curve::Curve;

/// Growth of the yield strength with equivalent plastic strain ε_p at the initial temperature.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Hardening {
    #[default]
    None,
    /// σ_Y + modulus·ε_p; modulus in Pa.
    Linear { modulus: f64 },
    /// σ_Y + modulus·ε_p^exponent (Johnson & Cook 1985: B, n); modulus in Pa.
    JohnsonCook { modulus: f64, exponent: f64 },
    /// σ_Y·factor(ε_p), linear between the points, constant after the last.
    Table { plastic_strain: Vec<f64>, factor: Vec<f64> },
}

impl Hardening {
    /// Modulus of the laws that have one, Pa: it changes with the initial temperature as the yield strength does.
    pub fn modulus_mut(&mut self) -> Option<&mut f64> {
        match self {
            Self::Linear { modulus } | Self::JohnsonCook { modulus, .. } => Some(modulus),
            Self::None | Self::Table { .. } => None,
        }
    }

    /// Whether the strength may fall with strain.
    pub fn may_fall(&self) -> bool {
        matches!(self, Self::Table { .. })
    }

    /// Plastic strain up to which the strength does not exceed the initial one; in a table, by more than 1 %.
    pub fn plateau(&self) -> f64 {
        const NO_RISE: f64 = 1.01;
        match self {
            Self::Linear { modulus } | Self::JohnsonCook { modulus, .. } if *modulus > 0.0 => 0.0,
            Self::None | Self::Linear { .. } | Self::JohnsonCook { .. } => f64::INFINITY,
            Self::Table { plastic_strain, factor } => {
                match factor.iter().rposition(|factor| *factor <= NO_RISE) {
                    Some(last) if last + 1 == factor.len() => f64::INFINITY,
                    Some(last) => plastic_strain[last],
                    None => 0.0,
                }
            }
        }
    }
}

/// Loss of yield strength with temperature, as a factor on the strength at the initial temperature.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Softening {
    #[default]
    None,
    /// 1 − ((T − reference)/(melting − reference))^exponent, between 0 and 1 (Johnson & Cook 1985);
    /// temperatures in K.
    JohnsonCook { reference: f64, melting: f64, exponent: f64 },
    /// factor(T), linear between the points, constant outside them.
    Table { temperature: Vec<f64>, factor: Vec<f64> },
}

impl Softening {
    /// factor(T), T in K: never negative.
    pub fn factor(&self, temperature: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::JohnsonCook { reference, melting, exponent } => {
                let homologous = (temperature - reference) / (melting - reference);
                1.0 - homologous.clamp(0.0, 1.0).powf(*exponent)
            }
            Self::Table { temperature: knots, factor } => interpolate(knots, factor, temperature).0,
        }
    }

    /// Temperature from which on no strength is left, K.
    pub fn melting(&self) -> Option<f64> {
        match self {
            Self::None => None,
            Self::JohnsonCook { melting, .. } => Some(*melting),
            Self::Table { temperature, factor } => {
                temperature.last().copied().filter(|_| factor.last() == Some(&0.0))
            }
        }
    }
}

/// Λ, factor of the yield strength by the equivalent plastic strain rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Rate {
    #[default]
    None,
    /// 1 + coefficient·ln(max(ε̇_p/reference, 1)) (Johnson & Cook 1983: C, ε̇₀); reference in 1/s.
    JohnsonCook { coefficient: f64, reference: f64 },
}

impl Rate {
    /// The factor at a strain rate, 1/s: 1 up to the reference.
    pub fn factor(&self, strain_rate: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::JohnsonCook { coefficient, reference } => {
                1.0 + coefficient * (strain_rate / reference).max(1.0).ln()
            }
        }
    }

    /// Derivative of the logarithm of the factor with respect to that of the strain rate (1/s).
    pub fn sensitivity(&self, strain_rate: f64) -> f64 {
        match self {
            Self::JohnsonCook { coefficient, reference } if strain_rate > *reference => {
                coefficient / self.factor(strain_rate)
            }
            _ => 0.0,
        }
    }
}

/// Where the shear fracture energy of a material comes from: keys of its section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum FractureData {
    /// G_IIc, J/m².
    Energy { shear_fracture_energy: f64 },
    /// K_IIc, Pa√m.
    Toughness { fracture_toughness_mode_ii: f64 },
    /// σ_u, Pa, and ε_u (engineering strain).
    Tensile { tensile_strength: f64, uniform_elongation: f64 },
}

/// A property over temperature, linear between the points, constant outside them. Two equal
/// temperatures make a jump.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TemperatureTable {
    /// K, not falling.
    pub temperature: Vec<f64>,
    /// Values in the unit of the property.
    pub value: Vec<f64>,
}

impl TemperatureTable {
    /// Value at a temperature in K.
    pub fn at(&self, temperature: f64) -> f64 {
        interpolate(&self.temperature, &self.value, temperature).0
    }

    /// Over the rise above `initial`, K.
    pub(crate) fn over_rise(&self, initial: f64) -> Curve {
        Curve::new(self.temperature.iter().map(|t| t - initial).collect(), self.value.clone())
    }

    /// Over the rise above `initial`, K, relative to the value at `initial`.
    pub(crate) fn relative(&self, initial: f64) -> Curve {
        let scale = self.at(initial);
        let values = self.value.iter().map(|value| value / scale).collect();
        Curve::new(self.temperature.iter().map(|t| t - initial).collect(), values)
    }
}

/// How properties change with temperature; those without a table are constant.
///
/// The fields of the same names in [`Material`] hold the values at the initial temperature, see
/// [`Material::evaluate_at_temperature`]. Modulus, specific heat and conductivity vary in proportion to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TemperatureDependence {
    pub youngs_modulus: Option<TemperatureTable>,
    pub specific_heat: Option<TemperatureTable>,
    pub thermal_conductivity: Option<TemperatureTable>,
    pub thermal_expansion: Option<TemperatureTable>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "MaterialSection", into = "MaterialSection")]
pub struct Material {
    /// E at the initial temperature, Pa.
    pub youngs_modulus: f64,
    pub poisson_ratio: f64,
    /// σ_Y at the initial temperature and zero plastic strain, Pa.
    pub yield_strength: f64,
    pub hardening: Hardening,
    pub rate: Rate,
    /// ρ, kg/m³.
    pub density: f64,
    /// c at the initial temperature, J/(kg K).
    pub specific_heat: f64,
    /// k at the initial temperature, W/(m K).
    pub thermal_conductivity: f64,
    /// Coefficient dε/dT at the initial temperature, 1/K.
    pub thermal_expansion: f64,
    pub softening: Softening,
    /// Fracture data in shear.
    pub fracture: Option<FractureData>,
    pub dependence: TemperatureDependence,
}

impl Material {
    /// The material of the closed forms.
    pub fn elastic_plastic(&self) -> ElasticPlastic {
        ElasticPlastic {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
            yield_strength: self.yield_strength,
        }
    }

    /// Thermal diffusivity κ = k/(ρc), m²/s.
    pub fn diffusivity(&self) -> f64 {
        self.thermal_conductivity / (self.density * self.specific_heat)
    }

    /// Sets the values at the initial temperature, K, of the properties that have a table.
    pub fn evaluate_at_temperature(&mut self, temperature: f64) {
        let tables = &self.dependence;
        for (value, table) in [
            (&mut self.youngs_modulus, &tables.youngs_modulus),
            (&mut self.specific_heat, &tables.specific_heat),
            (&mut self.thermal_conductivity, &tables.thermal_conductivity),
            (&mut self.thermal_expansion, &tables.thermal_expansion),
        ] {
            if let Some(table) = table {
                *value = table.at(temperature);
            }
        }
    }
}

/// The keys of the section as in a file.
#[derive(Serialize, Deserialize)]
struct MaterialSection {
    youngs_modulus: Property,
    poisson_ratio: f64,
    yield_strength: f64,
    #[serde(default)]
    hardening: Hardening,
    #[serde(default)]
    rate: Rate,
    density: f64,
    specific_heat: Property,
    thermal_conductivity: Property,
    thermal_expansion: Property,
    #[serde(default)]
    softening: Softening,
    #[serde(flatten)]
    fracture: Option<FractureData>,
}

/// A number, or a table over temperature.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Property {
    Constant(f64),
    Varying(TemperatureTable),
}

impl Property {
    /// The value, of a table the first until the initial temperature is known, and the table.
    pub(super) fn split(self) -> (f64, Option<TemperatureTable>) {
        match self {
            Self::Constant(value) => (value, None),
            Self::Varying(table) => (table.value[0], Some(table)),
        }
    }

    pub(super) fn join(value: f64, table: Option<TemperatureTable>) -> Self {
        table.map_or(Self::Constant(value), Self::Varying)
    }
}

impl From<MaterialSection> for Material {
    fn from(section: MaterialSection) -> Self {
        let (youngs_modulus, modulus_table) = section.youngs_modulus.split();
        let (specific_heat, heat_table) = section.specific_heat.split();
        let (thermal_conductivity, conductivity_table) = section.thermal_conductivity.split();
        let (thermal_expansion, expansion_table) = section.thermal_expansion.split();
        Self {
            youngs_modulus,
            poisson_ratio: section.poisson_ratio,
            yield_strength: section.yield_strength,
            hardening: section.hardening,
            rate: section.rate,
            density: section.density,
            specific_heat,
            thermal_conductivity,
            thermal_expansion,
            softening: section.softening,
            fracture: section.fracture,
            dependence: TemperatureDependence {
                youngs_modulus: modulus_table,
                specific_heat: heat_table,
                thermal_conductivity: conductivity_table,
                thermal_expansion: expansion_table,
            },
        }
    }
}

impl From<Material> for MaterialSection {
    fn from(material: Material) -> Self {
        let tables = material.dependence;
        Self {
            youngs_modulus: Property::join(material.youngs_modulus, tables.youngs_modulus),
            poisson_ratio: material.poisson_ratio,
            yield_strength: material.yield_strength,
            hardening: material.hardening,
            rate: material.rate,
            density: material.density,
            specific_heat: Property::join(material.specific_heat, tables.specific_heat),
            thermal_conductivity: Property::join(material.thermal_conductivity, tables.thermal_conductivity),
            thermal_expansion: Property::join(material.thermal_expansion, tables.thermal_expansion),
            softening: material.softening,
            fracture: material.fracture,
        }
    }
}
