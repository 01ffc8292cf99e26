//! Results as files, text and figures: friction.nc, mc.nc, figures, the HTML report, the
//! summary as text and JSON. All loop over [`QUANTITIES`](crate::friction::quantities::QUANTITIES).
//! Computes no results. Depends on `sampling` and `friction`. Chapters "Friction: friction.nc" and "Other files" of the
//! book.

mod cutoffs;
pub mod export;
pub mod figure;
pub mod friction_file;
mod origin;
mod rate_laws;
mod rate_step;
pub mod report;
mod result_tables;
pub mod sample_file;
pub mod summary;
pub mod summary_json;
#[cfg(test)]
mod tests;

pub use crate::sampling::case::Results;
pub use origin::Origin;
