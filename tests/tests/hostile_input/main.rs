//! Every reader against damaged and malicious input: whatever the bytes, a result or an error, but
//! no panic, no crash of a library, and no more memory than the limit set here.
//!
//! Inputs are mutations of good files by a fixed sequence of pseudo-random numbers: bits flipped,
//! cut off, pieces doubled or taken out, numbers and words inserted that are critical for parsers.
//! `HOSTILE_INPUTS=5000 cargo test -p tests --release --test hostile_input` tries as many of each kind.
#![cfg(unix)]

mod mutations;
mod oversized;

use std::path::{Path, PathBuf};

use asperity::scene::file::{parse_request, parse_scene};
use roughsurface::surface::file::SurfaceFile;
use roughsurface::topography::readers as topography;
use roughsurface::topography::readers::Reading;
use tables::quantity::Quantity;
use tables::table::{Axes, Cell, Metadata, Slice, Table};
use tests::programs::{execute, in_little_memory};
use tests::{files, root};

use mutations::{Random, corrupt, mutate};
use oversized::{asked_for_too_much, bombs};

/// Good files of a kind.
fn seeds(kind: &str, folder: &Path) -> Vec<Vec<u8>> {
    let files = |directory: &str, names: &[&str]| -> Vec<Vec<u8>> {
        names.iter().map(|name| std::fs::read(root().join(directory).join(name)).unwrap()).collect()
    };
    match kind {
        "scene" => files("examples/scenes", &["single-asperity.toml"]),
        "request" => files("examples/scenes", &["steel-4340-table.toml"]),
        "surface" => files(
            "examples/scenes",
            &["ground-steel-surface.toml", "bearing-steel.toml", "granite-fault.toml"],
        ),
        "table" => {
            let path = folder.join("seed.nc");
            table().write(&path).unwrap();
            let one = std::fs::read(&path).unwrap();
            let at = |temperature: f64| {
                let mut table = table();
                table.metadata_mut().temperature = temperature;
                table
            };
            Table::new(vec![at(300.0), at(500.0)]).unwrap().write(&path).unwrap();
            vec![one, std::fs::read(path).unwrap()]
        }
        _ => files(
            "roughsurface/tests/data",
            &[
                "map.gsf",
                "map.nc",
                "map.x3p",
                "map-int16.x3p",
                "map-int16.sdf",
                "map-um.npy",
                "profile.nc",
                "profile-um.txt",
            ],
        ),
    }
}

fn table() -> Slice {
    let axes = Axes { interference: vec![0.5, 5.0], slip_rate: vec![0.0, 1.0], slip: vec![0.0, 0.5, 2.0] };
    let metadata = Metadata { title: "Hostile".into(), asperity_radius: 1e-3, ..Metadata::default() };
    let mut table = Slice::new(axes, metadata).unwrap();
    for (i, j) in [(0, 0), (0, 1), (1, 1)] {
        let mut cell = Cell::new();
        for (n, quantity) in Quantity::SCALARS.into_iter().enumerate() {
            cell = cell.with(quantity, (1 + n + i + 2 * j) as f64 / 3.0, 0.01);
        }
        table.set_cell(i, j, cell).unwrap();
    }
    table.mark_failed(1, 0, "Newton did not converge");
    table
}

/// Why a text is refused, if it is.
fn refused(kind: &str, text: &str) -> Option<String> {
    match kind {
        "scene" => parse_scene(text, "input", &[]).err().map(|error| error.to_string()),
        "request" => parse_request(text, "input", &[]).err().map(|error| error.to_string()),
        _ => SurfaceFile::parse("input".as_ref(), text.into()).err().map(|error| error.to_string()),
    }
}

