pub mod body_fields;
pub(crate) mod press;
pub(crate) mod problem;
pub(crate) mod progress;
pub mod recording;
pub(crate) mod slide;
