//! A prediction as one HTML file: figures, numbers, parameters, errors and warnings.
//!
//! No script, no style sheet, no font and no picture from elsewhere: the file can be sent, kept and
//! opened anywhere.

use crate::friction::Prediction;
use crate::friction::regime::regime;
use crate::output::figure::figure;
use crate::output::friction_file::Origin;
use crate::output::summary::{row_head, with_error};
use crate::surface::query::Hold;
use std::fmt::Write;
use tables::law::Estimate;

const STYLE: &str = "body{font-family:sans-serif;max-width:76em;margin:2em auto;padding:0 1em;color:#111;line-height:1.4}\
table{border-collapse:collapse;margin:1em 0;display:block;overflow-x:auto}\
th,td{border-bottom:1px solid #bbb;padding:.25em .7em;text-align:right;white-space:nowrap}\
th:first-child,td:first-child{text-align:left}pre{background:#f4f4f4;padding:1em;overflow-x:auto}\
svg{max-width:100%;height:auto}.warning{border-left:.4em solid #d55e00;padding:.2em .8em;margin:.5em 0;background:#fbf1ea}";

/// What the numbers leave out, for readers who did not make them.
const CAVEATS: [&str; 6] = [
    "Asperities do not feel each other: real contact areas above some 30 % of the nominal one are not meant.",
    "No adhesion: loads lighter than the pull-off force of the summits are not meant.",
    "No wear: heights and radii stay what they are; running-in and polishing change them.",
    "No third body: no oxide, transfer layer, lubricant, gouge or debris between the surfaces.",
    "The counter-face is smooth and rigid: for two rough surfaces, heights and curvatures add up.",
    "Errors are those of the asperity law, with one sign in all asperities, of interpolation and of \
     quadrature; what the model leaves out is not in them.",
];

const CITATIONS: [&str; 4] = [
    "J. A. Greenwood & J. B. P. Williamson, Contact of nominally flat surfaces, Proc. R. Soc. A 295, 300 (1966), doi 10.1098/rspa.1966.0242",
    "J. R. Rice, Heating and weakening of faults during earthquake slip, J. Geophys. Res. 111, B05311 (2006), doi 10.1029/2005JB004006",
    "N. M. Beeler, T. E. Tullis & D. L. Goldsby, Constitutive relationships and physical basis of fault strength due to flash heating, J. Geophys. Res. 113, B01401 (2008), doi 10.1029/2007JB004988",
    "Y. Ida, Cohesive force across the tip of a longitudinal-shear crack and Griffith's specific surface energy, J. Geophys. Res. 77, 3796 (1972), doi 10.1029/JB077i020p03796",
];

