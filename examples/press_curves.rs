//! A sphere pressed from first yield to a hundred times as far, beside the fits of Jackson & Green 2005 and
//! Kogut & Etsion 2002: load and contact area at three yield strains.
//!
//! Frictionless and at small strain, as the fits are; then, at one of the yield strains, in full stick and at
//! finite strain, which the fits are not. Prints the differences from Jackson & Green in per cent; `coarse`
//! in place of the path of a figure presses a few cases on a coarse mesh.
//!
//!     cargo run --release -p examples --example press_curves [FIGURE.svg | coarse]

use std::path::Path;

use asperity::scene::file::parse_scene;
use asperity::simulate::{Unwatched, press};
use tables::closed_forms::{hertz, jackson_green, kogut_etsion};
use tables::figures::{Axis, Curve, Drawn, Figure, Panel};

/// E, Pa, and ν.
const ELASTIC: (f64, f64) = (200e9, 0.3);
const STRAINS: [f64; 3] = [0.001, 0.002, 0.005];
const INTERFERENCES: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// What is pressed: law of the interface, kinematics, σ_Y/E*.
#[derive(Clone, Copy)]
struct Case {
    law: &'static str,
    kinematics: &'static str,
    strain: f64,
}

/// P/P_c and A/A_c at an interference, each with its estimated error.
#[derive(Clone, Copy)]
struct Pressed {
    omega: f64,
    load: (f64, f64),
    area: (f64, f64),
}

fn main() -> anyhow::Result<()> {
    let argument = std::env::args().nth(1);
    let coarse = argument.as_deref() == Some("coarse");
    let (interferences, elements): (&[f64], usize) =
        if coarse { (&[2.0, 20.0], 6) } else { (&INTERFERENCES, 12) };
    let small = |strain| Case { law: "frictionless", kinematics: "small", strain };
    let middle = STRAINS[1];
    let cases = [
        STRAINS.map(small).to_vec(),
        vec![Case { law: "full-stick", ..small(middle) }, Case { kinematics: "finite", ..small(middle) }],
    ]
    .concat();

    let mut curves = Vec::new();
    for case in cases {
        let pressed: Vec<Pressed> =
            interferences.iter().map(|&omega| of(case, omega, elements)).collect::<Result<_, _>>()?;
        println!("{}, {} strain, sigma_Y/E* = {}", case.law, case.kinematics, case.strain);
        println!("  omega/omega_c     P/P_c   off J-G   off K-E     A/A_c   off J-G   off K-E");
        for Pressed { omega, load, area } in &pressed {
            let off = |value: f64, reference: f64| 100.0 * (value / reference - 1.0);
            println!(
                "  {omega:>13}  {:>8.2}  {:>6.1} %  {:>6.1} %  {:>8.2}  {:>6.1} %  {:>6.1} %",
                load.0,
                off(load.0, jackson_green::load(*omega, case.strain, ELASTIC.1)),
                off(load.0, kogut_etsion::load(*omega, ELASTIC.1)),
                area.0,
                off(area.0, jackson_green::area(*omega, case.strain)),
                off(area.0, kogut_etsion::area(*omega)),
            );
        }
        curves.push((case, pressed));
    }
    if let Some(path) = argument.filter(|_| !coarse) {
        figure(&curves).save(Path::new(&path))?;
        println!("written to {path}");
    }
    Ok(())
}

fn of(case: Case, omega: f64, elements: usize) -> anyhow::Result<Pressed> {
    let (youngs, poisson) = ELASTIC;
    let modulus = hertz::contact_modulus(youngs, poisson);
    let (strength, radius) = (case.strain * modulus, 1e-3);
    // Nothing slides: slip rate, heat and the constants of heat play no part.
    let text = format!(
        "[material]\nyoungs_modulus = {youngs:?}\npoisson_ratio = {poisson}\nyield_strength = {strength:?}\n\
         hardening = {{ law = \"none\" }}\nsoftening = {{ law = \"none\" }}\ndensity = 7850.0\n\
         specific_heat = 475.0\nthermal_conductivity = 45.0\nthermal_expansion = 0.0\n\
         [asperity]\nradius = {radius:?}\n[interface]\nlaw = \"{}\"\n\
         [loading]\ninterference = {omega:?}\nslip_rate = 0\n[model]\nkinematics = \"{}\"\n\
         [numerics]\nelements_per_radius = {elements}\nsectors = 4\n",
        case.law, case.kinematics
    );
    let contact = press(&parse_scene(&text, "this example", &[])?, &Unwatched)?.contact();
    let critical_load = hertz::critical_load(modulus, poisson, strength, radius);
    let critical_area = hertz::critical_area(modulus, poisson, strength, radius);
    Ok(Pressed {
        omega,
        load: (contact.load.value / critical_load, contact.load.error / critical_load),
        area: (contact.area.value / critical_area, contact.area.error / critical_area),
    })
}

