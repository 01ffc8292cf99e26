//! The simulation of one asperity: press, slide, errors.
//!
//! ```text
//! resolution from the accuracy ─► press on the coarse mesh ─► strain measure ─► heat
//!   ─► auxiliary runs ─► main run ─► scalars, error estimates ─► at most two finer runs ─► outcome
//! ```
//! The presses on other meshes are made before the first run that needs them. The main run begins beside the auxiliary runs (`early`) where a thread
//! is idle. One press ([`press`]) serves slides at any slip rate ([`slide`]). [`accuracy`] estimates errors from the values
//! of the runs; `report` collects outcome, notes and warnings; [`messages`] contains their sentences.
//!
//! Depends on `crate::loading` and the rooms below it. Chapters "What is reported" and "Errors of a run" of the book.

pub mod accuracy;
mod conditions;
pub mod derived;
mod early;
pub mod expected_time;
#[cfg(test)]
pub(crate) mod fake;
pub mod fracture;
mod ladder;
pub mod messages;
pub mod outcome;
mod prescribed_load;
mod pressed;
mod report;
mod run;
mod runs;
mod single;
mod steady;
mod strain;
mod until_steady;
pub(crate) mod values;

use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use crate::discretisation::threads::InProgress;
use crate::interface::contact::Contact;
use crate::loading::press::Increment;
use crate::loading::recording::Recording;
use crate::loading::slide::SlideFailure;
use crate::loading::state::SlideState;
use crate::scene::{Scene, Switch};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::expected_time::expected_time_but_for_hot_properties;
use crate::simulate::outcome::Outcome;
use messages::{Note, RunProgress};
pub use pressed::{Pressed, PressedContact, press};
pub(crate) use pressed::{largest_interference, press_error};
use run::Run;
use runs::Runner;
use until_steady::until_steady;

/// Times that a run is repeated more finely, at most.
const REFINEMENTS: usize = 2;

