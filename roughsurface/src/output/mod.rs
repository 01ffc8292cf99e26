//! Results as files, text and pictures: friction.nc, the file of samples, figures, the HTML report,
//! the summary as text and JSON. Reads predictions, decides nothing.

pub mod figure;
pub mod friction_file;
pub mod report;
pub mod sample_file;
pub mod summary;
