//! Shear fracture energy of the material, against which the energy that sliding releases is held.
//!
//! Given as such; or from the mode-II toughness in plane strain, G_IIc = K_IIc²(1 − ν²)/E (Irwin
//! 1957, J. Appl. Mech. 24, 361); or, where only a tensile test is available, estimated after
//! Griffith (1921, Phil. Trans. R. Soc. A 221, 163): a crack as large as the contact,
//! G_C = πσ_c²a/E, at the true stress where the tensile specimen begins to neck, σ_c = σ_u(1 + ε_u).
//! Without any of them σ_c is that of the hardening law, the stress at which σ = dσ/dε (Considère 1885). These estimates are
//! proportional to the contact radius. E is that at the initial temperature.

use std::f64::consts::PI;

use tables::functions::{Accuracy, root_of};
use tables::table::fracture::FractureEnergy;

use crate::scene::{FractureData, Hardening, Material};

/// G_IIc of the material over the contact radius, given or estimated.
pub fn fracture_energy(material: &Material) -> FractureEnergy {
    let modulus = material.youngs_modulus.value;
    let griffith =
        |stress: f64| FractureEnergy { coefficient: PI * stress.powi(2) / modulus, radius_exponent: 1 };
    match material.fracture {
        Some(FractureData::Energy { shear_fracture_energy }) => {
            FractureEnergy { coefficient: shear_fracture_energy, radius_exponent: 0 }
        }
        Some(FractureData::Toughness { fracture_toughness_mode_ii: toughness }) => FractureEnergy {
            coefficient: toughness.powi(2) * (1.0 - material.poisson_ratio.powi(2)) / modulus,
            radius_exponent: 0,
        },
        Some(FractureData::Tensile { tensile_strength, uniform_elongation }) => {
            griffith(tensile_strength * (1.0 + uniform_elongation))
        }
        None => griffith(necking_stress(&material.hardening, material.yield_strength)),
    }
}

/// True stress at which a tensile specimen begins to neck, σ = dσ/dε, Pa; without elastic strain.
fn necking_stress(hardening: &Hardening, yield_strength: f64) -> f64 {
    match hardening {
        Hardening::None => yield_strength,
        Hardening::Linear { modulus } | Hardening::JohnsonCook { modulus, exponent: 1.0 } => {
            modulus.max(yield_strength)
        }
        // The slope is zero at first.
        Hardening::JohnsonCook { exponent, .. } if *exponent > 1.0 => yield_strength,
        // Before ε = n, as dσ/dε is then Bεⁿ.
        Hardening::JohnsonCook { modulus, exponent } => {
            let power = |strain: f64| modulus * strain.powf(*exponent);
            let excess = |strain: f64| exponent * power(strain) / strain - yield_strength - power(strain);
            let strain = root_of(1e-12, *exponent, Accuracy::of(1e-12), excess);
            yield_strength + strain.map_or(0.0, power)
        }
        Hardening::Table { plastic_strain, factor } => {
            let stress = |point: usize| yield_strength * factor[point];
            for end in 1..factor.len() {
                let slope = (stress(end) - stress(end - 1)) / (plastic_strain[end] - plastic_strain[end - 1]);
                if slope <= stress(end) {
                    return slope.max(stress(end - 1));
                }
            }
            stress(factor.len() - 1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tests::of_preset;

    /// σ_u of Callister & Rethwisch, Fundamentals of Materials Science and Engineering, 3rd ed. 2008, Table B.4, MPa: T6 temper;
    /// electrolytic copper, hot-rolled; hot-finished and annealed, at least.
    #[test]
    fn presets_neck_at_the_tensile_strength_of_a_handbook() {
        for (preset, handbook, by_hardening) in
            [("aluminium-6061", 310e6, 340e6), ("copper", 220e6, 219e6), ("steel-304", 515e6, 578e6)]
        {
            let material = of_preset(preset, &[]).material;
            let Hardening::JohnsonCook { modulus, exponent } = material.hardening else { panic!("{preset}") };
            let stress = necking_stress(&material.hardening, material.yield_strength);
            let strain = ((stress - material.yield_strength) / modulus).powf(1.0 / exponent);
            let found = stress * (-strain).exp();
            assert!((found / by_hardening - 1.0).abs() < 2e-3, "{preset}: {found:e}");
            assert!((found / handbook - 1.0).abs() < 0.15, "{preset}: {found:e}");
        }
    }

    /// 4340 steel, σ = 792 + 510 ε^0.26 MPa: σ = dσ/dε at ε = 0.0619, 1039.4 MPa.
    #[test]
    fn necking_begins_where_the_slope_is_the_stress() {
        let steel = Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 };
        let stress = necking_stress(&steel, 792e6);
        let strain = ((stress - 792e6) / 510e6).powf(1.0 / 0.26);
        assert!((0.26 * (stress - 792e6) / strain / stress - 1.0).abs() < 1e-6, "{stress} at {strain}");
        // Hollomon's σ = K εⁿ necks at ε = n.
        let hollomon = necking_stress(&Hardening::JohnsonCook { modulus: 1e9, exponent: 0.3 }, 1e-3);
        assert!((hollomon / (1e9 * 0.3f64.powf(0.3)) - 1.0).abs() < 1e-9, "{hollomon}");
        // Without hardening, or where it is slight, at once.
        assert_eq!(necking_stress(&Hardening::None, 5e8), 5e8);
        assert_eq!(necking_stress(&Hardening::Linear { modulus: 1e8 }, 5e8), 5e8);
        assert_eq!(necking_stress(&Hardening::JohnsonCook { modulus: 2e9, exponent: 2.0 }, 5e8), 5e8);
        // A straight line of 2 GPa necks at 2 GPa, by any of its laws.
        assert_eq!(necking_stress(&Hardening::Linear { modulus: 2e9 }, 5e8), 2e9);
        for exponent in [0.99999, 1.0] {
            let stress = necking_stress(&Hardening::JohnsonCook { modulus: 2e9, exponent }, 5e8);
            assert!((stress / 2e9 - 1.0).abs() < 1e-4, "{exponent}: {stress}");
        }
        assert_eq!(necking_stress(&Hardening::JohnsonCook { modulus: 0.0, exponent: 0.3 }, 5e8), 5e8);
        // The slope falls from 2 to 1 GPa at 600 MPa, and to 0.2 GPa at 700 MPa.
        let table = Hardening::Table {
            plastic_strain: vec![0.0, 0.05, 0.15, 1.15],
            factor: vec![1.0, 1.2, 1.4, 1.8],
        };
        assert!((necking_stress(&table, 5e8) / 7e8 - 1.0).abs() < 1e-12);
    }
}
