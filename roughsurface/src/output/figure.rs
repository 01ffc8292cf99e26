//! Figures of a prediction.

use crate::friction::quantities::SurfaceQuantity;
use crate::friction::rate_law::RateLaw;
use crate::friction::rate_step::RateStepResponse;
use crate::friction::{Friction, Prediction};
use crate::sampling::case::{Case, Results};
use crate::surface::query::NormalLoading;
use tables::figures::{Axis, Curve, Drawn, Figure, Panel};
use tables::numbers::{Spacing, alike, digits};

/// Curves that a panel can hold and stay legible.
const MOST_CURVES: usize = 6;

const FRICTION_LABEL: &str = "Friction coefficient μ";

/// Names of the panels; `temperature` is drawn where the table states it, `step` for a step of the slip rate, `models`
/// in a comparison with models.
pub const PANELS: [&str; 11] = [
    "rate",
    "friction",
    "static",
    "slide",
    "area",
    "separation",
    "load",
    "regimes",
    "temperature",
    "step",
    "models",
];

/// The panels that the figure of a case beside the models `compared` has.
pub fn panels(case: &Case, compared: &[String]) -> Vec<&'static str> {
    let drawn = |name: &&str| match *name {
        "temperature" => states_temperature(case),
        "step" => case.file.query.rate_step.is_some(),
        "models" => !compared.is_empty(),
        _ => true,
    };
    PANELS.into_iter().filter(drawn).collect()
}

/// Whether the law has a temperature in any of its rows: closed forms and some tables have none.
fn states_temperature(case: &Case) -> bool {
    let (law, query) = (&case.source.law, &case.file.query);
    let radius = case.file.surface.asperity_radius.mean();
    let rows = law.breaks().into_iter().chain([law.interference_limit()]);
    let states = |interference: f64, rate: f64| {
        let mean = law.temperature_mean(radius, interference, rate);
        matches!(mean, Ok(Some(mean)) if mean.value.is_finite())
    };
    rows.into_iter().any(|row| query.slip_rates.iter().any(|rate| states(row, *rate)))
}

