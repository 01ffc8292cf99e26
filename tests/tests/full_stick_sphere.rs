//! An elastic sphere pressed in full stick against the frictionless press on the same mesh.
//!
//! Source: adhesive (no-slip) indentation that grows with its contact, V. I. Mossakovskii, J. Appl.
//! Math. Mech. 27, 630 (1963); D. A. Spence, Proc. R. Soc. A 305, 55 (1968),
//! doi 10.1098/rspa.1968.0105: punch stiffness larger by (1−ν) ln(3−4ν)/(1−2ν). The ratios for a
//! sphere at equal interference are from an independent boundary-element solution (220 rings) that
//! reproduces that factor to 1e-6.
//!
//! Parameters: σ_Y/E = 1/5000, ω₀ = 0.3 ω_c, ν = 0, 0.3, 0.45; n_c = 8 and 16, N_θ = 4.

use asperity::scene::FrictionLaw;
use tables::quantity::Quantity;
use tests::{Mesh, mesh, plain_material, press, pressed, scene};

/// Of the load ratio: the mesh error common to both presses cancels; halving the elements
/// changes the ratio by 0.0007 at most.
const LOAD: f64 = 0.001;
/// Of the area ratio: the edge of each of the two contacts is found to about a tenth of the ring
/// spacing of a/32, which is 0.6 % of its area.
const AREA: f64 = 0.012;

/// (load, area) in full stick over those without friction.
fn ratios(poisson: f64, mesh: Mesh) -> (f64, f64) {
    let [slip, stick] = [FrictionLaw::Frictionless, FrictionLaw::FullStick].map(|law| {
        let mut scene = scene(plain_material(poisson), law, 0.3, mesh);
        // Mesh and sectors are given: this is for the increments, on which what sticks depends.
        scene.numerics.accuracy = 0.002;
        press(&scene)
    });
    let (slip, stick) = (pressed(&slip), pressed(&stick));
    (stick[Quantity::Load] / slip[Quantity::Load], stick[Quantity::Area] / slip[Quantity::Area])
}

#[test]
fn stick_stiffens_the_contact_and_shrinks_its_area() {
    // ν, load and area over those of the frictionless press.
    for (poisson, load, area) in [(0.0, 1.05289, 0.91850), (0.3, 1.01621, 0.97601), (0.45, 1.00160, 0.99767)]
    {
        let (coarse, fine) = (ratios(poisson, mesh(8, 4)), ratios(poisson, mesh(16, 4)));
        println!("nu {poisson}: {coarse:?}, {fine:?}; reference {load}, {area}");
        assert!((fine.0 - load).abs() < LOAD, "nu {poisson}: load ratio {}, not {load}", fine.0);
        assert!((fine.1 - area).abs() < AREA, "nu {poisson}: area ratio {}, not {area}", fine.1);
        assert!((coarse.0 - fine.0).abs() < LOAD, "nu {poisson}: {coarse:?}, {fine:?}");
    }
}
