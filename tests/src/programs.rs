//! The programs, as a user starts them.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Output};
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

/// What a program leaves that has ended.
#[derive(Debug)]
pub struct Ended {
    pub status: ExitStatus,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Self { status: output.status, stdout: text(&output.stdout), stderr: text(&output.stderr) }
    }
}

impl Ended {
    /// Runs a command to its end.
    pub fn of(command: &mut Command) -> Self {
        let output = command.output();
        output.unwrap_or_else(|error| panic!("{}: {error}", command.get_program().display())).into()
    }

    /// Waits for a program that was started.
    pub fn awaited(child: Child) -> Self {
        child.wait_with_output().unwrap().into()
    }

    /// The same of a program that must have ended with this exit status.
    #[track_caller]
    pub fn with_status(self, status: i32) -> Self {
        assert_eq!(self.status.code(), Some(status), "{}", self.stderr);
        self
    }

    /// The results that it printed.
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap()
    }
}

/// A command to be run in `folder`.
pub fn command(program: impl AsRef<Path>, folder: &Path) -> Command {
    let mut command = Command::new(program.as_ref());
    // A program started at the same time may have inherited the lock of a file that a test has open.
    command.current_dir(folder).env("HDF5_USE_FILE_LOCKING", "FALSE");
    command
}

/// What becomes of the program in a file, with arguments separated by white space.
pub fn execute_file(program: &Path, folder: &Path, arguments: &str) -> Ended {
    Ended::of(command(program, folder).args(arguments.split_whitespace()))
}

/// What becomes of the program of this name.
pub fn execute(name: &str, folder: &Path, arguments: &str) -> Ended {
    execute_file(&program(name), folder, arguments)
}

/// The same of a program that must end well.
#[track_caller]
pub fn done(name: &str, folder: &Path, arguments: &str) -> Ended {
    execute(name, folder, arguments).with_status(0)
}

/// The ignored test `name` of this file in a process of its own, with memory for inputs of ordinary size.
pub fn in_little_memory(name: &str, variables: &[(&str, String)]) -> Ended {
    /// kB.
    const MEMORY: usize = 1_000_000;
    let script = format!("ulimit -v {MEMORY}; exec \"$0\" --exact {name} --ignored --nocapture");
    let mut shell = Command::new("sh");
    shell.args(["-c".as_ref(), script.as_ref(), std::env::current_exe().unwrap().as_os_str()]);
    shell.envs(variables.iter().map(|(name, value)| (name, value))).env("RUST_BACKTRACE", "0");
    Ended::of(&mut shell)
}
