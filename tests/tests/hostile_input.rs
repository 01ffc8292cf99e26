//! Every reader against damaged and malicious input: whatever the bytes, an answer or an error, but
//! no panic, no crash of a library, and no more memory than the limit set here.
//!
//! Inputs are mutations of good files by a fixed sequence of pseudo-random numbers: bits flipped,
//! cut off, pieces doubled or taken out, numbers and words put in that are known for trouble.
//! `HOSTILE_INPUTS=5000 cargo test -p tests --release --test hostile_input` tries as many of each kind.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::Command;

use asperity::scene::file::{parse_request, parse_scene};
use roughsurface::surface::file::SurfaceFile;
use roughsurface::topography::readers as topography;
use roughsurface::topography::readers::Reading;
use tables::quantity::Quantity;
use tables::table::{Axes, Cell, Metadata, Slice, Table};
use tests::programs;

/// Of the process that reads, in kB; the inputs are below 200 kB.
const MEMORY: usize = 1_000_000;

/// splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }
}

/// Numbers and words known for trouble, for text and in binary.
const TROUBLE: [&[u8]; 22] = [
    b"nan",
    b"inf",
    b"-inf",
    b"0",
    b"-1",
    b"1e308",
    b"-1e308",
    b"1e-320",
    b"9223372036854775807",
    b"-9223372036854775808",
    b"1e999",
    b"[]",
    b"{}",
    b"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    b"\"\"\"",
    b"a.b.c.d.e.f=1\n",
    b"\xff\xfe\x00",
    b"\x00\x00\x00\x00\x00\x00\x00\x00",
    b"\xff\xff\xff\xff\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\x00\x00\x00\x00\x00\x00\xf8\x7f",
    b"\n",
];

