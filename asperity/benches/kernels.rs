//! Kernels of a slide, and the limits of the machine.
//!
//!     cargo bench -p asperity
//!
//! The columns under a kernel are bytes and operations (items) per second. `machine` measures the limits: fused
//! multiply-adds from registers on one core, and a triad through arrays larger than any cache. One thread; the other
//! cores should be idle.

use asperity::scene::Scene;
use asperity::scene::file::parse_scene;
use asperity::studies::benchmark::{Kernels, Work};
use divan::counter::{BytesCount, ItemsCount};
use divan::{Bencher, black_box};

/// (n_c, N_θ).
const SIZES: [(usize, usize); 2] = [(8, 4), (16, 8)];

fn main() {
    divan::main();
}

fn scene(elements: usize, sectors: usize, kinematics: &str) -> Scene {
    let text = format!(
        "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
         [loading]\ninterference = 20.0\nslip_rate = 1.0\n\
         [model]\nkinematics = \"{kinematics}\"\n\
         [numerics]\nelements_per_radius = {elements}\nsectors = {sectors}\n"
    );
    parse_scene(&text, "benchmark", &[]).expect("a scene")
}

fn kernels(size: (usize, usize)) -> Kernels {
    kernels_at("small", size)
}

fn kernels_at(kinematics: &str, (elements, sectors): (usize, usize)) -> Kernels {
    let mut kernels = Kernels::new(&scene(elements, sectors, kinematics), 0.1);
    kernels.internal_force();
    kernels.precondition();
    kernels
}

fn counted(bencher: Bencher, work: Work, run: impl FnMut()) {
    bencher.counter(ItemsCount::new(work.operations)).counter(BytesCount::new(work.bytes)).bench_local(run);
}

#[divan::bench(args = SIZES)]
fn internal_force(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    // The operations of a tangent product; the powers of the hardening law come on top.
    counted(bencher, kernels.tangent_work(), || kernels.internal_force());
}

/// At finite strain.
#[divan::bench(args = SIZES)]
fn internal_force_at_finite_strain(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels_at("finite", size);
    bencher.bench_local(|| kernels.internal_force());
}

/// The return mapping.
#[divan::bench]
fn plastic_flow(bencher: Bencher) {
    let kernels = kernels(SIZES[0]);
    counted(bencher, kernels.flow_work(), || {
        black_box(kernels.flow());
    });
}

#[divan::bench(args = SIZES)]
fn tangent_product(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    counted(bencher, kernels.tangent_work(), || kernels.tangent_product());
}

#[divan::bench(args = SIZES)]
fn triangular_sweeps(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    counted(bencher, kernels.sweeps_work(), || kernels.sweeps());
}

#[divan::bench(args = SIZES)]
fn preconditioner(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    bencher.bench_local(|| kernels.precondition());
}

#[divan::bench(args = SIZES)]
fn derivative_in_theta(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    bencher.bench_local(|| kernels.transform());
}

#[divan::bench(args = SIZES)]
fn contact_factorisation(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    let mut turn = false;
    bencher.bench_local(|| {
        turn = !turn;
        kernels.factorise_contact(turn);
    });
}

#[divan::bench(args = SIZES)]
fn conduction_step(bencher: Bencher, size: (usize, usize)) {
    let mut kernels = kernels(size);
    kernels.conduct();
    bencher.bench_local(|| kernels.conduct());
}

/// Press and slide by a tenth of a contact radius.
#[divan::bench(sample_count = 5)]
fn small_slide(bencher: Bencher) {
    let scene = scene(4, 4, "small");
    bencher.bench_local(|| Kernels::new(black_box(&scene), 0.1).steps());
}

mod machine {
    use super::*;

    /// 12 chains of 8 lanes keep the multiply-add units of any present processor busy.
    const CHAINS: usize = 12;
    const LANES: usize = 8;
    const ROUNDS: usize = 100_000;

    #[divan::bench]
    fn fused_multiply_add(bencher: Bencher) {
        let operations = 2 * CHAINS * LANES * ROUNDS;
        bencher.counter(ItemsCount::new(operations)).bench_local(|| {
            let (a, b) = (black_box(0.999_999), black_box(1e-6));
            let mut sums = [[1.0f64; LANES]; CHAINS];
            for _ in 0..ROUNDS {
                for chain in &mut sums {
                    for sum in chain {
                        *sum = sum.mul_add(a, b);
                    }
                }
            }
            sums
        });
    }

    #[divan::bench]
    fn triad(bencher: Bencher) {
        const LENGTH: usize = 8 << 20;
        let (b, c) = (vec![1.0f64; LENGTH], vec![2.0f64; LENGTH]);
        let mut a = vec![0.0f64; LENGTH];
        bencher.counter(BytesCount::new(3 * 8 * LENGTH)).bench_local(|| {
            let scale = black_box(3.0);
            for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
                *a = scale * c + b;
            }
            black_box(&mut a);
        });
    }
}
