//! Whole runs of the pipeline.

use tables::quantity::Quantity;

use std::sync::atomic::{AtomicUsize, Ordering};

use super::accuracy::resolution::Resolution;
use super::messages::{Note, Warning};
use super::outcome::{ErrorSource, Outcome};
use super::{SimulationError, Unwatched, Watch, derived, run_alone, run_history, simulate};
use crate::heat::expected::HeatEffect;
use crate::loading::slide::SlideFailure;
use crate::scene::tests::{of_preset, parse};
use crate::scene::{Kinematics, LoadingStep, Numerics, Scene, Switch};

/// A point that lifts off with friction and touches without it has no equilibrium for any increment. Without removal of
/// its friction two steps here are cut back; at 0.01 ω_c the slide fails.
#[test]
fn chattering_points_do_not_cut_steps_back() {
    let run = |elements: usize| {
        let mut scene = coarse_scene("steel-304", &["loading.interference=0.02", "loading.slip_rate=0"]);
        (scene.numerics.elements_per_radius, scene.numerics.sectors) = (Some(elements), Some(8));
        simulate(&scene, &Unwatched).unwrap()
    };
    let outcome = run(8);
    assert_eq!(outcome.account.cutbacks, 0);
    // The friction of such a point is far below the mesh error.
    let finer = run(12).scalars[Quantity::Mu];
    let mu = outcome.scalars[Quantity::Mu];
    assert!((mu.value - finer.value).abs() < mu.error, "{mu:?} {finer:?}");
}

/// In a light contact the shear traction at the edge shifts the edge (book, "Contact edge"): without the shift friction on 8
/// elements is 1.0 % below that on 24.
#[test]
fn friction_of_a_light_contact_is_that_of_a_fine_mesh() {
    let friction = |elements: usize| {
        let mut scene = of_preset("steel-4340", &["model.kinematics=small", "loading.slip_distance=0.15"]);
        (scene.loading.interference, scene.loading.slip_rate) = (0.7, 0.0);
        (scene.numerics.elements_per_radius, scene.numerics.sectors) = (Some(elements), Some(4));
        let run = run_history(&scene, 0.0, &Resolution::choose(&scene.numerics), &Unwatched).unwrap();
        run.slide.last().unwrap().friction
    };
    let change = friction(8) / friction(24) - 1.0;
    assert!(change.abs() < 5e-3, "{change}");
}

/// Of an interrupted run that is kept which has ended or, if none has, has more states.
#[test]
fn an_ended_run_is_ahead_of_a_longer_one() {
    let scene = hot_scene("copper", 1.0, 0.0, "off");
    let run = || run_alone(&scene, 0.0, &Resolution::choose(&scene.numerics), &Unwatched).unwrap();
    let stopped = |states: usize| {
        let mut run = run();
        run.history.truncate(states);
        run.failure = Some(SlideFailure::Cancelled);
        run
    };
    let (mut ended, long, short) = (run(), stopped(6), stopped(3));
    ended.history.truncate(4);
    assert!(ended.is_ahead_of(&long) && !long.is_ahead_of(&ended));
    assert!(long.is_ahead_of(&short) && !short.is_ahead_of(&long));
}

/// A press alone has no friction, which is not friction of zero; a slide too short for full slip has no time of it.
#[test]
fn what_did_not_happen_has_no_numbers() {
    let mut scene = hot_scene("steel-4340", 5.0, 10.0, "off");
    scene.loading.slip_distance = 0.0;
    let pressed = simulate(&scene, &Unwatched).unwrap();
    for quantity in
        [Quantity::Mu, Quantity::MuStatic, Quantity::MuPeak, Quantity::Friction, Quantity::EnergyRelease]
    {
        assert!(pressed.scalars[quantity].value.is_nan(), "{quantity:?}");
    }
    let load = pressed.scalars[Quantity::LoadPress];
    assert!(load.value > 0.0 && load.error < 0.1 * load.value && !pressed.steady);
    for pair in [[Quantity::Load, Quantity::LoadPress], [Quantity::Area, Quantity::AreaPress]] {
        let [end, press] = pair.map(|quantity| pressed.scalars[quantity].value);
        assert!((end / press - 1.0).abs() < 1e-12, "{pair:?}");
    }
    scene.loading.slip_distance = 1e-3;
    let short = simulate(&scene, &Unwatched).unwrap();
    let named = |scene: &Scene, outcome: &Outcome| {
        derived::of_run(scene, outcome).iter().any(|(name, ..)| *name == "inception_time")
    };
    assert!(!named(&scene, &short) && short.account.warnings.contains(&Warning::NotSliding));
    let is_fast = |warning: &Warning| matches!(warning, Warning::FastInception { .. });
    assert!(!short.account.warnings.iter().any(is_fast));
    scene.loading.slip_distance = 0.1;
    assert!(named(&scene, &simulate(&scene, &Unwatched).unwrap()));
}

