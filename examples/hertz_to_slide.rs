//! One steel asperity from first touch to sliding, with the library `asperity`.
//!
//! Presses a sphere of 1 mm radius 20 times as far as first yield needs, compares load and area
//! with Hertz (elastic) and Jackson & Green 2005 (elastic–plastic, frictionless), then slides it
//! at 1 m/s. The press is computed once; a second slip rate would only cost another slide.
//!
//!     cargo run --release -p examples --example hertz_to_slide

use asperity::scene::file::parse_scene;
use asperity::simulate::{Unwatched, press, slide};
use tables::closed_forms::closed_form;
use tables::numbers::with_error;
use tables::quantity::Quantity;

/// A coarse mesh: a look at the method, not a result to quote.
const SCENE: &str = r#"
[material]
preset = "steel-4340"
[asperity]
radius = 1e-3               # m
[loading]
interference = 20.0         # in units of the interference of first yield
slip_rate = 1.0             # m/s
slip_distance = 1.0         # in contact radii
[numerics]
elements_per_radius = 6
sectors = 4
"#;

fn main() -> anyhow::Result<()> {
    // 1. The scene: plain data, here from text. `read_scene` takes a file and overrides.
    let scene = parse_scene(SCENE, "the scene of this example", &[])?;

    // 2. Press in full stick, then slide; `&Unwatched` reports no progress and is never cancelled.
    let pressed = press(&scene, &Unwatched)?;
    let outcome = slide(&pressed, scene.loading.slip_rate, &Unwatched)?;
    let scalars = &outcome.scalars;

    // 3. The press and two closed forms at the same interference.
    let material = scene.material.elastic_plastic();
    println!(
        "pressed to {} omega_c (omega_c = {:.3e} m)",
        scene.loading.interference, outcome.critical_interference
    );
    println!(
        "  this run            P = {}, A = {}",
        with_error(scalars[Quantity::LoadPress], "N"),
        with_error(scalars[Quantity::AreaPress], "m2")
    );
    for name in ["hertz", "jackson-green"] {
        let law = closed_form(name, &material)?;
        let response = law.response(scene.radius, scene.loading.interference, 0.0, 0.0)?;
        println!("  {name:<18}  P = {:.3} N, A = {:.3e} m2", response.load.value, response.area.value);
    }

    // 4. The slide: every tenth of the way.
    println!("slid at {} m/s", scene.loading.slip_rate);
    println!("  slip [um]   Q/P     sticks   T_max [K]");
    let last = outcome.slide.states().next_back().map_or(0.0, |step| step[Quantity::Slip]);
    let mut next = 0.0;
    for step in outcome.slide.states() {
        if step[Quantity::Slip] >= next {
            println!(
                "  {:>8.3}   {:.4}   {:>4.0} %   {:>7.1}",
                1e6 * step[Quantity::Slip],
                step[Quantity::Mu],
                100.0 * step[Quantity::StickFraction],
                step[Quantity::TemperatureMax]
            );
            next = step[Quantity::Slip] + 0.1 * last;
        }
    }
    println!("static friction coefficient  {}", with_error(scalars[Quantity::MuStatic], "1"));
    println!("sliding friction coefficient {}", with_error(scalars[Quantity::Mu], "1"));
    for warning in &outcome.account.warnings {
        println!("warning: {warning}");
    }
    Ok(())
}
