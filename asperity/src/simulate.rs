//! Press once, slide at any number of slip rates.
//!
//! Each run has companions on a coarser mesh, from which its errors are estimated (see
//! `error_budget`); where they are larger than asked, and the scene leaves the choice, it
//! is repeated more finely. The companions run beside it if there are threads for them. Where the
//! contact grows past the fine mesh, all is repeated on meshes with more room.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant as Clock;

use rayon::prelude::*;
use tables::law::Estimate;
use tables::quantity::Quantity;

use crate::body::Body;
use crate::body_fields::BodyFields;
use crate::conduction::Conduction;
use crate::contact::Contact;
use crate::error_budget::{self, Companions, ErrorBudget, ErrorSource};
use crate::kinematics::slide_as_strained;
use crate::mechanics::{Effort, Mechanics};
use crate::mesh::MeshSize;
use crate::outcome::{Account, Outcome};
use crate::press::{self, Increment, PressFailure};
use crate::problem::{Discretisation, Problem};
use crate::recording::{Fields, Recorder, Recording};
use crate::resolution::{Resolution, choose_heat, softening_number};
use crate::scalars::Scalars;
use crate::scene::{Kinematics, Scene, Switch};
use crate::sectors::Sectors;
use crate::slide::{Slide, SlideFailure};
use crate::standing;
use crate::summary;
use crate::timings::{Kernel, Timings};

/// Where a run stands; called between increments.
///
/// ```
/// use std::sync::atomic::{AtomicBool, Ordering};
///
/// use asperity::scene_file::parse_scene;
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
/// #             [numerics]\nelements_per_radius = 4\nsectors = 4\n";
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

/// The pressed asperity on one mesh.
struct PressedMesh {
    press_increments: usize,
    size: MeshSize,
    /// Axisymmetric state at the end of the press.
    body: Body,
    contact: Contact,
    displacement: Vec<f64>,
    increments: Vec<Increment>,
    effort: Effort,
    /// Time that it took, s.
    seconds: f64,
}

/// Asperity after the press, in full stick: start of slides at any slip rate.
pub struct Pressed {
    pub(crate) scene: Scene,
    problem: Problem,
    resolution: Resolution,
    /// Contact radius over R that meshes are laid out for.
    contact_radius: f64,
    /// Meshes pressed so far; more are added where a slide needs a finer one.
    meshes: Mutex<Vec<Arc<PressedMesh>>>,
    /// The same at finite strain, where a slide asked for that.
    pub(crate) finite: Mutex<Option<Arc<Pressed>>>,
    recording: Recording,
    wall_time: f64,
}

/// Press on the coarse mesh alone: what [`sample`] starts from.
pub(crate) fn press_coarsely(scene: &Scene, watch: &dyn Watch) -> Result<Pressed, SimulationError> {
    let clock = Clock::now();
    let problem = Problem::new(scene);
    let resolution = Resolution::choose(&scene.numerics);
    let expected = problem.expected_contact_radius();
    let mesh = press_mesh(&problem, &resolution.coarse(), expected, watch)?;
    let contact_radius = mesh.contact.radius(&mesh.contact.committed);
    Ok(Pressed {
        scene: scene.clone(),
        problem,
        resolution,
        contact_radius,
        meshes: Mutex::new(vec![Arc::new(mesh)]),
        finite: Mutex::new(None),
        recording: Recording::default(),
        wall_time: clock.elapsed().as_secs_f64(),
    })
}

