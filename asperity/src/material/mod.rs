//! Constitutive law: J2 plasticity with isotropic hardening and thermal softening, elastic moduli
//! and thermal expansion that may depend on temperature.
//!
//! σ_y(ε_p, T) = [σ_Y + h(ε_p)] f(T), with h and f of the scene. Bulk and shear modulus follow
//! Young's modulus, Poisson's ratio does not change. Stresses in units of σ_Y(T₀, ε_p = 0),
//! temperatures as the rise θ = T − T₀ in kelvin.

pub(crate) mod lanes;

use crate::discretisation::elastic::Moduli;
use crate::material::lanes::{Lanes, powers};
use crate::scene::curve::{Curve, interpolate};
use crate::scene::{Hardening, Material, Softening};

mod flow;
mod return_map;

pub use flow::StrainPath;
use return_map::Trial;

/// 1/√3, von Mises' ratio of shear to tensile strength.
pub const SHEAR_RATIO: f64 = 0.577_350_269_189_625_8;

/// The material in dimensionless form.
#[derive(Clone, Debug)]
pub struct Solid {
    /// At the initial temperature.
    pub moduli: Moduli,
    /// E(T)/E(T₀) over the rise, unless constant.
    stiffness: Option<Curve>,
    expansion: Expansion,
    hardening: Hardening,
    /// Pa, the unit of stress.
    yield_strength: f64,
    softening: Softening,
    /// K.
    initial_temperature: f64,
    /// f(T₀): strengths are relative to that at the initial temperature.
    initial_factor: f64,
}

