//! Report of a run: its histories, scalars and fields in SI units, account and warnings.

use tables::closed_forms::partial_slip::SHORTEST_INCEPTION;
use tables::law::UNKNOWN_STEADY_FRICTION;
use tables::quantity::{Estimate, History, Quantity, Scalars};

use super::ladder::Ladder;
use super::messages::{Note, Warning};
use super::pressed::Pressed;
use super::run::Run;
use super::runs::Runner;
use super::{SimulationError, slide_error};
use crate::loading::inception::{InceptionCriterion, stick_slip, sudden_fall};
use crate::loading::press::Increment;
use crate::loading::problem::{Problem, wave_speed};
use crate::loading::slide::SlideFailure;
use crate::loading::state::SlideState;
use crate::scene::{Interface, InterfaceStrength, LoadingStep, Scene};
use crate::simulate::accuracy::correction::Correction;
use crate::simulate::accuracy::error_budget::{CONTROLLED, ErrorBudget, ErrorSource};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::derived::inception_time;
use crate::simulate::outcome::{Account, ContactGrid, Outcome};
use crate::solver::timings::Kernel;

/// Plastic strain beyond which small-strain kinematics is inaccurate.
const LARGE_STRAIN: f64 = 0.2;
/// Missing energy or heat, over the largest term of its balance at the end of the slide, above which there is a warning:
/// at small strain balances close to the tolerance of the solver, at finite strain to second order in the increments.
const BALANCE: f64 = 1e-5;
const BALANCE_AT_FINITE_STRAIN: f64 = 1e-4;
/// Difference of the heat from that of friction and plastic flow, relative: the heat of an increment is by the traction at
/// its end, its dissipation by the mean one.
const BALANCE_OF_SOURCES: f64 = 0.03;

/// Friction coefficient whose work is the smallest that balances are relative to: without friction all terms are rounding
/// errors of the pressed state.
const NEGLIGIBLE_FRICTION: f64 = 1e-3;

/// The outcome of the finest main run, with the errors of `budget` (none: unknown); in the error where
/// the run failed or was stopped.
pub(super) fn report(
    runner: &Runner<'_>,
    mut ladder: Ladder,
    budget: Option<ErrorBudget>,
    stopped: bool,
    wall_time: f64,
) -> Result<Outcome, SimulationError> {
    let obstacle = ladder.obstacle.take();
    let mut warnings = warnings(runner, ladder.result(), budget.as_ref(), stopped);
    let Resolution { elements_per_radius, sectors, .. } = ladder.result().resolution;
    warnings.extend(obstacle.as_ref().map(|_| Warning::NoMainRun { elements_per_radius, sectors }));
    let account = account(runner, &ladder, warnings, wall_time);
    let mut run = ladder.main.pop().expect("there is a main run");
    let of_press = |quantity| {
        let relative = runner.pressed.relative_error(quantity, &run.resolution);
        relative.map(|relative| relative * run.values.value(quantity))
    };
    let budget = budget.unwrap_or_else(|| ErrorBudget::unknown(of_press));
    let outcome = outcome(runner, &mut run, budget, account);
    let error = match obstacle {
        Some(error) => Some(next_not_begun(error, &run)),
        None => {
            let failure = run.failure.or(stopped.then_some(SlideFailure::Cancelled));
            failure.map(|failure| slide_error(failure, run.history.last(), runner.pressed))
        }
    };
    match error {
        None => Ok(outcome),
        Some(error) => Err(error.with_partial(outcome)),
    }
}

