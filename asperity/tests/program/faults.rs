//! Faults of a long tabulation, tested on the program itself: killed at any moment, a full disk, a directory that is
//! removed or cannot be written, a clock that is wrong, names that are links or no text, two programs at one table.
//! Finished cells are preserved, and the final table is that of an undisturbed run.

use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::time::Duration;

use tables::table::Status;
use tests::folder::Folder;
use tests::programs::Ended;

use crate::cells;

const CELLS: usize = 6;
const JOBS: usize = 2;

const TABULATE: &str = "tabulate request.toml -o table.nc --jobs 2";

fn tabulate(directory: &Folder, more: &str) -> Command {
    let mut command = directory.command(&format!("{TABULATE} {more}"));
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// What a tabulation says that ends well.
fn tabulated(directory: &Folder, more: &str) -> String {
    Ended::of(&mut tabulate(directory, more)).with_status(0).stderr
}

fn folder() -> Folder {
    let sections =
        "[loading]\nslip_distance = 0.02\n[table]\ninterference = [0.5, 1, 2]\nslip_rate = [0, 1]\n";
    crate::folder_with("request.toml", &format!("{sections}{}", crate::COARSE))
}

/// Cells of the table of an undisturbed run.
fn undisturbed() -> &'static [Status] {
    static CELLS: OnceLock<Vec<Status>> = OnceLock::new();
    CELLS.get_or_init(|| {
        let folder = folder();
        tabulated(&folder, "");
        cells(&folder.path("table.nc"))
    })
}

/// Results in the journal `name`.
fn results_in(directory: &Folder, name: &str) -> usize {
    let text = std::fs::read_to_string(directory.path(name)).unwrap_or_default();
    text.split_inclusive('\n').filter(|line| line.ends_with('\n')).count().saturating_sub(1)
}

/// Results in the journal of the table.
fn journalled(directory: &Folder) -> usize {
    results_in(directory, "table.nc.part")
}