/// Press the asperity to the interference of the scene, in full stick and without heat.
///
/// ```
/// use asperity::scene_file::parse_scene;
/// use asperity::simulate::{Unwatched, press, slide};
///
/// let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
///             [loading]\ninterference = 5\nslip_rate = 0\nslip_distance = 0.02\n\
///             [numerics]\nelements_per_radius = 4\nsectors = 4\n";
/// let scene = parse_scene(text, "this example", &[])?;
/// // One press serves slides at any slip rate.
/// let pressed = press(&scene, &Unwatched)?;
/// let [slow, fast] = [0.1, 10.0].map(|rate| slide(&pressed, rate, &Unwatched));
/// assert_eq!(slow?.summary.load_press, fast?.summary.load_press);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn press(scene: &Scene, watch: &dyn Watch) -> Result<Pressed, SimulationError> {
    let clock = Clock::now();
    let problem = Problem::new(scene);
    let fine = Resolution::choose(&scene.numerics);
    let coarse = fine.coarse();
    watch.progress("press", 0.0, "coarse mesh");
    let expected = problem.expected_contact_radius();
    let first = press_mesh(&problem, &coarse, expected, watch)?;
    let contact_radius = first.contact.radius(&first.contact.committed);
    let mut meshes = vec![Arc::new(first)];
    watch.progress("press", 0.2, "fine mesh");
    let others = [fine, coarse.longer_steps()];
    let pressed: Vec<_> =
        others.par_iter().map(|resolution| press_mesh(&problem, resolution, contact_radius, watch)).collect();
    for mesh in pressed {
        meshes.push(Arc::new(mesh?));
    }
    watch.progress("press", 1.0, "");
    Ok(Pressed {
        scene: scene.clone(),
        problem,
        resolution: fine,
        contact_radius,
        meshes: Mutex::new(meshes),
        finite: Mutex::new(None),
        recording: Recording::default(),
        wall_time: clock.elapsed().as_secs_f64(),
    })
}

/// The contact at the end of the press, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressedContact {
    /// P, N.
    pub load: Estimate,
    /// Part of the load's error that is of the increments, N.
    pub load_error_of_steps: f64,
    /// A, m².
    pub area: Estimate,
    /// Of the Hertzian distribution with the same mean over the inner half of the contact, Pa: the
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
    let pairs = contact.areas.iter().zip(&contact.committed.pressure).take(inner);
    let load: f64 = pairs.map(|(area, pressure)| area * pressure).sum();
    let share = 2.0 * area / (std::f64::consts::PI * radius * radius);
    load / area * 1.5 * share / (1.0 - (1.0 - share).powf(1.5))
}

impl Pressed {
    /// The contact, with errors as those of runs.
    pub fn contact(&self) -> PressedContact {
        let meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        let [coarse, fine, longer] = [0, 1, 2].map(|i| &meshes[i]);
        let (run, coarser) = (&self.resolution, &self.resolution.coarse());
        let units = self.problem.units;
        let estimate = |unit: f64, edge_power: f64, of: fn(&Contact) -> f64| {
            let values = [fine, coarse, longer].map(|mesh| unit * of(&mesh.contact));
            let [mesh, steps] = error_budget::of_press(values, run, coarser, edge_power);
            (Estimate { value: values[0], error: mesh + steps }, steps)
        };
        let (load, load_error_of_steps) =
            estimate(units.force(), 0.0, |contact| contact.load(&contact.committed));
        PressedContact {
            load,
            load_error_of_steps,
            area: estimate(units.area(), 2.0, |contact| contact.area(&contact.committed)).0,
            peak_pressure: estimate(units.stress, 0.0, peak_pressure).0,
            plastic_strain_max: fine.body.committed.largest_plastic_strain(),
        }
    }

    /// The same, with slides that keep fields as `recording` says.
    pub fn recording(self, recording: Recording) -> Self {
        Self { recording, finite: Mutex::new(None), ..self }
    }

    pub(crate) fn what_is_recorded(&self) -> &Recording {
        &self.recording
    }

    /// The pressed mesh of a resolution, made now if it is not there.
    fn mesh(&self, resolution: &Resolution, watch: &dyn Watch) -> Result<Arc<PressedMesh>, SimulationError> {
        let mut meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        let known = meshes.iter().find(|mesh| {
            mesh.size.elements_per_radius == resolution.elements_per_radius
                && mesh.size.growth_zone == resolution.growth_zone
                && mesh.press_increments == resolution.press_increments
        });
        if let Some(mesh) = known {
            return Ok(mesh.clone());
        }
        let mesh = Arc::new(press_mesh(&self.problem, resolution, self.contact_radius, watch)?);
        meshes.push(mesh.clone());
        Ok(mesh)
    }

