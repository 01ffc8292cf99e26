//! Tangent, energies and thermal behaviour of the body.

use super::energies::MechanicalEnergies;
use super::*;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::tests::nodal;
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::material::instruction_set;
use crate::material::tests::steel;
use crate::scene::{Hardening, Material, Property, Rate, TemperatureTable};

pub(super) fn body(hardening: Hardening, sectors: Collocation) -> Body {
    body_of(&steel(hardening), sectors)
}

/// A steel with a modulus that falls by half over 400 K with a kink, and an expansion that grows.
fn varying(hardening: Hardening) -> Material {
    let property = |value: [f64; 3]| Property {
        value: value[0],
        table: Some(TemperatureTable { temperature: vec![298.0, 398.0, 698.0], value: value.to_vec() }),
    };
    Material {
        youngs_modulus: property([200e9, 190e9, 100e9]),
        thermal_expansion: property([1.2e-5, 1.4e-5, 1.5e-5]),
        ..steel(hardening)
    }
}

/// E = 500 σ_Y, ν = 0.3.
pub(crate) fn test_solid(hardening: Hardening) -> Solid {
    Solid::new(&steel(hardening), 298.0)
}

fn body_of(material: &Material, sectors: Collocation) -> Body {
    let mut meridian = MeridianMesh::new(MeshSize::new(0.1, 4));
    // With equal weights linear displacements have uniform strains in the fan too.
    meridian.weights.fill(1.0);
    Body::new(RevolvedMesh::new(meridian, sectors), Solid::new(material, 298.0))
}

pub(super) fn wave(n: usize, scale: f64, phase: f64) -> Vec<f64> {
    (0..n).map(|i| scale * (i as f64 * 0.37 + phase).sin()).collect()
}

/// Relative difference between the tangent product with `d` and the central difference of the forces along it.
fn tangent_error(body: &mut Body, u: &[f64], rise: Option<&[f64]>, d: &[f64], h: f64) -> f64 {
    let n = u.len();
    let at = |body: &mut Body, t: f64| {
        let x: Vec<f64> = u.iter().zip(d).map(|(a, b)| a + t * b).collect();
        let mut f = vec![0.0; n];
        body.internal_force(&x, rise, &mut f);
        f
    };
    let (plus, minus) = (at(body, h), at(body, -h));
    at(body, 0.0);
    assert!(body.tangent.flows.contains(&true));
    let mut product = vec![0.0; n];
    body.tangent_product(d, &mut product);
    let norm = product.iter().map(|x| x * x).sum::<f64>().sqrt();
    let error = (0..n).map(|i| ((plus[i] - minus[i]) / (2.0 * h) - product[i]).powi(2)).sum::<f64>().sqrt();
    error / norm
}

/// The tangent against finite differences of the force: exact at `first`, where loading is proportional from the
/// virgin state; with `first` as history, in error in proportion to the length of a further `step` of the same rate.
pub(super) fn check_tangent(
    body: &mut Body,
    rise: Option<&[f64]>,
    first: &[f64],
    step: &[f64],
    direction: &[f64],
    h: f64,
) {
    let error = tangent_error(body, first, rise, direction, h);
    assert!(error < 1e-6, "{error}");
    body.commit();
    let time_step = body.time_step;
    let errors = [1.0, 0.1, 1e-3, 1e-4].map(|length| {
        body.time_step = length * time_step;
        let u: Vec<f64> = first.iter().zip(step).map(|(a, b)| a + length * b).collect();
        tangent_error(body, &u, rise, direction, h * length)
    });
    let [long, shorter, short, shortest] = errors;
    assert!(long.max(shorter) < 0.03 && short < 2e-3, "{errors:?}");
    // At a strain rate the stress approaches that of another rate within a strain of C σ_Y/3G, which some steps resolve and
    // others do not.
    let fall = if time_step.is_finite() { 5.0..20.0 } else { 8.0..12.0 };
    assert!(fall.contains(&(short / shortest)), "{errors:?}");
}

#[test]
fn tangent_agrees_with_finite_differences() {
    let power = Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 };
    for material in [
        steel(Hardening::None),
        steel(Hardening::Linear { modulus: 2e9 }),
        steel(power.clone()),
        varying(Hardening::None),
        varying(power),
    ] {
        for rate in [Rate::None, Rate::JohnsonCook { coefficient: 0.02, reference: 1.0 }] {
            let mut body = body_of(&Material { rate, ..material.clone() }, Collocation::full(4));
            body.time_step = if rate == Rate::None { f64::INFINITY } else { 1e-7 };
            let n = body.mesh.field_length(3);
            let heat = wave(body.mesh.field_length(1), 100.0, 0.3);
            let rise: Vec<f64> = heat.iter().map(|t| t + 150.0).collect();
            // Strains of a few per cent in the fine elements.
            let [first, step, d] =
                [(2e-4, 0.1), (1e-4, 1.0), (1e-4, 2.0)].map(|(scale, phase)| wave(n, scale, phase));
            check_tangent(&mut body, Some(&rise), &first, &step, &d, 1e-6);
        }
    }
}

