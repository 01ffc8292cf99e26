//! Length of a slide that goes on until friction is steady: that from which on friction of a slide on the coarse mesh, which
//! goes on until its steady value is known (see `steady`), is within the accuracy of that value.

use tables::numbers::rounded;

use super::messages::{Note, RunProgress};
use super::pressed::press_coarsely;
use super::runs::Runner;
use super::{SimulationError, Watch};
use crate::scene::loading::default_slip_distance;
use crate::scene::{Loading, Scene};

/// The scene with the length of its slide in place of `"steady"`, and what is said of it.
pub(crate) fn until_steady(scene: &Scene, watch: &dyn Watch) -> Result<(Scene, Note), SimulationError> {
    let of_length = |slip_distance: f64| {
        let loading = Loading { slip_distance, ..scene.loading.clone() };
        Scene { loading, ..scene.clone() }
    };
    let first = default_slip_distance();
    let pressed = press_coarsely(&of_length(first), watch)?;
    let runner = Runner::new(&pressed, scene.loading.slip_rate, watch)?;
    let [mut coarse, ..] = pressed.resolution.auxiliary();
    let run = loop {
        let progress = RunProgress { kind: "until steady: ", span: (0.0, 0.0), goes_on: true };
        let run = runner.run(&coarse, progress, watch)?;
        if run.is_cancelled() {
            return Err(SimulationError::Cancelled { partial: None });
        }
        let lacks_room = run.outgrown().is_some() || run.steady.is_some_and(|steady| steady.lacks_room());
        if !lacks_room || !runner.conditions.fits(&coarse.wider()) {
            break run;
        }
        coarse = coarse.wider();
    };
    let accuracy = pressed.numerics.accuracy;
    let (level, longest) = run.steady.map_or((first, first), |steady| (steady.level, steady.slip));
    let slip = rounded(level.min(longest).max(first), 2);
    Ok((of_length(slip), Note::UntilSteady { slip, accuracy, is_steady: level.is_finite() }))
}

#[cfg(test)]
mod tests {
    use tables::quantity::Quantity;

    use super::*;
    use crate::scene::tests::of_preset;
    use crate::simulate::{Unwatched, simulate};

    fn steady_scene(slip_rate: &str, accuracy: &str) -> Scene {
        of_preset(
            "steel-4340",
            &[
                "loading.slip_distance=steady",
                "loading.interference=5",
                slip_rate,
                accuracy,
                "counterface.preset=steel-4340",
                "counterface.elastic=false",
            ],
        )
    }

    #[test]
    fn friction_at_the_end_is_steady_within_the_accuracy() {
        let scene = steady_scene("loading.slip_rate=1", "numerics.accuracy=0.05");
        let outcome = simulate(&scene, &Unwatched).unwrap();
        let [end, steady] = [Quantity::Mu, Quantity::MuSteady].map(|quantity| outcome.scalars[quantity]);
        let off = end.value / steady.value - 1.0;
        assert!(off.abs() < 0.05 + steady.error / steady.value, "{end:?} {steady:?}");
        let says =
            |note: &Note| matches!(note, Note::UntilSteady { slip, is_steady: true, .. } if *slip > 2.0);
        assert!(outcome.account.notes.iter().any(says), "{:?}", outcome.account.notes);
    }

    #[test]
    fn without_heat_the_slide_has_the_default_length() {
        let scene = steady_scene("loading.slip_rate=0", "numerics.accuracy=0.1");
        let (found, note) = until_steady(&scene, &Unwatched).unwrap();
        assert_eq!(found.loading.slip_distance, default_slip_distance(), "{note}");
    }
}
