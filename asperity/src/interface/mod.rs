pub(crate) mod contact;
pub(crate) mod contact_edge;
pub mod friction_law;
