//! Press once, slide at any number of slip rates.
//!
//! Each run is made twice, on the mesh and increments that the accuracy asks for and on ones
//! half as fine in every direction; the difference is the stated error of each number.

use std::time::Instant as Clock;

use crate::body::Body;
use crate::conduction::Conduction;
use crate::contact::Contact;
use crate::mechanics::{Effort, Mechanics};
use crate::mesh::MeshSize;
use crate::outcome::{Account, Outcome};
use crate::press::{self, Increment, PressFailure};
use crate::problem::{Discretisation, Problem};
use crate::resolution::{Resolution, choose_heat, softening_number};
use crate::scene::{Control, Kinematics, Scene, Switch};
use crate::sectors::Sectors;
use crate::slide::{Increments, Slide, SlideFailure};
use crate::summary;

/// Where a run stands; called between increments.
pub trait Watch: Sync {
    /// `stage` is "press" or "slide", `done` the share of that stage that is done (0 to 1).
    fn progress(&self, _stage: &'static str, _done: f64, _detail: &str) {}
    /// True once the run shall stop; what is there is returned in the error.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Watches nothing.
pub struct Unwatched;
impl Watch for Unwatched {}

#[derive(Debug, thiserror::Error)]
pub enum SimulationError {
    #[error("the {stage} did not converge at {at}: {reason}")]
    NotConverged {
        stage: &'static str,
        at: String,
        reason: String,
        /// Converged steps before the failure; the summary is of those.
        partial: Option<Box<Outcome>>,
    },
    #[error("stopped on request")]
    Cancelled { partial: Option<Box<Outcome>> },
    #[error("not supported: {0}")]
    Unsupported(String),
}

/// One resolution of the pressed asperity.
struct PressedMesh {
    resolution: Resolution,
    discretisation: Discretisation,
    /// Axisymmetric state at the end of the press.
    body: Body,
    contact: Contact,
    displacement: Vec<f64>,
    increments: Vec<Increment>,
    effort: Effort,
}

/// Asperity after the press, in full stick: start of slides at any slip rate.
pub struct Pressed {
    scene: Scene,
    problem: Problem,
    fine: PressedMesh,
    coarse: PressedMesh,
    wall_time: f64,
}

impl Pressed {
    /// Increments of the press on the fine mesh.
    pub(crate) fn increments(&self) -> &[Increment] {
        &self.fine.increments
    }
}

/// Press the asperity to the interference of the scene, in full stick and without heat.
pub fn press(scene: &Scene, watch: &dyn Watch) -> Result<Pressed, SimulationError> {
    let clock = Clock::now();
    if scene.loading.control == Control::Load {
        return Err(SimulationError::Unsupported("loading.control = \"load\"; use \"interference\"".into()));
    }
    if scene.model.kinematics == Kinematics::Finite {
        return Err(SimulationError::Unsupported(
            "model.kinematics = \"finite\"; use \"small\" or \"auto\"".into(),
        ));
    }
    let problem = Problem::new(scene);
    let fine = Resolution::choose(&scene.numerics);
    let coarse = fine.half();
    watch.progress("press", 0.0, "coarse mesh");
    let coarse = press_mesh(&problem, coarse, problem.expected_contact_radius(), watch)?;
    watch.progress("press", 0.3, "fine mesh");
    let radius = coarse.contact.radius(&coarse.contact.committed);
    let fine = press_mesh(&problem, fine, radius, watch)?;
    watch.progress("press", 1.0, "");
    Ok(Pressed { scene: scene.clone(), problem, fine, coarse, wall_time: clock.elapsed().as_secs_f64() })
}

/// Presses on meshes laid out for the contact radius, until the edge lies where the mesh expects it.
fn press_mesh(
    problem: &Problem,
    resolution: Resolution,
    mut radius: f64,
    watch: &dyn Watch,
) -> Result<PressedMesh, SimulationError> {
    /// Offset of the edge from its place between two rings, in ring spacings, that is good enough.
    const CLOSE_ENOUGH: f64 = 0.15;
    const LAYOUTS: usize = 4;
    for layout in 1.. {
        if watch.cancelled() {
            return Err(SimulationError::Cancelled { partial: None });
        }
        let size = MeshSize { contact_radius: radius, elements_per_radius: resolution.elements_per_radius };
        let (mechanics, increments) =
            press::press_on(problem, size, resolution.sectors).map_err(press_error)?;
        let reached = mechanics.contact.radius(&mechanics.contact.committed);
        let spacing = 0.5 / resolution.elements_per_radius as f64;
        if (reached / radius - 1.0).abs() <= CLOSE_ENOUGH * spacing || layout == LAYOUTS {
            let effort = mechanics.effort;
            let (body, contact, displacement) = mechanics.into_parts();
            let discretisation = Discretisation::new(problem, size, Sectors::full(resolution.sectors))
                .map_err(|e| press_error(e.into()))?;
            return Ok(PressedMesh {
                resolution,
                discretisation,
                body,
                contact,
                displacement,
                increments,
                effort,
            });
        }
        radius = reached;
    }
    unreachable!("the last layout is always taken")
}

fn press_error(failure: PressFailure) -> SimulationError {
    let (at, reason) = match failure {
        PressFailure::Factor(error) => ("the elastic stiffness".into(), error.to_string()),
        PressFailure::Step { interference, failure } => {
            (format!("interference {interference:.4} omega_c"), failure.to_string())
        }
    };
    SimulationError::NotConverged { stage: "press", at, reason, partial: None }
}

/// One slide on one mesh, as far as it came.
struct Slid {
    history: Vec<crate::slide::Instant>,
    fields: Vec<crate::slide::Fields>,
    effort: Effort,
    cutbacks: usize,
    failure: Option<SlideFailure>,
}

fn slide_mesh(
    pressed: &PressedMesh,
    problem: &Problem,
    speed: f64,
    heat: bool,
    distance: f64,
    watch: impl FnMut(f64) -> bool,
) -> Result<Slid, SimulationError> {
    let mesh = &pressed.discretisation.mesh;
    let body = Body::revolve(&pressed.body, mesh.clone());
    let contact = Contact::revolve(&pressed.contact, mesh, problem.contact_modulus);
    let displacement = mesh.sectors.spread(&pressed.displacement);
    let mechanics = Mechanics::new(body, contact, pressed.discretisation.factors.clone(), displacement);
    let conduction = if heat {
        let conduction = Conduction::new(mesh, problem.heat_capacity).map_err(|e| press_error(e.into()))?;
        Some(conduction.with_properties(problem.thermal_properties.clone()))
    } else {
        None
    };
    let mut slide = Slide::new(problem, mechanics, conduction, if heat { speed } else { 0.0 });
    let increments = Increments { growth: pressed.resolution.growth };
    slide.record_fields();
    let failure = slide.run(distance, increments, watch).err();
    slide.record_fields();
    Ok(Slid {
        effort: slide.mechanics.effort,
        history: slide.history,
        fields: slide.fields,
        cutbacks: slide.cutbacks,
        failure,
    })
}

/// Slide the pressed asperity at `slip_rate` (m/s).
pub fn slide(pressed: &Pressed, slip_rate: f64, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    let clock = Clock::now();
    let problem = &pressed.problem;
    let scene = &pressed.scene;
    let units = problem.units;
    let speed = slip_rate / units.speed();
    let radius = pressed.fine.contact.radius(&pressed.fine.contact.committed);
    let number = softening_number(scene, slip_rate, radius * units.length);
    let mut notes = Vec::new();
    let heat = choose_heat(scene, slip_rate, number, &mut notes);
    let ratio = scene.loading.slip_distance;
    // Each mesh slides as far in units of its own contact radius.
    let distance = |mesh: &PressedMesh| ratio * mesh.contact.radius(&mesh.contact.committed);
    let fine = slide_mesh(&pressed.fine, problem, speed, heat, distance(&pressed.fine), |done| {
        watch.progress("slide", 0.85 * done, "fine mesh");
        !watch.cancelled()
    })?;
    let complete = fine.failure.is_none();
    let coarse = if complete {
        slide_mesh(&pressed.coarse, problem, speed, heat, distance(&pressed.coarse), |done| {
            watch.progress("slide", 0.85 + 0.15 * done, "coarse mesh");
            !watch.cancelled()
        })?
    } else {
        Slid { history: vec![], fields: vec![], effort: Effort::default(), cutbacks: 0, failure: None }
    };

    let mut warnings = Vec::new();
    summary::warn(scene, &fine.history, &mut warnings);
    let fine_scalars = summary::Scalars::new(problem, scene, &pressed.fine.increments, &fine.history);
    let coarse_scalars = (complete && coarse.failure.is_none())
        .then(|| summary::Scalars::new(problem, scene, &pressed.coarse.increments, &coarse.history));
    if coarse_scalars.is_none() {
        warnings.push(
            "the coarse companion run did not finish: errors are unknown and given as the values themselves"
                .into(),
        );
    }
    let account = Account {
        elements_per_radius: pressed.fine.resolution.elements_per_radius,
        sectors: pressed.fine.resolution.sectors,
        unknowns: pressed.fine.discretisation.mesh.field_length(3),
        heat,
        steps: fine.history.len() - 1,
        cutbacks: fine.cutbacks + coarse.cutbacks,
        newton_iterations: pressed.fine.effort.newton + fine.effort.newton,
        krylov_iterations: pressed.fine.effort.krylov + fine.effort.krylov,
        wall_time: pressed.wall_time + clock.elapsed().as_secs_f64(),
        notes: {
            notes.insert(0, pressed.fine.resolution.describe(&pressed.coarse.resolution));
            notes
        },
        warnings,
    };
    let outcome = summary::outcome(
        problem,
        &pressed.fine.contact,
        &pressed.discretised_angles(),
        pressed.increments(),
        &fine.history,
        &fine.fields,
        summary::estimate(&fine_scalars, coarse_scalars.as_ref()),
        account,
    );
    match fine.failure {
        None => Ok(outcome),
        Some(SlideFailure::Cancelled) => Err(SimulationError::Cancelled { partial: Some(Box::new(outcome)) }),
        Some(failure) => Err(SimulationError::NotConverged {
            stage: "slide",
            at: format!("slip {:.4e} m", fine.history.last().map_or(0.0, |i| i.slip) * units.length),
            reason: failure.to_string(),
            partial: Some(Box::new(outcome)),
        }),
    }
}

impl Pressed {
    fn discretised_angles(&self) -> Vec<f64> {
        self.fine.discretisation.mesh.sectors.angles()
    }
}

/// Press and slide as the scene says.
pub fn simulate(scene: &Scene, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    if scene.model.heat == Switch::On && scene.loading.slip_rate == 0.0 {
        return Err(SimulationError::Unsupported("model.heat = \"on\" at slip rate 0".into()));
    }
    slide(&press(scene, watch)?, scene.loading.slip_rate, watch)
}
