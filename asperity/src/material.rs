//! Constitutive law: J2 plasticity with isotropic hardening and thermal softening, elastic moduli
//! and thermal expansion that may depend on temperature.
//!
//! σ_y(ε_p, T) = [σ_Y + h(ε_p)] f(T), with h and f of the scene. Bulk and shear modulus follow
//! Young's modulus, Poisson's ratio does not change. Stresses in units of σ_Y(T₀, ε_p = 0),
//! temperatures as the rise θ = T − T₀ in kelvin.

use crate::curve::{Curve, interpolate};
use crate::elastic::Moduli;
use crate::lanes::Lanes;
use crate::scene::{Hardening, Material, Softening};

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

/// Thermal expansion coefficient dε/dT, 1/K.
#[derive(Clone, Debug)]
enum Expansion {
    Constant(f64),
    /// Over the rise.
    Varying(Curve),
}

/// Result of a return mapping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// Increment of the equivalent plastic strain.
    pub increment: f64,
    /// Strength at the end, at the initial temperature.
    pub strength: f64,
    /// dσ_y/dε_p at the end.
    pub slope: f64,
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
        self.softening.factor(self.initial_temperature + rise) / self.initial_factor
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
        match &self.hardening {
            Hardening::None => (1.0, 0.0),
            Hardening::Linear { modulus } => {
                let slope = modulus / self.yield_strength;
                (1.0 + slope * strain, slope)
            }
            Hardening::JohnsonCook { modulus, exponent } => {
                let b = modulus / self.yield_strength;
                if strain <= 0.0 {
                    return (1.0, if *exponent < 1.0 { f64::INFINITY } else { b });
                }
                let power = b * strain.powf(*exponent);
                (1.0 + power, exponent * power / strain)
            }
            Hardening::Table { plastic_strain, factor } => interpolate(plastic_strain, factor, strain),
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

    /// Radial return: the increment x with q − 3Gx = factor·σ_y(ε_p + x, T₀), for a trial von Mises
    /// stress q above the yield strength; `factor` is that of softening. G is that of T₀: where the
    /// moduli have changed, q and the factor are relative to E(T)/E(T₀).
    ///
    /// The residual falls and is convex where hardening is concave, so Newton's method started
    /// left of the root never passes it; for a power law with its infinite first slope the start
    /// is where the elastic and the hardening part each take up half of the excess. A bracket
    /// guards against laws that are not concave.
    ///
    /// `strength` is σ_y(ε_p, T₀), `guess` a first guess of the increment, 0 if there is none.
    pub fn return_map(&self, trial: f64, strain: f64, strength: f64, factor: f64, guess: f64) -> Return {
        let stiffness = 3.0 * self.moduli.shear;
        let excess = trial - factor * strength;
        if excess <= 0.0 {
            return Return { increment: 0.0, strength, slope: factor * self.hardened(strain).1 };
        }
        // A hardening that falls lets the increment be larger than that at the present strength.
        let most = if let Hardening::Table { .. } = self.hardening { trial } else { excess };
        let (mut low, mut high) = (0.0, most / stiffness);
        let mut x = match &self.hardening {
            _ if guess > 0.0 && guess < high => guess,
            Hardening::JohnsonCook { modulus, exponent } if strain <= 0.0 && factor > 0.0 => {
                let b = factor * modulus / self.yield_strength;
                (0.5 * excess / b).powf(1.0 / exponent).min(0.5 * high)
            }
            _ => 0.0,
        };
        // A power law is smooth: an error e goes to less than e²/2(ε_p + x), so that the iteration
        // before the last tells how exact that will be, without a further power.
        let smooth = matches!(self.hardening, Hardening::JohnsonCook { .. });
        let mut end = None;
        for _ in 0..100 {
            let (strength, slope) = self.hardened(strain + x);
            let residual = trial - stiffness * x - factor * strength;
            if residual >= 0.0 {
                low = x;
            } else {
                high = x;
            }
            let step = residual / (stiffness + factor * slope);
            let next = x + step;
            let inside = next >= low && next <= high;
            let converged = step.abs() <= 1e-13 * (x.abs() + step.abs())
                || residual.abs() <= 1e-15 * trial
                || (smooth && inside && step * step <= 1e-13 * next.min(x) * (strain + next.min(x)));
            x = if inside { next } else { 0.5 * (low + high) };
            if converged {
                // To first order, and with the curvature left out of the slope alone.
                end = (smooth && inside && slope.is_finite()).then_some((strength + slope * step, slope));
                break;
            }
        }
        let end = end.unwrap_or_else(|| self.hardened(strain + x));
        Return { increment: x, strength: end.0, slope: factor * end.1 }
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
                        let Return { increment, strength: end, .. } = {
                            let strength = solid.yield_strength(strain, 0.0);
                            solid.return_map(trial, strain, strength, factor, guess)
                        };
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
                        let Return { increment, slope, .. } = solid.return_map(trial, 0.0, 1.0, factor, 0.0);
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
        let Return { increment, slope, .. } =
            solid.return_map(1.0, 0.0, 1.0, solid.softening_factor(2000.0), 0.0);
        assert!((increment * 3.0 * solid.moduli.shear - 1.0).abs() < 1e-12 && slope == 0.0);
    }
}