/// Kills a tabulation as soon as its journal has so many results.
fn killed_with(results: usize, directory: &Folder) {
    let mut child = tabulate(directory, "").spawn().unwrap();
    while journalled(directory) < results {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Continues a killed tabulation to its end; what it said, after a check of the table.
fn continued(directory: &Folder) -> String {
    let said = tabulated(directory, "--resume -v");
    assert_undisturbed(directory);
    said
}

fn assert_undisturbed(directory: &Folder) {
    assert_eq!(cells(&directory.path("table.nc")), undisturbed());
    assert!(!directory.path("table.nc.part").exists());
}

/// SIGKILL at moments all over the run, again and again until one run lasts to the end.
#[test]
fn killed_at_any_moment_it_continues() {
    let folder = folder();
    let mut kills = 0u32;
    // Moments that are spread out evenly whatever the speed of the machine (golden section).
    let mut share = 0.5;
    loop {
        let before = journalled(&folder);
        let mut child: Child = tabulate(&folder, "--resume").spawn().unwrap();
        share = (share + 0.618_034) % 1.0;
        // Later and later, so that there is an end to it.
        let longest = 200.0 + 100.0 * f64::from(kills);
        std::thread::sleep(Duration::from_millis(30 + (longest * share) as u64));
        // No effect if it has ended.
        child.kill().unwrap();
        let output = Ended::awaited(child);
        if output.status.code() == Some(0) {
            break;
        }
        assert_eq!(output.status.code(), None, "{}", output.stderr);
        kills += 1;
        // The journal is removed once the table is written.
        let complete = folder.path("table.nc").exists();
        assert!(complete || journalled(&folder) >= before, "a result was lost");
        assert!(kills < 200, "no progress");
    }
    assert!(kills > 0, "never killed");
    assert_undisturbed(&folder);
}

/// Killed as soon as there are results: at most those in flight are done again.
#[test]
fn only_cells_in_flight_are_done_again() {
    let folder = folder();
    killed_with(2, &folder);
    let kept = journalled(&folder);
    assert!(kept + JOBS <= CELLS, "all done before it could be killed");
    let said = continued(&folder);
    assert!(said.contains(&format!("{kept} cells were taken from the journal")), "{said}");
}

/// A disk with a given number of kilobytes left: a table, or an error and then, with room, the same table.
#[test]
fn a_full_disk_loses_nothing() {
    for kilobytes in [0, 4, 24, 48, 64, 80, 120] {
        let folder = folder();
        let script = format!(
            "set -e; mkdir disk; mount -t tmpfs -o size=1m tmpfs disk; cp request.toml disk; cd disk
             dd if=/dev/zero of=filler bs=1k count=$((1024 - 4 - {kilobytes})) 2>/dev/null
             run() {{ $PROGRAM tabulate request.toml -o table.nc --jobs 2 --quiet $1; }}
             status=0; run || status=$?; echo \"first $status\"
             if [ $status != 0 ]; then rm filler; run --resume; fi
             cp table.nc ..; ls -A > ../left"
        );
        let Some(output) = folder.in_namespace(&script) else { return };
        let said = format!("{}{}", output.stdout, output.stderr);
        assert_eq!(output.status.code(), Some(0), "{kilobytes} kB: {said}");
        if !said.contains("first 0") {
            assert!(said.contains("error: ") && !said.contains("panicked"), "{kilobytes} kB: {said}");
            assert!(said.contains("no space left") || said.contains("cannot"), "{kilobytes} kB: {said}");
        }
        assert_eq!(cells(&folder.path("table.nc")), undisturbed(), "{kilobytes} kB");
        let left = folder.read("left");
        let strays: Vec<&str> =
            left.lines().filter(|name| !["filler", "request.toml", "table.nc"].contains(name)).collect();
        assert!(strays.is_empty(), "{kilobytes} kB: {strays:?}");
    }
}

#[test]
fn a_directory_that_cannot_be_written_is_refused_at_once() {
    let folder = folder();
    let script = "mkdir disk; mount -t tmpfs tmpfs disk; cp request.toml disk; mount -o remount,ro disk
                  cd disk; exec $PROGRAM tabulate request.toml -o table.nc";
    let Some(output) = folder.in_namespace(script) else { return };
    let said = output.with_status(2).stderr;
    assert!(said.contains("Read-only file system"), "{said}");
}

/// The directory of the table is removed while it is being made.
#[test]
fn a_directory_that_vanishes_ends_the_run() {
    let folder = folder();
    let place = folder.path("place");
    std::fs::create_dir(&place).unwrap();
    let mut command = folder.command("tabulate request.toml -o place/table.nc --jobs 2 --quiet");
    let child = command.stderr(Stdio::piped()).spawn().unwrap();
    while results_in(&folder, "place/table.nc.part") < 1 {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::fs::remove_dir_all(&place).unwrap();
    let said = Ended::awaited(child).with_status(1).stderr;
    assert!(said.contains("table.nc"), "{said}");
}

/// Two programs at one table: one makes it, the other ends with a message.
#[test]
fn two_programs_do_not_disturb_each_other() {
    let folder = folder();
    let first = tabulate(&folder, "--resume").spawn().unwrap();
    let second = tabulate(&folder, "--resume").spawn().unwrap();
    let outputs = [first, second].map(Ended::awaited);
    let codes = outputs.each_ref().map(|output| output.status.code());
    assert!(codes.contains(&Some(0)), "{codes:?}");
    for output in outputs.into_iter().filter(|output| output.status.code() != Some(0)) {
        let said = output.with_status(2).stderr;
        assert!(said.contains("another program is making this table"), "{said}");
    }
    assert_undisturbed(&folder);
}

#[test]
fn a_finished_table_is_not_computed_again() {
    let folder = folder();
    let table = folder.path("table.nc");
    tabulated(&folder, "");
    let before = std::fs::read(&table).unwrap();
    let said = folder.done(&format!("{TABULATE} --resume")).stdout;
    assert!(said.contains("table.nc: the table of this request is complete"), "{said}");
    assert_eq!(std::fs::read(&table).unwrap(), before);
    // That of another request is not replaced.
    let other = "--set table.interference=[0.5]";
    let resumed = format!("{TABULATE} --resume {other}");
    folder.refused(&resumed, &["table.nc: holds a table of another request"]);
    assert_eq!(std::fs::read(&table).unwrap(), before);
    let said = tabulated(&folder, other);
    assert!(
        said.contains("warning: table.nc: holds a table of another request, or another part of it"),
        "{said}"
    );
    assert_ne!(std::fs::read(&table).unwrap(), before);
}

/// A table that a transfer cut off, and any other file.
#[test]
fn resuming_does_not_replace_what_is_no_table() {
    let folder = folder();
    let table = folder.path("table.nc");
    std::fs::write(&table, "notes").unwrap();
    let resumed = format!("{TABULATE} --resume");
    folder.refused(&resumed, &["table.nc", "--resume would replace the file"]);
    assert_eq!(std::fs::read(&table).unwrap(), b"notes");
    let said = tabulated(&folder, "");
    assert!(said.contains("the table replaces the file when it is done"), "{said}");
    let whole = std::fs::read(&table).unwrap();
    std::fs::write(&table, &whole[..whole.len() / 2]).unwrap();
    folder.refused(&resumed, &["table.nc", "--resume would replace the file"]);
}

/// A table called by a link is the table that the link leads to.
#[test]
fn a_journal_is_beside_the_table_whatever_link_leads_to_it() {
    use asperity::tabulate::Journal;

    let folder = crate::empty_folder();
    let [table, link] = ["table.nc", "link.nc"].map(|name| folder.path(name));
    std::os::unix::fs::symlink("table.nc", &link).unwrap();
    assert_eq!(Journal::beside(&link), Journal::beside(&table));
}

/// A clock that is set back by an hour at every look at it, where the library that does so is installed
/// (`apt-get install libfaketime`).
#[test]
fn a_clock_may_go_backwards() {
    let library = std::fs::read_dir("/usr/lib").into_iter().flatten().flatten();
    let library =
        library.map(|entry| entry.path().join("faketime/libfaketime.so.1")).find(|path| path.exists());
    let Some(library) = library else {
        eprintln!("skipped: no libfaketime here");
        return;
    };
    let folder = folder();
    let mut command = tabulate(&folder, "--progress --timings");
    // Of the clock of the day alone: a monotonic one does not do so.
    command.env("LD_PRELOAD", library).env("FAKETIME", "-1h i-3600").env("FAKETIME_DONT_FAKE_MONOTONIC", "1");
    let said = Ended::of(&mut command).with_status(0).stderr;
    assert!(!said.contains("panicked"), "{said}");
    assert_undisturbed(&folder);
}

/// Names with spaces and names that are not UTF-8, of the request, the table and its folder; outputs that are links are
/// written where the links lead to, and the links stay.
#[test]
fn names_may_be_anything_and_links_are_followed() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::symlink;

    let folder = folder();
    let odd = folder.path(OsStr::from_bytes(b"a folder \xff\xfe"));
    let targets = odd.join("large disk");
    std::fs::create_dir_all(&targets).unwrap();
    let [request, table, figure] = [&b"request \xff.toml"[..], b"my table \xff.nc", b"\xe9.svg"]
        .map(|name| odd.join(OsStr::from_bytes(name)));
    symlink("../request.toml", &request).unwrap();
    for (link, target) in [(&table, "large disk/table.nc"), (&figure, "large disk/figure.svg")] {
        symlink(target, link).unwrap();
    }
    let mut command = folder.command("tabulate --jobs 2 -o");
    Ended::of(command.arg(&table).arg("--plot").arg(&figure).arg(&request)).with_status(0);
    assert_eq!(cells(&table), undisturbed());
    for (link, target) in [(&table, "table.nc"), (&figure, "figure.svg")] {
        assert!(link.is_symlink() && targets.join(target).is_file(), "{target}");
    }
    let entries = [&odd, &targets].map(|folder| std::fs::read_dir(folder).unwrap().count());
    assert_eq!(entries, [4, 2], "something was left behind");
}
