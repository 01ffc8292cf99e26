//! Shipped tables are what the program computes: some of their cells again, others every day.

use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

#[test]
fn random_cells_of_shipped_tables_are_found_again() {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_secs();
    let day = (seconds / 86_400).to_string();
    for name in tables::shipped::names() {
        let arguments = ["table", "check", name, "--cells", "2", "--seed", &day];
        let output = Command::new(env!("CARGO_BIN_EXE_asperity")).args(arguments).output().unwrap();
        print!("{}", String::from_utf8_lossy(&output.stdout));
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "asperity {}: {error}", arguments.join(" "));
    }
}
