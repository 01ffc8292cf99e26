//! The rows of `asperity verify` that take seconds each, every one against its own source and by its own tolerance.

use asperity::simulate::Unwatched;
use asperity::studies::verification::{Cost, GROUPS, Row, Tally};

/// Least share of the errors stated by the program that cover the deviation: 95 % intervals.
const COVERED: f64 = 0.9;

#[test]
fn every_row_passes_by_its_tolerance() {
    let mut rows: Vec<Row> = Vec::new();
    for group in GROUPS {
        let of_group = group.rows(Cost::Medium, &Unwatched);
        rows.extend(of_group.unwrap_or_else(|error| panic!("{}: {error}", group.name)));
    }
    let failed: Vec<&Row> = rows.iter().filter(|row| !row.passes()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let tally = Tally::of(&rows);
    let uncovered: Vec<&Row> = rows.iter().filter(|row| row.covered() == Some(false)).collect();
    println!("{tally:?}; not covered: {uncovered:#?}");
    assert!(tally.stated > 30, "{tally:?}");
    assert!(tally.covered as f64 >= COVERED * tally.stated as f64, "{tally:?}: {uncovered:#?}");
}

#[test]
fn every_group_has_quick_rows_and_every_case_a_name_of_its_own() {
    let mut names = std::collections::BTreeSet::new();
    for group in GROUPS {
        assert!(group.cases.iter().any(|case| case.cost == Cost::Quick), "{}", group.name);
        for case in group.cases {
            assert!(names.insert((group.name, case.name)), "{}", case.name);
        }
    }
}