/// f(T) of each temperature, K; the same as [`Softening::factor`].
fn softening_of<const W: usize>(law: &Softening, temperature: &Lanes<W>) -> Lanes<W> {
    match law {
        Softening::None => [1.0; W],
        Softening::JohnsonCook { reference, melting, exponent } => {
            let homologous = temperature.map(|t| ((t - reference) / (melting - reference)).clamp(0.0, 1.0));
            powers(&homologous, *exponent).map(|power| 1.0 - power)
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
            moduli: Moduli::new(material.youngs_modulus / material.yield_strength, material.poisson_ratio),
            stiffness: material.dependence.youngs_modulus.as_ref().map(|e| e.relative(initial_temperature)),
            expansion: match &material.dependence.thermal_expansion {
                None => Expansion::Constant(material.thermal_expansion),
                Some(alpha) => Expansion::Varying(alpha.over_rise(initial_temperature)),
            },
            hardening: material.hardening.clone(),
            yield_strength: material.yield_strength,
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

    /// The same of each rise.
    pub fn softening_factors<const W: usize>(&self, rise: &Lanes<W>) -> Lanes<W> {
        let temperature = rise.map(|rise| self.initial_temperature + rise);
        softening_of(&self.softening, &temperature).map(|factor| factor / self.initial_factor)
    }

    /// Lower bound of the softening factor for rises between `coldest`, which is asked for where it
    /// matters, and `hottest`.
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
    pub fn thermal_dilatation<const W: usize>(&self, rise: &Lanes<W>) -> Lanes<W> {
        match &self.expansion {
            Expansion::Constant(alpha) => rise.map(|rise| 3.0 * alpha * rise),
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

    /// The same of each strain.
    fn hardened_lanes<const W: usize>(&self, strain: &Lanes<W>) -> (Lanes<W>, Lanes<W>) {
        match &self.hardening {
            Hardening::None => ([1.0; W], [0.0; W]),
            Hardening::Linear { modulus } => {
                let slope = modulus / self.yield_strength;
                (strain.map(|strain| 1.0 + slope * strain), [slope; W])
            }
            Hardening::JohnsonCook { modulus, exponent } => {
                let b = modulus / self.yield_strength;
                let at_zero = if *exponent < 1.0 { f64::INFINITY } else { b };
                let power = powers(strain, *exponent).map(|power| b * power);
                let slope = std::array::from_fn(|l| match strain[l] <= 0.0 {
                    true => at_zero,
                    false => exponent * power[l] / strain[l],
                });
                (std::array::from_fn(|l| if strain[l] <= 0.0 { 1.0 } else { 1.0 + power[l] }), slope)
            }
            Hardening::Table { plastic_strain, factor } => {
                let values = strain.map(|strain| interpolate(plastic_strain, factor, strain));
                (values.map(|value| value.0), values.map(|value| value.1))
            }
        }
    }

    /// Growth of the yield strength with plastic strain: σ_y(ε_p, T)/σ_y(0, T).
    pub fn hardening_factor(&self, strain: f64) -> f64 {
        self.hardened(strain).0
    }

    /// Current yield strength.
    pub fn yield_strength(&self, strain: f64, rise: f64) -> f64 {
        self.hardened(strain).0 * self.softening_factor(rise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steel(hardening: Hardening) -> Solid {
        let material = Material {
            youngs_modulus: 205e9,
            poisson_ratio: 0.29,
            yield_strength: 792e6,
            hardening,
            density: 7850.0,
            specific_heat: 475.0,
            thermal_conductivity: 44.5,
            thermal_expansion: 1.23e-5,
            softening: Softening::JohnsonCook { reference: 298.0, melting: 1793.0, exponent: 1.03 },
            fracture: None,
            dependence: Default::default(),
        };
        Solid::new(&material, 298.0)
    }

    /// (increment, strength, slope) of one lane; the others, of points that do not flow or do so otherwise, shall
    /// make no difference.
    fn returned(solid: &Solid, trial: f64, strain: f64, factor: f64, guess: f64) -> [f64; 3] {
        let strength = solid.yield_strength(strain, 0.0);
        let of = |value: f64, other: f64| [value, value, other, value];
        let trials = Trial {
            flowing: [true, false, true, true],
            stress: of(trial, 1.5 * trial),
            strain: of(strain, 1e-3),
            strength: of(strength, solid.yield_strength(1e-3, 0.0)),
            softening: of(factor, 0.7),
            guess: of(guess, 0.0),
        };
        let end = solid.return_map(&trials);
        assert_eq!((end.increment[1], end.strength[1]), (0.0, strength));
        assert_eq!((end.increment[0], end.slope[0]), (end.increment[3], end.slope[3]));
        let alone = solid.return_map(&Trial {
            flowing: [true],
            stress: [trial],
            strain: [strain],
            strength: [strength],
            softening: [factor],
            guess: [guess],
        });
        let close = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-9 * a.abs();
        assert!(close(alone.increment[0], end.increment[0]), "{alone:?} {end:?}");
        [end.increment[0], end.strength[0], end.slope[0]]
    }

    #[test]
    fn return_map_ends_on_the_yield_surface() {
        let laws = [
            Hardening::None,
            Hardening::Linear { modulus: 2e9 },
            Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 },
            Hardening::Table { plastic_strain: vec![0.0, 0.01, 0.3], factor: vec![1.0, 1.2, 1.5] },
            Hardening::Table { plastic_strain: vec![0.0, 0.01, 0.3], factor: vec![1.0, 0.9, 0.1] },
        ];
        for law in laws {
            let solid = steel(law);
            for strain in [0.0, 1e-9, 1e-4, 0.2] {
                for rise in [0.0, 300.0, 1400.0] {
                    for (overshoot, guess) in [(1e-9, 0.0), (1e-4, 1e-3), (0.1, 1e-7), (10.0, 0.02)] {
                        let trial = solid.yield_strength(strain, rise) * (1.0 + overshoot);
                        let factor = solid.softening_factor(rise);
                        let [increment, end, _] = returned(&solid, trial, strain, factor, guess);
                        assert!(increment >= 0.0);
                        let exact = solid.yield_strength(strain + increment, 0.0);
                        assert!((end / exact - 1.0).abs() < 1e-12, "{end} {exact}");
                        let q = trial - 3.0 * solid.moduli.shear * increment;
                        let strength = solid.yield_strength(strain + increment, rise);
                        assert!(
                            (q - strength).abs() < 1e-12 * trial,
                            "{solid:?} {strain} {rise} {overshoot}"
                        );
                    }
                }
            }
        }
    }

    /// A table that rises and falls again: the bound holds for every temperature in between.
    #[test]
    fn lowest_softening_factor_is_a_lower_bound() {
        let mut solid = steel(Hardening::None);
        let laws = [
            Softening::JohnsonCook { reference: 298.0, melting: 1793.0, exponent: 0.8 },
            Softening::Table {
                temperature: vec![250.0, 298.0, 400.0, 500.0, 700.0],
                factor: vec![0.9, 1.0, 0.7, 1.1, 0.2],
            },
        ];
        for law in laws {
            solid.softening = law;
            for (coldest, hottest) in [(0.0, 50.0), (-60.0, 0.0), (0.0, 202.0), (50.0, 180.0), (0.0, 3000.0)]
            {
                let bound = solid.lowest_softening_factor(|| coldest, hottest);
                let lowest = (0..=1000)
                    .map(|i| solid.softening_factor(coldest + (hottest - coldest) * i as f64 / 1000.0))
                    .fold(f64::INFINITY, f64::min);
                assert!(bound <= lowest && bound > lowest - 0.01, "{bound} {lowest}");
            }
        }
    }

    /// Exponents below one fall steeply at once, and end at zero at the melting point.
    #[test]
    fn johnson_cook_softening_is_finite_everywhere() {
        let mut solid = steel(Hardening::JohnsonCook { modulus: 331e6, exponent: 0.34 });
        for exponent in [0.1, 0.8, 1.0, 3.0] {
            solid.softening = Softening::JohnsonCook { reference: 298.0, melting: 1878.0, exponent };
            let mut last = 1.0;
            for rise in [-200.0, 0.0, 1e-300, 1e-9, 1.0, 500.0, 1579.999, 1580.0, 1e4, 1e300] {
                let factor = solid.softening_factor(rise);
                assert!(factor <= last && (0.0..=1.0).contains(&factor), "{exponent} {rise} {factor}");
                last = factor;
                for trial in [1e-12, 0.5, 3.0, 1e6] {
                    if trial > factor {
                        let [increment, _, slope] = returned(&solid, trial, 0.0, factor, 0.0);
                        assert!(increment.is_finite() && increment >= 0.0 && slope >= 0.0, "{rise} {trial}");
                    }
                }
            }
            assert_eq!(last, 0.0);
        }
    }

    #[test]
    fn molten_material_has_no_strength() {
        let solid = steel(Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 });
        assert_eq!(solid.yield_strength(0.0, 1495.0), 0.0);
        assert_eq!(solid.yield_strength(0.3, 1e5), 0.0);
        let [increment, _, slope] = returned(&solid, 1.0, 0.0, solid.softening_factor(2000.0), 0.0);
        assert!((increment * 3.0 * solid.moduli.shear - 1.0).abs() < 1e-12 && slope == 0.0);
    }
}
