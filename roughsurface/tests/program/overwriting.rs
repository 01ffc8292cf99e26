//! No output takes the place of an input or of another output.

use crate::folder::{data, folder_with, surface};
use std::path::Path;
use tests::folder::Folder;

/// A folder with a table, a copy and a link of it, a surface, one that reads its heights and the copy, and a map.
fn folder() -> Folder {
    let gaussian = r#"distribution = "gaussian", std = 1e-7"#;
    let plain = surface(1e10, 1e-4, 1e-7, "pressure = 1e6\nslip_rate = 1.0");
    let measured = plain.replace(gaussian, r#"distribution = "sample", file = "heights.txt""#);
    let folder = folder_with(&(measured + "[uncertainty]\ntables = { conductivity = \"up.nc\" }\n"));
    folder.write("plain.toml", plain);
    folder.write("heights.txt", "0 1e-7 2e-7 3e-7\n");
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tables/data/copper.nc");
    for name in ["table.nc", "up.nc"] {
        std::fs::copy(&table, folder.path(name)).unwrap();
    }
    std::fs::hard_link(folder.path("table.nc"), folder.path("hard.nc")).unwrap();
    std::fs::copy(data("map.nc"), folder.path("map.nc")).unwrap();
    folder
}

#[test]
fn an_output_that_is_an_input_or_another_output_is_refused() {
    let folder = folder();
    #[cfg(unix)]
    std::os::unix::fs::symlink("table.nc", folder.path("soft.nc")).unwrap();
    folder.write("map.gsf", "Gwyddion Simple Field 1.0\n");
    let files = ["surface.toml", "heights.txt", "table.nc", "up.nc", "map.nc", "map.gsf"];
    let files = files.map(|name| folder.path(name));
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
        (format!("{predict} -o f.nc --plot x.svg --report x.svg"), "--report and --plot are the same file"),
        (format!("{predict} -o up.nc"), "up.nc: is a table, which only `asperity tabulate`"),
        (format!("{predict} -o map.nc"), "map.nc: holds data of another program"),
        (format!("{predict} -o map.gsf"), "map.gsf: holds data of another program"),
        (
            "sample surface.toml --table table.nc --asperities 9 -o table.nc".into(),
            "--output and --table are the same file",
        ),
        ("predict map.nc --material copper -o map.nc".into(), "--output and the topography are the same"),
        ("characterize map.nc -o map.nc".into(), "--output and the topography are the same file, map.nc"),
        ("characterize map.nc -o m.svg --plot m.svg".into(), "--plot and --output are the same file, m.svg"),
    ] {
        folder.refused(&command, &[expected]);
        let after = files.each_ref().map(|file| std::fs::read(file).unwrap());
        assert!(before == after, "{command}");
    }
    folder.misused(&format!("{predict} -o heights.txt"), &["name it .nc, not .txt"]);
    assert!(!folder.path("f.nc").exists() && !folder.path("f.svg").exists());
}

/// Every file is on the disk, or in the place that the message names, and the summary is printed.
#[cfg(target_os = "linux")]
#[test]
fn results_for_which_there_is_no_room_are_saved_elsewhere() {
    let folder = folder();
    let predict = "predict plain.toml --table table.nc -o disk/f.nc --plot disk/f.svg --report disk/f.html";
    let sample = "sample plain.toml --table table.nc --asperities 9 --realizations 2 -o disk/f.nc";
    for (command, names) in [(predict, &["f.nc", "f.svg", "f.html"][..]), (sample, &["f.nc"])] {
        for kilobytes in [4, 16, 24, 32, 48, 64, 96, 128, 180] {
            let Some(output) = folder.on_small_disk(kilobytes, command) else { return };
            let said = output.stderr;
            let printed = output.stdout;
            assert!(printed.contains("pressure"), "{kilobytes} kB: the summary is lost");
            let places = tests::folder::places(&said);
            assert_eq!(output.status.code(), Some(i32::from(!places.is_empty())), "{kilobytes} kB: {said}");
            assert_eq!(said.matches("no space left on the disk").count(), places.len(), "{said}");
            for name in names {
                let elsewhere = places.iter().find(|place| place.ends_with(name));
                let place = elsewhere.map_or(folder.path("left").join(name), |place| place.to_path_buf());
                match *name {
                    "f.nc" => drop(tables::netcdf::DatasetReader::open(&place).expect(&said)),
                    _ => {
                        let text = std::fs::read_to_string(&place).expect(&said);
                        assert!(text.trim_end().ends_with(['>']), "{kilobytes} kB: {name} is cut off");
                    }
                }
            }
            let left = std::fs::read_dir(folder.path("left")).unwrap().count();
            assert_eq!(left + places.len(), names.len(), "{kilobytes} kB: {said}");
        }
    }
}

/// An export is made again from its input.
#[cfg(target_os = "linux")]
#[test]
fn an_export_for_which_there_is_no_room_leaves_nothing() {
    let folder = folder();
    folder.done("predict plain.toml --table table.nc --slip-rate 0.1..10:300 -o f.nc --quiet");
    let Some(output) = folder.on_small_disk(4, "export f.nc -o disk/f.csv") else { return };
    let said = output.stderr;
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write disk/f.csv: no space left on the disk"), "{said}");
    assert_eq!(std::fs::read_dir(folder.path("left")).unwrap().count(), 0);
}

/// What a user writes into a surface file cannot be computed again.
#[test]
fn an_edited_surface_file_is_not_replaced() {
    let folder = folder();
    let line = "characterize map.nc --cutoff 1.6um --summits found -o map.toml";
    folder.done(line);
    folder.done(line);
    for name in ["map.toml", "map.heights.txt"] {
        let file = folder.path(name);
        let text = std::fs::read_to_string(&file).unwrap();
        for edited in [format!("{text}# note\n"), text.replacen('1', "2", 1)] {
            std::fs::write(&file, &edited).unwrap();
            folder.refused(line, &["was changed since `roughsurface characterize` wrote it"]);
            assert_eq!(std::fs::read_to_string(&file).unwrap(), edited);
        }
        std::fs::write(&file, &text).unwrap();
    }
    folder.done("predict map.toml --table table.nc -o f.nc --quiet");
}

/// A name that is given again by mistake.
#[test]
fn results_of_other_commands_stay() {
    let folder = folder();
    let predict = |name: &str| format!("predict plain.toml --table table.nc -o {name} --quiet");
    let sample = |name: &str| {
        format!("sample plain.toml --table table.nc --asperities 9 --realizations 2 -o {name} --quiet")
    };
    for name in ["f.nc", "f.nc"] {
        folder.done(&predict(name));
    }
    folder.done(&sample("mc.nc"));
    folder.refused(
        &predict("mc.nc"),
        &["is not a result of this command, but \"Friction of finite rough surfaces\""],
    );
    folder
        .refused(&sample("f.nc"), &["is not a result of this command, but \"Friction of a rough surface\""]);
}

/// The file of heights beside the surface file would replace the map.
#[test]
fn the_file_of_heights_is_an_output_too() {
    let folder = folder();
    std::fs::copy(folder.path("map.nc"), folder.path("map.heights.txt")).unwrap();
    folder.refused(
        "characterize map.heights.txt --summits found -o map.toml",
        &["the file of heights and the topography are the same file, map.heights.txt"],
    );
    folder.refused(
        "characterize map.nc --summits found -o map.toml --plot map.heights.txt",
        &["--plot and the file of heights are the same file"],
    );
    folder.done("characterize map.heights.txt --cutoff 1.6um -o map.toml");
}
