//! Cut-backs, the bracket of sliding inception, reversals, stops and the fall of the slip rate.

use super::increments::INCEPTION_WIDTH;
use super::*;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::mesh::MeshSize;
use crate::loading::NEWTON_TOLERANCE;
use crate::loading::press;
use crate::loading::problem::Discretisation;
use crate::material::SHEAR_RATIO;
use crate::scene::tests::parse;
use tables::closed_forms::partial_slip::mindlin;

/// A hot slide in plastic contact, coarse, ready to start.
fn ready(problem: &Problem) -> Slide<'_> {
    let size = MeshSize::new(problem.expected_contact_radius(), 4);
    let (pressed, _) = press::press_on(problem, size, 8, &|| false).unwrap();
    let (body, contact, displacement) = pressed.into_parts();
    let discretisation = Discretisation::new(problem, size, Collocation::full(4), &|| false).unwrap();
    let conduction = Conduction::new(&discretisation.mesh, problem.heat_capacity, 1).unwrap();
    let mechanics = discretisation.revolve(problem, (&body, &contact, &displacement), NEWTON_TOLERANCE);
    let mut slide = Slide::new(problem, mechanics, Some(conduction), 0.3);
    slide.motion = slip(FAST, 0.0);
    slide
}

/// VR/κ of 1 m/s, steel and 1 mm.
const FAST: f64 = 80.0;

/// Slip at VR/κ, without an effect of the strain rate.
fn slip(speed: f64, distance: f64) -> Motion {
    Motion::Slip { slip_rate: 0.0, speed, distance }
}

/// Makes the motions, without stops.
fn run(slide: &mut Slide, motions: &[Motion]) -> Result<(), SlideFailure> {
    slide.run(motions, &|| false, |_, _| {}).map(drop)
}

/// An increment to the displacement `to`, in which sliding may begin.
fn advance(slide: &Slide, to: f64) -> Advance {
    let distance = (to - slide.last().slip).abs();
    let slip_rate = slide.motion.slip_rate();
    Advance { to, dt: slide.motion.time(distance), seconds: f64::INFINITY, slip_rate, wide: false }
}

/// A steel that does not harden, as strong as its interface, at 5 ω_c and 1 m/s.
fn problem_of(changes: &[&str]) -> Problem {
    let text = "[material]\nyoungs_modulus = 200e9\npoisson_ratio = 0.3\nyield_strength = 400e6\n\
                hardening = { law = \"none\" }\ndensity = 7850.0\nspecific_heat = 475.0\n\
                thermal_conductivity = 45.0\nthermal_expansion = 1.2e-5\n\
                softening = { law = \"johnson-cook\", reference = 298.0, melting = 1793.0, exponent = 1.0 }\n\
                [asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 5.0\nslip_rate = 1.0\nslip_distance = 0.5\n";
    Problem::new(&parse(text, changes).unwrap())
}

/// Each of nineteen steps is rejected once after its solution and repeated at half the length; the same short steps
/// without rejection give identical numbers.
#[test]
fn a_cut_back_restores_the_history_completely() {
    let problem = problem_of(&[]);
    let mut forced = ready(&problem);
    forced.rejecting = 2 * (MOST_FAILURES - 1);
    // The bracketing of inception would change the steps.
    forced.has_begun = true;
    let distance = 0.05 * problem.expected_contact_radius();
    run(&mut forced, &[slip(FAST, distance)]).unwrap();
    assert_eq!(forced.cutbacks, MOST_FAILURES - 1);
    assert!(forced.history.last().unwrap().rise_max > 1.0);

    // If further increments fail, or take more work than they may, the motion ends, with the states before.
    for (most_iterations, taken) in [(usize::MAX, MOST_FAILURES - 1), (0, 0)] {
        let mut endless = ready(&problem);
        (endless.rejecting, endless.mechanics.most_iterations) = (1000, most_iterations);
        let ended = run(&mut endless, &[slip(FAST, distance)]).unwrap_err();
        let is_work = matches!(ended, SlideFailure::Step(StepFailure::TooMuchWork { most: 0 }));
        let is_failures = matches!(ended, SlideFailure::Discontinuous { failures: MOST_FAILURES, .. });
        assert!(if taken == 0 { is_work } else { is_failures }, "{ended:?}");
        assert_eq!(endless.history.len(), 1 + taken);
    }

    let mut direct = ready(&problem);
    let mut before = direct.predictor();
    let slips: Vec<f64> = forced.history.iter().map(|state| state.slip).collect();
    for (k, pair) in slips.windows(2).enumerate() {
        let committed = direct.predictor();
        let slip_before = if k == 0 { 0.0 } else { slips[k - 1] };
        let guess = Predictor::between((&before, slip_before), (&committed, pair[0]), pair[1]);
        let advance = advance(&direct, pair[1]);
        assert!(matches!(direct.step(0, advance, guess, &|| false), Ok(Attempt::Taken)));
        before = committed;
    }
    assert_eq!(forced.history, direct.history);
    assert_eq!(forced.mechanics.displacement, direct.mechanics.displacement);
}

