//! Topographies in every format, against SurfaceTopography (tests/data/make_topographies.py), and
//! from there to a prediction.

use crate::folder::{data, empty_folder, surface};
use roughsurface::surface::file::SurfaceFile;
use roughsurface::topography::Topography;
use roughsurface::topography::characterize::{Detrend, Options, characterize};
use roughsurface::topography::readers::{Reading, checked, read};
use roughsurface::topography::spectrum::Window;
use tables::netcdf::DatasetWriter;

fn topography(name: &str) -> Topography {
    let in_micrometres = name.ends_with("-um.txt") || name.ends_with("-um.npy");
    let matrix = name.starts_with("map-um");
    let reading = Reading { unit: in_micrometres.then_some(1e-6), pixel: matrix.then_some(0.2e-6) };
    read(&data(name), &reading).unwrap_or_else(|error| panic!("{error}"))
}

fn reference() -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(data("reference.json")).unwrap()).unwrap()
}

#[test]
fn moments_are_those_of_surface_topography() {
    let reference = reference();
    let cutoff = reference["cutoff"].as_f64();
    for name in ["periodic.nc", "map.nc", "map.x3p", "map-int16.x3p", "profile.nc"] {
        // Its detrending takes the plane off; its moments take the map as periodic.
        let periodic = name == "periodic.nc";
        let detrend = if periodic { Detrend::Mean } else { Detrend::Plane };
        let options = Options { cutoff, detrend: Some(detrend), window: Window::None };
        let found = characterize(topography(name), &options).unwrap();
        let values = &reference[name];
        if periodic {
            let usual = characterize(topography(name), &Options { cutoff, ..Options::default() }).unwrap();
            assert_eq!((usual.moments, usual.detrend), (found.moments, Detrend::Mean));
        }
        for (quantity, value) in [
            ("rms_height", found.rms_height),
            ("m0", found.moments.m0),
            ("m2", found.moments.m2),
            ("m4", found.moments.m4),
        ] {
            let expected = values[quantity].as_f64().unwrap();
            assert!((value / expected - 1.0).abs() < 1e-6, "{name} {quantity}: {value:e} {expected:e}");
        }
    }
}

#[test]
fn every_format_holds_the_same_map() {
    let map = topography("map.nc");
    assert_eq!((map.rows, map.columns, map.periodic), (64, 64, false));
    // SurfaceTopography writes the extent in single precision.
    assert!((map.row_step / 0.2e-6 - 1.0).abs() < 1e-7);
    // NetCDF goes along x first, the others along y.
    let turned: Vec<f64> = (0..64 * 64).map(|p| map.heights[p % 64 * 64 + p / 64]).collect();
    // Doubles; sixteen bits over a range of 1 µm, and of 6.6 µm; single precision at 3 µm; eight printed digits.
    for (name, allowed) in [
        ("map.x3p", 1e-20),
        ("map-int16.x3p", 1e-11),
        ("map-int16.sdf", 6e-11),
        ("map.gsf", 2e-13),
        ("map-um.npy", 2e-13),
        ("map-um.txt", 1e-12),
        ("map-xyz-um.txt", 1e-12),
    ] {
        let other = topography(name);
        assert_eq!((other.rows, other.columns), (64, 64), "{name}");
        for step in [other.row_step, other.column_step] {
            assert!((step / 0.2e-6 - 1.0).abs() < 1e-6, "{name}: {step:e}");
        }
        for (one, expected) in other.heights.iter().zip(&turned) {
            assert!((one - expected).abs() <= allowed, "{name}: {one:e} {expected:e}");
        }
    }
    let (binary, text) = (topography("profile.nc"), topography("profile-um.txt"));
    assert!((text.column_step / binary.column_step - 1.0).abs() < 1e-6);
    for (one, other) in text.heights.iter().zip(&binary.heights) {
        assert!((one - other).abs() < 1e-12);
    }
    assert!(topography("periodic.nc").periodic);
}

