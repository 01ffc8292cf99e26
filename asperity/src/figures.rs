//! The figure of a run: what happens along the slide.

use tables::figure::{Axis, Curve, Figure, Panel};

use crate::numbers::plain;
use crate::outcome::{Outcome, SlideStep};
use crate::scene::Scene;

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

/// Friction, forces, area, temperature and energies of a run against slip.
pub fn run_figure(scene: &Scene, outcome: &Outcome) -> Figure {
    let panel = |title: &str, label: &str, unit: &str, histories: &[History]| {
        panel(outcome, title, label, unit, histories)
    };
    Figure {
        title: format!(
            "{} ω_c at {} m/s, R = {} m",
            plain(scene.loading.interference),
            plain(scene.loading.slip_rate),
            plain(scene.radius)
        ),
        panels: vec![
            panel("Friction", "friction coefficient Q/P", "", &FRICTION),
            panel("Forces", "force", "N", &FORCES),
            panel("Contact area", "contact area A", "m²", &AREA),
            panel("Contact temperature", "temperature", "K", &TEMPERATURES),
            panel("Energies since the start of the slide", "energy", "J", &ENERGIES),
        ],
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
    let exponent = thousands(largest);
    let scale = 10_f64.powi(exponent);
    let curve = |(name, of): &History| {
        let values = steps.iter().map(|step| of(step) / scale).collect();
        Curve::new(*name, slips.clone(), values)
    };
    Panel {
        title: title.to_owned(),
        x: Axis::linear("slip s/a₀"),
        y: Axis::linear(match (unit, exponent) {
            ("", _) => label.to_owned(),
            (unit, 0) => format!("{label} ({unit})"),
            (unit, exponent) => format!("{label} (10{} {unit})", superscript(exponent)),
        }),
        curves: histories.iter().map(curve).collect(),
    }
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
    use super::*;
    use crate::fake::{self, Fake};

    #[test]
    fn figure_has_the_panels_and_units() {
        let scene = fake::scene(20.0, 1.0);
        let figure = run_figure(&scene, &Fake::outcome(&scene));
        let labels: Vec<&str> = figure.panels.iter().map(|p| p.y.label.as_str()).collect();
        assert_eq!(
            labels,
            [
                "friction coefficient Q/P",
                "force (N)",
                "contact area A (10⁻⁹ m²)",
                "temperature (K)",
                "energy (J)",
            ]
        );
        let friction = &figure.panels[0].curves[0];
        assert!((friction.x.last().unwrap() - 2.0).abs() < 1e-12);
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
