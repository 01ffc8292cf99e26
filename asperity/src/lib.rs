//! Full 3-D thermomechanical simulation of one spherical asperity pressed
//! against, and slid along, a rigid flat.
//!
//! Friction is not put in: a contact point slips where its shear stress reaches the shear strength
//! of the material at its own temperature. A [`scene::Scene`] says what is simulated (read from TOML
//! by [`scene_file`]), [`simulate`] presses and slides it, an [`outcome::Outcome`] holds the histories
//! and the scalars with their errors, [`run_file`] writes them. [`mod@tabulate`] runs a grid of
//! interferences and slip rates into a [`tables::table::Table`], from which the crate `roughsurface`
//! builds rough surfaces.
//!
//! SI units and kelvin throughout; forces, areas and energies of the whole asperity. Inside, the half
//! y ≥ 0 is simulated, with lengths, stresses and temperatures made dimensionless, so that any radius
//! takes the same path through the code.
//!
//! ```text
//!        z │     flat, moves along +x ──►
//!   ═══════╪═══════════════════   z = R − ω
//!        ╭─┴─╮                    pressed: ω from 0 to ω₀
//!      ╱   │   ╲                  slid: slip s = V t
//!     │    │    │
//!   ──┴────┴────┴──► x            base z = 0: clamped, at the initial temperature
//! ```
//!
//! Not modelled: a rough, deformable or heated flat, adhesion, strain rates, neighbouring asperities.

#[doc(hidden)]
pub mod benchmark;
mod body;
mod conduction;
mod contact;
mod contact_edge;
pub mod convergence;
mod curve;
mod elastic;
mod element;
mod error_budget;
#[cfg(test)]
mod fake;
pub mod figures;
pub mod fracture;
pub mod hard_cases;
mod harmonic;
pub mod honesty;
mod kinematics;
mod lanes;
mod material;
mod mechanics;
mod mesh;
pub mod numbers;
pub mod outcome;
mod preconditioner;
pub mod presets;
mod press;
mod problem;
pub mod provenance;
pub mod quantities;
mod resolution;
pub mod run_file;
mod scalars;
pub mod scene;
pub mod scene_file;
mod sectors;
pub mod simulate;
mod slide;
mod summary;
pub mod tabulate;
pub mod timings;
pub mod verification;
