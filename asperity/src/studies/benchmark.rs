//! The kernels of a run one by one, in the state of a running slide: for `benches/kernels.rs`
//! alone, and no part of the interface.

use crate::discretisation::body::Body;
use crate::discretisation::collocation::Collocation;
use crate::heat::conduction::{Conduction, ContactHeat};
use crate::interface::contact::{Contact, FlatPosition};
use crate::loading::press::press_on;
use crate::loading::problem::{Discretisation, Problem};
use crate::loading::slide::{Motion, Slide};
use crate::material::SHEAR_RATIO;
use crate::material::lanes::Lanes;
use crate::material::{StrainPath, Trial};
use crate::scene::Scene;
use crate::simulate::accuracy::resolution::Resolution;
use crate::solver::harmonic::SingleFactors;
use crate::solver::preconditioner::Preconditioner;
use crate::solver::timings::Timings;

/// Rise that the conduction step and the internal force are given, K.
const RISE: f64 = 50.0;
/// Angles of one evaluation of plastic flow, and the number of evaluations.
const LANES: usize = 8;
const PATHS: usize = 1024;
/// Deviators at the start of a strain path and, if it were elastic, at its end.
type Ends = [[Lanes<LANES>; 6]; 2];

/// Arithmetic operations and bytes of one call, counted by hand.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    pub operations: usize,
    pub bytes: usize,
}

pub struct Kernels {
    body: Body,
    contact: Contact,
    single: SingleFactors,
    positions: Vec<u32>,
    preconditioner: Preconditioner,
    conduction: Conduction,
    flat: FlatPosition,
    displacement: Vec<f64>,
    paths: Vec<Ends>,
    rise: Vec<f64>,
    force: Vec<f64>,
    sweep: Vec<f32>,
    timings: Timings,
    steps: usize,
}

/// A strain path that rotates by some tens of degrees, to 1.5 to 2 times the strength.
fn strain_path(n: usize) -> Ends {
    let lane = |l: usize, phase: f64| (0.7 * (n * LANES + l) as f64 + phase).sin();
    let start: Lanes<LANES> = std::array::from_fn(|l| 0.6 + 0.1 * lane(l, 0.0));
    let shear: Lanes<LANES> = std::array::from_fn(|l| 1.3 + 0.2 * lane(l, 1.0));
    let zero = [0.0; LANES];
    let half = start.map(|s| -0.5 * s);
    [[half, half, start, zero, zero, zero], [half, half, start, zero, start, shear]]
}

struct Constant(Vec<f64>);

impl ContactHeat for Constant {
    fn flow(&self, point: usize, rise: f64) -> (f64, f64) {
        (self.0[point] * (1.0 - 1e-3 * rise), -1e-3 * self.0[point])
    }
}

impl Kernels {
    /// Presses the scene on one mesh and slides it by `distance` contact radii, without heat.
    pub fn new(scene: &Scene, distance: f64) -> Self {
        let problem = Problem::new(scene);
        let resolution = Resolution::choose(&scene.numerics);
        let size = resolution.mesh_size(problem.expected_contact_radius());
        let (pressed, _) =
            press_on(&problem, size, resolution.press_increments(), &|| false).expect("a press that works");
        let radius = pressed.contact.radius(&pressed.contact.committed);
        let (body, contact, displacement) = pressed.into_parts();
        let discretisation =
            Discretisation::new(&problem, size, Collocation::full(resolution.sectors), &|| false)
                .expect("factors");
        let mechanics =
            discretisation.revolve(&problem, (&body, &contact, &displacement), resolution.tolerance);
        let mesh = discretisation.mesh;
        let mut slide = Slide::new(&problem, mechanics, None, resolution.increment_growth);
        let motion = Motion::Slip { slip_rate: 0.0, speed: 0.0, distance: distance * radius };
        slide.run(&[motion], &|| false, |_, _| {}).expect("a slide that works");
        let steps = slide.history.len() - 1;
        let flat = FlatPosition { interference: problem.interference, displacement: distance * radius };
        let (body, contact, displacement) = slide.mechanics.into_parts();
        let single = SingleFactors::new(&discretisation.factors);
        Self {
            sweep: (0..single.len()).map(|i| (0.1 * i as f32).sin()).collect(),
            force: vec![0.0; displacement.len()],
            rise: vec![RISE; mesh.field_length(1)],
            conduction: Conduction::new(&mesh, problem.heat_capacity, 1).expect("factors"),
            preconditioner: Preconditioner::new(discretisation.factors.clone()),
            timings: Timings::default(),
            paths: (0..PATHS).map(strain_path).collect(),
            body,
            contact,
            positions: single.positions_before(0).collect(),
            single,
            flat,
            displacement,
            steps,
        }
    }

    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Internal force with a strain beyond that of the slide, so that what has flowed flows again.
    pub fn internal_force(&mut self) {
        let further: Vec<f64> = self.displacement.iter().map(|u| 1.02 * u).collect();
        self.body.internal_force(&further, Some(&self.rise), &mut self.force);
    }

