//! Where a file comes from: program, version, time and command.

pub use tables::netcdf::history;

/// Program and version, for the attribute `source`.
pub const SOURCE: &str = concat!("asperity ", env!("CARGO_PKG_VERSION"));

/// Fingerprint of sources, dependencies, compiler and instructions of the processor, made by `build.rs`: programs with the same
/// version and fingerprint give the same numbers, others may not.
pub const FINGERPRINT: &str = env!("ASPERITY_FINGERPRINT");
