//! Tables over initial temperature from outside: made, made in parts, read at one of them and in
//! between. A coarse asperity at 2 × 1 points and 3 temperatures.

use std::sync::OnceLock;

use tables::quantity::Quantity;
use tables::table::Table;

use tests::folder::Folder;

use crate::{SPHERE, cells, folder_with};

const REQUEST: &str = "[loading]\nslip_distance = 0.05\n\
                       [table]\ninterference = [2, 8]\nslip_rate = [1]\ntemperature = [298, 500, 700]\n\
                       [numerics]\nelements_per_radius = 4\nsectors = 4\n";

/// A folder with the table and both shards of it, and the table of 500 K by itself.
fn made() -> &'static Folder {
    static MADE: OnceLock<Folder> = OnceLock::new();
    MADE.get_or_init(|| {
        let folder = folder_with("request.toml", REQUEST);
        folder.done("tabulate request.toml -o whole.nc --plot whole.svg");
        folder.done("tabulate request.toml -o 1.nc --shard 1/2");
        folder.done("tabulate request.toml -o 2.nc --shard 2/2 --resume");
        // Strength and hardening as the softening law of the preset has them at 500 K.
        let factor = 1.0 - ((500.0_f64 - 298.0) / (1793.0 - 298.0)).powf(1.03);
        let (strength, modulus) = (792e6 * factor, 510e6 * factor);
        let alone = format!("{SPHERE}{REQUEST}")
            .replace("temperature = [298, 500, 700]\n", "")
            .replace("slip_distance", "temperature = 500.0\nslip_distance");
        let hot = format!("yield_strength = {strength}\nhardening = {{ modulus = {modulus} }}\n[asperity]");
        folder.write("alone.toml", alone.replace("[asperity]", &hot));
        folder.done("tabulate alone.toml -o alone.nc");
        folder
    })
}

#[test]
fn shards_merge_to_the_undivided_table() {
    let folder = made();
    folder.done("merge 2.nc 1.nc -o merged.nc --plot merged.svg");
    assert_eq!(cells(&folder.path("merged.nc")), cells(&folder.path("whole.nc")));
    let merged = Table::read(&folder.path("merged.nc")).unwrap();
    assert!(merged.slices().iter().all(|table| table.metadata().shard.is_empty()));
    folder.refused("merge 1.nc -o partial.nc", &["of 6 cells", "K; --partial"]);
    folder.refused("merge 1.nc alone.nc -o mixed.nc", &["1.nc and alone.nc", "temperatures: 3 and 1"]);
    for name in ["whole", "merged"] {
        for temperature in [298, 500, 700] {
            let svg = std::fs::read_to_string(folder.path(format!("{name}-{temperature}K.svg"))).unwrap();
            assert!(svg.contains(&format!("at {temperature} K")), "{name} {temperature}");
        }
    }
}

#[test]
fn a_table_of_several_temperatures_is_read_at_one() {
    let folder = made();
    let info = folder.done("table info whole.nc").stdout;
    for part in
        ["3 values from 298 to 700 K", "6 done", "schema        version 2", "from 500 K: yield strength"]
    {
        assert!(info.contains(part), "{info} lacks {part}");
    }
    let json = folder.done("table info whole.nc --json").json();
    assert_eq!(json["temperature"], serde_json::json!([298.0, 500.0, 700.0]));
    assert_eq!(json["tables"][2]["cells"]["done"], 2);
    assert!(folder.done("table info whole.nc --temperature 600").stdout.contains("2 done, 0 not run"));
    for (line, lines) in [("", 1 + 6), (" --temperature 450", 1 + 2), (" --histories", 1 + 6 * 73)] {
        folder.done(&format!("table export whole.nc -o whole.csv{line}"));
        let csv = std::fs::read_to_string(folder.path("whole.csv")).unwrap();
        assert_eq!(csv.lines().count(), lines);
        assert_eq!(csv.starts_with("temperature [K],interference [1]"), !line.contains("450"));
    }
    let range = ["whole.nc: has initial temperatures from 298 to 700 K", "--temperature"];
    folder.refused("table plot whole.nc -o plot.svg", &range);
    folder.refused("table check whole.nc", &range);
    folder.refused("table diff whole.nc alone.nc", &range);
    let outside = ["1000 K is outside the table, which goes from 298 to 700 K"];
    folder.refused("table plot whole.nc -o plot.svg --temperature 1000", &outside);
    folder.refused("table info alone.nc --temperature 400", &["of 500 K only, not 400 K"]);
    folder.done("table plot whole.nc -o plot.svg --temperature 400");
    assert!(std::fs::read_to_string(folder.path("plot.svg")).unwrap().contains("at 400 K"));
}

#[test]
fn at_one_of_its_temperatures_it_is_the_table_of_that_temperature() {
    let folder = made();
    let diff = folder.done("table diff whole.nc alone.nc --temperature 500 --tolerance 1e-9").stdout;
    assert!(diff.contains("2 cells in common, 0 in the first only, 0 in the second only"), "{diff}");
    let check = folder.done("table check whole.nc --cells 1 --temperature 700").stdout;
    assert!(check.contains("the same to the last digit"), "{check}");
    // In between what is computed again is within the errors.
    folder.done("table check whole.nc --cells 2 --temperature 610");
    let table = Table::read(&folder.path("whole.nc")).unwrap();
    let between = table.at(610.0).unwrap();
    for i in 0..2 {
        let mu = between.cell(i, 0).unwrap()[Quantity::Mu];
        let ends = [1, 2].map(|member| table.slices()[member].cell(i, 0).unwrap()[Quantity::Mu]);
        // And these are not much larger than those of the runs.
        assert!(mu.error < 1.5 * ends[0].error.max(ends[1].error), "{mu:?} {ends:?}");
    }
}