/// Friction against slip rate, pressure and slip, real contact area, separation, and the regimes of the
/// contacts; with models of the literature if there are any.
pub fn figure(results: &Results) -> Figure {
    let prediction = &results.prediction;
    let is_steady_known = prediction.friction.iter().flatten().any(|cell| cell.mu_steady.value.is_finite());
    let over = |panel: &str, title: &str, y: Axis, shown: &[(&str, &'static str)]| {
        over_loading(prediction, (panel, title), y, shown, 1.0)
    };
    let sliding: &[_] =
        if is_steady_known { &[("", "mu"), ("steady, ", "mu_steady")] } else { &[("", "mu")] };
    let (area, gap) =
        (Axis::logarithmic("Real area fraction"), Axis::linear("Separation while sliding (µm)"));
    let (of_load, of_contacts) = (Axis::linear("Share of the load"), Axis::linear("Share of contacts"));
    let regimes_of_load = [
        ("elastic, ", "elastic_load_fraction"),
        ("elastic-plastic, ", "elastic_plastic_load_fraction"),
        ("fully plastic, ", "fully_plastic_load_fraction"),
    ];
    let mut regimes = vec![("elastic, ", "elastic_fraction"), ("plastic, ", "plastic_fraction")];
    if !prediction.friction[0][0].contacts.shares.melting.is_nan() {
        regimes.push(("melting, ", "melting_fraction"));
    }
    let mut panels = vec![
        over_slip_rate(prediction),
        over("friction", "Sliding friction", Axis::linear(FRICTION_LABEL), sliding),
        over("static", "Static friction", Axis::linear(FRICTION_LABEL), &[("", "mu_static")]),
        along_the_slide(prediction),
        over("area", "Real contact area", area, &[("", "real_area_fraction")]),
        over_loading(prediction, ("separation", "Separation"), gap, &[("", "separation_sliding")], 1e6),
        over("load", "Share of the load", of_load, &regimes_of_load),
        over("regimes", "Share of the contacts", of_contacts, &regimes),
    ];
    if prediction.friction[0][0].contacts.temperature_mean.is_some() {
        let temperature = Axis::linear("Temperature (K)");
        let shown = [("mean, ", "temperature_mean"), ("highest, ", "temperature_max")];
        panels.push(over("temperature", "Temperature of the contacts", temperature, &shown));
    }
    panels.extend(prediction.rate_step.as_ref().map(|response| since_step(prediction, response)));
    if !results.comparisons.is_empty() {
        panels.push(compared(results));
    }
    Figure::new(title(&prediction.law), panels)
}

/// Friction against the slip since a step of the slip rate.
fn since_step(prediction: &Prediction, response: &RateStepResponse) -> Panel {
    let slip: Vec<f64> = response.slip[1..].iter().map(|slip| 1e6 * slip).collect();
    let curve = |row: usize| {
        let mu = response.rows[row].mu[1..].iter().copied();
        Curve::with_errors(row_label(prediction, row), slip.clone(), mu)
    };
    let curves = chosen(response.rows.len(), MOST_CURVES).into_iter().map(curve).collect();
    let title = format!("Step from {} to {} m/s", response.rates[0], response.rates[1]);
    let (x, y) = (Axis::logarithmic("Slip since the step (µm)"), Axis::linear(FRICTION_LABEL));
    Panel::new("step", &title, x, y, curves)
}

/// Sliding friction at the lowest rate in comparison with that of the models; over the slip rate, on which the models
/// do not depend, for the only loading.
fn compared(results: &Results) -> Panel {
    let prediction = &results.prediction;
    let rates = &prediction.query.slip_rates;
    let (values, label, cells): (_, _, Vec<&Friction>) = if one_loading(prediction) {
        (&rates[..], "this".to_owned(), prediction.friction[0].iter().collect())
    } else {
        let first = prediction.friction.iter().map(|cells| &cells[0]).collect();
        (prediction.query.loading.values(), format!("this, {}", rate_label(rates[0])), first)
    };
    let mu = cells.iter().map(|cell| cell.sliding.mu);
    let mut curves = vec![Curve::with_errors(label, values.to_vec(), mu)];
    for comparison in &results.comparisons {
        let mu = |row: usize| comparison.friction[row].sliding.mu.value;
        let y = (0..values.len()).map(|place| mu(place.min(comparison.friction.len() - 1))).collect();
        curves.push(Curve::new(comparison.model.as_str(), values.to_vec(), y));
    }
    let x = if one_loading(prediction) { slip_rate_axis() } else { loading_axis(prediction) };
    Panel::new("models", "Models of the literature", x, Axis::linear(FRICTION_LABEL), curves)
}

/// Names the law where it is short: that of a table is a sentence, and too long for the sheet.
fn title(law: &str) -> String {
    match law.len() {
        ..=24 => format!("Friction of a rough surface ({law})"),
        _ => "Friction of a rough surface".into(),
    }
}

/// Evenly spread choice of at most `most` of `count`, first and last among them.
pub(super) fn chosen(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|i| i * (count - 1) / (most - 1)).collect()
}

fn row_label(prediction: &Prediction, row: usize) -> String {
    let unit = match &prediction.query.loading {
        NormalLoading::Pressure(_) => "Pa",
        NormalLoading::Separation(_) => "m",
    };
    format!("{} {unit}", alike(prediction.query.loading.values(), 4)[row])
}

fn rate_label(slip_rate: f64) -> String {
    format!("{} m/s", digits(slip_rate, 4))
}

/// Points with the rate law through them; where none is determined, with a line.
fn over_slip_rate(prediction: &Prediction) -> Panel {
    let rates = &prediction.query.slip_rates;
    let mut curves = Vec::new();
    let rows = chosen(prediction.friction.len(), MOST_CURVES);
    for (style, &row) in rows.iter().enumerate() {
        let mu = prediction.friction[row].iter().map(|cell| cell.sliding.mu);
        let points = Curve::with_errors(row_label(prediction, row), rates.clone(), mu);
        match &prediction.rate_laws[row].chosen {
            Ok(fit) => {
                curves.push(points.drawn_as(Drawn::Markers, style));
                curves.push(fitted(rates, fit).drawn_as(Drawn::Line, style));
            }
            Err(_) => curves.push(points.drawn_as(Drawn::LineAndMarkers, style)),
        }
    }
    let with_fit = rows.iter().any(|row| prediction.rate_laws[*row].chosen.is_ok());
    let title = if with_fit { "Sliding friction, and rate law (lines)" } else { "Sliding friction" };
    let (x, y) = (slip_rate_axis(), Axis::linear(FRICTION_LABEL));
    Panel::new("rate", title, x, y, curves)
}

