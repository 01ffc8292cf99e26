//! Shipped tables are what the program computes: two cells of each metal, computed again.

use crate::empty_folder;

#[test]
fn cells_of_shipped_tables_are_computed_again() {
    for (seed, name) in tables::shipped::names().enumerate() {
        let line = format!("table check {name} --cells 1 --seed {seed}");
        print!("{}", empty_folder().done(&line).stdout);
    }
}

/// A place between the points of one is within the errors of what is read there.
#[test]
fn places_between_the_cells_are_computed() {
    let json = empty_folder().done("table check copper-rigid --between --cells 2 --seed 3 --json").json();
    let cells = json["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 2);
    let axes = tables::shipped::table("copper-rigid").unwrap().axes().clone();
    for cell in cells {
        let [interference, slip_rate] = ["interference", "slip_rate"].map(|key| cell[key].as_f64().unwrap());
        assert!(!axes.interference.contains(&interference) && !axes.slip_rate.contains(&slip_rate));
        let number = |side: &str, k: usize| cell["values"]["mu"][side][k].as_f64().unwrap();
        let off = (number("table", 0) - number("again", 0)).abs();
        assert!(off > 0.0 && off < number("table", 1).hypot(number("again", 1)), "{cell}");
    }
}

/// A folder that happens to have the name of a metal does not hide its table.
#[test]
fn a_folder_does_not_hide_a_shipped_table() {
    let folder = empty_folder();
    std::fs::create_dir(folder.path("steel-4340")).unwrap();
    assert!(folder.done("table info steel-4340").stdout.contains("steel-4340"));
}
