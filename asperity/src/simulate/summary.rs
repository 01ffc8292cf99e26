//! What is reported of a run: its histories, scalars and fields in SI units, and warnings.

use tables::law::Estimate;
use tables::quantity::Quantity;

use crate::loading::press::Increment;
use crate::loading::problem::Problem;
use crate::loading::slide::SlideState;
use crate::scene::{Hardening, InterfaceStrength, Kinematics, Scene};
use crate::simulate::Slid;
use crate::simulate::accuracy::error_budget::ErrorBudget;
use crate::simulate::outcome::{
    Account, ContactGrid, ContactStatus, InceptionCriterion, Outcome, PressStep, SlideStep, Snapshot, Summary,
};
use crate::simulate::scalars::Scalars;

/// Top-layer strains above this are beyond small-strain kinematics.
const LARGE_STRAIN: f64 = 0.2;

/// What the reader must know.
pub fn warn(
    scene: &Scene,
    history: &[SlideState],
    inception: InceptionCriterion,
    warnings: &mut Vec<String>,
) {
    if inception == InceptionCriterion::None && history.len() > 1 && scene.interface.law.has_friction() {
        warnings.push(
            "sliding has not begun by the end of the slide: mu_static, Q_static, G and inception_slip are those of \
             its end; a longer slip_distance lets it begin"
                .into(),
        );
    }
    let equal_strength = scene.interface.strength_factor >= 1.0 && scene.interface.law.as_strong_as_bulk();
    let plastic = history.last().is_some_and(|i| i.plastic_strain_max > 0.0);
    if equal_strength && scene.material.hardening == Hardening::None && plastic {
        warnings.push(
            "body and interface are equally strong and the body does not harden: shear may localise \
             in one layer of elements, and mu then follows the mesh"
                .into(),
        );
    }
    if equal_strength && scene.interface.strength == InterfaceStrength::Current && plastic {
        warnings.push(
            "the interface is as strong as the hardened body: the top layer of elements shears before \
             the contact slips, and mu then follows the mesh; a strength_factor below 1 lets it slip"
                .into(),
        );
    }
    let strain = history.last().map_or(0.0, |i| i.plastic_strain_max);
    if strain > LARGE_STRAIN && scene.model.kinematics != Kinematics::Finite {
        warnings.push(format!(
            "plastic strain reaches {strain:.2}: beyond about {LARGE_STRAIN} small-strain kinematics is in doubt"
        ));
    }
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
pub fn outcome(
    problem: &Problem,
    press: &[Increment],
    slid: &mut Slid,
    scalars: &Scalars,
    budget: ErrorBudget,
    account: Account,
) -> Outcome {
    let (history, fields, grid) = (&slid.history, &slid.fields, &slid.grid);
    let units = problem.units;
    // Work and heat are of the half body.
    let energy = |x: f64| 2.0 * x * units.energy();
    let slide = history
        .iter()
        .map(|i| SlideStep {
            slip: i.slip * units.length,
            interference: i.interference / problem.critical_interference,
            time: i.time * units.time,
            friction: i.friction * units.force(),
            load: i.load * units.force(),
            mu: if i.load > 0.0 { i.friction / i.load } else { 0.0 },
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
        })
        .collect();
    let rings = grid.radii.len();
    let columns = grid.angles.len();
    // Stored ring by ring; reported angle by angle.
    let places = || (0..columns).flat_map(|j| (0..rings).map(move |k| k * columns + j));
    let turn = |v: &[f64], scale: f64| -> Vec<f64> { places().map(|at| scale * v[at]).collect() };
    let reordered = |v: &[ContactStatus]| -> Vec<ContactStatus> { places().map(|at| v[at]).collect() };
    let snapshots = fields
        .iter()
        .map(|f| Snapshot {
            slip: f.slip * units.length,
            status: reordered(&f.status),
            pressure: turn(&f.pressure, units.stress),
            shear: turn(&f.shear, units.stress),
            temperature: turn(&f.rise, 1.0).iter().map(|t| units.temperature + t).collect(),
            slip_distance: turn(&f.path, units.length),
        })
        .collect();
    Outcome {
        critical_interference: problem.critical_interference * units.length,
        press: press
            .iter()
            .map(|i| PressStep {
                interference: i.interference / problem.critical_interference,
                load: i.load * units.force(),
                area: i.area * units.area(),
            })
            .collect(),
        slide,
        summary: summary(scalars, &budget),
        budget,
        grid: ContactGrid {
            theta: grid.angles.clone(),
            r: grid.radii.iter().map(|r| r * units.length).collect(),
        },
        snapshots,
        body: slid.body.take(),
        account,
    }
}
