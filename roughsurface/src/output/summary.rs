//! The summary of a prediction as text.

use crate::friction::regime::regime;
use crate::output::cutoffs;
use crate::output::rate_laws;
use crate::output::rate_step;
use crate::output::result_tables::{NO_SHARE, NOT_AVAILABLE, Rows, compared, parameters, quantities};
use crate::sampling::case::Results;
use crate::surface::query::NormalLoading;
use tables::numbers;

/// Columns of the summary but for the separation or the pressure, whichever is not given: quantity and heading.
const COLUMNS: [(&str, &str); 10] = [
    ("mu_static", "mu_static"),
    ("mu", "mu"),
    ("mu_steady", "mu_steady"),
    ("dmu_dlnV", "dmu/dlnV"),
    ("G", "G [J/m2]"),
    ("G_weakening", "G_weakening [J/m2]"),
    ("real_area_fraction", "area fraction"),
    ("temperature_mean", "T mean [K]"),
    ("temperature_max", "T max [K]"),
    ("outside_table_fraction", OUTSIDE),
];
const OUTSIDE: &str = "outside table";

/// The prediction as lines of text.
pub fn text(results: &Results) -> String {
    let psi = results.prediction.plasticity_index;
    let other = match results.prediction.query.loading {
        NormalLoading::Pressure(_) => ("separation", "separation [m]"),
        NormalLoading::Separation(_) => ("pressure", "pressure [Pa]"),
    };
    let columns = [&COLUMNS[..], &[other]].concat();
    let table = aligned(&without_empty(quantities(results, &columns), OUTSIDE));
    let mut text = format!("Plasticity index {psi:.3}: {}\n\n{table}", regime(psi));
    for (title, rows) in [
        ("Influence of the cut-off of the topography:", cutoffs::rows(results)),
        ("Standard deviations from uncertain parameters (± above: 95 %):", parameters(results)),
        ("With asperities after models of the literature:", compared(results)),
        ("Step of the slip rate in steady sliding:", rate_step::rows(results)),
        (
            "Rate dependence of mu, and flash heating with mu_w as mu_inf and V_w as V*:",
            rate_laws::rows(results),
        ),
    ] {
        if !rows.is_empty() {
            text.push_str(&format!("\n{title}\n{}", aligned(&rows)));
        }
    }
    text + &rate_laws::footnotes(results).map(|line| line + "\n").collect::<String>()
}

/// The rows without the column of this heading if no row has a number there.
fn without_empty(mut rows: Rows, heading: &str) -> Rows {
    let column = rows[0].iter().position(|head| head == heading).expect("a heading of the rows");
    if rows[1..].iter().all(|row| row[column] == NO_SHARE) {
        rows.iter_mut().for_each(|row| drop(row.remove(column)));
    }
    rows
}

/// Numbers to the right and text to the left.
fn aligned(rows: &Rows) -> String {
    let columns = rows[0].len();
    let is_text = |column: usize| {
        let complete = rows[1..].iter().find(|row| row.len() == columns);
        complete
            .is_some_and(|row| row[column] != NOT_AVAILABLE && row[column].starts_with(char::is_alphabetic))
    };
    numbers::aligned(rows, "   ", is_text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let row = |cells: &[&str]| cells.iter().map(|cell| cell.to_string()).collect();
        let text = aligned(&vec![row(&["a", "bbb"]), row(&["12", "d"]), row(&["e"])]);
        assert_eq!(text, " a   bbb\n12   d\ne\n");
    }
}
