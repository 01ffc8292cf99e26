//! Shards, their merging and the table subcommands, from outside: a coarse asperity at 2 × 2
//! points.

use std::sync::OnceLock;

use tables::table::{Cell, Slice, Table};
use tests::folder::Folder;

const REQUEST: &str = "[loading]\nslip_distance = 0.05\n\
                       [table]\ninterference = [1, 10]\nslip_rate = [0, 1]\n\
                       [numerics]\nelements_per_radius = 4\nsectors = 4\n";

/// A folder with the undivided table, by two threads, and both shards of it, by one.
fn made() -> &'static Folder {
    static MADE: OnceLock<Folder> = OnceLock::new();
    MADE.get_or_init(|| {
        let folder = crate::folder_with("request.toml", REQUEST);
        for output in ["whole.nc --jobs 2", "1.nc --jobs 1 --shard 1/2", "2.nc --jobs 1 --shard 2/2 --resume"]
        {
            folder.done(&format!("tabulate request.toml -o {output}"));
        }
        folder
    })
}

/// Refused, and no file `output`.
fn refused(line: &str, parts: &[&str], output: &str) {
    let folder = made();
    folder.refused(line, parts);
    assert!(!folder.path(output).exists(), "{line}");
}

/// The table of one initial temperature.
fn read(folder: &Folder, name: &str) -> Slice {
    Table::read(&folder.path(name)).unwrap().only().unwrap().clone()
}

#[test]
fn merged_shards_are_the_undivided_table_bit_for_bit() {
    let folder = made();
    folder.done("merge 2.nc 1.nc -o merged.nc");
    let numbers = |name: &str| {
        let mut table = read(folder, name);
        for (i, j) in table.grid() {
            let cell = Cell { wall_time: 0.0, ..table.cell(i, j).unwrap().clone() };
            table.set_cell(i, j, cell).unwrap();
        }
        table.metadata_mut().history = String::new();
        table
    };
    let (whole, merged) = (numbers("whole.nc"), numbers("merged.nc"));
    assert_eq!(merged, whole);
    // The checksum is over the bits of every number.
    assert_eq!(merged.checksum(), whole.checksum());
    let same = folder.done("table diff merged.nc whole.nc --tolerance 0").stdout;
    assert!(same.contains("no differences in the values that both have"));
    // A table that lacks cells is completed.
    folder.done("merge 2.nc -o completed.nc --partial");
    folder.done("tabulate request.toml -o completed.nc --jobs 1 --resume");
    folder.done("table diff completed.nc whole.nc --tolerance 0");
    assert!(!folder.path("completed.nc.part").exists());
    // Cells are not lost by a table with fewer.
    folder.refused("merge 2.nc -o completed.nc --partial", &["completed.nc: has cells of this request"]);
    folder.write("notes.nc", "notes");
    let replacing = folder.done("merge 1.nc 2.nc -o notes.nc").stderr;
    assert!(replacing.contains("this table replaces the file"), "{replacing}");
    // What cannot be computed again is not replaced.
    folder.write("map.x3p", b"PK\x03\x04 of another program");
    for command in ["merge 1.nc 2.nc -o map.x3p", "tabulate request.toml -o map.x3p"] {
        folder.refused(command, &["map.x3p: holds data of another program"]);
    }
    folder.refused("merge 1.nc 2.nc -o merged.nc.part", &["merged.nc.part: files named .part are journals"]);
    let alone = folder.done("merge whole.nc -o alone.nc").stderr;
    assert!(alone.contains("whole.nc is complete: there is nothing to merge it with"), "{alone}");
    // A shipped one is found by its name, and is of another request.
    folder.refused("merge whole.nc steel-4340 -o other.nc", &["whole.nc and steel-4340", "differ"]);
    let other = folder.done("table diff whole.nc copper").stdout;
    assert!(other.contains("no cell is in common"), "{other}");
    assert!(other.contains("material.youngs_modulus: 205000000000.0 and "), "{other}");
}

