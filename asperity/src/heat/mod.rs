//! Heat conduction, ρcθ̇ = ∇·(k∇θ) + sources, for the temperature rise θ = T − T₀ (ϑ in the book).
//!
//! - `conduction`: transient conduction in the body, with heat flows at the contact that may depend on its
//!   temperature;
//! - `counterface`: a half-space that moves past the contact and takes up heat;
//! - `properties`: specific heat and conductivity that vary with temperature;
//! - `expected`: expected temperature rise and its effect on friction, by which heat is computed or neglected.
//!
//! Depends on `crate::solver::harmonic`, `crate::discretisation` and the rooms below them. Chapters "Heat" and
//! "Conduction" of the book.

pub(crate) mod conduction;
pub(crate) mod counterface;
pub(crate) mod expected;
pub(crate) mod properties;