    /// Plastic flow of many points, all below yield at first and beyond it in the end, in a first iteration.
    pub fn flow(&self) -> f64 {
        let mut sum = 0.0;
        for [start, elastic] in &self.paths {
            let trial = Trial {
                flowing: [true; LANES],
                strain: [0.01; LANES],
                strength: [self.body.solid.hardening_factor(0.01); LANES],
                softening: [1.0; LANES],
                guess: [0.0; LANES],
                time_step: f64::INFINITY,
            };
            let end = self.body.solid.flow(&StrainPath { trial, start, elastic });
            sum += end.increment[0] + end.direction[0][0];
        }
        sum
    }

    /// About 500 operations a point, a power counted as sixty, an exponential and a logarithm as thirty.
    pub fn flow_work(&self) -> Work {
        Work { operations: PATHS * LANES * 500, bytes: PATHS * size_of::<Ends>() }
    }

    /// Product with the tangent at the last internal force.
    pub fn tangent_product(&mut self) {
        let zone = self.body.inelastic_zone();
        self.body.stiffness_loss(&zone, &self.displacement, &mut self.force);
    }

    /// About 940 operations for an element that flows at one angle: strains and forces 288 each, the rest
    /// stresses; the others are passed over. Geometry is read once per element, fields once.
    pub fn tangent_work(&self) -> Work {
        let mesh = &self.body.mesh;
        let lanes = mesh.sectors.columns();
        let flowing = (self.body.flowing_share() * mesh.elements.len() as f64) as usize;
        Work {
            operations: flowing * lanes * 940,
            bytes: flowing * (size_of::<crate::discretisation::element::Element>() + 4 * 8 * 8 * lanes)
                + 4 * 8 * self.displacement.len(),
        }
    }

    /// Forward and backward, down to the contact.
    pub fn sweeps(&mut self) {
        self.single.forward(&mut self.sweep, &self.positions);
        self.single.backward(&mut self.sweep, &self.positions);
        // Bounded away from zero and infinity for any number of calls.
        self.sweep.iter_mut().enumerate().for_each(|(i, x)| *x = (0.1 * (i % 64) as f32) - 3.2);
    }

    pub fn sweeps_work(&self) -> Work {
        Work { operations: 4 * self.single.multiplications(), bytes: 2 * self.single.bytes() }
    }

    /// Transforms, sweeps and dense solve.
    pub fn precondition(&mut self) {
        self.preconditioner.update(&self.contact, &mut self.timings).expect("stable contact");
        self.preconditioner.apply(&self.displacement, &mut self.force, &mut self.timings);
    }

    /// ∂/∂θ of the displacement and its transpose.
    pub fn transform(&mut self) {
        let sectors = self.body.mesh.sectors.clone();
        sectors.differentiate(
            &crate::discretisation::collocation::VECTOR_PARITY,
            &self.displacement,
            &mut self.force,
        );
    }

    /// Contact law and factorisation of the dense stiffness; `turn` makes it another each time.
    pub fn factorise_contact(&mut self, turn: bool) {
        let limit = vec![SHEAR_RATIO * if turn { 0.99 } else { 1.0 }; self.contact.len()];
        let u = &self.displacement;
        self.contact.evaluate(|p| u[p], self.flat, &limit);
        self.preconditioner.update(&self.contact, &mut self.timings).expect("stable contact");
    }

    pub fn conduct(&mut self) {
        let heat = Constant(self.contact.areas.clone());
        let none = vec![0.0; self.rise.len()];
        let (rise, _) = self.conduction.advance(1e-6, &none, &heat).expect("a step that works");
        self.force[0] = rise[0];
    }
}
