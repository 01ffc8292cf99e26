//! Press once, slide at any number of slip rates.
//!
//! Each run has companions on a coarser mesh, from which its errors are estimated (see
//! `error_budget`); where they are larger than asked, and the scene leaves the choice, it
//! is repeated more finely. The companions run before it, side by side if there are threads for them,
//! and tell how many sectors and increments it needs. Where the contact grows past the fine mesh, all
//! is repeated on meshes with more room.

pub mod accuracy;
#[cfg(test)]
pub(crate) mod fake;
pub mod fracture;
pub(crate) mod kinematics;
pub mod outcome;
pub mod quantities;
pub(crate) mod scalars;
pub(crate) mod summary;

use std::sync::Arc;
use std::time::Instant;

use tables::quantity::Quantity;

use crate::heat::expected::Heat;
use crate::loading::press::Increment;
use crate::loading::recording::Recording;
use crate::loading::slide::SlideFailure;
use crate::scene::{Kinematics, Scene, Switch};
use crate::simulate::accuracy::error_budget::ErrorBudget;
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::kinematics::slide_as_strained;
use crate::simulate::outcome::{Account, Outcome};
use crate::simulate::scalars::Scalars;
use crate::solver::timings::Kernel;

mod first_run;
mod pressed;
mod task;

use first_run::FirstRun;
use pressed::PressedMesh;
pub(crate) use pressed::press_coarsely;
pub use pressed::{Pressed, PressedContact, press};
use task::Task;
pub use task::{ContactPoints, Slid};

/// Where a run stands; called between increments.
///
/// ```
/// use std::sync::atomic::{AtomicBool, Ordering};
///
/// use asperity::scene::file::parse_scene;
/// use asperity::simulate::{SimulationError, Watch, simulate};
///
/// /// Stops a run once it slides.
/// #[derive(Default)]
/// struct Impatient(AtomicBool);
///
/// impl Watch for Impatient {
///     fn progress(&self, stage: &'static str, done: f64, _detail: &str) {
///         self.0.fetch_or(stage == "slide" && done > 0.01, Ordering::Relaxed);
///     }
///     fn cancelled(&self) -> bool {
///         self.0.load(Ordering::Relaxed)
///     }
/// }
///
/// # let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
/// #             [loading]\ninterference = 5\nslip_rate = 0\n\
/// #             [model]\nkinematics = \"small\"\n[numerics]\nelements_per_radius = 4\nsectors = 4\n";
/// # let scene = parse_scene(text, "this example", &[])?;
/// match simulate(&scene, &Impatient::default()) {
///     Err(SimulationError::Cancelled { partial: Some(outcome) }) => assert!(outcome.slide.len() > 1),
///     other => panic!("{other:?}"),
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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

/// Slide the pressed asperity at `slip_rate` (m/s), at small or finite strain as the scene says or
/// the strain asks for.
pub fn slide(pressed: &Pressed, slip_rate: f64, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    match pressed.scene.model.kinematics {
        Kinematics::Auto => slide_as_strained(pressed, slip_rate, watch),
        Kinematics::Small | Kinematics::Finite => slide_as_pressed(pressed, slip_rate, None, watch),
    }
}

/// A slide on the coarse mesh, to judge by what a finer one needs; it is one of its companions.
pub(crate) struct Probe {
    mesh: Arc<PressedMesh>,
    slid: Slid,
    scalars: Scalars,
}

impl Probe {
    pub fn new(pressed: &Pressed, slip_rate: f64, watch: &dyn Watch) -> Result<Self, SimulationError> {
        let task = Task::new(pressed, slip_rate, watch, &mut Vec::new());
        watch.progress("slide", 0.0, "coarse mesh");
        let (mesh, slid) = task.slide(&pressed.resolution.coarse(), |_, _| {})?;
        Ok(Self { scalars: task.scalars(&mesh, &slid), mesh, slid })
    }

    /// Largest plastic strain that the slide reaches.
    pub fn plastic_strain(&self) -> f64 {
        self.slid.history.last().map_or(0.0, |instant| instant.plastic_strain_max)
    }

    /// Whether the slide went all the way.
    pub fn complete(&self) -> bool {
        self.slid.failure.is_none()
    }

    pub fn value(&self, quantity: Quantity) -> f64 {
        self.scalars.value(quantity)
    }
}

/// Slide at the kinematics of the press; `probe` is the coarse slide, if that was made.
pub(crate) fn slide_as_pressed(
    pressed: &Pressed,
    slip_rate: f64,
    probe: Option<Probe>,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    /// Times that a run is repeated more finely.
    const REFINEMENTS: usize = 2;
    slide_refined(pressed, slip_rate, REFINEMENTS, probe, watch)
}

