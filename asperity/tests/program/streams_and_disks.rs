//! Standard streams that cannot be written, and results for which there is no room: files first, words second, and
//! nothing lost without a message.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use tables::netcdf::DatasetReader;

use crate::faults::in_namespace;
use crate::{alone, message};

const SCENE: &str = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
                     [loading]\ninterference = 1\nslip_rate = 0\nslip_distance = 0.02\n\
                     [numerics]\nelements_per_radius = 4\nsectors = 4\naccuracy = 0.5\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    folder
}

fn shell(directory: &Path, script: &str) -> Output {
    let mut command = Command::new("sh");
    command.args(["-c", script]).current_dir(directory).env("ASPERITY", env!("CARGO_BIN_EXE_asperity"));
    command.output().unwrap()
}

/// Whether the run in this file is complete; the file is removed.
fn taken(path: &Path) -> bool {
    let complete = DatasetReader::open(path).unwrap().attribute_text("completion").unwrap() == "complete";
    std::fs::remove_file(path).unwrap();
    complete
}

#[test]
fn results_are_written_where_words_cannot_be() {
    let _alone = alone();
    let folder = folder();
    let run = "exec $ASPERITY run scene.toml -o run.nc --set loading.temperature=400";
    // Standard error has a warning, notes and progress; what is lost on standard output is a failure.
    for (streams, status) in [
        ("-v --progress 2>/dev/full", 0),
        ("-v --progress 2>&-", 0),
        ("--json >/dev/full", 1),
        (">/dev/full", 1),
        ("--quiet >/dev/full", 0),
        (">/dev/full 2>/dev/full", 1),
    ] {
        let output = shell(folder.path(), &format!("{run} {streams}"));
        assert_eq!(output.status.code(), Some(status), "{streams}: {}", message(&output));
        assert!(taken(&folder.path().join("run.nc")), "{streams}");
        let said = message(&output);
        assert!(status == 0 || streams.contains("2>") || said.contains("standard output cannot be written"));
    }
    for line in ["--help >/dev/full", "materials >/dev/full", "table list --json >/dev/full"] {
        let output = shell(folder.path(), &format!("exec $ASPERITY {line}"));
        assert_eq!(output.status.code(), Some(1), "{line}: {}", message(&output));
    }
}

#[test]
fn closed_pipes_lose_no_results() {
    let _alone = alone();
    let folder = folder();
    let mut command = crate::command(folder.path(), "run scene.toml -o run.nc -v --progress --json");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(taken(&folder.path().join("run.nc")));
}