/// Where the body shears without limit and its elements are distorted, the first step that fails ends the slide.
#[test]
fn distorted_elements_end_a_slide_of_a_body_that_shears() {
    let problem = Problem { finite_strain: true, ..problem_of(&[]) };
    for (shears, strain, cutbacks) in [(true, 1.0, 1), (true, 0.1, 2), (false, 1.0, 2)] {
        let mut slide = ready(&problem);
        slide.shears_without_limit = shears;
        slide.rejecting = 4;
        slide.history[0].plastic_strain_max = strain;
        let distance = 1e-3 * problem.expected_contact_radius();
        let ended = run(&mut slide, &[slip(FAST, distance)]);
        assert_eq!(slide.cutbacks, cutbacks, "{ended:?}");
        assert_eq!(matches!(ended, Err(SlideFailure::Distorted { .. })), cutbacks == 1, "{ended:?}");
    }
}

/// The states before and after sliding inception are within the width of the bracket, and attempts beyond
/// inception leave the totals unchanged: work and energies balance.
#[test]
fn sliding_inception_is_enclosed() {
    let problem = problem_of(&[]);
    let mut slide = ready(&problem);
    run(&mut slide, &[slip(FAST, 0.1 * problem.expected_contact_radius())]).unwrap();
    let begun = slide.history.iter().position(SlideState::slides).unwrap();
    let (before, after) = (slide.history[begun - 1], slide.history[begun]);
    assert!(!before.slides());
    assert!(after.slip - before.slip <= INCEPTION_WIDTH * after.slip * (1.0 + 1e-9));
    // Usual increments are longer, before and after.
    for n in [begun - 4, slide.history.len() - 2] {
        let increment = slide.history[n + 1].slip - slide.history[n].slip;
        assert!(increment > 2.0 * (after.slip - before.slip), "{n}: {increment}");
    }
    let last = slide.history.last().unwrap();
    let taken = last.elastic + last.plastic + last.friction_work + last.springs + last.thermal_expansion;
    assert!((last.work - taken).abs() < 1e-6 * last.work, "{} {taken}", last.work);
}

/// A weak interface releases tractions of the press in the first increment. Their heat would not depend on the slip, and raise
/// the temperature the more the shorter the increment is.
#[test]
fn released_tractions_of_the_press_do_not_heat() {
    let problem = problem_of(&["interface.law=coulomb", "interface.friction=0.02"]);
    let mut slide = ready(&problem);
    run(&mut slide, &[slip(FAST, 0.3 * problem.expected_contact_radius())]).unwrap();
    // Of a constant flux the rise grows as the root of time.
    let (first, last) = (slide.history[1], slide.history[slide.history.len() - 1]);
    let bound = last.rise_max * (first.slip / last.slip).sqrt();
    assert!(first.rise_max > 0.0 && first.rise_max < bound, "{} {bound}", first.rise_max);
}

/// The first increment begins near its end if the contact is taken to stick, and ends in the same state.
#[test]
fn a_contact_that_sticks_is_a_good_predictor() {
    let problem = problem_of(&[]);
    let step = |sticks: bool| {
        let mut slide = ready(&problem);
        let to = 3e-4 * problem.expected_contact_radius();
        let guess = if sticks { slide.sticking(to).unwrap() } else { slide.predictor() };
        let advance = advance(&slide, to);
        assert!(matches!(slide.step(0, advance, guess, &|| false), Ok(Attempt::Taken)));
        (slide.mechanics.effort.newton, slide.last().friction)
    };
    let ((fewer, friction), (more, same)) = (step(true), step(false));
    assert!(3 * fewer < 2 * more && (friction / same - 1.0).abs() < 1e-4, "{fewer} {more} {friction} {same}");
}

/// Steps to each of the slips in turn, forwards or backwards.
fn go(slide: &mut Slide, slips: impl IntoIterator<Item = f64>) {
    for to in slips {
        let guess = slide.predictor();
        let advance = advance(slide, to);
        assert!(matches!(slide.step(0, advance, guess, &|| false), Ok(Attempt::Taken)));
    }
}

