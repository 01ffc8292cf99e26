//! `asperity verify`: every reference case, with its result.

use asperity::simulate::SimulationError;
use asperity::studies::verification::{Cost, GROUPS, Row, Tally};
use serde_json::json;
use tables::numbers::{digits, plain};

use super::progress::watched;
use super::{Display, Failure, VerifyArguments, print};

/// Run the cases and print a row for each.
pub fn verify(arguments: &VerifyArguments, display: &Display) -> Result<(), Failure> {
    if arguments.robustness {
        return super::robustness::robustness(arguments, display);
    }
    let groups = arguments.chosen(GROUPS.into(), |group| group.name)?;
    let most = if arguments.quick { Cost::Quick } else { Cost::Long };
    let (mut done, mut failed, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for group in groups {
        let rows = match watched(display, |progress| group.rows(most, progress)) {
            Ok(rows) => rows,
            Err(SimulationError::Cancelled { .. }) => return Err(Failure::run("stopped on request")),
            // The other groups are run nevertheless.
            Err(error) => {
                failed.push(format!("{}: {error}", group.name));
                continue;
            }
        };
        failed.extend(rows.iter().filter(|row| !row.passes()).map(|row| row.quantity.clone()));
        if !display.json && !display.quiet {
            print(&table(group.name, &rows))?;
        }
        done.push(json!({ "group": group.name, "rows": rows.iter().map(as_json).collect::<Vec<_>>() }));
        all.extend(rows);
    }
    let passed = failed.is_empty();
    let tally = Tally::of(&all);
    display.printer().print(
        || {
            json!({
                "passed": passed,
                "failed": failed,
                "rows": tally.rows,
                "stated_errors": tally.stated,
                "stated_errors_that_cover": tally.covered,
                "groups": done,
            })
        },
        || {
            format!(
                "{} of {} rows pass; {} of {} stated errors cover the deviation\n",
                tally.passed, tally.rows, tally.covered, tally.stated
            )
        },
    )?;
    match passed {
        true => Ok(()),
        false => Err(Failure::run(format!("failed: {}", failed.join("; ")))),
    }
}

/// Two lines a row: the numbers and verdicts, and the source and tolerance.
fn table(group: &str, rows: &[Row]) -> String {
    let mut text = format!("{group}\n");
    for row in rows {
        let verdict = if row.passes() { "pass" } else { "FAIL" };
        let unit = if row.unit == "1" { "" } else { row.unit };
        // Of a reference of zero the difference itself is shown.
        let (scale, sign) = match row.reference.value {
            0.0 => (1.0, ""),
            reference => (100.0 / reference.abs(), " %"),
        };
        let stated = row.stated_error.map_or(String::new(), |error| {
            let covers = if row.covered() == Some(true) { "covers" } else { "DOES NOT COVER" };
            format!("; stated error {}{sign} {covers} it", digits(scale * error, 2))
        });
        text += &format!(
            "  {verdict}  {}: {} {unit}, reference {} {unit}; off by {}{sign}{stated}\n",
            row.quantity,
            plain(row.computed),
            plain(row.reference.value),
            digits(scale * row.deviation(), 2),
        )
        .replace(" ,", ",")
        .replace(" ;", ";");
        text += &format!(
            "        {}; tolerance {}{sign}: {}\n",
            row.reference.source,
            digits(scale * row.allowed(), 2),
            row.tolerance.reason
        );
    }
    text
}

fn as_json(row: &Row) -> serde_json::Value {
    json!({
        "quantity": row.quantity,
        "unit": row.unit,
        "computed": row.computed,
        "reference": row.reference.value,
        "reference_uncertainty": row.reference.uncertainty,
        "source": row.reference.source,
        "difference": row.deviation(),
        "allowed_difference": row.allowed(),
        "allowed_because": row.tolerance.reason,
        "passes": row.passes(),
        "estimated_error": row.stated_error,
        "covered": row.covered(),
    })
}
