//! Small or finite strain: decided after the press, before any slide.
//!
//! Finite strain changes friction by about the largest plastic strain (see
//! [`crate::simulate::accuracy::modelling_error`]), so small strain is used only where that stays far
//! below the accuracy. Elastic strain changes friction by a share of σ_Y/E, which counts in polymers and ceramics beside an
//! interface that is weaker than the body. The plastic strain to expect is that of the press and what the slide adds
//! (`scene::fitted_constants::plastic_strain_of_slide`), by the ratio f of the largest shear traction of the interface
//! to the shear strength of the body. At f = 1 on a yield plateau its length is added. Above f = 1, and at f = 1 where body
//! and interface remain equally strong, the body may shear without limit.

use crate::discretisation::body::Body;
use crate::interface::contact::Contact;
use crate::interface::friction_law::{ContactPoint, shear_limit};
use crate::loading::problem::Problem;
use crate::material::SHEAR_RATIO;
use crate::scene::Scene;
use crate::scene::fitted_constants::elastic_strain::LIGHT;
use crate::scene::fitted_constants::plastic_strain_of_slide::{ADDED, EXPONENT};
use crate::simulate::accuracy::modelling_error::ElasticStrain;
use crate::simulate::messages::StrainChoice;
use tables::quantity::Quantity;

/// Plastic strain over the required accuracy up to which strain is taken to be small. At twice or four times this a
/// table of 4340 steel takes 1.2 and 2.3 times as long, as the modelling error makes runs be repeated.
const SMALL_SHARE: f64 = 0.05;

/// Change of friction, or of `G` over its allowance, by elastic strain over the required accuracy up to which it joins the
/// modelling error.
const SMALL_ELASTIC_SHARE: f64 = 0.2;

/// The choice for a scene with `kinematics = "auto"`, from the press on the coarse mesh at small strain.
pub fn choose_strain(scene: &Scene, problem: &Problem, body: &Body, contact: &Contact) -> StrainChoice {
    let strength = strength_ratio(scene, problem, contact);
    let added = match strength {
        ratio if ratio > 1.0 => f64::INFINITY,
        ratio => {
            let yield_strain = scene.material.yield_strength / scene.material.youngs_modulus.value;
            let added =
                yield_strain * added_by_slide(ratio, problem.interference / problem.critical_interference);
            if ratio == 1.0 { scene.plateau_below_interface() + added } else { added }
        }
    };
    let expected = body.committed.largest_plastic_strain() + added;
    let limit = SMALL_SHARE * scene.numerics.accuracy;
    let elastic = ElasticStrain {
        strain: elastic_strain(scene, problem),
        traction: strength,
        interference: scene.loading.interference,
    };
    let elastic = [Quantity::Mu, Quantity::EnergyRelease]
        .map(|quantity| elastic.share(quantity) / quantity.allowance())
        .into_iter()
        .fold(0.0, f64::max);
    let elastic_limit = SMALL_ELASTIC_SHARE * scene.numerics.accuracy;
    StrainChoice {
        finite: expected > limit || elastic > elastic_limit,
        expected,
        limit,
        elastic,
        elastic_limit,
    }
}

/// σ_Y/E, less in a light contact: what the [changes by elastic strain](crate::scene::fitted_constants::elastic_strain) are in
/// proportion to.
pub fn elastic_strain(scene: &Scene, problem: &Problem) -> f64 {
    let light = problem.interference / problem.critical_interference / LIGHT;
    scene.material.yield_strength / scene.material.youngs_modulus.value * light.min(1.0).sqrt()
}

/// Whether the body may shear without limit under the interface: it has yielded, does not harden, and is no stronger
/// than the interface.
pub fn shears_without_limit(scene: &Scene, problem: &Problem, body: &Body, contact: &Contact) -> bool {
    scene.material.hardening.plateau() == f64::INFINITY
        && body.committed.largest_plastic_strain() > 0.0
        && strength_ratio(scene, problem, contact) >= 1.0
}

/// Plastic strain that a slide adds to that of the press, over the yield strain.
fn added_by_slide(strength_ratio: f64, interference: f64) -> f64 {
    ADDED * (1.0 + interference).powf(EXPONENT) * (2.0 * strength_ratio - 1.0).max(0.0).powi(3)
}

/// Largest shear traction that the interface transmits in the slide, over the shear strength of the
/// body: its limit, or twice the mean traction 8Gs/((2 − ν)πa) of a contact that sticks all the way.
fn strength_ratio(scene: &Scene, problem: &Problem, contact: &Contact) -> f64 {
    let at = ContactPoint {
        pressure: contact.committed.iter().fold(0.0, |largest, state| f64::max(largest, state.pressure)),
        contact_fraction: 1.0,
        strength: problem.interface.strength_factor * SHEAR_RATIO,
        temperature: problem.units.temperature,
        unit: problem.units.stress,
    };
    let slip_over_radius = scene.loading.slip_distance;
    let shear = problem.solid.moduli.shear;
    let in_stick =
        2.0 * 8.0 * shear * slip_over_radius / ((2.0 - scene.material.poisson_ratio) * std::f64::consts::PI);
    // Not above 1 by rounding.
    let ratio = shear_limit(&problem.interface.law, &at).min(in_stick) / SHEAR_RATIO;
    if (ratio - 1.0).abs() < 1e-12 { 1.0 } else { ratio }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slides at small strain by two contact radii, V = 0, 6 elements: σ_Y/E, ω₀/ω_c, f, plastic strain after the
    /// press and after the slide (4340 steel, copper, Ti-6Al-4V, Al 6061, 304 steel).
    const MEASURED: [(f64, f64, f64, f64, f64); 16] = [
        (0.00386, 0.05, 0.8, 0.0, 0.0003),
        (0.00386, 0.05, 1.0, 0.0, 0.0017),
        (0.00386, 0.15, 1.0, 0.0, 0.0022),
        (0.00386, 5.0, 1.0, 0.0056, 0.0073),
        (0.00073, 0.4, 1.0, 0.0, 0.0002),
        (0.00073, 5.0, 1.0, 0.0009, 0.0010),
        (0.00757, 0.05, 1.0, 0.0, 0.0049),
        (0.00757, 1.0, 1.0, 0.0001, 0.0105),
        (0.00757, 5.0, 0.8, 0.0116, 0.0132),
        (0.00757, 5.0, 1.0, 0.0116, 0.0322),
        (0.00470, 0.05, 1.0, 0.0, 0.0033),
        (0.00470, 0.4, 0.8, 0.0, 0.0007),
        (0.00470, 2.0, 1.0, 0.0026, 0.0139),
        (0.00470, 5.0, 1.0, 0.0075, 0.0308),
        (0.00161, 1.0, 1.0, 0.0001, 0.0022),
        (0.00161, 5.0, 1.0, 0.0026, 0.0064),
    ];

    #[test]
    fn strains_of_slides_are_below_the_expected_ones() {
        for (yield_strain, interference, ratio, press, slide) in MEASURED {
            let expected = press + yield_strain * added_by_slide(ratio, interference);
            assert!(slide <= expected, "{interference} omega_c, f = {ratio}: {slide} of {expected}");
        }
        assert_eq!(added_by_slide(0.5, 20.0), 0.0);
    }
}
