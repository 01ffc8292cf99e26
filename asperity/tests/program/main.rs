//! The program from outside: exit status, messages, files, and what a crash, a signal or a full disk leave.

mod command_line;
#[cfg(target_os = "linux")]
mod faults;
mod initial_temperatures;
mod interrupt;
mod paraview;
mod shards_and_tables;
mod shipped_tables;
#[cfg(target_os = "linux")]
mod streams_and_disks;
mod threads;

use std::path::Path;

use tables::table::{Cell, Status, Table};
use tests::folder::Folder;

/// A sphere of which only the sections on loading, numerics and table are to be added.
const SPHERE: &str = "[material]\npreset = \"steel-4340\"\n[asperity]\nradius = 1e-3\n";

/// A mesh as coarse as there is, on which no accuracy is asked.
const COARSE: &str = "[numerics]\nelements_per_radius = 4\nsectors = 4\naccuracy = 0.5\n";

fn empty_folder() -> Folder {
    Folder::new(env!("CARGO_BIN_EXE_asperity"))
}

/// A folder with a file of these sections for [`SPHERE`].
fn folder_with(name: &str, sections: &str) -> Folder {
    let folder = empty_folder();
    folder.write(name, format!("{SPHERE}{sections}"));
    folder
}

/// The cells of a table at all its initial temperatures, but for the times that they took.
fn cells(table: &Path) -> Vec<Status> {
    let table = Table::read(table).unwrap();
    let of_slices = table.slices().iter().flat_map(|slice| slice.grid().map(|(i, j)| slice.status(i, j)));
    let timeless = |status: &Status| match status {
        Status::Done(cell) => Status::Done(Box::new(Cell { wall_time: 0.0, ..(**cell).clone() })),
        other => other.clone(),
    };
    of_slices.map(timeless).collect()
}
