//! Friction of one asperity, from a scene file, in ten lines.
//!
//!     cargo run --release -p examples --example ten_lines

use asperity::{Unwatched, read_scene, simulate};
use tables::quantity::Quantity;

fn main() -> anyhow::Result<()> {
    // A coarse mesh, to be quick; without it the scene's accuracy chooses.
    let coarse = ["numerics.elements_per_radius=6", "numerics.sectors=4"].map(String::from);
    let scene = read_scene(&examples::scene("single-asperity.toml"), &coarse)?;
    let scalars = simulate(&scene, &Unwatched)?.scalars;
    println!("static  {:.3} ± {:.3}", scalars[Quantity::MuStatic].value, scalars[Quantity::MuStatic].error);
    println!("sliding {:.3} ± {:.3}", scalars[Quantity::Mu].value, scalars[Quantity::Mu].error);
    Ok(())
}
