//! First law of thermodynamics at every step of a slide: work of the flat = elastic energy + plastic and frictional
//! dissipation + work on thermal expansion + elastic energy given up by moduli that fall with temperature; heat in = heat
//! stored + heat out.

use tables::quantity::{Quantity, State};

use super::counterface::conducting;
use super::setup::{largest, last, mesh, preset, scene, steel_4340};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::loading::NEWTON_TOLERANCE;
use crate::scene::{FrictionLaw, Kinematics, Scene, Softening};
use crate::simulate::outcome::Outcome;
use crate::simulate::{Watch, simulate};

const SOURCE: &str = "first law of thermodynamics";
/// Largest share of the energy that may be missing, over the tolerance of the residual of a step.
const ENERGY_OF_RESIDUAL: f64 = 5.0;

pub const CASES: [Case; 6] = [
    Case::new("ledgers of a hot plastic slide", Cost::Quick, hot_plastic),
    Case::new("heat of interfaces that lose their strength", Cost::Medium, softening_interfaces),
    Case::new("ledgers with properties that depend on temperature", Cost::Medium, varying_properties),
    Case::new("ledgers at finite strain", Cost::Medium, finite_strain),
    Case::new("heat through the gap", Cost::Medium, through_the_gap),
    Case::new("heat into the counterface", Cost::Medium, into_the_counterface),
];

/// 4340 steel at 3 m/s; half of the frictional heat and 0.9 of the plastic work heat the asperity.
fn steel(interference: f64) -> Scene {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, interference, mesh(6, 8));
    scene.interface.heat_partition = 0.5;
    scene.interface.taylor_quinney = 0.9;
    scene.loading.slip_rate = 3.0;
    scene.loading.slip_distance = 0.5;
    scene
}

/// |balance| over the largest of `terms`, where there is any.
fn missing(balance: f64, terms: &[f64]) -> f64 {
    let most = terms.iter().fold(0.0, |most: f64, term| most.max(term.abs()));
    if most > 0.0 { balance.abs() / most } else { balance.abs() }
}

/// Energy missing in a state, over the largest term.
pub(in crate::studies) fn energy_missing(step: State<'_>) -> f64 {
    use Quantity::*;
    let parts =
        [EnergyElastic, DissipationPlastic, DissipationFriction, WorkThermalExpansion, EnergyModuliSoftening];
    let parts = parts.map(|quantity| step[quantity]);
    let balance = step[Work] - parts.iter().sum::<f64>();
    missing(balance, &[&parts[..], &[step[Work]]].concat())
}

/// Heat missing in a state, over the largest term.
pub(in crate::studies) fn heat_missing(step: State<'_>) -> f64 {
    let terms = [step[Quantity::HeatIn], step[Quantity::HeatStored], step[Quantity::HeatOut]];
    missing(terms[0] - terms[1] - terms[2], &terms)
}

