//! `asperity verify --robustness`: the robustness suite, one line a case.

use asperity::output::provenance;
use asperity::output::run_file::{self, About};
use asperity::studies::robustness::{CaseResult, RobustnessCase, Verdict};
use serde_json::{Value, json};
use tables::quantity::Quantity;

use super::progress::watched;
use super::{Display, Failure, VerifyArguments, command_line, outputs, print};

/// Failures allowed, as a share of the cases that have a solution.
const MOST_FAILURES: f64 = 0.03;

/// Run the cases and report on them.
pub fn robustness(arguments: &VerifyArguments, display: &Display) -> Result<(), Failure> {
    let mut cases = asperity::studies::robustness::all();
    cases.retain(|case| case.quick || !arguments.quick);
    let cases = arguments.chosen(cases, |case| &case.name)?;
    if let Some(directory) = &arguments.save {
        outputs::check_directory(directory)?;
    }
    let text = !display.json && !display.quiet;
    if text {
        print(&header())?;
    }
    let mut results = Vec::new();
    for case in cases {
        let Some(result) = watched(display, |progress| case.run(progress)) else {
            return Err(Failure::Run("stopped on request".into()));
        };
        save(arguments, &case, &result)?;
        if text {
            print(&line(&case, &result))?;
        }
        results.push((case, result));
    }
    let count = |is: fn(&Verdict) -> bool| results.iter().filter(|(_, result)| is(&result.verdict)).count();
    let solved = count(|verdict| *verdict == Verdict::Solved);
    let refused = count(|verdict| matches!(verdict, Verdict::Refused(_)));
    let failed = results.len() - solved - refused;
    let json = || {
        let cases: Vec<Value> = results.iter().map(|(case, result)| as_json(case, result)).collect();
        json!({ "solved": solved, "refused": refused, "failed": failed, "cases": cases })
    };
    let (all, solvable) = (results.len(), results.iter().filter(|(case, _)| case.refused.is_none()).count());
    display.printer().print(json, || {
        format!("{all} cases: {solved} solved, {refused} refused as expected, {failed} failed\n")
    })?;
    match failed as f64 <= MOST_FAILURES * solvable as f64 {
        true => Ok(()),
        false => Err(Failure::Run(format!("{failed} of {all} cases failed"))),
    }
}

fn save(arguments: &VerifyArguments, case: &RobustnessCase, result: &CaseResult) -> Result<(), Failure> {
    let (Some(directory), Some(outcome)) = (&arguments.save, &result.outcome) else {
        return Ok(());
    };
    let about = About { history: provenance::history(&command_line()), incomplete: result.verdict.reason() };
    let path = directory.join(format!("{}.nc", case.name));
    run_file::write(&path, &result.scene, outcome, &about).map_err(Failure::run)
}

fn header() -> String {
    format!(
        "{:40}{:>8}{:>6}{:>6}{:>8}{:>8}{:>9}{:>9}{:>8}{:>8}\n",
        "case", "", "steps", "cuts", "Newton", "Krylov", "error %", "mu", "T_max", "time s"
    )
}

fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Solved => "solved",
        Verdict::Refused(_) => "refused",
        Verdict::Failed(_) => "FAILED",
    }
}

fn line(case: &RobustnessCase, result: &CaseResult) -> String {
    let mut text = format!("{:40}{:>8}", case.name, word(&result.verdict));
    if let Some(outcome) = &result.outcome {
        let account = &outcome.account;
        text += &format!(
            "{:>6}{:>6}{:>8}{:>8}{:>9.2}{:>9.4}{:>8.0}{:>8.1}",
            account.steps,
            account.cutbacks,
            account.newton_iterations,
            account.krylov_iterations,
            100.0 * result.error(),
            outcome.scalars[Quantity::Mu].value,
            outcome.scalars[Quantity::TemperatureMax].value,
            result.wall_time,
        );
    }
    text.push('\n');
    if let Some(reason) = result.verdict.reason() {
        text += &format!("  {reason}\n");
    }
    text
}

fn as_json(case: &RobustnessCase, result: &CaseResult) -> Value {
    let account = result.outcome.as_ref().map(|outcome| {
        let account = &outcome.account;
        json!({
            "steps": account.steps,
            "cutbacks": account.cutbacks,
            "newton_iterations": account.newton_iterations,
            "krylov_iterations": account.krylov_iterations,
            "relative_error": result.error(),
            "mu": outcome.scalars[Quantity::Mu].value,
            "temperature_max": outcome.scalars[Quantity::TemperatureMax].value,
            "notes": account.notes,
            "warnings": account.warnings,
        })
    });
    json!({
        "case": case.name,
        "set": case.set,
        "verdict": word(&result.verdict),
        "reason": result.verdict.reason(),
        "account": account,
        "wall_time": result.wall_time,
    })
}
