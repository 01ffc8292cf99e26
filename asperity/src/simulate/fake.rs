//! A stand-in for the simulation in tests of what lies around it: instantaneous, smooth,
//! deterministic, and able to fail on demand.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use tables::law::Estimate;

use crate::scene::Scene;
use crate::scene::file::parse_scene;
use crate::simulate::outcome::{
    Account, ContactGrid, ContactStatus, ErrorBudget, InceptionCriterion, Outcome, PressStep, SlideStep,
    Note, Snapshot, Summary, Warning,
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
        let state = |share: f64| {
            let mu = 0.3 * (1.0 - (initial - 298.0) / 2000.0) * (1.0 - (-20.0 * share).exp())
                / (1.0 + 0.2 * rate * share);
            SlideStep {
                slip: share * scene.loading.slip_distance * radius,
                time: share,
                friction: mu * load,
                load,
                mu,
                area: area * (1.0 + 0.1 * share),
                stick_fraction: (1.0 - 4.0 * share).max(0.0),
                temperature_max: initial + 500.0 * share.sqrt() * rate,
                temperature_mean: initial + 300.0 * share.sqrt() * rate,
                ..SlideStep::default()
            }
        };
        let slide: Vec<SlideStep> = (1..=40).map(|k| state((k as f64 / 40.0).powi(2))).collect();
        let (peak, end) = (state(0.2), state(1.0));
        Outcome {
            critical_interference: 1e-7,
            press: (1..=4)
                .map(|k| PressStep {
                    interference: omega * k as f64 / 4.0,
                    load: load * (k as f64 / 4.0).powf(1.5),
                    area: area * k as f64 / 4.0,
                })
                .collect(),
            slide,
            budget: ErrorBudget::default(),
            summary: Summary {
                mu: estimate(end.mu),
                mu_static: estimate(peak.mu),
                mu_peak: estimate(peak.mu),
                mu_mean: estimate(end.mu),
                friction: estimate(end.friction),
                friction_static: estimate(peak.friction),
                load: estimate(load),
                load_press: estimate(load),
                area: estimate(end.area),
                area_press: estimate(area),
                contact_radius: estimate(radius),
                energy_release: estimate(2.0),
                energy_weakening: estimate(3.0),
                temperature_max: estimate(end.temperature_max),
                temperature_mean: estimate(end.temperature_mean),
                inception_slip: estimate(0.3 * radius),
                inception: InceptionCriterion::FullSlip,
                levelled: true,
            },
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
