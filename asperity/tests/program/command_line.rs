//! The program from outside: exit status, messages, and no files after a
//! command that was refused.

use crate::{COARSE, SPHERE, empty_folder, folder_with};

const LOADING: &str = "[loading]\ninterference = 20\nslip_rate = 1\n";
const TABLE: &str = "[table]\ninterference = [1, 10]\nslip_rate = [1]\n";

/// Refused, and no new file.
fn refused(line: &str, parts: &[&str]) {
    let directory = folder_with("scene.toml", LOADING);
    directory.write("request.toml", format!("{SPHERE}{TABLE}"));
    directory.refused(line, parts);
    assert_eq!(directory.entries(), 2, "{line}");
}

#[test]
fn bad_input_is_refused_before_any_work() {
    let run = "run scene.toml -o run.nc";
    let tabulate = "tabulate request.toml -o table.nc";
    for (line, parts) in [
        (
            format!("{run} --set loading.interferance=3"),
            &["loading.interferance", "did you mean interference?"][..],
        ),
        (
            format!("{run} -q --set loading.interference=1e300"),
            &["1e300 omega_c", "small beside the asperity"],
        ),
        (format!("{run} --plot run.gif"), &["run.gif", "svg, png, pdf"]),
        (
            format!("{run} --plot run.svg --panel temperature --set model.heat=off"),
            &[
                "has no panel temperature: it has friction, forces, area, onset, plastic-strain, energies, status-map",
            ],
        ),
        (format!("{tabulate} --plot t.svg --panel friction-map"), &["it has friction, stress, energy"]),
        (
            format!("{run} --fields-at 1,5"),
            &["--fields-at 5", "a slip of 2 contact radii (loading.slip_distance"],
        ),
        ("run none.toml -o run.nc".into(), &["none.toml", "cannot be read"]),
        ("run scene.toml -o none/run.nc".into(), &["none/run.nc", "cannot be written"]),
        (format!("run scene.toml -o {}.nc", "n".repeat(253)), &["cannot be written"]),
        ("run scene.toml -o other.toml".into(), &["other.toml", "results need another extension"]),
        ("run scene.toml -o ./scene.toml".into(), &["--output and the scene are the same file"]),
        (format!("{run} --plot scene.toml"), &["scene.toml", "svg, png"]),
        ("run scene.toml -o a --vtu a".into(), &["--vtu and --output are the same file"]),
        ("run scene.toml -o a/body.pvd --vtu a".into(), &["a file of --vtu and --output are the same file"]),
        (
            "run scene.toml -o a/body-000.vtu --vtu a".into(),
            &["a file of --vtu and --output are the same file"],
        ),
        (
            "run scene.toml -o body-1234.vtu --vtu ./".into(),
            &["a file of --vtu and --output are the same file"],
        ),
        ("tabulate request.toml -o request.toml".into(), &["--output and the request are the same file"]),
        ("convergence scene.toml -o scene.toml".into(), &["--output and the scene are the same file"]),
        ("merge request.toml scene.toml -o scene.toml".into(), &["--output and a shard are the same file"]),
        ("table export scene.csv -o scene.csv".into(), &["--output and the table are the same file"]),
        ("table plot scene.svg -o scene.svg".into(), &["--plot and the table are the same file"]),
        ("table info /dev/zero".into(), &["/dev/zero", "not a regular file"]),
        ("run /dev/zero -o run.nc".into(), &["/dev/zero"]),
        ("table info stel-4340".into(), &["did you mean steel-4340?"]),
        ("run request.toml -o run.nc".into(), &["asperity tabulate"]),
        ("tabulate scene.toml -o table.nc".into(), &["table is missing"]),
        (format!("{tabulate} --set table.tolerance=2"), &["table.tolerance = 2", "1e-6 to 0.5"]),
        (format!("{tabulate} --set table.tolerance=0.1 --shard 1/2"), &["--shard 1/2", "table.tolerance"]),
        ("merge scene.toml none.nc -o table.nc".into(), &["scene.toml"]),
        ("materials steel4340".into(), &["steel4340", "steel-4340"]),
    ] {
        refused(&line, parts);
    }
}

/// Scenes, requests and tables in place of each other, depths and ranges of requests, and folders.
#[test]
fn what_was_mistaken_is_named() {
    let tabulate = "tabulate request.toml -o table.nc";
    for (line, parts) in [
        (
            format!("{tabulate} -q --set table.interference=[1,1e6]"),
            &["table.interference = 1e6: must be at most about"][..],
        ),
        (
            format!("{tabulate} --set table.slip_rate={{from=0,to=10,points=3}}"),
            &["table.slip_rate.from = 0: must be a positive number; zero needs spacing = \"linear\""],
        ),
        ("tabulate scene.toml -o table.nc".into(), &["table is missing", "a scene for `asperity run`"]),
        (
            "run scene.toml -o run.nc --vtu request.toml".into(),
            &["request.toml: is a file, a folder is needed"],
        ),
        ("table info request.toml".into(), &["is a request; the table of it is made by `asperity tabulate`"]),
        ("table info scene.toml".into(), &["is TOML, not a table"]),
    ] {
        refused(&line, parts);
    }
}

#[test]
fn a_scene_with_the_name_of_a_file_of_vtu_is_kept() {
    let directory = folder_with("body-001.vtu", LOADING);
    let line = "run body-001.vtu -o run.nc --vtu .";
    directory.refused(line, &["a file of --vtu and the scene are the same file"]);
}

