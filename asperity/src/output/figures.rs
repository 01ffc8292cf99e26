//! The figure of a run: histories over slip, and maps of the contact plane.

use tables::figures::{Axis, Curve, Figure, Panel};
use tables::quantity::Quantity;

use crate::output::contact_maps::contact_maps;
use crate::output::scale::scaled;
use crate::scene::{Scene, Switch};
use crate::simulate::outcome::Outcome;
use tables::numbers::plain;

/// Names of the panels; `temperature`, `heat` and `temperature-map` are drawn if heat is simulated.
pub const PANELS: [&str; 13] = [
    "friction",
    "forces",
    "area",
    "onset",
    "plastic-strain",
    "energies",
    "temperature",
    "heat",
    "status-map",
    "pressure-map",
    "shear-map",
    "slip-map",
    "temperature-map",
];

/// The panels of [`PANELS`] that show heat.
const OF_HEAT: [&str; 3] = ["temperature", "heat", "temperature-map"];

/// Panels that the figure of a run of `scene` may have: those of heat unless it is left out whatever its effect.
pub fn panels(scene: &Scene) -> Vec<&'static str> {
    let Scene { model, loading, interface, .. } = scene;
    let heated = match model.heat {
        Switch::Off => false,
        Switch::On => true,
        Switch::Auto => loading.slip_rate != 0.0 && interface.law.has_friction(),
    };
    PANELS.into_iter().filter(|name| heated || !OF_HEAT.contains(name)).collect()
}

