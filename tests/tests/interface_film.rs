//! An interface that shears more easily than the metal: τ_c = τ_0 + αp.
//!
//! Problem: an elastic–plastic sphere pressed and slid on a film. Where all of the contact slips, its
//! shear stress is τ_0 + αp at every point, so that Q = τ_0 A + αP whatever the pressures are.
//!
//! Source: B. J. Briscoe & D. Tabor, Wear 34, 29 (1975), doi 10.1016/0043-1648(75)90306-3.

use asperity::scene::FrictionLaw;
use tables::quantity::Quantity;
use tests::{assert_close, last, mesh, plain_material, run, scene};

const FILM_STRENGTH: f64 = 5e6;

fn slide(pressure_coefficient: f64, cap: bool) -> asperity::simulate::outcome::Outcome {
    let law = FrictionLaw::BriscoeTabor { film_strength: FILM_STRENGTH, pressure_coefficient, cap };
    let mut scene = scene(plain_material(0.3), law, 5.0, mesh(8, 8));
    scene.loading.slip_distance = 0.02;
    run(&scene)
}

#[test]
fn friction_in_gross_slip_is_that_of_the_film() {
    for pressure_coefficient in [0.0, 0.05] {
        let outcome = slide(pressure_coefficient, true);
        let end = last(&outcome);
        assert_eq!(end[Quantity::StickFraction], 0.0);
        let expected = FILM_STRENGTH * end[Quantity::Area] + pressure_coefficient * end[Quantity::Load];
        assert_close("Q", end[Quantity::Friction], expected, 2e-3);
        // Below that of the metal, 40 MPa/√3.
        assert!(end[Quantity::Friction] / end[Quantity::Area] < 20e6);
    }
}

/// Under the mean pressure of a plastic contact, about 100 MPa, τ_0 + p/2 is beyond the metal.
#[test]
fn the_metal_shears_where_the_film_is_stronger() {
    let outcome = slide(0.5, true);
    let end = last(&outcome);
    let strength = 40e6 / 3f64.sqrt();
    let mean = end[Quantity::Friction] / end[Quantity::Area];
    assert!(mean < strength * 1.001 && mean > 0.8 * strength, "{mean:e} {strength:e}");
    assert!(FILM_STRENGTH + 0.5 * end[Quantity::Load] / end[Quantity::Area] > strength);
}
