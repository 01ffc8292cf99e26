//! Where a file comes from: program, version, time and command.

/// Program and version, for the attribute `source`.
pub const SOURCE: &str = concat!("asperity ", env!("CARGO_PKG_VERSION"));

/// A line for the attribute `history`: time (UTC) and command.
pub fn history(command: &str) -> String {
    let now = chrono::Utc::now().format("%Y-%m-%dT%H:%M:%SZ");
    format!("{now}: {command}")
}
