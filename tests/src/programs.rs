//! The programs, as a user starts them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// The program `name`, built by the same profile as this test.
pub fn program(name: &str) -> PathBuf {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| built("--bins")).join(name)
}

/// The example `name`.
pub fn example(name: &str) -> PathBuf {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| built("--examples").join("examples")).join(name)
}

/// The folder of this test's profile, with the programs or examples of the whole workspace: for a part of it, cargo
/// compiles dependencies anew.
fn built(kind: &str) -> PathBuf {
    // target/<profile>/deps/<this test>
    let test = std::env::current_exe().unwrap();
    let folder = test.parent().and_then(Path::parent).unwrap().to_path_buf();
    let profile = match folder.file_name().and_then(|name| name.to_str()) {
        Some("debug") | None => "dev",
        Some(profile) => profile,
    };
    let status = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--offline", "--workspace", kind, "--profile", profile])
        .arg("--target-dir")
        .arg(folder.parent().unwrap())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .status()
        .unwrap();
    assert!(status.success(), "they could not be built: {kind}");
    folder
}

/// What becomes of a program started in `folder` with these arguments, without blanks in them.
pub fn execute(name: &str, folder: &Path, arguments: &str) -> Output {
    execute_file(&program(name), folder, arguments)
}

/// The same of a program that ends well.
pub fn done(name: &str, folder: &Path, arguments: &str) -> Output {
    let output = execute(name, folder, arguments);
    assert!(output.status.success(), "{name} {arguments}: {}", stderr(&output));
    output
}

/// What becomes of the program in a file.
pub fn execute_file(program: &Path, folder: &Path, arguments: &str) -> Output {
    Command::new(program)
        .args(arguments.split_whitespace())
        .current_dir(folder)
        // A program started at the same time may have inherited the lock of a file being written.
        .env("HDF5_USE_FILE_LOCKING", "FALSE")
        .output()
        .unwrap_or_else(|error| panic!("{}: {error}", program.display()))
}

/// The ignored test `name` of this file in a process of its own, with memory for inputs of ordinary size.
pub fn in_little_memory(name: &str, variables: &[(&str, String)]) -> Output {
    /// kB.
    const MEMORY: usize = 1_000_000;
    let script = format!("ulimit -v {MEMORY}; exec \"$0\" --exact {name} --ignored --nocapture");
    Command::new("sh")
        .args(["-c".as_ref(), script.as_ref(), std::env::current_exe().unwrap().as_os_str()])
        .envs(variables.iter().map(|(name, value)| (name, value)))
        .env("RUST_BACKTRACE", "0")
        .output()
        .unwrap()
}

/// Its standard error.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
