//! Small or finite strain: by the plastic strain that a slide reaches on a coarse mesh.
//!
//! Finite strain changes friction by about as much as the largest plastic strain (see [`crate::simulate::accuracy::modelling_error`]), so small
//! strain will do as long as that is far below the accuracy asked for.

use std::sync::{Arc, PoisonError};

use tables::quantity::Quantity;

use crate::scene::Kinematics;
use crate::simulate::outcome::Outcome;
use crate::simulate::{Pressed, Probe, SimulationError, Watch, press, slide_as_pressed};

/// Plastic strain over the asked accuracy up to which strain is taken to be small. With twice or four times as much a
/// table of 4340 steel took 1.2 and 2.3 times as long: what small strain leaves out made runs be repeated.
const SMALL_SHARE: f64 = 0.05;

/// Slides at small strain if that is accurate enough by a coarse slide, else at finite strain. What
/// is left out, or what it changes, is noted in the outcome.
pub fn slide_as_strained(
    pressed: &Pressed,
    slip_rate: f64,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    let small = Probe::new(pressed, slip_rate, watch)?;
    let strain = small.plastic_strain();
    if strain <= SMALL_SHARE * pressed.scene.numerics.accuracy {
        return slide_as_pressed(pressed, slip_rate, Some(small), watch).map(|mut outcome| {
            outcome.account.notes.push(what_is_left_out(largest_strain(&outcome)));
            outcome
        });
    }
    let finite_watch = FiniteWatch(watch);
    let finite = at_finite_strain(pressed, &finite_watch).and_then(|pressed| {
        let probe = Probe::new(&pressed, slip_rate, &finite_watch)?;
        let note = what_changes(&small, &probe);
        slide_as_pressed(&pressed, slip_rate, Some(probe), &finite_watch).map(|mut outcome| {
            outcome.account.notes.push(note);
            outcome
        })
    });
    match finite {
        Ok(_) | Err(SimulationError::Cancelled { partial: Some(_) }) => finite,
        // Stopped before it slid at finite strain: the coarse slide at small strain is what there is.
        Err(SimulationError::Cancelled { partial: None }) => {
            slide_as_pressed(pressed, slip_rate, Some(small), watch)
        }
        Err(error) => match slide_as_pressed(pressed, slip_rate, Some(small), watch) {
            Ok(mut outcome) => {
                outcome.account.warnings.push(format!("at small strain, as finite strain failed: {error}"));
                Ok(outcome)
            }
            Err(cancelled @ SimulationError::Cancelled { .. }) => Err(cancelled),
            Err(_) => Err(error),
        },
    }
}

fn largest_strain(outcome: &Outcome) -> f64 {
    outcome.slide.last().map_or(0.0, |step| step.plastic_strain_max)
}

/// The press at finite strain, made once for all slip rates.
fn at_finite_strain(pressed: &Pressed, watch: &dyn Watch) -> Result<Arc<Pressed>, SimulationError> {
    let known = || pressed.finite.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(finite) = &*known() {
        return Ok(finite.clone());
    }
    // Not under the lock: the press itself runs in parallel, and a thread that waits for its parts
    // may be given a slide that asks here. Of two that are made the first stays.
    let mut scene = pressed.scene.clone();
    scene.model.kinematics = Kinematics::Finite;
    let finite = Arc::new(press(&scene, watch)?.recording(pressed.what_is_recorded().clone()));
    Ok(known().get_or_insert(finite).clone())
}

fn what_is_left_out(strain: f64) -> String {
    if strain == 0.0 {
        return "small strain: nothing flows in the slide".into();
    }
    format!(
        "small strain: the plastic strain reaches {strain:.4}; kinematics = \"finite\" would change mu by \
         about that share, which its error includes"
    )
}

fn what_changes(small: &Probe, finite: &Probe) -> String {
    let strain = small.plastic_strain();
    if !(small.complete() && finite.complete()) {
        return format!("finite strain: at small strain the plastic strain reaches {strain:.4}");
    }
    let changes: Vec<String> = [Quantity::Mu, Quantity::MuStatic, Quantity::Load, Quantity::Area]
        .into_iter()
        .filter(|of| small.value(*of) != 0.0)
        .map(|of| {
            let change = 100.0 * (finite.value(of) / small.value(of) - 1.0);
            format!("{} by {change:+.1} %", of.descriptor().name)
        })
        .collect();
    format!(
        "finite strain, as the plastic strain reaches {strain:.4} on a coarse mesh; there it changes {}",
        changes.join(", ")
    )
}

/// Reports press and slide at finite strain as one more slide.
struct FiniteWatch<'a>(&'a dyn Watch);

impl Watch for FiniteWatch<'_> {
    fn progress(&self, stage: &'static str, done: f64, detail: &str) {
        /// Share of the press, about.
        const PRESS: f64 = 0.2;
        let done = if stage == "press" { PRESS * done } else { PRESS + (1.0 - PRESS) * done };
        let detail =
            if detail.is_empty() { "finite strain".into() } else { format!("finite strain: {detail}") };
        self.0.progress("slide", done, &detail);
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
