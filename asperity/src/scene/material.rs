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

/// A property in its unit, which may depend on temperature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "PropertyInFile", into = "PropertyInFile")]
pub struct Property {
    /// At the initial temperature.
    pub value: f64,
    /// None where the property is constant. Modulus, specific heat and conductivity vary in proportion to it.
    pub table: Option<TemperatureTable>,
}

/// A number, or a table over temperature.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum PropertyInFile {
    Constant(f64),
    Varying(TemperatureTable),
}

impl From<PropertyInFile> for Property {
    fn from(property: PropertyInFile) -> Self {
        match property {
            PropertyInFile::Constant(value) => value.into(),
            // Until the initial temperature is known.
            PropertyInFile::Varying(table) => Self { value: table.value[0], table: Some(table) },
        }
    }
}

impl From<Property> for PropertyInFile {
    fn from(property: Property) -> Self {
        property.table.map_or(Self::Constant(property.value), Self::Varying)
    }
}

/// A constant property.
impl From<f64> for Property {
    fn from(value: f64) -> Self {
        Self { value, table: None }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// E, Pa.
    pub youngs_modulus: Property,
    pub poisson_ratio: f64,
    /// σ_Y at the initial temperature and zero plastic strain, Pa.
    pub yield_strength: f64,
    #[serde(default)]
    pub hardening: Hardening,
    #[serde(default)]
    pub rate: Rate,
    /// ρ, kg/m³.
    pub density: f64,
    /// c, J/(kg K).
    pub specific_heat: Property,
    /// k, W/(m K).
    pub thermal_conductivity: Property,
    /// Coefficient dε/dT, 1/K.
    pub thermal_expansion: Property,
    #[serde(default)]
    pub softening: Softening,
    /// Fracture data in shear.
    #[serde(flatten)]
    pub fracture: Option<FractureData>,
}

impl Material {
    /// The material of the closed forms.
    pub fn elastic_plastic(&self) -> ElasticPlastic {
        ElasticPlastic {
            youngs_modulus: self.youngs_modulus.value,
            poisson_ratio: self.poisson_ratio,
            yield_strength: self.yield_strength,
        }
    }

    /// Thermal diffusivity κ = k/(ρc), m²/s.
    pub fn diffusivity(&self) -> f64 {
        self.thermal_conductivity.value / (self.density * self.specific_heat.value)
    }

    /// The properties that may depend on temperature.
    pub(crate) fn properties_mut(&mut self) -> [&mut Property; 4] {
        [
            &mut self.youngs_modulus,
            &mut self.specific_heat,
            &mut self.thermal_conductivity,
            &mut self.thermal_expansion,
        ]
    }
}
