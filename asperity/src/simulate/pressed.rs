//! The press: on the planned resolutions, shared by slides at any slip rate.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;
use tables::functions::bisect;
use tables::numbers::{digits, plain};
use tables::quantity::{Estimate, Quantity};

use super::messages::StrainChoice;
use super::strain::{choose_strain, shears_without_limit};
use super::{SimulationError, Watch, in_pool};
use crate::discretisation::body::{Body, MeanStress};
use crate::discretisation::mesh::MeshSize;
use crate::interface::contact::Contact;
use crate::loading::inception::InceptionCriterion;
use crate::loading::press::{self, Increment, PressFailure};
use crate::loading::problem::Problem;
use crate::loading::recording::Recording;
use crate::scene::{Kinematics, Numerics, Scene};
use crate::simulate::accuracy::correction::Correction;
use crate::simulate::accuracy::error_budget;
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::accuracy::scatter::scatter;
use crate::solver::newton::Effort;

/// The pressed asperity on one mesh.
pub(super) struct PressedMesh {
    resolution: Resolution,
    pub(super) size: MeshSize,
    /// Axisymmetric state at the end of the press.
    pub(super) body: Body,
    pub(super) contact: Contact,
    pub(super) displacement: Vec<f64>,
    pub(super) increments: Vec<Increment>,
    pub(super) effort: Effort,
    /// Time that it took, s.
    pub(super) seconds: f64,
}

/// Asperity after the press: start of slides at any slip rate.
pub struct Pressed {
    /// Scene with the combined modulus of asperity and counterface. Its slip rate is that of a press within a time only: each
    /// slide has its own, an argument of [`super::slide`].
    pub(super) scene: Scene,
    pub(super) problem: Problem,
    /// Strain measure, where the scene leaves the choice.
    pub(super) strain: Option<StrainChoice>,
    /// Numerics of the scene, with the accuracy that resolutions are planned for.
    pub(super) numerics: Numerics,
    /// Runs are not refined then.
    pub(super) shears_without_limit: bool,
    pub(super) resolution: Resolution,
    /// Contact radius over R that meshes are laid out for.
    pub(super) contact_radius: f64,
    /// The coarse mesh; from [`press`] also that of the main run, and the coarse one in longer increments.
    pub(super) meshes: Vec<Arc<PressedMesh>>,
    pub(super) recording: Recording,
    pub(super) wall_time: f64,
}

/// Press the asperity to the interference of the scene, without heat. The scene states the length of the slides that follow.
///
/// ```
/// use asperity::scene::file::parse_scene;
/// use asperity::simulate::{Unwatched, press, slide};
///
/// let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
///             [loading]\ninterference = 5\nslip_rate = 0\nslip_distance = 0.02\n\
///             [numerics]\nelements_per_radius = 4\nsectors = 4\n";
/// let scene = parse_scene(text, "this example", &[])?;
/// // One press serves slides at any slip rate.
/// let pressed = press(&scene, &Unwatched)?;
/// let [slow, fast] = [0.1, 10.0].map(|rate| slide(&pressed, rate, &Unwatched));
/// let load = tables::quantity::Quantity::LoadPress;
/// assert_eq!(slow?.scalars[load], fast?.scalars[load]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn press(scene: &Scene, watch: &dyn Watch) -> Result<Pressed, SimulationError> {
    let started = Instant::now();
    if let Some(given) = scene.loading.to_be_found() {
        let other = if scene.loading.load.is_some() { "the interference" } else { "a number" };
        let reason = format!("{given} of several slides from one press: give {other}");
        return Err(SimulationError::Unsupported(reason));
    }
    in_pool(|| {
        let mut pressed = press_coarsely(scene, watch)?;
        watch.progress("press", 0.2, "fine mesh");
        let others = [pressed.resolution, pressed.resolution.coarse().longer_steps()];
        add_presses(&mut pressed.meshes, &pressed.problem, &others, pressed.contact_radius, watch)?;
        watch.progress("press", 1.0, "");
        pressed.wall_time = started.elapsed().as_secs_f64();
        Ok(pressed)
    })
}

