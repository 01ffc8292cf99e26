//! The runs of one slip rate: a slide at one resolution, and the main run with its auxiliary runs.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;

use super::conditions::Conditions;
use super::messages::{Note, RunKind, RunProgress};
use super::pressed::{Pressed, PressedMesh, add_presses, press_error};
use super::{SimulationError, Watch};
use crate::discretisation::collocation::Collocation;
use crate::heat::conduction::Conduction;
use crate::interface::contact::Contact;
use crate::loading::body_fields::BodyFields;
use crate::loading::problem::Discretisation;
use crate::loading::recording::{Fields, Recorder};
use crate::loading::slide::increments::inception_width;
use crate::loading::slide::{Motion, Slide, SlideFailure};
use crate::loading::state::SlideState;
use crate::scene::Numerics;
use crate::simulate::accuracy::error_budget::{AuxiliaryRuns, ErrorBudget, RunValues, estimate};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::expected_time::{EXPECTED_TIME_FACTOR, time_of, time_ratio};
use crate::simulate::values::Values;
use crate::solver::newton::Effort;
use crate::solver::timings::{Kernel, Timings};

/// Shares of the progress of a slide at the end of the auxiliary runs and of the main run; then it may be
/// repeated more finely.
const AUXILIARY: f64 = 0.25;
const MAIN: f64 = 0.7;
/// Share of the error that a refinement leaves at which it has gained nothing; by the order of convergence a refinement
/// leaves half or less.
const STAGNATION: f64 = 0.8;

/// One slide at one resolution, up to its end or failure, and the press that it started from.
pub(super) struct Run {
    pub resolution: Resolution,
    pub press: Arc<PressedMesh>,
    pub history: Vec<SlideState>,
    pub values: Values,
    pub fields: Vec<Fields>,
    pub body: Option<BodyFields>,
    /// At its end.
    pub contact: Contact,
    pub unknowns: usize,
    pub effort: Effort,
    pub timings: Timings,
    pub cutbacks: usize,
    pub failure: Option<SlideFailure>,
}

impl Run {
    pub fn is_cancelled(&self) -> bool {
        matches!(self.failure, Some(SlideFailure::Cancelled))
    }

    /// Largest plastic strain.
    pub fn plastic_strain(&self) -> f64 {
        self.history.last().map_or(0.0, |state| state.plastic_strain_max)
    }

    /// Processor time of the slide by its counts, s.
    fn expected_time(&self) -> f64 {
        time_of(self.effort.newton, self.unknowns)
    }

    /// Time of the slide without the press, s.
    pub fn slide_time(&self) -> f64 {
        self.timings.total() - self.timings.of(Kernel::Press)
    }

    /// Growth of the contact, relative to its radius after the press, at which it left the mesh.
    fn outgrown(&self) -> Option<f64> {
        match self.failure {
            Some(SlideFailure::OutgrewMesh { growth }) => Some(growth),
            _ => None,
        }
    }
}

/// The main run and the auxiliary runs of the resolution `start`.
pub(super) struct Ladder {
    start: Resolution,
    /// On the coarse mesh: unchanged, with another N_θ, with longer increments, with a looser solver.
    pub auxiliary: Vec<Run>,
    /// Each finer than the one before.
    pub main: Vec<Run>,
    /// On the coarse mesh of the finest of them, where that is not the first: errors depend on the final resolution and
    /// not on those before.
    pub coarse: Option<Run>,
    /// A finer run that did not finish.
    pub abandoned: Option<Run>,
    /// Why the runs that had to follow could not begin; the result is then the best of those before.
    pub obstacle: Option<SimulationError>,
    /// Largest relative error of the quantities controlled by the accuracy, of each main run.
    errors: Vec<f64>,
    pub notes: Vec<Note>,
}