/// A file larger than `ulimit -f` allows: an ordinary error, not the signal that the system sends for it.
#[test]
fn a_limit_on_the_size_of_files_is_an_error() {
    let _alone = alone();
    let folder = folder();
    let output = shell(folder.path(), "ulimit -f 4; exec $ASPERITY run scene.toml -o run.nc");
    let said = message(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write run.nc: larger than the system allows"), "{said}");
    assert!(said.contains("the results are lost"), "{said}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("mu_static"), "the summary is printed");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "something was left behind");
}

/// A small disk: the run is on it, or in the place that the message names.
#[test]
fn a_run_for_which_there_is_no_room_is_saved_elsewhere() {
    let _alone = alone();
    for kilobytes in [4, 16, 32, 48, 64, 96, 128, 180] {
        let folder = folder();
        let script = format!(
            "mkdir disk; mount -t tmpfs -o size={kilobytes}k tmpfs disk; export TMPDIR=$PWD
             $ASPERITY run scene.toml -o disk/run.nc --quiet; status=$?; cp disk/run.nc .; ls -A disk >left; exit $status"
        );
        let Some(output) = in_namespace(folder.path(), &script) else { return };
        let said = message(&output);
        match output.status.code() {
            Some(0) => assert!(taken(&folder.path().join("run.nc")), "{kilobytes} kB: {said}"),
            status => {
                assert_eq!(status, Some(1), "{kilobytes} kB: {said}");
                assert!(said.contains("no space left on the disk"), "{kilobytes} kB: {said}");
                let (_, place) = said.split_once("the results are in ").expect(&said);
                let (place, _) = place.split_once(" instead").unwrap();
                assert!(taken(Path::new(place)), "{kilobytes} kB: {said}");
                let left = std::fs::read_to_string(folder.path().join("left")).unwrap();
                assert!(left.is_empty(), "{kilobytes} kB: {left}");
            }
        }
    }
}

/// Figures and fields of a run too, even where none of its files has room and the slide failed.
#[test]
fn every_file_of_a_run_is_saved_elsewhere() {
    let _alone = alone();
    let folder = folder();
    let failing = "--set interface.law=full-stick --set material.hardening.law=none --set loading.interference=10 \
                   --set loading.slip_distance=1";
    for (settings, reason) in
        [("", "no space left on the disk"), (failing, "the body shears below a sticking interface")]
    {
        let script = format!(
            "mkdir -p disk; mount -t tmpfs -o size=4k tmpfs disk; mkdir disk/fields; export TMPDIR=$PWD
             $ASPERITY run scene.toml -o disk/run.nc --plot disk/run.svg --vtu disk/fields {settings} --quiet"
        );
        let Some(output) = in_namespace(folder.path(), &script) else { return };
        let said = message(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.starts_with("error: ") && said.contains(reason), "{said}");
        let places: Vec<&str> = said
            .split("the results are in ")
            .skip(1)
            .map(|rest| rest.split_once(" instead").expect(&said).0)
            .collect();
        let [run, figure, fields] = places[..] else { panic!("{said}") };
        assert_eq!(taken(Path::new(run)), settings.is_empty(), "{said}");
        assert!(std::fs::read_to_string(figure).unwrap().contains("</svg>"), "{said}");
        assert!(Path::new(fields).join("body.pvd").exists(), "{said}");
    }
}

/// The same of shards in one.
#[test]
fn a_table_for_which_there_is_no_room_is_saved_elsewhere() {
    let _alone = alone();
    let folder = folder();
    let request = SCENE.replace("interference = 1\nslip_rate = 0\n", "")
        + "[table]\ninterference = [1]\nslip_rate = [0]\n";
    std::fs::write(folder.path().join("request.toml"), request).unwrap();
    crate::done(folder.path(), "tabulate request.toml -o shard.nc --jobs 1");
    let whole = std::fs::metadata(folder.path().join("shard.nc")).unwrap().len() / 1024;
    let mut saved_elsewhere = 0;
    for kilobytes in [4, 16, 24, 32, 40, 48, 64, 96, 128, 180, 256] {
        let script = format!(
            "mkdir -p disk; mount -t tmpfs -o size={kilobytes}k tmpfs disk; export TMPDIR=$PWD
             $ASPERITY merge shard.nc -o disk/table.nc --quiet; status=$?; cp disk/table.nc .; exit $status"
        );
        let Some(output) = in_namespace(folder.path(), &script) else { return };
        let said = message(&output);
        let place = match output.status.code() {
            Some(0) => folder.path().join("table.nc"),
            status => {
                assert_eq!(status, Some(1), "{kilobytes} kB: {said}");
                assert!(said.contains("no space left on the disk"), "{kilobytes} kB: {said}");
                saved_elsewhere += 1;
                let (_, place) = said.split_once("the results are in ").expect(&said);
                place.split_once(" instead").unwrap().0.into()
            }
        };
        tables::table::Table::read(&place).expect(&said);
        std::fs::remove_file(place).unwrap();
    }
    assert!(saved_elsewhere > 0 && whole < 256, "the shard has {whole} kB");
}

/// A request or scene from standard input, and remarks on it before the run.
#[test]
fn a_scene_may_come_from_standard_input() {
    let _alone = alone();
    let folder = folder();
    let run = "exec $ASPERITY run - -o run.nc --set material.density=7.85 --set model.heat=off <scene.toml";
    let output = shell(folder.path(), run);
    let said = message(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.starts_with("warning: material.density = 7.85 kg/m3 is implausible"), "{said}");
    assert_eq!(said.matches("implausible").count(), 1, "{said}");
    let file = DatasetReader::open(&folder.path().join("run.nc")).unwrap();
    assert!(file.attribute_text("warnings").unwrap().contains("implausible"));
    assert!(file.attribute_text("notes").unwrap().contains("interface.heat_partition = 0.5"));
    let output = shell(folder.path(), "echo '[loading' | $ASPERITY run - -o run.nc");
    assert!(message(&output).contains("standard input: line 1"), "{}", message(&output));
}

/// Refused before the run, not at its end.
#[test]
fn names_that_become_too_long_are_refused_at_once() {
    let _alone = alone();
    let folder = folder();
    let name = "n".repeat(252);
    for place in [format!("{name}.svg"), format!("{name}.toolong")] {
        let output = crate::asperity(folder.path(), &format!("run scene.toml -o {place}"));
        assert_eq!(output.status.code(), Some(2), "{}", message(&output));
        assert!(message(&output).contains("cannot be written"), "{}", message(&output));
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}
