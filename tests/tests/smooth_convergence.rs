//! Convergence of the pressed and the sliding contact with the mesh, without jumps as rings of
//! nodes come into contact.
//!
//! Problem: 4340 steel, isothermal, ω₀ = 20 ω_c and a little more; the slide ends at 0.1 a₀, past
//! sliding inception. Source: continuity. Contact node by node makes area and friction jump by a
//! ring (12 % of the area at n_c = 8) unless the edge is found between the rings; results of a
//! second-order method approach their limit at least as n_c^−1.5 beside the square-root edge of
//! the pressure.

use asperity::scene::FrictionLaw;
use tables::quantity::Quantity;
use tests::{Mesh, mesh, relative, run, scene, steel_4340};

const NAMES: [&str; 4] = ["A", "P", "Q", "mu_static"];

fn at(interference: f64, mesh: Mesh) -> [f64; 4] {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, interference, mesh);
    scene.loading.slip_distance = 0.1;
    let scalars = run(&scene).scalars;
    [
        scalars[Quantity::AreaPress],
        scalars[Quantity::LoadPress],
        scalars[Quantity::Friction],
        scalars[Quantity::MuStatic],
    ]
    .map(|x| x.value)
}

fn assert_change(coarse: Mesh, fine: Mesh, most: f64) {
    let (from, to) = (at(20.0, coarse), at(20.0, fine));
    let changes: Vec<f64> = from.iter().zip(&to).map(|(a, b)| relative(*b, *a)).collect();
    for (name, change) in NAMES.iter().zip(&changes) {
        println!("{name}: {:+.3} %", 100.0 * change);
    }
    for (name, change) in NAMES.iter().zip(&changes) {
        assert!(change.abs() < most, "{name} changes by {:+.2} %", 100.0 * change);
    }
}

/// The change from 8 to 16 elements is 2.8 times that from 16 to 32, which is to be below 1 %.
#[test]
fn twice_as_fine_changes_little() {
    assert_change(mesh(8, 8), mesh(16, 8), 0.028);
}

#[test]
#[ignore = "takes several minutes"]
fn twice_as_fine_again_changes_less_than_a_hundredth() {
    assert_change(mesh(16, 8), mesh(32, 8), 0.01);
}

/// 2 % of interference move the edge by a fifth of the ring spacing at n_c = 8.
#[test]
fn a_little_more_interference_makes_no_jump() {
    let steps: Vec<[f64; 4]> = (0..9).map(|k| at(20.0 + 0.4 * k as f64, mesh(8, 8))).collect();
    let mut worst = [0.0f64; 4];
    for three in steps.windows(3) {
        for (k, worst) in worst.iter_mut().enumerate() {
            let kink = (three[0][k] - 2.0 * three[1][k] + three[2][k]) / three[1][k];
            print!("{} {:+.2} %  ", NAMES[k], 100.0 * kink);
            *worst = worst.max(kink.abs());
        }
        println!();
    }
    for (name, worst) in NAMES.iter().zip(worst) {
        // A smooth curve bends by 0.01 % here; a tenth of a ring would be 1.2 % of the area.
        assert!(worst < 0.005, "{name} jumps by {:.2} %", 100.0 * worst);
    }
}