/// Follows a run and can stop it; called between increments.
///
/// ```
/// use std::sync::atomic::{AtomicBool, Ordering};
///
/// use asperity::scene::file::parse_scene;
/// use asperity::simulate::{SimulationError, Watch, simulate};
///
/// /// Stops a run once it slides.
/// #[derive(Default)]
/// struct Stopper(AtomicBool);
///
/// impl Watch for Stopper {
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
/// match simulate(&scene, &Stopper::default()) {
///     Err(SimulationError::Cancelled { partial: Some(outcome) }) => assert!(outcome.slide.len() > 1),
///     other => panic!("{other:?}"),
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Watch: Sync {
    /// `stage` is "press" or "slide", `done` the share of that stage that is done (0 to 1), less than before where a run is
    /// repeated. Called from several threads.
    fn progress(&self, _stage: &'static str, _done: f64, _detail: &str) {}
    /// True once the run shall stop; the converged steps are returned in the error.
    fn cancelled(&self) -> bool {
        false
    }
}

/// No observer: never cancels.
pub struct Unwatched;
impl Watch for Unwatched {}

#[derive(Debug, thiserror::Error)]
pub enum SimulationError {
    #[error("the {stage} did not converge at {at}: {reason}")]
    NotConverged {
        stage: &'static str,
        at: String,
        reason: String,
        /// Converged steps before the failure, or the best run before one that could not begin; the summary is of those.
        partial: Option<Box<Outcome>>,
    },
    #[error("stopped on request")]
    Cancelled { partial: Option<Box<Outcome>> },
    #[error("not supported: {0}")]
    Unsupported(String),
}

impl SimulationError {
    /// The results before it, if there are any.
    pub fn into_partial(self) -> Option<Box<Outcome>> {
        match self {
            Self::NotConverged { partial, .. } | Self::Cancelled { partial } => partial,
            Self::Unsupported(_) => None,
        }
    }

    /// The error with the results before it.
    fn with_partial(mut self, outcome: Outcome) -> Self {
        if let Self::NotConverged { partial, .. } | Self::Cancelled { partial } = &mut self {
            *partial = Some(Box::new(outcome));
        }
        self
    }

    /// The error with its partial results changed, if there are any.
    fn map_partial(mut self, change: impl FnOnce(Outcome) -> Outcome) -> Self {
        if let Self::NotConverged { partial, .. } | Self::Cancelled { partial } = &mut self {
            *partial = partial.take().map(|outcome| Box::new(change(*outcome)));
        }
        self
    }
}

/// Press and slide of a scene.
pub fn simulate(scene: &Scene, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    simulate_recorded(scene, &Recording::default(), watch)
}

/// Press and slide of a scene, with the fields chosen by `recording`.
pub fn simulate_recorded(
    scene: &Scene,
    recording: &Recording,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    if scene.model.heat == Switch::On && scene.loading.slip_rate == 0.0 {
        return Err(SimulationError::Unsupported("model.heat = \"on\" at slip rate 0".into()));
    }
    let started = Instant::now();
    if let Some((found, note)) = in_pool(|| find_what_is_open(scene, watch))? {
        until_steady::check_fields(recording, &found)?;
        let seconds = started.elapsed().as_secs_f64();
        let complete = |mut outcome: Outcome| {
            outcome.account.notes.push(note);
            outcome.account.wall_time += seconds;
            outcome
        };
        return match simulate_recorded(&found, recording, watch) {
            Ok(outcome) => Ok(complete(outcome)),
            Err(error) => Err(error.map_partial(complete)),
        };
    }
    in_pool(|| {
        // The other presses are made by the runs that start from them.
        let started = Instant::now();
        let pressed = pressed::press_coarsely(scene, watch)?;
        watch.progress("press", 1.0, "");
        let wall_time = started.elapsed().as_secs_f64();
        let pressed = Pressed { wall_time, ..pressed }.recording(recording.clone());
        slide_in_pool(&pressed, scene.loading.slip_rate, REFINEMENTS, watch)
    })
}

/// The scene with a number that its loading leaves open, and what is said of it; none where all is given.
pub(crate) fn find_what_is_open(
    scene: &Scene,
    watch: &dyn Watch,
) -> Result<Option<(Scene, Note)>, SimulationError> {
    match scene.loading.load {
        Some(load) => prescribed_load::with_interference(scene, load, watch).map(Some),
        None if scene.loading.is_until_steady() => until_steady(scene, watch).map(Some),
        None => Ok(None),
    }
}

/// Slide the pressed asperity at `slip_rate` (m/s).
pub fn slide(pressed: &Pressed, slip_rate: f64, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    let loading = &pressed.scene.loading;
    if loading.press_slip_distance.is_some() && slip_rate != loading.first_slip_rate() {
        let reason = "loading.press_slip_distance at several slip rates from one press: press at each".into();
        return Err(SimulationError::Unsupported(reason));
    }
    slide_refined(pressed, slip_rate, REFINEMENTS, watch)
}

/// Slide the pressed asperity at `slip_rate` (m/s), with at most `refinements` finer runs.
pub(crate) fn slide_refined(
    pressed: &Pressed,
    slip_rate: f64,
    refinements: usize,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    in_pool(|| slide_in_pool(pressed, slip_rate, refinements, watch))
}

/// Stack of a thread that simulates, bytes: while it waits for another one, it may compute a further run.
pub const STACK_SIZE: usize = 32 << 20;

/// A pool of threads for each simulation that is run at a time: of one, unless there are fewer of them than `threads`. In a
/// common pool a thread that waits for a part of its simulation would begin another one.
pub(crate) fn pools(threads: usize, simulations: usize) -> Result<Vec<ThreadPool>, ThreadPoolBuildError> {
    let count = simulations.clamp(1, threads);
    let pool = |n: usize| {
        let threads = threads / count + usize::from(n < threads % count);
        ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_SIZE).build()
    };
    (0..count).map(pool).collect()
}

/// A simulation on a thread of the pool. A thread outside of it would hand each divided loop to the pool and wait.
fn in_pool<R: Send>(compute: impl FnOnce() -> R + Send) -> R {
    let _in_progress = InProgress::begin();
    rayon::scope(|_| compute())
}