    /// Time spent on pressed meshes other than `mesh`, s.
    fn seconds_beside(&self, mesh: &Arc<PressedMesh>) -> f64 {
        let meshes = self.meshes.lock().unwrap_or_else(PoisonError::into_inner);
        meshes.iter().filter(|other| !Arc::ptr_eq(other, mesh)).map(|other| other.seconds).sum()
    }
}

/// Presses on a mesh laid out for the contact radius, and again on one laid out for the radius that
/// was reached, so that the edge lies close to where the mesh expects it. Always twice: results
/// change smoothly with the scene.
fn press_mesh(
    problem: &Problem,
    resolution: &Resolution,
    expected_radius: f64,
    watch: &dyn Watch,
) -> Result<PressedMesh, SimulationError> {
    /// Layouts that may be tried where the contact reaches the rim of the mesh: its radius is then
    /// not known yet.
    const LAYOUTS_PAST_RIM: usize = 8;
    let clock = Clock::now();
    let Resolution { elements_per_radius, press_increments, growth_zone, .. } = *resolution;
    let on = |mut contact_radius: f64| {
        for _ in 0..LAYOUTS_PAST_RIM {
            if watch.cancelled() {
                return Err(SimulationError::Cancelled { partial: None });
            }
            let size = MeshSize { contact_radius, elements_per_radius, growth_zone };
            if !size.fits() {
                break;
            }
            let (mechanics, increments) =
                press::press_on(problem, size, press_increments).map_err(press_error)?;
            if !mechanics.contact.at_rim(&mechanics.contact.committed) {
                return Ok((size, mechanics, increments));
            }
            contact_radius *= growth_zone;
        }
        Err(too_deep(problem, contact_radius))
    };
    let (_, first, _) = on(expected_radius)?;
    let (size, mechanics, increments) = on(first.contact.radius(&first.contact.committed))?;
    let effort = mechanics.effort;
    let (body, contact, displacement) = mechanics.into_parts();
    Ok(PressedMesh {
        press_increments,
        size,
        body,
        contact,
        displacement,
        increments,
        effort,
        seconds: clock.elapsed().as_secs_f64(),
    })
}

/// The contact is so large that its mesh does not fit into the hemisphere.
fn too_deep(problem: &Problem, radius: f64) -> SimulationError {
    SimulationError::Unsupported(format!(
        "an interference of {:.4} omega_c presses the asperity by {:.2} of its radius, to a contact radius \
         of about {radius:.2} of it: the model needs a contact that is small beside the asperity",
        problem.interference / problem.critical_interference,
        problem.interference,
    ))
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

/// A slide and the pressed mesh that it started on.
type Run = (Arc<PressedMesh>, Slid);

impl Slid {
    /// Growth of the contact, relative to its radius after the press, at which it left the mesh.
    fn outgrown(&self) -> Option<f64> {
        match self.failure {
            Some(SlideFailure::OutgrewMesh { growth }) => Some(growth),
            _ => None,
        }
    }
}

/// Where the contact points are.
pub struct ContactPoints {
    /// Over R.
    pub radii: Vec<f64>,
    pub angles: Vec<f64>,
}

/// One slide on one mesh, as far as it came.
pub struct Slid {
    pub history: Vec<crate::slide::Instant>,
    pub fields: Vec<Fields>,
    pub body: Option<BodyFields>,
    pub grid: ContactPoints,
    unknowns: usize,
    effort: Effort,
    timings: Timings,
    cutbacks: usize,
    failure: Option<SlideFailure>,
}

/// What all slides at one slip rate share.
struct Task<'a> {
    pressed: &'a Pressed,
    /// VR/κ.
    speed: f64,
    heat: bool,
    watch: &'a dyn Watch,
}

impl<'a> Task<'a> {
    fn new(pressed: &'a Pressed, slip_rate: f64, watch: &'a dyn Watch, notes: &mut Vec<String>) -> Self {
        let units = pressed.problem.units;
        let number = softening_number(&pressed.scene, slip_rate, pressed.contact_radius * units.length);
        let heat = choose_heat(&pressed.scene, slip_rate, number, notes);
        Self { pressed, speed: slip_rate / units.speed(), heat, watch }
    }

