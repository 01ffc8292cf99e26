//! Frictionless press of an elastic–plastic sphere without hardening.
//!
//! Sources: R. L. Jackson & I. Green, J. Tribol. 127, 343 (2005), doi 10.1115/1.1866166;
//! L. Kogut & I. Etsion, J. Appl. Mech. 69, 657 (2002), doi 10.1115/1.1490373; both are fits to
//! finite-element results, which differ from each other by up to 4 % in the load at 20 ω_c.
//!
//! Parameters: E = 200 GPa, ν = 0.3, σ_Y = 400 MPa (σ_Y/E* = 0.0018), ω₀ = 2 … 100 ω_c, n_c = 12,
//! N_θ = 8: 1.0 and 0.9 % too stiff while elastic (hertz.rs), less in plastic flow.

use asperity::scene::FrictionLaw;
use tables::closed_forms::{hertz, jackson_green, kogut_etsion};
use tables::quantity::Quantity;
use tests::{Hertz, assert_close, mesh, plain_material, press, pressed, scene};

/// What the fits allow: the spread between them.
const SPREAD: f64 = 0.05;

#[test]
fn load_and_area_follow_the_published_fits() {
    for omega in [2.0, 5.0, 10.0, 20.0, 50.0, 100.0] {
        let mut scene = scene(plain_material(0.3), FrictionLaw::Frictionless, omega, mesh(12, 8));
        scene.material.yield_strength = 400e6;
        let modulus = Hertz::of(&scene).modulus;
        let critical_load = hertz::critical_load(modulus, 0.3, 400e6, scene.radius);
        let critical_area = hertz::critical_area(modulus, 0.3, 400e6, scene.radius);
        let yield_strain = 400e6 / modulus;

        let outcome = press(&scene);
        let load = pressed(&outcome)[Quantity::Load] / critical_load;
        let area = pressed(&outcome)[Quantity::Area] / critical_area;
        let at = |what: &str| format!("{what} at {omega} omega_c");
        assert_close(&at("P, Jackson-Green"), load, jackson_green::load(omega, yield_strain, 0.3), SPREAD);
        assert_close(&at("P, Kogut-Etsion"), load, kogut_etsion::load(omega, 0.3), SPREAD);
        assert_close(&at("A, Jackson-Green"), area, jackson_green::area(omega, yield_strain), SPREAD);
        assert_close(&at("A, Kogut-Etsion"), area, kogut_etsion::area(omega), SPREAD);
    }
}
