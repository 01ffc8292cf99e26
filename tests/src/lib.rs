//! Scenes and comparisons that the verification tests share.
//!
//! The tests compare the whole program with references that this project did not write: closed
//! forms and fits of the literature (`tables::closed_forms` and numbers quoted with their source),
//! and properties that follow from the equations alone. What can be tested on one module is
//! tested beside it.

use asperity::outcome::{Outcome, SlideStep};
use asperity::scene::{
    Control, FrictionLaw, Hardening, Interface, InterfaceStrength, Kinematics, Loading, Material, Model,
    Numerics, Scene, Softening, Switch,
};
use asperity::scene_file::parse_scene;
use asperity::simulate::{SimulationError, Unwatched, Watch, simulate};
use std::sync::atomic::{AtomicBool, Ordering};
use tables::closed_forms::{hertz, partial_slip};

/// Steel-like material without hardening, thermal expansion or softening.
///
/// σ_Y/E = 1/5000: at ω_c the contact radius is 0.0005 R, so that the sphere is a half space to
/// the contact.
pub fn plain_material(poisson_ratio: f64) -> Material {
    Material {
        youngs_modulus: 200e9,
        poisson_ratio,
        yield_strength: 40e6,
        hardening: Hardening::None,
        density: 7850.0,
        specific_heat: 475.0,
        thermal_conductivity: 45.0,
        thermal_expansion: 0.0,
        softening: Softening::None,
        fracture: None,
        dependence: Default::default(),
    }
}

/// The shipped 4340 steel (Johnson & Cook 1985), with its hardening and softening.
pub fn steel_4340() -> Material {
    let text = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 1\nslip_rate = 1\n";
    parse_scene(text, "steel-4340", &[]).expect("the preset is a material").material
}

/// Sphere of 1 mm under the given law, at slip rate 0 and `interference` in ω_c; slides hardly.
pub fn scene(material: Material, law: FrictionLaw, interference: f64, mesh: Mesh) -> Scene {
    Scene {
        material,
        radius: 1e-3,
        interface: Interface {
            law,
            strength: InterfaceStrength::Initial,
            strength_factor: 1.0,
            heat_partition: 1.0,
            gap_conductance: 0.0,
            taylor_quinney: 0.0,
        },
        loading: Loading {
            interference,
            slip_rate: 0.0,
            slip_distance: 1e-6,
            control: Control::Interference,
            temperature: 298.0,
        },
        // The references of most tests are of small strain.
        model: Model { heat: Switch::Auto, kinematics: Kinematics::Small },
        numerics: Numerics {
            accuracy: 0.02,
            elements_per_radius: Some(mesh.elements),
            sectors: Some(mesh.sectors),
        },
    }
}

/// Resolution of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh {
    /// n_c, elements per contact radius.
    pub elements: usize,
    /// N_θ over the half circle.
    pub sectors: usize,
}

/// n_c elements and N_θ sectors.
pub const fn mesh(elements: usize, sectors: usize) -> Mesh {
    Mesh { elements, sectors }
}

/// Runs a scene that must converge.
pub fn run(scene: &Scene) -> Outcome {
    let outcome = simulate(scene, &Unwatched).unwrap_or_else(|error| panic!("{error}: {scene:?}"));
    println!(
        "n_c {} N_theta {}: {} steps, {} Newton, {:.1} s",
        outcome.account.elements_per_radius,
        outcome.account.sectors,
        outcome.account.steps,
        outcome.account.newton_iterations,
        outcome.account.wall_time
    );
    outcome
}

/// Runs only the press of a scene: the slide is cancelled after its first, tiny increment.
pub fn press(scene: &Scene) -> Outcome {
    #[derive(Default)]
    struct UntilSlide(AtomicBool);
    impl Watch for UntilSlide {
        fn progress(&self, stage: &'static str, done: f64, _detail: &str) {
            self.0.fetch_or(stage == "slide" && done > 0.0, Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed)
        }
    }
    match simulate(scene, &UntilSlide::default()) {
        Err(SimulationError::Cancelled { partial: Some(outcome) }) => *outcome,
        Err(error) => panic!("{error}: {scene:?}"),
        Ok(_) => panic!("the slide was not cancelled: {scene:?}"),
    }
}

/// State before any slip.
pub fn pressed(outcome: &Outcome) -> &SlideStep {
    &outcome.slide[0]
}

/// State at the end of the slide.
pub fn last(outcome: &Outcome) -> &SlideStep {
    outcome.slide.last().expect("a slide starts with the press")
}

/// Slide interpolated linearly in slip.
pub fn at_slip(outcome: &Outcome, slip: f64, value: impl Fn(&SlideStep) -> f64) -> f64 {
    let steps = &outcome.slide;
    let after = steps.partition_point(|step| step.slip < slip).clamp(1, steps.len() - 1);
    let (a, b) = (&steps[after - 1], &steps[after]);
    let share = (slip - a.slip) / (b.slip - a.slip);
    value(a) + share * (value(b) - value(a))
}

/// Hertz's load, area and peak pressure for a scene.
pub struct Hertz {
    /// E*, Pa.
    pub modulus: f64,
    /// G*, Pa.
    pub tangential_modulus: f64,
    /// ω₀, m.
    pub interference: f64,
    /// N.
    pub load: f64,
    /// m².
    pub area: f64,
    /// m.
    pub contact_radius: f64,
    /// Pa.
    pub peak_pressure: f64,
}

impl Hertz {
    /// Frictionless elastic contact of the scene's sphere at its interference.
    pub fn of(scene: &Scene) -> Self {
        let material = &scene.material;
        let (youngs, poisson) = (material.youngs_modulus, material.poisson_ratio);
        let modulus = hertz::contact_modulus(youngs, poisson);
        let critical = hertz::critical_interference(modulus, poisson, material.yield_strength, scene.radius);
        let interference = scene.loading.interference * critical;
        Self {
            modulus,
            tangential_modulus: partial_slip::tangential_modulus(youngs, poisson),
            interference,
            load: hertz::hertz_load(modulus, scene.radius, interference),
            area: hertz::contact_area(scene.radius, interference),
            contact_radius: hertz::contact_radius(scene.radius, interference),
            peak_pressure: hertz::peak_pressure(modulus, scene.radius, interference),
        }
    }
}

/// Limit of a sequence that converges with `order`, from its values at a step and half that step.
pub fn richardson(coarse: f64, fine: f64, order: f64) -> f64 {
    fine + (fine - coarse) / (2f64.powf(order) - 1.0)
}

/// Relative difference of a value from its reference.
pub fn relative(value: f64, reference: f64) -> f64 {
    value / reference - 1.0
}

/// Asserts that `value` is within `tolerance` of `reference`, relative, and prints both.
#[track_caller]
pub fn assert_close(what: &str, value: f64, reference: f64, tolerance: f64) {
    let off = relative(value, reference);
    println!("{what}: {value:.6e}, reference {reference:.6e}, {:+.3} %", 100.0 * off);
    assert!(
        off.abs() <= tolerance,
        "{what}: {value:e} is {:+.3} % off the reference {reference:e}, allowed {:.3} %",
        100.0 * off,
        100.0 * tolerance
    );
}
