use nalgebra::{Matrix3, Vector3};

use super::*;
use crate::material::tensor::{cauchy_green_excess, deformation_gradient};

fn matrix(tensor: &Symmetric<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| tensor[SYMMETRIC_INDEX[i][j]])
}

fn symmetric(matrix: &Matrix3<f64>) -> Symmetric<f64> {
    PAIR.map(|at| matrix[at])
}

/// Some rotation.
fn frame() -> Matrix3<f64> {
    nalgebra::Rotation3::new(Vector3::new(0.7, -1.1, 0.4)).into_inner()
}

/// X with these eigenvalues in that frame.
fn excess(values: [f64; 3]) -> Symmetric<f64> {
    symmetric(&(frame() * Matrix3::from_diagonal(&values.into()) * frame().transpose()))
}

/// E in the frame that X was built from: near zero, equal eigenvalues, and strains of 0.3, 1 and 2.
#[test]
fn strain_is_the_logarithm() {
    let rules = Rules::new();
    for values in [
        [0.0; 3],
        [1e-9, -2e-9, 3e-9],
        [1e-4, -2e-4, 3e-5],
        [5e-3, -1e-2, 1e-2],
        [0.02, 0.02, -0.04],
        [0.4, 0.4, 0.4],
        [0.8, 0.1, -0.5],
        [6.0, 6.0 + 1e-13, -0.9],
        [60.0, -0.98, 0.0],
    ] {
        let strain = rules.log(&excess(values)).strain();
        let exact = excess(values.map(|x| 0.5 * x.ln_1p()));
        let scale = exact.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
        for (found, exact) in strain.iter().zip(&exact) {
            assert!((found - exact).abs() < 30.0 * TRUNCATION * scale, "{values:?}: {found} {exact}");
        }
    }
}

/// The first derivative is that of the strain and gives the stress, the second is that of the stress under a T
/// that does not change, all to rounding: the truncation error does not enter any balance.
#[test]
fn derivatives_are_those_of_the_approximant() {
    let rules = Rules::new();
    let log_stress = [0.7, -0.4, 0.1, 0.9, -0.3, 0.5];
    for size in [3e-3, 0.05, 0.3, 1.0] {
        let h: TwoPoint<f64> =
            [[0.3, -0.5, 0.2], [0.1, 0.4, -0.6], [-0.2, 0.7, 0.5]].map(|row| row.map(|x| size * x));
        let x = cauchy_green_excess(&h);
        let log = rules.log(&x);
        let (first, second) = log.derivatives(&log_stress);
        let at = |v: usize, w: usize| if v <= w { (v, w) } else { (w, v) };
        for w in 0..6 {
            let step = 1e-5 * (1.0 + size);
            let moved = |sign: f64| {
                let mut x = x;
                // ½C by a symmetric unit, of which shears are two halves.
                x[w] += sign * step * if w < 3 { 2.0 } else { 1.0 };
                // By the same rule.
                LogStrain { excess: x, points: log.points }
            };
            let difference = |f: &dyn Fn(&LogStrain<f64>) -> Symmetric<f64>| -> Symmetric<f64> {
                let (plus, minus) = (f(&moved(1.0)), f(&moved(-1.0)));
                std::array::from_fn(|v| (plus[v] - minus[v]) / (2.0 * step))
            };
            let of_strain = difference(&|log| log.strain());
            let of_stress = difference(&|log| log.second_piola(&log_stress));
            for v in 0..6 {
                let (i, j) = at(v, w);
                let off = [of_strain[v] - first[i][j], of_stress[v] - second[i][j]].map(f64::abs);
                assert!(off[0] < 1e-8 && off[1] < 1e-7, "{size}: {off:?}");
            }
        }
        // S:½dC = T:dE.
        let stress = log.second_piola(&log_stress);
        for w in 0..6 {
            let twice = |v: usize| if v < 3 { 1.0 } else { 2.0 };
            let work: f64 = (0..6)
                .map(|v| {
                    let (i, j) = at(v, w);
                    twice(v) * log_stress[v] * first[i][j]
                })
                .sum();
            assert!((work - stress[w]).abs() < 1e-13, "{work} {}", stress[w]);
        }
    }
}

/// T of an isotropic elastic solid shares its axes with E, so that P = F·C⁻¹·T there.
#[test]
fn coaxial_stress_is_pulled_back_by_the_inverse() {
    let h: TwoPoint<f64> = [[0.2, -0.1, 0.05], [0.0, -0.15, 0.1], [0.1, 0.05, 0.1]];
    let f = deformation_gradient(&h);
    let log = Rules::new();
    let log = log.log(&cauchy_green_excess(&h));
    let strain = log.strain();
    let piola = first_piola(&f, &log.second_piola(&strain));
    let f = Matrix3::from_fn(|i, j| f[i][j]);
    let exact = f.transpose().try_inverse().expect("regular") * matrix(&strain);
    for i in 0..3 {
        for j in 0..3 {
            assert!((piola[i][j] - exact[(i, j)]).abs() < 1e-9, "{} {}", piola[i][j], exact[(i, j)]);
        }
    }
}
