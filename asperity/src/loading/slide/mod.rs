//! The slide: increments of the flat's displacement, mechanics and heat coupled in each.

use std::time::Instant;

use crate::discretisation::body::Body;
use crate::heat::conduction::{Conduction, HeatBalance, HeatError};
use crate::interface::contact::{Contact, FlatPosition};
use crate::loading::press::extrapolate;
use crate::loading::problem::{Problem, SHEAR_RATIO};
use crate::loading::recording::Recorder;
use crate::scene::Control;
use crate::solver::newton::{CouplingData, LoadingControl, Mechanics, StepFailure};
use crate::solver::timings::Kernel;
use edge_search::EdgeSearch;
use friction_heat::{HeatSources, contact_rise};
use shear_limits::{interface_hardening, shear_limits, shear_strength};

mod edge_search;
mod friction_heat;
mod shear_limits;

/// Change of the shear limits between iterations, relative to the strength, that counts as none.
const LIMIT_TOLERANCE: f64 = 3e-5;
/// Change of the areas of the contact points between iterations, relative, that counts as none.
const AREA_TOLERANCE: f64 = 1e-4;
/// First increment in units of the elastic displacement at gross slip.
const FIRST_INCREMENT: f64 = 0.1;
/// Sticking share of the contact that counts as none: points that have just touched stick until
/// they have slipped once.
pub const NO_STICK: f64 = 0.01;
/// Width of the increment in which sliding begins, relative to the slip. In shorter ones the last points
/// let go so suddenly that where heat spreads at once (Fo = 1e6) they get hot for a moment.
const INCEPTION_WIDTH: f64 = 0.01;
/// Plastic strain at which the body is taken to shear in place of the interface, if so large a share of
/// the contact still sticks. Interfaces no stronger than the body stick to that share up to a strain of
/// 0.03 (20 omega_c); under stronger ones a layer of elements shears without end.
const MOST_STRAIN_IN_STICK: f64 = 0.5;
const STILL_STICKING: f64 = 0.5;
/// Growth of the increments once the contact slides, over that before: no more than 0.08 per cent of friction and 0.02
/// of the rise of temperature hang on it in ten slides between 0.1 and 100 omega_c.
const WHILE_SLIDING: f64 = 2.0;
/// Number of increments at least, for a growth of 15 %. From 24 to 12 of them mu changed by 0.003, 0.01, 0.02, 0.27
/// and 0.48 per cent in five slides between 10 and 100 omega_c.
const LEAST_INCREMENTS: f64 = 16.0;

#[derive(Debug, thiserror::Error)]
pub enum SlideFailure {
    #[error(transparent)]
    Heat(#[from] HeatError),
    #[error("{0}")]
    Step(#[from] StepFailure),
    #[error("the contact grew past the fine mesh, to {growth:.2} times its radius after the press")]
    OutgrewMesh { growth: f64 },
    #[error(
        "the interface holds where the asperity does not: {:.0} % of the contact stick, while the elements \
         below have sheared by a plastic strain of {strain:.2}, where the mesh decides what comes next. To \
         slide, the interface has to be weaker than the metal below it",
        100.0 * .stick_fraction
    )]
    Distorted { strain: f64, stick_fraction: f64 },
    #[error("stopped on request")]
    Cancelled,
}

/// State after one increment, dimensionless, energies of the half body since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlideState {
    pub slip: f64,
    /// Over R.
    pub interference: f64,
    pub time: f64,
    pub friction: f64,
    pub load: f64,
    pub area: f64,
    pub stick_fraction: f64,
    pub rise_max: f64,
    pub rise_mean: f64,
    pub plastic_strain_max: f64,
    pub work: f64,
    pub elastic: f64,
    pub plastic: f64,
    pub friction_work: f64,
    pub springs: f64,
    pub thermal_expansion: f64,
    pub moduli_softening: f64,
    pub heat_in: f64,
    pub heat_stored: f64,
    pub heat_out: f64,
}

/// How finely the slide is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increments {
    /// Largest increment relative to the slip so far.
    pub growth: f64,
    /// Updates of temperature and contact edge in a step: each leaves about a fifth of the change
    /// of the one before (measured).
    pub coupling_limit: usize,
}

/// What came of the attempt at an increment.
enum Attempt {
    Taken,
    /// Solved, but sliding begins somewhere on the way: nothing is kept of it.
    PastInception(Beyond),
}

/// A state that sliding has begun before.
struct Beyond {
    slip: f64,
    guess: Guess,
}

