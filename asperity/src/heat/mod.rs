//! Heat: ρcθ̇ = ∇·(k∇θ) + sources.
//!
//! - `conduction`: transient conduction in the body, with heat flows at the contact that may depend on its
//!   temperature;
//! - `expected`: estimates of frictional heating.
//!
//! Depends on `crate::solver::harmonic`, `crate::discretisation` and the rooms below them. Chapter "Heat" of the
//! book.

pub(crate) mod conduction;
pub(crate) mod expected;
