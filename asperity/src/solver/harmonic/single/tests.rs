//! Sweeps in single precision against those in double precision, and sweeps over a part of the body.

use super::*;
use crate::discretisation::collocation::Collocation;
use crate::discretisation::element::RevolvedMesh;
use crate::discretisation::mesh::{MeridianMesh, MeshSize};
use crate::material::elasticity::Moduli;
use crate::material::instruction_set;

fn factors(sectors: usize) -> HarmonicFactors {
    let meridian = MeridianMesh::new(MeshSize::new(0.05, 4));
    let mesh = RevolvedMesh::new(meridian, Collocation::full(sectors));
    HarmonicFactors::elastic(&mesh, Moduli::new(250.0, 0.3), &|| false).unwrap()
}

/// A force that every harmonic has its share of, zero where the axis has no unknowns, without a hoop component
/// if it does not depend on θ.
fn force(factors: &HarmonicFactors) -> Vec<f64> {
    let nodal: Vec<f64> =
        (0..factors.on_axis.len() * 3 * factors.harmonics()).map(|i| (0.7 * i as f64).sin()).collect();
    let mut modal = vec![0.0; factors.modal_length()];
    factors.to_modal(&nodal, &mut modal);
    if factors.harmonics() == 1 {
        modal.iter_mut().skip(1).step_by(SIZE).for_each(|hoop| *hoop = 0.0);
    }
    modal
}

/// Entry of the modal vector at each entry of a sweep.
fn order(single: &SingleFactors) -> Vec<usize> {
    let size = SIZE * single.harmonics();
    let positions = single.positions_before(0);
    positions
        .flat_map(|position| (0..size).map(move |i| (position, i)))
        .map(|(position, i)| single.reversed(position as usize) * size + i)
        .collect()
}

#[test]
fn a_force_on_few_nodes_reaches_what_they_are_eliminated_into() {
    for sectors in [1, 8] {
        let factors = factors(sectors);
        let single = SingleFactors::new(&factors);
        let all: Vec<u32> = single.positions_before(0).collect();
        let mut marked: Vec<bool> = all.iter().map(|position| position % 50 == 7).collect();
        let touched = marked.iter().filter(|&&is| is).count();
        let size = SIZE * single.harmonics();
        let force = force(&factors);
        let force: Vec<f32> = order(&single)
            .iter()
            .enumerate()
            .map(|(at, &i)| if marked[at / size] { force[i] as f32 } else { 0.0 })
            .collect();
        single.close(&mut marked);
        let (within, beyond): (Vec<u32>, Vec<u32>) =
            all.iter().partition(|position| marked[**position as usize]);
        assert!(within.len() > touched + single.rings && !beyond.is_empty());

        let mut whole = force.clone();
        single.forward(&mut whole, &all);
        single.backward(&mut whole, &all);
        let mut parts = force.clone();
        single.forward(&mut parts, &within);
        single.backward(&mut parts, &within);
        single.backward(&mut parts, &beyond);
        assert_eq!(whole, parts);
    }
}

#[test]
fn single_precision_solves_what_double_does() {
    for sectors in [1, 4, 8, 12] {
        let factors = factors(sectors);
        let single = SingleFactors::new(&factors);
        let force = force(&factors);
        let mut exact = force.clone();
        factors.forward(&mut exact);
        factors.solve_free_contact(&mut exact);
        factors.backward(&mut exact);
        let largest = exact.iter().fold(0.0f64, |m, x| m.max(x.abs()));

        let lanes = factors.harmonics();
        for rings in [0, 1, 3, single.rings] {
            let positions: Vec<u32> = single.positions_before(rings).collect();
            let order = order(&single);
            let mut x: Vec<f32> = order.iter().map(|&i| force[i] as f32).collect();
            single.forward(&mut x, &positions);
            // The dense system of the innermost rings, harmonic by harmonic.
            let n = SIZE * rings;
            let mut stiffness = vec![nalgebra::DMatrix::<f64>::zeros(n, n); lanes];
            single.schur_complement(rings, |i, j, m, value| stiffness[m][(i, j)] = value);
            let first = x.len() - n * lanes;
            let position =
                |i: usize, m: usize| first + (SIZE * (rings - 1 - i / SIZE) + i % SIZE) * lanes + m;
            for (m, stiffness) in stiffness.into_iter().enumerate().filter(|_| n > 0) {
                let right = nalgebra::DVector::from_fn(n, |i, _| f64::from(x[position(i, m)]));
                let left = stiffness.cholesky().unwrap().solve(&right);
                (0..n).for_each(|i| x[position(i, m)] = left[i] as f32);
            }
            single.backward(&mut x, &positions);
            for (&a, &i) in x.iter().zip(&order) {
                let (a, b) = (f64::from(a), exact[i]);
                assert!((a - b).abs() < 1e-4 * largest, "{sectors} {rings} {i}: {a} {b}");
            }
        }
    }
}

/// Sweeps for AVX-512 and those of the program give the same bits, in both precisions.
#[test]
fn instruction_sets_agree_bit_for_bit() {
    for sectors in [1, 4, 8, 12, 16] {
        let factors = factors(sectors);
        let single = SingleFactors::new(&factors);
        let positions: Vec<u32> = single.positions_before(0).collect();
        let force = force(&factors);
        let sweep = || {
            let mut x: Vec<f32> = order(&single).iter().map(|&i| force[i] as f32).collect();
            single.forward(&mut x, &positions);
            single.backward(&mut x, &positions);
            let mut modal = force.clone();
            factors.forward(&mut modal);
            factors.backward(&mut modal);
            (
                x.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
                modal.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
            )
        };
        assert_eq!(sweep(), instruction_set::narrow(sweep), "{sectors}");
    }
}
