//! A prediction as one HTML file: charts, figures, numbers, parameters, errors and warnings.
//!
//! Without script, style sheet, font or picture from elsewhere: the file is
//! self-contained.

mod charts;

use crate::friction::regime::regime;
use crate::output::cutoffs;
use crate::output::figure::{chosen, figure};
use crate::output::origin::Origin;
use crate::output::rate_laws;
use crate::output::result_tables::{Rows, compared, parameters, quantities};
use crate::sampling::case::Results;
use crate::sampling::uncertainty::VariedParameter;
use crate::surface::query::{ContactLife, LoadingControl};
use std::fmt::Write;
use tables::figures::escaped;

const STYLE: &str = "body{font-family:sans-serif;max-width:76em;margin:2em auto;padding:0 1em;color:#111;line-height:1.4}\
table{border-collapse:collapse;margin:1em 0;display:block;overflow-x:auto}\
th,td{border-bottom:1px solid #bbb;padding:.25em .7em;text-align:right;white-space:nowrap}\
th:first-child,td:first-child{text-align:left}pre{background:#f4f4f4;padding:1em;overflow-x:auto}\
svg{max-width:100%;height:auto}fieldset{margin:.5em 0}fieldset label{margin-right:1.2em}.warning{border-left:.4em solid #d55e00;padding:.2em .8em;margin:.5em 0;background:#fbf1ea}";

/// Limits of the model.
const CAVEATS: [&str; 6] = [
    "Asperities do not interact: above a real contact area of some 5 % of the nominal one they do, which changes the separation at a given pressure.",
    "No adhesion: the model does not hold for loads below the pull-off force of the summits.",
    "No wear: heights and radii stay what they are; running-in and polishing change them.",
    "No third body: no oxide, transfer layer, lubricant, gouge or debris between the surfaces.",
    "The counterface is smooth: for two rough surfaces, heights and curvatures add up.",
    "Errors are those of the asperity law, with one sign in all asperities, of interpolation and of \
     quadrature; modelling errors are not included.",
];

const CITATIONS: [&str; 6] = [
    "Thermomechanical modeling and transient analysis of sliding contacts between an elastic-plastic asperity and a rigid isothermal flat (2014): the model of one asperity",
    "Wu, Shi & Polycarpou, An elastic-plastic spherical contact model under combined normal and tangential loading, J. Appl. Mech. 79, 051001 (2012)",
    "J. A. Greenwood & J. B. P. Williamson, Contact of nominally flat surfaces, Proc. R. Soc. A 295, 300 (1966), doi 10.1098/rspa.1966.0242",
    "J. R. Rice, Heating and weakening of faults during earthquake slip, J. Geophys. Res. 111, B05311 (2006), doi 10.1029/2005JB004006",
    "N. M. Beeler, T. E. Tullis & D. L. Goldsby, Constitutive relationships and physical basis of fault strength due to flash heating, J. Geophys. Res. 113, B01401 (2008), doi 10.1029/2007JB004988",
    "Y. Ida, Cohesive force across the tip of a longitudinal-shear crack and Griffith's specific surface energy, J. Geophys. Res. 77, 3796 (1972), doi 10.1029/JB077i020p03796",
];

/// Most rows of a table in the page, so that the page stays below 2 MB.
const MOST_ROWS: usize = 400;

const RATE_LAW: &str = "<p>The law that is chosen at each pressure; below it the form of flash heating, with μ<sub>w</sub> as mu_inf and V<sub>w</sub> as V*.</p>\n";

/// Columns of the results: quantity and heading.
const COLUMNS: [(&str, &str); 20] = [
    ("mu_static", "μ static"),
    ("mu", "μ sliding"),
    ("mu_steady", "μ steady"),
    ("dmu_dlnV", "dμ/d ln V"),
    ("G", "G [J/m²]"),
    ("G_real_area", "G per real area [J/m²]"),
    ("G_weakening", "G weakening [J/m²]"),
    ("G_weakening_real_area", "G weakening per real area [J/m²]"),
    ("weakening_distance", "D_w [m]"),
    ("real_area_fraction", "real area fraction"),
    ("temperature_mean", "T mean [K]"),
    ("temperature_max", "T max [K]"),
    ("separation_sliding", "separation [m]"),
    ("elastic_load_fraction", "load, elastic"),
    ("elastic_plastic_load_fraction", "load, elastic-plastic"),
    ("fully_plastic_load_fraction", "load, fully plastic"),
    ("elastic_fraction", "contacts, elastic"),
    ("plastic_fraction", "contacts, plastic"),
    ("melting_fraction", "contacts, melting"),
    ("outside_table_fraction", "outside table"),
];

