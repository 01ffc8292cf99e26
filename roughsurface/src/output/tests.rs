//! One battery for every output: files are read again, and every quantity is in them.

use super::export::{ExportError, FrictionTable};
use super::{Origin, Results, figure, friction_file, report, sample_file, summary, summary_json};
use crate::friction::quantities::{QUANTITIES, Source};
use crate::friction::warning::Warning;
use crate::friction::{Prediction, Settings, predict};
use crate::integral::test_laws::PowerLaw;
use crate::sampling::finite_surface::{Sampling, sample};
use crate::sampling::scatter::Scatter;
use crate::surface::file::SurfaceFile;
use std::path::Path;
use tables::netcdf::DatasetReader;

const SURFACE: &str = "# a < b & c\nsurface = { asperity_density = 1e10, asperity_radius = 1e-4, \
                       heights = { distribution = \"exponential\", std = 1e-6 } }\n[query]\n";
const ORIGIN: Origin =
    Origin { surface: SURFACE, table: "model:test", history: "2026-01-01T00:00:00Z: roughsurface predict" };

fn surface(query: &str) -> SurfaceFile {
    SurfaceFile::parse(Path::new("surface.toml"), format!("{SURFACE}{query}")).unwrap()
}

fn prediction(query: &str) -> Prediction {
    let history = |rate: f64, _, _| 0.25 + 0.75 / (1.0 + (rate / 0.2f64).powi(8)).powf(0.125);
    let law = PowerLaw { relative_error: 0.01, history, ..PowerLaw::hertz() };
    let file = surface(query);
    predict(&law, &file.surface, &file.query, &Settings::default(), &|_, _| ()).unwrap()
}

/// Writes the prediction, reads it with `read`, and returns the bytes.
fn written(results: &Results, read: impl Fn(&DatasetReader)) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("friction.nc");
    friction_file::write(&path, results, &ORIGIN).unwrap();
    read(&DatasetReader::open(&path).unwrap());
    std::fs::read(&path).unwrap()
}

#[test]
fn every_quantity_is_in_the_file_and_in_the_json() {
    let results = Results::from(prediction("pressure = [1e5, 1e6]\nslip_rate = [0.1, 1.0, 10.0]"));
    let prediction = &results.prediction;
    let json = summary_json::json(&results);
    let bytes = written(&results, |file| {
        assert_eq!(file.coordinate("pressure").unwrap(), [1e5, 1e6]);
        assert_eq!(file.coordinate("slip").unwrap(), prediction.slip);
        for quantity in QUANTITIES.iter().filter(|quantity| quantity.name != "pressure") {
            let name = quantity.name;
            let values = file.reals(name, &[2, 3]).unwrap();
            let is_share = matches!(quantity.source, Source::Share(_));
            for (index, cell) in prediction.friction.iter().flatten().enumerate() {
                let expected = quantity.estimate(cell);
                assert!(values[index] == expected.value || expected.value.is_nan(), "{name}");
                let in_json = &json["friction"][index][name];
                let finite = |value: f64| Some(value).filter(|value| value.is_finite());
                assert_eq!(in_json["value"].as_f64(), finite(expected.value), "{name}");
                assert!(in_json.is_null() || in_json["unit"] == quantity.unit, "{name}");
                if !is_share {
                    let error = file.reals(&format!("{name}_error"), &[2, 3]).unwrap()[index];
                    assert!(error == expected.error || expected.error.is_nan(), "{name}");
                }
            }
        }
        let history = file.reals("mu_history", &[2, 3, prediction.slip.len()]).unwrap();
        assert_eq!(history[0], prediction.friction[0][0].mu_history[0].value);
        assert_eq!(file.reals("V_w", &[2]).unwrap().len(), 2);
        assert_eq!(file.attribute_text("surface").unwrap(), SURFACE);
    });
    // The same prediction gives the same bytes.
    assert!(bytes == written(&results, |_| ()));
    let text = summary::text(&results);
    // Title, results, laws, and why some of them are not reliable.
    let unreliable = text.lines().filter(|line| line.starts_with('[')).count();
    assert_eq!(text.lines().count(), 2 + 7 + 2 + 5 + unreliable);
    assert!((1..=unreliable).all(|number| text.matches(&format!("[{number}]")).count() > 1), "{text}");
    // No summit is outside what the law covers.
    assert!(text.contains("T max [K]") && !text.contains("outside table"), "{text}");
}

#[test]
fn separations_are_a_coordinate_too_and_missing_fits_are_fill_values() {
    let results = prediction("separation = [0.0, 2e-6]\nslip_rate = [0.1]").into();
    written(&results, |file| {
        assert_eq!(file.coordinate("separation").unwrap(), [0.0, 2e-6]);
        assert_eq!(file.reals("pressure", &[2, 1]).unwrap().len(), 2);
        assert!(file.reals("mu_0", &[2]).unwrap().iter().all(|value| value.is_nan()));
    });
}

