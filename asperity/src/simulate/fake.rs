//! A stand-in for the simulation in tests of what lies around it: instantaneous, smooth,
//! deterministic, and able to fail on demand.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use tables::quantity::{Estimate, History, Quantity, Scalars};

use crate::scene::Scene;
use crate::scene::file::parse_scene;
use crate::simulate::outcome::{
    Account, ContactGrid, ContactStatus, ErrorBudget, InceptionCriterion, Note, Outcome, Snapshot, Warning,
};
use crate::simulate::{SimulationError, Watch};
use crate::tabulate::Simulator;

/// A valid scene.
pub fn scene(interference: f64, slip_rate: f64) -> Scene {
    let text = format!(
        "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
         [loading]\ninterference = {interference}\nslip_rate = {slip_rate}\n"
    );
    parse_scene(&text, "fake", &[]).unwrap()
}

/// Counts its presses and fails where told.
#[derive(Default)]
pub struct Fake {
    /// Interferences in the order in which they were pressed.
    pub presses: Mutex<Vec<f64>>,
    pub slides: AtomicUsize,
    /// Press fails at this interference.
    pub press_fails: Option<f64>,
    /// Slide fails at this slip rate.
    pub slide_fails: Option<f64>,
    /// Slide panics at this slip rate.
    pub slide_panics: Option<f64>,
}

fn estimate(value: f64) -> Estimate {
    Estimate { value, error: 0.01 * value.abs() }
}

impl Fake {
    /// P ∝ ω^1.5 and a ∝ √ω; μ rises to a peak and falls with the slip rate, and with the initial
    /// temperature above 298 K.
    pub fn outcome(scene: &Scene) -> Outcome {
        let (omega, rate) = (scene.loading.interference, scene.loading.slip_rate);
        let (radius, load) = (1e-5 * omega.sqrt(), 0.7 * omega.powf(1.5));
        let initial = scene.loading.temperature;
        let area = std::f64::consts::PI * radius * radius;
        let state = |share: f64, quantity: Quantity| {
            let mu = 0.3 * (1.0 - (initial - 298.0) / 2000.0) * (1.0 - (-20.0 * share).exp())
                / (1.0 + 0.2 * rate * share);
            match quantity {
                Quantity::Slip => share * scene.loading.slip_distance * radius,
                Quantity::Time => share,
                Quantity::Friction => mu * load,
                Quantity::Load => load,
                Quantity::Mu => mu,
                Quantity::Area => area * (1.0 + 0.1 * share),
                Quantity::StickFraction => (1.0 - 4.0 * share).max(0.0),
                Quantity::TemperatureMax => initial + 500.0 * share.sqrt() * rate,
                Quantity::TemperatureMean => initial + 300.0 * share.sqrt() * rate,
                _ => 0.0,
            }
        };
        let mut slide = History::new(&Quantity::RUN_HISTORIES);
        (1..=40).for_each(|k| slide.push(|quantity| state((k as f64 / 40.0).powi(2), quantity)));
        let mut press = History::new(&Quantity::PRESS_HISTORIES);
        for share in [0.25, 0.5, 0.75, 1.0f64] {
            press.push(|quantity| match quantity {
                Quantity::InterferencePress => omega * share,
                Quantity::LoadPress => load * share.powf(1.5),
                _ => area * share,
            });
        }
        let (peak, end) = (|quantity| state(0.2, quantity), |quantity| state(1.0, quantity));
        let scalar = |quantity| match quantity {
            Quantity::MuStatic | Quantity::MuPeak => peak(Quantity::Mu),
            Quantity::MuMean => end(Quantity::Mu),
            Quantity::FrictionStatic => peak(Quantity::Friction),
            Quantity::LoadPress => load,
            Quantity::AreaPress => area,
            Quantity::ContactRadius => radius,
            Quantity::EnergyRelease => 2.0,
            Quantity::EnergyWeakening => 3.0,
            Quantity::InceptionSlip => 0.3 * radius,
            quantity => end(quantity),
        };
        Outcome {
            critical_interference: 1e-7,
            press,
            slide,
            scalars: Scalars::from_fn(|quantity| estimate(scalar(quantity))),
            inception: InceptionCriterion::FullSlip,
            steady: true,
            budget: ErrorBudget::default(),
            grid: ContactGrid { theta: vec![0.0, 1.0], r: vec![0.0, 1e-5, 2e-5] },
            snapshots: vec![Snapshot {
                slip: 1e-5,
                status: vec![ContactStatus::Slip; 6],
                pressure: vec![1e9; 6],
                shear: vec![1e8; 6],
                temperature: vec![400.0; 6],
                slip_distance: vec![1e-6; 6],
            }],
            body: None,
            account: Account {
                notes: vec![Note::Remeshed { growth: 2.0, room: 3.0 }],
                warnings: vec![Warning::ErrorsUnknown, Warning::NotSliding],
                ..Account::default()
            },
        }
    }
}

impl Simulator for Fake {
    type Pressed = Scene;

    fn press(&self, scene: &Scene, watch: &dyn Watch) -> Result<Scene, SimulationError> {
        if watch.cancelled() {
            return Err(SimulationError::Cancelled { partial: None });
        }
        let interference = scene.loading.interference;
        self.presses.lock().unwrap().push(interference);
        if self.press_fails == Some(interference) {
            return Err(SimulationError::Unsupported("this press".into()));
        }
        Ok(scene.clone())
    }

    fn slide(&self, pressed: &Scene, slip_rate: f64, _watch: &dyn Watch) -> Result<Outcome, SimulationError> {
        self.slides.fetch_add(1, Ordering::Relaxed);
        if self.slide_panics == Some(slip_rate) {
            panic!("this slide panics");
        }
        let mut scene = pressed.clone();
        scene.loading.slip_rate = slip_rate;
        if self.slide_fails == Some(slip_rate) {
            return Err(SimulationError::NotConverged {
                stage: "slide",
                at: "s = 1 um".into(),
                reason: "told to".into(),
                partial: Some(Box::new(Self::outcome(&scene))),
            });
        }
        Ok(Self::outcome(&scene))
    }
}