fn row(name: &str, outcome: &Outcome, of: fn(State<'_>) -> f64, bound: f64) -> Row {
    let tolerance = Tolerance::absolute(bound, "tolerance of the solver");
    let name = format!("{name}, at any step, over the largest term");
    Row::new(name, largest(outcome, of), Reference::exact(0.0, SOURCE), tolerance)
}

/// The energy ledger of a slide.
pub(super) fn energy(name: &str, outcome: &Outcome) -> Row {
    row(name, outcome, energy_missing, ENERGY_OF_RESIDUAL * NEWTON_TOLERANCE)
}

fn hot_plastic(watch: &dyn Watch) -> Rows {
    let scene = steel(20.0);
    let outcome = simulate(&scene, watch)?;
    Ok(vec![
        energy("energy missing", &outcome),
        row("heat missing", &outcome, heat_missing, 1e-6),
        generated("heat in over the heat generated", &scene, &outcome, 0.005),
    ])
}

/// Carbon steel of EN 1993-1-2 so fast that the surface loses half of its strength and modulus and a third of its
/// conductivity.
fn varying_properties(watch: &dyn Watch) -> Rows {
    let steel = preset("carbon-steel-en1993");
    let mut scene = scene(steel, FrictionLaw::ShearStrength, 20.0, mesh(6, 8));
    scene.interface.strength_factor = 0.9;
    scene.interface.taylor_quinney = 0.9;
    scene.loading.slip_rate = 300.0;
    scene.loading.slip_distance = 1.0;
    let outcome = simulate(&scene, watch)?;
    Ok(vec![
        energy("energy missing, properties over temperature", &outcome),
        row("heat missing, properties over temperature", &outcome, heat_missing, 1e-10),
    ])
}

/// At 50 ω_c in increments of a tenth of the slip.
fn finite_strain(watch: &dyn Watch) -> Rows {
    let mut scene = steel(50.0);
    scene.model.kinematics = Kinematics::Finite;
    // Increments alone: mesh and angles are given.
    scene.numerics.accuracy = 0.002;
    let outcome = simulate(&scene, watch)?;
    let work = last(&outcome)[Quantity::Work];
    // Trapezoidal work on a curved path: missing before gross slip, when little work has been done.
    let off = largest(&outcome, |step| energy_missing(step) * step[Quantity::Work] / work);
    Ok(vec![
        Row::new(
            "energy missing at finite strain, over the work of the slide",
            off,
            Reference::exact(0.0, SOURCE),
            Tolerance::absolute(1e-7, "curvature of the forces within a step, third order"),
        ),
        row("heat missing at finite strain", &outcome, heat_missing, 1e-6),
    ])
}

/// Heat into both bodies over f_h of the frictional and β of the plastic dissipation; f_h is 1 beside a conducting
/// counterface.
pub(in crate::studies) fn heat_over_dissipation(scene: &Scene, step: State<'_>) -> f64 {
    let partition = match scene.counterface.conduction() {
        Some(_) => 1.0,
        None => scene.interface.heat_partition,
    };
    let plastic = scene.interface.taylor_quinney * step[Quantity::DissipationPlastic];
    let dissipated = partition * step[Quantity::DissipationFriction] + plastic;
    (step[Quantity::HeatIn] + step[Quantity::HeatCounterface]) / dissipated
}

fn generated(name: &str, scene: &Scene, outcome: &Outcome, bound: f64) -> Row {
    const WHY: &str = "dissipation by the mean traction of a step, heat by that at its end";
    let reference = Reference::exact(1.0, SOURCE);
    let found = heat_over_dissipation(scene, last(outcome));
    Row::new(name, found, reference, Tolerance::relative(bound, WHY))
}

/// Ti-6Al-4V at 100 m/s loses most of its strength as sliding begins. A film of 10 GPa that shears at no more than the
/// strength of the metal is an interface of that strength, and Coulomb's law with such a limit heats as much as it
/// dissipates.
fn softening_interfaces(watch: &dyn Watch) -> Rows {
    let slide = |law: FrictionLaw| {
        let mut scene = scene(preset("titanium-6al4v"), law, 20.0, mesh(6, 4));
        scene.interface.heat_partition = 0.5;
        scene.interface.taylor_quinney = 0.9;
        scene.loading.slip_rate = 100.0;
        scene.loading.slip_distance = 0.5;
        simulate(&scene, watch).map(|outcome| (scene, outcome))
    };
    let (_, metal) = slide(FrictionLaw::ShearStrength)?;
    let (scene_of_film, film) = slide(FrictionLaw::BriscoeTabor {
        film_strength: 1e10,
        pressure_coefficient: 0.0,
        film_softening: Softening::None,
        cap: true,
    })?;
    let (scene_of_coulomb, coulomb) = slide(FrictionLaw::Coulomb { friction: 0.3, cap: true })?;
    // Of the mesh: forces and areas of the metal are corrected for their mean errors, those of films are not.
    let over = |quantity: Quantity| last(&film)[quantity] / last(&metal)[quantity];
    let same = |name: &str, ratio: f64| {
        let reference = Reference::exact(1.0, "both interfaces are the strength of the metal");
        Row::new(name, ratio, reference, Tolerance::relative(1e-6, "tolerance of the solver"))
    };
    Ok(vec![
        same(
            "friction work of a strong film with the limit of the metal, over that of the metal",
            over(Quantity::DissipationFriction),
        ),
        same("mean temperature of it, over that of the metal", over(Quantity::TemperatureMean)),
        generated("heat in over the heat generated, capped film at 100 m/s", &scene_of_film, &film, 0.02),
        generated(
            "heat in over the heat generated, capped Coulomb friction at 100 m/s",
            &scene_of_coulomb,
            &coulomb,
            0.02,
        ),
    ])
}

/// A conducting gap takes heat out and generates as much.
fn through_the_gap(watch: &dyn Watch) -> Rows {
    let mut scene = steel(20.0);
    scene.interface.gap_conductance = 1e7;
    let outcome = simulate(&scene, watch)?;
    Ok(vec![
        generated("heat in over the heat generated, h_g = 1e7 W/(m2 K)", &scene, &outcome, 0.01),
        row("heat missing, h_g = 1e7 W/(m2 K)", &outcome, heat_missing, 1e-6),
    ])
}

/// Frictional and plastic heat, of which a like counterface takes up a part. It expands, and its surface does work.
fn into_the_counterface(watch: &dyn Watch) -> Rows {
    let mut scene = steel(20.0);
    scene.counterface = conducting(&scene, 1.0);
    scene.counterface.thermal_expansion = Some(scene.material.thermal_expansion.value);
    let outcome = simulate(&scene, watch)?;
    Ok(vec![
        generated("heat into asperity and counterface over the heat generated", &scene, &outcome, 0.005),
        row("heat missing, conducting counterface", &outcome, heat_missing, 1e-6),
        energy("energy missing, counterface that conducts and expands", &outcome),
    ])
}
