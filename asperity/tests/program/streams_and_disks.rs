//! Standard streams that cannot be written, and results for which there is no room: files first, words second, and
//! nothing lost without a message.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use tables::netcdf::DatasetReader;

use crate::faults::in_namespace;
use crate::{COARSE, SPHERE, alone, ended, message};

fn folder() -> tempfile::TempDir {
    let loading = "[loading]\ninterference = 1\nslip_rate = 0\nslip_distance = 0.02\n";
    crate::folder_with("scene.toml", &format!("{loading}{COARSE}"))
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
        ended(&output, 1);
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
    let said = ended(&output, 1);
    assert!(said.contains("cannot write run.nc: larger than the system allows"), "{said}");
    assert!(said.contains("the results are lost"), "{said}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("mu_static"), "the summary is printed");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "something was left behind");
}

/// Runs a command of the program with its outputs on a small disk, the folder `disk`, which is then copied to the
/// folder `left`, and other files in the folder itself; none where there are no mount namespaces.
fn on_small_disk(folder: &Path, kilobytes: usize, command: &str) -> Option<Output> {
    let script = format!(
        "mkdir -p disk; mount -t tmpfs -o size={kilobytes}k tmpfs disk; export TMPDIR=$PWD
         $ASPERITY {command} --quiet; status=$?; rm -rf left; cp -r disk left; exit $status"
    );
    in_namespace(folder, &script)
}

/// The places that a message names for files that found no room.
fn places(said: &str) -> Vec<&Path> {
    let places = said.split("the results are in ").skip(1);
    places.map(|rest| Path::new(rest.split_once(" instead").expect(said).0)).collect()
}

/// A run, and shards in one table: on the disk, or in the place that the message names.
#[test]
fn results_for_which_there_is_no_room_are_saved_elsewhere() {
    let _alone = alone();
    let folder = folder();
    let request = format!(
        "{SPHERE}[loading]\nslip_distance = 0.02\n[table]\ninterference = [1]\nslip_rate = [0]\n{COARSE}"
    );
    std::fs::write(folder.path().join("request.toml"), request).unwrap();
    crate::done(folder.path(), "tabulate request.toml -o shard.nc --jobs 1");
    for (command, name) in [("run scene.toml", "run.nc"), ("merge shard.nc", "table.nc")] {
        let mut on_disk = Vec::new();
        for kilobytes in [4, 16, 24, 32, 40, 48, 64, 96, 128, 180, 256] {
            let command = format!("{command} -o disk/{name}");
            let Some(output) = on_small_disk(folder.path(), kilobytes, &command) else { return };
            let left = folder.path().join("left");
            let said = message(&output);
            on_disk.push(output.status.success());
            let place = match output.status.success() {
                true => left.join(name),
                false => {
                    ended(&output, 1);
                    assert!(said.contains("no space left on the disk"), "{kilobytes} kB: {said}");
                    assert_eq!(std::fs::read_dir(left).unwrap().count(), 0, "{kilobytes} kB: {said}");
                    places(&said)[0].to_path_buf()
                }
            };
            match name {
                "run.nc" => assert!(taken(&place), "{kilobytes} kB: {said}"),
                _ => drop(tables::table::Table::read(&place).expect(&said)),
            }
        }
        assert!(!on_disk[0] && on_disk[on_disk.len() - 1], "{name}: {on_disk:?}");
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
        [("", "no space left on the disk"), (failing, "the body shears in place of the interface")]
    {
        let command =
            format!("run scene.toml -o disk/run.nc --plot disk/run.svg --vtu disk/fields {settings}");
        let Some(output) = on_small_disk(folder.path(), 4, &command) else { return };
        let said = ended(&output, 1);
        assert!(said.starts_with("error: ") && said.contains(reason), "{said}");
        let [run, figure, fields] = places(&said)[..] else { panic!("{said}") };
        assert_eq!(taken(run), settings.is_empty(), "{said}");
        assert!(std::fs::read_to_string(figure).unwrap().contains("</svg>"), "{said}");
        assert!(fields.join("body.pvd").exists(), "{said}");
    }
}

/// A request or scene from standard input, and remarks on it before the run.
#[test]
fn a_scene_may_come_from_standard_input() {
    let _alone = alone();
    let folder = folder();
    let run = "exec $ASPERITY run - -o run.nc --set material.density=7.85 --set model.heat=off <scene.toml";
    let said = ended(&shell(folder.path(), run), 0);
    assert!(said.starts_with("warning: material.density = 7.85 kg/m3 is implausible"), "{said}");
    assert_eq!(said.matches("implausible").count(), 1, "{said}");
    let file = DatasetReader::open(&folder.path().join("run.nc")).unwrap();
    assert!(file.attribute_text("warnings").unwrap().contains("implausible"));
    assert!(file.attribute_text("notes").unwrap().contains("interface.heat_partition = 0.5"));
    let output = shell(folder.path(), "echo '[loading' | $ASPERITY run - -o run.nc");
    assert!(message(&output).contains("standard input: line 1"), "{}", message(&output));
}
