//! Full 3-D thermomechanical simulation of one spherical asperity pressed
//! against, and slid along, a rigid flat.
//!
//! Friction is a result: a contact point slips where its shear stress reaches the shear strength of the material at the
//! temperature of the point. A [`scene::Scene`] is the input (read from TOML by [`scene::file`]), [`mod@simulate`] presses
//! and slides it, an [`Outcome`] contains the histories and the scalars with their errors, [`output::run_file`] writes
//! them. [`mod@tabulate`] computes a grid of interferences and slip rates as a [`tables::table::Table`], which the crate
//! `roughsurface` integrates over the summits of a rough surface.
//!
//! SI units and kelvin throughout; forces, areas and energies of the whole asperity. The half y ≥ 0 is simulated, with
//! lengths in units of R, stresses in units of σ_Y and times in units of R²/κ, so that the computation does not depend on
//! the radius. The origin of the coordinates is the apex of the undeformed sphere.
//!
//! ```text
//!        z │     flat, moves along +x ──►
//!   ═══════╪═══════════════════   z = −ω
//!        ╭─┴─╮                    pressed: ω from 0 to ω₀
//!      ╱   │   ╲                  slid: slip s = V t
//!     │    │    │
//!   ──┴────┴────┴──► x            base z = −R: clamped, at the initial temperature
//! ```
//! A minimal simulation:
//!
//! ```
//! # let text = "[material]\npreset = \"copper\"\n[asperity]\nradius = 1e-3\n\
//! #             [loading]\ninterference = 5\nslip_rate = 0\nslip_distance = 0.02\n\
//! #             [numerics]\nelements_per_radius = 4\nsectors = 4\n";
//! use tables::quantity::Quantity;
//!
//! let scene = asperity::parse_scene(text, "scene.toml", &[])?;
//! let mu = asperity::simulate(&scene, &asperity::Unwatched)?.scalars[Quantity::Mu];
//! assert!(mu.error > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A run, its file, its figure and its fields for ParaView:
//!
//! ```
//! use asperity::loading::recording::Recording;
//! use asperity::output::revolved::Extent;
//! use asperity::simulate::{Unwatched, simulate_recorded};
//! use asperity::output::{figures, provenance, run_file, vtu};
//! use asperity::scene::file::parse_scene;
//! use tables::quantity::Quantity;
//!
//! let text = r#"
//! [material]
//! preset = "steel-4340"
//! [asperity]
//! radius = 1e-3            # m
//! [loading]
//! interference = 20.0      # in units of that of first yield
//! slip_rate = 1.0          # m/s
//! slip_distance = 0.05     # in contact radii
//! [numerics]
//! elements_per_radius = 4  # very coarse
//! sectors = 4
//! "#;
//! let scene = parse_scene(text, "this example", &[])?;
//! let recording = Recording { body: true, ..Recording::default() };
//! let outcome = simulate_recorded(&scene, &recording, &Unwatched)?;
//! assert!(outcome.scalars[Quantity::MuStatic].value > 0.2 && outcome.scalars[Quantity::MuStatic].value < 0.35);
//!
//! let folder = std::env::temp_dir().join(format!("asperity-example-{}", std::process::id()));
//! std::fs::create_dir_all(&folder)?;
//! let about = run_file::About { history: provenance::history("an example"), incomplete: None };
//! run_file::write(&folder.join("run.nc"), &scene, &outcome, &about)?;
//! figures::run_figure(&scene, &outcome).save(&folder.join("run.svg"))?;
//! let collection = vtu::write(&folder, &outcome, Extent::Half)?;
//! assert!(collection.exists());
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Not modelled: a rough or plastic flat, adhesion, wear, neighbouring asperities.

mod discretisation;
mod heat;
pub mod interface;
pub mod loading;
mod material;
pub mod output;
pub mod scene;
pub mod simulate;
pub mod solver;
pub mod studies;
pub mod tabulate;

pub use scene::Scene;
pub use scene::file::{parse_scene, read_scene};
pub use simulate::outcome::Outcome;
pub use simulate::{Unwatched, simulate};
pub use tables::quantity::Quantity;
