//! Frictionless elastic contact of a sphere with a rigid flat: load, area and pressure.
//!
//! Source: H. Hertz, J. reine angew. Math. 92, 156 (1882); K. L. Johnson, *Contact Mechanics*
//! (1985), §4.2, doi 10.1017/CBO9781139171731, through `tables::closed_forms::hertz`.
//!
//! Parameters: ν = 0.3, σ_Y/E = 1/5000, ω₀ = 0.3 ω_c, so that a = 0.00025 R: what the finite
//! sphere adds is of order a/R and lost beside the mesh.

use asperity::scene::FrictionLaw;
use asperity::simulate::outcome::Outcome;
use tables::quantity::Quantity;
use tests::{Hertz, Mesh, assert_close, mesh, plain_material, press, pressed, relative, richardson, scene};

fn on(mesh: Mesh) -> (Hertz, Outcome) {
    let scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh);
    let outcome = press(&scene);
    assert_eq!(pressed(&outcome)[Quantity::PlasticStrainMax], 0.0);
    (Hertz::of(&scene), outcome)
}

fn load_error(mesh: Mesh) -> f64 {
    let (hertz, outcome) = on(mesh);
    relative(pressed(&outcome)[Quantity::Load], hertz.load)
}

/// Errors measured: 2.2 and 0.7 % for n_c = 8 and 16, whatever N_θ.
#[test]
fn load_converges_to_the_closed_form() {
    let (coarse, fine) = (load_error(mesh(8, 4)), load_error(mesh(16, 4)));
    println!("errors: {coarse} {fine}");
    // Nothing depends on θ, so N_θ changes nothing.
    assert!((load_error(mesh(8, 8)) - coarse).abs() < 1e-12);
    // Order 1.5 in n_c, beside the square-root edge of the pressure: 2.8.
    let gain = coarse / fine;
    assert!((2.0..4.5).contains(&gain), "order in n_c: gain {gain}");
    let limit = richardson(coarse, fine, 1.5);
    println!("limit {limit}");
    assert!(limit.abs() < 0.003, "limit of the load is {:+.3} % off", 100.0 * limit);
}

#[test]
fn area_and_pressure() {
    let (hertz, outcome) = on(mesh(16, 8));
    // The rings beside the edge are a/48 apart; the edge is placed to a tenth of that.
    assert_close("A", pressed(&outcome)[Quantity::Area], hertz.area, 2.0 * 0.1 / 48.0);
    // Measured +0.72 %.
    assert_close("P", pressed(&outcome)[Quantity::Load], hertz.load, 0.01);
    let before = &outcome.snapshots[0];
    for (ring, (&r, &pressure)) in outcome.grid.r.iter().zip(&before.pressure).enumerate() {
        let reference = tables::closed_forms::hertz::pressure(hertz.peak_pressure, hertz.contact_radius, r);
        let off = (pressure - reference) / hertz.peak_pressure;
        println!("r/a {:.3}: {:+.2} % of p0", r / hertz.contact_radius, 100.0 * off);
        // The apex, alone in its ring, is the worst: −2.0 %, and −3.9 % at n_c = 8.
        let allowed = if ring == 0 { 0.025 } else { 0.02 };
        assert!(off.abs() < allowed, "ring {ring}: {pressure:e}, {reference:e}");
    }
    // Every angle alike.
    let rings = outcome.grid.r.len();
    for angle in before.pressure.chunks(rings) {
        for (a, b) in angle.iter().zip(&before.pressure) {
            assert!((a - b).abs() <= 1e-5 * hertz.peak_pressure, "{a} {b}");
        }
    }
}