/// Curves of a panel that rise and fall over more than ten points.
fn curves(svg: &str, panel: &str) -> usize {
    let document = roxmltree::Document::parse(svg).unwrap();
    let group = document.descendants().find(|node| node.attribute("class") == Some(panel)).unwrap();
    let paths = group.descendants().filter_map(|node| node.attribute("d"));
    let heights = |path: &str| {
        let heights = path.split(['M', 'L']).skip(1).map(|point| point.split(' ').nth(1).unwrap().to_owned());
        heights.collect::<std::collections::BTreeSet<String>>().len()
    };
    paths.filter(|path| !path.ends_with('Z') && heights(path) > 10).count()
}

/// Whether `units` has a unit at the place of every number of `value`.
pub fn numbers_have_units(value: &serde_json::Value, units: &serde_json::Value, place: &str) {
    match value {
        serde_json::Value::Number(_) => assert!(units.is_string(), "{place}: {units}"),
        serde_json::Value::Array(list) => {
            list.iter().for_each(|value| numbers_have_units(value, units, place));
        }
        serde_json::Value::Object(keys) => {
            keys.iter().for_each(|(key, value)| numbers_have_units(value, &units[key], key));
        }
        _ => {}
    }
}

#[test]
fn a_topography_becomes_a_surface_file_that_predicts() {
    let folder = empty_folder();
    let map = data("map.x3p").display().to_string();
    for summits in ["moments", "found"] {
        let options = format!("--cutoff 1.6um --summits {summits} -o s.toml --json --plot s.svg");
        let output = folder.done(&format!("characterize {map} {options}"));
        let result = output.json();
        numbers_have_units(&result, &result["units"], "");
        let key = if summits == "moments" { "summits" } else { "found" };
        let expected = |name: &str| result[key][name].as_f64().unwrap();
        let surface = SurfaceFile::read(&folder.path("s.toml")).unwrap().surface;
        assert!((surface.asperity_density / expected("density") - 1.0).abs() < 1e-6);
        assert!((surface.asperity_radius.mean() / expected("radius") - 1.0).abs() < 1e-6);
        assert!((surface.heights.standard_deviation() / expected("std") - 1.0).abs() < 1e-5);
        let figure = folder.read("s.svg");
        assert!(figure.contains("Wavelength (m)") && figure.contains("from moments"));
        assert_eq!(curves(&figure, "panel spectrum"), 2);
        assert_eq!(curves(&figure, "panel summits"), 2);
    }
    let mut text = folder.read("s.toml");
    text.push_str("[material]\nyoungs_modulus = 200e9\npoisson_ratio = 0.3\nyield_strength = 1e9\n");
    folder.write("s.toml", text);
    folder.done("predict s.toml --table model:jackson-green -o f.nc -q");
}

#[test]
fn micrometres_read_as_metres_are_noticed() {
    let map = data("map-um.npy");
    let output = empty_folder().done(&format!("characterize {} --pixel 0.2um --cutoff 1.6um", map.display()));
    assert_eq!(output.stderr.matches("--unit um").count(), 1, "{}", output.stderr);
}

/// A file of an instrument: titles in Latin-1, decimal commas.
#[test]
fn titles_state_units_in_any_encoding_and_what_none_states_is_said() {
    let folder = empty_folder();
    // Waves that fall like those of a rough profile.
    let height = |x: f64| (1..100).map(f64::from).map(|k| (0.0157 * k * x + k * k).sin() / k).sum::<f64>();
    let point = |i: i32| {
        let x = f64::from(i);
        format!("{};{}\n", 0.5e-3 * x, height(x)).replace('.', ",")
    };
    let points: String = (0..400).map(point).collect();
    for (name, title) in [
        ("latin.csv", &b"Abstand [mm];H\xf6he [\xb5m]\n"[..]),
        ("utf.csv", "Abstand [mm];Höhe [µm]\n".as_bytes()),
        ("numpy.csv", b"# x [mm]\tz [um]\n"),
        ("units.csv", b"x;z\nmm;um\n"),
    ] {
        folder.write(name, [title, points.as_bytes()].concat());
        let output = folder.done(&format!("characterize {name} --cutoff 4um --json"));
        let result = output.json();
        assert!((result["pixel"].as_f64().unwrap() / 0.5e-6 - 1.0).abs() < 1e-9, "{name}: {result}");
        let height = result["rms_height"].as_f64().unwrap();
        assert!((5e-7..1e-6).contains(&height), "{name}: {height}");
        assert!(!output.stderr.contains("states no unit"), "{}", output.stderr);
    }
    folder.write("none.csv", format!("x;z\n{points}"));
    folder.refused(
        "characterize none.csv --cutoff 2um",
        &["the file states no unit, metres are assumed: for text"],
    );
}

