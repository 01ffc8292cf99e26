//! What is simulated: material, asperity, interface, loading, model and numerics.
//! SI units and kelvin throughout; plain data, no files.

pub(crate) mod curve;
pub mod file;
pub mod presets;

pub use crate::interface::friction_law::FrictionLaw;
use crate::material::lanes::{Lanes, powers};
use crate::scene::curve::{Curve, interpolate};

/// Growth of the yield strength with equivalent plastic strain ε_p at the initial temperature.
#[derive(Clone, Debug, PartialEq)]
pub enum Hardening {
    None,
    /// σ_Y + modulus·ε_p; modulus in Pa.
    Linear {
        modulus: f64,
    },
    /// σ_Y + modulus·ε_p^exponent (Johnson & Cook 1985: B, n); modulus in Pa.
    JohnsonCook {
        modulus: f64,
        exponent: f64,
    },
    /// σ_Y·factor(ε_p), linear between the points, constant after the last.
    Table {
        plastic_strain: Vec<f64>,
        factor: Vec<f64>,
    },
}

/// Loss of yield strength with temperature, as a factor on the strength at the initial temperature.
#[derive(Clone, Debug, PartialEq)]
pub enum Softening {
    None,
    /// 1 − ((T − reference)/(melting − reference))^exponent, between 0 and 1 (Johnson & Cook 1985).
    JohnsonCook {
        reference: f64,
        melting: f64,
        exponent: f64,
    },
    /// factor(T), linear between the points, constant outside them.
    Table {
        temperature: Vec<f64>,
        factor: Vec<f64>,
    },
}

impl Softening {
    /// factor(T), T in K: never negative.
    pub fn factor(&self, temperature: f64) -> f64 {
        self.factors(&[temperature])[0]
    }

    /// The same of each temperature.
    pub(crate) fn factors<const W: usize>(&self, temperature: &Lanes<W>) -> Lanes<W> {
        match self {
            Self::None => [1.0; W],
            Self::JohnsonCook { reference, melting, exponent } => {
                let homologous =
                    temperature.map(|t| ((t - reference) / (melting - reference)).clamp(0.0, 1.0));
                powers(&homologous, *exponent).map(|power| 1.0 - power)
            }
            Self::Table { temperature: knots, factor } => {
                temperature.map(|t| interpolate(knots, factor, t).0)
            }
        }
    }
}

/// Where the shear fracture energy of a material comes from; see [`crate::simulate::fracture`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FractureData {
    /// G_IIc, J/m².
    Energy(f64),
    /// K_IIc, Pa√m.
    Toughness(f64),
    /// Tensile strength σ_u, Pa, and uniform elongation ε_u (engineering strain).
    Tensile { strength: f64, uniform_elongation: f64 },
}

/// A property over temperature, linear between the points, constant outside them. Two equal
/// temperatures make a jump.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TemperatureTable {
    /// K, not falling.
    pub temperature: Vec<f64>,
    /// In the unit of the property.
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

    /// The same, relative to the value at `initial`.
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

#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// E at the initial temperature, Pa.
    pub youngs_modulus: f64,
    pub poisson_ratio: f64,
    /// At the initial temperature and zero plastic strain, Pa.
    pub yield_strength: f64,
    pub hardening: Hardening,
    /// kg/m³.
    pub density: f64,
    /// c at the initial temperature, J/(kg K).
    pub specific_heat: f64,
    /// k at the initial temperature, W/(m K).
    pub thermal_conductivity: f64,
    /// Coefficient dε/dT at the initial temperature, 1/K.
    pub thermal_expansion: f64,
    pub softening: Softening,
    /// What is known of its fracture in shear.
    pub fracture: Option<FractureData>,
    pub dependence: TemperatureDependence,
}

