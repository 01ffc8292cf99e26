pub(crate) mod contact;
pub(crate) mod contact_edge;
pub(crate) mod friction_law;
