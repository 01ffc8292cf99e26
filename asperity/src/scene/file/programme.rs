//! The programme `loading.steps`, in place of `loading.slip_rate` and `loading.slip_distance`.

use toml::{Table, Value};

use super::check::check;
use super::error::SceneFileError;
use super::keys::{LOADING, STEP};
use super::source::{Source, join};
use crate::scene::LoadingStep;
use crate::scene::loading::extent;

/// Path of the programme.
const STEPS: &str = "loading.steps";
const BY_STEPS: [&str; 2] = ["slip_rate", "slip_distance"];

/// Checks the programme of a scene, if it has one, and enters the largest slip rate and the total slip.
pub fn resolve_programme(sections: &mut Table, source: &Source) -> Result<(), SceneFileError> {
    let Some(Value::Table(loading)) = sections.get_mut("loading") else {
        return Ok(());
    };
    // An override replaces the slip rate of the file.
    let is_set = |path: &str| source.overrides.iter().any(|(set, _)| set == path);
    if is_set(STEPS) {
        loading.retain(|key, _| !BY_STEPS.contains(&key) || is_set(&join("loading", key)));
    }
    let Some(steps) = loading.get("steps") else {
        return Ok(());
    };
    check("loading", loading, LOADING, source)?;
    if let Some((key, value)) = BY_STEPS.iter().find_map(|key| Some((key, loading.get(*key)?))) {
        return Err(source.invalid(&join("loading", key), value, "left out where loading.steps is given"));
    }
    let steps = steps.as_array().expect("checked").iter().enumerate();
    let steps: Result<Vec<LoadingStep>, _> = steps.map(|(n, step)| step_at(n, step, source)).collect();
    let (slip_rate, slip_distance) = extent(&steps?);
    loading.insert("slip_rate".into(), slip_rate.into());
    loading.insert("slip_distance".into(), slip_distance.into());
    Ok(())
}

/// A step slides or holds; the first slides forwards.
fn step_at(n: usize, step: &Value, source: &Source) -> Result<LoadingStep, SceneFileError> {
    let path = format!("{STEPS}[{n}]");
    let table = step.as_table().expect("checked");
    if let Some(hold) = table.get("hold")
        && (table.len() > 1 || n == 0)
    {
        let allowed = match n {
            0 => "left out of the first step, which slides",
            _ => "alone in its step, or left out of a step with slip_rate and slip_distance",
        };
        return Err(source.invalid(&join(&path, "hold"), hold, allowed));
    }
    let missing = |key: &&&str| !table.contains_key("hold") && !table.contains_key(**key);
    if let Some(key) = BY_STEPS.iter().find(missing) {
        let kind = STEP.iter().find(|entry| entry.name == *key).expect("a key of a step").kind;
        return Err(
            source.missing(join(&path, key), format!("{}, or the step {{ hold = … }} (s)", kind.allowed()))
        );
    }
    let step: LoadingStep = step.clone().try_into().expect("checked");
    match step.slip_rate() < 0.0 && n == 0 {
        true => {
            let allowed = "positive in the first step, whose direction is that of positive slip";
            Err(source.invalid(&join(&path, "slip_rate"), step.slip_rate(), allowed))
        }
        false => Ok(step),
    }
}

/// Removes from a written scene what its programme determines.
pub fn leave_to_programme(sections: &mut Table) {
    if let Some(Value::Table(loading)) = sections.get_mut("loading") {
        loading.retain(|key, _| !BY_STEPS.contains(&key));
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::tests::{assert_written_is_read, parse, request, sphere};
    use crate::scene::{LoadingStep, Scene};

    fn with(loading: &str) -> String {
        format!("{}[loading]\ninterference = 20\n{loading}\n", sphere("steel-4340"))
    }

    fn read(loading: &str) -> Result<Scene, String> {
        parse(&with(loading), &[])
    }

    #[test]
    fn a_programme_is_read_and_written() {
        let text = "steps = [{ slip_rate = 1e-2, slip_distance = 2 }, { slip_rate = 1, slip_distance = 2.5 },\n\
                    { hold = 1e-3 }, { slip_rate = -3, slip_distance = 1 }]";
        let scene = read(text).unwrap();
        let slip = |slip_rate, slip_distance| LoadingStep::Slip { slip_rate, slip_distance };
        let steps = [slip(0.01, 2.0), slip(1.0, 2.5), LoadingStep::Hold { hold: 1e-3 }, slip(-3.0, 1.0)];
        assert_eq!(scene.loading.steps, steps);
        assert_eq!((scene.loading.slip_rate, scene.loading.slip_distance), (3.0, 5.5));
        assert_eq!(scene.loading.clone().with_steps(steps.into()), scene.loading);
        assert_eq!(scene.loading.first_slip_rate(), 0.01);
        let written = assert_written_is_read(&scene);
        let set = ["loading.steps=[{ slip_rate = 5, slip_distance = 1 }]"];
        for text in [written, with("slip_rate = 2")] {
            assert_eq!(parse(&text, &set).unwrap().loading.slip_rate, 5.0);
        }
        assert!(
            !read("slip_rate = 1").unwrap().defaults_in_effect().iter().any(|text| text.contains("steps"))
        );
    }

    #[test]
    fn mistakes_in_a_programme_are_named_with_their_line() {
        for (loading, parts) in [
            (
                "slip_rate = 1\nsteps = [{ slip_rate = 1, slip_distance = 1 }]",
                ["line 7: loading.slip_rate", "left out where"],
            ),
            ("steps = []", ["loading.steps", "a list, not empty"]),
            ("steps = 3", ["loading.steps", "a list, not empty"]),
            ("steps = [3]", ["line 7: loading.steps[0] = 3", "a section"]),
            (
                "steps = [{ slip_rate = 1, slip_distance = 1 },\n{ hold = -1 }]",
                ["line 8: loading.steps[1].hold", "a positive number (s)"],
            ),
            (
                "steps = [{ slip_rate = 1, slip_distnace = 1 }]",
                ["loading.steps[0].slip_distnace", "did you mean slip_distance?"],
            ),
            (
                "steps = [{ slip_rate = 0, slip_distance = 1 }]",
                ["loading.steps[0].slip_rate", "other than 0"],
            ),
            ("steps = [{ slip_rate = 1 }]", ["loading.steps[0].slip_distance is missing", "contact radii"]),
            (
                "steps = [{ slip_rate = 1, slip_distance = 1, hold = 1 }]",
                ["loading.steps[0].hold", "left out of the first step"],
            ),
            (
                "steps = [{ slip_rate = 1, slip_distance = 1 }, { slip_rate = 1, hold = 1 }]",
                ["loading.steps[1].hold", "alone in its step"],
            ),
            (
                "steps = [{ slip_rate = -1, slip_distance = 1 }]",
                ["loading.steps[0].slip_rate", "positive in the first step"],
            ),
        ] {
            let message = read(loading).unwrap_err();
            assert!(parts.iter().all(|part| message.contains(part)), "{message}");
        }
        let set = "loading.steps=[{ hold = 0 }]";
        let error = parse(&with(""), &[set]).unwrap_err();
        assert!(error.starts_with(&format!("--set {set}: loading.steps[0].hold")), "{error}");
        let steps = "[loading]\nsteps = [{ slip_rate = 1, slip_distance = 1 }]\n[table]\n";
        let error = request(&format!("{}{steps}", sphere("steel-4340")), &[]).unwrap_err();
        assert!(
            error.contains("line 6: loading.steps") && error.contains("left out of a request"),
            "{error}"
        );
    }
}
