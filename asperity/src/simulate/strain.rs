//! Small or finite strain: decided after the press, before any slide.
//!
//! Finite strain changes friction by about the largest plastic strain (see
//! [`crate::simulate::accuracy::modelling_error`]), so small strain is used only where that stays far
//! below the accuracy. The strain to expect is that of the press and what the slide adds, in units of
//! the yield strain σ_Y/E: with f the largest shear traction of the interface over the shear strength
//! of the body,
//!
//! ε = ε_press + 0.7 (1 + ω₀/ω_c)^¾ (2f − 1)³ σ_Y/E for ½ < f ≤ 1, ε_press below.
//!
//! Above f = 1, and at f = 1 where body and interface remain equally strong, the body may shear
//! without limit.

use crate::discretisation::body::Body;
use crate::interface::contact::Contact;
use crate::interface::friction_law::{ContactPoint, shear_limit};
use crate::loading::problem::{Problem, SHEAR_RATIO};
use crate::scene::{Hardening, InterfaceStrength, Scene};
use crate::simulate::messages::StrainChoice;

/// Plastic strain over the asked accuracy up to which strain is taken to be small. At twice or four times this a
/// table of 4340 steel takes 1.2 and 2.3 times as long, as the modelling error makes runs be repeated.
const SMALL_SHARE: f64 = 0.05;
/// Plastic strain that a slide adds at f = 1 to an elastic contact, over the yield strain. Measured: at most 0.6 at
/// 0.05 to 0.4 omega_c and 0.13 at f = 0.8, none at f = 0.5 (4340 and 304 steel, copper, Ti-6Al-4V, Al 6061).
const ADDED_BY_SLIDE: f64 = 0.7;
/// Its growth with interference; measured 1.1, 1.5 and 2.2 at 1, 2 and 5 omega_c (Ti-6Al-4V).
const GROWTH: f64 = 0.75;

/// The choice for a scene that leaves it, from the press on the coarse mesh at small strain.
pub fn choose_strain(scene: &Scene, problem: &Problem, body: &Body, contact: &Contact) -> StrainChoice {
    let strength = strength_ratio(scene, problem, contact);
    let equal = problem.strength == InterfaceStrength::Current || scene.material.hardening == Hardening::None;
    let added = match strength {
        ..=0.5 => 0.0,
        ratio if ratio > 1.0 || (ratio == 1.0 && equal) => f64::INFINITY,
        ratio => {
            let yield_strain = scene.material.yield_strength / scene.material.youngs_modulus;
            let depth = 1.0 + problem.interference / problem.critical_interference;
            ADDED_BY_SLIDE * depth.powf(GROWTH) * (2.0 * ratio - 1.0).powi(3) * yield_strain
        }
    };
    let expected = body.committed.largest_plastic_strain() + added;
    let limit = SMALL_SHARE * scene.numerics.accuracy;
    StrainChoice { finite: expected > limit, expected, limit }
}

/// Largest shear traction that the interface transmits in the slide, over the shear strength of the
/// body: its limit, or twice the mean traction 8Gs/((2 − ν)πa) of a contact that sticks all the way.
fn strength_ratio(scene: &Scene, problem: &Problem, contact: &Contact) -> f64 {
    let at = ContactPoint {
        pressure: contact.committed.pressure.iter().copied().fold(0.0, f64::max),
        contact_fraction: 1.0,
        strength: problem.strength_factor * SHEAR_RATIO,
        unit: problem.units.stress,
    };
    let limit = shear_limit(&problem.law, &at);
    let slip_over_radius = scene.loading.slip_distance;
    let shear = problem.solid.moduli.shear;
    let in_stick =
        2.0 * 8.0 * shear * slip_over_radius / ((2.0 - scene.material.poisson_ratio) * std::f64::consts::PI);
    // Not above 1 by rounding.
    let ratio = limit.min(in_stick) / SHEAR_RATIO;
    if (ratio - 1.0).abs() < 1e-12 { 1.0 } else { ratio }
}
