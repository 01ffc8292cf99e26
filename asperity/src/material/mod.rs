//! The material at a point: isotropic elasticity, J2 plasticity with isotropic hardening and thermal softening,
//! thermal expansion; moduli and expansion may depend on temperature.
//!
//! - `Solid`: σ_y(ε_p, ε̇_p, T) = [σ_Y + h(ε_p)] Λ(ε̇_p) f(T)/f(T₀), with h, Λ and f of the scene, E(T), ∫α dT;
//! - `elasticity`: bulk and shear modulus; Poisson's ratio is constant;
//! - `flow`, `return_map`: stress and plastic strain at the end of a step, `strain_rate`: Λ over it;
//! - `tensor`, `log_strain`, `log_moduli`: finite strain, E = ½ ln C and its derivatives;
//! - `lanes`: arithmetic on several angles at once, `elementary`: powers, exponentials and logarithms for it,
//!   `instruction_set`: kernels with the widest vector instructions of the processor.
//!
//! Depends on `crate::scene` alone. Stresses in units of σ_Y(T₀, ε_p = 0), temperatures as the rise θ = T − T₀ in
//! kelvin,
//! times in seconds. Chapters "One asperity" and "Integration of plastic flow" of the book.

pub(crate) mod elasticity;
pub mod elementary;
mod flow;
pub(crate) mod instruction_set;
pub(crate) mod lanes;
pub(crate) mod log_moduli;
pub(crate) mod log_strain;
mod return_map;
mod strain_rate;
pub(crate) mod tensor;

use tables::functions::interpolate;

use crate::material::elasticity::Moduli;
use crate::material::lanes::{Lanes, lanes, powers};
use crate::scene::curve::Curve;
use crate::scene::{Hardening, Material, Rate, Softening};
pub use flow::StrainPath;
pub use return_map::Trial;

/// 1/√3, von Mises' ratio of shear to tensile strength.
pub const SHEAR_RATIO: f64 = 0.577_350_269_189_625_8;

/// The material in dimensionless form.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Elastic moduli at the initial temperature.
    pub moduli: Moduli,
    /// E(T)/E(T₀) over the rise, unless constant.
    stiffness: Option<Curve>,
    expansion: Expansion,
    hardening: Hardening,
    /// Pa, the unit of stress.
    yield_strength: f64,
    rate: Rate,
    softening: Softening,
    /// K.
    initial_temperature: f64,
    /// f(T₀): strengths are relative to that at the initial temperature.
    initial_factor: f64,
}

/// f(T) of each temperature, K; the same as [`Softening::factor`].
#[inline(always)]
fn softening_of<const W: usize>(law: &Softening, temperature: &Lanes<W>) -> Lanes<W> {
    match law {
        Softening::None => [1.0; W],
        Softening::JohnsonCook { reference, melting, exponent } => {
            let homologous =
                lanes(|l| ((temperature[l] - reference) / (melting - reference)).clamp(0.0, 1.0));
            let power: Lanes<W> = powers(&homologous, *exponent);
            lanes(|l| 1.0 - power[l])
        }
        Softening::Table { temperature: knots, factor } => {
            temperature.map(|t| interpolate(knots, factor, t).0)
        }
    }
}

/// Thermal expansion coefficient dε/dT, 1/K.
#[derive(Clone, Debug)]
enum Expansion {
    Constant(f64),
    /// Over the rise.
    Varying(Curve),
}

impl Solid {
    pub fn new(material: &Material, initial_temperature: f64) -> Self {
        let mut solid = Self {
            moduli: Moduli::new(
                material.youngs_modulus.value / material.yield_strength,
                material.poisson_ratio,
            ),
            stiffness: material.youngs_modulus.table.as_ref().map(|e| e.relative(initial_temperature)),
            expansion: match &material.thermal_expansion.table {
                None => Expansion::Constant(material.thermal_expansion.value),
                Some(alpha) => Expansion::Varying(alpha.over_rise(initial_temperature)),
            },
            hardening: material.hardening.clone(),
            yield_strength: material.yield_strength,
            rate: material.rate,
            softening: material.softening.clone(),
            initial_temperature,
            initial_factor: 1.0,
        };
        solid.initial_factor = solid.softening_factor(0.0);
        solid
    }

    /// f(T)/f(T₀): 1 at the initial temperature, never negative.
    pub fn softening_factor(&self, rise: f64) -> f64 {
        self.softening_factors(&[rise])[0]
    }

    /// f(T)/f(T₀) at each rise.
    #[inline(always)]
    pub fn softening_factors<const W: usize>(&self, rise: &Lanes<W>) -> Lanes<W> {
        let factor: Lanes<W> = softening_of(&self.softening, &lanes(|l| self.initial_temperature + rise[l]));
        lanes(|l| factor[l] / self.initial_factor)
    }

