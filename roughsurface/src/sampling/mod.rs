//! Many surfaces in place of one: finite surfaces with heights drawn at random, and uncertain
//! parameters propagated to the friction.

pub mod finite_surface;
pub mod uncertainty;
