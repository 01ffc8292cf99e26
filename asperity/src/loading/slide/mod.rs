//! The slide: increments of the flat's displacement s, mechanics and heat coupled in each.
//!
//! [`motion`]: slip at a constant rate or a hold; [`motion_in_progress`]: its increments one after the other; [`relaxation`]:
//! the slip rate after the flat has slowed down; [`increments`]: lengths of the increments and the bracket of sliding inception; [`coupling`]:
//! equilibrium of one increment with its contact edge, shear limits and temperature; [`state`]: the
//! state after it with the totals of work and heat; [`invariants`]: conditions that every state meets.

mod coupling;
mod edge_search;
mod first_increment;
mod friction_heat;
pub mod increments;
pub mod invariants;
mod motion;
mod motion_in_progress;
mod relaxation;
mod shear_limits;
mod state;

use crate::heat::conduction::{Conduction, HeatError};
use crate::interface::contact::FlatPosition;
use crate::loading::problem::Problem;
use crate::loading::recording::Recorder;
use crate::loading::state::SlideState;
use crate::scene::{Control, REMEDY_OF_LIGHT_CONTACT};
use crate::solver::StopRequest;
use crate::solver::newton::{LoadingControl, Mechanics, StepFailure};
use coupling::Equilibrium;
use friction_heat::HeatSources;
use increments::Predictor;
use invariants::Violation;
pub use motion::Motion;
pub use motion_in_progress::MotionInProgress;
use relaxation::Relaxation;

/// Plastic strain above which the body shears in place of the interface, if the stick area fraction is above
/// [`STILL_STICKING`]. Under interfaces no stronger than the body that fraction is reached at strains up to 0.03
/// (20 ω_c); under stronger ones a layer of elements shears without limit.
const LARGEST_STRAIN_IN_STICK: f64 = 0.5;
const STILL_STICKING: f64 = 0.5;
/// Increments of a motion that fail after one that was taken, at which the slide ends: repeated halving counts once. Motions
/// that arrive have up to 9; one without a continuous sequence of states fails in every fourth increment.
const MOST_FAILURES: usize = 20;

#[derive(Debug, thiserror::Error)]
pub enum SlideFailure {
    #[error(transparent)]
    Heat(#[from] HeatError),
    #[error("{0}")]
    Step(StepFailure),
    #[error("the contact grew past the fine mesh, to {radius_ratio:.2} times its radius after the press")]
    OutgrewMesh { radius_ratio: f64 },
    #[error(
        "the body shears in place of the interface: {:.0} % of the contact stick, and the elements below \
         have a plastic strain of {strain:.2}, beyond which the result depends on the mesh. Sliding requires \
         an interface weaker than the metal below it: {remedy}",
        100.0 * .stick_fraction
    )]
    Distorted { strain: f64, stick_fraction: f64, remedy: &'static str },
    #[error("the state after the next increment is not admissible: {0}")]
    Impossible(#[from] Violation),
    #[error(
        "{failures} times an increment failed after one that was taken: there may be no continuous sequence of \
         states, as where a light contact sticks and lifts off in turn; {REMEDY_OF_LIGHT_CONTACT} may have one. The last failure: {last}"
    )]
    Discontinuous { failures: usize, last: Box<SlideFailure> },
    #[error("stopped on request")]
    Cancelled,
}

impl SlideFailure {
    /// Whether a shorter increment may succeed.
    fn allows_cut_back(&self) -> bool {
        match self {
            Self::Step(failure) => !matches!(failure, StepFailure::TooMuchWork { .. }),
            Self::Impossible(_) | Self::Heat(HeatError::NotConverged { .. }) => true,
            _ => false,
        }
    }
}

impl From<StepFailure> for SlideFailure {
    fn from(failure: StepFailure) -> Self {
        match failure {
            StepFailure::Stopped => Self::Cancelled,
            failure => Self::Step(failure),
        }
    }
}

/// An increment to attempt.
struct Advance {
    /// Displacement of the flat at its end.
    to: f64,
    /// Over R²/κ; 0 in the isothermal limit.
    dt: f64,
    /// Time for the strain rate, s; infinite in the isothermal limit.
    seconds: f64,
    /// Rate at which the contact slips at its end, m/s.
    slip_rate: f64,
    /// Whether it is longer than an increment in which sliding may begin.
    wide: bool,
}