/// Presses of [`press`]: on the coarse mesh, on that of the main run, and on the coarse one in longer increments.
const PRESSES: usize = 3;

/// Accuracy to plan for, at best, where the body may shear without limit: its slip lines are as narrow as the
/// elements, finer meshes gain little (mu of brass without hardening at 10 ω_c: 0.353 to 0.362 on 6 to 12 elements),
/// and the tangent is nearly singular (30 iterations of conjugate gradients in place of 8).
const ACCURACY_OF_UNLIMITED_SHEAR: f64 = 0.1;

/// Press on the coarse mesh alone; there the strain measure is decided, where the scene leaves it, and the accuracy
/// to plan for.
pub(super) fn press_coarsely(scene: &Scene, watch: &dyn Watch) -> Result<Pressed, SimulationError> {
    let mut problem = Problem::new(scene);
    let scene = &scene.with_combined_modulus();
    let mut numerics = scene.numerics.clone();
    let choose =
        |numerics: &Numerics| Resolution::choose(numerics).for_scatter(numerics, scene.loading.interference);
    let mut resolution = choose(&numerics);
    let expected = problem.expected_contact_radius();
    watch.progress("press", 0.0, "coarse mesh");
    let mut mesh = press_mesh(&problem, &resolution.coarse(), expected, watch)?;
    let strain = (scene.model.kinematics == Kinematics::Auto)
        .then(|| choose_strain(scene, &problem, &mesh.body, &mesh.contact));
    let shears_without_limit = shears_without_limit(scene, &problem, &mesh.body, &mesh.contact);
    if shears_without_limit {
        numerics.accuracy = numerics.accuracy.max(ACCURACY_OF_UNLIMITED_SHEAR);
        resolution = choose(&numerics);
    }
    let to_finite_strain = strain.is_some_and(|choice| choice.finite);
    problem.finite_strain |= to_finite_strain;
    let coarse = resolution.coarse();
    if to_finite_strain || !mesh.serves(&coarse) {
        watch.progress("press", 0.1, "coarse mesh");
        mesh = press_mesh(&problem, &coarse, expected, watch)?;
    }
    Ok(Pressed {
        scene: scene.clone(),
        problem,
        strain,
        numerics,
        shears_without_limit,
        resolution,
        contact_radius: mesh.contact.radius(&mesh.contact.committed),
        meshes: vec![Arc::new(mesh)],
        recording: Recording::default(),
        wall_time: 0.0,
    })
}

/// Presses on the meshes of those of the resolutions that `meshes` lacks.
pub(super) fn add_presses(
    meshes: &mut Vec<Arc<PressedMesh>>,
    problem: &Problem,
    resolutions: &[Resolution],
    contact_radius: f64,
    watch: &dyn Watch,
) -> Result<(), SimulationError> {
    let mut missing: Vec<&Resolution> = Vec::new();
    for resolution in resolutions {
        let known = meshes.iter().any(|mesh| mesh.serves(resolution));
        if !known && !missing.iter().any(|other| other.shares_press(resolution)) {
            missing.push(resolution);
        }
    }
    let pressed: Vec<_> =
        missing.par_iter().map(|resolution| press_mesh(problem, resolution, contact_radius, watch)).collect();
    for mesh in pressed {
        meshes.push(Arc::new(mesh?));
    }
    Ok(())
}

impl PressedMesh {
    /// Whether this is the press of slides at the resolution.
    pub(super) fn serves(&self, resolution: &Resolution) -> bool {
        self.resolution.shares_press(resolution)
    }
}

/// The contact at the end of the press, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressedContact {
    /// P, N; without the correction of mean errors, see [`Pressed::contact`].
    pub load: Estimate,
    /// A, m².
    pub area: Estimate,
    /// Peak pressure of the Hertzian distribution with the same mean over the inner half of the contact, Pa: the
    /// apex itself is alone in its ring.
    pub peak_pressure: Estimate,
    pub plastic_strain_max: f64,
}

