//! A sphere pressed from ω_c to 100 ω_c, in comparison with the fits of Jackson & Green 2005 and
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
use tables::quantity::Estimate;

/// E, Pa, and ν.
const ELASTIC: (f64, f64) = (200e9, 0.3);
const STRAINS: [f64; 3] = [0.001, 0.002, 0.005];
const INTERFERENCES: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// A case: law of the interface, kinematics, σ_Y/E*.
#[derive(Clone, Copy)]
struct Case {
    law: &'static str,
    kinematics: &'static str,
    strain: f64,
}

/// P/P_c and A/A_c at an interference.
struct Pressed {
    omega: f64,
    load: Estimate,
    area: Estimate,
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
                load.value,
                off(load.value, jackson_green::load(*omega, case.strain, ELASTIC.1)),
                off(load.value, kogut_etsion::load(*omega, ELASTIC.1)),
                area.value,
                off(area.value, jackson_green::area(*omega, case.strain)),
                off(area.value, kogut_etsion::area(*omega)),
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
    // Without a slide, slip rate, heat and thermal constants have no effect.
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
    let critical_load = Estimate::exact(hertz::critical_load(modulus, poisson, strength, radius));
    let critical_area = Estimate::exact(hertz::critical_area(modulus, poisson, strength, radius));
    let (load, area) = (contact.load.over(critical_load), contact.area.over(critical_area));
    Ok(Pressed { omega, load, area })
}

/// Of a press: P/P_c or A/A_c.
type Part = fn(&Pressed) -> Estimate;
/// A fit over ω* at a yield strain.
type Fit = fn(f64, f64) -> f64;

/// Load or area, Hertz's power of ω*, and the two fits.
struct Shown {
    label: &'static str,
    part: Part,
    power: f64,
    jackson: Fit,
    kogut: Fit,
}

const SHOWN: [Shown; 2] = [
    Shown {
        label: "P/P_Hertz",
        part: |pressed| pressed.load,
        power: 1.5,
        jackson: |omega, strain| jackson_green::load(omega, strain, ELASTIC.1),
        kogut: |omega, _| kogut_etsion::load(omega, ELASTIC.1),
    },
    Shown {
        label: "A/A_Hertz",
        part: |pressed| pressed.area,
        power: 1.0,
        jackson: jackson_green::area,
        kogut: |omega, _| kogut_etsion::area(omega),
    },
];

/// Load and area over their Hertzian values, and their differences from the fits.
fn figure(curves: &[(Case, Vec<Pressed>)]) -> Figure {
    let ratios = SHOWN.iter().map(|shown| over_hertz(shown, curves));
    let panels = ratios.chain(SHOWN.iter().map(|shown| off_jackson(shown, curves))).collect();
    Figure::new("Press of an elastic–plastic sphere without hardening", panels)
}

fn panel(title: String, y: &str, curves: Vec<Curve>) -> Panel {
    Panel::new("", title, Axis::logarithmic("Interference ω_{0}/ω_{c}"), Axis::linear(y), curves)
}

fn points(label: String, pressed: &[Pressed], value: impl Fn(&Pressed) -> Estimate) -> Curve {
    let omegas = pressed.iter().map(|pressed| pressed.omega).collect();
    Curve::with_errors(label, omegas, pressed.iter().map(value))
}

/// The frictionless presses at small strain and the fits, over Hertz.
fn over_hertz(shown: &Shown, curves: &[(Case, Vec<Pressed>)]) -> Panel {
    let Shown { label, part, power, jackson, kogut } = shown;
    let dense: Vec<f64> = (0..=60).map(|n| 10f64.powf(f64::from(n) / 30.0)).collect();
    let of_fit = |fit: &Fit, strain: f64| -> Vec<f64> {
        dense.iter().map(|omega| fit(*omega, strain) / omega.powf(*power)).collect()
    };
    let mut drawn = Vec::new();
    for (style, (case, pressed)) in curves[..STRAINS.len()].iter().enumerate() {
        let simulated = |p: &Pressed| part(p).over(Estimate::exact(p.omega.powf(*power)));
        let name = format!("σ_{{Y}}/E* = {}", case.strain);
        drawn.push(points(name, pressed, simulated).drawn_as(Drawn::Markers, style));
        let fit = of_fit(jackson, case.strain);
        drawn.push(Curve::new("", dense.clone(), fit).drawn_as(Drawn::Line, style));
    }
    let fit = of_fit(kogut, 0.0);
    drawn.push(Curve { style: Some(7), ..Curve::new("Kogut–Etsion", dense.clone(), fit) });
    panel(format!("{label}: markers simulated, lines Jackson–Green"), label, drawn)
}

/// Differences from Jackson & Green, as the fit is made, in full stick and at finite strain.
fn off_jackson(shown: &Shown, curves: &[(Case, Vec<Pressed>)]) -> Panel {
    let Shown { label, part, jackson, .. } = shown;
    let off = |(case, pressed): &(Case, Vec<Pressed>), name: &str, style| {
        let value = |p: &Pressed| {
            let (Estimate { value, error }, reference) = (part(p), jackson(p.omega, case.strain));
            Estimate { value: 100.0 * (value / reference - 1.0), error: 100.0 * error / reference }
        };
        Curve { style: Some(style), ..points(name.to_owned(), pressed, value) }
    };
    let [_, plain, _, stick, finite] = curves else { unreachable!("as many cases as were made") };
    let drawn =
        vec![off(plain, "as the fit", 1), off(stick, "full stick", 4), off(finite, "finite strain", 5)];
    let title = format!("{label} at σ_{{Y}}/E* = {}: off Jackson–Green", plain.0.strain);
    panel(title, "Difference (%)", drawn)
}
