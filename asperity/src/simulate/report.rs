//! What is reported of a run: its histories, scalars and fields in SI units, account and warnings.

use tables::law::Estimate;
use tables::quantity::Quantity;

use super::messages::{Note, Warning};
use super::runs::{Ladder, Run, Runner};
use super::{SimulationError, slide_error};
use crate::loading::inception::InceptionCriterion;
use crate::loading::press::Increment;
use crate::loading::problem::{Problem, Units};
use crate::loading::recording::Fields;
use crate::loading::slide::{SlideFailure, SlideState};
use crate::scene::{Hardening, InterfaceStrength, Scene};
use crate::simulate::accuracy::error_budget::ErrorBudget;
use crate::simulate::outcome::{
    Account, ContactGrid, ContactStatus, Outcome, PressStep, SlideStep, Snapshot, Summary,
};
use crate::simulate::scalars::Scalars;
use crate::solver::timings::Kernel;

/// Plastic strain beyond which small-strain kinematics is in doubt.
const LARGE_STRAIN: f64 = 0.2;

/// The outcome of the finest main run, with the errors of `budget` (none: unknown); in the error where
/// the run failed or was stopped.
pub(super) fn report(
    runner: &Runner<'_>,
    mut ladder: Ladder,
    budget: Option<ErrorBudget>,
    stopped: bool,
    wall_time: f64,
) -> Result<Outcome, SimulationError> {
    let warnings = warnings(runner, ladder.result(), budget.as_ref(), stopped);
    let account = account(runner, &ladder, warnings, wall_time);
    let mut run = ladder.main.pop().expect("there is a main run");
    let budget = budget.unwrap_or_else(|| {
        let modelling_error = runner.conditions.modelling_error(runner.pressed, run.plastic_strain());
        ErrorBudget::unknown(&run.scalars, &modelling_error)
    });
    let outcome = outcome(&runner.pressed.problem, &mut run, budget, account);
    let failure = run.failure.or(stopped.then_some(SlideFailure::Cancelled));
    match failure {
        None => Ok(outcome),
        Some(failure) => {
            Err(slide_error(failure, run.history.last(), runner.pressed, Some(Box::new(outcome))))
        }
    }
}

fn account(runner: &Runner<'_>, ladder: &Ladder, warnings: Vec<Warning>, wall_time: f64) -> Account {
    let run = ladder.result();
    let (pressed, conditions) = (runner.pressed, &runner.conditions);
    let mut notes = vec![Note::resolution(&run.resolution), Note::Heat(conditions.heat, conditions.effect)];
    notes.extend(ladder.notes.iter().cloned());
    notes.extend(pressed.strain.map(Note::Strain));
    let earlier = &ladder.main[..ladder.main.len() - 1];
    let others = || ladder.auxiliary.iter().chain(earlier).chain(&ladder.abandoned);
    let mut timings = run.timings;
    let slides: f64 = others().map(Run::slide_time).sum();
    timings.add(Kernel::AuxiliaryRuns, slides + runner.other_presses(run));
    Account {
        elements_per_radius: run.resolution.elements_per_radius,
        sectors: run.resolution.sectors,
        unknowns: run.unknowns,
        heat: conditions.heat.is_coupled(),
        finite_strain: pressed.problem.finite_strain,
        steps: run.history.len() - 1,
        cutbacks: run.cutbacks + others().map(|run| run.cutbacks).sum::<usize>(),
        newton_iterations: run.press.effort.newton + run.effort.newton,
        krylov_iterations: run.press.effort.krylov + run.effort.krylov,
        wall_time,
        timings,
        notes,
        warnings,
    }
}

/// What the reader must know.
fn warnings(
    runner: &Runner<'_>,
    run: &Run,
    budget: Option<&ErrorBudget>,
    stopped: bool,
) -> Vec<Warning> {
    let scene = &runner.pressed.scene;
    let mut warnings = Vec::new();
    match budget.map(|budget| budget.worst(&run.scalars)) {
        None => warnings.push(Warning::ErrorsUnknown),
        Some((quantity, parts)) if parts.total() > scene.numerics.accuracy => {
            let (error, accuracy) = (parts.total(), scene.numerics.accuracy);
            warnings.push(Warning::ErrorAboveAccuracy { quantity, error, accuracy });
        }
        Some(_) => {}
    }
    let inception = run.scalars.inception;
    if inception == InceptionCriterion::None && run.history.len() > 1 && scene.interface.law.has_friction() {
        warnings.push(Warning::NotSliding);
    }
    let strain = run.plastic_strain();
    warnings.extend(warnings_of_strength(scene, strain));
    if strain > LARGE_STRAIN && !runner.pressed.problem.finite_strain {
        warnings.push(Warning::LargeStrain { strain, limit: LARGE_STRAIN });
    }
    warnings.extend(runner.conditions.unresolved_layer(runner.pressed, &run.resolution));
    if stopped {
        warnings.push(Warning::StoppedBeforeRefinement);
    }
    warnings
}

