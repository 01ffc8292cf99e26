//! Interface laws in gross slip, and sliding at constant load.
//!
//! Film: τ_c = τ_0 + αp, B. J. Briscoe & D. Tabor, Wear 34, 29 (1975), doi 10.1016/0043-1648(75)90306-3, so that
//! Q = τ_0 A + αP whatever the pressures are. Current strength: τ_c = f_τ σ_y(ε_p)/√3. Load control: equilibrium; X. Shi,
//! A. Wu, C. Zhu & S. Qu, Tribol. Int. (2013): static friction is lower under displacement than under force control.

use tables::quantity::Quantity;

use super::setup::{largest, last, mesh, plain_material, pressed, scene, steel_4340};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::scene::{Control, FrictionLaw, Hardening, InterfaceStrength, Softening};
use crate::simulate::outcome::Outcome;
use crate::simulate::{Watch, simulate};

const BRISCOE: &str = "Briscoe & Tabor 1975, doi 10.1016/0043-1648(75)90306-3";
const STRENGTH: &str = "tau_c = f_tau sigma_y(eps_p)/sqrt(3)";
const EQUILIBRIUM: &str = "equilibrium at constant load";
const SOLVER: &str = "tolerance of the solver";

pub const CASES: [Case; 4] = [
    Case::new("film", Cost::Quick, film),
    Case::new("interface that hardens with the body", Cost::Medium, current_strength),
    Case::new("constant load", Cost::Medium, constant_load),
    Case::new("constant load without friction", Cost::Quick, frictionless_load),
];

fn film(watch: &dyn Watch) -> Rows {
    const FILM_STRENGTH: f64 = 5e6;
    const METAL_STRENGTH: f64 = 40e6 / 1.732_050_807_568_877_2;
    let slide = |pressure_coefficient: f64, film_softening: Softening| {
        let law = FrictionLaw::BriscoeTabor {
            film_strength: FILM_STRENGTH,
            pressure_coefficient,
            film_softening,
            cap: true,
        };
        let mut scene = scene(plain_material(0.3), law, 5.0, mesh(8, 8));
        scene.loading.slip_distance = 0.02;
        simulate(&scene, watch)
    };
    // 60 % of the strength is left at the initial temperature, 298 K.
    let warm = Softening::Table { temperature: vec![248.0, 373.0], factor: vec![1.0, 0.0] };
    let mut rows = Vec::new();
    for (coefficient, softening) in [(0.0, Softening::None), (0.05, Softening::None), (0.05, warm)] {
        let factor = softening.factor(298.0);
        let outcome = slide(coefficient, softening)?;
        let end = last(&outcome);
        let expected = factor * (FILM_STRENGTH * end[Quantity::Area] + coefficient * end[Quantity::Load]);
        let tolerance = Tolerance::relative(1e-6, SOLVER);
        let name = format!("Q of a film, alpha = {coefficient}, factor(T) = {factor}");
        rows.push(
            Row::new(name, end[Quantity::Friction], Reference::exact(expected, BRISCOE), tolerance).unit("N"),
        );
    }
    // At the mean pressure of about 100 MPa the film is stronger than the metal.
    let outcome = slide(0.5, Softening::None)?;
    let end = last(&outcome);
    let excess = (end[Quantity::Friction] / end[Quantity::Area] / METAL_STRENGTH - 1.0).max(0.0);
    rows.push(Row::new(
        "excess of Q/A over the shear strength of the metal under a strong film",
        excess,
        Reference::exact(0.0, STRENGTH),
        Tolerance::absolute(1e-6, SOLVER),
    ));
    Ok(rows)
}