/// First guess of a step, and what it is extrapolated from.
#[derive(Clone)]
struct Guess {
    displacement: Vec<f64>,
    interference: f64,
    /// Of the contact, along each angle.
    edges: Vec<f64>,
}

impl Guess {
    /// Straight on from two states to the slip `next`.
    fn between((before, slip_before): (&Guess, f64), (now, slip): (&Guess, f64), next: f64) -> Self {
        let on = |before: &[f64], now: &[f64]| extrapolate(before, now, slip_before, slip, next);
        Self {
            displacement: on(&before.displacement, &now.displacement),
            interference: on(&[before.interference], &[now.interference])[0],
            edges: on(&before.edges, &now.edges),
        }
    }
}

/// Heat of a slide.
pub struct SlideHeat {
    pub conduction: Conduction,
    /// Whether temperatures soften and expand the contact.
    pub acts_back: bool,
}

pub struct Slide<'a> {
    problem: &'a Problem,
    pub mechanics: Mechanics,
    heat: Option<SlideHeat>,
    /// VR/κ.
    speed: f64,
    interference: f64,
    hold: LoadingControl,
    /// Whether the contact has once slipped everywhere.
    has_begun: bool,
    /// Shortest increment in which sliding inception is looked for.
    finest: f64,
    sources: HeatSources,
    pub history: Vec<SlideState>,
    pub recorder: Recorder,
    pub cutbacks: usize,
    increments: Increments,
    /// So many attempts at a step are still to be counted, and every other one of them rejected.
    #[cfg(test)]
    rejecting: usize,
}

impl<'a> Slide<'a> {
    /// A slide from the pressed state `mechanics`, at dimensionless speed VR/κ; with heat if that
    /// is given.
    pub fn new(
        problem: &'a Problem,
        mechanics: Mechanics,
        heat: Option<SlideHeat>,
        speed: f64,
        increments: Increments,
    ) -> Self {
        let mut slide = Self {
            interference: problem.interference,
            hold: LoadingControl::Interference,
            has_begun: false,
            finest: 0.0,
            problem,
            mechanics,
            heat,
            speed,
            sources: HeatSources::default(),
            history: Vec::new(),
            recorder: Recorder::default(),
            cutbacks: 0,
            increments,
            #[cfg(test)]
            rejecting: 0,
        };
        let start = slide.instant(0.0, SlideState::default());
        slide.history.push(start);
        if problem.control == Control::Load {
            slide.hold = LoadingControl::Load(start.load);
        }
        slide
    }

    /// Slides by `distance` (in R); `watch` is given the share done and the history, and may stop the slide.
    pub fn run(
        &mut self,
        distance: f64,
        mut watch: impl FnMut(f64, &[SlideState]) -> bool,
    ) -> Result<(), SlideFailure> {
        let increments = self.increments;
        let radius = (self.history[0].area / std::f64::consts::PI).sqrt();
        let shear = self.problem.solid.moduli.shear;
        // δ_s = τ₀a(2 − ν)/(2G), with 2 − ν taken as 2.
        let elastic = self.problem.strength_factor.min(10.0) * SHEAR_RATIO * radius / shear;
        let mut advance =
            (FIRST_INCREMENT * increments.growth / 0.15 * elastic).min(distance / LEAST_INCREMENTS);
        let least = FIRST_INCREMENT * increments.growth / 0.15 * elastic;
        self.finest = (0.1 * least).min(0.1 * advance);
        let mut before = self.state();
        let mut slip_before = 0.0;
        let mut slip = 0.0;
        // Sliding inception is enclosed between two states, by halving the increment that leaps it;
        // the increments before it are taken up again after it.
        let mut beyond: Option<Beyond> = None;
        let mut usual = advance;
        while slip < distance * (1.0 - 1e-9) {
            if !watch(slip / distance, &self.history) {
                return Err(SlideFailure::Cancelled);
            }
            // No sliver of an increment at the end.
            let left = distance - slip;
            let increment =
                if left < 1.5 * advance { if left <= advance { left } else { 0.5 * left } } else { advance };
            let next = if left <= increment { distance } else { slip + increment };
            let committed = self.state();
            let cover = self.mechanics.contact.cover.clone();
            let guess = match &beyond {
                None => Guess::between((&before, slip_before), (&committed, slip), next),
                Some(beyond) => Guess::between((&committed, slip), (&beyond.guess, beyond.slip), next),
            };
            match self.step(slip, next, guess) {
                Ok(Attempt::Taken) => {
                    (before, slip_before, slip) = (committed, slip, next);
                    beyond = beyond.filter(|beyond| beyond.slip > slip);
                    advance = match &beyond {
                        Some(beyond) => self.towards(slip, beyond),
                        None => {
                            let growth = increments.growth * if self.has_begun { WHILE_SLIDING } else { 1.0 };
                            let most = (growth * slip)
                                .max(least)
                                .min(distance / LEAST_INCREMENTS * increments.growth / 0.15);
                            (2.0 * advance.max(usual)).min(most)
                        }
                    };
                    if self.recorder.is_due(self.history.last().expect("stepped")) {
                        self.record_fields();
                    }
                }
                Ok(Attempt::PastInception(state)) => {
                    self.mechanics.restore(committed.displacement, cover);
                    if beyond.is_none() {
                        usual = 0.5 * increment;
                    }
                    advance = self.towards(slip, &state);
                    beyond = Some(state);
                }
                Err(
                    failure @ (SlideFailure::Step(_) | SlideFailure::Heat(HeatError::NotConverged { .. })),
                ) => {
                    self.mechanics.restore(committed.displacement, cover);
                    self.cutbacks += 1;
                    usual = 0.0;
                    advance = 0.5 * increment;
                    if advance < 1e-6 * elastic {
                        return Err(failure);
                    }
                }
                Err(failure) => return Err(failure),
            }
        }
        watch(1.0, &self.history);
        Ok(())
    }

