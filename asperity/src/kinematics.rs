//! Small or finite strain: by the plastic strain that a slide reaches at small strain.

use std::sync::{Arc, PoisonError};

use crate::outcome::{Outcome, Summary};
use crate::scene::Kinematics;
use crate::simulate::{Pressed, SimulationError, Watch, press, slide_as_pressed};
use crate::summary::LARGE_STRAIN;

/// Slides at small strain, and where the plastic strain is large then, presses and slides again at
/// finite strain. What that changes is noted in the outcome.
pub fn slide_as_strained(
    pressed: &Pressed,
    slip_rate: f64,
    watch: &dyn Watch,
) -> Result<Outcome, SimulationError> {
    let small = slide_as_pressed(pressed, slip_rate, watch);
    let strain = match &small {
        Ok(outcome) => largest_strain(outcome),
        Err(SimulationError::NotConverged { partial: Some(partial), .. }) => largest_strain(partial),
        Err(_) => 0.0,
    };
    if strain <= LARGE_STRAIN {
        return small.map(|mut outcome| {
            outcome.account.notes.push(what_is_left_out(strain));
            outcome
        });
    }
    let watch = FiniteWatch(watch);
    let finite =
        at_finite_strain(pressed, &watch).and_then(|pressed| slide_as_pressed(&pressed, slip_rate, &watch));
    match (small, finite) {
        (Ok(small), Ok(mut finite)) => {
            finite.account.notes.push(what_changed(strain, &small.summary, &finite.summary));
            finite.account.wall_time += small.account.wall_time;
            Ok(finite)
        }
        (Err(_), Ok(mut finite)) => {
            finite.account.notes.push(format!(
                "finite strain: at small strain the slide failed at a plastic strain of {strain:.2}"
            ));
            Ok(finite)
        }
        (Ok(small), Err(SimulationError::Cancelled { partial: None })) => {
            Err(SimulationError::Cancelled { partial: Some(Box::new(small)) })
        }
        (_, Err(cancelled @ SimulationError::Cancelled { .. })) => Err(cancelled),
        (Ok(mut small), Err(error)) => {
            small.account.warnings.push(format!("at small strain, as finite strain failed: {error}"));
            Ok(small)
        }
        (Err(error), Err(_)) => Err(error),
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
    let finite = Arc::new(press(&scene, watch)?);
    Ok(known().get_or_insert(finite).clone())
}

fn what_is_left_out(strain: f64) -> String {
    if strain == 0.0 {
        return "small strain: nothing flows in the slide".into();
    }
    // mu of a slide without heat fell by 2.2, 3.8 and 6.0 % at strains of 0.028, 0.051 and 0.083
    // (4340 steel at 20, 50 and 100 omega_c).
    format!(
        "small strain: the plastic strain reaches {strain:.3}; kinematics = \"finite\" would change mu by \
         about that share"
    )
}

fn what_changed(strain: f64, small: &Summary, finite: &Summary) -> String {
    let change = |of: fn(&Summary) -> f64| 100.0 * (of(finite) / of(small) - 1.0);
    format!(
        "finite strain, as the plastic strain reached {strain:.2} at small strain: mu {:+.1} %, mu_static \
         {:+.1} %, P {:+.1} %, A {:+.1} %",
        change(|s| s.mu.value),
        change(|s| s.mu_static.value),
        change(|s| s.load.value),
        change(|s| s.area.value)
    )
}

/// Reports press and slide at finite strain as one more slide.
struct FiniteWatch<'a>(&'a dyn Watch);

impl Watch for FiniteWatch<'_> {
    fn progress(&self, stage: &'static str, done: f64, _detail: &str) {
        /// Share of the press, about.
        const PRESS: f64 = 0.2;
        let done = if stage == "press" { PRESS * done } else { PRESS + (1.0 - PRESS) * done };
        self.0.progress("slide", done, "finite strain");
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