impl Ladder {
    fn new(start: Resolution, main: Run, auxiliary: Vec<Run>) -> Self {
        Self {
            start,
            auxiliary,
            main: vec![main],
            coarse: None,
            abandoned: None,
            obstacle: None,
            errors: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The first auxiliary run replaces the main run.
    fn of_auxiliary(start: Resolution, mut auxiliary: Vec<Run>, obstacle: Option<SimulationError>) -> Self {
        let coarse = auxiliary.swap_remove(0);
        Self { obstacle, ..Self::new(start, coarse, auxiliary) }
    }

    /// The finest main run.
    pub fn result(&self) -> &Run {
        self.main.last().expect("there is a main run")
    }

    /// The next finer resolution, if the accuracy requires one, the last refinement, if any, reduced the error, and the
    /// time with it is within the factor of the time `expected` (s) of all runs.
    pub fn finer(&mut self, budget: &ErrorBudget, numerics: &Numerics, expected: f64) -> Option<Resolution> {
        let (quantity, parts) = budget.worst(&self.result().values);
        if parts.solver_exceeds(numerics.accuracy) {
            let solver = parts.solver;
            self.notes.push(Note::AccuracyOutOfReach { quantity, solver, accuracy: numerics.accuracy });
            return None;
        }
        let finer = self.result().resolution.refine(numerics, &parts)?;
        let after = parts.total();
        if let Some(&before) = self.errors.last()
            && after > STAGNATION * before
        {
            self.notes.push(Note::RefinementStopped { before, after });
            return None;
        }
        let spent: f64 = self.main.iter().map(Run::expected_time).sum();
        let next = self.result().expected_time() * time_ratio(&finer, &self.result().resolution);
        if spent + next > EXPECTED_TIME_FACTOR * expected {
            let (elements, sectors) = (finer.elements_per_radius, finer.sectors);
            self.notes.push(Note::RefinementTooLong { next, expected, elements, sectors });
            return None;
        }
        self.errors.push(after);
        Some(finer)
    }
}

fn auxiliary_values(runs: &[Run]) -> Option<AuxiliaryRuns<'_>> {
    let [coarse, other_sectors, longer_steps, looser_solver] = runs else { return None };
    runs.iter().all(|run| run.failure.is_none()).then_some(AuxiliaryRuns {
        coarse: &coarse.values,
        other_sectors: &other_sectors.values,
        longer_steps: &longer_steps.values,
        looser_solver: &looser_solver.values,
    })
}

/// Makes the runs of one slip rate.
pub(super) struct Runner<'a> {
    pub pressed: &'a Pressed,
    pub conditions: Conditions,
    pub watch: &'a dyn Watch,
    /// Those of `pressed`, and those that this slip rate alone needs.
    presses: Vec<Arc<PressedMesh>>,
}

impl<'a> Runner<'a> {
    pub fn new(pressed: &'a Pressed, slip_rate: f64, watch: &'a dyn Watch) -> Result<Self, SimulationError> {
        let conditions = Conditions::new(pressed, slip_rate)?;
        Ok(Self { pressed, conditions, watch, presses: pressed.meshes.clone() })
    }

    /// The runs of the first resolution. Where a contact outgrows its mesh, all is repeated on wider ones as long as
    /// there is room; where that cannot begin, the runs before are the result.
    pub fn ladder(&mut self) -> Result<Ladder, SimulationError> {
        let mut ladder = self.runs_from(self.pressed.resolution)?;
        let mut notes = Vec::new();
        while let Some((growth, wider)) =
            self.wider(&ladder.start, ladder.auxiliary.iter().chain(&ladder.main))
        {
            match self.runs_from(wider) {
                Ok(wider) => ladder = wider,
                Err(error) => {
                    ladder.obstacle = Some(error);
                    break;
                }
            }
            notes.push(Note::Remeshed { growth, room: wider.growth_zone });
        }
        ladder.notes = notes;
        Ok(ladder)
    }