    /// Next increment towards a state that sliding has begun before: half of the way, or all of it
    /// once that is narrow enough.
    fn towards(&self, slip: f64, beyond: &Beyond) -> f64 {
        let left = beyond.slip - slip;
        if left <= (INCEPTION_WIDTH * beyond.slip).max(self.finest) { left } else { 0.5 * left }
    }

    /// What the next guess goes on from.
    fn state(&self) -> Guess {
        Guess {
            displacement: self.mechanics.displacement.clone(),
            interference: self.interference,
            edges: self.mechanics.contact.edges(),
        }
    }

    /// One increment from slip to slip, from a first guess.
    fn step(&mut self, from: f64, to: f64, guess: Guess) -> Result<Attempt, SlideFailure> {
        let dt = if self.speed > 0.0 { (to - from) / self.speed } else { 0.0 };
        let Guess { displacement: start, interference, edges } = guess;
        let flat = FlatPosition { interference, displacement: to };
        let problem = self.problem;
        let mut coupled = self.heat.as_mut().filter(|heat| heat.acts_back);
        let mut heated: Option<(Vec<f64>, HeatBalance)> = None;
        let mut failure = None;
        let mut last_limit: Option<Vec<f64>> = None;
        let strength = shear_strength(problem, 1.0, 0.0);
        let before = &self.sources;
        let mut sources = HeatSources::default();
        let (mut frozen, mut refreshed) = (false, 0);
        let coupling_limit = self.increments.coupling_limit;
        let mut heat_time = 0.0;
        // What touches at the first guess, for which the shear limits do not matter.
        let contact = &mut self.mechanics.contact;
        contact.evaluate(|place| start[place], flat, &vec![0.0; contact.len()]);
        contact.cover_to(&edges);
        let mut edge = EdgeSearch::default();
        let solved = self.mechanics.solve(
            flat,
            self.hold,
            start,
            |body: &mut Body, contact: &mut Contact, iteration| {
                if frozen {
                    return None;
                }
                if iteration > 0 {
                    let edges = edge.next(contact.edges(), contact.trial_edges());
                    contact.cover_to(&edges);
                }
                let stretched =
                    if problem.finite_strain { contact.update_areas(iteration == 0) } else { 0.0 };
                // A step that failed may have left any trial state.
                let state = if iteration == 0 { &body.committed } else { &body.trial };
                let hardened = interface_hardening(problem, body, contact, state);
                let mut rise = None;
                if let Some(SlideHeat { conduction, .. }) = &mut coupled {
                    let clock = Instant::now();
                    // The first guess heats as the step before did.
                    sources = if iteration == 0 {
                        before.clone()
                    } else {
                        HeatSources::of(problem, body, contact, dt)
                    };
                    match sources.heat(problem, conduction, contact, Some(&hardened), dt) {
                        Ok(result) => {
                            rise = Some(result.0.clone());
                            heated = Some(result);
                        }
                        Err(error) => failure = Some(error),
                    }
                    heat_time += clock.elapsed().as_secs_f64();
                }
                let limit = shear_limits(problem, contact, &hardened, rise.as_deref());
                // Once they no longer change they are held, and Newton's method converges fast.
                let agrees = last_limit.as_ref().is_some_and(|last| {
                    last.iter()
                        .zip(&limit)
                        .all(|(a, b)| a == b || (a - b).abs() <= LIMIT_TOLERANCE * strength.max(a.abs()))
                });
                refreshed += 1;
                frozen = (agrees && stretched <= AREA_TOLERANCE) || refreshed > coupling_limit;
                last_limit = Some(limit.clone());
                Some(CouplingData { limit, rise, settled: frozen })
            },
        );
        self.mechanics.timings.add(Kernel::Heat, heat_time);
        let flat = solved?;
        if let Some(error) = failure {
            return Err(error.into());
        }
        #[cfg(test)]
        if self.rejecting > 0 {
            self.rejecting -= 1;
            if self.rejecting % 2 == 1 {
                return Err(StepFailure::NotFinite.into());
            }
        }
        let contact = &self.mechanics.contact;
        if contact.at_rim(&contact.trial) {
            let start = (self.history[0].area / std::f64::consts::PI).sqrt();
            return Err(SlideFailure::OutgrewMesh { growth: contact.radius(&contact.trial) / start });
        }
        let mut instant = self.instant(to, *self.history.last().expect("starts with the press"));
        let (strain, stick_fraction) = (instant.plastic_strain_max, instant.stick_fraction);
        if strain > MOST_STRAIN_IN_STICK && stick_fraction > STILL_STICKING {
            return Err(SlideFailure::Distorted { strain, stick_fraction });
        }
        let begins = !self.has_begun && instant.stick_fraction < NO_STICK;
        // What has not stuck after the press, or lets go at once, begins to slide at no slip.
        let stuck = self.history.last().is_some_and(|before| before.stick_fraction >= NO_STICK);
        let width = (INCEPTION_WIDTH * to).max(self.finest);
        if begins && stuck && to - from > width * (1.0 + 1e-9) {
            let guess = Guess { interference: flat.interference, ..self.state() };
            return Ok(Attempt::PastInception(Beyond { slip: to, guess }));
        }
        if let Some(heat) = self.heat.as_mut().filter(|heat| !heat.acts_back) {
            let clock = Instant::now();
            let Mechanics { body, contact, .. } = &self.mechanics;
            sources = HeatSources::of(problem, body, contact, dt);
            heated = Some(sources.heat(problem, &mut heat.conduction, contact, None, dt)?);
            self.mechanics.timings.add(Kernel::Heat, clock.elapsed().as_secs_f64());
        }
        instant.interference = flat.interference;
        let old = FlatPosition { interference: self.interference, displacement: from };
        let interface = self.mechanics.contact.step_work(old, flat);
        let energies = self.mechanics.body.step_energies();
        let stored = |state| self.mechanics.body.elastic_energy(state);
        let elastic = stored(&self.mechanics.body.trial) - stored(&self.mechanics.body.committed);
        instant.time += dt;
        instant.work += interface.of_flat;
        instant.friction_work += interface.friction;
        instant.springs += interface.springs;
        instant.elastic += elastic;
        instant.plastic += energies.plastic;
        instant.thermal_expansion += energies.thermal_expansion;
        instant.moduli_softening += energies.moduli_softening;
        if let (Some((rise, balance)), Some(SlideHeat { conduction, .. })) = (heated, self.heat.as_mut()) {
            instant.heat_in += balance.contact + balance.body;
            instant.heat_out += balance.base + balance.gap;
            instant.heat_stored = conduction.stored(&rise);
            (instant.rise_max, instant.rise_mean) = contact_rise(&self.mechanics.contact, &rise);
            conduction.committed = rise;
        }
        self.mechanics.body.commit();
        self.mechanics.contact.commit();
        self.sources = sources;
        self.interference = flat.interference;
        self.has_begun |= begins;
        self.history.push(instant);
        Ok(Attempt::Taken)
    }

    /// Present state with the totals of `previous`.
    fn instant(&self, slip: f64, previous: SlideState) -> SlideState {
        let contact = &self.mechanics.contact;
        SlideState {
            slip,
            interference: self.interference,
            friction: contact.friction(&contact.trial),
            load: contact.load(&contact.trial),
            area: contact.area(&contact.trial),
            stick_fraction: contact.stick_fraction(&contact.trial),
            plastic_strain_max: self.mechanics.body.trial.largest_plastic_strain(),
            ..previous
        }
    }

    /// Keeps the fields of the present state.
    pub fn record_fields(&mut self) {
        let now = self.history.last().expect("starts with the press");
        self.recorder.keep(now, &self.mechanics, self.heat.as_ref().map(|heat| &heat.conduction));
    }
}

#[cfg(test)]
mod tests;
