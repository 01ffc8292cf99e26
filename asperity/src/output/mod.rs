//! Files and figures of a run: `run.nc`, the figure, the body for ParaView, numbers as text and JSON.
//!
//! Writes outcomes without changing them; loops over the list of [`tables::quantity`]. Depends on simulate
//! and the rooms below it. Book: "run.nc".

mod contact_maps;
pub mod figures;
pub mod journal_file;
pub mod numbers;
pub mod provenance;
pub mod revolved;
pub mod run_file;
mod scale;
pub mod vtu;