/// Load and area over their Hertzian values, which spreads the curves; and what is off the fits.
fn figure(curves: &[(Case, Vec<Pressed>)]) -> Figure {
    let dense: Vec<f64> = (0..=60).map(|n| 10f64.powf(f64::from(n) / 30.0)).collect();
    let x = || Axis::logarithmic("interference ω₀/ω_c");
    let points = |label: String, pressed: &[Pressed], value: &dyn Fn(&Pressed) -> (f64, f64)| {
        let (values, errors): (Vec<f64>, Vec<f64>) = pressed.iter().map(value).unzip();
        let omegas = pressed.iter().map(|pressed| pressed.omega).collect();
        Curve::new(label, omegas, values).with_error(errors)
    };
    let scaled = |(value, error): (f64, f64), by: f64| (value / by, error / by);
    let percent = |(value, error): (f64, f64), reference: f64| {
        (100.0 * (value / reference - 1.0), 100.0 * error / reference)
    };
    type Part = fn(&Pressed) -> (f64, f64);
    type Fit = fn(f64, f64) -> f64;
    // Label, the part of a press, Hertz's power of ω*, the two fits.
    let load: (&str, Part, f64, Fit, Fit) = (
        "P/P_Hertz",
        |pressed| pressed.load,
        1.5,
        |omega, strain| jackson_green::load(omega, strain, ELASTIC.1),
        |omega, _| kogut_etsion::load(omega, ELASTIC.1),
    );
    let area: (&str, Part, f64, Fit, Fit) =
        ("A/A_Hertz", |pressed| pressed.area, 1.0, jackson_green::area, |omega, _| kogut_etsion::area(omega));
    let mut panels = Vec::new();
    for (label, part, power, jackson, kogut) in [load, area] {
        let mut shown = Vec::new();
        for (style, (case, pressed)) in curves[..STRAINS.len()].iter().enumerate() {
            let simulated = |p: &Pressed| scaled(part(p), p.omega.powf(power));
            let name = format!("σ_Y/E* = {}", case.strain);
            shown.push(points(name, pressed, &simulated).drawn_as(Drawn::Markers, style));
            let fit = dense.iter().map(|omega| jackson(*omega, case.strain) / omega.powf(power)).collect();
            shown.push(Curve::new("", dense.clone(), fit).drawn_as(Drawn::Line, style));
        }
        let fit = dense.iter().map(|omega| kogut(*omega, 0.0) / omega.powf(power)).collect();
        shown.push(Curve { style: Some(7), ..Curve::new("Kogut–Etsion", dense.clone(), fit) });
        panels.push(Panel {
            title: format!("{label}: markers simulated, lines Jackson–Green"),
            x: x(),
            y: Axis::linear(label),
            curves: shown,
        });
    }
    for (label, part, _, jackson, _) in [load, area] {
        let off = |case: &Case, pressed: &[Pressed], name: &str, style| {
            let strain = case.strain;
            let value = |p: &Pressed| percent(part(p), jackson(p.omega, strain));
            Curve { style: Some(style), ..points(name.to_owned(), pressed, &value) }
        };
        let [_, (plain, pressed), _, (stick, stuck), (finite, strained)] = curves else {
            unreachable!("as many cases as were made")
        };
        panels.push(Panel {
            title: format!("{label} at σ_Y/E* = {}: off Jackson–Green", plain.strain),
            x: x(),
            y: Axis::linear("difference (%)"),
            curves: vec![
                off(plain, pressed, "as the fit", 1),
                off(stick, stuck, "full stick", 4),
                off(finite, strained, "finite strain", 5),
            ],
        });
    }
    Figure { title: "Press of an elastic–plastic sphere without hardening".into(), panels }
}
