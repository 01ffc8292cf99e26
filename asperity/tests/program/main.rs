//! The program from outside: exit status, messages, files, and what a crash, a signal or a full disk leave.

mod command_line;
#[cfg(target_os = "linux")]
mod faults;
mod initial_temperatures;
mod interrupt;
mod paraview;
mod shards_and_tables;
mod shipped_tables;
#[cfg(target_os = "linux")]
mod streams_and_disks;
mod threads;

use std::path::Path;
use std::process::{Command, Output};
use std::sync::{Mutex, MutexGuard};

use tables::table::{Cell, Status, Table};

/// One test at a time: a program started by one would inherit the files that another has open in
/// the HDF5 library, and their locks.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// The program with arguments separated by blanks.
fn command(directory: &Path, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.args(line.split(' ').filter(|word| !word.is_empty())).current_dir(directory);
    command
}

fn asperity(directory: &Path, line: &str) -> Output {
    command(directory, line).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A sphere of which only the sections on loading, numerics and table are to be added.
const SPHERE: &str = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n";

/// A mesh as coarse as there is, on which no accuracy is asked.
const COARSE: &str = "[numerics]\nelements_per_radius = 4\nsectors = 4\naccuracy = 0.5\n";

/// A folder with a file of these sections for [`SPHERE`].
fn folder_with(name: &str, sections: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), format!("{SPHERE}{sections}")).unwrap();
    folder
}

/// The cells of a table at all its initial temperatures, but for the times that they took.
fn cells(table: &Path) -> Vec<Status> {
    let table = Table::read(table).unwrap();
    let of_slices = table.slices().iter().flat_map(|slice| slice.grid().map(|(i, j)| slice.status(i, j)));
    let timeless = |status: &Status| match status {
        Status::Done(cell) => Status::Done(Box::new(Cell { wall_time: 0.0, ..(**cell).clone() })),
        other => other.clone(),
    };
    of_slices.map(timeless).collect()
}

/// What the program wrote on stderr.
fn message(output: &Output) -> String {
    text(&output.stderr)
}

/// The same of a program that ended with this exit status.
fn ended(output: &Output, status: i32) -> String {
    let said = message(output);
    assert_eq!(output.status.code(), Some(status), "{said}");
    said
}

/// Exit status 0; what the program printed.
fn done(directory: &Path, line: &str) -> String {
    let output = asperity(directory, line);
    ended(&output, 0);
    text(&output.stdout)
}

/// Exit status 2, an empty stdout, and one line on stderr with all of `parts`.
fn refused(directory: &Path, line: &str, parts: &[&str]) {
    let output = asperity(directory, line);
    let message = message(&output);
    assert_eq!(output.status.code(), Some(2), "{line}: {message}");
    assert_eq!(message.lines().count(), 1, "{line}: {message}");
    assert!(output.stdout.is_empty(), "{line}");
    for part in parts {
        assert!(message.contains(part), "{line}: {message} lacks {part}");
    }
}