/// The warning of a fast inception has the number that the results have, also beside an elastic counterface.
#[test]
fn a_fast_inception_is_stated_once() {
    let mut scene = hot_scene("copper", 1.0, 10.0, "off");
    scene.loading.slip_distance = 0.1;
    (scene.counterface.youngs_modulus, scene.counterface.poisson_ratio) = (Some(200e9), Some(0.3));
    let outcome = simulate(&scene, &Unwatched).unwrap();
    let stated = outcome.account.warnings.iter().find_map(|warning| match warning {
        Warning::FastInception { time, .. } => Some(*time),
        _ => None,
    });
    let of_run = derived::of_run(&scene, &outcome);
    let (.., time) = of_run.iter().find(|(name, ..)| *name == "inception_time").unwrap();
    assert!((stated.unwrap() / time.value - 1.0).abs() < 1e-9, "{stated:?} {time:?}");
}

/// In a hold both bodies exchange heat with hardly any friction: the partition stays that of the slip before.
#[test]
fn a_hold_keeps_the_heat_partition_of_the_slip_before() {
    let steps = "loading.steps=[{slip_rate=10.0, slip_distance=0.5}, {slip_rate=-1.0, slip_distance=0.1}, {hold=1e-3}]";
    let changes = ["counterface.preset=\"copper\"", "loading.interference=5", steps];
    let outcome = simulate(&coarse_scene("steel-4340", &changes), &Unwatched).unwrap();
    let of_step = |step: f64| -> Vec<f64> {
        let states = outcome.slide.states().filter(|state| state[Quantity::ProgrammeStep] == step);
        states.map(|state| state[Quantity::HeatPartition]).collect()
    };
    let (slip, hold) = (of_step(2.0), of_step(3.0));
    let [.., before, last] = slip[..] else { panic!("{slip:?}") };
    assert!(before != last && hold.len() > 3 && hold.iter().all(|now| *now == last), "{slip:?} {hold:?}");
    // 0.5 a₀ forwards and 0.1 a₀ backwards.
    let [slip, path] = [Quantity::Slip, Quantity::SlipAccumulated].map(|of| outcome.slide.last(of));
    assert!((path.unwrap() / slip.unwrap() - 1.5).abs() < 1e-12, "{slip:?} {path:?}");
}

/// Without heat nothing depends on time: a hold of any length leaves the contact as it is.
#[test]
fn a_contact_does_not_creep_in_a_long_hold() {
    let after = |hold: f64| {
        let mut scene = hot_scene("steel-4340", 20.0, 1.0, "off");
        let slip = LoadingStep::Slip { slip_rate: 1.0, slip_distance: 0.5 };
        scene.loading = scene.loading.with_steps(vec![slip, LoadingStep::Hold { hold }]);
        simulate(&scene, &Unwatched).unwrap().scalars[Quantity::Mu].value
    };
    // Each of the 90 increments finds the contact edge to 2e-4.
    let change = after(1e10) / after(1e-3) - 1.0;
    assert!(change.abs() < 1e-3, "{change}");
}

