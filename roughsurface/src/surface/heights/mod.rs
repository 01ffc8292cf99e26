//! Distributions of summit heights φ(z), and their catalogue.
//!
//! To add a distribution: write its file here, implement [`Heights`], name it below and add its entry to
//! [`DISTRIBUTIONS`]. The surface file, its help and its messages, the integrals and the sampling take it
//! from there; the tests in `tests.rs` require an example.
//! Depends on `crate::surface::text` for files, `messages` for errors. Chapter "Rough surfaces" of the book.

mod catalogue;
mod distribution;
mod empirical;
mod exponential;
mod gaussian;
mod histogram;
mod inverted_chi_squared;
mod lognormal;
#[cfg(test)]
mod tests;
mod text_file;
mod truncated_gaussian;
mod uniform;
mod weibull;

pub use catalogue::{DISTRIBUTIONS, Entry, HeightsKeys, build};
pub use distribution::{Heights, Random};
pub use empirical::Empirical;
pub use exponential::Exponential;
pub use gaussian::Gaussian;
pub use histogram::Histogram;
pub use inverted_chi_squared::InvertedChiSquared;
pub use lognormal::LogNormal;
pub use truncated_gaussian::TruncatedGaussian;
pub use uniform::Uniform;
pub use weibull::Weibull;
