//! Programmes of slip rates, holds and reversals.
//!
//! Hold: the heat of a disc source that is switched off is that of two sources, T(t) − T(t − t₁) (H. S. Carslaw & J. C.
//! Jaeger, *Conduction of Heat in Solids* (1959), §10.5). Reversal in partial slip under Coulomb friction: R. D. Mindlin &
//! H. Deresiewicz, J. Appl. Mech. 20, 327 (1953), doi 10.1115/1.4010702. Rate step: factor 1 + C ln(ε̇/ε̇₀) of the strength
//! at the strain rate V/a. Relaxation in a hold: a slider with a velocity-strengthening interface on a
//! spring (H. Perfettini & J.-P. Avouac, J. Geophys. Res. 109, B02304 (2004), doi 10.1029/2003JB002488), the spring a half-space
//! under a uniform shear traction (V. Cerruti; K. L. Johnson, *Contact Mechanics* (1985), §3.6).

use std::f64::consts::PI;

use tables::closed_forms::partial_slip::mindlin;
use tables::quantity::{Quantity, State};

use super::heat_source::{RANGE, START, source};
use super::partial_slip::{FRICTION, ON_8, scene_of};
use super::setup::{last, mesh, pressed, scene, steel_4340};
use super::strain_rate::{self, at_slip_rate, weak_interface};
use super::{Case, Cost, Reference, Row, Rows, Tolerance};
use crate::scene::{FrictionLaw, LoadingStep, Scene, Switch};
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, simulate};

pub const CASES: [Case; 5] = [
    Case::new("hold after a disc source", Cost::Quick, hold),
    Case::new("reversal in partial slip", Cost::Quick, reversal),
    Case::new("rate step and reversal without heat", Cost::Quick, rate_step),
    Case::new("relaxation in a hold", Cost::Quick, relaxation),
    Case::new("reversal of an elastic-plastic contact", Cost::Quick, plastic_reversal),
];

fn run(mut scene: Scene, steps: Vec<LoadingStep>, watch: &dyn Watch) -> Result<Outcome, SimulationError> {
    scene.loading = scene.loading.with_steps(steps);
    simulate(&scene, watch)
}

fn slip(slip_rate: f64, slip_distance: f64) -> LoadingStep {
    LoadingStep::Slip { slip_rate, slip_distance }
}

/// The last state of each step.
fn ends(outcome: &Outcome) -> Vec<State<'_>> {
    let steps = outcome.slide.column(Quantity::ProgrammeStep);
    let is_end = |n: &usize| *n + 1 == steps.len() || steps[*n] < steps[n + 1];
    (0..steps.len()).filter(is_end).map(|n| outcome.slide.state(n)).collect()
}

/// A disc source as in the group "heat source", until Fo = 1, then at rest.
fn hold(watch: &dyn Watch) -> Rows {
    const DISC: &str = "superposition of disc sources, Carslaw & Jaeger 1959, sec. 10.5";
    /// Fo of the hold, mean rise over qa/k, and that of the centre.
    const RISES: [(f64, f64, f64); 3] =
        [(0.1, 0.304177, 0.387894), (0.25, 0.201357, 0.241837), (1.0, 0.069548, 0.075486)];
    let (scene, [.., time]) = source(1.0, 1.0, 8);
    let mut steps = vec![slip(scene.loading.slip_rate, scene.loading.slip_distance)];
    let mut held = 0.0;
    for (fourier, ..) in RISES {
        steps.push(LoadingStep::Hold { hold: (fourier - held) * time });
        held = fourier;
    }
    let outcome = run(scene, steps, watch)?;
    let mut rows = Vec::new();
    for ((fourier, mean, centre), state) in RISES.into_iter().zip(ends(&outcome).into_iter().skip(1)) {
        for (name, quantity, reference) in
            [("mean", Quantity::TemperatureMean, mean), ("largest", Quantity::TemperatureMax, centre)]
        {
            let rise = (state[quantity] - START) / RANGE;
            let name = format!("{name} rise over qa/k after Fo = 1 and a hold of Fo = {fourier}");
            let tolerance =
                Tolerance::relative(0.044, "mesh, 0.5 n_c^-1.5, of the source and of the Fourier number");
            rows.push(Row::new(name, rise, Reference::exact(reference, DISC), tolerance));
        }
    }
    Ok(rows)
}

/// Loaded to 0.6 of gross slip, back by 1.2 of it, and forth again: Q = Q₁ − 2F((u₁ − u)/2) with F that of loading.
fn reversal(watch: &dyn Watch) -> Rows {
    const MINDLIN: &str = "Mindlin & Deresiewicz 1953, doi 10.1115/1.4010702";
    const TURN: f64 = 0.6;
    let (mut scene, hertz) = scene_of(FrictionLaw::Coulomb { friction: FRICTION, cap: false }, 8);
    scene.model.heat = Switch::Off;
    let (g, a) = (hertz.tangential_modulus, hertz.contact_radius);
    let gross = |load: f64| mindlin::gross_slip_displacement(FRICTION, load, g, a);
    let unit = gross(hertz.load) / a;
    let steps = [0.3, 0.3, 0.3, 0.3].map(|share| slip(-1.0, share * unit));
    let steps = [vec![slip(1.0, TURN * unit)], steps.into()].concat();
    let outcome = run(scene, steps, watch)?;
    // The computed P sets the scale.
    let load = pressed(&outcome)[Quantity::Load];
    let force = mindlin::force_fraction;
    let mut rows = Vec::new();
    for state in ends(&outcome) {
        let x = state[Quantity::Slip] / gross(load);
        let expected = force(TURN) - 2.0 * force(0.5 * (TURN - x));
        let q = state[Quantity::Friction] / (FRICTION * load);
        let name = format!("Q over mu P at u/u_s = {:.1}, unloaded from {TURN}", 0.3 * (x / 0.3).round());
        let tolerance = Tolerance::absolute(ON_8.force, "mesh, 0.5 n_c^-1.5; direction of slip, 0.2 %");
        rows.push(Row::new(name, q, Reference::exact(expected, MINDLIN), tolerance));
    }
    let closed = last(&outcome)[Quantity::Friction] / ends(&outcome)[0][Quantity::Friction];
    let tolerance = Tolerance::relative(2.0 * ON_8.force, "that of Q, twice");
    rows.push(Row::new("Q at -u_1 over that at u_1", closed, Reference::exact(-1.0, MINDLIN), tolerance));
    Ok(rows)
}

