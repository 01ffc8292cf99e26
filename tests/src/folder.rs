//! A folder in which a program is run.

use std::path::{Path, PathBuf};
use std::process::{Child, Command};

use tables::netcdf::DatasetReader;
use tempfile::TempDir;

use crate::programs::{Ended, command};

/// A folder for one program, removed at the end.
pub struct Folder {
    program: PathBuf,
    place: TempDir,
}

impl Folder {
    pub fn new(program: impl Into<PathBuf>) -> Self {
        Self { program: program.into(), place: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.place.path().join(name)
    }

    /// Writes a file, for a name or a number of text or bytes.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    pub fn dataset(&self, name: &str) -> DatasetReader {
        DatasetReader::open(&self.path(name)).unwrap()
    }

    /// Number of files and folders in it.
    pub fn entries(&self) -> usize {
        std::fs::read_dir(self.place.path()).unwrap().count()
    }

    /// The program with arguments separated by white space.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = command(&self.program, self.place.path());
        command.args(arguments.split_whitespace());
        command
    }

    /// Another program, for which the variable `PROGRAM` names this one.
    pub fn other(&self, program: &str) -> Command {
        let mut command = command(program, self.place.path());
        command.env("PROGRAM", &self.program);
        command
    }

    /// A shell script, in which the program is `$PROGRAM`.
    pub fn shell(&self, script: &str) -> Command {
        let mut shell = self.other("sh");
        shell.args(["-c", script]);
        shell
    }

    pub fn run(&self, arguments: &str) -> Ended {
        Ended::of(&mut self.command(arguments))
    }

    /// Runs the program, which must end well.
    #[track_caller]
    pub fn done(&self, arguments: &str) -> Ended {
        self.run(arguments).with_status(0)
    }

    /// Runs the program, which must refuse its input in one line with all of `parts`, and print no results.
    #[track_caller]
    pub fn refused(&self, arguments: &str, parts: &[&str]) {
        let message = self.misused(arguments, parts);
        assert_eq!(message.lines().count(), 1, "{arguments}: {message}");
    }

    /// Runs the program, which must refuse its arguments with all of `parts` in the message, and print no results;
    /// returns the message.
    #[track_caller]
    pub fn misused(&self, arguments: &str, parts: &[&str]) -> String {
        let ended = self.run(arguments);
        let message = ended.stderr;
        assert_eq!(ended.status.code(), Some(2), "{arguments}: {message}");
        assert!(ended.stdout.is_empty(), "{arguments}: {}", ended.stdout);
        for part in parts {
            assert!(message.contains(part), "{arguments}: {message} lacks {part}");
        }
        message
    }

    /// Runs a shell script as root of a mount namespace of its own; none where that is not allowed.
    pub fn in_namespace(&self, script: &str) -> Option<Ended> {
        let allowed = Command::new("unshare").args(["-rm", "mount", "-t", "tmpfs", "tmpfs", "/mnt"]).output();
        if !allowed.is_ok_and(|output| output.status.success()) {
            eprintln!("skipped: no mount namespaces here");
            return None;
        }
        Some(Ended::of(self.other("unshare").args(["-rm", "sh", "-c", script])))
    }

    /// Runs the program with its outputs on a small disk, the folder `disk`, which is then copied to the folder
    /// `left`, and temporary files in the folder itself; none where there are no mount namespaces.
    pub fn on_small_disk(&self, kilobytes: usize, arguments: &str) -> Option<Ended> {
        let script = format!(
            "mkdir -p disk; mount -t tmpfs -o size={kilobytes}k tmpfs disk; export TMPDIR=$PWD
             $PROGRAM {arguments}; status=$?; rm -rf left; cp -r disk left; exit $status"
        );
        self.in_namespace(&script)
    }
}

/// The places that a message names for files that found no room.
pub fn places(said: &str) -> Vec<&Path> {
    let places = said.split("the results are in ").skip(1);
    places.map(|rest| Path::new(rest.split_once(" instead").expect(said).0)).collect()
}

/// Sends a signal, such as `-INT`, to a program.
#[track_caller]
pub fn signal(child: &Child, signal: &str) {
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(kill.success(), "{signal} could not be sent: it has ended");
}
