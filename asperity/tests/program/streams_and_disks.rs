//! Standard streams that cannot be written, and results for which there is no room: files first, words second, and
//! nothing lost without a message.

use std::path::Path;
use std::process::Stdio;

use tables::netcdf::DatasetReader;
use tests::folder::{Folder, places};
use tests::programs::Ended;

use crate::{COARSE, SPHERE};

fn folder() -> Folder {
    let loading = "[loading]\ninterference = 1\nslip_rate = 0\nslip_distance = 0.02\n";
    crate::folder_with("scene.toml", &format!("{loading}{COARSE}"))
}

fn shell(directory: &Folder, script: &str) -> Ended {
    Ended::of(&mut directory.shell(script))
}

/// Whether the run in this file is complete; the file is removed.
fn taken(path: &Path) -> bool {
    let complete = DatasetReader::open(path).unwrap().attribute_text("completion").unwrap() == "complete";
    std::fs::remove_file(path).unwrap();
    complete
}

#[test]
fn results_are_written_where_words_cannot_be() {
    let folder = folder();
    let run = "exec $PROGRAM run scene.toml -o run.nc --set loading.temperature=400";
    // Standard error has a warning, notes and progress; what is lost on standard output is a failure.
    for (streams, status) in [
        ("-v --progress 2>/dev/full", 0),
        ("-v --progress 2>&-", 0),
        ("--json >/dev/full", 1),
        (">/dev/full", 1),
        ("--quiet >/dev/full", 0),
        (">/dev/full 2>/dev/full", 1),
    ] {
        let output = shell(&folder, &format!("{run} {streams}"));
        let said = output.stderr;
        assert_eq!(output.status.code(), Some(status), "{streams}: {said}");
        assert!(taken(&folder.path("run.nc")), "{streams}");
        assert!(status == 0 || streams.contains("2>") || said.contains("standard output cannot be written"));
    }
    for line in ["--help >/dev/full", "materials >/dev/full", "table list --json >/dev/full"] {
        shell(&folder, &format!("exec $PROGRAM {line}")).with_status(1);
    }
}

#[test]
fn closed_pipes_lose_no_results() {
    let folder = folder();
    let mut command = folder.command("run scene.toml -o run.nc -v --progress --json");
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(taken(&folder.path("run.nc")));
}

/// A file larger than `ulimit -f` allows: an ordinary error, not the signal that the system sends for it.
#[test]
fn a_limit_on_the_size_of_files_is_an_error() {
    let folder = folder();
    let output = shell(&folder, "ulimit -f 4; exec $PROGRAM run scene.toml -o run.nc").with_status(1);
    let said = output.stderr;
    assert!(said.contains("cannot write run.nc: larger than the system allows"), "{said}");
    assert!(said.contains("the results are lost"), "{said}");
    assert!(output.stdout.contains("mu_static"), "the summary is printed");
    assert_eq!(folder.entries(), 1, "something was left behind");
}

/// A run, and shards in one table: on the disk, or in the place that the message names.
#[test]
fn results_for_which_there_is_no_room_are_saved_elsewhere() {
    let folder = folder();
    let request = format!(
        "{SPHERE}[loading]\nslip_distance = 0.02\n[table]\ninterference = [1]\nslip_rate = [0]\n{COARSE}"
    );
    folder.write("request.toml", request);
    folder.done("tabulate request.toml -o shard.nc --jobs 1");
    for (command, name) in [("run scene.toml", "run.nc"), ("merge shard.nc", "table.nc")] {
        let mut on_disk = Vec::new();
        for kilobytes in [4, 16, 24, 32, 40, 48, 64, 96, 128, 180, 256] {
            let command = format!("{command} -o disk/{name} --quiet");
            let Some(output) = folder.on_small_disk(kilobytes, &command) else { return };
            let left = folder.path("left");
            let said = output.stderr;
            on_disk.push(output.status.success());
            let place = match output.status.success() {
                true => left.join(name),
                false => {
                    assert_eq!(output.status.code(), Some(1), "{kilobytes} kB: {said}");
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
    let folder = folder();
    let failing = "--set interface.law=full-stick --set material.hardening.law=none --set loading.interference=10 \
                   --set loading.slip_distance=1";
    for (settings, reason) in
        [("", "no space left on the disk"), (failing, "the body shears in place of the interface")]
    {
        let command =
            format!("run scene.toml -o disk/run.nc --plot disk/run.svg --vtu disk/fields --quiet {settings}");
        let Some(output) = folder.on_small_disk(4, &command) else { return };
        let said = output.with_status(1).stderr;
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
    let folder = folder();
    let run = "exec $PROGRAM run - -o run.nc --set material.density=7.85 --set model.heat=off <scene.toml";
    let said = shell(&folder, run).with_status(0).stderr;
    assert!(said.starts_with("warning: material.density = 7.85 kg/m3 is implausible"), "{said}");
    assert_eq!(said.matches("implausible").count(), 1, "{said}");
    let file = folder.dataset("run.nc");
    assert!(file.attribute_text("warnings").unwrap().contains("implausible"));
    assert!(file.attribute_text("notes").unwrap().contains("interface.heat_partition = 0.5"));
    let said = shell(&folder, "echo '[loading' | $PROGRAM run - -o run.nc").stderr;
    assert!(said.contains("standard input: line 1"), "{said}");
}