/// The same, repeated more finely so often at most.
pub(crate) fn slide_refined(
    pressed: &Pressed,
    slip_rate: f64,
    refinements: usize,
    probe: Option<Probe>,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    /// Share of a run's progress until it may have to be repeated.
    const FIRST_SHARE: f64 = 0.7;
    let clock = Instant::now();
    let (problem, scene) = (&pressed.problem, &pressed.scene);
    let mut notes = Vec::new();
    let task = Task::new(pressed, slip_rate, watch, &mut notes);
    let first =
        task.first_run(probe, |done, standing| watch.progress("slide", FIRST_SHARE * done, standing))?;
    let FirstRun { companions, mut resolution, mut mesh, mut fine, mut scalars, budget, notes: remeshed } =
        first;
    notes.extend(remeshed);
    let slide_time = |slid: &Slid| slid.timings.total() - slid.timings.of(Kernel::Press);
    let mut beside: f64 = companions.iter().map(|(_, slid)| slide_time(slid)).sum();
    let mut cutbacks = fine.cutbacks;
    let mut warnings = Vec::new();
    let mut stopped = false;
    let known = budget.is_some();
    let mut budget = budget.unwrap_or_else(|| ErrorBudget::unknown(&scalars));
    budget.set_model(&task.modelling_error(&fine), &scalars);
    if known {
        for _ in 0..refinements {
            let (_, parts) = budget.worst(&scalars);
            let Some(finer) = resolution.refine(&scene.numerics, &parts) else { break };
            watch.progress("slide", FIRST_SHARE, "finer");
            let result = task.slide(&finer, |done, standing| {
                let done = FIRST_SHARE + (1.0 - FIRST_SHARE) * done;
                watch.progress("slide", done, &format!("finer: {standing}"));
            });
            let (next_mesh, next) = match result {
                // What there is already is worth more than nothing.
                Err(SimulationError::Cancelled { .. }) => {
                    stopped = true;
                    break;
                }
                result => result?,
            };
            cutbacks += next.cutbacks;
            if next.failure.is_some() {
                stopped = matches!(next.failure, Some(SlideFailure::Cancelled));
                beside += slide_time(&next);
                break;
            }
            beside += slide_time(&fine);
            let next_scalars = task.scalars(&next_mesh, &next);
            if finer.elements_per_radius > resolution.elements_per_radius {
                budget.set_mesh(&next_scalars, &scalars, &finer, &resolution);
            }
            budget = budget.refined(&resolution, &finer);
            budget.set_model(&task.modelling_error(&next), &next_scalars);
            (mesh, fine, scalars, resolution) = (next_mesh, next, next_scalars, finer);
        }
        let (quantity, parts) = budget.worst(&scalars);
        if parts.total() > scene.numerics.accuracy {
            warnings.push(format!(
                "the estimated error of {} is {:.1} %, above the accuracy of {:.1} %",
                quantity.descriptor().name,
                100.0 * parts.total(),
                100.0 * scene.numerics.accuracy
            ));
        }
    } else {
        warnings.push("a run or companion did not finish: errors are unknown and given as the values".into());
    }
    watch.progress("slide", 1.0, "");

    summary::warn(scene, &fine.history, scalars.inception, &mut warnings);
    warnings.extend(task.unresolved_layer(&resolution));
    notes.insert(0, resolution.describe());
    let mut timings = fine.timings;
    timings.add(Kernel::AuxiliaryRuns, beside + pressed.seconds_beside(&mesh));
    let mut account = Account {
        elements_per_radius: resolution.elements_per_radius,
        sectors: resolution.sectors,
        unknowns: fine.unknowns,
        heat: task.heat != Heat::ModellingError,
        finite_strain: problem.finite_strain,
        steps: fine.history.len() - 1,
        cutbacks: cutbacks + companions.iter().map(|(_, slid)| slid.cutbacks).sum::<usize>(),
        newton_iterations: mesh.effort.newton + fine.effort.newton,
        krylov_iterations: mesh.effort.krylov + fine.effort.krylov,
        wall_time: pressed.wall_time + clock.elapsed().as_secs_f64(),
        timings,
        notes,
        warnings,
    };
    if stopped {
        account.warnings.push("stopped before the run was repeated more finely".into());
    }
    let outcome = summary::outcome(problem, &mesh.increments, &mut fine, &scalars, budget, account);
    match fine.failure {
        None if !stopped => Ok(outcome),
        None | Some(SlideFailure::Cancelled) => {
            Err(SimulationError::Cancelled { partial: Some(Box::new(outcome)) })
        }
        Some(failure) => Err(SimulationError::NotConverged {
            stage: "slide",
            at: format!("slip {:.4e} m", fine.history.last().map_or(0.0, |i| i.slip) * problem.units.length),
            reason: failure.to_string(),
            partial: Some(Box::new(outcome)),
        }),
    }
}

/// What one run without companions leaves, dimensionless.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    pub press: Vec<Increment>,
    pub history: Vec<crate::loading::slide::SlideState>,
}

/// One slide at any resolution, without companions: for studies of what the resolution does. Its
/// mesh is laid out for the same contact radius as those of `pressed`.
pub(crate) fn sample(
    pressed: &Pressed,
    slip_rate: f64,
    resolution: &Resolution,
    watch: &dyn Watch,
) -> Result<Sample, SimulationError> {
    let task = Task::new(pressed, slip_rate, watch, &mut Vec::new());
    let (mesh, slid) = task.slide(resolution, |_, _| {})?;
    match slid.failure {
        None => Ok(Sample { press: mesh.increments.clone(), history: slid.history }),
        Some(SlideFailure::Cancelled) => Err(SimulationError::Cancelled { partial: None }),
        Some(failure) => Err(SimulationError::NotConverged {
            stage: "slide",
            at: format!(
                "slip {:.4e} m",
                slid.history.last().map_or(0.0, |i| i.slip) * pressed.problem.units.length
            ),
            reason: failure.to_string(),
            partial: None,
        }),
    }
}

/// Press and slide as the scene says.
pub fn simulate(scene: &Scene, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    simulate_recorded(scene, &Recording::default(), watch)
}

/// Press and slide as the scene says, keeping fields as `recording` says.
pub fn simulate_recorded(
    scene: &Scene,
    recording: &Recording,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    if scene.model.heat == Switch::On && scene.loading.slip_rate == 0.0 {
        return Err(SimulationError::Unsupported("model.heat = \"on\" at slip rate 0".into()));
    }
    slide(&press(scene, watch)?.recording(recording.clone()), scene.loading.slip_rate, watch)
}