/// Trapezoidal work of the internal forces = change of elastic energy + plastic work + work through
/// thermal expansion + elastic energy given up by softening moduli, whatever the step.
#[test]
fn internal_work_is_stored_or_dissipated() {
    for material in [steel, varying] {
        let mut body = body_of(&material(Hardening::Linear { modulus: 2e9 }), Collocation::full(4));
        let n = body.mesh.field_length(3);
        let (u0, u1) = (wave(n, 1e-4, 0.1), wave(n, 1.5e-4, 0.4));
        let (mut f0, mut f1) = (vec![0.0; n], vec![0.0; n]);
        let cool: Vec<f64> = wave(body.mesh.field_length(1), 50.0, 1.0).iter().map(|t| t + 60.0).collect();
        body.internal_force(&u0, Some(&cool), &mut f0);
        body.commit();
        let hot: Vec<f64> = wave(body.mesh.field_length(1), 50.0, 0.0).iter().map(|t| t + 150.0).collect();
        body.internal_force(&u1, Some(&hot), &mut f1);
        let work: f64 = (0..n).map(|i| 0.5 * (f0[i] + f1[i]) * (u1[i] - u0[i])).sum();
        let MechanicalEnergies { plastic, thermal_expansion, moduli_softening } = body.step_energies();
        let elastic = body.elastic_energy(&body.trial) - body.elastic_energy(&body.committed);
        assert!(plastic > 0.0);
        assert_eq!(moduli_softening != 0.0, body.solid.stiffness_varies());
        let balance = work - elastic - plastic - thermal_expansion - moduli_softening;
        assert!(balance.abs() < 1e-12 * work.abs().max(plastic), "{balance} {moduli_softening}");
        let mut nodal = vec![0.0; body.mesh.field_length(1)];
        body.add_plastic_work(1.0, &mut nodal);
        assert!((nodal.iter().sum::<f64>() - plastic).abs() < 1e-12 * plastic);
    }
}

/// ∫α dT of the table in [`varying`] from 298 K, by hand.
fn expansion(rise: f64) -> f64 {
    let first = |x: f64| 1.2e-5 * x + 0.5 * 2e-8 * x * x;
    match rise {
        x if x < 100.0 => first(x),
        x => first(100.0) + 1.4e-5 * (x - 100.0) + 0.5 * (1e-6 / 300.0) * (x - 100.0).powi(2),
    }
}

/// A uniformly heated body that is free to expand has no stress, whatever its modulus; clamped, its
/// mean stress is −3K(T)∫α dT.
#[test]
fn uniform_heat_stresses_only_what_is_held() {
    for rise in [50.0, 100.0, 250.0] {
        let mut body = body_of(&varying(Hardening::None), Collocation::full(8));
        let u = nodal(&body.mesh, |x| x.map(|x| expansion(rise) * x));
        let heat = vec![rise; body.mesh.field_length(1)];
        let mut force = vec![0.0; u.len()];
        body.internal_force(&u, Some(&heat), &mut force);
        let factor =
            if rise <= 100.0 { 1.0 - 0.05 * rise / 100.0 } else { 0.95 - 0.45 * (rise - 100.0) / 300.0 };
        let bulk = factor * 200e9 / (3.0 * (1.0 - 2.0 * 0.3)) / 400e6;
        let held = -3.0 * bulk * expansion(rise);
        assert!(body.trial.mean_stress.iter().all(|p| p.abs() < 1e-10 * held.abs()));
        assert!(body.trial.deviator.iter().all(|s| s.abs() < 1e-10 * held.abs()));

        body.internal_force(&vec![0.0; u.len()], Some(&heat), &mut force);
        for p in &body.trial.mean_stress {
            assert!((p / held - 1.0).abs() < 1e-12, "{p} {held}");
        }
    }
}

