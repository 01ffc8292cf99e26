pub(crate) mod error_budget;
pub(crate) mod modelling_error;
pub(crate) mod resolution;