/// The reason why no run could follow `run`, with what is reported instead and how to ask for less.
fn next_not_begun(error: SimulationError, run: &Run) -> SimulationError {
    let (stage, at, reason) = match error {
        SimulationError::NotConverged { stage, at, reason, .. } => (stage, at, reason),
        SimulationError::Unsupported(reason) => ("press", "the mesh of the main run".to_owned(), reason),
        stopped @ SimulationError::Cancelled { .. } => return stopped,
    };
    let Resolution { elements_per_radius, sectors, .. } = run.resolution;
    let end = if run.failure.is_none() { "complete" } else { "incomplete" };
    let reason = format!(
        "{reason}; the results are those of the run before, {end}, with {elements_per_radius} elements per contact \
         radius and {sectors} sectors; numerics.elements_per_radius = {elements_per_radius} takes its mesh for the main \
         run, a larger numerics.accuracy its increments"
    );
    SimulationError::NotConverged { stage, at, reason, partial: None }
}

fn account(runner: &Runner<'_>, ladder: &Ladder, warnings: Vec<Warning>, wall_time: f64) -> Account {
    let run = ladder.result();
    let (pressed, conditions) = (runner.pressed, &runner.conditions);
    let mut notes = vec![Note::Resolution(run.resolution), Note::Heat(conditions.heat, conditions.effect)];
    notes.extend(ladder.notes.iter().cloned());
    notes.extend(Note::press(&pressed.problem));
    notes.extend(Note::heat_partition(&pressed.problem, &run.history));
    notes.extend(pressed.strain.map(Note::Strain));
    let planned = pressed.numerics.accuracy;
    notes.extend(pressed.shears_without_limit.then_some(Note::UnlimitedShear { planned }));
    let earlier = &ladder.main[..ladder.main.len() - 1];
    let others = || ladder.auxiliary.iter().chain(earlier).chain(&ladder.coarse).chain(&ladder.abandoned);
    let mut timings = run.timings;
    let other_slides = ladder.time_of_slides() - run.slide_time();
    timings.add(Kernel::AuxiliaryRuns, other_slides + runner.other_presses(run));
    Account {
        elements_per_radius: run.resolution.elements_per_radius,
        sectors: run.resolution.sectors,
        unknowns: run.unknowns,
        heat: conditions.heat.is_coupled(),
        finite_strain: pressed.problem.finite_strain,
        steps: run.history.len() - 1,
        cutbacks: run.cutbacks + others().map(|run| run.cutbacks).sum::<usize>(),
        newton_iterations: run.press.effort.newton + run.effort.newton,
        press_newton_iterations: run.press.effort.newton,
        line_searches: run.press.effort.line_searches + run.effort.line_searches,
        krylov_iterations: run.press.effort.krylov + run.effort.krylov,
        wall_time,
        timings,
        notes,
        warnings,
    }
}

fn warnings(runner: &Runner<'_>, run: &Run, budget: Option<&ErrorBudget>, stopped: bool) -> Vec<Warning> {
    let scene = &runner.pressed.scene;
    let mut warnings = Vec::new();
    match budget {
        None => warnings.push(Warning::ErrorsUnknown),
        Some(budget) => warnings.extend(warning_of_errors(budget, run, scene.numerics.accuracy)),
    }
    let inception = run.values.inception;
    if inception != InceptionCriterion::None && stick_slip(&run.history).is_some() {
        warnings.push(Warning::StickSlip);
    }
    warnings.extend(sudden_fall(&run.history).map(|step| Warning::SuddenFall { step: step + 1 }));
    let is_stuck = inception == InceptionCriterion::None && run.history.len() > 1;
    // A slide that failed or was stopped says so; a longer one would end there too.
    if is_stuck && run.failure.is_none() && scene.interface.law.has_friction() {
        warnings.push(Warning::NotSliding);
    }
    warnings.extend(budget.filter(|_| !is_stuck).and_then(|budget| uncertain_steady_friction(budget, run)));
    warnings.extend(fast_inception(runner, run));
    warnings.extend(released_press(runner, run));
    let spread = run.values.bracket(Quantity::MuStatic) / run.values.value(Quantity::MuStatic);
    let is_unsure = inception == InceptionCriterion::Stiffness && spread > scene.numerics.accuracy;
    warnings.extend(is_unsure.then_some(Warning::InceptionByStiffness { spread }));
    let strain = run.plastic_strain();
    warnings.extend(warning_of_strength(scene, run.plastic_strain_in_stick()));
    if strain > LARGE_STRAIN && !runner.pressed.problem.finite_strain {
        warnings.push(Warning::LargeStrain { strain, limit: LARGE_STRAIN });
    }
    warnings.extend(runner.conditions.unresolved_layer(&run.resolution));
    warnings.extend(warnings_of_balances(&runner.pressed.problem, &run.history));
    let rise = run.history.iter().map(|state| state.rise_max).fold(0.0, f64::max);
    let highest = runner.pressed.problem.units.temperature + rise;
    let melting = scene.material.softening.melting().filter(|melting| highest > *melting && rise > 0.0);
    if scene.highest_temperature().is_none() {
        warnings.extend(melting.map(|melting| Warning::AboveMelting { highest, melting }));
    }
    warnings.extend(
        scene
            .outside_tables(highest, runner.conditions.heat.is_coupled())
            .into_iter()
            .chain(scene.outside_hardening(strain))
            .map(Warning::OutsideTable),
    );
    if stopped {
        warnings.push(Warning::StoppedBeforeFurtherRun);
    }
    warnings
}