    /// Lower bound of the softening factor for rises between `coldest`, evaluated only near yield, and `hottest`.
    pub fn lowest_softening_factor(&self, coldest: impl Fn() -> f64, hottest: f64) -> f64 {
        match &self.softening {
            // These do not rise.
            Softening::None | Softening::JohnsonCook { .. } => self.softening_factor(hottest),
            Softening::Table { temperature, factor } => {
                let coldest = coldest();
                let ends = self.softening_factor(coldest).min(self.softening_factor(hottest));
                let rises = temperature.iter().map(|t| t - self.initial_temperature);
                let between = rises.zip(factor).filter(|(rise, _)| (coldest..=hottest).contains(rise));
                between.fold(ends, |lowest, (_, factor)| lowest.min(factor / self.initial_factor))
            }
        }
    }

    /// Whether the elastic moduli depend on temperature.
    pub fn stiffness_varies(&self) -> bool {
        self.stiffness.is_some()
    }

    /// E(T)/E(T₀).
    pub fn stiffness_factor(&self, rise: f64) -> f64 {
        self.stiffness.as_ref().map_or(1.0, |curve| curve.value(rise))
    }

    /// Volumetric thermal strain 3∫α dT of each rise.
    #[inline(always)]
    pub fn thermal_dilatation<const W: usize>(&self, rise: &Lanes<W>) -> Lanes<W> {
        match &self.expansion {
            Expansion::Constant(alpha) => lanes(|l| 3.0 * alpha * rise[l]),
            Expansion::Varying(alpha) => rise.map(|rise| 3.0 * alpha.integral(rise)),
        }
    }

    /// Mean expansion coefficient between two rises, 1/K.
    pub fn mean_expansion(&self, from: f64, to: f64) -> f64 {
        match &self.expansion {
            Expansion::Constant(alpha) => *alpha,
            Expansion::Varying(alpha) if from == to => alpha.value(from),
            Expansion::Varying(alpha) => (alpha.integral(to) - alpha.integral(from)) / (to - from),
        }
    }

    /// (σ_y, dσ_y/dε_p) without softening.
    fn hardened(&self, strain: f64) -> (f64, f64) {
        let ([strength], [slope]) = self.hardened_lanes(&[strain]);
        (strength, slope)
    }

    /// (σ_y, dσ_y/dε_p) without softening, at each strain.
    #[inline(always)]
    fn hardened_lanes<const W: usize>(&self, strain: &Lanes<W>) -> (Lanes<W>, Lanes<W>) {
        match &self.hardening {
            Hardening::None => ([1.0; W], [0.0; W]),
            Hardening::Linear { modulus } => {
                let slope = modulus / self.yield_strength;
                (lanes(|l| 1.0 + slope * strain[l]), [slope; W])
            }
            Hardening::JohnsonCook { modulus, exponent } => {
                let b = modulus / self.yield_strength;
                // nBε^(n − 1) at ε = 0.
                let at_zero = if b > 0.0 { b * 0f64.powf(exponent - 1.0) } else { 0.0 };
                let power: Lanes<W> = powers(strain, *exponent);
                let power: Lanes<W> = lanes(|l| b * power[l]);
                let slope = lanes(|l| {
                    let slope = exponent * power[l] / strain[l];
                    if strain[l] <= 0.0 { at_zero } else { slope }
                });
                (lanes(|l| if strain[l] <= 0.0 { 1.0 } else { 1.0 + power[l] }), slope)
            }
            Hardening::Table { plastic_strain, factor } => {
                let values = strain.map(|strain| interpolate(plastic_strain, factor, strain));
                (values.map(|value| value.0), values.map(|value| value.1))
            }
        }
    }

    /// Λ, factor of the strength of an interface that slips at V (m/s) on a contact of radius a (m): at the strain rate
    /// V/a, or the reference without contact.
    pub fn interface_rate_factor(&self, slip_rate: f64, contact_radius: f64) -> f64 {
        if contact_radius > 0.0 { self.rate.factor(slip_rate / contact_radius) } else { 1.0 }
    }

    /// d ln Λ/d ln V of an interface that slips at V (m/s) on a contact of radius a (m).
    pub fn interface_rate_sensitivity(&self, slip_rate: f64, contact_radius: f64) -> f64 {
        if contact_radius > 0.0 { self.rate.sensitivity(slip_rate / contact_radius) } else { 0.0 }
    }

    /// Factor of the yield strength by plastic strain: σ_y(ε_p, T)/σ_y(0, T).
    pub fn hardening_factor(&self, strain: f64) -> f64 {
        self.hardened(strain).0
    }

    /// Current yield strength.
    pub fn yield_strength(&self, strain: f64, rise: f64) -> f64 {
        self.hardened(strain).0 * self.softening_factor(rise)
    }
}

#[cfg(test)]
pub(crate) mod tests;
