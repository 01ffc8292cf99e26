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
    let distance = 0.05 * problem.expected_contact_radius();
    forced.run(distance, |_, _| true).unwrap();
    assert!(forced.cutbacks >= 40);
    assert!(forced.history.last().unwrap().rise_max > 1.0);

    let mut direct = ready(&problem);
    let mut before = direct.mechanics.displacement.clone();
    let slips: Vec<f64> = forced.history.iter().map(|instant| instant.slip).collect();
    for (k, pair) in slips.windows(2).enumerate() {
        let committed = direct.mechanics.displacement.clone();
        let slip_before = if k == 0 { 0.0 } else { slips[k - 1] };
        let start = extrapolate(&before, &committed, slip_before, pair[0], pair[1]);
        let sunk = direct.interference;
        direct.step(pair[0], pair[1], start, sunk).unwrap();
        before = committed;
    }
    assert_eq!(forced.history, direct.history);
    assert_eq!(forced.mechanics.displacement, direct.mechanics.displacement);
}