/// p₀ of p₀√(1 − r²/a²) from the mean over the points within a/2: over r < sa that is
/// p₀ 2(1 − (1 − s²)^{3/2})/(3s²).
fn peak_pressure(contact: &Contact) -> f64 {
    let radius = contact.radius(&contact.committed);
    let inner = contact.radii.iter().take_while(|&&r| r < 0.5 * radius).count();
    // One angle; areas are those of the half body.
    let area: f64 = contact.areas[..inner].iter().sum();
    let pairs = contact.areas.iter().zip(&contact.committed).take(inner);
    let load: f64 = pairs.map(|(area, state)| area * state.pressure).sum();
    let share = 2.0 * area / (std::f64::consts::PI * radius * radius);
    load / area * 1.5 * share / (1.0 - (1.0 - share).powf(1.5))
}

impl Pressed {
    /// The contact on the mesh of the main run, with errors as those of runs and without the correction of mean errors.
    pub fn contact(&self) -> PressedContact {
        let [coarse, fine, longer] = &self.meshes[..PRESSES] else { unreachable!("made by `press`") };
        let (run, coarser) = (&self.resolution, &self.resolution.coarse());
        let units = self.problem.units;
        let estimate = |quantity, unit: f64, of: fn(&Contact) -> f64| {
            let values = [fine, coarse, longer].map(|mesh| unit * of(&mesh.contact));
            let scatter = scatter(quantity, self.scene.loading.interference, run.elements_per_radius);
            Estimate { value: values[0], error: error_budget::of_press(values, run, coarser, scatter) }
        };
        PressedContact {
            load: estimate(Quantity::LoadPress, units.force(), |contact| contact.load(&contact.committed)),
            area: estimate(Quantity::AreaPress, units.area(), |contact| contact.area(&contact.committed)),
            // Follows the load over a fixed area.
            peak_pressure: estimate(Quantity::LoadPress, units.stress, peak_pressure),
            plastic_strain_max: fine.body.committed.largest_plastic_strain(),
        }
    }

    /// P as runs report it, N.
    pub(super) fn reported_load(&self) -> f64 {
        let correction = Correction {
            inception: InceptionCriterion::None,
            law: &self.scene.interface.law,
            has_slid: false,
            interference: self.scene.loading.interference,
            peclet: 0.0,
            resolution: self.resolution,
        };
        self.contact().load.value * correction.factor(Quantity::LoadPress)
    }

    /// Error of a quantity of the press, relative: that of [`Self::contact`]. None of other quantities, on meshes other than
    /// that of the main run, and where the press was made on one mesh alone.
    pub(super) fn relative_error(&self, quantity: Quantity, resolution: &Resolution) -> Option<f64> {
        let same_mesh = resolution.elements_per_radius == self.resolution.elements_per_radius;
        if self.meshes.len() < PRESSES || !same_mesh {
            return None;
        }
        let contact = self.contact();
        let (known, exponent) = match quantity {
            Quantity::LoadPress => (contact.load, 1.0),
            Quantity::AreaPress => (contact.area, 1.0),
            Quantity::ContactRadius => (contact.area, 0.5),
            _ => return None,
        };
        Some(exponent * known.error / known.value)
    }

    pub(crate) fn mean_stresses_on_axis(&self) -> Vec<MeanStress> {
        let body = &self.meshes[1].body;
        body.mean_stresses_on_axis(&body.committed)
    }

    /// Sets the fields that slides record.
    pub fn recording(self, recording: Recording) -> Self {
        Self { recording, ..self }
    }
}