/// As the flat stops, an interface that depends on the slip rate loses strength no faster than the contact slips on.
#[test]
fn a_contact_that_relaxes_does_not_heat_up() {
    let rate = "material.rate={ law = \"johnson-cook\", coefficient = 0.014, reference = 1.0 }";
    let changes = ["loading.interference=10", "asperity.radius=50e-6", rate];
    let mut scene = coarse_scene("steel-4340", &changes);
    let slip = LoadingStep::Slip { slip_rate: 10.0, slip_distance: 1.0 };
    scene.loading = scene.loading.with_steps(vec![slip, LoadingStep::Hold { hold: 1e-6 }]);
    let outcome = simulate(&scene, &Unwatched).unwrap();
    let highest = |step: f64| {
        let states = outcome.slide.states().filter(|state| state[Quantity::ProgrammeStep] == step);
        states.map(|state| state[Quantity::TemperatureMax] - 298.0).fold(0.0, f64::max)
    };
    let (slides, holds) = (highest(1.0), highest(2.0));
    // At first it slips hardly slower than before.
    assert!(holds < 1.001 * slides, "{holds} {slides}");
}

/// An interface that is too weak for the shear tractions of the press slips radially at first, which is no sliding.
#[test]
fn a_weak_interface_slides_when_its_strength_resists() {
    let run = |factor: f64| {
        let mut scene = hot_scene("steel-4340", 20.0, 0.0, "off");
        scene.interface.strength_factor = factor;
        scene.numerics.accuracy = 0.05;
        simulate(&scene, &Unwatched).unwrap()
    };
    let is_released = |warning: &Warning| matches!(warning, Warning::ReleasedPress { .. });
    for (factor, released) in [(0.02, true), (1.0, false)] {
        let outcome = run(factor);
        let of = |quantity: Quantity| outcome.scalars[quantity].value;
        let share = of(Quantity::MuStatic) / of(Quantity::MuPeak);
        assert!((0.9..=1.0).contains(&share), "{factor}: {share}");
        assert_eq!(outcome.account.warnings.iter().any(is_released), released, "{factor}");
    }
}

#[test]
fn a_run_outside_a_table_of_its_scene_is_warned_of() {
    let table = "material.specific_heat={temperature=[293, 320], value=[460, 500]}";
    // Friction of 4340 steel at 10 m/s heats by more than 100 K.
    for (heat, warned) in [("on", true), ("off", false)] {
        let mut scene = hot_scene("steel-4340", 20.0, 10.0, heat);
        scene.material.specific_heat = of_preset("steel-4340", &[table]).material.specific_heat;
        let warnings = simulate(&scene, &Unwatched).unwrap().account.warnings;
        let found = warnings.iter().any(|warning| matches!(warning, Warning::OutsideTable(_)));
        assert_eq!(found, warned, "{warnings:?}");
    }
}

fn hot_scene(preset: &str, interference: f64, slip_rate: f64, heat: &str) -> Scene {
    let mut scene = coarse_scene(preset, &[&format!("model.heat={heat}")]);
    (scene.loading.interference, scene.loading.slip_rate) = (interference, slip_rate);
    scene
}

/// At small strain, on 6 elements and 4 sectors.
fn coarse_scene(preset: &str, changes: &[&str]) -> Scene {
    let mut scene = of_preset(preset, changes);
    scene.model.kinematics = Kinematics::Small;
    scene.numerics = Numerics { accuracy: 0.5, elements_per_radius: Some(6), sectors: Some(4) };
    scene
}

/// Requests a stop from its n-th question on, and counts the questions after it.
struct StopsAfter {
    allowed: usize,
    asked: AtomicUsize,
}

impl Watch for StopsAfter {
    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.allowed
    }
}

/// Wherever the stop is requested, in a factorisation, a press, an increment of a slide or a refinement, the run ends
/// within a few further questions, each from an innermost loop; converged states are kept.
#[test]
fn a_stop_is_honoured_in_the_innermost_loops() {
    let scene = hot_scene("steel-4340", 5.0, 1.0, "on");
    let whole = StopsAfter { allowed: usize::MAX, asked: AtomicUsize::new(0) };
    let finished = simulate(&scene, &whole).unwrap();
    let questions = whole.asked.into_inner();
    let solves = finished.account.newton_iterations + finished.account.krylov_iterations;
    assert!(questions > solves, "{questions} {solves}");
    let mut kept = Vec::new();
    for allowed in (0..questions).step_by(questions / 12) {
        let watch = StopsAfter { allowed, asked: AtomicUsize::new(0) };
        match simulate(&scene, &watch) {
            Err(SimulationError::Cancelled { partial }) => {
                // A longer slip would not let it begin to slide.
                let is_stuck = |run: &Outcome| run.account.warnings.contains(&Warning::NotSliding);
                assert!(!partial.as_deref().is_some_and(is_stuck));
                kept.push(partial.map_or(0, |run| run.slide.len()))
            }
            other => panic!("{allowed} of {questions}: {other:?}"),
        }
        let after = watch.asked.into_inner() - allowed;
        assert!(after < 100, "{after} questions after the request at {allowed} of {questions}");
    }
    assert!(kept[0] == 0 && kept[kept.len() - 1] > 5, "{kept:?}");
}

