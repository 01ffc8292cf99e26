//! The battery of a model at finite strain: tangent, small-strain limit, objectivity, and large
//! homogeneous strains against Hencky's law.

use super::super::tests::{body, check_tangent, wave};
use super::*;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::tests::nodal;
use crate::material::lanes::dot;
use crate::scene::Hardening;
use std::f64::consts::PI;

mod tube;

type Matrix = [[f64; 3]; 3];

const POWER: Hardening = Hardening::JohnsonCook { modulus: 510e6, exponent: 0.26 };
/// Of [`body`], in units of its yield strength of 400 MPa.
const YOUNG: f64 = 500.0;
const POISSON: f64 = 0.3;
const SHEAR: f64 = YOUNG / 2.6;

fn finite_body(hardening: Hardening, sectors: usize) -> Body {
    body(hardening, Collocation::full(sectors)).at_finite_strain()
}

fn times(a: &Matrix, x: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|j| a[i][j] * x[j]).sum())
}

/// Displacement of a homogeneous deformation.
fn deform(body: &Body, f: &Matrix) -> Vec<f64> {
    nodal(&body.mesh, |x| {
        let image = times(f, x);
        std::array::from_fn(|i| image[i] - x[i])
    })
}

fn force(body: &mut Body, u: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; u.len()];
    body.internal_force(u, None, &mut force);
    force
}

/// Mean P_iJ over the body, Cartesian, from the work on linear displacements.
fn mean_piola(body: &Body, force: &[f64], i: usize, j: usize) -> f64 {
    let volume: f64 = body.mesh.elements.iter().map(|e| e.volume).sum();
    // Elements have the volume of all their angles.
    let volume = volume * body.mesh.sectors.columns() as f64;
    let mut unit = [[0.0; 3]; 3];
    unit[i][j] = 1.0;
    dot(force, &nodal(&body.mesh, |x| times(&unit, x))) / volume
}

/// Rotation about the y axis, which keeps the symmetry about y = 0.
fn rotation(angle: f64) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]]
}

/// A displacement of large strain that is smooth in θ, of Cartesian harmonics up to the second.
fn smooth(body: &Body, scale: f64) -> Vec<f64> {
    nodal(&body.mesh, |[x, y, z]| {
        [
            scale * (0.5 * x - 0.3 * z + x * z + 0.4 * y * y),
            scale * (-0.3 * y + 0.6 * x * y),
            scale * (0.4 * z + 0.5 * x + 0.7 * x * x - z * z),
        ]
    })
}

/// The relative error of the small-strain moduli is of the order of the displacement gradient.
#[test]
fn moduli_of_small_strain_are_near_the_tangent_where_they_stand_for_it() {
    let mut body = finite_body(POWER, 4);
    let n = body.mesh.field_length(3);
    let d = wave(n, 1e-4, 2.0);
    for gradient in [0.2 * SMALL, SMALL] {
        // Components of the gradient of `smooth` stay below three times its scale.
        let u = smooth(&body, gradient / 3.0);
        let mut at = |t: f64| {
            let x: Vec<f64> = u.iter().zip(&d).map(|(a, b)| a + t * b).collect();
            force(&mut body, &x)
        };
        let h = 1e-4;
        let (plus, minus) = (at(h), at(-h));
        at(0.0);
        assert_eq!(body.trial.largest_plastic_strain() > 0.0, gradient == SMALL);
        let tangent = body.finite_strain.as_ref().unwrap();
        assert!(tangent.small.iter().step_by(4).all(|&small| small), "{gradient}");
        let mut product = vec![0.0; n];
        body.tangent_product(&d, &mut product);
        let apart: Vec<f64> = (0..n).map(|i| (plus[i] - minus[i]) / (2.0 * h) - product[i]).collect();
        let error = (dot(&apart, &apart) / dot(&product, &product)).sqrt();
        assert!(error < 3.0 * gradient, "{gradient}: {error}");
    }
}