#[test]
fn bad_topographies_end_with_status_two_one_line_and_nothing_written() {
    let folder = empty_folder();
    for (file, parts) in [("map.x3p", 2), ("map.gsf", 2), ("map.nc", 100)] {
        let whole = std::fs::read(data(file)).unwrap();
        folder.write(&file.replace("map", "cut"), &whole[..whole.len() / parts]);
    }
    folder.write("text.txt", "1 2 3 4\n5 6 seven 8\n");
    folder.write("flat.txt", "1 1 1 1 1 1 1 1\n".repeat(8));
    folder.write("small.txt", "1 2 3 4\n5 6 7 8\n");
    folder.write("map.sur", b"DIGITAL SURF\0\0\x01\0");
    let (map, profile) = (data("map.nc").display().to_string(), data("profile.nc").display().to_string());
    for (arguments, expected) in [
        ("none.x3p", "none.x3p: cannot be read"),
        ("cut.x3p", "cut.x3p: is no X3P file"),
        ("cut.gsf", "cut.gsf: holds"),
        ("cut.nc", "cut.nc: "),
        ("text.txt", "text.txt: line 2: \"seven\" is not a number"),
        ("flat.txt --pixel 1um", "flat.txt: all heights are"),
        ("small.txt --pixel 1um", "small.txt: holds 2 x 4 points; at least 8"),
        ("small.txt", "give it with --pixel LENGTH"),
        ("map.sur", "map.sur: is a binary file of unknown format; known are X3P"),
        (&format!("{map} --unit um"), "states its own lengths"),
        (&format!("{map} --cutoff 0.1um"), "cutoff = 1e-7 m: must lie between"),
        (&format!("{profile} --cutoff 1um --summits found"), "needs a map"),
    ] {
        folder.refused(&format!("characterize {arguments} -o s.toml"), &[expected]);
        assert!(!folder.path("s.toml").exists(), "{arguments}");
    }
    folder.refused(&format!("characterize {map} -o no/s.toml"), &["its folder does not exist"]);
}

/// A title with a unit is none of the sections of a surface file; a surface file may begin with a mark of its encoding.
#[test]
fn topographies_and_surface_files_are_told_apart() {
    let folder = empty_folder();
    let text = std::fs::read_to_string(data("map-xyz-um.txt")).unwrap();
    for (title, unit) in [("[um]", "--unit um"), ("[um] [um] [um]", "")] {
        folder.write("titled.txt", format!("{title}\n{text}"));
        let query = "--cutoff 1.6um --table steel-4340 --pressure 1e5 --slip-rate 1";
        folder.done(&format!("predict titled.txt {unit} {query} -o f.nc -q"));
    }
    let surface = surface(1e8, 1e-3, 4e-7, "pressure = 1e6\nslip_rate = 1");
    folder.write("marked.surface", format!("\u{feff}{surface}"));
    folder.done("predict marked.surface --table steel-4340 -o f.nc -q");
    // As spreadsheets write "Unicode".
    let utf16: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    folder.write("unicode.txt", utf16);
    folder.done("characterize unicode.txt --unit um --cutoff 1.6um -q");
}