/// Reads one input; true if it was taken for good.
fn read(kind: &str, bytes: &[u8], folder: &Path) -> bool {
    if ["scene", "request", "surface"].contains(&kind) {
        return refused(kind, &String::from_utf8_lossy(bytes)).is_none();
    }
    let path = folder.join("input");
    // A new file each time: the HDF5 library may still have the last one open after an error, and
    // would take an old file of the same name and number for it.
    let _ = std::fs::remove_file(&path);
    std::fs::write(&path, bytes).unwrap();
    if kind == "table" {
        return Table::read(&path).is_ok();
    }
    // Arrays do not state the distance of their points, the others do.
    let spaced = Reading { pixel: Some(1e-6), ..Reading::default() };
    [Reading::default(), spaced].iter().any(|reading| topography::read(&path, reading).is_ok())
}

/// What the parent starts: inputs from HOSTILE_FIRST on, of HOSTILE_KIND; the number of the one being
/// read is written to the file `at`, so that it is available after a crash.
#[test]
#[ignore = "run by the other test, in a process of its own with little memory"]
fn reads_a_batch() {
    let variable = |name: &str| std::env::var(name).unwrap();
    let (kind, folder) = (variable("HOSTILE_KIND"), PathBuf::from(variable("HOSTILE_FOLDER")));
    let [first, last] = ["HOSTILE_FIRST", "HOSTILE_LAST"].map(|name| variable(name).parse::<u64>().unwrap());
    let seeds = seeds(&kind, &folder);
    assert!(seeds.iter().all(|seed| read(&kind, seed, &folder)), "a seed is not accepted");
    for number in first..last {
        std::fs::write(folder.join("at"), number.to_string()).unwrap();
        let mut random = Random(number);
        let seed = &seeds[random.below(seeds.len())];
        let input = mutate(seed, &mut random);
        read(&kind, &input, &folder);
    }
}

#[test]
fn no_input_breaks_a_reader() {
    survive(&["scene", "request", "surface", "topography"]);
}

/// The HDF5 library crashes on one damaged file in eight or so: such files must not reach it.
#[test]
fn no_damaged_table_breaks_a_reader() {
    survive(&["table"]);
}

/// netCDF-4 files without a checksum, as other programs write them: a table, and a map of heights.
fn foreign(folder: &Path) -> Vec<(&'static str, &'static str, Vec<u8>)> {
    let path = folder.join("seed.nc");
    table().write(&path).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    let checksum = bytes.windows(8).rposition(|end| end == b"\nsha256 ").unwrap();
    bytes.truncate(checksum);

    let path = folder.join("map.nc");
    let mut map = netcdf::create(&path).unwrap();
    for axis in ["x", "y"] {
        map.add_dimension(axis, 16).unwrap();
        map.add_variable::<f64>(axis, &[axis]).unwrap().put_attribute("length", 16e-6).unwrap();
    }
    let heights: Vec<f64> = (0..256).map(|n| 1e-8 * (f64::from(n) * 0.7).sin()).collect();
    let mut variable = map.add_variable::<f64>("heights", &["x", "y"]).unwrap();
    variable.put_attribute("unit", "m").unwrap();
    variable.put_values(&heights, ..).unwrap();
    drop(map);
    vec![
        ("asperity", "table info input", bytes),
        ("roughsurface", "characterize input", std::fs::read(path).unwrap()),
    ]
}