/// Reversed sliding in elastic contact at a constant shear limit: friction reverses fully, and the second half
/// of the loop is the first with the sign changed. The first loading differs: shear of the press remains at
/// the edge.
#[test]
fn a_reversed_slide_closes_its_loop() {
    const STEPS: u32 = 20;
    let problem =
        problem_of(&["loading.interference=0.5", "interface.strength_factor=0.2", "model.heat=off"]);
    let mut slide = ready(&problem);
    (slide.heat, slide.motion) = (None, slip(0.0, 0.0));
    let radius = slide.history[0].radius();
    // Twice the elastic displacement τa/G at gross slip: the contact slips all over, but only towards the end.
    let far = 2.0 * problem.interface.strength_factor * SHEAR_RATIO * radius / problem.solid.moduli.shear;
    let branch = |from: f64, to: f64| {
        (1..=STEPS).map(move |k| from + (to - from) * f64::from(k) / f64::from(STEPS)).collect::<Vec<_>>()
    };
    for (from, to) in [(0.0, far), (far, -far), (-far, far)] {
        go(&mut slide, branch(from, to));
    }
    let friction: Vec<f64> = slide.history.iter().map(|state| state.friction).collect();
    let full = friction[STEPS as usize];
    let (back, forth) = friction[STEPS as usize + 1..].split_at(STEPS as usize);
    assert!(full > 0.0 && slide.history[STEPS as usize].stick_fraction == 0.0);
    assert!((back[STEPS as usize - 1] / full + 1.0).abs() < 1e-3 && back[0] < 0.8 * full);
    for (back, forth) in back.iter().zip(forth) {
        assert!((back + forth).abs() < 1e-3 * full, "{back} {forth} of {full}");
    }
    let lost = [1, 2, 3].map(|branch| slide.history[branch * STEPS as usize].friction_work);
    assert!(lost[0] > 0.0 && lost[1] > 2.0 * lost[0] && lost[2] > lost[1] + lost[0], "{lost:?}");
}

/// Slide, near-stop for a thousand times as long, slide: the contact cools and sticks, has a higher static
/// friction, reaches the same temperature again, and the energies balance.
#[test]
fn a_slide_that_stops_cools_and_restarts() {
    let problem = problem_of(&[]);
    let mut slide = ready(&problem);
    let step = 0.01 * problem.expected_contact_radius();
    let from = |slide: &Slide| slide.history.last().unwrap().slip;
    let run = |slide: &mut Slide| {
        let at = from(slide);
        go(slide, (1..=30).map(|k| at + step * f64::from(k)));
        *slide.history.last().unwrap()
    };
    let hot = run(&mut slide);
    slide.motion = slip(1e-9 * FAST, 0.0);
    slide.mechanics.contact.start_motion();
    let at = from(&slide);
    go(&mut slide, (1..=20).map(|k| at + 1.5e-6 * step * f64::from(k)));
    let cold = *slide.history.last().unwrap();
    slide.motion = slip(FAST, 0.0);
    slide.mechanics.contact.start_motion();
    let again = run(&mut slide);
    assert!(hot.rise_max > 10.0 && cold.rise_max < 1e-3 * hot.rise_max, "{hot:?} {cold:?}");
    // A point at the edge slips as long as the edge recedes in the cooling contact.
    assert!(hot.stick_fraction == 0.0 && cold.stick_fraction > 0.95, "{}", cold.stick_fraction);
    let restart = &slide.history[slide.history.len() - 30..];
    let strongest = restart.iter().map(|state| state.friction / state.area).fold(0.0, f64::max);
    assert!(strongest > 1.005 * hot.friction / hot.area, "{strongest} {hot:?}");
    assert!((again.rise_max / hot.rise_max - 1.0).abs() < 0.1, "{hot:?} {again:?}");
    let off = again.heat_in - again.heat_stored - again.heat_out;
    assert!(off.abs() < 1e-5 * again.heat_in, "{off} of {}", again.heat_in);
    let spent = again.elastic + again.plastic + again.friction_work + again.thermal_expansion;
    let off = again.work - spent - again.moduli_softening - again.springs;
    assert!(off.abs() < 1e-3 * again.work, "{off} of {}", again.work);
}