/// Elastic and flowing, hot and cold: exact from the virgin state; after a history, the shorter the step.
#[test]
fn tangent_agrees_with_finite_differences_and_is_symmetric() {
    for hardening in [Hardening::None, Hardening::Linear { modulus: 2e9 }, POWER] {
        for (scale, hot) in [(0.05, false), (0.3, false), (0.3, true)] {
            let mut body = finite_body(hardening.clone(), 4);
            let n = body.mesh.field_length(3);
            let rise: Vec<f64> =
                wave(body.mesh.field_length(1), 100.0, 0.3).iter().map(|t| t + 150.0).collect();
            let rise = hot.then_some(&rise[..]);
            let first = smooth(&body, scale);
            let (d, other) = (wave(n, 1e-4, 2.0), wave(n, 1e-4, 0.7));
            let step: Vec<f64> = first.iter().zip(wave(n, 2e-4, 1.0)).map(|(a, b)| 0.2 * a + b).collect();
            check_tangent(&mut body, rise, &first, &step, &d, 1e-4);

            let (mut product, mut of_other) = (vec![0.0; n], vec![0.0; n]);
            body.tangent_product(&d, &mut product);
            body.tangent_product(&other, &mut of_other);
            let (there, back) = (dot(&other, &product), dot(&d, &of_other));
            let size = (dot(&product, &product) * dot(&other, &other)).sqrt();
            assert!((there - back).abs() < 1e-12 * size, "{there} {back}");
        }
    }
}

/// Forces and plastic strains differ from those of small strain in proportion to the strain.
#[test]
fn small_strain_is_the_limit() {
    let mut off = Vec::new();
    for scale in [1e-5, 1e-6, 1e-7] {
        // The yield strain is scaled with the strains.
        let [mut small, mut finite] = [false, true].map(|finite| {
            let mut body = body(POWER, Collocation::full(8));
            body.solid.moduli.bulk *= 1e-2 / scale;
            body.solid.moduli.shear *= 1e-2 / scale;
            if finite { body.at_finite_strain() } else { body }
        });
        let u = smooth(&small, scale);
        let (f, g) = (force(&mut small, &u), force(&mut finite, &u));
        assert!(small.trial.largest_plastic_strain() > 0.1 * scale);
        let difference: Vec<f64> = f.iter().zip(&g).map(|(a, b)| a - b).collect();
        let of_forces = (dot(&difference, &difference) / dot(&f, &f)).sqrt();
        let of_strain = finite.trial.largest_plastic_strain() / small.trial.largest_plastic_strain() - 1.0;
        assert!(of_forces < 3.0 * scale && of_strain.abs() < 3.0 * scale, "{scale}: {of_forces} {of_strain}");
        off.push(of_forces);
    }
    // First order over all scales, down to rounding.
    for pair in off.windows(2) {
        assert!((pair[0] / pair[1] - 10.0).abs() < 0.5, "{off:?}");
    }
}