/// Result of the attempt at an increment.
enum Attempt {
    Taken,
    /// Solved, but sliding begins within the increment: only this predictor of its end is used.
    PastInception(Predictor),
}

pub struct Slide<'a> {
    problem: &'a Problem,
    pub mechanics: Mechanics,
    /// Conduction; none without heat.
    pub heat: Option<Conduction>,
    /// The present one.
    motion: Motion,
    /// Time that the motion before took.
    time_before: f64,
    relaxation: Relaxation,
    /// Rate at which the contact slips, m/s.
    slip_rate: f64,
    interference: f64,
    control: LoadingControl,
    /// Elastic energy after the press.
    elastic_of_press: f64,
    /// Whether the contact has slipped everywhere since the start, the last hold or the last reversal.
    has_begun: bool,
    sources: HeatSources,
    pub history: Vec<SlideState>,
    pub recorder: Recorder,
    pub cutbacks: usize,
    /// Largest increment relative to the slip so far, times [`increments::WHILE_STICKING`] or
    /// [`increments::WHILE_SLIDING`].
    increment_growth: f64,
    /// Width of the increment in which sliding begins, relative to the slip.
    pub inception_width: f64,
    /// Whether the body may shear without limit below the interface: then an increment that fails when the elements are
    /// distorted is not halved, as the result depends on the mesh by then.
    pub shears_without_limit: bool,
    /// Number of further attempts of which every other one is rejected.
    #[cfg(test)]
    rejecting: usize,
}

impl<'a> Slide<'a> {
    /// A slide from the pressed state `mechanics`; with heat if a conduction solver is given.
    pub fn new(
        problem: &'a Problem,
        mechanics: Mechanics,
        heat: Option<Conduction>,
        increment_growth: f64,
    ) -> Self {
        let mut slide = Self {
            interference: problem.interference,
            control: LoadingControl::Interference,
            elastic_of_press: mechanics.body.elastic_energy(&mechanics.body.committed),
            has_begun: false,
            problem,
            mechanics,
            heat,
            motion: Motion::Hold { time: 0.0 },
            time_before: 0.0,
            relaxation: Relaxation::default(),
            slip_rate: 0.0,
            sources: HeatSources::default(),
            history: Vec::new(),
            recorder: Recorder::default(),
            cutbacks: 0,
            increment_growth,
            inception_width: increments::INCEPTION_WIDTH,
            shears_without_limit: false,
            #[cfg(test)]
            rejecting: 0,
        };
        let start = SlideState { heat_partition: problem.initial_heat_partition, ..SlideState::default() };
        let start = slide.present_state(0.0, start);
        slide.history.push(start);
        if problem.control == Control::Load {
            slide.control = LoadingControl::Load(start.load);
        }
        slide
    }

    /// Makes the motions one after the other; `watch` is given the share done and the history. Returns the last of them, to go
    /// on with.
    pub fn run(
        &mut self,
        motions: &[Motion],
        stop: &StopRequest,
        mut watch: impl FnMut(f64, &[SlideState]),
    ) -> Result<Option<MotionInProgress>, SlideFailure> {
        let (mut path, mut last) = (0.0, None);
        for (step, motion) in motions.iter().enumerate() {
            self.motion = *motion;
            if let Some(before) = step.checked_sub(1) {
                let before = motions[before];
                self.relaxation = self.relaxation();
                // The contact may stick again.
                self.has_begun &= motion.direction() == before.direction();
                self.time_before = before.time(before.length());
                self.record_fields();
            }
            self.mechanics.contact.start_motion();
            // Those of another rate are no first iterate.
            self.sources = HeatSources::default();
            let mut in_progress = self.begin(step, path);
            while !in_progress.has_arrived() {
                watch((step as f64 + in_progress.share()) / motions.len() as f64, &self.history);
                self.attempt(&mut in_progress, stop)?;
            }
            path += motion.direction().abs() * motion.length();
            last = Some(in_progress);
        }
        watch(1.0, &self.history);
        Ok(last)
    }