/// A press without friction, between like bodies, leaves a contact that sticks with no shear traction; of an interface without
/// friction, one that does not.
#[test]
fn a_slide_after_a_press_without_friction_begins_in_stick() {
    let like = ["counterface.youngs_modulus=200e9", "counterface.poisson_ratio=0.3"];
    for (changes, sticks) in [(&like[..], 1.0), (&["interface.law=frictionless"], 0.0)] {
        let problem = problem_of(changes);
        assert!(!problem.press_friction.sticks);
        let slide = ready(&problem);
        let contact = &slide.mechanics.contact;
        assert_eq!(slide.history[0].stick_fraction, sticks, "{changes:?}");
        assert!(contact.committed.iter().all(|state| state.traction[0].hypot(state.traction[1]) == 0.0));
    }
}

/// It is a share of the slip at which all points slip by Coulomb's law (Mindlin 1949), which is far below that of the strength.
#[test]
fn the_first_increment_follows_the_friction_law() {
    const FRICTION: f64 = 0.02;
    let friction = format!("interface.friction={FRICTION}");
    let problem =
        problem_of(&["loading.interference=0.5", "interface.law=coulomb", &friction, "model.heat=off"]);
    let mut slide = ready(&problem);
    (slide.heat, slide.motion) = (None, slip(0.0, 1.0));
    let radius = slide.history[0].radius();
    let tangential = problem.solid.moduli.shear / (2.0 - problem.poisson_ratio);
    let gross = mindlin::gross_slip_displacement(FRICTION, slide.last().load, tangential, radius);
    let first = slide.step_control().next(0.0, None) / gross;
    assert!((0.05..0.15).contains(&first), "{first}");
}

/// As the flat slows down or stops, the strength falls by less than its change with an e-fold of the slip rate in an increment, to
/// that at the new rate; after a reversal, also one after a hold, it is that of the new rate at once.
#[test]
fn increments_resolve_the_fall_of_the_slip_rate() {
    const SENSITIVITY: f64 = 0.02;
    let rate = "material.rate={ law = \"johnson-cook\", coefficient = 0.02, reference = 1.0 }";
    let problem = problem_of(&[rate, "interface.strength_factor=0.5"]);
    let slip = |slip_rate: f64, share: f64| Motion::Slip {
        slip_rate,
        speed: slip_rate * FAST,
        distance: share * problem.expected_contact_radius(),
    };
    let hold = Motion::Hold { time: 1e-6 };
    let strengthening = |motions: &[Motion], is_hot: bool| -> Vec<f64> {
        let mut slide = ready(&problem);
        slide.heat = slide.heat.filter(|_| is_hot);
        run(&mut slide, motions).unwrap();
        let before = slide.history.iter().rposition(|state| state.step + 1 < motions.len()).unwrap();
        slide.history[before..].iter().map(|state| state.rate_strengthening).collect()
    };
    for (second, least, is_hot) in [
        (slip(0.01, 0.05), SENSITIVITY * 100f64.ln(), true),
        (slip(0.01, 0.05), SENSITIVITY * 100f64.ln(), false),
        (hold, SENSITIVITY * 2f64.ln(), true),
    ] {
        let strengthening = strengthening(&[slip(1.0, 0.1), second], is_hot);
        let falls: Vec<f64> = strengthening.windows(2).map(|pair| pair[0] - pair[1]).collect();
        assert!(falls.iter().all(|fall| *fall < SENSITIVITY), "{strengthening:?}");
        assert!(falls.iter().sum::<f64>() > 0.99 * least, "{strengthening:?}");
    }
    let reversed = strengthening(&[slip(1.0, 0.1), hold, slip(-1e-4, 0.05)], true);
    assert!((reversed[1] - reversed[reversed.len() - 1]).abs() < 0.1 * SENSITIVITY, "{reversed:?}");
}

/// The first increments of a slip so slow that the contact cools within it are not lost to rounding.
#[test]
fn increments_of_a_slow_slip_are_not_shorter_than_rounding() {
    let problem = problem_of(&["interface.strength_factor=0.5"]);
    let radius = problem.expected_contact_radius();
    let mut slide = ready(&problem);
    run(&mut slide, &[slip(FAST, 0.1 * radius), slip(1e-12 * FAST, 0.02 * radius)]).unwrap();
    let slow = slide.history.windows(2).filter(|pair| pair[1].step == 1);
    let shortest = slow.map(|pair| pair[1].slip - pair[0].slip).fold(f64::INFINITY, f64::min);
    assert!(shortest > 1e-12 * radius, "{shortest}");
    let end = slide.history.last().unwrap();
    assert!(end.rise_max < 1e-6, "{end:?}");
}