/// The report of a prediction.
///
/// ```
/// use roughsurface::friction::{Settings, predict};
/// use roughsurface::output::friction_file::Origin;
/// use roughsurface::surface::file::SurfaceFile;
/// use tables::closed_forms::closed_form;
///
/// let text = "surface = { asperity_density = 1e10, asperity_radius = 1e-4, \
///             heights = { distribution = \"gaussian\", std = 5e-7 } }\n\
///             query = { pressure = [1e6], slip_rate = [1.0] }\n\
///             material = { youngs_modulus = 200e9, poisson_ratio = 0.3, yield_strength = 400e6 }";
/// let file = SurfaceFile::parse("an example".as_ref(), text.into())?;
/// let law = closed_form("jackson-green", file.material.as_ref().unwrap())?;
/// let prediction = predict(law.as_ref(), &file.surface, &file.query, &Settings::default(), &|_, _| ())?;
/// let origin = Origin { surface: text, table: "model:jackson-green", command: "an example" };
/// let page = roughsurface::output::report::html(&prediction, &origin);
/// assert!(page.contains("<svg") && page.contains("asperity_density"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn html(prediction: &Prediction, origin: &Origin) -> String {
    let mut page = String::new();
    let hold = match prediction.query.hold {
        Hold::Load => "nominal load",
        Hold::Separation => "separation",
    };
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <title>Friction of a rough surface</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <h1>Friction of a rough surface</h1>\n\
         <p>Asperity law: {}. Held during the slide: {hold}. Plasticity index ψ = √(σ<sub>s</sub>/ω<sub>c</sub>) \
         = {:.3}: {}.</p>\n",
        escaped(&prediction.law),
        prediction.plasticity_index,
        regime(prediction.plasticity_index)
    );
    if prediction.warnings.is_empty() {
        page.push_str("<p>No warnings.</p>\n");
    }
    for warning in &prediction.warnings {
        let _ = writeln!(page, "<p class=\"warning\">Warning: {}</p>", escaped(warning));
    }
    let svg = figure(prediction).svg();
    // A declaration before the picture belongs to files of its own.
    let picture = svg.find("<svg").map_or("", |start| &svg[start..]);
    let _ = writeln!(page, "<h2>Figures</h2>\n<div>{picture}</div>");
    results(&mut page, prediction);
    fits(&mut page, prediction);
    uncertainties(&mut page, prediction);
    comparisons(&mut page, prediction);
    page.push_str("<h2>What is left out</h2>\n<ul>\n");
    for caveat in CAVEATS {
        let _ = writeln!(page, "<li>{caveat}</li>");
    }
    let _ = write!(
        page,
        "</ul>\n<h2>Input</h2>\n<p>Table: {}. Command: <code>{}</code>, roughsurface {}.</p>\n<pre>{}</pre>\n<h2>To cite</h2>\n<ul>\n",
        escaped(origin.table),
        escaped(origin.command),
        env!("CARGO_PKG_VERSION"),
        escaped(origin.surface)
    );
    for citation in CITATIONS {
        let _ = writeln!(page, "<li>{}</li>", escaped(citation));
    }
    page.push_str("</ul>\n</body>\n</html>\n");
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A table with a head; cells are text.
fn table(page: &mut String, head: &[String], rows: &[Vec<String>]) {
    let line = |cells: &[String], tag: &str| {
        let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    page.push_str("<table>\n");
    page.push_str(&line(head, "th"));
    for row in rows {
        page.push_str(&line(row, "td"));
    }
    page.push_str("</table>\n");
}

fn heads(prediction: &Prediction, others: &[&str]) -> Vec<String> {
    let first = row_head(&prediction.query.pressing).to_string();
    std::iter::once(first).chain(others.iter().map(|head| head.to_string())).collect()
}

fn results(page: &mut String, prediction: &Prediction) {
    let head = heads(
        prediction,
        &[
            "V [m/s]",
            "μ static",
            "μ sliding",
            "dμ/d ln V",
            "G [J/m²]",
            "G per real area [J/m²]",
            "G weakening [J/m²]",
            "G weakening per real area [J/m²]",
            "D_w [m]",
            "real area fraction",
            "separation [m]",
            "elastic/plastic/melting",
            "outside table",
        ],
    );
    let mut rows = Vec::new();
    for (value, cells) in prediction.query.pressing.values().iter().zip(&prediction.friction) {
        for (rate, cell) in prediction.query.slip_rates.iter().zip(cells) {
            let shares = cell.shares;
            rows.push(vec![
                format!("{value:.3e}"),
                rate.to_string(),
                with_error(cell.mu_static),
                with_error(cell.sliding.mu),
                with_error(cell.rate_sensitivity),
                cell.energy_release.map_or("-".into(), scientific),
                cell.release_of_real_area().map_or("-".into(), scientific),
                scientific(cell.weakening_energy),
                scientific(cell.weakening_of_real_area()),
                scientific(cell.weakening_distance),
                scientific(cell.sliding.area_fraction),
                scientific(cell.sliding.separation),
                format!("{:.3}/{:.3}/{:.3}", shares.elastic, shares.plastic, shares.melting),
                format!("{:.1e}", cell.outside_table),
            ]);
        }
    }
    page.push_str("<h2>Results</h2>\n<p>Value ± estimated absolute error.</p>\n");
    table(page, &head, &rows);
}

fn scientific(estimate: Estimate) -> String {
    match estimate.value.is_finite() {
        true => format!("{:.3e} ± {:.0e}", estimate.value, estimate.error),
        false => "-".into(),
    }
}

fn fits(page: &mut String, prediction: &Prediction) {
    let head = heads(prediction, &["μ_0", "μ_w", "V_w [m/s]", "rms", "R²"]);
    let rows: Vec<Vec<String>> = (prediction.query.pressing.values().iter().zip(&prediction.flash_heating))
        .map(|(value, fit)| {
            let mut row = vec![format!("{value:.3e}")];
            match fit {
                Ok(fit) => {
                    row.extend([fit.mu_0, fit.mu_w, fit.v_w].map(with_error));
                    row.extend([format!("{:.1e}", fit.misfit), format!("{:.4}", fit.r_squared)]);
                }
                Err(reason) => row.push(format!("not fitted: {reason}")),
            }
            row
        })
        .collect();
    page.push_str(
        "<h2>Flash heating</h2>\n<p>μ = μ<sub>w</sub> + (μ<sub>0</sub> − μ<sub>w</sub>)/[1 + (V/V<sub>w</sub>)<sup>8</sup>]<sup>1/8</sup></p>\n",
    );
    table(page, &head, &rows);
}

fn uncertainties(page: &mut String, prediction: &Prediction) {
    let Some(propagated) = &prediction.propagated else {
        return;
    };
    let outputs = crate::sampling::uncertainty::OUTPUTS
        .iter()
        .map(|output| format!("{} [{}]", output.name, output.units));
    let mut head = heads(prediction, &["V [m/s]"]);
    head.extend(outputs);
    let mut rows = Vec::new();
    for value in prediction.query.pressing.values() {
        for rate in &prediction.query.slip_rates {
            let cell = rows.len();
            let mut row = vec![format!("{value:.3e}"), rate.to_string()];
            row.extend((0..head.len() - 2).map(|output| format!("{:.2e}", propagated.std(cell, output))));
            rows.push(row);
        }
    }
    page.push_str("<h2>Standard deviations from uncertain parameters</h2>\n<ul>\n");
    for uncertain in &propagated.parameters {
        let std = uncertain.std.map_or("another table".into(), |std| format!("± {std:e}"));
        let _ = writeln!(page, "<li>{} {std}</li>", escaped(&uncertain.key));
    }
    page.push_str("</ul>\n");
    table(page, &head, &rows);
}

fn comparisons(page: &mut String, prediction: &Prediction) {
    if prediction.comparisons.is_empty() {
        return;
    }
    let head = heads(prediction, &["model", "asperities", "μ static", "μ sliding", "real area fraction"]);
    let mut rows = Vec::new();
    for (row, value) in prediction.query.pressing.values().iter().enumerate() {
        for comparison in &prediction.comparisons {
            let cell = &comparison.friction[row];
            rows.push(vec![
                format!("{value:.3e}"),
                comparison.model.clone(),
                comparison.description.to_string(),
                format!("{:.4}", cell.mu_static.value),
                format!("{:.4}", cell.sliding.mu.value),
                format!("{:.3e}", cell.sliding.area_fraction.value),
            ]);
        }
    }
    page.push_str("<h2>Models of the literature</h2>\n");
    table(page, &head, &rows);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::{Settings, predict};
    use crate::integral::test_laws::PowerLaw;
    use crate::surface::file::SurfaceFile;
    use std::path::Path;

    #[test]
    fn the_report_is_one_well_formed_file() {
        let text = "surface = { asperity_density = 1e10, asperity_radius = 1e-4, \
                    heights = { distribution = \"gaussian\", std = 1e-6 } } # a < b & c\n\
                    query = { pressure = [1e6, 1e7], slip_rate = [0.05, 0.2, 1.0, 3.0] }\n";
        let file = SurfaceFile::parse(Path::new("surface.toml"), text.into()).unwrap();
        let law = PowerLaw {
            history: |rate, _, _| 0.25 + 0.75 / (1.0 + (rate / 0.2f64).powi(8)).powf(0.125),
            ..PowerLaw::hertz()
        };
        let mut prediction =
            predict(&law, &file.surface, &file.query, &Settings::default(), &|_, _| ()).unwrap();
        prediction.warnings.push("less < more".into());
        let origin = Origin { surface: text, table: "t.nc", command: "roughsurface predict" };
        let page = html(&prediction, &origin);
        for wanted in [
            "Warning: less &lt; more",
            "# a &lt; b &amp; c",
            "Share of the contacts",
            "flash-heating fit (lines)",
            "dμ/d ln V",
            "No adhesion",
            "Greenwood",
        ] {
            assert!(page.contains(wanted), "{wanted}");
        }
        // Nothing is fetched from anywhere.
        for foreign in ["<script", "<link", "src=", "@import", "url(http"] {
            assert!(!page.contains(foreign), "{foreign}");
        }
        // Every element is closed: as XML, but for the two void ones of the head.
        let body = page.replace("<!DOCTYPE html>", "").replace("<meta charset=\"utf-8\">", "");
        roxmltree::Document::parse(&body).unwrap();
    }
}