/// Steel with linear hardening at 20 ω_c, f_τ = 0.8, isothermal.
fn current_strength(watch: &dyn Watch) -> Rows {
    const FACTOR: f64 = 0.8;
    const YIELD: f64 = 40e6;
    const MODULUS: f64 = 2e9;
    let slide = |hardening: Hardening, strength: InterfaceStrength| {
        let mut scene = scene(plain_material(0.3), FrictionLaw::ShearStrength, 20.0, mesh(8, 8));
        scene.material.hardening = hardening;
        scene.interface.strength = strength;
        scene.interface.strength_factor = FACTOR;
        scene.loading.slip_distance = 0.3;
        simulate(&scene, watch)
    };
    let virgin = FACTOR * YIELD / 3f64.sqrt();
    let hardens = Hardening::Linear { modulus: MODULUS };
    let perfect = slide(Hardening::None, InterfaceStrength::Initial)?;
    let perfect_current = slide(Hardening::None, InterfaceStrength::Current)?;
    let initial = slide(hardens.clone(), InterfaceStrength::Initial)?;
    let current = slide(hardens, InterfaceStrength::Current)?;
    let stress =
        |outcome: &Outcome| last(outcome)[Quantity::Friction] / last(outcome)[Quantity::Area] / virgin;
    let row = |name: &str, computed: f64, reference: f64, tolerance| {
        Row::new(name, computed, Reference::exact(reference, STRENGTH), tolerance)
    };
    let law = Tolerance::relative(1e-6, SOLVER);
    // No slipping point bears more than the largest hardened strength, and none less than the virgin one.
    let most = 1.0 + MODULUS * last(&current)[Quantity::PlasticStrainMax] / YIELD;
    let shear = current.snapshots.last().map_or(&[][..], |fields| &fields.shear);
    let strongest = shear.iter().fold(0.0f64, |most, &x| most.max(x)) / virgin;
    let middle = 0.5 * (1.0 + most);
    Ok(vec![
        row("Q/A over f tau_0 without hardening", stress(&perfect), 1.0, law),
        row(
            "Q at current over Q at initial strength without hardening",
            last(&perfect_current)[Quantity::Friction] / last(&perfect)[Quantity::Friction],
            1.0,
            Tolerance::relative(0.0, "the same law"),
        ),
        row("Q/A over f tau_0 at initial strength", stress(&initial), 1.0, law),
        row(
            "P of the press at current over that at initial strength",
            pressed(&current)[Quantity::Load] / pressed(&initial)[Quantity::Load],
            1.0,
            Tolerance::relative(0.0, "nothing slips in the press"),
        ),
        row(
            "Q/A over f tau_0 at current strength",
            stress(&current),
            middle,
            Tolerance::absolute(middle - 1.0, "between virgin and largest hardened strength"),
        ),
        row(
            "largest shear stress over the largest hardened strength",
            strongest / most,
            1.0,
            Tolerance::absolute(0.05, "integration points and nodes do not coincide"),
        ),
    ])
}

/// 4340 steel at 20 ω_c, isothermal: at constant interference the contact loses load while it slides, at constant load
/// the flat sinks.
fn constant_load(watch: &dyn Watch) -> Rows {
    const SHI: &str = "Shi, Wu, Zhu & Qu 2013: lower under displacement control";
    let slide = |control: Control| {
        let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 20.0, mesh(8, 4));
        scene.loading.slip_distance = 0.1;
        scene.loading.control = control;
        simulate(&scene, watch)
    };
    let (fixed, held) = (slide(Control::Interference)?, slide(Control::Load)?);
    let load = pressed(&held)[Quantity::Load];
    let peak = |outcome: &Outcome| largest(outcome, |step| step[Quantity::Friction]);
    let interferences = held.slide.column(Quantity::Interference);
    let rises = interferences.windows(2).map(|pair| 1.0 - pair[1] / pair[0]);
    let zero = |name: &str, computed: f64, source, tolerance| {
        Row::new(name, computed, Reference::exact(0.0, source), tolerance)
    };
    Ok(vec![
        zero(
            "largest change of P at constant load",
            largest(&held, |step| (step[Quantity::Load] / load - 1.0).abs()),
            EQUILIBRIUM,
            Tolerance::absolute(1e-5, SOLVER),
        ),
        zero(
            "preload at constant load against constant interference",
            load / pressed(&fixed)[Quantity::Load] - 1.0,
            EQUILIBRIUM,
            Tolerance::absolute(1e-12, "the same press"),
        ),
        zero(
            "largest relative rise of the flat at constant load",
            rises.fold(0.0, f64::max),
            "plastic contacts sink as they slide",
            Tolerance::absolute(1e-6, SOLVER),
        ),
        zero(
            "excess of the largest Q at constant interference over that at constant load",
            (peak(&fixed) / peak(&held) - 1.0).max(0.0),
            SHI,
            Tolerance::absolute(0.0, "an inequality"),
        ),
        super::ledgers::energy("energy missing at constant load", &held),
    ])
}

fn frictionless_load(watch: &dyn Watch) -> Rows {
    let mut scene = scene(plain_material(0.3), FrictionLaw::Frictionless, 0.3, mesh(6, 4));
    scene.loading.control = Control::Load;
    scene.loading.slip_distance = 0.05;
    let outcome = simulate(&scene, watch)?;
    Ok(vec![Row::new(
        "largest relative change of interference at constant load without friction",
        largest(&outcome, |step| (step[Quantity::Interference] / 0.3 - 1.0).abs()),
        Reference::exact(0.0, EQUILIBRIUM),
        Tolerance::absolute(1e-5, SOLVER),
    )])
}
