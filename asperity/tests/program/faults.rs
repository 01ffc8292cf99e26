//! Faults of a long tabulation, tested on the program itself: killed at any moment, a full disk, a directory that is
//! removed or cannot be written, a clock that is wrong, names that are links or no text, two programs at one table.
//! Finished cells are preserved, and the final table is that of an undisturbed run.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::time::Duration;

use tables::table::Status;

use crate::{alone, cells, ended, message};

const CELLS: usize = 6;
const JOBS: usize = 2;

const TABULATE: &str = "tabulate request.toml -o table.nc --jobs 2";

fn tabulate(directory: &Path, more: &str) -> Command {
    let mut command = crate::command(directory, &format!("{TABULATE} {more}"));
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// What a tabulation says that ends well.
fn tabulated(directory: &Path, more: &str) -> String {
    ended(&tabulate(directory, more).output().unwrap(), 0)
}

fn folder() -> tempfile::TempDir {
    let sections =
        "[loading]\nslip_distance = 0.02\n[table]\ninterference = [0.5, 1, 2]\nslip_rate = [0, 1]\n";
    crate::folder_with("request.toml", &format!("{sections}{}", crate::COARSE))
}

/// Cells of the table of an undisturbed run.
fn undisturbed() -> &'static [Status] {
    static CELLS: OnceLock<Vec<Status>> = OnceLock::new();
    CELLS.get_or_init(|| {
        let folder = folder();
        tabulated(folder.path(), "");
        cells(&folder.path().join("table.nc"))
    })
}

/// Results in the journal.
fn journalled(directory: &Path) -> usize {
    let text = std::fs::read_to_string(directory.join("table.nc.part")).unwrap_or_default();
    text.split_inclusive('\n').filter(|line| line.ends_with('\n')).count().saturating_sub(1)
}

/// Kills a tabulation as soon as its journal has so many results.
fn killed_with(results: usize, directory: &Path) {
    let mut child = tabulate(directory, "").spawn().unwrap();
    while journalled(directory) < results {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Continues a killed tabulation to its end; what it said, after a check of the table.
fn continued(directory: &Path) -> String {
    let said = tabulated(directory, "--resume -v");
    assert_undisturbed(directory);
    said
}

fn assert_undisturbed(directory: &Path) {
    assert_eq!(cells(&directory.join("table.nc")), undisturbed());
    assert!(!directory.join("table.nc.part").exists());
}

/// SIGKILL at moments all over the run, again and again until one run lasts to the end.
#[test]
fn killed_at_any_moment_it_continues() {
    let _alone = alone();
    let folder = folder();
    let mut kills = 0u32;
    // Moments that are spread out evenly whatever the speed of the machine (golden section).
    let mut share = 0.5;
    loop {
        let before = journalled(folder.path());
        let mut child: Child = tabulate(folder.path(), "--resume").spawn().unwrap();
        share = (share + 0.618_034) % 1.0;
        // Later and later, so that there is an end to it.
        let longest = 200.0 + 100.0 * f64::from(kills);
        std::thread::sleep(Duration::from_millis(30 + (longest * share) as u64));
        // No effect if it has ended.
        child.kill().unwrap();
        let output = child.wait_with_output().unwrap();
        if output.status.code() == Some(0) {
            break;
        }
        assert_eq!(output.status.code(), None, "{}", message(&output));
        kills += 1;
        // The journal is removed once the table is written.
        let complete = folder.path().join("table.nc").exists();
        assert!(complete || journalled(folder.path()) >= before, "a result was lost");
        assert!(kills < 200, "no progress");
    }
    assert!(kills > 0, "never killed");
    assert_undisturbed(folder.path());
}

/// Killed as soon as there are results: at most those in flight are done again.
#[test]
fn only_cells_in_flight_are_done_again() {
    let _alone = alone();
    let folder = folder();
    killed_with(2, folder.path());
    let kept = journalled(folder.path());
    assert!(kept + JOBS <= CELLS, "all done before it could be killed");
    let said = continued(folder.path());
    assert!(said.contains(&format!("{kept} cells were taken from the journal")), "{said}");
}

/// Runs a shell script as root of a mount namespace of its own; none where that is not allowed.
pub fn in_namespace(directory: &Path, script: &str) -> Option<Output> {
    let allowed = Command::new("unshare").args(["-rm", "mount", "-t", "tmpfs", "tmpfs", "/mnt"]).output();
    if !allowed.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: no mount namespaces here");
        return None;
    }
    let mut command = Command::new("unshare");
    command.args(["-rm", "sh", "-c", script]).current_dir(directory);
    command.env("ASPERITY", env!("CARGO_BIN_EXE_asperity"));
    Some(command.output().unwrap())
}

/// A disk with a given number of kilobytes left: a table, or an error and then, with room, the same table.
#[test]
fn a_full_disk_loses_nothing() {
    let _alone = alone();
    for kilobytes in [0, 4, 24, 48, 64, 80, 120] {
        let folder = folder();
        let script = format!(
            "set -e; mkdir disk; mount -t tmpfs -o size=1m tmpfs disk; cp request.toml disk; cd disk
             dd if=/dev/zero of=filler bs=1k count=$((1024 - 4 - {kilobytes})) 2>/dev/null
             run() {{ $ASPERITY tabulate request.toml -o table.nc --jobs 2 --quiet $1; }}
             status=0; run || status=$?; echo \"first $status\"
             if [ $status != 0 ]; then rm filler; run --resume; fi
             cp table.nc ..; ls -A > ../left"
        );
        let Some(output) = in_namespace(folder.path(), &script) else { return };
        let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), message(&output));
        assert_eq!(output.status.code(), Some(0), "{kilobytes} kB: {said}");
        if !said.contains("first 0") {
            assert!(said.contains("error: ") && !said.contains("panicked"), "{kilobytes} kB: {said}");
            assert!(said.contains("no space left") || said.contains("cannot"), "{kilobytes} kB: {said}");
        }
        assert_eq!(cells(&folder.path().join("table.nc")), undisturbed(), "{kilobytes} kB");
        let left = std::fs::read_to_string(folder.path().join("left")).unwrap();
        let strays: Vec<&str> =
            left.lines().filter(|name| !["filler", "request.toml", "table.nc"].contains(name)).collect();
        assert!(strays.is_empty(), "{kilobytes} kB: {strays:?}");
    }
}