/// An interface as strong as a body that flows.
fn warnings_of_strength(scene: &Scene, plastic_strain: f64) -> Vec<Warning> {
    let equal = scene.interface.strength_factor >= 1.0 && scene.interface.law.as_strong_as_bulk();
    if !equal || plastic_strain <= 0.0 {
        return Vec::new();
    }
    let perfect = scene.material.hardening == Hardening::None;
    let hardened = scene.interface.strength == InterfaceStrength::Current;
    let equal_strength = perfect.then_some(Warning::EqualStrength);
    equal_strength.into_iter().chain(hardened.then_some(Warning::HardenedInterface)).collect()
}

/// Values with their errors.
fn summary(scalars: &Scalars, budget: &ErrorBudget) -> Summary {
    let of = |quantity| Estimate { value: scalars.value(quantity), error: budget.total(quantity) };
    Summary {
        mu: of(Quantity::Mu),
        mu_static: of(Quantity::MuStatic),
        mu_peak: of(Quantity::MuPeak),
        mu_mean: of(Quantity::MuMean),
        friction: of(Quantity::Friction),
        friction_static: of(Quantity::FrictionStatic),
        load: of(Quantity::Load),
        load_press: of(Quantity::LoadPress),
        area: of(Quantity::Area),
        area_press: of(Quantity::AreaPress),
        contact_radius: of(Quantity::ContactRadius),
        energy_release: of(Quantity::EnergyRelease),
        energy_weakening: of(Quantity::EnergyWeakening),
        temperature_max: of(Quantity::TemperatureMax),
        temperature_mean: of(Quantity::TemperatureMean),
        inception_slip: of(Quantity::InceptionSlip),
        inception: scalars.inception,
        levelled: scalars.levelled,
    }
}

/// The whole outcome in SI units.
fn outcome(problem: &Problem, run: &mut Run, budget: ErrorBudget, account: Account) -> Outcome {
    let units = problem.units;
    let press_step = |i: &Increment| PressStep {
        interference: i.interference / problem.critical_interference,
        load: i.load * units.force(),
        area: i.area * units.area(),
    };
    let (rings, columns) = (run.radii.len(), run.angles.len());
    Outcome {
        critical_interference: problem.critical_interference * units.length,
        press: run.press.increments.iter().map(press_step).collect(),
        slide: run.history.iter().map(|state| slide_step(problem, state)).collect(),
        summary: summary(&run.scalars, &budget),
        budget,
        grid: ContactGrid {
            theta: run.angles.clone(),
            r: run.radii.iter().map(|r| r * units.length).collect(),
        },
        snapshots: run.fields.iter().map(|fields| snapshot(&units, fields, (rings, columns))).collect(),
        body: run.body.take(),
        account,
    }
}

fn slide_step(problem: &Problem, i: &SlideState) -> SlideStep {
    let units = problem.units;
    // Work and heat are of the half body.
    let energy = |x: f64| 2.0 * x * units.energy();
    SlideStep {
        slip: i.slip * units.length,
        interference: i.interference / problem.critical_interference,
        time: i.time * units.time,
        friction: i.friction * units.force(),
        load: i.load * units.force(),
        mu: i.mu(),
        area: i.area * units.area(),
        stick_fraction: i.stick_fraction,
        temperature_max: units.temperature + i.rise_max,
        temperature_mean: units.temperature + i.rise_mean,
        plastic_strain_max: i.plastic_strain_max,
        work: energy(i.work),
        energy_elastic: energy(i.elastic + i.springs),
        dissipation_plastic: energy(i.plastic),
        dissipation_friction: energy(i.friction_work),
        work_thermal_expansion: energy(i.thermal_expansion),
        energy_moduli_softening: energy(i.moduli_softening),
        heat_in: energy(i.heat_in),
        heat_stored: energy(i.heat_stored),
        heat_out: energy(i.heat_out),
    }
}

/// Fields stored ring by ring, reported angle by angle.
fn snapshot(units: &Units, fields: &Fields, (rings, columns): (usize, usize)) -> Snapshot {
    let places = || (0..columns).flat_map(|j| (0..rings).map(move |k| k * columns + j));
    let reordered = |v: &[f64], scale: f64| -> Vec<f64> { places().map(|at| scale * v[at]).collect() };
    let status: Vec<ContactStatus> = places().map(|at| fields.status[at]).collect();
    Snapshot {
        slip: fields.slip * units.length,
        status,
        pressure: reordered(&fields.pressure, units.stress),
        shear: reordered(&fields.shear, units.stress),
        temperature: places().map(|at| units.temperature + fields.rise[at]).collect(),
        slip_distance: reordered(&fields.path, units.length),
    }
}
