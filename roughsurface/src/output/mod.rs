//! Results as files, text and pictures: friction.nc, the file of samples, figures, the HTML report, the
//! summary as text and JSON. Every one loops over [`QUANTITIES`](crate::friction::quantities::QUANTITIES).
//! Depends on `sampling` and `friction`; results are written unchanged.

pub mod figure;
pub mod friction_file;
mod origin;
pub mod report;
mod result_tables;
mod results;
pub mod sample_file;
pub mod summary;
pub mod summary_json;
#[cfg(test)]
mod tests;

pub use origin::Origin;
pub use results::Results;
