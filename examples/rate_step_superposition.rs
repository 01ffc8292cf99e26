//! A contact after a step of the slip rate: superposition of the slides of a table against a run through the step.
//!
//! For each case friction Q and load P after the slip x since the step, over those at the step, of the run and of
//! `roughsurface::integral::rate_step`, and at the end the largest difference over the change that the step makes. One
//! minute of processor time.
//!
//!     cargo run --release -p examples --example rate_step_superposition

use asperity::scene::file::parse_scene;
use asperity::simulate::outcome::Outcome;
use asperity::{Unwatched, simulate};
use roughsurface::integral::rate_step::RateStep;
use tables::quantity::Quantity;
use tables::shipped;

/// Radius, m.
const RADIUS: f64 = 1e-3;

/// Metal, ω₀/ω_c, slip rates before and after (m/s), slip before over a₀.
const CASES: [(&str, f64, [f64; 2], f64); 7] = [
    ("steel-4340", 8.0, [0.5, 4.0], 1.0),
    ("steel-4340", 8.0, [10.0, 0.5], 1.0),
    ("steel-4340", 100.0, [0.12, 1.6], 1.0),
    ("steel-4340", 100.0, [1.6, 10.0], 0.3),
    ("steel-4340", 100.0, [10.0, 0.5], 2.0),
    ("titanium-6al4v", 8.0, [0.12, 1.6], 1.0),
    ("titanium-6al4v", 8.0, [4.0, 0.5], 1.0),
];

/// Slips since the step over a₀.
const SLIPS: [f64; 5] = [0.03, 0.1, 0.3, 1.0, 2.0];

fn main() -> anyhow::Result<()> {
    println!(
        "{:<46} {}",
        "Q/Q(0): run, table; P/P(0): run, table",
        SLIPS.map(|x| format!("x = {x:<25}")).concat()
    );
    for case in CASES {
        println!("{}", line(case)?);
    }
    Ok(())
}

fn line((metal, omega, rates, before): (&str, f64, [f64; 2], f64)) -> anyhow::Result<String> {
    let [slow, fast] = rates;
    let last = SLIPS[SLIPS.len() - 1];
    let table = shipped::table(metal)?;
    let text = format!(
        "[material]\npreset = \"{metal}\"\n[counterface]\npreset = \"{metal}\"\nelastic = false\n[asperity]\nradius = {RADIUS}\n\
         [loading]\ninterference = {omega}\nsteps = [{{ slip_rate = {slow:?}, slip_distance = {before:?} }}, {{ slip_rate = {fast:?}, slip_distance = {last:?} }}]\n"
    );
    let run = simulate(&parse_scene(&text, "this example", &[])?, &Unwatched)?;
    let radius = run.scalars[Quantity::ContactRadius].value;
    let step = RateStep::new(&table, RADIUS, rates)?;
    let contact = step.contact(omega)?;
    let start = contact.response(before * radius, 0.0)?;
    let at_step = [Quantity::Friction, Quantity::Load].map(|quantity| since(&run, quantity, 0.0));
    let mut line = format!("{metal:<15} {omega:>4} ω_c, {slow:>4} to {fast:>4} m/s after {before} a₀");
    let mut worst: f64 = 0.0;
    let mut change: f64 = 0.0;
    for x in SLIPS {
        let found = contact.response(before * radius, x * radius)?;
        let [q, p] = [(found.friction, start.friction), (found.load, start.load)]
            .map(|(now, then)| now.value / then.value);
        let [run_q, run_p] = [(Quantity::Friction, at_step[0]), (Quantity::Load, at_step[1])]
            .map(|(quantity, then)| since(&run, quantity, x * radius) / then);
        line += &format!("  {run_q:.3} {q:.3} {run_p:.3} {p:.3}");
        worst = worst.max((q - run_q).abs()).max((p - run_p).abs());
        change = change.max((run_q - 1.0).abs()).max((run_p - 1.0).abs());
    }
    Ok(format!("{line}  {:.2}", worst / change))
}

/// A history of the second step after `slip` (m) since its beginning, between the states of the run.
fn since(run: &Outcome, quantity: Quantity, slip: f64) -> f64 {
    let states: Vec<_> = run.slide.states().collect();
    let second = states.iter().position(|state| state[Quantity::ProgrammeStep] > 1.5).expect("two steps");
    let states = &states[second - 1..];
    let at = |n: usize| states[n][Quantity::Slip] - states[0][Quantity::Slip];
    let after = (1..states.len()).find(|&n| at(n) >= slip * (1.0 - 1e-9)).expect("slides as far");
    let share = (slip - at(after - 1)) / (at(after) - at(after - 1));
    let [a, b] = [states[after - 1][quantity], states[after][quantity]];
    a + share.max(0.0) * (b - a)
}
