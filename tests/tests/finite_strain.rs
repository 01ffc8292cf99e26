//! The choice between small and finite strain, and what small strain leaves out.
//!
//! Finite strain in the limit of small strains and its ledgers are rows of `asperity verify`; the constitutive law and
//! the element are verified next to their code: closed forms of Hencky's law, rotation, an expanding tube.

use asperity::scene::{FrictionLaw, Hardening, Kinematics, Scene};
use asperity::simulate::outcome::{ErrorSource, Outcome, Warning};
use tables::quantity::{COVERAGE_FACTOR, OF_BOUND, Quantity};
use tests::{last, mesh, plain_material, run, scene, steel_4340};

fn run_with(scene: &Scene, kinematics: Kinematics) -> Outcome {
    let mut scene = scene.clone();
    scene.model.kinematics = kinematics;
    run(&scene)
}

fn says(outcome: &Outcome, words: &str) -> bool {
    outcome.account.notes.iter().any(|note| note.to_string().contains(words))
}

#[test]
fn auto_stays_at_small_strain_where_strains_are_small() {
    let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 3.0, mesh(6, 8));
    scene.interface.strength_factor = 0.9;
    scene.loading.slip_distance = 0.2;
    let (small, auto) = (run_with(&scene, Kinematics::Small), run_with(&scene, Kinematics::Auto));
    assert_eq!(auto.slide, small.slide);
    assert!(!auto.account.finite_strain);
    assert!(says(&auto, "small strain: a plastic strain of no more than"), "{:?}", auto.account.notes);
}

/// Under an interface that does not slip the surface shears far: `auto` takes finite strain, with the
/// results of the explicit choice.
#[test]
fn auto_takes_finite_strain_where_strains_are_large() {
    let mut scene = scene(steel_4340(), FrictionLaw::FullStick, 20.0, mesh(6, 4));
    scene.material.hardening = Hardening::Linear { modulus: 1e9 };
    scene.loading.slip_distance = 0.03;
    let small = run_with(&scene, Kinematics::Small);
    assert!(last(&small)[Quantity::PlasticStrainMax] > 0.2, "{:?}", last(&small));
    let warns_of_large_strain = |outcome: &Outcome| {
        outcome.account.warnings.iter().any(|warning| matches!(warning, Warning::LargeStrain { .. }))
    };
    assert!(warns_of_large_strain(&small));
    let auto = run_with(&scene, Kinematics::Auto);
    assert!(
        says(&auto, "finite strain: the interface is at least as strong as the body"),
        "{:?}",
        auto.account.notes
    );
    assert!(!warns_of_large_strain(&auto));
    let finite = run_with(&scene, Kinematics::Finite);
    assert_eq!(auto.slide, finite.slide);
    assert!(auto.account.finite_strain);
    assert!(auto.scalars[Quantity::Mu].value != small.scalars[Quantity::Mu].value);
}

/// The modelling error of μ at small strain is about the largest plastic strain at 20 ω_c, as its estimate
/// states; and `auto` takes finite strain where a strain above a twentieth of the accuracy is expected.
#[test]
fn what_small_strain_leaves_out_is_in_the_error() {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 20.0, mesh(6, 4));
    scene.loading.slip_distance = 0.3;
    let finite = run_with(&scene, Kinematics::Finite);
    let auto = |twentieths: f64| {
        let mut scene = scene.clone();
        scene.numerics.accuracy = twentieths * 20.0 * last(&finite)[Quantity::PlasticStrainMax];
        run_with(&scene, Kinematics::Auto)
    };
    // The expected strain is an upper bound.
    let (small, large) = (auto(6.0), auto(0.5));
    assert!(!small.account.finite_strain && large.account.finite_strain);
    let part = |outcome: &Outcome| {
        outcome.budget.part(ErrorSource::Model, Quantity::Mu) / (COVERAGE_FACTOR * OF_BOUND)
    };
    let change = (small.scalars[Quantity::Mu].value - finite.scalars[Quantity::Mu].value).abs();
    assert!(change < part(&small) && change > 0.5 * part(&small), "{change} {}", part(&small));
    assert_eq!(part(&large), 0.0);
}