impl Material {
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

/// Which yield strength of the material the interface shears at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterfaceStrength {
    /// That of the virgin material at the temperature of the contact: σ_Y(T).
    Initial,
    /// The flow stress σ_y(ε_p, T), with the mean plastic strain of the surface elements around
    /// the contact point: an interface that work-hardens with the metal below it.
    Current,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    pub law: FrictionLaw,
    pub strength: InterfaceStrength,
    /// f_τ.
    pub strength_factor: f64,
    /// f_h, share of the frictional heat that enters the asperity.
    pub heat_partition: f64,
    /// h_g, W/(m² K).
    pub gap_conductance: f64,
    /// β, share of the plastic work that becomes heat.
    pub taylor_quinney: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    Interference,
    Load,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Loading {
    /// ω₀/ω_c.
    pub interference: f64,
    /// V, m/s; 0 is the isothermal limit.
    pub slip_rate: f64,
    /// In contact radii a₀ at the end of the press.
    pub slip_distance: f64,
    pub control: Control,
    /// Of body and flat at the start, K.
    pub temperature: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Switch {
    Auto,
    On,
    Off,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinematics {
    Auto,
    Small,
    Finite,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub heat: Switch,
    pub kinematics: Kinematics,
}

/// n_c that a scene may ask for.
pub const ELEMENTS_PER_RADIUS: std::ops::RangeInclusive<usize> = 4..=256;

#[derive(Clone, Debug, PartialEq)]
pub struct Numerics {
    /// Relative; chooses what is not given.
    pub accuracy: f64,
    /// n_c.
    pub elements_per_radius: Option<usize>,
    /// N_θ over the half circle; a multiple of 4.
    pub sectors: Option<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub material: Material,
    /// R, m.
    pub radius: f64,
    pub interface: Interface,
    pub loading: Loading,
    pub model: Model,
    pub numerics: Numerics,
}

impl Scene {
    /// The scene with body and flat at another initial temperature, K: yield strength and hardening
    /// moduli are multiplied by the ratio of the softening factors (a table of hardening factors stays),
    /// properties with a table take their value there. Both softening factors must be above 0.
    ///
    /// All else stays, what is known of fracture and the strength of a film among it.
    ///
    /// ```
    /// use asperity::scene::file::parse_scene;
    ///
    /// let text = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
    ///             [loading]\ninterference = 5\nslip_rate = 1\n";
    /// let cold = parse_scene(text, "this example", &[])?;
    /// let hot = cold.at_temperature(600.0);
    /// assert_eq!(hot.loading.temperature, 600.0);
    /// let factor = |temperature| cold.material.softening.factor(temperature);
    /// let expected = cold.material.yield_strength * factor(600.0) / factor(298.0);
    /// assert!((hot.material.yield_strength / expected - 1.0).abs() < 1e-12);
    /// # Ok::<(), asperity::scene::file::SceneFileError>(())
    /// ```
    pub fn at_temperature(&self, temperature: f64) -> Self {
        let mut scene = self.clone();
        let known = self.loading.temperature;
        if temperature == known {
            return scene;
        }
        let material = &mut scene.material;
        let ratio = material.softening.factor(temperature) / material.softening.factor(known);
        material.yield_strength *= ratio;
        match &mut material.hardening {
            Hardening::Linear { modulus } | Hardening::JohnsonCook { modulus, .. } => *modulus *= ratio,
            Hardening::None | Hardening::Table { .. } => {}
        }
        material.evaluate_at_temperature(temperature);
        scene.loading.temperature = temperature;
        scene
    }

    /// A sentence where the constants, which hold at the initial temperature, are hardly those that the softening law
    /// has there: those of a preset hold at its reference temperature. To be asked of scenes as they are read.
    pub fn strength_elsewhere(&self) -> Option<String> {
        const NONE: f64 = 0.01;
        let temperature = self.loading.temperature;
        let factor = self.material.softening.factor(temperature);
        ((factor - 1.0).abs() > NONE).then(|| {
            format!(
                "yield_strength is taken to hold at loading.temperature, {temperature} K, where the softening law \
                 gives {factor:.3} of its strength; if the constants hold where that is 1, as those of presets do, a \
                 table with table.temperature = [..] has them at other temperatures"
            )
        })
    }
}

#[cfg(test)]
mod tests;
