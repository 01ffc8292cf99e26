//! Interference of a prescribed load: that whose press has the load on the mesh of the main run.

use tables::numbers::{plain, rounded};

use super::messages::Note;
use super::pressed::press;
use super::{SimulationError, Watch};
use crate::scene::{Loading, Scene};

/// Relative difference of the load at which the interference is found.
const CLOSE: f64 = 3e-4;
/// Presses that may be tried; three or four are the rule.
const MOST_PRESSES: usize = 12;
/// d ln P/d ln ω of the first step, between those of elastic (3/2) and of plastic spheres (1).
const FIRST_SLOPE: f64 = 1.2;
/// Bounds of that slope between two presses; the load of a press scatters by the position of the edge in its mesh.
const SLOPES: [f64; 2] = [0.7, 1.6];
const DIGITS: usize = 5;

/// The scene with the interference in place of the load `prescribed`, N, and what is said of it.
pub(super) fn with_interference(
    scene: &Scene,
    prescribed: f64,
    watch: &dyn Watch,
) -> Result<(Scene, Note), SimulationError> {
    let pressed_to = |interference: f64| {
        let loading = Loading { interference, load: None, ..scene.loading.clone() };
        Scene { loading, ..scene.clone() }
    };
    let mut interference = rounded(scene.loading.interference, DIGITS);
    let mut before: Option<[f64; 2]> = None;
    for _ in 0..MOST_PRESSES {
        let found = pressed_to(interference);
        let load = load_of(&found, watch).map_err(|error| of_load(error, prescribed))?;
        if (load / prescribed - 1.0).abs() < CLOSE {
            return Ok((found, Note::OfLoad { prescribed, interference }));
        }
        let here = [interference.ln(), load.ln()];
        let slope = before.map_or(FIRST_SLOPE, |[omega, load]| (here[1] - load) / (here[0] - omega));
        let step = (prescribed.ln() - here[1]) / slope.clamp(SLOPES[0], SLOPES[1]);
        before = Some(here);
        interference = rounded(interference * step.exp(), DIGITS);
    }
    Err(SimulationError::NotConverged {
        stage: "press",
        at: format!("interference {interference} omega_c"),
        reason: format!(
            "no interference has the load of {} N within {MOST_PRESSES} presses",
            plain(prescribed)
        ),
        partial: None,
    })
}

/// P at the end of a press as the slide reports it, N.
fn load_of(scene: &Scene, watch: &dyn Watch) -> Result<f64, SimulationError> {
    // The length of a slide does not matter here.
    let loading = Loading { slip_distance: 0.0, ..scene.loading.clone() };
    Ok(press(&Scene { loading, ..scene.clone() }, watch)?.reported_load())
}

/// The refusal of an interference, in terms of the load.
fn of_load(error: SimulationError, load: f64) -> SimulationError {
    match error {
        SimulationError::Unsupported(reason) => {
            SimulationError::Unsupported(format!("loading.load = {} N: {reason}", plain(load)))
        }
        error => error,
    }
}

#[cfg(test)]
mod tests {
    use tables::quantity::Quantity;

    use super::*;
    use crate::scene::tests::parse;
    use crate::simulate::{Unwatched, simulate};

    fn scene(load: &str, slip_distance: &str) -> Scene {
        let text = format!(
            "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n[loading]\n{load}\nslip_rate = 0\n\
             slip_distance = {slip_distance}\n[numerics]\nelements_per_radius = 6\nsectors = 4\n"
        );
        parse(&text, &[]).unwrap()
    }

    /// From elastic to deep contacts, on both sides of the first guess.
    #[test]
    fn the_press_has_the_prescribed_load() {
        for prescribed in [1e-3, 0.3, 7.0, 80.0] {
            let (found, note) =
                with_interference(&scene("interference = 1", "0"), prescribed, &Unwatched).unwrap();
            let load = load_of(&found, &Unwatched).unwrap();
            assert!((load / prescribed - 1.0).abs() < CLOSE, "{prescribed}: {load}, {note}");
        }
    }

    /// It is held during the slide.
    #[test]
    fn a_slide_has_the_prescribed_load() {
        let outcome = simulate(&scene("load = 7", "0.2"), &Unwatched).unwrap();
        for quantity in [Quantity::LoadPress, Quantity::Load] {
            let load = outcome.scalars[quantity].value;
            assert!((load / 7.0 - 1.0).abs() < 1.5 * CLOSE, "{quantity:?}: {load}");
        }
        let says = |note: &Note| matches!(note, Note::OfLoad { prescribed: 7.0, .. });
        assert!(outcome.account.notes.iter().any(says), "{:?}", outcome.account.notes);
        // That of the given interference is the same run.
        let text = format!("interference = {}\ncontrol = \"load\"", outcome.interference);
        let again = simulate(&scene(&text, "0.2"), &Unwatched).unwrap();
        assert_eq!(again.scalars, outcome.scalars);
    }

    #[test]
    fn a_load_beyond_the_hemisphere_is_refused() {
        let error = simulate(&scene("load = 1e6", "0.2"), &Unwatched).unwrap_err().to_string();
        assert!(error.contains("loading.load = 1e6 N") && error.contains("goes to about"), "{error}");
    }
}