/// Without friction every term of the balance is a rounding error, and so is what is missing.
#[test]
fn balances_without_friction_are_not_relative_to_rounding() {
    let text = "[material]\nyoungs_modulus = 200e9\npoisson_ratio = 0.3\nyield_strength = 1e9\ndensity = 7800\n\
                specific_heat = 460\nthermal_conductivity = 45\nthermal_expansion = 0\n\
                hardening = { law = \"linear\", modulus = 1e9 }\n[asperity]\nradius = 100e-6\n\
                [interface]\nlaw = \"frictionless\"\n\
                [loading]\ninterference = 0.5\nslip_rate = 0\nslip_distance = 0.5\n\
                [numerics]\nelements_per_radius = 4\nsectors = 4\n";
    let outcome = simulate(&parse(text, &[]).unwrap(), &Unwatched).unwrap();
    let is_unbalanced = |warning: &Warning| matches!(warning, Warning::Unbalanced { .. });
    assert!(!outcome.account.warnings.iter().any(is_unbalanced), "{:?}", outcome.account.warnings);
    let weakening = outcome.scalars[Quantity::EnergyWeakening].value;
    assert!(weakening == 0.0 && weakening.is_sign_positive(), "{weakening:?}");
}

/// On the coarsest meshes the auxiliary ones are finer: the layers of elements that heat requires fit into both.
#[test]
fn the_layers_of_a_fast_slide_fit_into_the_coarsest_mesh() {
    let mut scene = hot_scene("steel-4340", 2.0, 1e6, "on");
    scene.numerics.elements_per_radius = Some(4);
    scene.loading.slip_distance = 0.02;
    let error = simulate(&scene, &Unwatched).err();
    assert!(!matches!(error, Some(SimulationError::Unsupported(_))), "{error:?}");
    let text = error.map(|error| error.to_string()).unwrap_or_default();
    assert!(!text.contains("the mesh of the main run"), "{text}");
}

/// A body without hardening under an interface of its own strength is planned for an accuracy of 10 % at best and not
/// refined, and says so; with hardening, with a weaker interface or without yield it is as the scene asks.
#[test]
fn unlimited_shear_is_not_refined() {
    let text = "[material]\nyoungs_modulus = 200e9\npoisson_ratio = 0.3\nyield_strength = 400e6\ndensity = 7850\n\
                specific_heat = 475\nthermal_conductivity = 45\nthermal_expansion = 0\n[asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 10\nslip_rate = 0\nslip_distance = 0.01\n[numerics]\naccuracy = 0.05\n";
    let limited = |set: &[&str]| {
        let outcome = simulate(&parse(text, set).unwrap(), &Unwatched).unwrap();
        outcome.account.notes.iter().any(|note| matches!(note, Note::UnlimitedShear { planned: 0.1 }))
    };
    assert!(limited(&[]));
    for other in [
        "material.hardening={ law = \"linear\", modulus = 1e9 }",
        "interface.strength_factor=0.9",
        "loading.interference=0.5",
    ] {
        assert!(!limited(&[other]), "{other}");
    }
}

/// On its yield plateau a body as strong as the interface shears in the layer of elements below it: the slip at inception
/// and G follow the mesh, and their errors contain that.
#[test]
fn shear_on_a_yield_plateau_is_in_the_error() {
    let run = |elements: usize| {
        let set = format!("numerics.elements_per_radius={elements}");
        let scene =
            of_preset("carbon-steel-en1993", &["loading.interference=0.3", "numerics.sectors=4", &set]);
        simulate(&scene, &Unwatched).unwrap()
    };
    let (coarse, fine) = (run(8), run(20));
    let warned =
        coarse.account.warnings.iter().find(|warning| matches!(warning, Warning::EqualStrength { .. }));
    assert!(warned.unwrap().to_string().contains("up to a plastic strain of 0.0183"));
    for quantity in [Quantity::EnergyRelease, Quantity::InceptionSlip] {
        let (stated, finer) = (coarse.scalars[quantity], fine.scalars[quantity].value);
        let without =
            (stated.error.powi(2) - coarse.budget.part(ErrorSource::Model, quantity).powi(2)).sqrt();
        let change = (finer - stated.value).abs();
        assert!(without < change && change < stated.error, "{quantity:?} {stated:?} {finer}");
    }
}

