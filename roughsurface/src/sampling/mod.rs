//! Many surfaces in place of one: finite surfaces with heights drawn at random ([`finite_surface`]), and
//! uncertain parameters propagated to the friction ([`uncertainty`]). Depends on `friction`.

pub mod finite_surface;
pub mod scatter;
pub mod uncertainty;
