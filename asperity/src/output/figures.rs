//! The figure of a run: what happens along the slide, and the contact plane at chosen instants.

use tables::figures::{Axis, Curve, Drawing, Panel, Sheet};

use crate::output::contact_maps::contact_maps;
use crate::scene::Scene;
use crate::simulate::outcome::{Outcome, SlideStep};
use tables::numbers::plain;

type History = (&'static str, fn(&SlideStep) -> f64);

const FRICTION: [History; 1] = [("", |step| step.mu)];
const FORCES: [History; 2] = [("Q", |step| step.friction), ("P", |step| step.load)];
const AREA: [History; 1] = [("", |step| step.area)];
const TEMPERATURES: [History; 2] =
    [("highest", |step| step.temperature_max), ("mean", |step| step.temperature_mean)];
const ENERGIES: [History; 6] = [
    ("work of the flat", |step| step.work),
    ("elastic", |step| step.energy_elastic),
    ("plastic", |step| step.dissipation_plastic),
    ("frictional", |step| step.dissipation_friction),
    ("thermal expansion", |step| step.work_thermal_expansion),
    ("softening of moduli", |step| step.energy_moduli_softening),
];
const HEATS: [History; 3] =
    [("in", |step| step.heat_in), ("stored", |step| step.heat_stored), ("out", |step| step.heat_out)];
const PLASTIC_STRAIN: [History; 1] = [("", |step| step.plastic_strain_max)];

/// Friction, forces, area, temperature, energies and heat of a run against slip; below, a row of maps
/// for each snapshot of the contact.
pub fn run_figure(scene: &Scene, outcome: &Outcome) -> Sheet {
    let panel = |title: &str, label: &str, unit: &str, histories: &[History]| {
        panel(outcome, title, label, unit, histories)
    };
    let mut panels = vec![
        panel("Friction", "friction coefficient Q/P", "", &FRICTION),
        panel("Forces", "force", "N", &FORCES),
        panel("Contact area", "contact area A", "m²", &AREA),
        onset(outcome),
        panel("Plastic strain", "largest plastic strain", "", &PLASTIC_STRAIN),
        panel("Energies since the start of the slide", "energy", "J", &ENERGIES),
    ];
    if outcome.account.heat {
        panels.push(panel("Contact temperature", "temperature", "K", &TEMPERATURES));
        panels.push(panel("Heat since the start of the slide", "heat", "J", &HEATS));
    }
    let maps = contact_maps(outcome).into_iter().map(Drawing::Cells);
    Sheet {
        title: format!(
            "{} ω_c at {} m/s, R = {} m",
            plain(scene.loading.interference),
            plain(scene.loading.slip_rate),
            plain(scene.radius)
        ),
        // Those of a row of maps.
        columns: if outcome.account.heat { 4 } else { 3 },
        drawings: panels.into_iter().map(Drawing::Curves).chain(maps).collect(),
    }
}

fn panel(outcome: &Outcome, title: &str, label: &str, unit: &str, histories: &[History]) -> Panel {
    let steps = &outcome.slide;
    let radius = outcome.summary.contact_radius.value;
    let slips: Vec<f64> = steps.iter().map(|step| step.slip / radius).collect();
    let largest = histories
        .iter()
        .flat_map(|(_, of)| steps.iter().map(of))
        .filter(|value| value.is_finite())
        .fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let (scale, label) = scaled(largest, label, unit);
    let curve = |(name, of): &History| {
        let values = steps.iter().map(|step| of(step) / scale).collect();
        Curve::new(*name, slips.clone(), values)
    };
    Panel {
        title: title.to_owned(),
        x: Axis::linear("slip s/a₀"),
        y: Axis::linear(label),
        curves: histories.iter().map(curve).collect(),
    }
}

/// From stick to slip, which goes by in a small part of the slide: over the logarithm of the slip.
fn onset(outcome: &Outcome) -> Panel {
    let radius = outcome.summary.contact_radius.value;
    let slips: Vec<f64> = outcome.slide.iter().map(|step| step.slip / radius).collect();
    let curve = |name, of: &dyn Fn(&SlideStep) -> f64| {
        Curve::new(name, slips.clone(), outcome.slide.iter().map(of).collect())
    };
    let peak = outcome.summary.mu_peak.value;
    Panel {
        title: "Onset of sliding".to_owned(),
        x: Axis::logarithmic("slip s/a₀"),
        y: Axis::linear("share"),
        curves: vec![
            curve("sticks, of A", &|step| step.stick_fraction),
            curve("µ, of its peak", &|step| if peak > 0.0 { step.mu / peak } else { f64::NAN }),
        ],
    }
}

/// What values up to `largest` are divided by for display, and their label with the unit that is left.
pub(crate) fn scaled(largest: f64, label: &str, unit: &str) -> (f64, String) {
    let (exponent, label) = match (unit, thousands(largest)) {
        ("", _) => (0, label.to_owned()),
        (unit, 0) => (0, format!("{label} ({unit})")),
        (unit, exponent) => (exponent, format!("{label} (10{} {unit})", superscript(exponent))),
    };
    (10_f64.powi(exponent), label)
}

/// Multiple of three that leaves a number from 1 to 1000, or 0 if it needs no scaling.
fn thousands(largest: f64) -> i32 {
    match largest {
        0.0 | 0.1..1e4 => 0,
        largest => 3 * (largest.log10() / 3.0).floor() as i32,
    }
}

fn superscript(exponent: i32) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use tables::figures::Scale;

    use super::*;
    use crate::simulate::fake::{self, Fake};

    fn labels(sheet: &Sheet) -> Vec<&str> {
        fn label(drawing: &Drawing) -> &str {
            match drawing {
                Drawing::Curves(panel) => panel.y.label.as_str(),
                Drawing::Cells(cells) => match &cells.scale {
                    Scale::Shades { label, .. } => label.as_str(),
                    Scale::Classes(_) => "classes",
                },
                Drawing::Map(_) => "map",
            }
        }
        sheet.drawings.iter().map(label).collect()
    }

    #[test]
    fn figure_has_the_panels_and_units() {
        let scene = fake::scene(20.0, 1.0);
        let mut outcome = Fake::outcome(&scene);
        let cold = [
            "friction coefficient Q/P",
            "force (N)",
            "contact area A (10⁻⁹ m²)",
            "share",
            "largest plastic strain",
            "energy (J)",
        ];
        let maps = ["classes", "pressure (10⁹ Pa)", "shear traction (10⁶ Pa)"];
        assert_eq!(labels(&run_figure(&scene, &outcome)), [&cold[..], &maps].concat());
        outcome.account.heat = true;
        let figure = run_figure(&scene, &outcome);
        let hot = ["temperature (K)", "heat (J)"];
        assert_eq!(labels(&figure), [&cold[..], &hot, &maps, &["temperature (K)"]].concat());
        let Drawing::Curves(Panel { curves, .. }) = &figure.drawings[0] else { panic!() };
        assert!((curves[0].x.last().unwrap() - 2.0).abs() < 1e-12);
        let directory = tempfile::tempdir().unwrap();
        figure.save(&directory.path().join("run.svg")).unwrap();
    }

    #[test]
    fn a_run_without_steps_gives_an_empty_figure() {
        let scene = fake::scene(20.0, 1.0);
        let mut outcome = Fake::outcome(&scene);
        outcome.slide.clear();
        let directory = tempfile::tempdir().unwrap();
        let figure = run_figure(&scene, &outcome);
        figure.save(&directory.path().join("run.svg")).unwrap();
    }

    #[test]
    fn scales_are_powers_of_a_thousand() {
        assert_eq!([0.0, 0.3, 9e3, 2e4, 5e-9].map(thousands), [0, 0, 0, 3, -9]);
        assert_eq!(superscript(-12), "⁻¹²");
    }
}
