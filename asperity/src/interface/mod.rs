//! The interface between asperity and flat: unilateral normal contact, stick and slip.
//!
//! - `contact`: pressure, shear traction, slip and stiffness of each contact node;
//! - `contact_edge`: position of the contact edge between two rings of nodes;
//! - `friction_law`: limit of the shear traction, τ ≤ τ_c(p, T, ε_p).
//!
//! Depends on `crate::discretisation` and the rooms below it. Chapters "Interface" and "Contact" of the book.

pub(crate) mod contact;
pub(crate) mod contact_edge;
pub(crate) mod friction_law;
