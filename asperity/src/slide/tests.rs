//! A step that is cut back leaves nothing behind.

use super::*;
use crate::hard_cases;
use crate::mesh::MeshSize;
use crate::press;
use crate::problem::Discretisation;
use crate::resolution::NEWTON_TOLERANCE;
use crate::sectors::Sectors;

/// A hot slide in plastic contact, coarse, ready to start.
fn ready(problem: &Problem) -> Slide<'_> {
    let size = MeshSize::new(problem.expected_contact_radius(), 4);
    let (pressed, _) = press::press_on(problem, size, 8).unwrap();
    let (body, contact, displacement) = pressed.into_parts();
    let Discretisation { mesh, factors } = Discretisation::new(problem, size, Sectors::full(4)).unwrap();
    let conduction = Conduction::new(&mesh, problem.heat_capacity).unwrap();
    let displacement = mesh.sectors.spread(&displacement);
    let body = Body::revolve(&body, mesh.clone());
    let contact = Contact::revolve(&contact, &mesh, problem.contact_modulus);
    let mechanics = Mechanics::new(body, contact, factors, displacement, NEWTON_TOLERANCE);
    let increments = Increments { growth: 0.3, coupling_limit: 4 };
    // VR/κ of 1 m/s, steel and 1 mm.
    Slide::new(problem, mechanics, Some(conduction), 80.0, increments)
}

/// Forty steps are cut back once after it was solved; the same small steps without any cut-back give
/// the same numbers to the last bit.
#[test]
fn a_cut_back_restores_the_history_completely() {
    let case = hard_cases::all().into_iter().find(|case| case.name == "interference-5").unwrap();
    let problem = Problem::new(&case.scene().unwrap());
    let mut forced = ready(&problem);
    forced.rejecting = 80;
    // Its search would start steps elsewhere.
    forced.has_begun = true;
    let distance = 0.05 * problem.expected_contact_radius();
    forced.run(distance, |_, _| true).unwrap();
    assert!(forced.cutbacks >= 40);
    assert!(forced.history.last().unwrap().rise_max > 1.0);

    let mut direct = ready(&problem);
    direct.has_begun = true;
    let mut before = direct.mechanics.displacement.clone();
    let slips: Vec<f64> = forced.history.iter().map(|instant| instant.slip).collect();
    for (k, pair) in slips.windows(2).enumerate() {
        let committed = direct.mechanics.displacement.clone();
        let slip_before = if k == 0 { 0.0 } else { slips[k - 1] };
        let start = extrapolate(&before, &committed, slip_before, pair[0], pair[1]);
        let sunk = direct.interference;
        assert!(matches!(direct.step(pair[0], pair[1], start, sunk), Ok(Attempt::Taken)));
        before = committed;
    }
    assert_eq!(forced.history, direct.history);
    assert_eq!(forced.mechanics.displacement, direct.mechanics.displacement);
}

/// The state before and the one after sliding inception are as close as the increments ask for, and
/// no attempt that leapt it leaves anything behind: work and energies still balance.
#[test]
fn sliding_inception_is_enclosed() {
    let case = hard_cases::all().into_iter().find(|case| case.name == "interference-5").unwrap();
    let problem = Problem::new(&case.scene().unwrap());
    let mut slide = ready(&problem);
    slide.run(0.1 * problem.expected_contact_radius(), |_, _| true).unwrap();
    let begun = slide.history.iter().position(|instant| instant.stick_fraction < NO_STICK).unwrap();
    let (before, after) = (slide.history[begun - 1], slide.history[begun]);
    assert!(before.stick_fraction >= NO_STICK);
    assert!(after.slip - before.slip <= slide.inception_width(after.slip) * (1.0 + 1e-9));
    // Usual increments are longer, before and after.
    for n in [begun - 4, slide.history.len() - 2] {
        let increment = slide.history[n + 1].slip - slide.history[n].slip;
        assert!(increment > 2.0 * (after.slip - before.slip), "{n}: {increment}");
    }
    let last = slide.history.last().unwrap();
    let taken = last.elastic + last.plastic + last.friction_work + last.springs + last.thermal_expansion;
    assert!((last.work - taken).abs() < 1e-6 * last.work, "{} {taken}", last.work);
}