    fn slide(
        &self,
        resolution: &Resolution,
        mut progress: impl FnMut(f64, &str),
    ) -> Result<Run, SimulationError> {
        let problem = &self.pressed.problem;
        let pressed = self.pressed.mesh(resolution, self.watch)?;
        let clock = Clock::now();
        let discretisation = Discretisation::new(problem, pressed.size, Sectors::full(resolution.sectors))
            .map_err(|e| press_error(e.into()))?;
        let mesh = &discretisation.mesh;
        let body = Body::revolve(&pressed.body, mesh.clone());
        let contact = Contact::revolve(&pressed.contact, mesh, problem.contact_modulus);
        let displacement = mesh.sectors.spread(&pressed.displacement);
        let factors = discretisation.factors.clone();
        let mechanics = Mechanics::new(body, contact, factors, displacement, resolution.tolerance);
        let conduction = if self.heat {
            let conduction =
                Conduction::new(mesh, problem.heat_capacity).map_err(|e| press_error(e.into()))?;
            Some(conduction.with_properties(problem.thermal_properties.clone()))
        } else {
            None
        };
        let speed = if self.heat { self.speed } else { 0.0 };
        let mut slide = Slide::new(problem, mechanics, conduction, speed, resolution.increments);
        slide.mechanics.timings.since(Kernel::Setup, clock);
        // Each mesh slides as far in units of its own contact radius.
        let radius = pressed.contact.radius(&pressed.contact.committed);
        let distance = self.pressed.scene.loading.slip_distance * radius;
        slide.recorder = Recorder::new(&self.pressed.recording, radius, &slide.history[0]);
        slide.record_fields();
        let failure = slide
            .run(distance, |done, history| {
                progress(done, &standing::in_words(&problem.units, history));
                !self.watch.cancelled()
            })
            .err();
        slide.record_fields();
        let mut timings = slide.mechanics.timings;
        timings.add(Kernel::Rest, clock.elapsed().as_secs_f64() - timings.total());
        timings.add(Kernel::Press, pressed.seconds);
        let slid = Slid {
            effort: slide.mechanics.effort,
            timings,
            history: slide.history,
            fields: slide.recorder.contact,
            body: BodyFields::new(mesh, &slide.recorder.bodies, &problem.units),
            grid: ContactPoints {
                radii: slide.mechanics.contact.radii.clone(),
                angles: mesh.sectors.angles(),
            },
            unknowns: mesh.field_length(3),
            cutbacks: slide.cutbacks,
            failure,
        };
        Ok((pressed, slid))
    }

    /// The run at `resolution` and its companions; `probe` is the coarse one of them, if that was made.
    ///
    /// The resolution gets more room where the contact outgrows the mesh, for all of them alike, as
    /// long as there is any; what was done about it is added to `notes`. Where the coarse run failed
    /// errors are unknown, and the others are not needed.
    fn with_companions(
        &self,
        resolution: &mut Resolution,
        mut probe: Option<Probe>,
        notes: &mut Vec<String>,
        progress: impl Fn(f64, &str) + Sync,
    ) -> Result<Vec<Run>, SimulationError> {
        /// Place of the coarse run in the plan.
        const COARSE: usize = 1;
        let note = |growth: f64, wider: &Resolution| {
            format!(
                "repeated: the contact grew to {growth:.2} times its radius after the press, past the fine \
                 mesh, which now has room for {:.2} times",
                wider.growth_zone
            )
        };
        loop {
            let wider = resolution.wider();
            let room = self.fits(&wider);
            if let Some(growth) = probe.as_ref().and_then(|probe| probe.slid.outgrown()).filter(|_| room) {
                notes.push(note(growth, &wider));
                (*resolution, probe) = (wider, None);
                continue;
            }
            let coarse = resolution.coarse();
            let (sectors, steps) = (coarse.other_sectors(), coarse.longer_steps());
            let plan = [*resolution, coarse, sectors, steps, coarse.looser_solver()];
            let hopeless = probe.as_ref().is_some_and(|probe| !probe.complete());
            let needed = |i: usize| i == 0 || (!hopeless && (i != COARSE || probe.is_none()));
            let runs: Vec<_> = plan
                .par_iter()
                .enumerate()
                .filter(|(i, _)| needed(*i))
                .map(|(i, resolution)| {
                    self.slide(resolution, |done, standing| {
                        if i == 0 {
                            progress(done, standing);
                        }
                    })
                })
                .collect();
            let mut runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
            if let Some(Probe { mesh, slid, .. }) = probe.take() {
                runs.insert(COARSE, (mesh, slid));
            }
            let growth = runs.iter().filter_map(|(_, slid)| slid.outgrown()).fold(0.0, f64::max);
            if growth == 0.0 || !room {
                return Ok(runs);
            }
            notes.push(note(growth, &wider));
            *resolution = wider;
        }
    }

