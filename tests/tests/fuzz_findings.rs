//! What fuzzing has found (`tests/fuzz`), minimised: each is refused as damaged, with memory for files of
//! ordinary size.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::Command;

use roughsurface::topography::readers::{Reading, read};

/// Of the process that reads, in kB.
const MEMORY: usize = 1_000_000;

fn findings() -> Vec<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/findings/topography");
    std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect()
}

#[test]
#[ignore = "run by the other test, in a process of its own with little memory"]
fn reads_all() {
    for path in findings() {
        let message = read(&path, &Reading::default()).unwrap_err().to_string();
        assert!(message.contains("damaged: its header asks for more"), "{}: {message}", path.display());
    }
}

#[test]
fn findings_are_refused_in_little_memory() {
    assert!(findings().len() >= 2);
    let script = format!("ulimit -v {MEMORY}; exec \"$0\" --exact reads_all --ignored");
    let program = std::env::current_exe().unwrap();
    let output =
        Command::new("sh").args(["-c".as_ref(), script.as_ref(), program.as_os_str()]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "{}: {said}", output.status);
}
