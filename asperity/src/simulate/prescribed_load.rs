//! Interference of a prescribed load: that whose press has the load on the mesh of the main run.

use tables::numbers::{digits, plain, rounded};

use super::messages::Note;
use super::pressed::{largest_interference, press};
use super::{SimulationError, Watch};
use crate::scene::{Loading, Scene};

/// Relative difference of the load at which the interference is found.
const CLOSE: f64 = 3e-4;
/// Presses that may be tried; three or four are the rule. Most of those refused end before they begin.
const MOST_PRESSES: usize = 30;
/// d ln P/d ln ω of the first step, between those of elastic (3/2) and of plastic spheres (1).
const FIRST_SLOPE: f64 = 1.2;
/// Bounds of that slope between two presses; the load of a press scatters by the position of the edge in its mesh.
const SLOPES: [f64; 2] = [0.7, 1.6];
const DIGITS: usize = 5;
/// Step from an interference that does not fit into the hemisphere.
const SHALLOWER: f64 = 0.7;
/// Ratio of an interference that does not fit to one that does, at which the load is refused.
const BRACKET: f64 = 1.05;
/// Part of the first guess at which the search ends where none fits.
const LEAST: f64 = 1e-2;

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
    // The smallest interference that did not fit, and why.
    let mut refused: Option<(f64, String)> = None;
    for _ in 0..MOST_PRESSES {
        let found = pressed_to(interference);
        let load = match load_of(&found, watch) {
            Ok(load) => load,
            // The first guess of a deep contact may be far too deep.
            Err(SimulationError::Unsupported(reason)) => {
                let fits = largest_interference(&found).unwrap_or(SHALLOWER * interference);
                // Rounded, an interference that was pressed may be just below.
                let known = before.map(|[omega, _]| omega.exp()).filter(|omega| *omega > 0.999 * fits);
                let shallower = known.map_or(fits, |omega| (omega * interference).sqrt());
                refused = Some((interference, reason));
                if let Some(error) = too_large([prescribed, scene.loading.interference], before, &refused) {
                    return Err(error);
                }
                interference = rounded(shallower, DIGITS);
                continue;
            }
            Err(error) => return Err(error),
        };
        if (load / prescribed - 1.0).abs() < CLOSE {
            return Ok((found, Note::OfLoad { prescribed, interference }));
        }
        let here = [interference.ln(), load.ln()];
        let other = before.filter(|[omega, _]| *omega != here[0]);
        let slope = other.map_or(FIRST_SLOPE, |[omega, load]| (here[1] - load) / (here[0] - omega));
        let step = (prescribed.ln() - here[1]) / slope.clamp(SLOPES[0], SLOPES[1]);
        before = Some(here);
        if load < prescribed
            && let Some(error) = too_large([prescribed, scene.loading.interference], before, &refused)
        {
            return Err(error);
        }
        let limit = refused.as_ref().map_or(f64::INFINITY, |(limit, _)| (limit * interference).sqrt());
        interference = rounded((interference * step.exp()).min(limit), DIGITS);
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

/// The refusal of a load, where the interference `refused` is hardly above one whose load is known, or far below the first guess.
fn too_large(
    [prescribed, guess]: [f64; 2],
    known: Option<[f64; 2]>,
    refused: &Option<(f64, String)>,
) -> Option<SimulationError> {
    let (limit, reason) = refused.as_ref()?;
    let pressed = match known {
        Some([omega, load]) if *limit < BRACKET * omega.exp() => format!(
            "; an interference of {} omega_c has a load of {} N",
            digits(omega.exp(), 4),
            digits(load.exp(), 3)
        ),
        None if *limit < LEAST * guess => String::new(),
        _ => return None,
    };
    let load = plain(prescribed);
    Some(SimulationError::Unsupported(format!("loading.load = {load} N: {reason}{pressed}")))
}

#[cfg(test)]
mod tests {
    use tables::quantity::Quantity;

    use super::*;
    use crate::scene::tests::of_preset;
    use crate::simulate::{Unwatched, simulate};

    fn scene(preset: &str, loading: &[&str]) -> Scene {
        let coarse = ["loading.slip_rate=0", "numerics.elements_per_radius=6", "numerics.sectors=4"];
        of_preset(preset, &[&coarse, loading].concat())
    }

    fn steel(loading: &[&str]) -> Scene {
        scene("steel-4340", loading)
    }

    /// From elastic to deep contacts, on both sides of the first guess.
    #[test]
    fn the_press_has_the_prescribed_load() {
        for prescribed in [1e-3, 0.3, 7.0, 80.0] {
            let start = steel(&["loading.interference=1", "loading.slip_distance=0"]);
            let (found, note) = with_interference(&start, prescribed, &Unwatched).unwrap();
            let load = load_of(&found, &Unwatched).unwrap();
            assert!((load / prescribed - 1.0).abs() < CLOSE, "{prescribed}: {load}, {note}");
        }
    }

    /// It is held during the slide.
    #[test]
    fn a_slide_has_the_prescribed_load() {
        let outcome = simulate(&steel(&["loading.load=7", "loading.slip_distance=0.2"]), &Unwatched).unwrap();
        for quantity in [Quantity::LoadPress, Quantity::Load] {
            let load = outcome.scalars[quantity].value;
            assert!((load / 7.0 - 1.0).abs() < 1.5 * CLOSE, "{quantity:?}: {load}");
        }
        let says = |note: &Note| matches!(note, Note::OfLoad { prescribed: 7.0, .. });
        assert!(outcome.account.notes.iter().any(says), "{:?}", outcome.account.notes);
        // That of the given interference is the same run.
        let given = format!("loading.interference={}", outcome.interference);
        let given = steel(&[&given, "loading.control=load", "loading.slip_distance=0.2"]);
        let again = simulate(&given, &Unwatched).unwrap();
        assert_eq!(again.scalars, outcome.scalars);
    }

    /// The largest load that is pressed is stated.
    #[test]
    fn a_load_beyond_the_hemisphere_is_refused() {
        let error = simulate(&steel(&["loading.load=1e6", "loading.slip_distance=0"]), &Unwatched)
            .unwrap_err()
            .to_string();
        let words = ["loading.load = 1e6 N", "goes to about", "omega_c has a load of"];
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }

    /// The closed form underestimates the load of a deep contact that hardens: its interference for this load does not fit.
    #[test]
    fn a_load_is_found_where_the_first_guess_is_too_deep() {
        let copper = scene("copper", &["loading.load=80", "loading.slip_distance=0"]);
        let guess = copper.loading.interference;
        let at_guess = load_of(&copper, &Unwatched);
        assert!(matches!(at_guess, Err(SimulationError::Unsupported(_))), "{at_guess:?}");
        let outcome = simulate(&copper, &Unwatched).unwrap();
        assert!((outcome.scalars[Quantity::LoadPress].value / 80.0 - 1.0).abs() < 1.5 * CLOSE);
        assert!(outcome.interference < 0.6 * guess, "{guess} {}", outcome.interference);
    }
}
