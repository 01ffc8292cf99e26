//! Files and figures of a run: `run.nc`, the figure, the body for ParaView.
//!
//! Writes the results of [`simulate`](mod@crate::simulate) without computing any; loops over the list of [`tables::quantity`]. Depends
//! on `crate::simulate` and the rooms below it. Chapters "Run: run.nc" and "Other files" of the book.

mod contact_maps;
pub mod figures;
pub mod journal_file;
pub mod provenance;
pub mod revolved;
pub mod run_file;
mod scale;
pub mod vtu;
