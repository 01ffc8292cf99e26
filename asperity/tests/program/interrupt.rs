//! An interrupt (Ctrl-C) from outside: results so far are saved, and the message names the command that continues.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use tables::netcdf::DatasetReader;

use crate::{alone, ended, folder_with};

const NUMERICS: &str = "[numerics]\nelements_per_radius = 8\nsectors = 8\n";

/// The program with progress on stderr. The tests may run where signals are ignored, as under nohup.
fn start(directory: &Path, arguments: &str) -> Child {
    Command::new("env")
        .args(["--default-signal", env!("CARGO_BIN_EXE_asperity"), "--progress"])
        .args(arguments.split_whitespace())
        .current_dir(directory)
        .env("HDF5_USE_FILE_LOCKING", "FALSE")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Sends the signals once a line of progress is seen; yields the exit status and what was said after.
fn interrupt_at(mut child: Child, signals: &[&str], seen: impl Fn(&str) -> bool) -> (Option<i32>, String) {
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    loop {
        line.clear();
        assert!(stderr.read_line(&mut line).unwrap() > 0, "it ended before it could be interrupted");
        if seen(&line) {
            break;
        }
    }
    for signal in signals {
        let kill = Command::new("kill").args([signal, &*child.id().to_string()]).status().unwrap();
        assert!(kill.success());
    }
    let mut said = String::new();
    stderr.read_to_string(&mut said).unwrap();
    (child.wait().unwrap().code(), said)
}

#[test]
fn an_interrupted_run_is_saved_as_far_as_it_came_and_says_so() {
    let _alone = alone();
    let directory =
        folder_with("scene.toml", &format!("[loading]\ninterference = 20\nslip_rate = 1\n{NUMERICS}"));
    for signal in ["-INT", "-TERM"] {
        let child = start(directory.path(), "run scene.toml -o run.nc --plot run.svg --vtu body");
        let (status, said) =
            interrupt_at(child, &[signal], |line| line.contains("step ") && !line.contains("coarse mesh"));
        assert_eq!(status, Some(1), "{said}");
        let last = said.lines().last().unwrap();
        for part in ["error: stopped on request", "run.nc", "cannot be continued"] {
            assert!(last.contains(part), "{said}");
        }
        let path = directory.path().join("run.nc");
        let file = DatasetReader::open(&path).unwrap();
        assert_eq!(file.attribute_text("completion").unwrap(), "incomplete: stopped on request");
        let steps = file.shape("slip").unwrap()[0];
        let slip = file.reals("slip", &[steps]).unwrap();
        let radius = file.reals("contact_radius", &[]).unwrap()[0];
        // The slide would have gone on to 2 a₀.
        assert!(steps > 2 && slip[steps - 1] > 0.0 && slip[steps - 1] < 1.9 * radius, "{slip:?}");
        for name in ["run.svg", "body/body.pvd", "body/body-001.vtu"] {
            assert!(directory.path().join(name).exists(), "{name}");
        }
        std::fs::remove_file(path).unwrap();
    }
}

/// Ctrl-C in a repetition of a run: what there was stays, and what there is lies beside it.
#[test]
fn an_interrupted_run_does_not_replace_a_complete_one() {
    let _alone = alone();
    let short =
        format!("[loading]\ninterference = 5\nslip_rate = 0\nslip_distance = 0.02\n{}", crate::COARSE);
    let directory = folder_with("scene.toml", &short);
    let read = |name: &str| std::fs::read(directory.path().join(name));
    crate::done(directory.path(), "run scene.toml -o run.nc --plot run.svg");
    let before = [read("run.nc").unwrap(), read("run.svg").unwrap()];
    let long =
        "--set loading.slip_distance=2 --set numerics.elements_per_radius=8 --set loading.interference=20";
    let child = start(directory.path(), &format!("run scene.toml -o run.nc --plot run.svg {long}"));
    let (status, said) =
        interrupt_at(child, &["-INT"], |line| line.contains("step ") && !line.contains("coarse mesh"));
    assert_eq!(status, Some(1), "{said}");
    assert!(said.lines().last().unwrap().contains("are in run.incomplete.nc"), "{said}");
    assert_eq!([read("run.nc").unwrap(), read("run.svg").unwrap()], before);
    let file = DatasetReader::open(&directory.path().join("run.incomplete.nc")).unwrap();
    assert_eq!(file.attribute_text("completion").unwrap(), "incomplete: stopped on request");
    assert!(read("run.incomplete.svg").is_ok());
}

/// As `timeout` ends a program: by a signal to it and, at once, another to its group. The run is then in its press at
/// finite strain, after a coarse slide at small strain, which is saved.
#[test]
fn two_signals_at_once_are_one_request_and_lose_nothing() {
    let _alone = alone();
    let fine = "[loading]\ninterference = 5\nslip_rate = 0\n[numerics]\nelements_per_radius = 24\n";
    let directory = folder_with("scene.toml", fine);
    let child = start(directory.path(), "run scene.toml -o run.nc");
    let (status, said) = interrupt_at(child, &["-TERM", "-TERM"], |line| line.starts_with("slide"));
    assert_eq!(status, Some(1), "{said}");
    let file = DatasetReader::open(&directory.path().join("run.nc")).expect(&said);
    assert_eq!(file.attribute_text("completion").unwrap(), "incomplete: stopped on request");
}

/// As `nohup` starts a program: the end of the terminal does not end it, a request to stop still does.
#[test]
fn signals_that_are_ignored_stay_ignored() {
    let _alone = alone();
    let directory =
        folder_with("scene.toml", &format!("[loading]\ninterference = 5\nslip_rate = 0\n{NUMERICS}"));
    for (signals, expected) in [(&["-HUP"][..], 0), (&["-HUP", "-TERM"], 1)] {
        let mut shell = Command::new("sh");
        shell.args(["-c", "trap '' HUP; exec \"$ASPERITY\" run scene.toml -o run.nc --progress"]);
        shell.env("ASPERITY", env!("CARGO_BIN_EXE_asperity")).current_dir(directory.path());
        let child = shell.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let (status, said) = interrupt_at(child, signals, |line| line.contains("coarse mesh"));
        assert_eq!(status, Some(expected), "{signals:?}: {said}");
        assert_eq!(said.contains("stopping"), expected == 1, "{signals:?}: {said}");
    }
}

/// A mesh of which a single factorisation takes minutes, and increments of a body without hardening: the stop is
/// honoured within them.
#[test]
fn a_request_to_stop_is_honoured_within_an_increment() {
    /// Of processor time; a second is promised, the machine may be busy.
    const LATEST: std::time::Duration = std::time::Duration::from_secs(5);
    let _alone = alone();
    let directory = folder_with("scene.toml", "[loading]\ninterference = 20\nslip_rate = 1\n[numerics]\n");
    let fine = "--set numerics.elements_per_radius=192";
    let perfect = "--set numerics.elements_per_radius=32 --set loading.interference=100 \
                   --set material.hardening.law=\"none\" --set interface.law=full-stick";
    for (settings, after) in [(fine, 0.5), (fine, 2.0), (fine, 5.0), (perfect, 2.0), (perfect, 6.0)] {
        let mut child = start(directory.path(), &format!("run scene.toml -o run.nc {settings}"));
        std::thread::sleep(std::time::Duration::from_secs_f64(after));
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be interrupted");
        let asked = std::time::Instant::now();
        assert!(Command::new("kill").arg(child.id().to_string()).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert!(asked.elapsed() < LATEST, "after {after} s: {:?}", asked.elapsed());
        let said = ended(&output, 1);
        assert!(said.contains("stopped on request"), "{said}");
    }
}

#[test]
fn an_interrupted_table_is_continued_by_the_command_that_it_names() {
    let _alone = alone();
    let request = "[table]\ninterference = [1, 2, 20]\nslip_rate = [1]\n[numerics]\nelements_per_radius = 6\nsectors = 4\n";
    let directory = folder_with("request.toml", request);
    let hardening = "--set material.hardening={law=\"linear\",modulus=3e8}";
    let child = start(
        directory.path(),
        &format!("tabulate request.toml -o table.nc --jobs 1 --plot it's.svg {hardening}"),
    );
    let (status, said) = interrupt_at(child, &["-INT"], |line| line.contains("1 of 3 cells"));
    assert_eq!(status, Some(1), "{said}");
    assert!(!directory.path().join("table.nc").exists());
    assert!(directory.path().join("table.nc.part").exists());
    let (_, command) = said.lines().last().unwrap().split_once("to continue: asperity ").unwrap();
    assert!(command.contains("--resume"), "{command}");
    // As copied into a shell, which would take braces and quotes for its own.
    let output = Command::new("bash")
        .args(["-c", &format!("\"$ASPERITY\" {command} -v")])
        .env("ASPERITY", env!("CARGO_BIN_EXE_asperity"))
        .current_dir(directory.path())
        .env("HDF5_USE_FILE_LOCKING", "FALSE")
        .output()
        .unwrap();
    let said = ended(&output, 0);
    assert!(!said.contains("0 cells were taken") && said.contains("cells were taken"), "{said}");
    assert!(directory.path().join("table.nc").exists() && directory.path().join("it's.svg").exists());
    assert!(!directory.path().join("table.nc.part").exists());
}
