//! Runnable examples, smallest first. Scene files are in `examples/scenes/`.
//!
//! | what | how |
//! |---|---|
//! | friction of one asperity in ten lines of Rust | `cargo run --release -p examples --example ten_lines` |
//! | one asperity, pressed and slid, from Rust | `cargo run --release -p examples --example hertz_to_slide` |
//! | friction of a Gaussian surface, from Rust | `cargo run --release -p examples --example rough_surface [table.nc]` |
//! | from elastic to plastic contact, from the shipped tables | `cargo run --release -p examples --example elastic_to_plastic [figure.svg]` |
//! | friction against the slip rate, from the shipped tables | `cargo run --release -p examples --example slip_rate_effects [figure.svg]` |
//! | a press in comparison with the fits of the literature | `cargo run --release -p examples --example press_curves [figure.svg]` |
//! | body and interface of equal strength: dependence on the mesh, and its remedies | `cargo run --release -p examples --example no_end_state [figure.svg]` |
//! | a step of the slip rate, a hold and a reversal | `cargo run --release -p examples --example rate_steps [figure.svg]` |
//! | a study of fresh and worn surfaces, from Rust | `cargo run --release -p examples --example worn_surface` |
//! | one asperity, from the command line | `asperity run examples/scenes/single-asperity.toml -o run.nc` |
//! | a brake disc, bearing steel, a granite fault | `roughsurface predict examples/scenes/brake-disc.toml --table model:jackson-green -o brake.nc` |
//! | a table in shards, with Snakemake or Slurm | `examples/snakemake/two-jobs.sh`, `slurm-array.sh` there |
//! | 3-D fields of a run, in Python | `examples/read_body.py DIR/body.pvd`, after `asperity run … --vtu DIR` |
//! | sliding friction against slip rate from a table, in Python | `examples/friction_against_rate.py table.nc figure.png` |
//! | material and roughness to friction, the main job | `examples/friction-of-steel.sh` |

use std::path::PathBuf;

/// Path of a file in `examples/scenes/`, wherever the example is started from.
pub fn scene(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "scenes", name].iter().collect()
}

/// Compiles the code of the README.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

/// Runs the code of the book's chapter on the libraries.
#[cfg(doctest)]
#[doc = include_str!("../../docs/src/library.md")]
struct Library;
