//! One contact of 4340 steel through steps of the slip rate, a hold and a reversal (examples/scenes/rate-steps.toml), with
//! and without the rate law of the strength.
//!
//! Prints for each step the mean shear stress τ̄ = Q/A before it, in its first state in which all of the contact slips, and
//! at its end; the slip after which half of the change between the last two is done; and the temperature at the end. Draws
//! friction, stress and temperature. Five seconds of processor time.
//!
//!     cargo run --release -p examples --example rate_steps [FIGURE.svg]

use std::path::Path;

use asperity::scene::file::read_scene;
use asperity::scene::{LoadingStep, Scene};
use asperity::simulate::outcome::Outcome;
use asperity::{Unwatched, simulate};
use examples::scene;
use tables::figures::{Axis, Curve, Figure, Panel};
use tables::quantity::{Quantity, State};

/// Label and overrides.
const CASES: [(&str, &[&str]); 2] = [
    ("no rate law", &["material.rate={law=\"none\"}"]),
    ("C = 0.014", &["material.rate={law=\"johnson-cook\"}"]),
];

fn main() -> anyhow::Result<()> {
    let mut runs = Vec::new();
    for (name, changes) in CASES {
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let scene = read_scene(&scene("rate-steps.toml"), &changes)?;
        let run = simulate(&scene, &Unwatched)?;
        println!(
            "{name}\nstep                       before   all slips      end  half slip     T mean   (MPa, contact radii, K)"
        );
        for (n, step) in scene.loading.steps.iter().enumerate() {
            println!("{}", line(step, &within(&run, n), run.scalars[Quantity::ContactRadius].value));
        }
        runs.push((name, scene, run));
    }
    if let Some(path) = std::env::args().nth(1) {
        figure(&runs).save(Path::new(&path))?;
        println!("written to {path}");
    }
    Ok(())
}

/// The states of a step of the programme, from the end of the one before.
fn within(run: &Outcome, step: usize) -> Vec<State<'_>> {
    let number = (step + 1) as f64;
    let steps = run.slide.column(Quantity::ProgrammeStep);
    let start = steps.iter().rposition(|n| *n < number).unwrap_or(0);
    (start..steps.len()).take_while(|n| steps[*n] <= number).map(|n| run.slide.state(n)).collect()
}

/// Q/A, MPa.
fn stress(state: &State<'_>) -> f64 {
    1e-6 * state[Quantity::Friction] / state[Quantity::Area]
}

fn line(step: &LoadingStep, states: &[State<'_>], radius: f64) -> String {
    let (first, last) = (states[0], states[states.len() - 1]);
    let slip = |state: &State<'_>| (state[Quantity::Slip] - first[Quantity::Slip]).abs() / radius;
    // The first state in which the contact slips everywhere; as the slip rate falls, the weakest one from there on.
    let slips = |state: &&State<'_>| state[Quantity::StickFraction] < 0.01;
    let slipping = states[1..].iter().skip_while(|state| !slips(state));
    let rate = |state: &State<'_>| state[Quantity::SlipRate].abs();
    let weaker = |one: &&State<'_>, other: &&State<'_>| stress(one).abs().total_cmp(&stress(other).abs());
    let direct = match rate(&last) < rate(&first) {
        true => slipping.min_by(weaker),
        false => slipping.into_iter().next(),
    };
    let direct = direct.unwrap_or(&last);
    let end = stress(&last);
    let half = 0.5 * (stress(direct) + end);
    let later: Vec<_> = states.iter().skip_while(|state| slip(state) < slip(direct)).collect();
    let passed = later.windows(2).find(|pair| (stress(pair[1]) - half) * (end - half) >= 0.0);
    let between = |pair: &[&State<'_>]| {
        let [a, b] = [pair[0], pair[1]];
        slip(a) + (half - stress(a)) / (stress(b) - stress(a)) * (slip(b) - slip(a))
    };
    format!(
        "{:<24} {:>8.1} {:>12.1} {end:>8.1} {:>10.4} {:>10.1}",
        step.to_string(),
        stress(&first),
        stress(direct),
        passed.map_or(0.0, between),
        last[Quantity::TemperatureMean]
    )
}

fn figure(runs: &[(&str, Scene, Outcome)]) -> Figure {
    let radius = |run: &Outcome| run.scalars[Quantity::ContactRadius].value;
    let over_path = |run: &Outcome, value: &dyn Fn(&State<'_>) -> f64| -> (Vec<f64>, Vec<f64>) {
        let mut path = 0.0;
        let mut before = 0.0;
        let point = |state: State<'_>| {
            path += (state[Quantity::Slip] - before).abs() / radius(run);
            before = state[Quantity::Slip];
            (path, value(&state))
        };
        run.slide.states().map(point).unzip()
    };
    let panel = |title: &str, y: &str, value: &dyn Fn(&State<'_>) -> f64| {
        let curve = |(name, _, run): &(&str, Scene, Outcome)| {
            let (x, y) = over_path(run, value);
            Curve::new(*name, x, y)
        };
        let curves = runs.iter().map(curve).collect();
        Panel::new("", title, Axis::linear("Accumulated slip over a_{0}"), Axis::linear(y), curves)
    };
    let part = |title: &str, step: usize, hold: bool| {
        let curve = |(name, _, run): &(&str, Scene, Outcome)| {
            let states = within(run, step);
            let (slip, time) = (states[0][Quantity::Slip], states[0][Quantity::Time]);
            let x = |state: &State<'_>| match hold {
                true => state[Quantity::Time] - time,
                false => (state[Quantity::Slip] - slip).abs() / radius(run),
            };
            let y = |state: &State<'_>| if hold { state[Quantity::TemperatureMean] } else { stress(state) };
            let (x, y) = states[1..].iter().map(|state| (x(state), y(state))).unzip();
            Curve::new(*name, x, y)
        };
        let (x, y) = match hold {
            true => ("Time of the hold (s)", "Mean temperature (K)"),
            false => ("Slip of the step over a_{0}", "Shear stress Q/A (MPa)"),
        };
        Panel::new("", title, Axis::logarithmic(x), Axis::linear(y), runs.iter().map(curve).collect())
    };
    let panels = vec![
        panel("Friction", "Friction coefficient μ = Q/P", &|state| state[Quantity::Mu]),
        panel("Temperature", "Mean temperature (K)", &|state| state[Quantity::TemperatureMean]),
        part("Rate step, 0.01 to 1 m/s", 1, false),
        part("Rate step, 1 to 0.01 m/s", 2, false),
        part("Hold after 1 m/s", 4, true),
        part("Restart at 1 m/s", 5, false),
    ];
    Figure::new("4340 steel at 20 ω_{c} through steps of the slip rate", panels)
}
