//! Shipped tables are what the program computes: two cells of each metal, computed again.

use std::path::Path;

use crate::{alone, done};

#[test]
fn cells_of_shipped_tables_are_computed_again() {
    let _alone = alone();
    for (seed, name) in tables::shipped::names().enumerate() {
        print!("{}", done(Path::new("."), &format!("table check {name} --cells 1 --seed {seed}")));
    }
}
