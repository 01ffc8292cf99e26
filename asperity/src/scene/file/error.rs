//! Errors of a scene, a request or an override: one line each.

/// Why a scene or a request was refused; the message is one line that names the place
/// (a file or a `--set`), the key, the value and what is allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneFileError {
    /// The file is not there or is not text.
    #[error("{file}: cannot be read: {reason}")]
    Unreadable {
        /// Path as given.
        file: String,
        /// What the system said.
        reason: String,
    },
    /// The file is not TOML.
    #[error("{file}: line {line}: {}", short(.reason))]
    Syntax {
        /// Path as given.
        file: String,
        /// Counted from 1.
        line: usize,
        /// What the parser said.
        reason: String,
    },
    /// An override is not of the form `section.key=value`.
    #[error("--set {}: {}", short(.text), short(.reason))]
    Override {
        /// As given.
        text: String,
        /// What is expected.
        reason: String,
    },
    /// An unknown key or section.
    #[error("{}: unknown key {}; {hint}", short(.place), short(.key))]
    UnknownKey {
        /// File or override.
        place: String,
        /// Full path of the key.
        key: String,
        /// Nearest known key, or all of them.
        hint: String,
    },
    /// A key without a default is not given.
    #[error("{}: {key} is missing; it must be {allowed}", short(.place))]
    Missing {
        /// File or override.
        place: String,
        /// Full path of the key, or several.
        key: String,
        /// What it may be.
        allowed: String,
    },
    /// A value of the wrong type or out of range.
    #[error("{}: {} = {}: must be {allowed}", short(.place), short(.key), short(.value))]
    Invalid {
        /// File or override.
        place: String,
        /// Full path of the key.
        key: String,
        /// As given.
        value: String,
        /// What it may be.
        allowed: String,
    },
}

/// The beginning of a text that is too long for a message.
fn short(text: &str) -> String {
    const MOST: usize = 200;
    match text.char_indices().nth(MOST) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}… ({} bytes)", &text[..end], text.len()),
    }
}
