pub(crate) mod harmonic;
pub(crate) mod newton;
pub(crate) mod preconditioner;
pub mod timings;
