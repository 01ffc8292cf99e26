//! Shipped tables are what the program computes: two cells of each, computed again.

use std::path::Path;

use crate::{alone, done};

#[test]
fn cells_of_shipped_tables_are_computed_again() {
    let _alone = alone();
    for name in tables::shipped::names() {
        print!("{}", done(Path::new("."), &format!("table check {name} --cells 2 --seed 1")));
    }
}