/// A rigid rotation causes no stress and rotates the nodal forces of a strained body.
#[test]
fn response_is_objective() {
    for hardening in [Hardening::None, POWER] {
        for angle in [0.3, 0.5 * PI, 2.8] {
            let turn = rotation(angle);
            let mut rigid = finite_body(hardening.clone(), 8);
            let u = deform(&rigid, &turn);
            let scale = SHEAR * rigid.mesh.elements.iter().fold(0.0f64, |m, e| m.max(e.volume));
            let f = force(&mut rigid, &u);
            assert!(f.iter().all(|f| f.abs() < 1e-11 * scale), "{angle}");
            assert_eq!(rigid.trial.largest_plastic_strain(), 0.0);

            // The same strain, with and without rotation, after a common history.
            let mut still = finite_body(hardening.clone(), 8);
            let history = smooth(&still, 0.2);
            force(&mut still, &history);
            still.commit();
            let mut turned = still.clone();
            let u = smooth(&still, -0.3);
            let position = deform(&still, &turn);
            let rotated = rotate_field(&still, &turn, &u);
            let v: Vec<f64> = position.iter().zip(&rotated).map(|(a, b)| a + b).collect();
            let (f, g) = (force(&mut still, &u), force(&mut turned, &v));
            assert!(still.trial.largest_plastic_strain() > 0.05);
            for (a, b) in still.trial.deviator.iter().zip(&turned.trial.deviator) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
            for (a, b) in still.trial.mean_stress.iter().zip(&turned.trial.mean_stress) {
                assert!((a - b).abs() < 1e-9 * YOUNG, "{a} {b}");
            }
            for (a, b) in still.trial.plastic_strain.iter().zip(&turned.trial.plastic_strain) {
                assert!((a - b).abs() < 1e-11, "{a} {b}");
            }
            // The rotated forces do the same work on the rotated displacement.
            let probe = smooth(&still, 1.0);
            let work = dot(&f, &probe);
            let of_turned = dot(&g, &rotate_field(&turned, &turn, &probe));
            assert!((work - of_turned).abs() < 1e-9 * work.abs(), "{work} {of_turned}");
        }
    }
}

/// A cylindrical nodal field turned in space.
fn rotate_field(body: &Body, turn: &Matrix, field: &[f64]) -> Vec<f64> {
    let columns = body.mesh.sectors.columns();
    let mut turned = vec![0.0; field.len()];
    for node in 0..body.mesh.node_count() {
        for (j, theta) in body.mesh.sectors.angles().into_iter().enumerate() {
            let (sin, cos) = theta.sin_cos();
            let at = |c: usize| (node * 3 + c) * columns + j;
            let (r, t) = (field[at(0)], field[at(1)]);
            let [x, y, z] = times(turn, [r * cos - t * sin, r * sin + t * cos, field[at(2)]]);
            turned[at(0)] = x * cos + y * sin;
            turned[at(1)] = -x * sin + y * cos;
            turned[at(2)] = z;
        }
    }
    turned
}

/// Uniaxial stress: Kirchhoff's is E times the logarithmic strain, the sides shrink by its ν-th part;
/// beyond yield σ_y(ε_p), with half the plastic strain. From 0.36 to 2.7 times the length.
#[test]
fn uniaxial_stress_follows_henckys_law() {
    let modulus = 2e9;
    let slope = modulus / 400e6;
    for plastic in [0.0, 0.05, 0.5, 1.0] {
        for sign in [1.0, -1.0] {
            let tension = if plastic > 0.0 { 1.0 + slope * plastic } else { 0.9 };
            let axial: f64 = sign * (tension / YOUNG + plastic);
            let lateral: f64 = -sign * (POISSON * tension / YOUNG + 0.5 * plastic);
            let mut body = finite_body(Hardening::Linear { modulus }, 8);
            let mut f = [[0.0; 3]; 3];
            (f[0][0], f[1][1], f[2][2]) = (lateral.exp(), lateral.exp(), axial.exp());
            let u = deform(&body, &f);
            let forces = force(&mut body, &u);
            let expected = sign * tension / axial.exp();
            let piola = |i, j| mean_piola(&body, &forces, i, j);
            assert!((piola(2, 2) / expected - 1.0).abs() < 1e-9, "{plastic} {} {expected}", piola(2, 2));
            for (i, j) in [(0, 0), (1, 1), (0, 2), (2, 0)] {
                assert!(piola(i, j).abs() < 1e-9 * expected.abs(), "{plastic}: P_{i}{j} = {}", piola(i, j));
            }
            for strain in &body.trial.accumulated {
                assert!((strain - plastic).abs() < 1e-10, "{strain} {plastic}");
            }
        }
    }
}

