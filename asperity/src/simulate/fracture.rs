//! Shear fracture energy of the material, against which the energy that sliding releases is held.
//!
//! Given as such; or from the mode-II toughness in plane strain, G_IIc = K_IIc²(1 − ν²)/E (Irwin
//! 1957, J. Appl. Mech. 24, 361); or, where only a tensile test is available, estimated after
//! Griffith (1921, Phil. Trans. R. Soc. A 221, 163): a crack as large as the contact,
//! G_C = πσ_c²a/E, at the true stress where the tensile specimen begins to neck, σ_c = σ_u(1 + ε_u).
//! The estimate is proportional to the contact radius. E is that at the initial
//! temperature.

use std::f64::consts::PI;

use tables::quantity::{Estimate, Quantity};
use tables::table::fracture::FractureEnergy;

use crate::scene::{FractureData, Material, Scene};
use crate::simulate::outcome::Outcome;

/// G_IIc of the material over the contact radius, if it is known.
///
/// ```
/// use asperity::simulate::fracture::fracture_energy;
/// use asperity::scene::file::parse_scene;
/// use tables::quantity::Estimate;
///
/// let text = "[material]\npreset = \"copper\"\nshear_fracture_energy = 500.0\n\
///             [asperity]\nradius = 1e-6\n[loading]\ninterference = 5\nslip_rate = 1\n";
/// let scene = parse_scene(text, "this example", &[])?;
/// let energy = fracture_energy(&scene.material).unwrap();
/// assert_eq!(energy.at(Estimate { value: 1e-7, error: 0.0 }).value, 500.0);
/// # Ok::<(), asperity::scene::file::SceneFileError>(())
/// ```
pub fn fracture_energy(material: &Material) -> Option<FractureEnergy> {
    let modulus = material.youngs_modulus;
    material.fracture.as_ref().map(|data| match *data {
        FractureData::Energy(energy) => FractureEnergy { coefficient: energy, radius_exponent: 0 },
        FractureData::Toughness(toughness) => FractureEnergy {
            coefficient: toughness.powi(2) * (1.0 - material.poisson_ratio.powi(2)) / modulus,
            radius_exponent: 0,
        },
        FractureData::Tensile { strength, uniform_elongation } => FractureEnergy {
            coefficient: PI * (strength * (1.0 + uniform_elongation)).powi(2) / modulus,
            radius_exponent: 1,
        },
    })
}

/// A scalar that follows from others: name, unit, long name, value.
pub type Derived = (&'static str, &'static str, &'static str, Estimate);

/// G_IIc and G/G_IIc of a run; empty without fracture data.
pub fn of_run(scene: &Scene, outcome: &Outcome) -> Vec<Derived> {
    let Some(law) = fracture_energy(&scene.material) else {
        return Vec::new();
    };
    let (energy, radius) =
        (outcome.scalars[Quantity::EnergyRelease], outcome.scalars[Quantity::ContactRadius]);
    let name = match law.radius_exponent {
        0 => "shear fracture energy of the material",
        _ => "shear fracture energy estimated from the tensile test at the contact radius",
    };
    vec![
        ("G_IIc", "J m-2", name, law.at(radius)),
        (
            "G_ratio",
            "1",
            "energy released over the shear fracture energy, G/G_IIc",
            law.ratio(energy, radius),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::fake;

    /// Worked by hand: K_IIc = 50 MPa√m, E = 205 GPa, ν = 0.29 give 11.17 kJ/m²; σ_u = 1000 MPa,
    /// ε_u = 0.1 and a = 20 µm give π·(1.1e9)²·2e-5/205e9 = 370.9 J/m².
    #[test]
    fn recipes_give_the_numbers_worked_by_hand() {
        let mut scene = fake::scene(4.0, 1.0);
        let outcome = fake::outcome(&scene);
        assert!(of_run(&scene, &outcome).is_empty());
        let radius = outcome.scalars[Quantity::ContactRadius];
        assert!((radius.value - 2e-5).abs() < 1e-18);
        let mut energy = |data| {
            scene.material.fracture = Some(data);
            let derived = of_run(&scene, &outcome);
            let (critical, ratio) = (derived[0].3, derived[1].3);
            let exact = outcome.scalars[Quantity::EnergyRelease].value / critical.value;
            assert!((ratio.value / exact - 1.0).abs() < 1e-14);
            (critical.value, ratio.error / ratio.value)
        };
        // The fake's errors are 1 % of each value.
        let (given, error) = energy(FractureData::Energy(500.0));
        assert!(given == 500.0 && (error - 0.01).abs() < 1e-12);
        let (toughness, _) = energy(FractureData::Toughness(50e6));
        assert!((toughness / 11169.5 - 1.0).abs() < 1e-5, "{toughness}");
        let (tensile, error) = energy(FractureData::Tensile { strength: 1e9, uniform_elongation: 0.1 });
        assert!((tensile / 370.86 - 1.0).abs() < 1e-4, "{tensile}");
        assert!((error - 0.02).abs() < 1e-12);
    }
}