/// The rate law along the slip rates.
fn fitted(slip_rates: &[f64], law: &RateLaw) -> Curve {
    const POINTS: usize = 121;
    let rates = slip_rates.iter().copied().filter(|rate| *rate > 0.0);
    let (slowest, fastest) = rates
        .fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), rate: f64| (low.min(rate), high.max(rate)));
    let x = Spacing::Log.range(slowest, fastest, POINTS);
    let y = x.iter().map(|&rate| law.friction_coefficient(rate)).collect();
    Curve::new("", x, y)
}

fn loading_axis(prediction: &Prediction) -> Axis {
    match prediction.query.loading {
        NormalLoading::Pressure(_) => Axis::logarithmic("Nominal pressure p (Pa)"),
        NormalLoading::Separation(_) => Axis::linear("Separation before the slide (m)"),
    }
}

fn slip_rate_axis() -> Axis {
    Axis::logarithmic("Slip rate V (m/s)")
}

/// Whether there is one pressure or separation only, and results are drawn over the slip rate.
fn one_loading(prediction: &Prediction) -> bool {
    prediction.friction.len() == 1 && prediction.query.slip_rates.len() > 1
}

/// Quantities over pressure or separation, a curve for each slip rate, or over the slip rate for the only loading:
/// prefix of the label and name of each, times `factor`.
fn over_loading(
    prediction: &Prediction,
    (panel, title): (&str, &str),
    y: Axis,
    shown: &[(&str, &'static str)],
    factor: f64,
) -> Panel {
    let rates = &prediction.query.slip_rates;
    let mut curves = Vec::new();
    let mut add = |label: String, x: &[f64], cells: &mut dyn Iterator<Item = &Friction>, name| {
        let quantity = SurfaceQuantity::named(name);
        let y = cells.map(|cell| quantity.estimate(cell).scaled(factor));
        curves.push(Curve::with_errors(label, x.to_vec(), y));
    };
    for (prefix, name) in shown {
        if one_loading(prediction) {
            let label = format!("{prefix}{}", row_label(prediction, 0));
            add(label, rates, &mut prediction.friction[0].iter(), name);
            continue;
        }
        for rate in chosen(rates.len(), MOST_CURVES / shown.len()) {
            let label = format!("{prefix}{}", rate_label(rates[rate]));
            let cells = &mut prediction.friction.iter().map(|cells| &cells[rate]);
            add(label, prediction.query.loading.values(), cells, name);
        }
    }
    let x = if one_loading(prediction) { slip_rate_axis() } else { loading_axis(prediction) };
    Panel::new(panel, title, x, y, curves)
}

fn along_the_slide(prediction: &Prediction) -> Panel {
    let rates = chosen(prediction.query.slip_rates.len(), 3);
    let rows = chosen(prediction.friction.len(), (MOST_CURVES / rates.len()).min(2));
    let mut curves = Vec::new();
    for row in rows {
        for &rate in &rates {
            let history = prediction.friction[row][rate].mu_history.iter().copied();
            let slip_rate = rate_label(prediction.query.slip_rates[rate]);
            let label = format!("{}, {slip_rate}", row_label(prediction, row));
            curves.push(Curve::with_errors(label, prediction.slip.clone(), history));
        }
    }
    let (x, y) = (Axis::logarithmic("Slip s (m)"), Axis::linear(FRICTION_LABEL));
    Panel::new("slide", "Along the slide", x, y, curves)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_keep_both_ends() {
        assert_eq!(chosen(3, 6), [0, 1, 2]);
        assert_eq!(chosen(11, 3), [0, 5, 10]);
        assert_eq!(chosen(20, 6), [0, 3, 7, 11, 15, 19]);
    }
}