    /// The present state, from which the next ones are extrapolated.
    fn predictor(&self) -> Predictor {
        Predictor {
            displacement: self.mechanics.displacement.clone(),
            interference: self.interference,
            edges: self.mechanics.contact.edges(),
            elevation: self.mechanics.contact.elevation(),
        }
    }

    /// Predictor at the displacement `to` of the flat of a contact that sticks.
    fn sticking(&mut self, to: f64) -> Result<Predictor, StepFailure> {
        let from = FlatPosition { interference: self.interference, displacement: self.last().slip };
        let displacement = self.mechanics.sticking(from, FlatPosition { displacement: to, ..from })?;
        Ok(Predictor { displacement, ..self.predictor() })
    }

    /// One increment of the step `step` of the programme, from a first guess.
    fn step(
        &mut self,
        step: usize,
        advance: Advance,
        guess: Predictor,
        stop: &StopRequest,
    ) -> Result<Attempt, SlideFailure> {
        self.mechanics.body.time_step = advance.seconds;
        let equilibrium = self.equilibrium(&advance, guess, stop)?;
        #[cfg(test)]
        if self.rejecting > 0 {
            self.rejecting -= 1;
            if self.rejecting % 2 == 1 {
                return Err(StepFailure::NotFinite.into());
            }
        }
        let mut state = SlideState { step, ..self.next_state(advance.dt, &equilibrium) };
        state.rate_strengthening = self.rate_factor(advance.slip_rate, state.area) - 1.0;
        self.check(&state, &equilibrium)?;
        let begins = !self.has_begun && state.slides();
        // A contact without stick after the press, or with full slip in the first increment, has its inception at s =
        // 0.
        let stuck = !self.last().slides();
        if begins && stuck && advance.wide {
            let predictor = Predictor { interference: equilibrium.flat.interference, ..self.predictor() };
            return Ok(Attempt::PastInception(predictor));
        }
        self.commit(state, equilibrium);
        self.slip_rate = advance.slip_rate;
        self.has_begun |= begins;
        Ok(Attempt::Taken)
    }

    /// Whether the state is possible, and mesh and elements still represent it.
    fn check(&self, state: &SlideState, solved: &Equilibrium) -> Result<(), SlideFailure> {
        let (strain, stick_fraction) = (state.plastic_strain_max, state.stick_fraction);
        if strain > LARGEST_STRAIN_IN_STICK && stick_fraction > STILL_STICKING {
            return Err(self.shears_in_stick(strain, stick_fraction));
        }
        // NaN, if any is.
        let highest = |most: f64, &rise: &f64| if rise <= most { most } else { rise };
        let rise = solved.heated.iter().flat_map(|(rise, _)| rise).fold(0.0, highest);
        invariants::check(self.problem, self.elastic_of_press, self.last(), state, rise)?;
        let contact = &self.mechanics.contact;
        if contact.at_rim(&contact.trial) {
            let radius_ratio = contact.radius(&contact.trial) / self.history[0].radius();
            return Err(SlideFailure::OutgrewMesh { radius_ratio });
        }
        Ok(())
    }

    /// The cause of a failure, where the elements of the last state are too distorted for equilibrium.
    fn distorted(&self) -> Option<SlideFailure> {
        let SlideState { plastic_strain_max: strain, stick_fraction, .. } = *self.last();
        (self.problem.finite_strain && strain > LARGEST_STRAIN_IN_STICK)
            .then(|| self.shears_in_stick(strain, stick_fraction))
    }

    fn shears_in_stick(&self, strain: f64, stick_fraction: f64) -> SlideFailure {
        let remedy = self.problem.interface.law.remedy_of_strong_interface();
        SlideFailure::Distorted { strain, stick_fraction, remedy }
    }

    /// The last converged state.
    fn last(&self) -> &SlideState {
        self.history.last().expect("starts with the press")
    }

    /// Records the fields of the present state.
    pub fn record_fields(&mut self) {
        let now = self.history.last().expect("starts with the press");
        self.recorder.keep(now, &self.mechanics, self.heat.as_ref(), &self.problem.units);
    }
}

#[cfg(test)]
mod tests;