    /// The auxiliary runs of a resolution, then the main run with the sectors and increments that they require. Without
    /// the main run where an auxiliary one was stopped or has outgrown its mesh, or where the main run cannot begin.
    fn runs_from(&mut self, start: Resolution) -> Result<Ladder, SimulationError> {
        let [coarse, others @ ..] = start.auxiliary();
        let middle = 0.5 * AUXILIARY;
        let auxiliary_progress = |span| RunProgress { kind: RunKind::Auxiliary, span };
        let mut auxiliary = self.run_all(&[coarse], auxiliary_progress((0.0, middle)))?;
        // Without the first of them errors are unknown, and the others are not needed.
        if auxiliary[0].failure.is_none() {
            match self.run_all(&others, auxiliary_progress((middle, AUXILIARY))) {
                Ok(others) => auxiliary.extend(others),
                Err(error) => return Ok(Ladder::of_auxiliary(start, auxiliary, Some(error))),
            }
        }
        let stopped = auxiliary.iter().any(Run::is_cancelled);
        if stopped || self.wider(&start, auxiliary.iter()).is_some() {
            let obstacle = stopped.then_some(SimulationError::Cancelled { partial: None });
            return Ok(Ladder::of_auxiliary(start, auxiliary, obstacle));
        }
        let resolution = self.main_resolution(&start, &auxiliary);
        let progress = RunProgress { kind: RunKind::Main, span: (AUXILIARY, MAIN) };
        Ok(match self.run(&resolution, progress) {
            Ok(main) => Ladder::new(start, main, auxiliary),
            Err(error) => Ladder::of_auxiliary(start, auxiliary, Some(error)),
        })
    }

    /// Errors of the finest main run; none where a run did not finish.
    pub fn judge(&self, ladder: &Ladder) -> Option<ErrorBudget> {
        let run = ladder.result();
        let auxiliary = auxiliary_values(&ladder.auxiliary).filter(|_| run.failure.is_none())?;
        let alike = match run.resolution.sectors == ladder.start.sectors {
            true => &ladder.auxiliary[0],
            false => &ladder.auxiliary[1],
        };
        let pair = [run, ladder.coarse.as_ref().unwrap_or(alike)]
            .map(|run| RunValues { resolution: &run.resolution, values: &run.values });
        let modelling_error = self.conditions.modelling_error(self.pressed, run.plastic_strain());
        Some(estimate(&ladder.start, &auxiliary, pair, &modelling_error))
    }

    /// The resolution of the main run: that of the start, with more sectors and shorter increments where
    /// the auxiliary runs require them.
    fn main_resolution(&self, start: &Resolution, auxiliary: &[Run]) -> Resolution {
        let Some(values) = auxiliary_values(auxiliary) else { return *start };
        let (_, parts) = ErrorBudget::other_than_mesh(&values, start).worst(values.coarse);
        start.refine_other_than_mesh(&self.pressed.numerics, &parts)
    }