/// On one mesh heat changes load and friction by about the expected effect, which decides whether it is neglected.
#[test]
fn the_expected_effect_of_heat_is_that_of_the_simulation() {
    for (preset, interference, slip_rate) in
        [("steel-4340", 0.5, 0.08), ("steel-1045", 5.0, 0.1), ("copper", 40.0, 2.0)]
    {
        let run = |heat| simulate(&hot_scene(preset, interference, slip_rate, heat), &Unwatched).unwrap();
        let (coupled, none) = (run("on").scalars, run("off").scalars);
        let radius = none[Quantity::ContactRadius].value;
        let effect =
            HeatEffect::expected(&hot_scene(preset, interference, slip_rate, "on"), slip_rate, radius);
        for (quantity, expected) in [(Quantity::Load, effect.load), (Quantity::Mu, effect.friction())] {
            let change = (coupled[quantity].value / none[quantity].value - 1.0).abs();
            assert!((0.2..1.5).contains(&(change / expected)), "{preset} {quantity:?}: {change} {expected}");
        }
    }
}

/// Negligible heat is left out: all but the temperatures is as without, and these have the expected rise as error.
#[test]
fn negligible_heat_is_left_out() {
    let run = |heat| simulate(&hot_scene("steel-4340", 2.0, 1e-5, heat), &Unwatched).unwrap();
    let (auto, off) = (run("auto"), run("off"));
    assert!(!auto.account.heat);
    assert_eq!(auto.slide, off.slide);
    let rise = auto.scalars[Quantity::TemperatureMax].value - off.scalars[Quantity::TemperatureMax].value;
    assert!(rise > 0.0 && auto.scalars[Quantity::TemperatureMax].error >= rise, "{rise}");
    // Beside a counterface of five times the conductivity and capacity e/(e + e₂) = 1/6, of the same capacity
    // 1/(1 + √5) at first; k/(k + ρk₂) at last.
    for (capacity, first) in [(5.0, 1.0 / 6.0), (1.0, 1.0 / (1.0 + 5f64.sqrt()))] {
        let mut scene = hot_scene("steel-4340", 2.0, 1e-5, "auto");
        let material = &scene.material;
        scene.counterface.thermal_conductivity = Some((5.0 * material.thermal_conductivity.value).into());
        scene.counterface.specific_heat = Some((capacity * material.specific_heat.value).into());
        scene.counterface.density = Some(material.density);
        let scalars = simulate(&scene, &Unwatched).unwrap().scalars;
        let partition = scalars[Quantity::HeatPartition];
        let steady = 1.0 / (1.0 + 5.0 * scene.constriction(scalars[Quantity::ContactRadius].value));
        let expected = 2.0 / 3f64.sqrt() * (first - steady);
        assert!((partition.value / first - 1.0).abs() < 1e-12, "{capacity}: {partition:?}");
        assert!((partition.error - expected).abs() < 1e-5, "{capacity}: {partition:?} {expected}");
        // With V = 0 it is the steady one.
        scene.loading.slip_rate = 0.0;
        let resting = simulate(&scene, &Unwatched).unwrap().scalars[Quantity::HeatPartition];
        assert!((resting.value / steady - 1.0).abs() < 1e-4, "{resting:?} {steady}");
        assert!(resting.error > 0.0 && resting.error < 0.01 * steady, "{resting:?}");
        // At 10 m/s the counterface takes up much more than at rest.
        (scene.loading.slip_rate, scene.model.heat) = (10.0, Switch::Off);
        let fast = simulate(&scene, &Unwatched).unwrap().scalars[Quantity::HeatPartition];
        assert!(fast.error > 0.3 * fast.value, "{capacity}: {fast:?}");
    }
}
