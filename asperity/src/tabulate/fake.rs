//! A stand-in for the simulation in tests of the tabulation, able to fail on demand.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::Simulator;
use crate::scene::Scene;
use crate::simulate::outcome::Outcome;
use crate::simulate::{SimulationError, Watch, fake};

/// Counts its presses and fails at the given cells.
#[derive(Default)]
pub struct Fake {
    /// Interferences in the order in which they were pressed.
    pub presses: Mutex<Vec<f64>>,
    pub slides: AtomicUsize,
    /// Most threads that a slide was divided among.
    pub threads: AtomicUsize,
    /// Press fails at this interference.
    pub press_fails: Option<f64>,
    /// Slide fails at this slip rate.
    pub slide_fails: Option<f64>,
    /// Slide panics at this slip rate.
    pub slide_panics: Option<f64>,
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
        self.threads.fetch_max(rayon::current_num_threads(), Ordering::Relaxed);
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
                partial: Some(Box::new(fake::outcome(&scene))),
            });
        }
        Ok(fake::outcome(&scene))
    }
}