/// A label and the quantity that it is for.
type Labelled = (&'static str, Quantity);

/// Histories in one panel: its name, title, label and unit, and the histories.
type Shown = (&'static str, &'static str, &'static str, &'static str, &'static [Labelled]);

/// Quantities that change at the onset of sliding, in a small part of the slide: over the logarithm of the slip.
#[rustfmt::skip]
const AT_ONSET: [Shown; 4] = [
    ("friction", "Friction", "Friction coefficient μ = Q/P", "", &[("", Quantity::Mu)]),
    ("forces", "Forces", "Force", "N", &[("friction Q", Quantity::Friction), ("load P", Quantity::Load)]),
    ("area", "Contact area", "Contact area A", "m²", &[("", Quantity::Area)]),
    ("plastic-strain", "Plastic strain", "Largest plastic strain", "", &[("", Quantity::PlasticStrainMax)]),
];

const ENERGIES: Shown = (
    "energies",
    "Energies since the start of the slide",
    "Energy",
    "J",
    &[
        ("work of the flat", Quantity::Work),
        ("elastic", Quantity::EnergyElastic),
        ("plastic", Quantity::DissipationPlastic),
        ("frictional", Quantity::DissipationFriction),
        ("thermal expansion", Quantity::WorkThermalExpansion),
        ("softening of moduli", Quantity::EnergyModuliSoftening),
    ],
);

#[rustfmt::skip]
const WITH_HEAT: [Shown; 2] = [
    ("temperature", "Contact temperature", "Temperature T", "K",
        &[("highest", Quantity::TemperatureMax), ("mean", Quantity::TemperatureMean)]),
    ("heat", "Heat since the start of the slide", "Heat", "J",
        &[("in", Quantity::HeatIn), ("stored", Quantity::HeatStored), ("out", Quantity::HeatOut)]),
];

/// Friction, forces, area, temperature, energies and heat of a run against slip; below, a row of maps
/// for each snapshot of the contact.
pub fn run_figure(scene: &Scene, outcome: &Outcome) -> Figure {
    let [friction, forces, area, plastic_strain] = AT_ONSET.map(|shown| panel(outcome, shown, true));
    let mut panels = vec![friction, forces, area, onset(outcome), plastic_strain];
    panels.push(panel(outcome, ENERGIES, false));
    if outcome.account.heat {
        panels.extend(WITH_HEAT.map(|shown| panel(outcome, shown, false)));
    }
    panels.extend(contact_maps(outcome));
    let loading = &scene.loading;
    let rates = match loading.steps.is_empty() {
        true => format!("at {} m/s", plain(loading.slip_rate)),
        false => format!("through {} steps of slip rate", loading.steps.len()),
    };
    Figure {
        title: format!("{} ω_{{c}} {rates}, R = {} m", plain(outcome.interference), plain(scene.radius)),
        // Those of a row of maps.
        columns: if outcome.account.heat { 5 } else { 4 },
        panels,
    }
}

/// Slip in units of a₀ along the slide; of a programme the sum over its steps.
fn slips(outcome: &Outcome) -> Vec<f64> {
    let radius = outcome.scalars[Quantity::ContactRadius].value;
    outcome.slide.column(Quantity::SlipAccumulated).iter().map(|slip| slip / radius).collect()
}

fn is_programme(outcome: &Outcome) -> bool {
    outcome.slide.last(Quantity::ProgrammeStep).is_some_and(|step| step > 1.0)
}

fn slip_axis(outcome: &Outcome, at_onset: bool) -> Axis {
    match is_programme(outcome) {
        true => Axis::linear("Accumulated slip over a_{0}"),
        false => Axis { log: at_onset, ..Axis::linear("Slip s/a_{0}") },
    }
}

fn panel(outcome: &Outcome, (name, title, label, unit, histories): Shown, at_onset: bool) -> Panel {
    let slips = slips(outcome);
    let values = |quantity: Quantity| outcome.slide.column(quantity).iter();
    let largest = (histories.iter())
        .flat_map(|(_, quantity)| values(*quantity))
        .filter(|value| value.is_finite())
        .fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let (scale, label) = scaled(largest, label, unit);
    let curve = |(name, quantity): &Labelled| {
        Curve::new(*name, slips.clone(), values(*quantity).map(|value| value / scale).collect())
    };
    let curves = histories.iter().map(curve).collect();
    Panel::new(name, title, slip_axis(outcome, at_onset), Axis::linear(label), curves)
}

/// Panel of the change from stick to slip.
fn onset(outcome: &Outcome) -> Panel {
    let curve = |name, quantity, scale: f64| {
        let values = outcome.slide.column(quantity).iter().map(|value| value / scale).collect();
        Curve::new(name, slips(outcome), values)
    };
    let peak = outcome.slide.column(Quantity::Mu).iter().fold(0.0, |most: f64, mu| most.max(mu.abs()));
    let curves = vec![
        curve("stick area fraction", Quantity::StickFraction, 1.0),
        curve("μ over its peak", Quantity::Mu, if peak > 0.0 { peak } else { f64::NAN }),
    ];
    Panel::new("onset", "Onset of sliding", slip_axis(outcome, true), Axis::linear("Fraction"), curves)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::fake;

    fn names(figure: &Figure) -> Vec<&str> {
        figure.panels.iter().map(|panel| panel.name.as_str()).collect()
    }

    #[test]
    fn figure_has_the_panels_and_units() {
        let scene = fake::scene(20.0, 1.0);
        let mut outcome = fake::outcome(&scene);
        outcome.account.heat = true;
        let figure = run_figure(&scene, &outcome);
        assert_eq!(names(&figure), PANELS);
        let labels: Vec<&str> = figure.panels[..8].iter().map(|panel| panel.y.label.as_str()).collect();
        let expected = [
            "Friction coefficient μ = Q/P",
            "Force (N)",
            "Contact area A (10^{−9} m²)",
            "Fraction",
            "Largest plastic strain",
            "Energy (J)",
            "Temperature T (K)",
            "Heat (J)",
        ];
        assert_eq!(labels, expected);
        // The onset, at a hundredth of the slide, is visible in the friction.
        let Panel { x, curves, .. } = &figure.panels[0];
        assert!(x.log && (curves[0].x.last().unwrap() - 2.0).abs() < 1e-12);
        outcome.account.heat = false;
        let cold = run_figure(&scene, &outcome);
        let off = fake::scene(20.0, 0.0);
        assert_eq!(names(&cold), panels(&off));
        assert_eq!(panels(&scene), PANELS);
        // Of several rows of maps each name once.
        let mut rows = cold.clone();
        rows.panels.extend(cold.panels);
        let error = rows.only(&["temperature".into()]).unwrap_err().to_string();
        assert!(error.ends_with(&format!("it has {}", panels(&off).join(", "))), "{error}");
    }

    /// Forwards by 2 a₀, backwards by 1 a₀.
    #[test]
    fn a_programme_is_drawn_over_its_accumulated_slip() {
        let scene = fake::scene(20.0, 1.0);
        let mut outcome = fake::outcome(&scene);
        let radius = outcome.scalars[Quantity::ContactRadius].value;
        let last = outcome.slide.len() - 1;
        outcome.slide.column_mut(Quantity::Slip)[last] = radius;
        outcome.slide.column_mut(Quantity::SlipAccumulated)[last] = 3.0 * radius;
        outcome.slide.column_mut(Quantity::ProgrammeStep)[last] = 2.0;
        let Panel { x, curves, .. } = &run_figure(&scene, &outcome).panels[0];
        assert!(!x.log && (curves[0].x[last] - 3.0).abs() < 1e-12, "{:?}", curves[0].x);
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
