//! Shear fracture energy of the material, against which the energy that sliding releases is held.
//!
//! Given as such; or from the mode-II toughness in plane strain, G_IIc = K_IIc²(1 − ν²)/E (Irwin
//! 1957, J. Appl. Mech. 24, 361); or, where only a tensile test is available, estimated after
//! Griffith (1921, Phil. Trans. R. Soc. A 221, 163): a crack as large as the contact,
//! G_C = πσ_c²a/E, at the true stress where the tensile specimen begins to neck, σ_c = σ_u(1 + ε_u).
//! The estimate is proportional to the contact radius. E is that at the initial
//! temperature.

use std::f64::consts::PI;

use tables::table::fracture::FractureEnergy;

use crate::scene::{FractureData, Material};

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
