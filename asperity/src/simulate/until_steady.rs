//! Length of a slide that goes on until friction is steady: that from which on friction of a slide on the coarse mesh, which
//! goes on until its steady value is known (see `steady`), is within the accuracy of that value.

use tables::numbers::rounded;

use super::messages::{Note, RunProgress};
use super::pressed::press_coarsely;
use super::runs::Runner;
use super::steady::has_to_go_on;
use super::{SimulationError, Watch};
use crate::loading::recording::Recording;
use crate::loading::state::SlideState;
use crate::scene::loading::default_slip_distance;
use crate::scene::{Loading, Scene};

/// Share of the slide on the coarse mesh that a slide may have: that on another mesh may end a little before.
const MOST_OF_COARSE_SLIDE: f64 = 0.9;

/// The scene with the length of its slide in place of `"steady"`, and what is said of it.
pub(crate) fn until_steady(scene: &Scene, watch: &dyn Watch) -> Result<(Scene, Note), SimulationError> {
    let of_length = |slip_distance: f64| {
        let loading = Loading { slip_distance, ..scene.loading.clone() };
        Scene { loading, ..scene.clone() }
    };
    let first = default_slip_distance();
    let pressed = press_coarsely(&of_length(first), watch)?;
    let runner = Runner::new(&pressed, scene.loading.slip_rate, watch)?;
    let [coarse, ..] = pressed.resolution.auxiliary();
    let progress = RunProgress { goes_on: true, ..RunProgress::new("until steady: ", (0.0, 0.0)) };
    let run = runner.run_with_room(&coarse, progress)?;
    if watch.cancelled() {
        return Err(SimulationError::Cancelled { partial: None });
    }
    let accuracy = pressed.numerics.accuracy;
    let slides = run.failure.is_none() && run.history.last().is_some_and(SlideState::slides);
    let (slip, is_steady) = match run.steady {
        Some(steady) => {
            let longest = MOST_OF_COARSE_SLIDE * steady.slip;
            (steady.level.min(longest).max(first), steady.level <= longest)
        }
        None => (first, slides && !has_to_go_on(&run.history, accuracy)),
    };
    let slip = rounded(slip, 2);
    Ok((of_length(slip), Note::UntilSteady { slip, accuracy, is_steady }))
}

/// Refuses fields beyond the end of the slide.
pub(super) fn check_fields(recording: &Recording, of_length: &Scene) -> Result<(), SimulationError> {
    let end = of_length.loading.slip_distance;
    recording.slips.iter().find(|slip| **slip > end).map_or(Ok(()), |slip| {
        let reason = format!(
            "fields at a slip of {slip} contact radii: friction is steady, and the slide ends, at {end}"
        );
        Err(SimulationError::Unsupported(reason))
    })
}

#[cfg(test)]
mod tests {
    use tables::quantity::{Quantity, State};

    use super::*;
    use crate::scene::tests::{assert_written_is_read, of_preset, request, sphere};
    use crate::simulate::{Unwatched, press, simulate};

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

    /// It is not yet so after the default length.
    #[test]
    fn friction_at_the_end_is_steady_within_the_accuracy() {
        const ACCURACY: f64 = 0.05;
        let scene = steady_scene("loading.slip_rate=1", "numerics.accuracy=0.05");
        let outcome = simulate(&scene, &Unwatched).unwrap();
        let [end, steady] = [Quantity::Mu, Quantity::MuSteady].map(|quantity| outcome.scalars[quantity]);
        let off = |mu: f64| mu / steady.value - 1.0;
        assert!(off(end.value).abs() < ACCURACY + end.error / end.value, "{end:?} {steady:?}");
        let radius = outcome.scalars[Quantity::ContactRadius].value;
        let early = |state: &State<'_>| state[Quantity::Slip] <= default_slip_distance() * radius;
        let first = outcome.slide.states().take_while(early).last().unwrap();
        assert!(off(first[Quantity::Friction] / first[Quantity::Load]) > ACCURACY, "{steady:?}");
        let says =
            |note: &Note| matches!(note, Note::UntilSteady { slip, is_steady: true, .. } if *slip > 2.0);
        assert!(outcome.account.notes.iter().any(says), "{:?}", outcome.account.notes);
    }

    /// In full stick; the slide has the default length, two contact radii.
    #[test]
    fn a_contact_that_does_not_slide_is_not_steady() {
        let mut scene = steady_scene("loading.slip_rate=0", "numerics.accuracy=0.1");
        scene.interface.law = crate::scene::FrictionLaw::FullStick;
        let (found, note) = until_steady(&scene, &Unwatched).unwrap();
        assert!(matches!(note, Note::UntilSteady { is_steady: false, .. }), "{note}");
        let recording = Recording { slips: vec![1.0, 3.0], body: false };
        assert!(check_fields(&recording, &found).unwrap_err().to_string().contains("at a slip of 3 contact"));
    }

    #[test]
    fn one_press_of_several_slides_needs_a_length() {
        let scene = steady_scene("loading.slip_rate=0", "numerics.accuracy=0.1");
        assert!(press(&scene, &Unwatched).err().unwrap().to_string().contains("give a number"));
        // As it is written, it is read.
        let written = assert_written_is_read(&scene);
        assert!(written.contains("slip_distance = \"steady\""), "{written}");
        let table = sphere("steel-4340") + "[loading]\nslip_distance = \"steady\"\n[table]\n";
        let refused = request(&table, &[]).unwrap_err();
        let words = "loading.slip_distance = \"steady\": must be a positive number";
        assert!(refused.contains(words), "{refused}");
    }

    #[test]
    fn without_heat_the_slide_has_the_default_length() {
        let scene = steady_scene("loading.slip_rate=0", "numerics.accuracy=0.1");
        let (found, note) = until_steady(&scene, &Unwatched).unwrap();
        assert_eq!(found.loading.slip_distance, default_slip_distance(), "{note}");
    }
}
