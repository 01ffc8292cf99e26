//! What follows from the equations alone: independence of rate and size, conservation.

use super::setup::{Hertz, mesh, scene, steel_4340};
use super::{Extent, Row, Rows};
use crate::scene::{FrictionLaw, Scene};
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, press, simulate, slide};
use tables::quantity::{Quantity, State};

pub fn rows(extent: Extent, watch: &dyn Watch) -> Rows {
    let mut rows = rate(extent, watch)?;
    rows.extend(scale(watch)?);
    rows.extend(ledgers(watch)?);
    Ok(rows)
}

fn steel(interference: f64, elements: usize) -> Scene {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, interference, mesh(elements, 4));
    scene.interface.heat_partition = 0.5;
    scene.interface.taylor_quinney = 0.9;
    scene
}

/// At sliding inception the flat has moved by δ_s = τ₀a/(2G*) only: the rise is at most
/// 2τ₀V√(κδ_s/(πV))/k (Carslaw & Jaeger 1959, §2.9), and static friction lower by what that takes
/// off the strength.
fn rate(extent: Extent, watch: &dyn Watch) -> Rows {
    const SOURCE: &str = "the rise at inception is small, Carslaw & Jaeger 1959, sec. 2.9";
    const WHY: &str = "loss of strength at the largest rise possible at inception";
    let elements = extent.elements() / 2;
    let mut scene = steel(20.0, elements);
    scene.loading.slip_distance = 0.2;
    let pressed = press(&scene, watch)?;
    let [slow, fast] = [0.1, 10.0].map(|rate| slide(&pressed, rate, watch));
    let (slow, fast) = (slow?.scalars, fast?.scalars);
    let material = &scene.material;
    let strength = material.yield_strength / 3f64.sqrt();
    let k = material.thermal_conductivity;
    let diffusivity = k / (material.density * material.specific_heat);
    let slip = strength * slow[Quantity::ContactRadius].value / (2.0 * Hertz::of(&scene).tangential_modulus);
    let rise = 2.0 * scene.interface.heat_partition * strength * 10.0 / k
        * (diffusivity * slip / (std::f64::consts::PI * 10.0)).sqrt();
    let crate::scene::Softening::JohnsonCook { reference, melting, exponent } = material.softening else {
        unreachable!("the preset has this law")
    };
    let loss = (rise / (melting - reference)).powf(exponent);
    // Discretised alike: errors are common to both, but for the iteration of inception.
    let error = 0.25 * (slow[Quantity::MuStatic].error + fast[Quantity::MuStatic].error);
    let value = fast[Quantity::MuStatic].value;
    let row = Row::new(
        "mu_static of 4340 steel at 10 m/s, against 0.1 m/s",
        value,
        error,
        slow[Quantity::MuStatic].value,
        SOURCE,
    );
    Ok(vec![row.allow(loss, WHY)])
}

/// Quasi-static, rate-independent plasticity with conduction has no length of its own.
fn scale(watch: &dyn Watch) -> Rows {
    const SOURCE: &str = "dimensional analysis: the same at equal VR/kappa";
    const WHY: &str = "rounding differs with the unit, and with it the last iterate";
    let at = |radius: f64| -> Result<Outcome, SimulationError> {
        let mut scene = steel(5.0, 4);
        scene.radius = radius;
        scene.interface.gap_conductance = 10.0 / radius;
        scene.loading.slip_rate = 5e-3 / radius;
        scene.loading.slip_distance = 0.3;
        simulate(&scene, watch)
    };
    let (small, large) = (at(10e-9)?, at(1e-3)?);
    let scale: f64 = 1e-3 / 10e-9;
    let row = |name: &str, unit, of: fn(&Outcome) -> f64, power: i32| {
        let quantity = format!("{name} at R = 10 nm, scaled to 1 mm");
        Row::new(quantity, of(&small) * scale.powi(power), 0.0, of(&large), SOURCE)
            .unit(unit)
            .allow(1e-6, WHY)
    };
    Ok(vec![
        row("mu", "1", |run| run.scalars[Quantity::Mu].value, 0),
        row("mu_static", "1", |run| run.scalars[Quantity::MuStatic].value, 0),
        row("P", "N", |run| run.scalars[Quantity::Load].value, 2),
        row("G", "J m-2", |run| run.scalars[Quantity::EnergyRelease].value, 1),
        row("T_max", "K", |run| run.scalars[Quantity::TemperatureMax].value, 0),
    ])
}

fn ledgers(watch: &dyn Watch) -> Rows {
    const SOURCE: &str = "first law of thermodynamics";
    const WHY: &str = "tolerance of the solver";
    let mut scene = steel(20.0, 6);
    scene.loading.slip_rate = 3.0;
    scene.loading.slip_distance = 0.5;
    let outcome = simulate(&scene, watch)?;
    let worst = |of: fn(State<'_>) -> f64| outcome.slide.states().skip(1).map(of).fold(0.0, f64::max);
    let row = |name: &str, of| Row::new(name, worst(of), 0.0, 0.0, SOURCE).allow_absolute(1e-6, WHY);
    Ok(vec![
        row("energy missing at any step, over its largest term", energy_off),
        row("heat missing at any step, over its largest term", heat_off),
    ])
}

/// |balance| over the largest of `terms`.
fn off(balance: f64, terms: &[f64]) -> f64 {
    balance.abs() / terms.iter().fold(0.0, |most: f64, term| most.max(term.abs()))
}

fn energy_off(step: State<'_>) -> f64 {
    let s = step;
    let mut terms =
        vec![s[Quantity::EnergyElastic], s[Quantity::DissipationPlastic], s[Quantity::DissipationFriction]];
    terms.extend([s[Quantity::WorkThermalExpansion], s[Quantity::EnergyModuliSoftening]]);
    let balance = s[Quantity::Work] - terms.iter().sum::<f64>();
    terms.push(s[Quantity::Work]);
    off(balance, &terms)
}

fn heat_off(step: State<'_>) -> f64 {
    let terms = [step[Quantity::HeatIn], step[Quantity::HeatStored], step[Quantity::HeatOut]];
    off(terms[0] - terms[1] - terms[2], &terms)
}