/// Uniaxial-like loading at a uniform temperature: flowing points lie on σ_y(ε_p, T), elastic ones
/// have the energy of E(T).
#[test]
fn yield_strength_and_modulus_are_those_of_the_temperature() {
    let mut body = body_of(&varying(Hardening::Linear { modulus: 2e9 }), Collocation::full(4));
    let u = wave(body.mesh.field_length(3), 2e-4, 0.1);
    let heat = vec![250.0; body.mesh.field_length(1)];
    let mut force = vec![0.0; u.len()];
    body.internal_force(&u, Some(&heat), &mut force);
    let lanes = body.mesh.sectors.columns();
    let mut flowing = 0;
    for (i, &strain) in body.trial.accumulated.iter().enumerate() {
        let (point, l) = (i / lanes, i % lanes);
        let s = |c: usize| {
            body.trial.deviator[state::value_index(TENSOR, [point / POINTS, c, point % POINTS], lanes) + l]
        };
        let squared: f64 = (0..TENSOR).map(|c| if c < 3 { s(c) * s(c) } else { 2.0 * s(c) * s(c) }).sum();
        let (von_mises, strength) = ((1.5 * squared).sqrt(), body.solid.yield_strength(strain, 250.0));
        if strain > 0.0 {
            flowing += 1;
            assert!((von_mises / strength - 1.0).abs() < 1e-10, "{von_mises} {strength}");
        } else {
            assert!(von_mises <= strength * (1.0 + 1e-12));
        }
    }
    assert!(flowing > 100);
    // With small displacements E(250 K) = 0.725 E: forces in proportion.
    let small: Vec<f64> = u.iter().map(|x| 1e-6 * x).collect();
    let mut cold = body_of(&steel(Hardening::None), Collocation::full(4));
    let mut reference = vec![0.0; u.len()];
    cold.internal_force(&small, None, &mut reference);
    let material = Material { thermal_expansion: 1.2e-5.into(), ..varying(Hardening::None) };
    let mut hot = body_of(&material, Collocation::full(4));
    let (mut with, mut without) = (vec![0.0; u.len()], vec![0.0; u.len()]);
    hot.internal_force(&small, Some(&heat), &mut with);
    hot.internal_force(&vec![0.0; u.len()], Some(&heat), &mut without);
    let largest = reference.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    for i in 0..u.len() {
        assert!((with[i] - without[i] - 0.725 * reference[i]).abs() < 1e-6 * largest);
    }
}

#[test]
fn axisymmetric_and_revolved_bodies_agree() {
    let mut flat =
        body(Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 }, Collocation::axisymmetric());
    let n = flat.mesh.field_length(3);
    let mut u = wave(n, 2e-4, 0.1);
    for node in 0..flat.mesh.node_count() {
        u[3 * node + 1] = 0.0;
    }
    let mut force = vec![0.0; n];
    flat.internal_force(&u, None, &mut force);
    flat.commit();
    let mesh = RevolvedMesh::new(flat.mesh.meridian.clone(), Collocation::full(8));
    let mut round = Body::revolve(&flat, mesh);
    let mut round_force = vec![0.0; round.mesh.field_length(3)];
    round.internal_force(&round.mesh.sectors.spread(&u), None, &mut round_force);
    let scale = force.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    for node in 0..flat.mesh.node_count() {
        for c in [0, 2] {
            let sum: f64 = (0..8).map(|j| round_force[(3 * node + c) * 8 + j]).sum();
            assert!((sum - force[3 * node + c]).abs() < 1e-12 * scale);
        }
    }
    let (strain, alike) = (round.trial.largest_plastic_strain(), flat.committed.largest_plastic_strain());
    assert!((strain - alike).abs() < 1e-12 * alike);
}

/// Kernels for AVX-512 and those of the program give the same bits; also on a processor without AVX-512 the groups of
/// lanes are covered.
#[test]
fn instruction_sets_agree_bit_for_bit() {
    let hardening = Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 };
    for (count, finite) in [1, 4, 8, 12, 16].into_iter().flat_map(|count| [(count, false), (count, true)]) {
        let mut body = body_of(&varying(hardening.clone()), Collocation::full(count));
        if finite {
            body = body.at_finite_strain();
        }
        let u = wave(body.mesh.field_length(3), if finite { 3e-4 } else { 1e-4 }, 0.0);
        let rise: Vec<f64> =
            wave(body.mesh.field_length(1), 100.0, 0.5).iter().map(|rise| 150.0 + rise).collect();
        let compute = || {
            let (mut body, mut force, mut loss) = (body.clone(), vec![0.0; u.len()], vec![0.0; u.len()]);
            body.internal_force(&u, Some(&rise), &mut force);
            assert!(body.tangent.flows.contains(&true));
            let zone = body.inelastic_zone();
            body.stiffness_loss(&zone, &wave(u.len(), 1.0, 0.3), &mut loss);
            let state = [body.trial.plastic_strain, body.trial.deviator, body.trial.accumulated];
            [force, loss, state.concat()].concat()
        };
        let (widest, narrow) = (compute(), instruction_set::narrow(compute));
        assert!(widest.iter().zip(&narrow).all(|(a, b)| a.to_bits() == b.to_bits()), "{count} {finite}");
        assert!(widest.iter().all(|x| x.is_finite()), "{count} {finite}");
    }
}
