//! The load `loading.load`, in place of `loading.interference`.

use tables::closed_forms::jackson_green;
use tables::functions::bisect;
use toml::{Table, Value};

use super::error::SceneFileError;
use super::source::Source;
use crate::scene::Scene;

pub const LOAD: &str = "loading.load";
pub const INTERFERENCE: &str = "loading.interference";
const BY_LOAD: &str = "interference";

/// For a scene that gives a load: leaves room for the interference, and holds the load during the slide unless the scene says
/// otherwise.
pub fn resolve_load(sections: &mut Table, source: &Source) -> Result<(), SceneFileError> {
    let Some(Value::Table(loading)) = sections.get_mut("loading") else {
        return Ok(());
    };
    // An override replaces what the file gives in the other way.
    let is_set = |key: &str| source.overrides.iter().any(|(set, _)| *set == format!("loading.{key}"));
    match [is_set("load"), is_set(BY_LOAD)] {
        [true, false] => drop(loading.remove(BY_LOAD)),
        [false, true] => drop(loading.remove("load")),
        _ => {}
    }
    if !loading.contains_key("load") {
        return Ok(());
    }
    if let Some(interference) = loading.insert(BY_LOAD.into(), 1.0.into()) {
        let allowed = format!("left out where {LOAD} is given");
        return Err(source.invalid(INTERFERENCE, interference, allowed));
    }
    loading.entry("control").or_insert_with(|| "load".into());
    Ok(())
}

/// ω₀/ω_c of a load, N, by Jackson & Green (2005).
pub fn expected_interference(scene: &Scene, load: f64) -> f64 {
    const DECADES: [f64; 2] = [-12.0, 12.0];
    let body = scene.with_combined_modulus().material.elastic_plastic();
    let critical = body.critical_interference(scene.radius);
    let unit = 4.0 / 3.0 * body.contact_modulus() * (scene.radius * critical).sqrt() * critical;
    let yield_strain = body.yield_strength / body.contact_modulus();
    let [below, _] = bisect(DECADES, 60, |decade| {
        unit * jackson_green::load(10f64.powf(decade), yield_strain, body.poisson_ratio) < load
    });
    10f64.powf(below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Control;
    use crate::scene::tests::{assert_written_is_read, parse, request, sphere};

    fn read(loading: &str, overrides: &[&str]) -> Result<Scene, String> {
        parse(&format!("{}[loading]\nslip_rate = 1\n{loading}\n", sphere("steel-4340")), overrides)
    }

    #[test]
    fn a_load_takes_the_place_of_an_interference() {
        let scene = read("load = 20", &[]).unwrap();
        assert_eq!((scene.loading.load, scene.loading.control), (Some(20.0), Control::Load));
        assert_written_is_read(&scene);
        assert!(!scene.defaults_in_effect().iter().any(|text| text.contains("loading.control")));
        let held = read("load = 20\ncontrol = \"interference\"", &[]).unwrap();
        assert_eq!(held.loading.control, Control::Interference);
        // An override replaces the other.
        let of_load = read("interference = 3", &["loading.load=20"]).unwrap();
        assert_eq!(of_load, scene);
        let of_interference = read("load = 20", &["loading.interference=3"]).unwrap();
        assert_eq!(of_interference, read("interference = 3", &[]).unwrap());
    }

    #[test]
    fn a_load_is_refused_where_it_cannot_be_met() {
        let refused = |loading: &str, words: &[&str]| {
            let error = read(loading, &[]).unwrap_err();
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
        };
        refused("load = 20\ninterference = 3", &["loading.interference = 3", "left out where loading.load"]);
        refused("load = -1", &["line 7: loading.load = -1", "a positive number (N)"]);
        refused("", &["loading.interference is missing", "or loading.load"]);
        let text = format!("{}[loading]\nload = 20\n[table]\n", sphere("steel-4340"));
        let error = request(&text, &[]).unwrap_err();
        assert!(error.contains("loading.load = 20") && error.contains("table.interference"), "{error}");
    }

    /// Hertz's law below first yield; such an interference is not taken for one in metres.
    #[test]
    fn a_light_load_is_that_of_hertz() {
        let scene = read("load = 1e-8", &[]).unwrap();
        let body = scene.material.elastic_plastic();
        let interference = scene.loading.interference * body.critical_interference(scene.radius);
        let load = 4.0 / 3.0 * body.contact_modulus() * scene.radius.sqrt() * interference.powf(1.5);
        assert!((load / 1e-8 - 1.0).abs() < 1e-9, "{load}");
        assert_eq!(scene.interference_in_metres(), None);
        assert_eq!(scene.implausible(), Vec::<String>::new());
    }
}
