//! Friction of one asperity, from a scene file, in ten lines.
//!
//!     cargo run --release -p examples --example ten_lines

use asperity::{Unwatched, read_scene, simulate};

fn main() -> anyhow::Result<()> {
    // A coarse mesh, to be quick; without it the scene's accuracy chooses.
    let coarse = ["numerics.elements_per_radius=6", "numerics.sectors=4"].map(String::from);
    let scene = read_scene(&examples::scene("single-asperity.toml"), &coarse)?;
    let summary = simulate(&scene, &Unwatched)?.summary;
    println!("static  {:.3} ± {:.3}", summary.mu_static.value, summary.mu_static.error);
    println!("sliding {:.3} ± {:.3}", summary.mu.value, summary.mu.error);
    Ok(())
}
