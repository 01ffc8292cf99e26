//! The structure of the source: rooms in one order, with arrows downwards only, and files of moderate length.

use tests::{files, root};

/// Rooms of each crate from the bottom up, as named in CONTRIBUTING.md: a room may use those before it.
const ROOMS: [(&str, &[&str]); 3] = [
    (
        "asperity",
        &[
            "scene",
            "material",
            "discretisation",
            "interface",
            "solver",
            "heat",
            "loading",
            "simulate",
            "output",
            "tabulate",
            "studies",
            "cli",
        ],
    ),
    (
        "tables",
        &[
            "quantity",
            "law",
            "closed_forms",
            "table",
            "interpolation",
            "refinement",
            "netcdf",
            "shipped",
            "figures",
        ],
    ),
    ("roughsurface", &["surface", "topography", "integral", "friction", "sampling", "output", "cli"]),
];
/// Entries of `src` at most, `lib.rs` among them.
const ENTRIES: [usize; 3] = [13, 10, 10];
/// Lines of a file at most.
const LINES: usize = 400;

/// First segments of the paths into the own crate that a file names, comments and documentation left out.
fn rooms_used(text: &str, library: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let mut used = Vec::new();
    for line in code {
        for prefix in ["crate::", library] {
            for (at, _) in line.match_indices(prefix) {
                if line[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_') {
                    continue;
                }
                let rest = line[at + prefix.len()..].chars();
                used.push(rest.take_while(|c| c.is_ascii_lowercase() || *c == '_').collect());
            }
        }
    }
    used
}

#[test]
fn rooms_use_only_the_rooms_below_them() {
    for (name, rooms) in ROOMS {
        let floor = |room: &str| rooms.iter().position(|known| *known == room);
        let src = root().join(name).join("src");
        for file in files(&src, ".rs") {
            let place = file.strip_prefix(&src).unwrap().iter().next().unwrap().to_str().unwrap();
            let Some(own) = floor(place.trim_end_matches(".rs")) else {
                assert!(["lib.rs", "main.rs"].contains(&place), "{name}: {place} is not among its rooms");
                continue;
            };
            let text = std::fs::read_to_string(&file).unwrap();
            for used in rooms_used(&text, &format!("{name}::")) {
                if let Some(other) = floor(&used) {
                    assert!(other <= own, "{} uses {used}, a room above it", file.display());
                }
            }
        }
    }
}

#[test]
fn folders_and_files_are_of_moderate_size() {
    for ((name, _), most) in ROOMS.into_iter().zip(ENTRIES) {
        let src = root().join(name).join("src");
        let entries = std::fs::read_dir(&src).unwrap().count();
        assert!(entries <= most, "{name}/src has {entries} entries, {most} at most");
    }
    for folder in ["asperity", "tables", "roughsurface", "tests", "examples"] {
        for file in files(&root().join(folder), ".rs") {
            let lines = std::fs::read_to_string(&file).unwrap().lines().count();
            assert!(lines <= LINES, "{} has {lines} lines, {LINES} at most", file.display());
        }
    }
}

#[test]
fn an_upward_arrow_is_found() {
    let text = "use crate::output::figures;\n/// [`crate::cli`]\nlet a = asperity::loading::press();\nmy_crate::cli();\n";
    assert_eq!(rooms_used(text, "asperity::"), ["output", "loading"]);
}
