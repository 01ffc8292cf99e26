//! Robustness suite: cases at the limits of what can be simulated. Each either converges to consistent numbers (finite,
//! ledgers closed, no contact above its melting point) or is refused with the reason (book, "Limits").
//!
//! The cases are data, `cases.toml`: what each changes of the scene `base.toml`. No setting of the program depends on
//! them. Uses simulate like any caller.

use std::time::{Duration, Instant};

use serde::Deserialize;
use tables::quantity::Quantity;

use crate::loading::slide::invariants::MELTING_OVERSHOOT;
use crate::scene::Scene;
use crate::scene::file::{SceneFileError, parse_scene};
use crate::simulate::accuracy::error_budget::CONTROLLED;
use crate::simulate::outcome::{InceptionCriterion, Outcome};
use crate::simulate::{SimulationError, Watch, simulate};
use crate::studies::verification::ledgers::{energy_missing, heat_missing, heat_over_dissipation};

const BASE: &str = include_str!("base.toml");
const CASES: &str = include_str!("cases.toml");

/// Tolerance of the two ledgers, relative to their largest entry; on ordinary scenes they close to 1e-6.
const LEDGER: f64 = 1e-3;
/// Difference of the heat from the dissipation that a slide may have, by its increments.
const SOURCES: f64 = 0.05;

/// Longest run of a case; those that converge take seconds.
const TIME_LIMIT: Duration = Duration::from_secs(120);

/// One case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobustnessCase {
    /// Unique.
    pub name: String,
    /// `section.key=value`, laid over the base scene.
    pub set: Vec<String>,
    /// Whether the tests run it.
    #[serde(default)]
    pub quick: bool,
    /// Part of the message with which it has to be refused, if it is beyond the model.
    pub refused: Option<String>,
    /// Temperature that the contact has to exceed, K.
    pub hotter_than: Option<f64>,
}

#[derive(Deserialize)]
struct Cases {
    case: Vec<RobustnessCase>,
}

/// How a case ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Solved with consistent numbers.
    Solved,
    /// Beyond the model, with the reason.
    Refused(String),
    /// Did not converge, or not to consistent numbers: the reason.
    Failed(String),
}

impl Verdict {
    /// Why it is not solved.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Solved => None,
            Self::Refused(reason) | Self::Failed(reason) => Some(reason),
        }
    }
}

/// A case that was run.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// Scene that was run.
    pub scene: Scene,
    pub verdict: Verdict,
    /// The whole run, or the part of it before the failure, if there is any.
    pub outcome: Option<Box<Outcome>>,
    /// s.
    pub wall_time: f64,
}

/// All cases, in the order of the file.
pub fn all() -> Vec<RobustnessCase> {
    let cases: Cases = toml::from_str(CASES).expect("checked by the tests");
    cases.case
}

impl RobustnessCase {
    /// The scene.
    pub fn scene(&self) -> Result<Scene, SceneFileError> {
        parse_scene(BASE, "base.toml", &self.set)
    }

    /// Runs it; none if stopped on request.
    pub fn run(&self, watch: &dyn Watch) -> Option<CaseResult> {
        let since = Instant::now();
        let scene = self.scene().expect("checked by the tests");
        let (verdict, outcome) = match simulate(&scene, &Limited { watch, since }) {
            Ok(outcome) => {
                let mut wrong = contradictions(&scene, &outcome);
                wrong.extend(self.hotter_than.and_then(|least| colder(&outcome, least)));
                let verdict = match (wrong.is_empty(), &self.refused) {
                    (false, _) => Verdict::Failed(wrong.join("; ")),
                    (true, None) => Verdict::Solved,
                    (true, Some(_)) => Verdict::Failed("was solved though it is beyond the model".into()),
                };
                (verdict, Some(Box::new(outcome)))
            }
            Err(SimulationError::Cancelled { .. }) if watch.cancelled() => return None,
            Err(SimulationError::Cancelled { partial }) => {
                (Verdict::Failed(format!("stopped: not done after {} s", TIME_LIMIT.as_secs())), partial)
            }
            Err(error) => {
                let message = error.to_string();
                let verdict = match &self.refused {
                    Some(part) if message.contains(part) => Verdict::Refused(message),
                    _ => Verdict::Failed(message),
                };
                (verdict, error.into_partial())
            }
        };
        Some(CaseResult { scene, verdict, outcome, wall_time: since.elapsed().as_secs_f64() })
    }
}

/// Stops what takes too long.
struct Limited<'a> {
    watch: &'a dyn Watch,
    since: Instant,
}

impl Watch for Limited<'_> {
    fn progress(&self, stage: &'static str, done: f64, detail: &str) {
        self.watch.progress(stage, done, detail);
    }

    fn cancelled(&self) -> bool {
        self.watch.cancelled() || self.since.elapsed() > TIME_LIMIT
    }
}

impl CaseResult {
    /// The largest relative error of the quantities controlled by the accuracy, over its allowance, but for the
    /// friction where there is none.
    pub fn error(&self) -> f64 {
        let Some(outcome) = &self.outcome else { return 0.0 };
        let none = outcome.scalars[Quantity::MuPeak].value < 1e-9;
        let frictional = [Quantity::Mu, Quantity::MuStatic, Quantity::Friction, Quantity::EnergyRelease];
        let relative = |quantity: &Quantity| {
            let estimate = outcome.scalars[*quantity];
            if estimate.value == 0.0 {
                0.0
            } else {
                (estimate.error / estimate.value).abs() / quantity.allowance()
            }
        };
        let counted = CONTROLLED.iter().filter(|quantity| !none || !frictional.contains(quantity));
        counted.map(relative).fold(0.0, f64::max)
    }
}