/// Q/A is the strength at V/a whatever the steps before.
fn rate_step(watch: &dyn Watch) -> Rows {
    const LAW: &str = "1 + C ln(V/(a deps_0)), Johnson & Cook 1983";
    let scene = weak_interface(6);
    let rates = [0.01, 1.0, 0.01, -0.1];
    let outcome = run(scene.clone(), rates.map(|rate| slip(rate, 0.05)).into(), watch)?;
    let mut rows = Vec::new();
    for (n, (rate, end)) in rates.into_iter().zip(ends(&outcome)).enumerate() {
        let name = format!("Q/A over f tau_0 at {rate} m/s, step {}", n + 1);
        rows.push(at_slip_rate(name, &scene, rate, end, LAW));
    }
    Ok(rows)
}

/// An interface with the rate law after the flat has stopped: Q falls with the logarithm of time as the contact slips on. The
/// strength is computed at the rate of the reference; that the contact slips at that rate is seen in the heat.
fn relaxation(watch: &dyn Watch) -> Rows {
    const SLIDER: &str = "slider on a spring, Perfettini & Avouac 2004, 10.1029/2003JB002488";
    const RATE: f64 = 1.0;
    const HOLDS: [f64; 3] = [1e-9, 1e-7, 1e-5];
    let scene = weak_interface(8);
    let shear_modulus = scene.material.youngs_modulus.value / (2.0 * (1.0 + scene.material.poisson_ratio));
    let poisson_ratio = scene.material.poisson_ratio;
    let hold =
        |(n, time): (usize, f64)| LoadingStep::Hold { hold: if n == 0 { time } else { time - HOLDS[n - 1] } };
    let holds = HOLDS.into_iter().enumerate().map(hold);
    let outcome = run(scene, [slip(RATE, 0.05)].into_iter().chain(holds).collect(), watch)?;
    let [start, held @ ..] = &ends(&outcome)[..] else { unreachable!("a slip and three holds") };
    let force = start[Quantity::Friction];
    let radius = (start[Quantity::Area] / PI).sqrt();
    let displacement = 4.0 * (2.0 - poisson_ratio) * force / (3.0 * PI * PI * shear_modulus * radius);
    let rate = RATE / radius / strain_rate::REFERENCE;
    let sensitivity = strain_rate::sensitivity(rate);
    // Down to the strength at the reference strain rate.
    let most = 1.0 - 1.0 / strain_rate::strength(rate);
    let mut rows = Vec::new();
    for (time, state) in HOLDS.into_iter().zip(held) {
        let fall = most.min(sensitivity * (RATE * time / (sensitivity * displacement)).ln_1p());
        let dissipated = state[Quantity::DissipationFriction] - start[Quantity::DissipationFriction];
        rows.push(Row::new(
            format!("fall of Q over Q {time:e} s after the flat has stopped"),
            1.0 - state[Quantity::Friction] / force,
            Reference::exact(fall, SLIDER),
            Tolerance::relative(0.01, "change of the area"),
        ));
        rows.push(Row::new(
            format!("heat of friction over Q u until then, u = 4(2 - nu)Q/(3 pi^2 Ga), {time:e} s"),
            dissipated / (force * displacement),
            Reference::exact(fall * (1.0 - 0.5 * fall), SLIDER),
            Tolerance::relative(0.025, "mesh of 8 elements, and a half-space for the sphere"),
        ));
    }
    Ok(rows)
}

/// Without heat and rate law, a step of the rate changes nothing, and a reversal changes the sign of the shear stress.
fn plastic_reversal(watch: &dyn Watch) -> Rows {
    const CONSEQUENCE: &str = "rate-independent equations";
    let mut scene = scene(steel_4340(), FrictionLaw::ShearStrength, 20.0, mesh(6, 4));
    scene.model.heat = Switch::Off;
    scene.interface.strength_factor = 0.9;
    let stress = |state: &State<'_>| state[Quantity::Friction] / state[Quantity::Area];
    let single = run(scene.clone(), vec![slip(1.0, 0.4)], watch)?;
    let stepped = run(scene, vec![slip(0.01, 0.2), slip(1.0, 0.2), slip(-1.0, 0.4)], watch)?;
    let (single, ends) = (last(&single), ends(&stepped));
    let exact = |value: f64| Reference::exact(value, CONSEQUENCE);
    let steps = Tolerance::relative(2e-3, "increments");
    Ok(vec![
        Row::new(
            "mu after a rate step over that without",
            ends[1][Quantity::Mu] / single[Quantity::Mu],
            exact(1.0),
            steps,
        ),
        Row::new(
            "Q/A after a reversal over that before",
            stress(&ends[2]) / stress(&ends[1]),
            exact(-1.0),
            steps,
        ),
    ])
}