/// The report of a prediction.
pub fn html(results: &Results, origin: &Origin) -> String {
    let prediction = &results.prediction;
    let hold = match prediction.query.control {
        LoadingControl::Load => "nominal load",
        LoadingControl::Separation => "separation",
    };
    let life = match prediction.query.contact_life {
        ContactLife::Diameters(diameters) => format!("{diameters} contact diameters"),
        ContactLife::Steady => "unlimited".into(),
    };
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <title>Friction of a rough surface</title>\n<style>{STYLE}{}</style>\n</head>\n<body>\n\
         <h1>Friction of a rough surface</h1>\n\
         <p>Material: {}. Asperity law: {}. Held during the slide: {hold}. Life of a contact: {life}. Plasticity index ψ = √(σ<sub>s</sub>/ω<sub>c</sub>) \
         = {:.3}: {}.</p>\n",
        charts::STYLE,
        material(origin),
        escaped(&prediction.law),
        prediction.plasticity_index,
        regime(prediction.plasticity_index)
    );
    if prediction.warnings.is_empty() {
        page.push_str("<p>No warnings.</p>\n");
    }
    for warning in &prediction.warnings {
        let _ = writeln!(page, "<p class=\"warning\">Warning: {}</p>", escaped(&warning.to_string()));
    }
    page.push_str(&charts::html(results));
    let svg = figure(results).svg();
    // The XML declaration is for a separate file only.
    let picture = svg.find("<svg").map_or("", |start| &svg[start..]);
    let _ = writeln!(page, "<h2>Figures</h2>\n<div>{picture}</div>");
    let note = "<p>Value ± estimated absolute error.</p>\n";
    table(&mut page, "Results", note, &quantities(results, &COLUMNS));
    table(&mut page, "Rate dependence", RATE_LAW, &rate_laws::rows(results));
    page.extend(rate_laws::footnotes(results).map(|line| format!("<p>{}</p>\n", escaped(&line))));
    table(&mut page, "Influence of the cut-off of the topography", "", &cutoffs::rows(results));
    if let Some(propagated) = &results.propagated {
        let parameter = |varied: &VariedParameter| {
            let std = varied.std.map_or("another table".into(), |std| format!("± {std:e}"));
            format!("{} {std}", varied.key)
        };
        list(&mut page, "Uncertain parameters", propagated.parameters.iter().map(parameter));
    }
    table(&mut page, "Standard deviations from uncertain parameters (± is 95 %)", "", &parameters(results));
    table(&mut page, "Models of the literature", "", &compared(results));
    list(&mut page, "What is left out", CAVEATS.iter().map(ToString::to_string));
    let _ = write!(
        page,
        "<h2>Input</h2>\n<p>Table: {}. Made: <code>{}</code>, roughsurface {}.</p>\n<pre>{}</pre>\n",
        escaped(origin.table),
        escaped(origin.history),
        env!("CARGO_PKG_VERSION"),
        escaped(origin.surface)
    );
    if !prediction.request.is_empty() {
        let _ = writeln!(page, "<p>Request of the table:</p>\n<pre>{}</pre>", escaped(&prediction.request));
    }
    list(&mut page, "To cite", CITATIONS.iter().map(ToString::to_string));
    page.push_str("</body>\n</html>\n");
    page
}

/// Sentence on the source of the constants of the material.
fn material(origin: &Origin) -> String {
    match origin.table.strip_prefix("model:") {
        Some(model) => {
            format!("that of the section [material] of the input, in the closed form {}", escaped(model))
        }
        None => format!("that of the table {} (constants under Input)", escaped(origin.table)),
    }
}

fn list(page: &mut String, title: &str, items: impl Iterator<Item = String>) {
    let items: String = items.map(|item| format!("<li>{}</li>\n", escaped(&item))).collect();
    let _ = write!(page, "<h2>{title}</h2>\n<ul>\n{items}</ul>\n");
}

/// A table under a title and a line of HTML, of a choice of the rows if there are many; empty without rows.
fn table(page: &mut String, title: &str, note: &str, rows: &Rows) {
    let Some((head, rows)) = rows.split_first() else { return };
    let shown = chosen(rows.len(), MOST_ROWS);
    let part = match rows.len() - shown.len() {
        0 => String::new(),
        _ => format!("<p>{} of {} rows; the NetCDF file has all.</p>\n", shown.len(), rows.len()),
    };
    let line = |cells: &[String], tag: &str| {
        let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows: String = shown.iter().map(|&row| line(&rows[row], "td")).collect();
    let _ = write!(page, "<h2>{title}</h2>\n{note}{part}<table>\n{}{rows}</table>\n", line(head, "th"));
}
