//! The interface at the strength of the metal as it is now (`strength = "current"`).
//!
//! Problem: steel with linear hardening, R = 1 mm, ω₀ = 20 ω_c, isothermal slide, f_τ = 0.8.
//! Source: the law itself, τ_c = f_τ σ_y(ε_p)/√3: no contact is sheared more than the strongest
//! point of the body allows, and none that slips less than the virgin one does.

use asperity::scene::{FrictionLaw, Hardening, InterfaceStrength};
use asperity::simulate::outcome::Outcome;
use tables::quantity::Quantity;
use tests::{assert_close, last, mesh, plain_material, pressed, run, scene};

const FACTOR: f64 = 0.8;
const YIELD: f64 = 40e6;
const MODULUS: f64 = 2e9;

fn slide(hardening: Hardening, strength: InterfaceStrength) -> Outcome {
    let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 20.0, mesh(6, 8));
    scene.material.hardening = hardening;
    scene.interface.strength = strength;
    scene.interface.strength_factor = FACTOR;
    scene.loading.slip_distance = 0.3;
    run(&scene)
}

/// Mean shear stress over that of the virgin interface at the end of the slide.
fn relative_stress(outcome: &Outcome) -> f64 {
    let end = last(outcome);
    assert!(end[Quantity::StickFraction] < 0.01, "{end:?}");
    end[Quantity::Friction] / end[Quantity::Area] / (FACTOR * YIELD / 3f64.sqrt())
}

/// Without hardening there is nothing to tell the two apart.
#[test]
fn without_hardening_current_and_initial_strength_are_the_same() {
    let current = slide(Hardening::None, InterfaceStrength::Current);
    let initial = slide(Hardening::None, InterfaceStrength::Initial);
    assert_eq!(last(&current)[Quantity::Friction], last(&initial)[Quantity::Friction]);
    assert_close("Q/A", relative_stress(&initial), 1.0, 0.005);
}

#[test]
fn the_interface_hardens_with_the_body() {
    let law = Hardening::Linear { modulus: MODULUS };
    let initial = slide(law.clone(), InterfaceStrength::Initial);
    let current = slide(law, InterfaceStrength::Current);
    assert_close("Q/A at initial strength", relative_stress(&initial), 1.0, 0.005);
    // Pressed alike: the interface does not slip in the press.
    assert_eq!(pressed(&current)[Quantity::Load], pressed(&initial)[Quantity::Load]);
    let stress = relative_stress(&current);
    let most = 1.0 + MODULUS * last(&current)[Quantity::PlasticStrainMax] / YIELD;
    println!("Q/A at current strength: {stress:.4} of the virgin interface's, at most {most:.4}");
    assert!(stress > 1.02 && stress < most, "{stress} {most}");
    // Point by point: slipping points are at f_τ(σ_Y + Hε)/√3 for some ε of the surface.
    let shear = &current.snapshots.last().unwrap().shear;
    let largest = shear.iter().fold(0.0f64, |most, &x| most.max(x)) / (FACTOR * YIELD / 3f64.sqrt());
    assert!(largest > stress && largest < most, "{largest} {most}");
}