/// Also where warnings are not printed, as the likely cause.
#[test]
fn a_refusal_has_the_implausible_values_with_it() {
    let directory = folder_with("scene.toml", &format!("{LOADING}{COARSE}"));
    let refused = |more: &str| {
        let modulus = "counterface.youngs_modulus=330 --set counterface.poisson_ratio=0.2";
        directory.run(&format!("run scene.toml -o run.nc --set {modulus} {more}")).with_status(2).stderr
    };
    for more in ["", "-q"] {
        let said = refused(more);
        assert_eq!(said.matches("counterface.youngs_modulus = 330 Pa is implausible").count(), 1, "{said}");
        assert!(said.contains("small beside the asperity") && !said.contains("inf"), "{said}");
    }
}

#[test]
fn usage_errors_have_status_2_and_help_has_0() {
    let folder = empty_folder();
    let both = "run scene.toml -o run.nc --quiet -v";
    for line in ["", "run", "run scene.toml", "fly", "tabulate r.toml -o t.nc --jobs 0", both] {
        assert_eq!(folder.run(line).status.code(), Some(2), "{line}");
    }
    folder.misused("run scene.toml -o run.CSV", &["name it .nc, not .CSV"]);
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(folder.done(&format!("completions {shell}")).stdout.contains("tabulate"), "{shell}");
    }
    folder.done("man pages");
    let page = folder.read("pages/asperity-run.1");
    assert!(page.contains("single") || page.contains("fields\\-at"), "{page}");
    for line in ["--help", "run --help", "tabulate --help", "honesty --help", "--version"] {
        assert!(folder.done(line).stdout.contains("asperity"), "{line}");
    }
}

#[test]
fn materials_are_listed_with_units_and_sources() {
    let folder = empty_folder();
    let list = folder.done("materials").stdout;
    let names: Vec<&str> = list.lines().map(|line| line.split(' ').next().unwrap()).collect();
    assert_eq!(names, asperity::scene::presets::names());
    assert!(names.contains(&"copper") && names.len() >= 7, "{list}");
    let steel = folder.done("materials steel-4340").stdout;
    let line = steel.lines().find(|line| line.starts_with("yield_strength")).unwrap();
    for part in ["7.92e8", "Pa", "Johnson & Cook 1985"] {
        assert!(line.contains(part), "{line}");
    }
    let json = folder.done("materials copper --json").json();
    assert_eq!(json["constants"]["yield_strength"]["value"], 90e6);
    assert_eq!(json["laws"]["hardening"], "johnson-cook");
    let carbon = folder.done("materials carbon-steel-en1993").stdout;
    for part in ["youngs_modulus", "873.15 K: 6.51e10", "1008.15 K: 5000", "EN 1993-1-2:2005", "checked: "] {
        assert!(carbon.contains(part), "{carbon}");
    }
}

/// Where there is no friction the numbers are zero, not rounding, and where there is no slide they are none. Where sliding
/// does not begin or the strength is that of another temperature, there is a warning.
#[test]
fn a_run_says_what_its_numbers_are_not() {
    let directory = folder_with("scene.toml", &format!("{LOADING}{COARSE}"));
    let run = |set: &[&str]| {
        let set: String = set.iter().map(|change| format!(" --set {change}")).collect();
        let output = directory.done(&format!("run scene.toml -o run.nc --json -v{set}"));
        (output.json(), output.stderr)
    };
    let (zero, none) = (serde_json::json!(0.0), serde_json::Value::Null);
    for (set, value) in [
        (&["loading.slip_distance=0"][..], none),
        (&["interface.law=coulomb", "interface.friction=0"], zero.clone()),
        (&["interface.law=frictionless"], zero),
    ] {
        let (json, said) = run(set);
        for name in ["mu", "mu_static", "Q", "G", "inception_slip"] {
            assert_eq!(json["summary"][name]["value"], value, "{set:?} {name}");
        }
        assert!(!said.contains("NaN") && !said.contains("warning"), "{set:?} {said}");
    }
    let begun = "sliding has not begun";
    assert!(!run(&[]).1.contains(begun));
    assert!(run(&["loading.interference=100", "loading.slip_distance=0.005"]).1.contains(begun));
    assert!(run(&["loading.temperature=700"]).1.contains("yield_strength is taken to hold at"));
    // Once, with the remedy.
    let (json, said) = run(&["material.hardening={law=\"none\"}", "loading.interference=5"]);
    let warnings = said.lines().filter(|line| line.starts_with("warning: ") && line.contains("harden"));
    assert_eq!(warnings.count(), 1, "{said}");
    let warnings = json["warnings"].as_array().unwrap().iter();
    let warnings: Vec<&str> = warnings.filter_map(|text| text.as_str()).collect();
    let of_hardening = warnings.iter().filter(|text| text.contains("harden"));
    assert_eq!(of_hardening.count(), 1, "{warnings:?}");
    assert!(warnings[0].contains("give [material] hardening = "), "{warnings:?}");
}

/// `-v` prints the notes of cells whether or not the table is a resumed one; tables without a common cell differ.
#[test]
fn tables_tell_notes_and_differ_in_their_cells() {
    let sections = format!("{TABLE}{COARSE}[loading]\nslip_distance = 0.02\n");
    let directory = folder_with("request.toml", &sections);
    for (table, interference) in [("one.nc", "[1]"), ("other.nc", "[2]")] {
        let line = format!("tabulate request.toml -o {table} -v --set table.interference={interference}");
        let said = directory.done(&line).stderr;
        assert!(
            said.contains("4 elements per contact radius") && !said.contains("taken from the journal"),
            "{said}"
        );
    }
    let diff = |other: &str| directory.run(&format!("table diff one.nc {other} --tolerance 0.1"));
    diff("one.nc").with_status(0);
    let said = diff("other.nc").with_status(1).stderr;
    assert!(said.contains("1 cells are in the first only, 1 in the second only"));
}
