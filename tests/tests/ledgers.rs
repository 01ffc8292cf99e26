//! Energy and heat ledgers of a hot, plastic slide.
//!
//! Problem: 4340 steel, R = 1 mm, ω₀ = 20 ω_c, V = 3 m/s, half of the frictional heat and 0.9 of
//! the plastic work heating the asperity, thermal expansion included.
//! Source: first law of thermodynamics; for the mechanics
//! work of the flat = elastic energy + plastic + frictional dissipation + work on thermal expansion and
//! the elastic energy given up by moduli that fall with temperature,
//! for the heat  heat in = heat stored + heat out.

use asperity::scene::FrictionLaw;
use asperity::scene::file::parse_scene;
use asperity::simulate::outcome::Outcome;
use tables::quantity::{Quantity, State};
use tests::{assert_close, last, mesh, run, scene, steel_4340};

fn slide(gap_conductance: f64) -> Outcome {
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 20.0, mesh(6, 8));
    scene.interface.heat_partition = 0.5;
    scene.interface.taylor_quinney = 0.9;
    scene.interface.gap_conductance = gap_conductance;
    scene.loading.slip_rate = 3.0;
    scene.loading.slip_distance = 0.5;
    let outcome = run(&scene);
    let end = last(&outcome);
    assert!(end[Quantity::PlasticStrainMax] > 0.01 && end[Quantity::TemperatureMax] > 330.0, "{end:?}");
    outcome
}

/// |balance| over the largest of `terms`.
fn off(balance: f64, terms: &[f64]) -> f64 {
    balance.abs() / terms.iter().fold(0.0, |most: f64, term| most.max(term.abs()))
}

fn energy_off(step: State<'_>) -> f64 {
    let s = step;
    let spent = [
        s[Quantity::EnergyElastic],
        s[Quantity::DissipationPlastic],
        s[Quantity::DissipationFriction],
        s[Quantity::WorkThermalExpansion],
        s[Quantity::EnergyModuliSoftening],
    ];
    let balance = s[Quantity::Work] - spent.iter().sum::<f64>();
    off(balance, &[s[Quantity::Work], spent[0], spent[1], spent[2], spent[3], spent[4]])
}

fn heat_off(step: State<'_>) -> f64 {
    let s = step;
    off(
        s[Quantity::HeatIn] - s[Quantity::HeatStored] - s[Quantity::HeatOut],
        &[s[Quantity::HeatIn], s[Quantity::HeatStored], s[Quantity::HeatOut]],
    )
}

/// To 1e-6 of the largest term of each step: the tolerance of the solver.
#[test]
fn energy_and_heat_are_accounted_for_at_every_step() {
    let outcome = slide(0.0);
    let steps = outcome.slide.states().skip(1);
    let worst = |off: fn(State<'_>) -> f64| steps.clone().map(off).fold(0.0, f64::max);
    let (energy, heat) = (worst(energy_off), worst(heat_off));
    println!("energy {energy:.1e}, heat {heat:.1e}");
    assert!(heat <= 1e-6, "heat is off by {heat:.1e}");
    assert!(energy <= 1e-6, "energy is off by {energy:.1e}");
}

/// Carbon steel of EN 1993-1-2: modulus, expansion, conductivity and specific heat over temperature,
/// fast enough for the surface to lose half of its strength and modulus and a third of its conductivity.
#[test]
fn ledgers_close_with_properties_that_depend_on_temperature() {
    let text = "[material]\npreset = \"carbon-steel-en1993\"\n[asperity]\nradius = 1e-3\n\
                [loading]\ninterference = 1\nslip_rate = 1\n";
    let steel = parse_scene(text, "carbon steel", &[]).unwrap().material;
    let mut scene = scene(steel, FrictionLaw::ShearStrength, 20.0, mesh(6, 8));
    scene.interface.strength_factor = 0.9;
    scene.interface.taylor_quinney = 0.9;
    scene.loading.slip_rate = 300.0;
    scene.loading.slip_distance = 1.0;
    let outcome = run(&scene);
    let end = last(&outcome);
    assert!(end[Quantity::TemperatureMax] > 850.0 && end[Quantity::EnergyModuliSoftening] > 0.0, "{end:?}");
    let steps = outcome.slide.states().skip(1);
    let worst = |off: fn(State<'_>) -> f64| steps.clone().map(off).fold(0.0, f64::max);
    let (energy, heat) = (worst(energy_off), worst(heat_off));
    println!("energy {energy:.1e}, heat {heat:.1e}");
    assert!(heat <= 1e-10, "heat is off by {heat:.1e}");
    assert!(energy <= 1e-6, "energy is off by {energy:.1e}");
}

/// Heat in = f_h of the frictional and β of the plastic dissipation. The dissipation is summed
/// with the mean traction of each step, the heat with that at its end: up to 0.25 % on this slide.
#[test]
fn heat_comes_from_dissipation() {
    let outcome = slide(0.0);
    let end = last(&outcome);
    let generated = 0.5 * end[Quantity::DissipationFriction] + 0.9 * end[Quantity::DissipationPlastic];
    assert_close("heat in", end[Quantity::HeatIn], generated, 0.005);
}

/// A conducting gap takes heat out; it does not make less of it. The tolerance is that above, and
/// for steps of temperature that the conductance makes larger.
#[test]
fn heat_through_the_gap_is_heat_out() {
    let outcome = slide(1e7);
    let end = last(&outcome);
    let generated = 0.5 * end[Quantity::DissipationFriction] + 0.9 * end[Quantity::DissipationPlastic];
    assert!(
        end[Quantity::HeatOut] > 0.1 * generated,
        "heat out {:e} of {generated:e} J",
        end[Quantity::HeatOut]
    );
    assert_close("heat in", end[Quantity::HeatIn], generated, 0.01);
}