fn slide_in_pool(
    pressed: &Pressed,
    slip_rate: f64,
    refinements: usize,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    let started = Instant::now();
    let runner = Runner::new(pressed, slip_rate, watch)?;
    let mut ladder = runner.ladder()?;
    let mut budget = runner.judge(&ladder);
    let mut stopped = false;
    let refinements = if pressed.shears_without_limit { 0 } else { refinements };
    let expected = expected_time_but_for_hot_properties(&pressed.scene);
    while ladder.main.len() <= refinements {
        let finer = budget.as_ref().and_then(|budget| ladder.finer(budget, &pressed.numerics, expected));
        let Some(finer) = finer else { break };
        match runner.finer(&finer, ladder.result()) {
            Ok([run, coarse]) if run.failure.is_none() && coarse.failure.is_none() => {
                ladder.main.push(run);
                ladder.coarse = Some(coarse);
            }
            // Here and below the run before is the result.
            Ok([run, coarse]) => {
                stopped = run.is_cancelled() || coarse.is_cancelled();
                ladder.abandon([run, coarse]);
                break;
            }
            Err(error) => {
                stopped = matches!(error, SimulationError::Cancelled { .. });
                break;
            }
        }
        budget = runner.judge(&ladder);
    }
    if !stopped {
        match runner.steady_state(&mut ladder) {
            Ok(Some(steady)) => {
                ladder.set_steady_friction(steady);
                budget = runner.judge(&ladder);
            }
            Ok(None) => {}
            Err(_) => stopped = true,
        }
    }
    watch.progress("slide", 1.0, "");
    let wall_time = pressed.wall_time + started.elapsed().as_secs_f64();
    report::report(&runner, ladder, budget, stopped, wall_time)
}

/// Increments of the press and states of the slide of one run, dimensionless.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RunHistory {
    pub press: Vec<Increment>,
    #[serde(rename = "history")]
    pub slide: Vec<SlideState>,
}

/// One run at any resolution, without auxiliary runs: for studies of the effect of the resolution. Its
/// mesh is laid out for the contact radius of the coarse press of the scene.
pub(crate) fn run_history(
    scene: &Scene,
    slip_rate: f64,
    resolution: &Resolution,
    watch: &dyn Watch,
) -> Result<RunHistory, SimulationError> {
    let run = run_alone(scene, slip_rate, resolution, watch)?;
    Ok(RunHistory { press: run.press.increments.clone(), slide: run.history })
}

/// The contact at the end of one run at any resolution, without auxiliary runs.
pub(crate) fn contact_after_slide(
    scene: &Scene,
    slip_rate: f64,
    resolution: &Resolution,
    watch: &dyn Watch,
) -> Result<Contact, SimulationError> {
    run_alone(scene, slip_rate, resolution, watch).map(|run| run.contact)
}

fn run_alone(
    scene: &Scene,
    slip_rate: f64,
    resolution: &Resolution,
    watch: &dyn Watch,
) -> Result<Run, SimulationError> {
    in_pool(|| {
        let pressed = pressed::press_coarsely(scene, watch)?;
        let progress = RunProgress::new("", (0.0, 1.0));
        let mut run = Runner::new(&pressed, slip_rate, watch)?.run_with_room(resolution, progress)?;
        match run.failure.take() {
            None => Ok(run),
            Some(failure) => Err(slide_error(failure, run.history.last(), &pressed)),
        }
    })
}

/// The slide failed after the state `last`.
fn slide_error(failure: SlideFailure, last: Option<&SlideState>, pressed: &Pressed) -> SimulationError {
    match failure {
        SlideFailure::Cancelled => SimulationError::Cancelled { partial: None },
        failure => SimulationError::NotConverged {
            stage: "slide",
            at: format!("slip {:.4e} m", last.map_or(0.0, |state| state.slip) * pressed.problem.units.length),
            reason: failure.to_string(),
            partial: None,
        },
    }
}

#[cfg(test)]
mod tests;
