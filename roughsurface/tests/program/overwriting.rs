//! No output takes the place of an input or of another output.

use crate::folder::{Folder, stderr};
use std::path::Path;

const SURFACE: &str = r#"
[surface]
asperity_density = 1e10
asperity_radius = 100e-6
heights = { distribution = "sample", file = "heights.txt" }
[query]
pressure = 1e6
slip_rate = 1.0
[uncertainty]
tables = { conductivity = "up.nc" }
"#;

#[cfg(target_os = "linux")]
const PLAIN: &str = r#"
[surface]
asperity_density = 1e10
asperity_radius = 100e-6
heights = { distribution = "gaussian", std = 1e-7 }
[query]
pressure = 1e6
slip_rate = 1.0
"#;

/// A folder with a table, two links to it, a surface, its heights, and a map.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("surface.toml", SURFACE);
    folder.write("heights.txt", "0 1e-7 2e-7 3e-7\n");
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tables/data/copper.nc");
    for name in ["table.nc", "up.nc"] {
        std::fs::copy(&table, folder.path(name)).unwrap();
    }
    std::fs::hard_link(folder.path("table.nc"), folder.path("hard.nc")).unwrap();
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/map.nc");
    std::fs::copy(map, folder.path("map.nc")).unwrap();
    folder
}

#[test]
fn an_output_that_is_an_input_or_another_output_is_refused() {
    let folder = folder("overwriting");
    #[cfg(unix)]
    std::os::unix::fs::symlink("table.nc", folder.path("soft.nc")).unwrap();
    let files = ["surface.toml", "heights.txt", "table.nc", "up.nc", "map.nc"].map(|name| folder.path(name));
    let before = files.each_ref().map(|file| std::fs::read(file).unwrap());
    let predict = "predict surface.toml --table table.nc";
    for (command, expected) in [
        (format!("{predict} -o table.nc"), "--output and --table are the same file, table.nc"),
        (format!("{predict} -o ./table.nc"), "--output and --table are the same file, ./table.nc"),
        (format!("{predict} -o hard.nc"), "--output and --table are the same file, hard.nc"),
        #[cfg(unix)]
        (format!("{predict} -o soft.nc"), "--output and --table are the same file, soft.nc"),
        (format!("{predict} -o surface.toml"), "--output and the surface file are the same file"),
        (format!("{predict} -o f.nc --report surface.toml"), "--report and the surface file are the same"),
        (format!("{predict} -o f.svg --plot f.svg"), "--plot and --output are the same file, f.svg"),
        (format!("{predict} -o f.nc --plot x.svg --report x.svg"), "--report and --plot are the same file"),
        (format!("{predict} -o up.nc"), "--output and a table of the surface file are the same file"),
        (format!("{predict} -o heights.txt"), "--output and the heights of the surface file are the same"),
        (
            "sample surface.toml --table table.nc --asperities 9 -o table.nc".into(),
            "--output and --table are the same file",
        ),
        ("predict map.nc --material copper -o map.nc".into(), "--output and the topography are the same"),
        ("characterize map.nc -o map.nc".into(), "--output and the topography are the same file, map.nc"),
        ("characterize map.nc -o m.svg --plot m.svg".into(), "--plot and --output are the same file, m.svg"),
    ] {
        folder.refused(&command, expected);
        let after = files.each_ref().map(|file| std::fs::read(file).unwrap());
        assert!(before == after, "{command}");
    }
    assert!(!folder.path("f.nc").exists() && !folder.path("f.svg").exists());
}

/// A small disk: the prediction is on it, or in the place that the message names, and is printed.
#[cfg(target_os = "linux")]
#[test]
fn a_prediction_for_which_there_is_no_room_is_saved_elsewhere() {
    use std::process::Command;
    let folder = folder("full-disk");
    let allowed = Command::new("unshare").args(["-rm", "mount", "-t", "tmpfs", "tmpfs", "/mnt"]).output();
    if !allowed.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: no mount namespaces here");
        return;
    }
    folder.write("plain.toml", PLAIN);
    for kilobytes in [4, 16, 24, 32, 40, 48, 64, 96, 128, 180] {
        let script = format!(
            "mkdir -p disk; mount -t tmpfs -o size={kilobytes}k tmpfs disk; export TMPDIR=$PWD
             $ROUGHSURFACE predict plain.toml --table table.nc -o disk/f.nc; status=$?; cp disk/f.nc .; exit $status"
        );
        let mut command = Command::new("unshare");
        command.args(["-rm", "sh", "-c", &script]).current_dir(folder.path("."));
        let output = command.env("ROUGHSURFACE", env!("CARGO_BIN_EXE_roughsurface")).output().unwrap();
        let said = stderr(&output);
        assert!(
            String::from_utf8_lossy(&output.stdout).contains("mu_static"),
            "{kilobytes} kB: the summary is lost"
        );
        let place = match output.status.code() {
            Some(0) => folder.path("f.nc"),
            status => {
                assert_eq!(status, Some(1), "{kilobytes} kB: {said}");
                assert!(said.contains("no space left on the disk"), "{kilobytes} kB: {said}");
                let (_, place) = said.split_once("the results are in ").expect(&said);
                place.split_once(" instead").unwrap().0.into()
            }
        };
        tables::netcdf::DatasetReader::open(&place).expect(&said);
        std::fs::remove_file(place).unwrap();
    }
}

/// The file of heights beside the surface file would replace the map.
#[test]
fn the_file_of_heights_is_an_output_too() {
    let folder = folder("heights");
    std::fs::copy(folder.path("map.nc"), folder.path("map.heights.txt")).unwrap();
    folder.refused(
        "characterize map.heights.txt --summits found -o map.toml",
        "the file of heights and the topography are the same file, map.heights.txt",
    );
    folder.refused(
        "characterize map.nc --summits found -o map.toml --plot map.heights.txt",
        "--plot and the file of heights are the same file",
    );
    let moments = folder.run("characterize map.heights.txt --cutoff 1.6um -o map.toml");
    assert_eq!(moments.status.code(), Some(0), "{}", stderr(&moments));
}
