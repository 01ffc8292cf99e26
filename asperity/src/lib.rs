//! Full 3-D thermomechanical simulation of one spherical asperity pressed
//! against, and slid along, a rigid flat.

mod body;
mod conduction;
mod contact;
mod elastic;
mod element;
#[cfg(test)]
mod fake;
pub mod figures;
mod harmonic;
mod lanes;
mod material;
mod mechanics;
mod mesh;
pub mod numbers;
pub mod outcome;
pub mod presets;
mod press;
mod problem;
pub mod provenance;
pub mod quantities;
mod resolution;
pub mod run_file;
pub mod scene;
pub mod scene_file;
mod sectors;
pub mod simulate;
mod slide;
mod summary;
pub mod tabulate;
