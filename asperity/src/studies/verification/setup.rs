//! Scenes of the cases, and the quantities read from their outcomes.

use std::f64::consts::PI;

use tables::closed_forms::hertz;
use tables::quantity::{Estimate, Quantity, State};

use crate::scene::file::parse_scene;
use crate::scene::{
    Control, Counterface, FrictionLaw, Hardening, Interface, InterfaceStrength, Kinematics, Loading,
    Material, Model, Numerics, Rate, Scene, Softening, Switch,
};
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, simulate};

/// Steel-like material without hardening, thermal expansion or softening.
///
/// σ_Y/E = 1/5000: at ω_c the contact radius is 0.0005 R, so that the sphere is a half space to
/// the contact.
pub fn plain_material(poisson_ratio: f64) -> Material {
    Material {
        youngs_modulus: 200e9.into(),
        poisson_ratio,
        yield_strength: 40e6,
        hardening: Hardening::None,
        rate: Rate::None,
        density: 7850.0,
        specific_heat: 475.0.into(),
        thermal_conductivity: 45.0.into(),
        thermal_expansion: 0.0.into(),
        softening: Softening::None,
        fracture: None,
    }
}

/// A shipped material.
pub fn preset(name: &str) -> Material {
    slide_at_small_strain(name, 1.0, 1.0, 8).material
}

/// A shipped material at small strain, R = 1 mm, slid by two contact radii.
pub fn slide_at_small_strain(preset: &str, interference: f64, slip_rate: f64, elements: usize) -> Scene {
    let text = format!(
        "[material]\npreset = \"{preset}\"\n[asperity]\nradius = 1e-3\n\
         [loading]\ninterference = {interference:?}\nslip_rate = {slip_rate:?}\n\
         [model]\nkinematics = \"small\"\n[numerics]\nelements_per_radius = {elements}\n"
    );
    parse_scene(&text, preset, &[]).expect("presets are valid")
}

/// The shipped 4340 steel (Johnson & Cook 1985), with its hardening and softening.
pub fn steel_4340() -> Material {
    preset("steel-4340")
}

/// Sphere of 1 mm under the given law, at slip rate 0 and `interference` in ω_c; hardly slides.
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
        counterface: Counterface::default(),
        loading: Loading {
            interference,
            load: None,
            slip_rate: 0.0,
            slip_distance: 1e-6,
            steps: Vec::new(),
            press_slip_distance: None,
            control: Control::Interference,
            temperature: 298.0,
        },
        // The references of most cases are of small strain.
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

/// The press of a scene, without a slide.
pub fn run_press(scene: &Scene, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    let mut scene = scene.clone();
    scene.loading.slip_distance = 0.0;
    simulate(&scene, watch)
}

/// State before any slip.
pub fn pressed(outcome: &Outcome) -> State<'_> {
    outcome.slide.state(0)
}

/// State at the end of the slide.
pub fn last(outcome: &Outcome) -> State<'_> {
    outcome.slide.state(outcome.slide.len() - 1)
}

/// Largest value over the steps of the slide.
pub fn largest(outcome: &Outcome, value: impl Fn(State<'_>) -> f64) -> f64 {
    outcome.slide.states().skip(1).map(value).fold(0.0, f64::max)
}

/// Slide interpolated linearly in slip.
pub fn at_slip(outcome: &Outcome, slip: f64, value: impl Fn(State<'_>) -> f64) -> f64 {
    interpolated(outcome, (Quantity::Slip, slip), |slip| slip, value)
}

/// Slide where a quantity that rises has a value, interpolated linearly in a function of the quantity.
pub fn interpolated(
    outcome: &Outcome,
    (quantity, at): (Quantity, f64),
    scale: fn(f64) -> f64,
    value: impl Fn(State<'_>) -> f64,
) -> f64 {
    let column = outcome.slide.column(quantity);
    let after = column.partition_point(|x| *x < at).clamp(1, column.len() - 1);
    let (a, b) = (outcome.slide.state(after - 1), outcome.slide.state(after));
    let share = (scale(at) - scale(a[quantity])) / (scale(b[quantity]) - scale(a[quantity]));
    value(a) + share * (value(b) - value(a))
}

/// An estimate in units of `unit`.
pub fn over(estimate: Estimate, unit: f64) -> Estimate {
    Estimate { value: estimate.value / unit, error: estimate.error / unit }
}

/// Shear strength of the interface without softening, τ₀ = f_τ σ_Y/√3, Pa.
pub fn shear_strength(scene: &Scene) -> f64 {
    scene.interface.strength_factor * scene.material.yield_strength / 3f64.sqrt()
}

/// Hertz's load, contact radius and peak pressure for a scene.
pub struct Hertz {
    /// E*, Pa.
    pub modulus: f64,
    /// G*, Pa.
    pub tangential_modulus: f64,
    /// N.
    pub load: f64,
    /// m.
    pub contact_radius: f64,
    /// Pa.
    pub peak_pressure: f64,
}

impl Hertz {
    /// Frictionless elastic contact of the scene's sphere at its interference.
    pub fn of(scene: &Scene) -> Self {
        let material = scene.with_combined_modulus().material.elastic_plastic();
        let modulus = material.contact_modulus();
        let interference = scene.loading.interference * material.critical_interference(scene.radius);
        Self {
            modulus,
            tangential_modulus: material.tangential_modulus(),
            load: hertz::hertz_load(modulus, scene.radius, interference),
            contact_radius: hertz::contact_radius(scene.radius, interference),
            peak_pressure: hertz::peak_pressure(modulus, scene.radius, interference),
        }
    }

    /// Contact area, m².
    pub fn area(&self) -> f64 {
        PI * self.contact_radius * self.contact_radius
    }
}