/// The controlled quantity that misses its accuracy most, and whatever is undetermined.
fn warning_of_errors(budget: &ErrorBudget, run: &Run, accuracy: f64) -> Vec<Warning> {
    let of = |quantity: Quantity| (quantity, budget.relative(quantity, &run.values));
    let over = |quantity: Quantity, error: f64| error / quantity.allowance();
    let mut errors = CONTROLLED.map(of);
    errors.sort_by(|a, b| over(b.0, b.1).total_cmp(&over(a.0, a.1)));
    let above = errors.into_iter().filter(|(quantity, error)| over(*quantity, *error) > accuracy);
    let warning = |(quantity, error): (Quantity, f64)| {
        let lasting = budget.lasting(quantity) / run.values.value(quantity).abs();
        Warning::of_error(quantity, [error, lasting], quantity.allowance(), accuracy)
    };
    let (undetermined, inexact): (Vec<_>, Vec<_>) =
        above.map(warning).partition(|warning| matches!(warning, Warning::ErrorAboveValue { .. }));
    inexact.into_iter().take(1).chain(undetermined).collect()
}

/// Steady friction that counts as unknown.
fn uncertain_steady_friction(budget: &ErrorBudget, run: &Run) -> Option<Warning> {
    let error =
        budget.part(ErrorSource::Steps, Quantity::MuSteady) / run.values.value(Quantity::MuSteady).abs();
    (error > UNKNOWN_STEADY_FRICTION).then_some(Warning::SteadyUncertain { error })
}

/// Sliding inception so fast that inertia counts.
fn fast_inception(runner: &Runner<'_>, run: &Run) -> Option<Warning> {
    if run.values.inception == InceptionCriterion::None {
        return None;
    }
    let slip_rate = runner.conditions.programme.first()?.slip_rate();
    let Pressed { scene, problem, .. } = runner.pressed;
    let correction = correction(runner, run);
    let exact = |quantity| Estimate::exact(run.values.value(quantity) * correction.factor(quantity));
    let (friction, radius) = (exact(Quantity::FrictionStatic), exact(Quantity::ContactRadius));
    // Both bodies are displaced, the wave passes the asperity.
    let faster = problem.wave_speed * problem.units.speed() / wave_speed(&scene.material);
    let time = faster * inception_time(scene, slip_rate, friction, radius)?.value;
    (time < SHORTEST_INCEPTION).then_some(Warning::FastInception { time, limit: SHORTEST_INCEPTION })
}