    /// Whether the hemisphere has room for the mesh.
    fn fits(&self, resolution: &Resolution) -> bool {
        let Resolution { elements_per_radius, growth_zone, .. } = *resolution;
        MeshSize { contact_radius: self.pressed.contact_radius, elements_per_radius, growth_zone }.fits()
    }

    fn scalars(&self, mesh: &PressedMesh, slid: &Slid) -> Scalars {
        Scalars::new(&self.pressed.problem, &self.pressed.scene, &mesh.increments, &slid.history)
    }
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
    /// Share of a run's progress until its companions are done.
    const FIRST_SHARE: f64 = 0.6;
    let clock = Clock::now();
    let (problem, scene) = (&pressed.problem, &pressed.scene);
    let mut notes = Vec::new();
    let task = Task::new(pressed, slip_rate, watch, &mut notes);

    let mut resolution = pressed.resolution;
    let shown = |done: f64, standing: &str| watch.progress("slide", FIRST_SHARE * done, standing);
    let mut runs = task.with_companions(&mut resolution, probe, &mut notes, shown)?.into_iter();
    let coarser = resolution.coarse();
    let (mut mesh, mut fine) = runs.next().expect("planned");
    let companions: Vec<_> = runs.collect();
    let slide_time = |slid: &Slid| slid.timings.total() - slid.timings.of(Kernel::Press);
    let mut beside: f64 = companions.iter().map(|(_, slid)| slide_time(slid)).sum();
    let mut cutbacks = fine.cutbacks;
    let mut warnings = Vec::new();
    let mut scalars = task.scalars(&mesh, &fine);
    let complete = |slid: &Slid| slid.failure.is_none();
    let known = complete(&fine) && companions.iter().all(|(_, slid)| complete(slid));
    let mut budget = if known {
        let [coarse, sectors, steps, solver] = [0, 1, 2, 3].map(|i| {
            let (mesh, slid) = &companions[i];
            task.scalars(mesh, slid)
        });
        let companions = Companions {
            coarse: &coarse,
            other_sectors: &sectors,
            longer_steps: &steps,
            looser_solver: &solver,
        };
        ErrorBudget::new(&scalars, &companions, &resolution, &coarser)
    } else {
        warnings.push("a companion run did not finish: errors are unknown and given as the values".into());
        ErrorBudget::unknown(&scalars)
    };
    let mut stopped = false;
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
            if !complete(&next) {
                stopped = matches!(next.failure, Some(SlideFailure::Cancelled));
                beside += slide_time(&next);
                break;
            }
            beside += slide_time(&fine);
            let next_scalars = task.scalars(&next_mesh, &next);
            if finer.elements_per_radius > resolution.elements_per_radius {
                budget.set_mesh(&next_scalars, &scalars, &finer, &resolution);
            }
            // Second order in θ at least, first in the increments.
            budget.scale(ErrorSource::Sectors, (resolution.sectors as f64 / finer.sectors as f64).powi(2));
            budget.scale(ErrorSource::Steps, finer.increments.growth / resolution.increments.growth);
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
    }
    watch.progress("slide", 1.0, "");

    summary::warn(scene, &fine.history, &mut warnings);
    notes.insert(0, resolution.describe());
    let mut timings = fine.timings;
    timings.add(Kernel::Companions, beside + pressed.seconds_beside(&mesh));
    let mut account = Account {
        elements_per_radius: resolution.elements_per_radius,
        sectors: resolution.sectors,
        unknowns: fine.unknowns,
        heat: task.heat,
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
    pub history: Vec<crate::slide::Instant>,
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