/// Positions in micrometres, heights in nanometres; a profile along either side of a matrix.
#[test]
fn lengths_are_those_of_each_variable_and_of_the_longer_side() {
    let folder = empty_folder();
    let heights: Vec<f64> = (0..512).map(|place| (0.37 * f64::from(place * place)).sin()).collect();
    let mut file = DatasetWriter::create(&folder.path("units.nc"), "heights").unwrap();
    for (name, points) in [("x", 16), ("y", 32)] {
        let places: Vec<f64> = (0..points).map(f64::from).collect();
        let attributes = [("length", f64::from(2 * points).into()), ("unit", "um".into())];
        file.coordinate(name, &places, &attributes).unwrap();
    }
    file.reals("heights", &["x", "y"], &heights, &[("unit", "nm".into())]).unwrap();
    file.finish().unwrap();
    let found = read(&folder.path("units.nc"), &Reading::default()).unwrap();
    assert_eq!((found.rows, found.columns), (16, 32));
    assert!((found.row_step / 2e-6 - 1.0).abs() < 1e-12 && (found.column_step / 2e-6 - 1.0).abs() < 1e-12);
    for (found, height) in found.heights.iter().zip(&heights) {
        assert!((found - 1e-9 * height).abs() < 1e-20, "{found:e}");
    }
    for (rows, columns) in [((1, f64::NAN), (512, 2e-6)), ((512, 2e-6), (1, f64::NAN))] {
        let found = checked(Topography::map(rows, columns, heights.clone())).unwrap();
        assert!(found.is_profile() && found.heights == heights);
        assert_eq!((found.columns, found.column_step, found.row_step), (512, 2e-6, 2e-6));
    }
}

/// White noise has shorter waves than any isotropic surface with such profiles.
#[test]
fn noise_in_a_profile_is_refused() {
    let folder = empty_folder();
    let mut state = 1u64;
    let mut noise = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        1e-7 * ((state >> 11) as f64 / (1u64 << 53) as f64 - 0.5)
    };
    let heights: Vec<String> = (0..500).map(|_| format!("{:e}", noise())).collect();
    folder.write("noise.txt", heights.join("\n"));
    let mut refused = 0;
    for cutoff in ["4um", "8um", "16um", "32um", "64um"] {
        let output =
            folder.run(&format!("characterize noise.txt --pixel 1um --unit m --cutoff {cutoff} --json -q"));
        if output.status.success() {
            let summits = &output.json()["summits"];
            let is_positive = |name: &str| summits[name].as_f64().is_some_and(|value| value > 0.0);
            assert!(["density", "radius", "std"].into_iter().all(is_positive), "{cutoff}: {summits}");
        } else {
            refused += 1;
            let message = output.stderr;
            assert!(message.contains("no isotropic surface has the estimated moments"), "{message}");
        }
    }
    assert!(refused > 0);
}

/// What is no regular file is refused at once: reading a FIFO or /dev/zero would not end.
#[cfg(unix)]
#[test]
fn folders_fifos_and_devices_are_refused_at_once() {
    let folder = empty_folder();
    let made = std::process::Command::new("mkfifo").arg(folder.path("fifo")).status().unwrap();
    assert!(made.success());
    for (name, expected) in
        [("fifo", "fifo: cannot be read: it is a FIFO"), (".", ".: cannot be read: it is a folder")]
    {
        folder.refused(&format!("characterize {name} -o s.toml"), &[expected]);
    }
    folder.refused(
        "characterize /dev/zero --pixel 1um",
        &["/dev/zero: cannot be read: it is a FIFO, a socket or a device"],
    );
    let sample = "[surface]\nasperity_density = 1e10\nasperity_radius = 1e-4\nheights = { distribution = \"sample\", \
                  file = \"/dev/zero\" }\n[query]\npressure = 1e6\nslip_rate = 1\n";
    folder.write("s.toml", sample);
    folder.refused("predict s.toml --table copper -o f.nc", &["heights.file = \"/dev/zero\""]);
}