/// An interface along which the shear tractions of the press slip before they turn into the motion.
fn released_press(runner: &Runner<'_>, run: &Run) -> Option<Warning> {
    let units = &runner.pressed.problem.units;
    let slide = &run.history[1..];
    let turns = slide.iter().position(SlideState::is_along_motion)?;
    let released = slide[..turns].last()?;
    let energy = 2.0 * (released.work - released.elastic) / released.area * units.stress * units.length;
    let share = energy / run.values.value(Quantity::EnergyRelease);
    let limit = Quantity::EnergyRelease.allowance() * runner.pressed.scene.numerics.accuracy;
    (share > limit).then_some(Warning::ReleasedPress { share: share.min(1.0) })
}

/// Energy or heat that is missing at the end.
fn warnings_of_balances(problem: &Problem, history: &[SlideState]) -> Option<Warning> {
    let limit = if problem.finite_strain { BALANCE_AT_FINITE_STRAIN } else { BALANCE };
    let end = history.last()?;
    let path: f64 = history.windows(2).map(|pair| (pair[1].slip - pair[0].slip).abs()).sum();
    // Of the half body.
    let negligible = 0.5 * NEGLIGIBLE_FRICTION * end.load * path;
    let relative = |missing: f64, terms: &[f64]| {
        let largest = terms.iter().fold(negligible, |most: f64, term| most.max(term.abs()));
        if largest > 0.0 { missing.abs() / largest } else { 0.0 }
    };
    let energy = relative(end.energy_missing(), &[&end.energies()[..], &[end.work]].concat());
    let heat = relative(end.heat_missing(), &[end.heat_in, end.heat_stored, end.heat_out]);
    let Interface { heat_partition, taylor_quinney, .. } = problem.interface;
    let dissipated = heat_partition * end.friction_work + taylor_quinney * end.plastic;
    let taken = end.heat_in + end.heat_counterface;
    // Before sliding begins there is hardly any heat.
    let is_heated = taken != 0.0 && history.iter().any(SlideState::slides);
    let sources = if is_heated { relative(taken - dissipated, &[dissipated]) } else { 0.0 };
    let is_unbalanced = energy.max(heat) > limit || sources > BALANCE_OF_SOURCES;
    is_unbalanced.then_some(Warning::Unbalanced { energy, heat, sources })
}

/// An interface as strong as a body that flows.
fn warning_of_strength(scene: &Scene, plastic_strain: f64) -> Option<Warning> {
    let grows_with_body = scene.interface.strength == InterfaceStrength::Current;
    scene.localised_shear(plastic_strain).map(|_| match grows_with_body {
        true => Warning::HardenedInterface,
        false => Warning::EqualStrength { plateau: scene.material.hardening.plateau() },
    })
}

/// The whole outcome in SI units.
fn outcome(runner: &Runner<'_>, run: &mut Run, budget: ErrorBudget, account: Account) -> Outcome {
    let Pressed { scene, problem, .. } = runner.pressed;
    let units = problem.units;
    let correction = correction(runner, run);
    let budget = budget.scaled(|quantity| correction.factor(quantity));
    Outcome {
        interference: scene.loading.interference,
        critical_interference: problem.critical_interference * units.length,
        scalars: scalars(run, &correction, &budget),
        inception: run.values.inception,
        steady: run.values.steady,
        budget,
        press: press_history(problem, &run.press.increments, &correction),
        slide: slide_history((problem, &runner.conditions.programme), &run.history, &correction),
        grid: ContactGrid {
            theta: run.contact.angles.clone(),
            r: run.contact.radii.iter().map(|r| r * units.length).collect(),
        },
        counterface_rise: counterface_rise(run),
        snapshots: std::mem::take(&mut run.snapshots),
        body: run.body.take(),
        account,
    }
}

/// Correction of the values of a run for their mean errors.
fn correction<'a>(runner: &Runner<'a>, run: &Run) -> Correction<'a> {
    let scene = &runner.pressed.scene;
    Correction {
        inception: run.values.inception,
        law: &scene.interface.law,
        has_slid: run.history.len() > 1,
        interference: scene.loading.interference,
        peclet: runner.conditions.peclet_number_at_inception(),
        resolution: run.resolution,
    }
}

