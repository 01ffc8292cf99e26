//! The rows of `asperity verify --quick`, each against its own source.

use asperity::simulate::Unwatched;
use asperity::studies::verification::{Extent, GROUPS};

#[test]
fn every_row_of_the_quick_verification_passes() {
    let mut failed = Vec::new();
    for group in GROUPS {
        let rows =
            group.rows(Extent::Quick, &Unwatched).unwrap_or_else(|error| panic!("{}: {error}", group.name));
        assert!(!rows.is_empty(), "{} has no rows", group.name);
        failed.extend(rows.into_iter().filter(|row| !row.passes()));
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