/// Contradictions in an outcome, a sentence each.
pub fn contradictions(scene: &Scene, outcome: &Outcome) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut check = |holds: bool, what: String| {
        if !holds {
            wrong.push(what);
        }
    };
    for quantity in Quantity::SCALARS {
        use Quantity::{Area, AreaPress, ContactRadius, Load, LoadPress};
        let estimate = outcome.scalars[quantity];
        let name = quantity.descriptor().name;
        let of_press = matches!(quantity, Load | LoadPress | Area | AreaPress | ContactRadius);
        // Without a slide there is no friction.
        let is_none = outcome.slide.len() == 1 && !of_press && estimate.value.is_nan();
        let is_finite = estimate.value.is_finite() && estimate.error.is_finite();
        check(is_finite || is_none, format!("{name} is not finite"));
    }
    let fields =
        outcome.snapshots.iter().flat_map(|s| s.pressure.iter().chain(&s.shear).chain(&s.temperature));
    check(fields.clone().all(|x| x.is_finite()), "a field over the contact is not finite".into());
    let hottest = outcome
        .slide
        .states()
        .map(|step| step[Quantity::TemperatureMax])
        .fold(scene.loading.temperature, f64::max);
    if let Some(melting) = scene.highest_temperature() {
        let most = melting + MELTING_OVERSHOOT * (melting - scene.loading.temperature);
        check(
            hottest <= most,
            format!("the contact is at {hottest:.0} K, above its melting point of {melting:.0} K"),
        );
    }
    // After a reversal friction keeps its sign until the shear is released.
    let reverses = scene.loading.steps.iter().any(|step| step.slip_rate() < 0.0);
    let pulls = outcome.slide.states().all(|step| step[Quantity::Mu] >= -1e-9);
    check(reverses || pulls, "friction pushes".into());
    if let Some(end) = outcome.slide.states().next_back() {
        let off = energy_missing(end);
        check(off <= LEDGER, format!("the energies of the slide miss the work of the flat by {off:.1e}"));
        let off = heat_missing(end);
        check(off <= LEDGER, format!("the heat in the body differs from the heat input by {off:.1e}"));
        let off = (heat_over_dissipation(scene, end) - 1.0).abs();
        let is_heated = end[Quantity::HeatIn] != 0.0 && outcome.inception != InceptionCriterion::None;
        check(
            !is_heated || off <= SOURCES,
            format!("the heat differs from that of friction and plastic flow by {off:.1e}"),
        );
    }
    wrong
}

/// The contradiction that the contact stays below the temperature required by the case, if so.
fn colder(outcome: &Outcome, least: f64) -> Option<String> {
    let hottest = outcome.slide.states().map(|step| step[Quantity::TemperatureMax]).fold(0.0, f64::max);
    (hottest <= least).then(|| format!("the contact reaches {hottest:.0} K and was to pass {least:.0} K"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::Unwatched;

    #[test]
    fn cases_are_scenes_with_names_of_their_own() {
        let cases = all();
        for (i, case) in cases.iter().enumerate() {
            case.scene().unwrap_or_else(|error| panic!("{}: {error}", case.name));
            assert!(cases[..i].iter().all(|other| other.name != case.name), "{}", case.name);
        }
        assert!(cases.iter().filter(|case| case.quick).count() >= 8);
    }

    #[test]
    fn quick_cases_end_as_they_should() {
        for case in all().into_iter().filter(|case| case.quick) {
            let result = case.run(&Unwatched).expect("nobody stops it");
            match (&result.verdict, &case.refused) {
                (Verdict::Solved, None) | (Verdict::Refused(_), Some(_)) => {}
                (verdict, _) => panic!("{}: {verdict:?}", case.name),
            }
        }
    }

    #[test]
    fn a_case_that_stays_too_cold_is_not_solved() {
        let case = all().into_iter().find(|case| case.name == "slide-0").unwrap();
        let run =
            |hotter_than| RobustnessCase { hotter_than, ..case.clone() }.run(&Unwatched).unwrap().verdict;
        assert_eq!(run(Some(297.0)), Verdict::Solved);
        let Verdict::Failed(why) = run(Some(298.0)) else { panic!("solved") };
        assert_eq!(why, "the contact reaches 298 K and was to pass 298 K");
    }

    /// Each check detects its contradiction.
    #[test]
    fn contradictions_are_found() {
        let case = all().into_iter().find(|case| case.name == "slide-0").unwrap();
        let result = case.run(&Unwatched).unwrap();
        let good = *result.outcome.unwrap();
        assert_eq!(contradictions(&result.scene, &good), Vec::<String>::new());
        let mut bad = good.clone();
        bad.scalars[Quantity::Load].value = f64::NAN;
        assert!(contradictions(&result.scene, &bad)[0].contains("P is not finite"));
        let mut bad = good.clone();
        *bad.slide.column_mut(Quantity::TemperatureMax).last_mut().unwrap() = 1900.0;
        assert!(contradictions(&result.scene, &bad)[0].contains("melting point"));
        let mut bad = good;
        *bad.slide.column_mut(Quantity::Work).last_mut().unwrap() = 1.0;
        assert!(contradictions(&result.scene, &bad)[0].contains("work of the flat"));
    }
}
