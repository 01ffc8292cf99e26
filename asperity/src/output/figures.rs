//! The figure of a run: histories over slip, and maps of the contact plane.

use tables::figures::{Axis, Curve, Drawing, Panel, Sheet};
use tables::quantity::Quantity;

use crate::output::contact_maps::contact_maps;
use crate::output::scale::scaled;
use crate::scene::Scene;
use crate::simulate::outcome::Outcome;
use tables::numbers::plain;

/// A label and the quantity that it is for.
type Labelled = (&'static str, Quantity);

const FRICTION: [Labelled; 1] = [("", Quantity::Mu)];
const FORCES: [Labelled; 2] = [("Q", Quantity::Friction), ("P", Quantity::Load)];
const AREA: [Labelled; 1] = [("", Quantity::Area)];
const TEMPERATURES: [Labelled; 2] =
    [("highest", Quantity::TemperatureMax), ("mean", Quantity::TemperatureMean)];
const ENERGIES: [Labelled; 6] = [
    ("work of the flat", Quantity::Work),
    ("elastic", Quantity::EnergyElastic),
    ("plastic", Quantity::DissipationPlastic),
    ("frictional", Quantity::DissipationFriction),
    ("thermal expansion", Quantity::WorkThermalExpansion),
    ("softening of moduli", Quantity::EnergyModuliSoftening),
];
const HEATS: [Labelled; 3] =
    [("in", Quantity::HeatIn), ("stored", Quantity::HeatStored), ("out", Quantity::HeatOut)];
const PLASTIC_STRAIN: [Labelled; 1] = [("", Quantity::PlasticStrainMax)];

/// Friction, forces, area, temperature, energies and heat of a run against slip; below, a row of maps
/// for each snapshot of the contact.
pub fn run_figure(scene: &Scene, outcome: &Outcome) -> Sheet {
    let panel = |title: &str, label: &str, unit: &str, histories: &[Labelled]| {
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

/// Slip in units of a₀ along the slide.
fn slips(outcome: &Outcome) -> Vec<f64> {
    let radius = outcome.scalars[Quantity::ContactRadius].value;
    outcome.slide.column(Quantity::Slip).iter().map(|slip| slip / radius).collect()
}

fn panel(outcome: &Outcome, title: &str, label: &str, unit: &str, histories: &[Labelled]) -> Panel {
    let slips = slips(outcome);
    let values = |quantity: Quantity| outcome.slide.column(quantity).iter();
    let largest = histories
        .iter()
        .flat_map(|(_, quantity)| values(*quantity))
        .filter(|value| value.is_finite())
        .fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let (scale, label) = scaled(largest, label, unit);
    let curve = |(name, quantity): &Labelled| {
        Curve::new(*name, slips.clone(), values(*quantity).map(|value| value / scale).collect())
    };
    Panel {
        title: title.to_owned(),
        x: Axis::linear("slip s/a₀"),
        y: Axis::linear(label),
        curves: histories.iter().map(curve).collect(),
    }
}

/// From stick to slip, in a small part of the slide: over the logarithm of the slip.
fn onset(outcome: &Outcome) -> Panel {
    let curve = |name, quantity, scale: f64| {
        let values = outcome.slide.column(quantity).iter().map(|value| value / scale).collect();
        Curve::new(name, slips(outcome), values)
    };
    let peak = outcome.scalars[Quantity::MuPeak].value;
    Panel {
        title: "Onset of sliding".to_owned(),
        x: Axis::logarithmic("slip s/a₀"),
        y: Axis::linear("fraction"),
        curves: vec![
            curve("stick area fraction", Quantity::StickFraction, 1.0),
            curve("µ over its peak", Quantity::Mu, if peak > 0.0 { peak } else { f64::NAN }),
        ],
    }
}

#[cfg(test)]
mod tests {
    use tables::figures::Scale;

    use super::*;
    use crate::simulate::fake;

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
        let mut outcome = fake::outcome(&scene);
        let cold = [
            "friction coefficient Q/P",
            "force (N)",
            "contact area A (10⁻⁹ m²)",
            "fraction",
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
        let mut outcome = fake::outcome(&scene);
        outcome.slide.truncate(0);
        let directory = tempfile::tempdir().unwrap();
        let figure = run_figure(&scene, &outcome);
        figure.save(&directory.path().join("run.svg")).unwrap();
    }
}