#[test]
fn a_directory_that_cannot_be_written_is_refused_at_once() {
    let _alone = alone();
    let folder = folder();
    let script = "mkdir disk; mount -t tmpfs tmpfs disk; cp request.toml disk; mount -o remount,ro disk
                  cd disk; exec $ASPERITY tabulate request.toml -o table.nc";
    let Some(output) = in_namespace(folder.path(), script) else { return };
    let said = ended(&output, 2);
    assert!(said.contains("Read-only file system"), "{said}");
}

/// The directory of the table is removed while it is being made.
#[test]
fn a_directory_that_vanishes_ends_the_run() {
    let _alone = alone();
    let folder = folder();
    let place = folder.path().join("place");
    std::fs::create_dir(&place).unwrap();
    let mut command =
        crate::command(folder.path(), "tabulate request.toml -o place/table.nc --jobs 2 --quiet");
    let child = command.stderr(Stdio::piped()).spawn().unwrap();
    while journalled(&place) < 1 {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::fs::remove_dir_all(&place).unwrap();
    let said = ended(&child.wait_with_output().unwrap(), 1);
    assert!(said.contains("table.nc"), "{said}");
}

/// Two programs at one table: one makes it, the other ends with a message.
#[test]
fn two_programs_do_not_disturb_each_other() {
    let _alone = alone();
    let folder = folder();
    let first = tabulate(folder.path(), "--resume").spawn().unwrap();
    let second = tabulate(folder.path(), "--resume").spawn().unwrap();
    let outputs = [first, second].map(|child| child.wait_with_output().unwrap());
    let codes = outputs.each_ref().map(|output| output.status.code());
    assert!(codes.contains(&Some(0)), "{codes:?}");
    for output in outputs.iter().filter(|output| output.status.code() != Some(0)) {
        let said = ended(output, 2);
        assert!(said.contains("another program is making this table"), "{said}");
    }
    assert_undisturbed(folder.path());
}

#[test]
fn a_finished_table_is_not_computed_again() {
    let _alone = alone();
    let folder = folder();
    let table = folder.path().join("table.nc");
    tabulated(folder.path(), "");
    let before = std::fs::read(&table).unwrap();
    let said = crate::done(folder.path(), &format!("{TABULATE} --resume"));
    assert!(said.contains("table.nc: the table of this request is complete"), "{said}");
    assert_eq!(std::fs::read(&table).unwrap(), before);
    // That of another request is not replaced.
    let other = "--set table.interference=[0.5]";
    let resumed = format!("{TABULATE} --resume {other}");
    crate::refused(folder.path(), &resumed, &["table.nc: holds a table of another request"]);
    assert_eq!(std::fs::read(&table).unwrap(), before);
    let said = tabulated(folder.path(), other);
    assert!(
        said.contains("warning: table.nc: holds a table of another request, or another part of it"),
        "{said}"
    );
    assert_ne!(std::fs::read(&table).unwrap(), before);
}

/// A table that a transfer cut off, and any other file.
#[test]
fn resuming_does_not_replace_what_is_no_table() {
    let _alone = alone();
    let folder = folder();
    let table = folder.path().join("table.nc");
    std::fs::write(&table, "notes").unwrap();
    let resumed = format!("{TABULATE} --resume");
    crate::refused(folder.path(), &resumed, &["table.nc", "--resume would replace the file"]);
    assert_eq!(std::fs::read(&table).unwrap(), b"notes");
    let said = tabulated(folder.path(), "");
    assert!(said.contains("the table replaces the file when it is done"), "{said}");
    let whole = std::fs::read(&table).unwrap();
    std::fs::write(&table, &whole[..whole.len() / 2]).unwrap();
    crate::refused(folder.path(), &resumed, &["table.nc", "--resume would replace the file"]);
}

/// A table called by a link is the table that the link leads to.
#[test]
fn a_journal_is_beside_the_table_whatever_link_leads_to_it() {
    use asperity::tabulate::Journal;

    let folder = tempfile::tempdir().unwrap();
    let [table, link] = ["table.nc", "link.nc"].map(|name| folder.path().join(name));
    std::os::unix::fs::symlink("table.nc", &link).unwrap();
    assert_eq!(Journal::beside(&link), Journal::beside(&table));
}

/// A clock that is set back by an hour at every look at it, where the library that does so is installed
/// (`apt-get install libfaketime`).
#[test]
fn a_clock_may_go_backwards() {
    let _alone = alone();
    let library = std::fs::read_dir("/usr/lib").into_iter().flatten().flatten();
    let library =
        library.map(|entry| entry.path().join("faketime/libfaketime.so.1")).find(|path| path.exists());
    let Some(library) = library else {
        eprintln!("skipped: no libfaketime here");
        return;
    };
    let folder = folder();
    let mut command = tabulate(folder.path(), "--progress --timings");
    // Of the clock of the day alone: a monotonic one does not do so.
    command.env("LD_PRELOAD", library).env("FAKETIME", "-1h i-3600").env("FAKETIME_DONT_FAKE_MONOTONIC", "1");
    let said = ended(&command.output().unwrap(), 0);
    assert!(!said.contains("panicked"), "{said}");
    assert_undisturbed(folder.path());
}

/// Names with spaces and names that are not UTF-8, of the request, the table and its folder; outputs that are links are
/// written where the links lead to, and the links stay.
#[test]
fn names_may_be_anything_and_links_are_followed() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::symlink;

    let _alone = alone();
    let folder = folder();
    let odd = folder.path().join(OsStr::from_bytes(b"a folder \xff\xfe"));
    let targets = odd.join("large disk");
    std::fs::create_dir_all(&targets).unwrap();
    let [request, table, figure] = [&b"request \xff.toml"[..], b"my table \xff.nc", b"\xe9.svg"]
        .map(|name| odd.join(OsStr::from_bytes(name)));
    symlink("../request.toml", &request).unwrap();
    for (link, target) in [(&table, "large disk/table.nc"), (&figure, "large disk/figure.svg")] {
        symlink(target, link).unwrap();
    }
    let mut command = crate::command(folder.path(), "tabulate --jobs 2 -o");
    ended(&command.arg(&table).arg("--plot").arg(&figure).arg(&request).output().unwrap(), 0);
    assert_eq!(cells(&table), undisturbed());
    for (link, target) in [(&table, "table.nc"), (&figure, "figure.svg")] {
        assert!(link.is_symlink() && targets.join(target).is_file(), "{target}");
    }
    let entries = [&odd, &targets].map(|folder| std::fs::read_dir(folder).unwrap().count());
    assert_eq!(entries, [4, 2], "something was left behind");
}