/// Simple shear γ without yield: Kirchhoff's stress is τ_xz = 4G asinh(γ/2)/√(4 + γ²) and τ_xx =
/// −τ_zz = 2G asinh(γ/2) γ/√(4 + γ²), from the principal stretches and their directions (Ogden,
/// Non-linear Elastic Deformations, 1984, §2.2.6); τ_xz is largest at γ = 3.0177, where
/// (γ/2) asinh(γ/2) = √(1 + γ²/4).
#[test]
fn simple_shear_follows_henckys_law_and_turns_soft() {
    let mut body = finite_body(Hardening::None, 8);
    // The moduli are so low that the stress stays below yield.
    body.solid.moduli.bulk *= 1e-4;
    body.solid.moduli.shear *= 1e-4;
    let shear = 1e-4 * SHEAR;
    let mut stress_at = |gamma: f64| {
        let mut f = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        f[0][2] = gamma;
        let u = deform(&body, &f);
        let forces = force(&mut body, &u);
        assert_eq!(body.trial.largest_plastic_strain(), 0.0);
        let piola: Matrix =
            std::array::from_fn(|i| std::array::from_fn(|j| mean_piola(&body, &forces, i, j)));
        // P Fᵀ.
        let kirchhoff = |i: usize, j: usize| (0..3).map(|k| piola[i][k] * f[j][k]).sum::<f64>();
        (kirchhoff(0, 2), kirchhoff(2, 0), kirchhoff(0, 0), kirchhoff(1, 1), kirchhoff(2, 2))
    };
    for gamma in [1e-4f64, 0.1, 1.0, 3.0, 8.0] {
        let (xz, zx, xx, yy, zz) = stress_at(gamma);
        let common = 2.0 * shear * (0.5 * gamma).asinh() / (4.0 + gamma * gamma).sqrt();
        assert!((xz / (2.0 * common) - 1.0).abs() < 1e-9, "{gamma}: {xz}");
        assert!((zx / xz - 1.0).abs() < 1e-9);
        assert!((xx - gamma * common).abs() < 1e-9 * xz && (zz + gamma * common).abs() < 1e-9 * xz);
        assert!(yy.abs() < 1e-9 * xz);
    }
    let peak = 3.017_759;
    assert!(stress_at(peak).0 > stress_at(peak - 0.01).0 && stress_at(peak).0 > stress_at(peak + 0.01).0);
}

/// The force of an inverted element is NaN, so that no step ends in such a state.
#[test]
fn inverted_elements_are_refused() {
    let mut body = finite_body(Hardening::None, 4);
    let u = deform(&body, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -0.5]]);
    assert!(force(&mut body, &u).iter().any(|f| f.is_nan()));
}

/// The trapezoidal work of the forces is stored or dissipated up to the curvature of the forces within a
/// step; over a given path the difference is of second order in the increments.
#[test]
fn internal_work_is_stored_or_dissipated() {
    let balance = |increments: usize| {
        let mut body = finite_body(Hardening::Linear { modulus: 2e9 }, 8);
        // So that the volumetric energy does not dominate.
        body.solid.moduli.bulk *= 1e-2;
        let end = smooth(&body, 0.5);
        let mut before = vec![0.0; end.len()];
        let (mut work, mut plastic) = (0.0, 0.0);
        for k in 1..=increments {
            let u: Vec<f64> = end.iter().map(|x| k as f64 / increments as f64 * x).collect();
            let after = force(&mut body, &u);
            work += 0.5 / increments as f64 * (dot(&before, &end) + dot(&after, &end));
            plastic += body.step_energies().plastic;
            body.commit();
            before = after;
        }
        assert!(plastic > 0.3 * work, "{plastic} {work}");
        (work - plastic - body.elastic_energy(&body.committed)) / work
    };
    let (coarse, fine) = (balance(32), balance(64));
    assert!(fine.abs() < 2e-4 && (coarse / fine - 4.0).abs() < 0.5, "{coarse} {fine}");
}
