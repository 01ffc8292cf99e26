use super::*;
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::scene::fitted_constants::contact_edge::FITTED;

pub(super) fn contact() -> (RevolvedMesh, Contact) {
    let meridian = MeridianMesh::new(MeshSize::new(0.05, 4));
    let mesh = RevolvedMesh::new(meridian, Collocation::full(4));
    let contact = Contact::new(&mesh, 500.0);
    (mesh, contact)
}

/// Displacements of the order of the interference, different at each node.
fn wave(n: usize, scale: f64, phase: f64) -> Vec<f64> {
    (0..n).map(|i| scale * (i as f64 * 0.61 + phase).sin()).collect()
}

/// A limit of the shear traction at the points that touch, at a displacement; the edge is beyond none of the others.
fn where_it_touches(
    contact: &mut Contact,
    u: impl Fn(usize) -> f64,
    flat: FlatPosition,
    limit: f64,
) -> Vec<f64> {
    contact.evaluate(u, flat, &vec![0.0; contact.len()]);
    contact.trial.iter().map(|state| if state.pressure > 0.0 { limit } else { 0.0 }).collect()
}

fn force(contact: &mut Contact, u: &[f64], flat: FlatPosition, limit: &[f64]) -> Vec<f64> {
    contact.evaluate(|p| u[p], flat, limit);
    let mut residual = vec![0.0; u.len()];
    contact.subtract_force(&mut residual);
    residual
}

/// A rigid sphere that sinks in touches ring after ring. The pressure by which a ring has been penetrated since the last
/// iterate does not place the edge; it does once it is that of the iterate.
#[test]
fn a_ring_that_has_just_touched_is_at_the_edge() {
    let (_, mut contact) = contact();
    let sink = |contact: &mut Contact, interference: f64| {
        let flat = FlatPosition { interference, displacement: 0.0 };
        contact.evaluate(|_| 0.0, flat, &vec![0.0; contact.len()]);
        (contact.last_ring(0).unwrap(), contact.trial_edges()[0])
    };
    let (before, _) = sink(&mut contact, 4e-4);
    contact.begin_iteration();
    let (last, touched) = sink(&mut contact, 12e-4);
    assert!(last > before);
    assert_eq!(touched, last as f64 + 0.5 + FITTED.first_position);
    contact.begin_iteration();
    let (same, settled) = sink(&mut contact, 12e-4);
    assert!(same == last && settled > touched, "{settled} {touched}");
}

/// In stick, in slip and with both (and open nodes) side by side.
#[test]
fn tangent_agrees_with_finite_differences() {
    let (mesh, mut contact) = contact();
    let n = mesh.field_length(3);
    let flat = FlatPosition { interference: 1e-3, displacement: 2e-4 };
    let u = wave(n, 1e-4, 0.2);
    let d = wave(n, 1.0, 1.3);
    for (limit, stick, slip) in [(f64::INFINITY, true, false), (5e-4, false, true), (6.0, true, true)] {
        let limit = where_it_touches(&mut contact, |index| u[index], flat, limit);
        let h = 1e-10;
        let at = |contact: &mut Contact, t: f64| {
            let x: Vec<f64> = u.iter().zip(&d).map(|(a, b)| a + t * b).collect();
            force(contact, &x, flat, &limit)
        };
        let (plus, minus) = (at(&mut contact, h), at(&mut contact, -h));
        at(&mut contact, 0.0);
        let has = |status| contact.trial.iter().any(|state| state.status == status);
        assert_eq!((has(Status::Stick), has(Status::Slip), has(Status::Open)), (stick, slip, true));
        let mut product = vec![0.0; n];
        contact.add_tangent_product(&d, &mut product);
        let norm = product.iter().map(|x| x * x).sum::<f64>().sqrt();
        let error =
            (0..n).map(|i| ((plus[i] - minus[i]) / (2.0 * h) - product[i]).powi(2)).sum::<f64>().sqrt();
        assert!(error < 1e-5 * norm, "{error} {norm}");
    }
}

/// Points that touch after the start of a motion stick here, while the others slip: only from the next motion on do they
/// count.
#[test]
fn points_that_touch_during_a_motion_do_not_count_as_stick() {
    let (_, mut contact) = contact();
    let take = |contact: &mut Contact, interference: f64, displacement: f64, limit: f64| {
        let flat = FlatPosition { interference, displacement };
        let limit = where_it_touches(contact, |_| 0.0, flat, limit);
        contact.evaluate(|_| 0.0, flat, &limit);
        contact.commit();
        contact.stick_fraction(&contact.committed)
    };
    assert_eq!(take(&mut contact, 5e-4, 0.0, 0.3), 1.0);
    contact.start_motion();
    assert_eq!(take(&mut contact, 5e-4, 1e-2, 0.3), 0.0);
    let before = contact.area(&contact.committed);
    // The flat goes deeper and hardly further: the old points slip on, the new ones stick.
    assert_eq!(take(&mut contact, 1e-3, 1e-2 + 1e-8, 0.3), 0.0);
    assert!(contact.committed.iter().any(|state| state.status == Status::Stick));
    assert!(contact.area(&contact.committed) > 1.5 * before);
    contact.start_motion();
    let new = contact.stick_fraction(&contact.committed);
    assert!((new - (1.0 - before / contact.area(&contact.committed))).abs() < 1e-12, "{new}");
}

