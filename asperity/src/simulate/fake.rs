//! Outcomes for tests of the callers of the simulation: without computation, smooth, deterministic.

use std::f64::consts::PI;

use tables::quantity::{Estimate, History, Quantity, Scalars};

use crate::scene::Scene;
use crate::scene::tests::of_preset;
use crate::simulate::outcome::{
    Account, ContactGrid, ContactStatus, ErrorBudget, InceptionCriterion, Note, Outcome, Snapshot, Warning,
};

/// A valid scene.
pub fn scene(interference: f64, slip_rate: f64) -> Scene {
    let changes = [format!("loading.interference={interference}"), format!("loading.slip_rate={slip_rate}")];
    of_preset("steel-4340", &changes.each_ref().map(String::as_str))
}

fn estimate(value: f64) -> Estimate {
    Estimate { value, error: 0.01 * value.abs() }
}

/// Contact radius a ∝ √ω, m, and load P ∝ ω^1.5, N.
fn contact(scene: &Scene) -> (f64, f64) {
    let omega = scene.loading.interference;
    (1e-5 * omega.sqrt(), 0.7 * omega.powf(1.5))
}

/// State after a share of the slide: μ rises to a peak and falls with the slip rate, and with the initial
/// temperature above 298 K.
fn state(scene: &Scene, share: f64, quantity: Quantity) -> f64 {
    let (radius, load) = contact(scene);
    let (rate, initial) = (scene.loading.slip_rate, scene.loading.temperature);
    let mu =
        0.3 * (1.0 - (initial - 298.0) / 2000.0) * (1.0 - (-20.0 * share).exp()) / (1.0 + 0.2 * rate * share);
    match quantity {
        Quantity::Slip | Quantity::SlipAccumulated => share * scene.loading.slip_distance * radius,
        Quantity::Time => share,
        Quantity::Friction => mu * load,
        Quantity::Load => load,
        Quantity::Mu => mu,
        Quantity::Area => PI * radius * radius * (1.0 + 0.1 * share),
        Quantity::StickFraction => (1.0 - 4.0 * share).max(0.0),
        Quantity::StrengthMobilised => (4.0 * share).min(1.0),
        Quantity::TemperatureMax => initial + 500.0 * share.sqrt() * rate,
        Quantity::TemperatureMean => initial + 300.0 * share.sqrt() * rate,
        _ => 0.0,
    }
}

fn scalar(scene: &Scene, quantity: Quantity) -> f64 {
    let (radius, load) = contact(scene);
    match quantity {
        Quantity::MuStatic | Quantity::MuPeak => state(scene, 0.2, Quantity::Mu),
        Quantity::MuMean | Quantity::MuSteady => state(scene, 1.0, Quantity::Mu),
        Quantity::FrictionStatic => state(scene, 0.2, Quantity::Friction),
        Quantity::LoadPress => load,
        Quantity::AreaPress => PI * radius * radius,
        Quantity::ContactRadius => radius,
        Quantity::EnergyRelease => 2.0,
        Quantity::EnergyWeakening => 3.0,
        Quantity::HeatPartition => 0.5,
        Quantity::InceptionSlip => 0.3 * radius,
        quantity => state(scene, 1.0, quantity),
    }
}

/// A smooth outcome.
pub fn outcome(scene: &Scene) -> Outcome {
    let (radius, load) = contact(scene);
    let mut slide = History::new(&Quantity::RUN_HISTORIES);
    (1..=40).for_each(|k| slide.push(|quantity| state(scene, (k as f64 / 40.0).powi(2), quantity)));
    let mut press = History::new(&Quantity::PRESS_HISTORIES);
    for share in [0.25, 0.5, 0.75, 1.0f64] {
        press.push(|quantity| match quantity {
            Quantity::InterferencePress => scene.loading.interference * share,
            Quantity::LoadPress => load * share.powf(1.5),
            _ => PI * radius * radius * share,
        });
    }
    Outcome {
        interference: scene.loading.interference,
        critical_interference: 1e-7,
        press,
        slide,
        scalars: Scalars::from_fn(|quantity| estimate(scalar(scene, quantity))),
        inception: InceptionCriterion::FullSlip,
        steady: true,
        budget: ErrorBudget::default(),
        counterface_rise: None,
        grid: ContactGrid { theta: vec![0.0, 1.0], r: vec![0.0, 1e-5, 2e-5] },
        snapshots: vec![Snapshot {
            slip: 1e-5,
            time: 0.1,
            status: vec![ContactStatus::Slip; 6],
            pressure: vec![1e9; 6],
            shear: vec![1e8; 6],
            temperature: vec![400.0; 6],
            slip_distance: vec![1e-6; 6],
        }],
        body: None,
        account: Account {
            notes: vec![Note::Remeshed { radius_ratio: 2.0, room: 3.0 }],
            warnings: vec![Warning::ErrorsUnknown, Warning::NotSliding],
            ..Account::default()
        },
    }
}
