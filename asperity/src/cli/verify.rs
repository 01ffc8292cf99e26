//! `asperity verify`: every reference case, with its result.

use asperity::simulate::SimulationError;
use asperity::studies::verification::{Extent, GROUPS, Row};
use serde_json::json;
use tables::numbers::{digits, plain};

use super::progress::{Progress, watch_for_interrupt};
use super::{Display, Failure, VerifyArguments, print};

/// Run the cases and print a row for each.
pub fn verify(arguments: &VerifyArguments, display: &Display) -> Result<(), Failure> {
    if arguments.robustness {
        return super::robustness::robustness(arguments, display);
    }
    let extent = if arguments.quick { Extent::Quick } else { Extent::Full };
    watch_for_interrupt();
    let progress = Progress::new(display);
    let (mut groups, mut failed, mut all) = (Vec::new(), Vec::new(), 0);
    for group in GROUPS {
        let rows = match group.rows(extent, &progress) {
            Ok(rows) => rows,
            Err(SimulationError::Cancelled { .. }) => return Err(Failure::run("stopped on request")),
            // The other groups are run all the same.
            Err(error) => {
                failed.push(format!("{}: {error}", group.name));
                continue;
            }
        };
        all += rows.len();
        failed.extend(rows.iter().filter(|row| !row.passes()).map(|row| row.quantity.clone()));
        if !display.json && !display.quiet {
            progress.aside(|| print(&table(group.name, &rows)));
        }
        groups.push(json!({ "group": group.name, "rows": rows.iter().map(as_json).collect::<Vec<_>>() }));
    }
    progress.clear();
    let passed = failed.is_empty();
    if display.json {
        print(&format!("{:#}\n", json!({ "passed": passed, "failed": failed, "groups": groups })));
    } else if !display.quiet {
        print(&format!("{} of {all} rows pass\n", all - failed.len().min(all)));
    }
    match passed {
        true => Ok(()),
        false => Err(Failure::run(format!("failed: {}", failed.join("; ")))),
    }
}

/// Two lines a row: the numbers, and where the reference is from and differs.
fn table(group: &str, rows: &[Row]) -> String {
    let mut text = format!("{group}\n");
    for row in rows {
        let verdict = if row.passes() { "pass" } else { "FAIL" };
        let unit = if row.unit == "1" { "" } else { row.unit };
        // Of a reference of zero the difference itself is shown.
        let (scale, sign) = match row.reference {
            0.0 => (1.0, ""),
            reference => (100.0 / reference.abs(), " %"),
        };
        text += &format!(
            "  {verdict}  {}: {} {unit}, reference {} {unit}; off by {}{sign}, estimated error {}{sign}\n",
            row.quantity,
            plain(row.computed),
            plain(row.reference),
            digits(scale * row.difference(), 2),
            digits(scale * row.error, 2),
        )
        .replace(" ,", ",")
        .replace(" ;", ";");
        text += &format!("        {}", row.source);
        if row.allowance.bound > 0.0 {
            text +=
                &format!("; {}: {}{sign} allowed", row.allowance.why, digits(scale * row.allowance.bound, 2));
        }
        text.push('\n');
    }
    text
}

fn as_json(row: &Row) -> serde_json::Value {
    json!({
        "quantity": row.quantity,
        "unit": row.unit,
        "computed": row.computed,
        "reference": row.reference,
        "source": row.source,
        "difference": row.difference(),
        "estimated_error": row.error,
        "allowed_difference": row.allowance.bound,
        "allowed_because": row.allowance.why,
        "passes": row.passes(),
    })
}