    /// The growth by which one of the runs has outgrown its mesh, and a resolution with more room, if the hemisphere has
    /// it.
    fn wider<'r>(
        &self,
        resolution: &Resolution,
        runs: impl Iterator<Item = &'r Run>,
    ) -> Option<(f64, Resolution)> {
        let growth = runs.filter_map(Run::outgrown).fold(0.0, f64::max);
        let wider = resolution.wider();
        (growth > 0.0 && self.conditions.fits(&wider)).then_some((growth, wider))
    }

    /// Time spent on presses other than that of the run, s.
    pub fn other_presses(&self, run: &Run) -> f64 {
        self.presses.iter().filter(|press| !Arc::ptr_eq(press, &run.press)).map(|press| press.seconds).sum()
    }

    /// Runs side by side; progress is that of the first.
    fn run_all(&mut self, plan: &[Resolution], progress: RunProgress) -> Result<Vec<Run>, SimulationError> {
        self.add_presses(plan)?;
        let this = &*self;
        let progress_of = |i: usize| (i == 0).then_some(progress);
        plan.par_iter().enumerate().map(|(i, resolution)| this.slide(resolution, progress_of(i))).collect()
    }

    /// A finer main run, and one on its coarse mesh.
    pub fn finer(&mut self, resolution: &Resolution) -> Result<[Run; 2], SimulationError> {
        self.watch.progress("slide", MAIN, "finer");
        let progress = RunProgress { kind: RunKind::Finer, span: (MAIN, 1.0) };
        let runs = self.run_all(&[*resolution, resolution.coarse()], progress)?;
        Ok(runs.try_into().unwrap_or_else(|_| unreachable!("as many runs as planned")))
    }

    /// One run.
    pub fn run(&mut self, resolution: &Resolution, progress: RunProgress) -> Result<Run, SimulationError> {
        self.add_presses(std::slice::from_ref(resolution))?;
        self.slide(resolution, Some(progress))
    }

    fn add_presses(&mut self, plan: &[Resolution]) -> Result<(), SimulationError> {
        let plan: Vec<_> = plan.iter().map(|resolution| self.conditions.at_surface(resolution)).collect();
        let Pressed { problem, contact_radius, .. } = self.pressed;
        add_presses(&mut self.presses, problem, &plan, *contact_radius, self.watch)
    }

    /// A slide from its press, which must be there.
    fn slide(&self, resolution: &Resolution, progress: Option<RunProgress>) -> Result<Run, SimulationError> {
        let Pressed { problem, recording, .. } = self.pressed;
        let at_surface = self.conditions.at_surface(resolution);
        let press =
            self.presses.iter().find(|press| press.serves(&at_surface)).expect("pressed before").clone();
        let clock = Instant::now();
        let discretisation =
            Discretisation::new(problem, press.size, Collocation::full(resolution.sectors), &|| {
                self.watch.cancelled()
            })
            .map_err(|e| press_error(e.into()))?;
        let mut slide = self.start(&press, &discretisation, resolution)?;
        slide.mechanics.timings.since(Kernel::Setup, clock);
        // Each mesh slides as far in units of its own contact radius.
        let radius = press.contact.radius(&press.contact.committed);
        slide.recorder = Recorder::new(recording, radius, &slide.history[0]);
        slide.record_fields();
        let programme = self.conditions.programme.iter();
        let motions: Vec<Motion> = programme.map(|step| Motion::new(step, radius, &problem.units)).collect();
        let failure = slide
            .run(&motions, &|| self.watch.cancelled(), |done, history| {
                if let Some(progress) = progress {
                    let detail = progress.describe(&problem.units, history);
                    self.watch.progress("slide", progress.at(done), &detail);
                }
            })
            .err();
        slide.record_fields();
        let mut timings = slide.mechanics.timings;
        timings.add(Kernel::Rest, clock.elapsed().as_secs_f64() - timings.total());
        timings.add(Kernel::Press, press.seconds);
        let mesh = &discretisation.mesh;
        let values = Values::new(problem, &press.increments, &slide.history);
        let effort = slide.mechanics.effort;
        let residual = press.effort.residual + effort.residual;
        Ok(Run {
            resolution: *resolution,
            values: values.with_expected_rise(self.conditions.expected_rise()).with_residual(residual),
            effort,
            timings,
            history: slide.history,
            fields: slide.recorder.contact,
            body: BodyFields::new(mesh, &slide.recorder.bodies, &problem.units),
            unknowns: mesh.field_length(3),
            cutbacks: slide.cutbacks,
            contact: slide.mechanics.into_parts().1,
            failure,
            press,
        })
    }

    /// The pressed state revolved to all angles.
    fn start(
        &self,
        press: &PressedMesh,
        discretisation: &Discretisation,
        resolution: &Resolution,
    ) -> Result<Slide<'a>, SimulationError> {
        let Pressed { problem, .. } = self.pressed;
        let mesh = &discretisation.mesh;
        let pressed = (&press.body, &press.contact, &press.displacement[..]);
        let mechanics = discretisation.revolve(problem, pressed, resolution.tolerance);
        let heat = match self.conditions.heat.is_coupled() {
            false => None,
            true => {
                let conduction =
                    Conduction::new(mesh, problem.heat_capacity, self.conditions.thermal_sublayers)
                        .map_err(|e| press_error(e.into()))?;
                let conduction = conduction.with_properties(problem.thermal_properties.clone());
                Some(conduction.with_counterface(problem.counterface.clone()))
            }
        };
        let mut slide = Slide::new(problem, mechanics, heat, resolution.growth);
        slide.inception_width = inception_width(self.conditions.softening_at_inception(self.pressed));
        slide.shears_without_limit = self.pressed.shears_without_limit;
        Ok(slide)
    }
}
