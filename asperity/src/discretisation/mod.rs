//! The discrete body: mesh of the meridian half-plane, collocation in θ, ring elements, and the internal
//! forces, tangent and energies of the elastic-plastic body at small and at finite strain.
//!
//! - `mesh`: graded quadrilaterals of the meridian; `collocation`: values and derivatives at N_θ angles;
//! - `element`: strains and forces of a ring element with mean dilatation (B̄); `elastic`: its stiffness;
//! - `body`: history at the Gauss points, ∫Bᵀσ dV, its derivative, energies, means at nodes and surface;
//! - `runs`: vectors restricted to a part of the body; `threads`: when loops over the body are divided among threads.
//!
//! Depends on `crate::material` and `crate::scene` alone. Chapters "Mesh and elements" and "Integration of plastic
//! flow" of the book.

pub(crate) mod body;
pub(crate) mod collocation;
pub(crate) mod elastic;
pub(crate) mod element;
pub(crate) mod mesh;
pub(crate) mod runs;
pub(crate) mod threads;
