//! Errors of a scene, a request or an override: one line each.

/// Why a scene or a request was refused; the message is one line that names the location
/// (a file or a `--set`), the key, the value and what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneFileError {
    /// The file, by its path as given, is not there or is not text; `reason` is what the system said.
    #[error("{file}: cannot be read: {reason}")]
    Unreadable { file: String, reason: String },
    /// The file is not TOML; lines are counted from 1, `reason` is what the parser said.
    #[error("{file}: line {line}: {}", short(.reason))]
    Syntax { file: String, line: usize, reason: String },
    /// An override is not of the form `section.key=value`; `reason` is what is expected.
    #[error("--set {}: {}", short(.text), short(.reason))]
    Override { text: String, reason: String },
    /// An unknown key (full path) or section in a file or override; `hint` is the nearest known key, or all of them.
    #[error("{}: unknown key {}; {hint}", short(.location), short(.key))]
    UnknownKey { location: String, key: String, hint: String },
    /// A key without a default, or several, is not given; `allowed` is what it may be.
    #[error("{}: {key} is missing; it must be {allowed}", short(.location))]
    Missing { location: String, key: String, allowed: String },
    /// A value of the wrong type or out of range.
    #[error("{}: {} = {}: must be {allowed}", short(.location), short(.key), short(.value))]
    Invalid { location: String, key: String, value: String, allowed: String },
}

/// The beginning of a text that is too long for a message.
fn short(text: &str) -> String {
    const MOST: usize = 200;
    match text.char_indices().nth(MOST) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}… ({} bytes)", &text[..end], text.len()),
    }
}