#[test]
fn every_surface_and_its_statistics_are_written() {
    let file = surface("pressure = [1e6, 1e7]\nslip_rate = [1.0]");
    let (law, settings) = (PowerLaw::hertz(), Settings::default());
    let sampling = Sampling { asperities: 100, realizations: 20, seed: u64::MAX, slip: Some(1e-3) };
    let samples = sample(&law, &file.surface, &file.query, &sampling, &settings, &|_, _| ()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mc.nc");
    sample_file::write(&path, &samples, &ORIGIN).unwrap();
    let read = DatasetReader::open(&path).unwrap();
    assert_eq!(read.reals("mu", &[2, 1, 20]).unwrap()[21], samples.states[1][1].state.mu.value);
    let mean = read.reals("mu_mean", &[2, 1]).unwrap();
    assert_eq!(mean[1], Scatter::of(samples.states[1].iter().map(|one| one.state.mu.value)).mean);
    for name in ["Q", "pressure_sliding", "separation_sliding", "real_area_fraction", "contacts"] {
        assert!(read.reals(&format!("{name}_std"), &[2, 1]).is_ok(), "{name}");
    }
    assert_eq!(read.attribute_text("seed").unwrap(), u64::MAX.to_string());
    assert_eq!(sample_file::text(&samples).lines().count(), 4);
    assert_eq!(sample_file::json(&samples)["friction"][1]["pressure"], 1e7);
}

#[test]
fn the_report_is_one_well_formed_page_without_references_outside() {
    let mut results = Results::from(prediction("pressure = [1e6]\nslip_rate = [0.01, 0.1, 0.5, 2.0]"));
    results.prediction.warnings.push(Warning::CellsMissing { cells: vec!["less < more".into()] });
    assert!(figure::figure(&results).svg().contains("Share of the contacts"));
    let page = report::html(&results, &ORIGIN);
    for wanted in [
        "slip rate: less &lt; more",
        "# a &lt; b &amp; c",
        "Share of the contacts",
        "rate law (lines)",
        "dμ/d ln V",
        "No adhesion",
        "Greenwood",
    ] {
        assert!(page.contains(wanted), "{wanted}");
    }
    for chart in ["over-rate", "over-load", "over-slip"] {
        assert!(
            page.contains(&format!("<div id=\"{chart}\">"))
                && page.contains(&format!("data-chart=\"{chart}\""))
        );
    }
    assert!(page.contains("Copyright (c) 2022 Leon Sorokin") && page.len() < 2_000_000);
    for foreign in ["<script src", "<link", " src=", "@import", "url(", "fetch(", "XMLHttpRequest"] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    // As XML, but for the declaration and a void element of the head.
    let body = page.replace("<!DOCTYPE html>", "").replace("<meta charset=\"utf-8\">", "");
    let document = roxmltree::Document::parse(&body).unwrap();
    let data = document.descendants().find(|node| node.attribute("id") == Some("data")).unwrap();
    let data: serde_json::Value = serde_json::from_str(data.text().unwrap()).unwrap();
    assert_eq!(data["slip_rates"], serde_json::json!([0.01, 0.1, 0.5, 2.0]));
    assert_eq!(data["mu_history"][0][3].as_array().unwrap().len(), data["slip"].as_array().unwrap().len());
    let quantities = data["quantities"].as_array().unwrap();
    assert_eq!(quantities.len(), QUANTITIES.len());
    for (quantity, charted) in QUANTITIES.iter().zip(quantities) {
        for (cell, value) in
            results.prediction.friction[0].iter().zip(charted["values"][0].as_array().unwrap())
        {
            let expected = quantity.estimate(cell).value;
            // Five digits.
            let off = value.as_f64().map(|value| (value - expected).abs());
            assert!(
                off.map_or(!expected.is_finite(), |off| off <= 1e-4 * expected.abs()),
                "{}",
                quantity.name
            );
        }
    }
}

#[test]
fn a_step_of_the_slip_rate_is_in_every_output() {
    let query = "pressure = [1e5, 1e6]\nslip_rate = 1.0\nrate_step = { before = 0.1, after = 1.0 }";
    let results = Results::from(prediction(query));
    let step = results.prediction.rate_step.clone().unwrap();
    written(&results, |file| {
        assert_eq!(file.coordinate("slip_since_step").unwrap(), step.slip);
        let mu = file.reals("mu_since_step", &[2, step.slip.len()]).unwrap();
        assert_eq!(mu[step.slip.len()], step.rows[1].mu[0].value);
        for (name, of) in [("mu_before_step", step.rows[0].before), ("mu_after_step", step.rows[0].after)] {
            assert_eq!(file.reals(name, &[2]).unwrap()[0], of.value);
        }
    });
    let json = summary_json::json(&results);
    assert_eq!(
        json["rate_step"]["rows"][1]["mu_after_step"]["value"].as_f64(),
        Some(step.rows[1].after.value)
    );
    assert!(summary::text(&results).contains("Step of the slip rate"));
    assert!(figure::figure(&results).svg().contains("Step from 0.1 to 1 m/s"));
}

#[test]
fn an_export_of_no_file_is_refused() {
    assert!(matches!(FrictionTable::read(&[]), Err(ExportError::NoFile)));
}