fn mutate(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(4) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        match random.below(7) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes.truncate(at),
            2 => {
                let end = (at + random.below(64)).min(bytes.len());
                bytes.drain(at..end);
            }
            3 => {
                let end = (at + random.below(200)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            4 => {
                let word = TROUBLE[random.below(TROUBLE.len())];
                let end = (at + word.len()).min(bytes.len());
                bytes.splice(at..end, word.iter().copied());
            }
            5 => bytes[at] = random.next() as u8,
            // A number or word of a text.
            _ => {
                let ends = |byte: &u8| b" ,=[]{}\n\t\"".contains(byte);
                let start = bytes[..at].iter().rposition(ends).map_or(0, |k| k + 1);
                let end = at + bytes[at..].iter().position(ends).unwrap_or(0);
                let word = TROUBLE[random.below(TROUBLE.len())];
                bytes.splice(start..end.max(start), word.iter().copied());
            }
        }
    }
    bytes
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

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
            let mut hot = table();
            hot.set_metadata(Metadata { temperature: 500.0, ..hot.metadata().clone() });
            let mut cold = table();
            cold.set_metadata(Metadata { temperature: 300.0, ..cold.metadata().clone() });
            Table::new(vec![cold, hot]).unwrap().write(&path).unwrap();
            vec![one, std::fs::read(path).unwrap()]
        }
        _ => files(
            "roughsurface/tests/data",
            &["map.gsf", "map.nc", "map.x3p", "map-int16.x3p", "profile.nc", "profile-um.txt"],
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

/// Reads one input; true if it was taken for good.
fn read(kind: &str, bytes: &[u8], folder: &Path) -> bool {
    let text = || String::from_utf8_lossy(bytes).into_owned();
    let path = folder.join("input");
    // A new file each time: the HDF5 library may still have the last one open after an error, and
    // would take an old file of the same name and number for it.
    let _ = std::fs::remove_file(&path);
    match kind {
        "scene" => parse_scene(&text(), "input", &[]).is_ok(),
        "request" => parse_request(&text(), "input", &[]).is_ok(),
        "surface" => SurfaceFile::parse(&path, text()).is_ok(),
        "table" => {
            std::fs::write(&path, bytes).unwrap();
            Table::read(&path).is_ok()
        }
        _ => {
            std::fs::write(&path, bytes).unwrap();
            topography::read(&path, &Reading::default()).is_ok()
        }
    }
}

/// What the parent starts: inputs from HOSTILE_FIRST on, of HOSTILE_KIND; the number of the one being
/// read stands in the file `at`, so that it is known after a crash.
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

/// The HDF5 library crashes on one damaged file in eight or so: it must not come to see them.
#[test]
fn no_damaged_table_breaks_a_reader() {
    survive(&["table"]);
}

/// netCDF-4 files without a seal, as other programs write them: a table, and a map of heights.
fn foreign(folder: &Path) -> Vec<(&'static str, &'static str, Vec<u8>)> {
    let path = folder.join("seed.nc");
    table().write(&path).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    let seal = bytes.windows(8).rposition(|end| end == b"\nsha256 ").unwrap();
    bytes.truncate(seal);

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

/// Bytes changed where they stand, so that the length is the one that the file states.
fn corrupt(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + random.below(8) {
        let word = TROUBLE[random.below(TROUBLE.len())];
        let at = random.below(bytes.len() - word.len());
        if random.below(2) == 0 {
            bytes[at] = random.next() as u8;
        } else {
            bytes[at..at + word.len()].copy_from_slice(word);
        }
    }
    bytes
}

/// What crashes the HDF5 library crashes a copy of the program, which says so.
#[test]
fn no_foreign_file_crashes_a_program() {
    let inputs: u64 = std::env::var("HOSTILE_INPUTS").map_or(150, |text| text.parse().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let mut refused = 0;
    for (name, arguments, seed) in foreign(folder.path()) {
        let run = |bytes: &[u8]| {
            std::fs::write(folder.path().join("input"), bytes).unwrap();
            programs::execute(name, folder.path(), arguments)
        };
        let output = run(&seed);
        assert!(output.status.success(), "{}", programs::stderr(&output));
        for number in 0..inputs {
            let output = run(&corrupt(&seed, &mut Random(number)));
            let said = programs::stderr(&output);
            let code = output.status.code();
            assert!(code.is_some_and(|code| code < 3), "{name} {number}: {}: {said}", output.status);
            assert!(!said.contains("internal error"), "{name} {number}: {said}");
            refused += u64::from(said.contains("on trial"));
        }
    }
    eprintln!("{refused} of {} crashed a copy", 2 * inputs);
    assert!(refused > 0, "no input crashed the library: the test shows nothing");
}

/// Texts that are small or at most some megabytes, and ask for much: deep nesting of every kind, long lists,
/// huge counts, keys without end.
fn bombs() -> Vec<(&'static str, String)> {
    const DEEP: usize = 100_000;
    let many = |item: &str, count: usize| item.repeat(count);
    let digits = many("9", DEEP);
    vec![
        ("nested lists", format!("a = {}", many("[", DEEP))),
        ("nested lists, closed", format!("a = {}{}", many("[", DEEP), many("]", DEEP))),
        ("nested tables", format!("a = {}1{}", many("{ a = ", DEEP), many(" }", DEEP))),
        ("a key of many parts", format!("{}a = 1", many("a.", DEEP))),
        ("a section of many parts", format!("[{}a]", many("a.", DEEP))),
        ("a section of lists of many parts", format!("[[{}a]]", many("a.", DEEP))),
        ("many sections", (0..DEEP).map(|n| format!("[a{n}]\n")).collect()),
        ("many lists of sections", many("[[a]]\n", DEEP)),
        ("many keys", (0..DEEP).map(|n| format!("a{n} = 1\n")).collect()),
        ("a long list", format!("a = [{}]", many("1.0,", 1_000_000))),
        ("a long list of lists", format!("a = [{}]", many("[[]],", 300_000))),
        ("an endless number", format!("a = {digits}")),
        ("an endless fraction", format!("a = 0.{digits}e{digits}")),
        ("an endless word", format!("a = \"{}\"", many("é", DEEP))),
        ("an endless key", format!("\"{}\" = 1", many("a\\n", DEEP))),
        ("an open text", format!("a = \"\"\"{}", many("\n", DEEP))),
    ]
}

/// The same within input files that are good but for one value.
fn asked_for_too_much(kind: &str) -> Vec<(&'static str, String)> {
    let base = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n";
    let scene = format!("{base}[loading]\ninterference = 5\nslip_rate = 1\n");
    let rising = |count: usize| (0..count).map(|n| format!("{n}.0,")).collect::<String>();
    match kind {
        "scene" => vec![
            ("a fine mesh", format!("{scene}[numerics]\nelements_per_radius = 1000000000000\n")),
            ("many angles", format!("{scene}[numerics]\nsectors = 9223372036854775807\n")),
            (
                "a long table",
                scene.replace(
                    "preset = \"copper\"\n",
                    &format!(
                        "preset = \"copper\"\nhardening = {{ law = \"table\", plastic_strain = [{0}], factor = [{0}] }}\n",
                        rising(300_000)
                    ),
                ),
            ),
        ],
        "request" => vec![
            (
                "many points",
                format!(
                    "{base}[table]\nslip_rate = [1]\n\
                     interference = {{ from = 0.1, to = 100, points = 9223372036854775807 }}\n"
                ),
            ),
            (
                "many cells",
                format!(
                    "{base}[table]\ninterference = [1, 2]\nslip_rate = [1]\ntolerance = 0.1\n\
                     max_cells = 9223372036854775807\n"
                ),
            ),
            ("a long axis", format!("{base}[table]\ninterference = [1]\nslip_rate = [{}]\n", rising(300_000))),
        ],
        _ => vec![(
            "many pressures",
            format!(
                "[surface]\nasperity_density = 1e10\nasperity_radius = 1e-4\n\
                 heights = {{ distribution = \"gaussian\", std = 1e-6 }}\n\
                 [query]\npressure = [{}]\nslip_rate = [1.0]\n",
                (1..300_000).map(|n| format!("{n}.0,")).collect::<String>()
            ),
        )],
    }
}

/// Of each reader of text; what is too much is answered in a line, not in megabytes.
#[test]
#[ignore = "run by the next test, in a process of its own with little memory"]
fn reads_the_bombs() {
    let folder = tempfile::tempdir().unwrap();
    let short =
        |name: &str, message: String| assert!(message.len() < 2000, "{name}: {} bytes", message.len());
    for kind in ["scene", "request", "surface"] {
        for (name, text) in bombs().into_iter().chain(asked_for_too_much(kind)) {
            eprintln!("{kind}: {name}");
            let error = match kind {
                "scene" => parse_scene(&text, "input", &[]).err().map(|error| error.to_string()),
                "request" => parse_request(&text, "input", &[]).err().map(|error| error.to_string()),
                _ => SurfaceFile::parse(Path::new("input"), text).err().map(|error| error.to_string()),
            };
            short(name, error.unwrap_or_default());
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

#[test]
fn no_bomb_breaks_a_reader() {
    let script = format!("ulimit -v {MEMORY}; exec \"$0\" --exact reads_the_bombs --ignored --nocapture");
    let program = std::env::current_exe().unwrap();
    let begun = std::time::Instant::now();
    let output = Command::new("sh")
        .args(["-c".as_ref(), script.as_ref(), program.as_os_str()])
        .env("RUST_BACKTRACE", "0")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    let last: Vec<&str> = said.lines().rev().take(4).collect();
    assert!(output.status.success(), "{}: {last:?}", output.status);
    // None of them takes minutes.
    assert!(begun.elapsed().as_secs() < 120, "{:?}", begun.elapsed());
}

fn survive(kinds: &[&str]) {
    let inputs: u64 = std::env::var("HOSTILE_INPUTS").map_or(300, |text| text.parse().unwrap());
    let mut broken = Vec::new();
    for kind in kinds {
        let folder = tempfile::tempdir().unwrap();
        let mut first = 0;
        while first < inputs {
            let script =
                format!("ulimit -v {MEMORY}; exec \"$0\" --exact reads_a_batch --ignored --nocapture");
            let program = std::env::current_exe().unwrap();
            let output = Command::new("sh")
                .args(["-c".as_ref(), script.as_ref(), program.as_os_str()])
                .env("HOSTILE_KIND", kind)
                .env("HOSTILE_FOLDER", folder.path())
                .env("HOSTILE_FIRST", first.to_string())
                .env("HOSTILE_LAST", inputs.to_string())
                .env("RUST_BACKTRACE", "0")
                .output()
                .unwrap();
            if output.status.success() {
                break;
            }
            let at = std::fs::read_to_string(folder.path().join("at")).expect("the seeds are accepted");
            let said = String::from_utf8_lossy(&output.stderr);
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