/// Values without their mean discretisation errors; the largest friction coefficient is at least the static one so corrected.
fn scalars(run: &Run, correction: &Correction<'_>, budget: &ErrorBudget) -> Scalars {
    let mut scalars = Scalars::from_fn(|quantity| {
        let value = run.values.value(quantity) * correction.factor(quantity);
        Estimate { value, error: budget.total(quantity) }
    });
    let (peak, at_inception) = (scalars[Quantity::MuPeak], scalars[Quantity::MuStatic]);
    // Unknown stays unknown.
    if peak.value <= at_inception.value {
        scalars[Quantity::MuPeak] = Estimate { error: peak.error.max(at_inception.error), ..at_inception };
    }
    scalars
}

fn counterface_rise(run: &Run) -> Option<f64> {
    let radius = run.contact.radius(&run.contact.committed);
    let counterface = run.counterface.as_ref().filter(|_| radius > 0.0);
    counterface.map(|half_space| half_space.highest_rise(radius))
}

fn press_history(problem: &Problem, increments: &[Increment], correction: &Correction<'_>) -> History {
    let units = problem.units;
    let mut history = History::new(&Quantity::PRESS_HISTORIES);
    for increment in increments {
        let of_run = |quantity| match quantity {
            Quantity::InterferencePress => increment.interference / problem.critical_interference,
            Quantity::LoadPress => increment.load * units.force(),
            Quantity::AreaPress => increment.area * units.area(),
            _ => unreachable!("{quantity:?} is no history of the press"),
        };
        history.push(|quantity| correction.factor(quantity) * of_run(quantity));
    }
    history
}

fn slide_history(
    (problem, programme): (&Problem, &[LoadingStep]),
    states: &[SlideState],
    correction: &Correction<'_>,
) -> History {
    let units = problem.units;
    // Work and heat are of the half body.
    let energy = |x: f64| 2.0 * x * units.energy();
    let mut history = History::new(&Quantity::RUN_HISTORIES);
    let (mut before, mut path) = (0.0, 0.0);
    for i in states {
        path += (i.slip - before).abs();
        before = i.slip;
        let of_run = |quantity| match quantity {
            Quantity::Slip => i.slip * units.length,
            Quantity::SlipAccumulated => path * units.length,
            Quantity::Interference => i.interference / problem.critical_interference,
            Quantity::Time => i.time * units.time,
            Quantity::SlipRate => programme[i.step].slip_rate(),
            Quantity::ProgrammeStep => (i.step + 1) as f64,
            Quantity::Friction => i.friction * units.force(),
            Quantity::Load => i.load * units.force(),
            Quantity::Mu => i.mu(),
            Quantity::Area => i.area * units.area(),
            Quantity::StickFraction => i.stick_fraction,
            Quantity::StrengthMobilised => i.mobilised,
            Quantity::TemperatureMax => units.temperature + i.rise_max,
            Quantity::TemperatureMean => units.temperature + i.rise_mean,
            Quantity::PlasticStrainMax => i.plastic_strain_max,
            Quantity::Work => energy(i.work),
            Quantity::EnergyElastic => energy(i.elastic + i.springs),
            Quantity::DissipationPlastic => energy(i.plastic),
            Quantity::DissipationFriction => energy(i.friction_work),
            Quantity::WorkThermalExpansion => energy(i.thermal_expansion),
            Quantity::EnergyModuliSoftening => energy(i.moduli_softening),
            Quantity::HeatIn => energy(i.heat_in),
            Quantity::HeatStored => energy(i.heat_stored),
            Quantity::HeatOut => energy(i.heat_out),
            Quantity::HeatCounterface => energy(i.heat_counterface),
            Quantity::HeatPartition => i.heat_partition,
            _ => unreachable!("{quantity:?} is no history of the slide"),
        };
        // The first state is that of the press.
        let of_state = Correction { has_slid: !history.is_empty(), ..*correction };
        history.push(|quantity| of_state.factor(quantity) * of_run(quantity));
    }
    history
}