/// Files that crash the HDF5 library crash a copy of the program, and the program reports that.
#[test]
fn no_foreign_file_crashes_a_program() {
    let inputs: u64 = std::env::var("HOSTILE_INPUTS").map_or(150, |text| text.parse().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let mut refused = 0;
    for (name, arguments, seed) in foreign(folder.path()) {
        let run = |bytes: &[u8]| {
            std::fs::write(folder.path().join("input"), bytes).unwrap();
            execute(name, folder.path(), arguments)
        };
        let output = run(&seed);
        assert!(output.status.success(), "{}", output.stderr);
        for number in 0..inputs {
            let output = run(&corrupt(&seed, &mut Random(number)));
            let said = output.stderr;
            let code = output.status.code();
            assert!(code.is_some_and(|code| code < 3), "{name} {number}: {}: {said}", output.status);
            assert!(!said.contains("internal error"), "{name} {number}: {said}");
            refused += u64::from(said.contains("on trial"));
        }
    }
    eprintln!("{refused} of {} crashed a copy", 2 * inputs);
    assert!(refused > 0, "no input crashed the library: the test shows nothing");
}

/// Readers of text: oversized input ends with a message of one line.
#[test]
#[ignore = "run by no_bomb_and_no_finding_breaks_a_reader, in a process of its own with little memory"]
fn reads_the_bombs() {
    let folder = tempfile::tempdir().unwrap();
    let short =
        |name: &str, message: String| assert!(message.len() < 2000, "{name}: {} bytes", message.len());
    for kind in ["scene", "request", "surface"] {
        for (name, text) in bombs().into_iter().chain(asked_for_too_much(kind)) {
            eprintln!("{kind}: {name}");
            short(name, refused(kind, &text).unwrap_or_default());
        }
    }
    // What is laid over a scene on the command line is TOML too.
    let good = std::fs::read_to_string(root().join("examples/scenes/single-asperity.toml")).unwrap();
    for (name, text) in bombs() {
        eprintln!("override: {name}");
        let value = text.split_once(" = ").map_or(text.as_str(), |(_, value)| value);
        for change in [format!("material.hardening={value}"), format!("{text}=1")] {
            let error = parse_scene(&good, "input", &[change]).expect_err(name);
            short(name, error.to_string());
        }
    }
    for (name, text) in bombs() {
        eprintln!("topography: {name}");
        assert!(!read("topography", text.as_bytes(), folder.path()), "{name}");
    }
    // As many points as the longest list has, on one line and one a line.
    for text in ["1.0 ".repeat(1_000_000), "1.0\n".repeat(1_000_000)] {
        read("topography", text.as_bytes(), folder.path());
    }
}

/// What fuzzing has found (`tests/fuzz`), minimised: each is refused as damaged.
#[test]
#[ignore = "run by no_bomb_and_no_finding_breaks_a_reader, in a process of its own with little memory"]
fn reads_the_findings() {
    let findings = files(&root().join("tests/fuzz/findings/topography"), "");
    assert!(findings.len() >= 2);
    for path in findings {
        let message = topography::read(&path, &Reading::default()).unwrap_err().to_string();
        assert!(message.contains("damaged: its header asks for more"), "{}: {message}", path.display());
    }
}

#[test]
fn no_bomb_and_no_finding_breaks_a_reader() {
    for name in ["reads_the_bombs", "reads_the_findings"] {
        let begun = std::time::Instant::now();
        let output = in_little_memory(name, &[]);
        let said = output.stderr;
        let last: Vec<&str> = said.lines().rev().take(4).collect();
        assert!(output.status.success(), "{name}: {}: {last:?}", output.status);
        // None of them takes minutes.
        assert!(begun.elapsed().as_secs() < 120, "{name}: {:?}", begun.elapsed());
    }
}

fn survive(kinds: &[&str]) {
    let inputs: u64 = std::env::var("HOSTILE_INPUTS").map_or(300, |text| text.parse().unwrap());
    let mut broken = Vec::new();
    for kind in kinds {
        let folder = tempfile::tempdir().unwrap();
        let mut first = 0;
        while first < inputs {
            let variables = [
                ("HOSTILE_KIND", kind.to_string()),
                ("HOSTILE_FOLDER", folder.path().to_str().unwrap().to_owned()),
                ("HOSTILE_FIRST", first.to_string()),
                ("HOSTILE_LAST", inputs.to_string()),
            ];
            let output = in_little_memory("reads_a_batch", &variables);
            if output.status.success() {
                break;
            }
            let at = std::fs::read_to_string(folder.path().join("at")).expect("the seeds are accepted");
            let said = output.stderr;
            broken.push(format!(
                "{kind} {at}: {}: {}",
                output.status,
                said.lines().take(3).collect::<String>()
            ));
            first = at.parse::<u64>().unwrap() + 1;
        }
        eprintln!("{kind}: {inputs} inputs");
    }
    assert!(broken.is_empty(), "{} broke a reader:\n{}", broken.len(), broken.join("\n"));
}
