//! An interrupt (Ctrl-C) from outside: results so far are saved, and the message names the command that continues.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Stdio};
#[cfg(target_os = "linux")]
use std::time::Duration;

use tests::folder::{Folder, signal};
use tests::programs::Ended;

use crate::folder_with;

const NUMERICS: &str = "[numerics]\nelements_per_radius = 8\nsectors = 8\n";

/// The program with progress on stderr. The tests may run where signals are ignored, as under nohup.
fn start(directory: &Folder, arguments: &str) -> Child {
    let mut command = directory.other("env");
    command.args(["--default-signal", env!("CARGO_BIN_EXE_asperity"), "--progress"]);
    command.args(arguments.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
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
    signals.iter().for_each(|name| signal(&child, name));
    let mut said = String::new();
    stderr.read_to_string(&mut said).unwrap();
    (child.wait().unwrap().code(), said)
}

#[test]
fn an_interrupted_run_is_saved_as_far_as_it_came_and_says_so() {
    let directory =
        folder_with("scene.toml", &format!("[loading]\ninterference = 20\nslip_rate = 1\n{NUMERICS}"));
    for signal in ["-INT", "-TERM"] {
        let child = start(&directory, "run scene.toml -o run.nc --plot run.svg --vtu body");
        let (status, said) =
            interrupt_at(child, &[signal], |line| line.contains("step ") && !line.contains("coarse mesh"));
        assert_eq!(status, Some(1), "{said}");
        let last = said.lines().last().unwrap();
        for part in ["error: stopped on request", "run.nc", "cannot be continued"] {
            assert!(last.contains(part), "{said}");
        }
        let file = directory.dataset("run.nc");
        assert_eq!(file.attribute_text("completion").unwrap(), "incomplete: stopped on request");
        let steps = file.shape("slip").unwrap()[0];
        let slip = file.reals("slip", &[steps]).unwrap();
        let radius = file.reals("contact_radius", &[]).unwrap()[0];
        // The slide would have gone on to 2 a₀.
        assert!(steps > 2 && slip[steps - 1] > 0.0 && slip[steps - 1] < 1.9 * radius, "{slip:?}");
        for name in ["run.svg", "body/body.pvd", "body/body-001.vtu"] {
            assert!(directory.path(name).exists(), "{name}");
        }
        std::fs::remove_file(directory.path("run.nc")).unwrap();
    }
}

/// Ctrl-C in a repetition of a run: what there was stays, and what there is lies beside it.
#[test]
fn an_interrupted_run_does_not_replace_a_complete_one() {
    let short =
        format!("[loading]\ninterference = 5\nslip_rate = 0\nslip_distance = 0.02\n{}", crate::COARSE);
    let directory = folder_with("scene.toml", &short);
    directory.done("run scene.toml -o run.nc --plot run.svg");
    let results = || ["run.nc", "run.svg"].map(|name| directory.bytes(name));
    let before = results();
    let long =
        "--set loading.slip_distance=2 --set numerics.elements_per_radius=8 --set loading.interference=20";
    let child = start(&directory, &format!("run scene.toml -o run.nc --plot run.svg {long}"));
    let (status, said) =
        interrupt_at(child, &["-INT"], |line| line.contains("step ") && !line.contains("coarse mesh"));
    assert_eq!(status, Some(1), "{said}");
    assert!(said.lines().last().unwrap().contains("are in run.incomplete.nc"), "{said}");
    assert_eq!(results(), before);
    let file = directory.dataset("run.incomplete.nc");
    assert_eq!(file.attribute_text("completion").unwrap(), "incomplete: stopped on request");
    assert!(directory.path("run.incomplete.svg").exists());
}

/// As `timeout` ends a program: by a signal to it and, at once, another to its group. The run is then in its press at
/// finite strain, after a coarse slide at small strain, which is saved.
#[test]
fn two_signals_at_once_are_one_request_and_lose_nothing() {
    let fine = "[loading]\ninterference = 5\nslip_rate = 0\n[numerics]\nelements_per_radius = 24\n";
    let directory = folder_with("scene.toml", fine);
    let child = start(&directory, "run scene.toml -o run.nc");
    let (status, said) = interrupt_at(child, &["-TERM", "-TERM"], |line| line.starts_with("slide"));
    assert_eq!(status, Some(1), "{said}");
    let file = directory.dataset("run.nc");
    assert_eq!(file.attribute_text("completion").unwrap(), "incomplete: stopped on request");
}

/// As `nohup` starts a program: the end of the terminal does not end it, a request to stop still does.
#[test]
fn signals_that_are_ignored_stay_ignored() {
    let directory =
        folder_with("scene.toml", &format!("[loading]\ninterference = 5\nslip_rate = 0\n{NUMERICS}"));
    for (signals, expected) in [(&["-HUP"][..], 0), (&["-HUP", "-TERM"], 1)] {
        let mut shell = directory.shell("trap '' HUP; exec \"$PROGRAM\" run scene.toml -o run.nc --progress");
        let child = shell.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let (status, said) = interrupt_at(child, signals, |line| line.contains("coarse mesh"));
        assert_eq!(status, Some(expected), "{signals:?}: {said}");
        assert_eq!(said.contains("stopping"), expected == 1, "{signals:?}: {said}");
    }
}

/// Whether a program has ended, and its processor time until then, in s (proc(5), `stat`): to be read until the program is
/// waited for.
#[cfg(target_os = "linux")]
fn state(child: &Child) -> (bool, f64) {
    /// Of the interface, whatever the system counts in.
    const TICKS_PER_SECOND: f64 = 100.0;
    let text = std::fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap();
    let fields: Vec<&str> = text.rsplit_once(") ").unwrap().1.split(' ').collect();
    let ticks: f64 = fields[11..13].iter().map(|ticks| ticks.parse::<f64>().unwrap()).sum();
    (fields[0] == "Z", ticks / TICKS_PER_SECOND)
}

/// A mesh of which a single factorisation takes minutes, and increments of a body without hardening: the stop is
/// honoured within them.
#[cfg(target_os = "linux")]
#[test]
fn a_request_to_stop_is_honoured_within_an_increment() {
    /// Processor time of each thread, in s, as the machine may be busy; a second is promised.
    const LATEST: f64 = 5.0;
    let latest = LATEST * std::thread::available_parallelism().unwrap().get() as f64;
    let directory = folder_with("scene.toml", "[loading]\ninterference = 20\nslip_rate = 1\n[numerics]\n");
    let fine = "--set numerics.elements_per_radius=192";
    let perfect = "--set numerics.elements_per_radius=32 --set loading.interference=100 \
                   --set material.hardening.law=\"none\" --set interface.law=full-stick";
    for (settings, after) in [(fine, 0.5), (fine, 2.0), (fine, 5.0), (perfect, 2.0), (perfect, 6.0)] {
        let child = start(&directory, &format!("run scene.toml -o run.nc {settings}"));
        std::thread::sleep(Duration::from_secs_f64(after));
        let (ended, asked) = state(&child);
        assert!(!ended, "it ended before it could be interrupted");
        signal(&child, "-TERM");
        let mut now = state(&child);
        while !now.0 {
            std::thread::sleep(Duration::from_millis(20));
            now = state(&child);
            assert!(now.1 - asked < latest, "after {after} s: {} s", now.1 - asked);
        }
        let said = Ended::awaited(child).with_status(1).stderr;
        assert!(said.contains("stopped on request"), "{said}");
    }
}

#[test]
fn an_interrupted_table_is_continued_by_the_command_that_it_names() {
    let request = "[table]\ninterference = [1, 2, 20]\nslip_rate = [1]\n[numerics]\nelements_per_radius = 6\nsectors = 4\n";
    let directory = folder_with("request.toml", request);
    let hardening = "--set material.hardening={law=\"linear\",modulus=3e8}";
    let child =
        start(&directory, &format!("tabulate request.toml -o table.nc --jobs 1 --plot it's.svg {hardening}"));
    let (status, said) = interrupt_at(child, &["-INT"], |line| line.contains("1 of 3 cells"));
    assert_eq!(status, Some(1), "{said}");
    assert!(!directory.path("table.nc").exists());
    assert!(directory.path("table.nc.part").exists());
    let (_, command) = said.lines().last().unwrap().split_once("to continue: asperity ").unwrap();
    assert!(command.contains("--resume"), "{command}");
    // As copied into a shell, which would take braces and quotes for its own.
    let continued = Ended::of(directory.other("bash").args(["-c", &format!("\"$PROGRAM\" {command} -v")]));
    let said = continued.with_status(0).stderr;
    assert!(!said.contains("0 cells were taken") && said.contains("cells were taken"), "{said}");
    assert!(directory.path("table.nc").exists() && directory.path("it's.svg").exists());
    assert!(!directory.path("table.nc.part").exists());
}