/// In stick the sum of the forces over that of the limits, 1 in slip; an infinite strength and none are not mobilised. The
/// forces of partly covered cells contain their coverage already.
#[test]
fn the_mobilised_strength_is_a_ratio_of_forces() {
    let (_, mut contact) = contact();
    contact.contact_fraction.iter_mut().enumerate().for_each(|(i, share)| *share = 1.0 / (1 + i % 3) as f64);
    let mut at = |displacement: f64, limit: f64| {
        let flat = FlatPosition { interference: 1e-3, displacement };
        let limit = where_it_touches(&mut contact, |_| 0.0, flat, limit);
        contact.evaluate(|_| 0.0, flat, &limit);
        let forces: f64 = (0..contact.len())
            .map(|i| contact.areas[i] * contact.trial[i].traction[0].hypot(contact.trial[i].traction[1]))
            .sum();
        let touching: f64 = (0..contact.len())
            .filter(|&i| contact.trial[i].status != Status::Open)
            .map(|i| contact.areas[i])
            .sum();
        (contact.mobilised_strength(&contact.trial), forces / (0.3 * touching))
    };
    let (mobilised, share) = at(1e-7, 0.3);
    assert!(mobilised > 0.0 && mobilised < 1.0 && (mobilised - share).abs() < 1e-12, "{mobilised} {share}");
    assert!((at(1e-2, 0.3).0 - 1.0).abs() < 1e-12);
    assert_eq!((at(1e-7, f64::INFINITY).0, at(1e-2, 0.0).0), (0.0, 0.0));
}

#[test]
fn slip_keeps_the_traction_at_the_limit_and_along_the_motion() {
    let (_, mut contact) = contact();
    let limit = vec![0.3; contact.len()];
    contact.evaluate(|_| 0.0, FlatPosition { interference: 1e-3, displacement: 0.0 }, &limit);
    contact.commit();
    let flat = FlatPosition { interference: 1e-3, displacement: 1e-2 };
    contact.evaluate(|_| 0.0, flat, &limit);
    for i in (0..contact.len()).filter(|&i| contact.trial[i].status != Status::Open) {
        assert_eq!(contact.trial[i].status, Status::Slip);
        assert!((contact.along_x(i, contact.trial[i].traction) - 0.3).abs() < 1e-12);
    }
    // The work of the flat is the frictional dissipation plus the energy of the springs.
    let work = contact.step_work(FlatPosition { interference: 1e-3, displacement: 0.0 }, flat);
    assert!((work.of_flat - work.friction).abs() < 1e-12 * work.of_flat);
    contact.commit();
    // Reversal: stick until the spring force is reversed.
    contact.evaluate(|_| 0.0, FlatPosition { interference: 1e-3, displacement: 1e-2 - 1e-8 }, &limit);
    assert!(contact.trial.iter().any(|state| state.status == Status::Stick));
}

/// The edge lies in the cell of a ring that is about to touch: neither friction nor area jumps as it does.
#[test]
fn friction_is_continuous_as_a_ring_touches() {
    let (_, mut contact) = contact();
    let ring = 4;
    let touching = -contact.height[ring];
    let at = |contact: &mut Contact, share: f64| {
        let flat = FlatPosition { interference: touching * share, displacement: 1e-2 };
        // Without friction first: the points that touch are known to the fractions.
        contact.evaluate(|_| 0.0, flat, &vec![0.0; contact.len()]);
        contact.set_edges(&vec![ring as f64 + 0.4; contact.columns]);
        let limit: Vec<f64> = contact.contact_fraction.iter().map(|fraction| 0.3 * fraction).collect();
        contact.evaluate(|_| 0.0, flat, &limit);
        let touches = contact.trial[ring * contact.columns].pressure > 0.0;
        (touches, contact.friction(&contact.trial), contact.area(&contact.trial))
    };
    let (before, after) = (at(&mut contact, 1.0 - 1e-9), at(&mut contact, 1.0 + 1e-9));
    assert_eq!((before.0, after.0), (false, true));
    assert!((before.1 / after.1 - 1.0).abs() < 1e-12 && before.1 > 0.0, "{before:?} {after:?}");
    assert!((before.2 / after.2 - 1.0).abs() < 1e-12, "{before:?} {after:?}");
    // The whole cells up to the ring and 0.4 of its own.
    let cells: f64 = (0..contact.len()).map(|i| contact.areas[i] * contact.contact_fraction[i]).sum();
    assert!((before.2 / (2.0 * cells) - 1.0).abs() < 1e-12);
}
