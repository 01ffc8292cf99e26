//! The solution of a linear system against products of the whole tangent.

use std::sync::Arc;

use super::*;
use crate::discretisation::body::{Body, test_solid};
use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::interface::contact::{Contact, FlatPosition};
use crate::scene::Hardening;
use crate::solver::harmonic::HarmonicFactors;
use crate::solver::newton::CouplingData;

/// E* and ω_c/R of [`test_solid`].
const CONTACT_MODULUS: f64 = 500.0 / 0.91;
const FIRST_YIELD: f64 = 2.1e-5;

fn factors(mesh: &RevolvedMesh, body: &Body) -> Arc<HarmonicFactors> {
    Arc::new(HarmonicFactors::elastic(mesh, body.solid.moduli, &|| false).unwrap())
}

/// Pressed in full stick to an interference, revolved, then pushed on and along, so that the body flows and no
/// angle is like another.
fn sheared(interference: f64, finite_strain: bool) -> Mechanics {
    let meridian = MeridianMesh::new(MeshSize::new((1.6 * interference).sqrt(), 6));
    let flat = RevolvedMesh::new(meridian.clone(), Collocation::axisymmetric());
    let mut body = Body::new(flat.clone(), test_solid(Hardening::Linear { modulus: 2e9 }));
    if finite_strain {
        body = body.at_finite_strain();
    }
    let contact = Contact::new(&flat, CONTACT_MODULUS);
    let elastic = factors(&flat, &body);
    let mut press = Mechanics::new(body, contact, elastic, vec![0.0; flat.field_length(3)], 1e-7);
    let stick = |contact: &Contact| vec![f64::INFINITY; contact.len()];
    // In units of the contact radius; shorter where Newton's method fails.
    let (mut done, mut increment) = (0.0f64, 0.125);
    while done < 1.0 {
        let next = (done + increment).min(1.0);
        let flat = FlatPosition { interference: interference * next * next, displacement: 0.0 };
        let start = press.displacement.clone();
        let held = |_: &mut Body, contact: &mut Contact, _| {
            Some(CouplingData { limit: stick(contact), rise: None, elevation: None, converged: true })
        };
        match press.solve(flat, LoadingControl::Interference, start.clone(), &|| false, held) {
            Ok(_) => {
                press.body.commit();
                press.contact.commit();
                done = next;
            }
            Err(failure) => {
                increment *= 0.5;
                assert!(increment > 1e-3, "{failure}");
                let fractions = press.contact.contact_fraction.clone();
                press.restore(start, fractions);
            }
        }
    }
    let (body, contact, displacement) = press.into_parts();
    let mesh = RevolvedMesh::new(meridian, Collocation::full(4));
    let body = Body::revolve(&body, mesh.clone());
    let contact = Contact::revolve(&contact, &mesh, (CONTACT_MODULUS, 0.3));
    let elastic = factors(&mesh, &body);
    let mut mechanics = Mechanics::new(body, contact, elastic, mesh.sectors.spread(&displacement), 1e-7);
    let interference = 1.03 * interference;
    let flat = FlatPosition { interference, displacement: 0.05 * interference };
    let further: Vec<f64> = mechanics.displacement.iter().map(|u| 1.01 * u).collect();
    let Mechanics { body, contact, internal, .. } = &mut mechanics;
    body.internal_force(&further, None, internal);
    contact.evaluate(|index| further[index], flat, &stick(contact));
    mechanics
}

/// Energy norm of the residual after a step along a direction.
fn left(mechanics: &mut Mechanics, residual: &[f64], direction: &[f64]) -> f64 {
    let size = mechanics.internal.len();
    let field = &direction[..size];
    let mut rest = vec![0.0; direction.len()];
    mechanics.body.tangent_product(field, &mut rest[..size]);
    mechanics.contact.add_tangent_product(field, &mut rest[..size]);
    if let Some(&height) = direction.get(size) {
        let contact = &mechanics.contact;
        contact.add_height_product(|_| height, &mut rest[..size]);
        rest[size] = contact.height_stiffness() * height + contact.load_product(field);
    }
    rest.iter_mut().zip(residual).for_each(|(rest, residual)| *rest += residual);
    let mut answer = vec![0.0; direction.len()];
    mechanics.precondition(&rest, &mut answer);
    dot(&rest, &answer)
}

/// An inverted element has forces that are no numbers.
#[test]
fn a_step_from_no_numbers_is_refused() {
    let mut mechanics = sheared(5.0 * FIRST_YIELD, false);
    let limit = vec![f64::INFINITY; mechanics.contact.len()];
    let flat = FlatPosition { interference: 5.0 * FIRST_YIELD, displacement: 0.0 };
    let start = vec![f64::NAN; mechanics.displacement.len()];
    let failure = mechanics.solve(flat, LoadingControl::Interference, start, &|| false, |_, _, _| {
        Some(CouplingData { limit: limit.clone(), rise: None, elevation: None, converged: true })
    });
    assert_eq!(failure.unwrap_err().to_string(), StepFailure::NotFinite.to_string());
}

/// The residual of the solution is computed with products of the whole tangent, which the solver never forms.
#[test]
fn solution_in_the_inelastic_zone_solves_the_whole_system() {
    for (interference, finite_strain) in [(5.0 * FIRST_YIELD, false), (100.0 * FIRST_YIELD, true)] {
        let mut mechanics = sheared(interference, finite_strain);
        let n = mechanics.displacement.len();
        let zone = mechanics.body.inelastic_zone().nodes.len() as f64;
        let share = zone / mechanics.body.mesh.node_count() as f64;
        assert!(share > 0.1 && share < 0.9, "{share}");
        for control in [LoadingControl::Interference, LoadingControl::Load(0.0)] {
            // Forces on all nodes; or a missing load alone, which moves the flat.
            let residual: Vec<f64> = match control {
                LoadingControl::Interference => (0..n).map(|i| (0.61 * i as f64).sin()).collect(),
                LoadingControl::Load(_) => (0..=n).map(|i| f64::from(i == n)).collect(),
            };
            mechanics.update_preconditioner(control).unwrap();
            let mut direction = vec![0.0; residual.len()];
            mechanics.precondition(&residual, &mut direction);
            let elastic: Vec<f64> = direction.iter().map(|x| -x).collect();
            let before = dot(&residual, &direction);
            let unanswered = (left(&mut mechanics, &residual, &elastic) / before).sqrt();
            assert!(unanswered > 0.1, "{unanswered}");
            mechanics.conjugate_gradients(&residual, &mut direction, 1e-3, &|| false);
            let unanswered = (left(&mut mechanics, &residual, &direction) / before).sqrt();
            assert!(unanswered < 1.5e-3, "{control:?}: {unanswered}");
        }
    }
}
