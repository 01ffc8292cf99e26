//! The trap of an interface exactly as strong as a body that does not harden: friction then follows the
//! mesh. Here one can see it, and see what helps and what does not.
//!
//! A sphere pressed to 50 ω_c slides by three tenths of a contact radius, on 6 and on 12 elements per
//! contact radius, at small strain. Prints μ of both meshes along the slide. A minute of processor time;
//! with `coarse` the first three cases alone, on 4 and 8 elements over half the slide.
//!
//!     cargo run --release -p examples --example no_end_state [FIGURE.svg | coarse]

use std::path::Path;
use tables::quantity::Quantity;

use asperity::simulate::outcome::Outcome;
use asperity::{Unwatched, parse_scene, simulate};
use tables::figures::{Axis, Curve, Figure, Panel};

const SCENE: &str = r#"
[material]
youngs_modulus = 200e9      # Pa
poisson_ratio = 0.3
yield_strength = 400e6      # Pa
hardening = { law = "none" }
density = 7850.0            # kg/m3
specific_heat = 475.0       # J/(kg K)
thermal_conductivity = 45.0 # W/(m K)
thermal_expansion = 0.0
softening = { law = "johnson-cook", reference = 298.0, melting = 1793.0, exponent = 1.0 }
[asperity]
radius = 1e-3               # m
[loading]
interference = 50.0         # in units of that of first yield
slip_rate = 0.0             # m/s; 0 is the isothermal limit
slip_distance = 0.3         # in contact radii
[model]
kinematics = "small"
[numerics]
sectors = 4
"#;

/// Changes of the scene, with a label.
const CASES: [(&str, &[&str]); 6] = [
    ("f_τ = 1, no hardening", &[]),
    ("hardening of 0.2 % of E", &["material.hardening={law=\"linear\",modulus=400e6}"]),
    ("f_τ = 0.9", &["interface.strength_factor=0.9"]),
    ("heat, 10 m/s", &["loading.slip_rate=10"]),
    ("heat, 100 m/s", &["loading.slip_rate=100"]),
    ("load held", &["loading.control=load"]),
];

fn main() -> anyhow::Result<()> {
    let argument = std::env::args().nth(1);
    let coarse = argument.as_deref() == Some("coarse");
    let (cases, meshes, end) = if coarse { (&CASES[..3], [4, 8], 0.15) } else { (&CASES[..], [6, 12], 0.3) };
    let shown = [0.02, 0.05, 0.1, 0.2, 0.3].map(|share| share * end / 0.3);

    println!(
        "mu on {} and {} elements per contact radius, after a slip in contact radii of",
        meshes[0], meshes[1]
    );
    println!("{:<24}{}", "", shown.map(|slip| format!("{slip:>14.3}")).concat());
    let mut panels = Vec::new();
    for &(name, changes) in cases {
        let mut runs = Vec::new();
        for elements in meshes {
            let mut overrides: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
            overrides.push(format!("numerics.elements_per_radius={elements}"));
            overrides.push(format!("loading.slip_distance={end}"));
            runs.push(simulate(&parse_scene(SCENE, "this example", &overrides)?, &Unwatched)?);
        }
        let row =
            shown.map(|slip| format!("{:>8.3} {:.3}", friction(&runs[0], slip), friction(&runs[1], slip)));
        println!("{name:<24}{}", row.concat());
        panels.push(panel(name, &runs, meshes));
    }
    if let Some(path) = argument.filter(|_| !coarse) {
        let title = "Friction where body and interface are equally strong, and what changes that";
        Figure::new(title, panels).save(Path::new(&path))?;
        println!("written to {path}");
    }
    Ok(())
}

/// Slips over the contact radius, and μ.
fn history(run: &Outcome) -> (Vec<f64>, Vec<f64>) {
    let radius = run.scalars[Quantity::ContactRadius].value;
    run.slide.states().map(|step| (step[Quantity::Slip] / radius, step[Quantity::Mu])).unzip()
}

/// μ at a slip, between the steps of the run.
fn friction(run: &Outcome, slip: f64) -> f64 {
    let (slips, friction) = history(run);
    let after = slips.partition_point(|known| *known < slip).clamp(1, slips.len() - 1);
    let share = ((slip - slips[after - 1]) / (slips[after] - slips[after - 1])).min(1.0);
    friction[after - 1] + share * (friction[after] - friction[after - 1])
}

fn panel(title: &str, runs: &[Outcome], meshes: [usize; 2]) -> Panel {
    let curve = |(run, elements): (&Outcome, usize)| {
        let (slips, friction) = history(run);
        Curve::new(format!("{elements} elements"), slips, friction)
    };
    let (x, y) = (Axis::linear("Slip s/a_{0}"), Axis::linear("Friction coefficient μ = Q/P"));
    Panel::new("", title, x, y, runs.iter().zip(meshes).map(curve).collect())
}