#[test]
fn shards_that_do_not_belong_together_are_refused() {
    let folder = made();
    refused("merge 1.nc -o m1.nc", &["2 of 4 cells", "--partial"], "m1.nc");
    folder.done("merge 1.nc -o partial.nc --partial");
    let partial = read(folder, "partial.nc");
    assert_eq!(partial.missing().len(), 2);
    assert_eq!(partial.metadata().shard, "1/2");

    let shard = read(folder, "2.nc");
    let scene = shard.metadata().scene.replace("slip_distance = 0.05", "slip_distance = 0.06");
    let mut other = shard.clone();
    other.metadata_mut().scene = scene;
    other.write(&folder.path("request.nc")).unwrap();
    let parts = ["1.nc and request.nc", "their request", "slip_distance = 0.05", "slip_distance = 0.06"];
    refused("merge 1.nc request.nc -o m2.nc", &parts, "m2.nc");
}

#[test]
fn damaged_tables_are_refused_everywhere() {
    let folder = made();
    let path = folder.path("damaged.nc");
    std::fs::copy(folder.path("whole.nc"), &path).unwrap();
    netcdf::append(&path).unwrap().variable_mut("mu").unwrap().put_value(0.5, [0, 0]).unwrap();
    let part = ["damaged.nc", "checksum"];
    refused("table info damaged.nc", &part, "none");
    refused("table plot damaged.nc -o d.png", &part, "d.png");
    refused("table export damaged.nc -o d.csv", &part, "d.csv");
    refused("table diff whole.nc damaged.nc", &part, "none");
    refused("merge damaged.nc -o m5.nc", &part, "m5.nc");
    refused("table plot whole.nc -o plot.gif", &["plot.gif", "svg, png, pdf"], "plot.gif");
    // Before the table is read.
    refused("table export damaged.nc -o d.xlsx", &["d.xlsx", ".csv"], "d.xlsx");
    refused("table info request.toml", &["cannot read request.toml"], "none");
}

/// τ₀ = 792/√3 MPa over √(ρG) = 24.94 MPa s/m with 0.5 (2 − ν) is 15.7 m/s over the slip rate.
#[test]
fn cells_in_which_sliding_begins_fast_say_so() {
    let folder = made();
    folder
        .done("tabulate request.toml -o fast.nc --set table.interference=[1] --set table.slip_rate=[0,1,10]");
    let table = read(folder, "fast.nc");
    let is_fast = |j: usize| {
        let cell = table.cell(0, j).unwrap();
        cell.warnings.iter().any(|warning| warning.starts_with("sliding begins within 1.6 times"))
    };
    assert_eq!([0, 1, 2].map(is_fast), [false, false, true]);
}

#[test]
fn a_table_is_described_plotted_and_exported() {
    let folder = made();
    let info = folder.done("table info whole.nc").stdout;
    for part in [
        "2 values from 1 to 10 omega_c",
        "4 done, 0 not run, 0 failed",
        "asperity 0.1.0, fingerprint",
        "asperity tabulate request.toml -o whole.nc",
        "mu_static",
        "median",
    ] {
        assert!(info.contains(part), "{info} lacks {part}");
    }
    let value = folder.done("table info 1.nc --json").json();
    assert_eq!(value["cells"]["not_run"], 2);
    assert_eq!(value["shard"], "1/2");
    assert!(value["quantities"]["mu"]["relative_error_median"].as_f64().unwrap() > 0.0);

    folder.done("table plot whole.nc -o plot.svg");
    let svg = folder.read("plot.svg");
    for label in ["Friction coefficient", "Friction stress", "Energy release", "Highest temperature"] {
        assert!(svg.contains(label), "{label}");
    }
    folder.done("table plot whole.nc -o one.pdf --panel slide");
    assert!(folder.bytes("one.pdf").starts_with(b"%PDF"));
    let unknown = folder.misused("table plot whole.nc -o none.svg --panel slid", &[]);
    assert!(unknown.contains("'slide'") && unknown.contains("friction-map"));
    for (histories, lines) in [("", 5), ("--histories", 1 + 4 * 73)] {
        folder.done(&format!("table export whole.nc -o table.csv {histories}"));
        let csv = folder.read("table.csv");
        assert_eq!(csv.lines().count(), lines);
    }
    let diff = folder.run("table diff whole.nc 1.nc --tolerance 0").with_status(1).stderr;
    assert!(diff.contains(": done in one, not run in the other"));
}
