//! The program from outside: exit status, messages, and that nothing is left behind by a
//! command that was refused.

use std::path::Path;
use std::process::{Command, Output};

const SCENE: &str = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n\
                     [loading]\ninterference = 20\nslip_rate = 1\n";
const REQUEST: &str = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
                       [table]\ninterference = [1, 10]\nslip_rate = [1]\n";

fn asperity(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).args(arguments).current_dir(directory).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Exit status 2, one line on stderr with all of `parts`, and no new file.
fn refused(arguments: &[&str], parts: &[&str]) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("scene.toml"), SCENE).unwrap();
    std::fs::write(directory.path().join("request.toml"), REQUEST).unwrap();
    let output = asperity(directory.path(), arguments);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    for part in parts {
        assert!(message.contains(part), "{message} lacks {part}");
    }
    assert!(output.stdout.is_empty());
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 2);
}

#[test]
fn bad_input_is_refused_before_any_work() {
    let run = ["run", "scene.toml", "-o", "run.nc"];
    let with = |more: &[&'static str]| [&run, more].concat();
    refused(
        &with(&["--set", "material.youngs_modulus=-1"]),
        &["material.youngs_modulus", "-1", "a positive number (Pa)"],
    );
    refused(
        &with(&["--set", "loading.interferance=3"]),
        &["loading.interferance", "did you mean interference?"],
    );
    refused(&with(&["--plot", "run.pdf"]), &["run.pdf", "svg, png"]);
    refused(&with(&["--fields-at", "1,5"]), &["--fields-at 5", "loading.slip_distance = 2"]);
    refused(&["run", "none.toml", "-o", "run.nc"], &["none.toml", "cannot be read"]);
    refused(&["run", "scene.toml", "-o", "none/run.nc"], &["none/run.nc", "cannot be written"]);
    refused(&["run", "scene.toml", "-o", "scene.toml"], &["is the input"]);
    refused(&["run", "request.toml", "-o", "run.nc"], &["asperity tabulate"]);
    refused(&["tabulate", "scene.toml", "-o", "table.nc"], &["table is missing"]);
    refused(
        &["tabulate", "request.toml", "-o", "table.nc", "--set", "table.tolerance=2"],
        &["table.tolerance = 2", "at most 0.5"],
    );
    refused(
        &["tabulate", "request.toml", "-o", "table.nc", "--set", "table.max_cells=100"],
        &["table.max_cells = 100", "unless tolerance"],
    );
    refused(
        &["tabulate", "request.toml", "-o", "t.nc", "--set", "table.tolerance=0.1", "--shard", "1/2"],
        &["--shard 1/2", "table.tolerance"],
    );
    refused(&["merge", "scene.toml", "none.nc", "-o", "table.nc"], &["scene.toml"]);
    refused(&["materials", "steel4340"], &["steel4340", "steel-4340"]);
}

#[test]
fn usage_errors_have_status_2_and_help_has_0() {
    let here = Path::new(".");
    for arguments in [&[][..], &["run"], &["run", "scene.toml"], &["fly"]] {
        assert_eq!(asperity(here, arguments).status.code(), Some(2), "{arguments:?}");
    }
    for arguments in [&["--help"][..], &["run", "--help"], &["tabulate", "--help"], &["--version"]] {
        let output = asperity(here, arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert!(text(&output.stdout).contains("asperity"));
    }
}

#[test]
fn materials_are_listed_with_units_and_sources() {
    let here = Path::new(".");
    let list = text(&asperity(here, &["materials"]).stdout);
    let names: Vec<&str> = list.lines().map(|line| line.split(' ').next().unwrap()).collect();
    assert_eq!(names, asperity::scene::presets::names());
    assert!(names.contains(&"copper") && names.len() >= 7, "{list}");
    let steel = text(&asperity(here, &["materials", "steel-4340"]).stdout);
    let line = steel.lines().find(|line| line.starts_with("yield_strength")).unwrap();
    for part in ["7.92e8", "Pa", "Johnson & Cook 1985"] {
        assert!(line.contains(part), "{line}");
    }
    let json = text(&asperity(here, &["materials", "copper", "--json"]).stdout);
    let value: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(value["constants"]["yield_strength"]["value"], 90e6);
    let carbon = text(&asperity(here, &["materials", "carbon-steel-en1993"]).stdout);
    for part in ["youngs_modulus", "873.15 K: 6.51e10", "1008.15 K: 5000", "EN 1993-1-2:2005", "checked: "] {
        assert!(carbon.contains(part), "{carbon}");
    }
}

/// Where there is no friction the numbers are none, not rounding, and where sliding does not begin or the strength is
/// that of another temperature, a warning says so.
#[test]
fn a_run_says_what_its_numbers_are_not() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("scene.toml"), SCENE).unwrap();
    let run = |set: &[&str]| {
        let coarse = ["numerics.elements_per_radius=4", "numerics.sectors=4", "numerics.accuracy=0.5"];
        let set = coarse.iter().chain(set).flat_map(|change| ["--set", change]);
        let arguments: Vec<&str> =
            ["run", "scene.toml", "-o", "run.nc", "--json", "-v"].into_iter().chain(set).collect();
        let output = asperity(directory.path(), &arguments);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{said}");
        (serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap(), said)
    };
    for set in [
        &["loading.slip_distance=0"][..],
        &["interface.law=coulomb", "interface.friction=0"],
        &["interface.law=frictionless"],
    ] {
        let (json, said) = run(set);
        for name in ["mu", "mu_static", "Q", "G", "inception_slip"] {
            assert_eq!(json["summary"][name]["value"], 0.0, "{set:?} {name}");
        }
        assert!(!said.contains("NaN") && !said.contains("warning"), "{set:?} {said}");
    }
    let begun = "sliding has not begun";
    assert!(!run(&[]).1.contains(begun));
    assert!(run(&["loading.interference=100", "loading.slip_distance=0.005"]).1.contains(begun));
    assert!(run(&["loading.temperature=700"]).1.contains("yield_strength is taken to hold at"));
}

/// `-v` tells the notes of cells whether or not the table is a resumed one; tables without a common cell differ.
#[test]
fn tables_tell_notes_and_differ_in_their_cells() {
    let directory = tempfile::tempdir().unwrap();
    let coarse =
        "[numerics]\nelements_per_radius = 4\nsectors = 4\naccuracy = 0.5\n[loading]\nslip_distance = 0.02\n";
    std::fs::write(directory.path().join("request.toml"), format!("{REQUEST}{coarse}")).unwrap();
    for (table, interference) in [("one.nc", "[1]"), ("other.nc", "[2]")] {
        let set = format!("table.interference={interference}");
        let output =
            asperity(directory.path(), &["tabulate", "request.toml", "-o", table, "-v", "--set", &set]);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(
            said.contains("4 elements per contact radius") && !said.contains("interrupted run"),
            "{said}"
        );
    }
    let diff =
        |other: &str| asperity(directory.path(), &["table", "diff", "one.nc", other, "--tolerance", "0.1"]);
    assert_eq!(diff("one.nc").status.code(), Some(0));
    let output = diff("other.nc");
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("1 cells are in the first only, 1 in the second only"));
}