/// Presses on a mesh laid out for the contact radius, and again on one laid out for the radius that
/// was reached, so that the edge is close to its position in the layout of the mesh. Always twice, so
/// that results change smoothly with the scene.
fn press_mesh(
    problem: &Problem,
    resolution: &Resolution,
    expected_radius: f64,
    watch: &dyn Watch,
) -> Result<PressedMesh, SimulationError> {
    /// Layouts that may be tried where the contact reaches the rim of the mesh: its radius is then
    /// not known yet.
    const LAYOUTS_PAST_RIM: usize = 8;
    let started = Instant::now();
    let press_increments = resolution.press_increments();
    let size_for = |contact_radius: f64| resolution.mesh_size(contact_radius);
    let on = |mut contact_radius: f64, increments: usize| {
        for _ in 0..LAYOUTS_PAST_RIM {
            let size = size_for(contact_radius);
            if !size.fits() {
                break;
            }
            let (mechanics, increments) =
                press::press_on(problem, size, increments, &|| watch.cancelled()).map_err(press_error)?;
            if !mechanics.contact.at_rim(&mechanics.contact.committed) {
                return Ok((size, mechanics, increments));
            }
            contact_radius *= resolution.growth_zone;
        }
        Err(too_deep(problem, |radius| size_for(radius).fits()))
    };
    // In as many increments: an error of one per cent in the radius moves the edge by a twelfth of a ring at 8
    // elements, and the load at 100 omega_c by one per cent.
    let (_, first, _) = on(expected_radius, press_increments)?;
    let radius = first.contact.radius(&first.contact.committed);
    let (size, mechanics, increments) = on(radius, press_increments)?;
    let effort = mechanics.effort;
    let (body, contact, displacement) = mechanics.into_parts();
    Ok(PressedMesh {
        resolution: *resolution,
        size,
        body,
        contact,
        displacement,
        increments,
        effort,
        seconds: started.elapsed().as_secs_f64(),
    })
}

/// Part of the deepest interference that is offered in place of one too deep: the mesh of the main run is finer than that of
/// the auxiliary ones and the contact grows as it slides, for which room is needed too.
const SURE: f64 = 0.8;

/// The contact is so large that its mesh does not fit into the hemisphere.
fn too_deep(problem: &Problem, fits: impl Fn(f64) -> bool) -> SimulationError {
    SimulationError::Unsupported(format!(
        "an interference of {} omega_c presses the asperity by {} of its radius: the model needs a contact that is \
         small beside the asperity, and with this material and mesh goes to about {} omega_c",
        plain(problem.interference / problem.critical_interference),
        digits(problem.interference, 2),
        digits(SURE * deepest(problem, fits), 2),
    ))
}

/// The largest interference to offer, in ω_c, where that of the scene is so deep that already the first mesh, which is laid
/// out for the contact radius to expect, does not fit into the hemisphere.
pub(crate) fn largest_interference(scene: &Scene) -> Option<f64> {
    let problem = Problem::new(scene);
    let chosen = Resolution::choose(&scene.numerics);
    let coarse = chosen.for_scatter(&scene.numerics, scene.loading.interference).coarse();
    let fits = |radius: f64| coarse.mesh_size(radius).fits();
    (!fits(problem.expected_contact_radius())).then(|| SURE * deepest(&problem, fits))
}

/// Interference, in ω_c, up to which a mesh laid out for the contact radius to expect fits.
fn deepest(problem: &Problem, fits: impl Fn(f64) -> bool) -> f64 {
    let asked = problem.interference / problem.critical_interference;
    let [fitting, _] = bisect([0.0, asked], 50, |middle| {
        let interference = middle * problem.critical_interference;
        let there = Problem { interference, ..problem.clone() };
        fits(there.expected_contact_radius())
    });
    fitting
}

pub fn press_error(failure: PressFailure) -> SimulationError {
    let (at, reason) = match failure {
        PressFailure::Stopped => return SimulationError::Cancelled { partial: None },
        PressFailure::Factor(error) => ("the elastic stiffness".into(), error.to_string()),
        PressFailure::Step { interference, failure } => {
            (format!("interference {} omega_c", plain(interference)), failure.to_string())
        }
    };
    SimulationError::NotConverged { stage: "press", at, reason, partial: None }
}

#[cfg(test)]
mod tests;
