//! The numbers that the worked examples state are those of their files.

use roughsurface::friction::regime::regime;
use roughsurface::friction::{Friction, Prediction, Settings, predict};
use roughsurface::integral::law_source::LawSource;
use roughsurface::sampling::uncertainty::propagate;
use roughsurface::surface::file::SurfaceFile;
use std::path::Path;

const TEXT: &str = include_str!("../../src/worked_examples.md");

fn scene(name: &str) -> SurfaceFile {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes");
    SurfaceFile::read(&scenes.join(name)).unwrap()
}

fn predicted(file: &SurfaceFile, model: &str) -> Prediction {
    let law = LawSource::open(model, file.material.as_ref(), None, false).unwrap().law;
    predict(law.as_ref(), &file.surface, &file.query, &Settings::default(), &|_, _| ()).unwrap()
}

/// Rows of the tables under a heading of which every cell is a number; the first is the pressure.
fn rows(heading: &str) -> Vec<Vec<f64>> {
    let section = TEXT.split("\n# ").find(|section| section.starts_with(heading)).unwrap();
    let numbers = |line: &str| {
        let cells = line.strip_prefix("| ")?.strip_suffix(" |")?;
        cells.split(" | ").map(|cell| cell.parse().ok()).collect()
    };
    section.lines().filter_map(numbers).collect()
}

/// The quantities in the columns after the pressure, to the digits written.
fn assert_rows(heading: &str, prediction: &Prediction, columns: &[fn(&Friction) -> f64]) {
    let rows = rows(heading);
    let pressures = prediction.query.loading.values();
    assert_eq!(rows.len(), pressures.len(), "{heading}");
    for ((row, pressure), cells) in rows.iter().zip(pressures).zip(&prediction.friction) {
        assert_eq!(row[0], *pressure);
        assert_eq!(row.len(), 1 + columns.len());
        for (written, quantity) in row[1..].iter().zip(columns) {
            // Three to four significant digits.
            let value = quantity(&cells[0]);
            assert!((value / written - 1.0).abs() < 2e-3, "{heading} at {pressure:e}: {value} {written}");
        }
    }
}

#[test]
fn brake_disc() {
    let file = scene("brake-disc.toml");
    let prediction = predicted(&file, "model:jackson-green");
    assert!((prediction.plasticity_index - 19.6).abs() < 0.05);
    assert!(regime(prediction.plasticity_index).starts_with("fully plastic"));
    assert_rows(
        "Brake disc",
        &prediction,
        &[
            |cell| cell.sliding.mu.value,
            |cell| cell.sliding.area_fraction.value,
            |cell| cell.sliding.contact_density.value,
        ],
    );
    assert!(
        prediction.friction.iter().flatten().all(|cell| (cell.contacts.shares.plastic - 0.99).abs() < 0.005)
    );
    let propagated =
        propagate(&file, ("model:jackson-green", false), &prediction, &Settings::default(), &|_, _| ())
            .unwrap();
    let std = propagated.std(0, 0);
    assert!((std - 0.002).abs() < 5e-4, "{std}");
}

#[test]
fn bearing_steel() {
    let file = scene("bearing-steel.toml");
    let prediction = predicted(&file, "model:jackson-green");
    assert!((prediction.plasticity_index - 1.98).abs() < 0.005);
    assert_rows(
        "Bearing steel",
        &prediction,
        &[
            |cell| cell.sliding.mu.value,
            |cell| cell.sliding.area_fraction.value,
            |cell| cell.contacts.shares.elastic,
        ],
    );
    for (model, from, to) in [("model:hertz", 0.324, 0.237), ("model:brizmer", 0.611, 0.473)] {
        let other = predicted(&file, model);
        let [light, heavy] = [0, 3].map(|row: usize| other.friction[row][0].sliding.mu.value);
        assert!((light - from).abs() < 6e-4 && (heavy - to).abs() < 6e-4, "{model}: {light} {heavy}");
    }
}

#[test]
fn granite_fault_without_heat() {
    let prediction = predicted(&scene("granite-fault.toml"), "model:constant-shear");
    assert!((prediction.plasticity_index - 0.83).abs() < 0.005);
    for (cells, mu) in prediction.friction.iter().zip([0.819, 0.689, 0.608]) {
        assert!(cells.iter().all(|cell| (cell.sliding.mu.value - mu).abs() < 6e-4));
    }
}
