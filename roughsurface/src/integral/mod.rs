//! A surface at one separation and slip: the response of single asperities integrated over heights
//! and radii, p(d) = η ∫ P(z − d) φ(z) dz and likewise Q, A and G, and the separation that carries a
//! pressure. Depends on [`surface`](crate::surface) and on [`tables`].

pub mod asperity_at_slip;
pub mod contact_state;
pub mod height_integral;
pub(crate) mod kronrod;
pub mod law_source;
pub(crate) mod panels;
pub mod predictor;
pub mod separation;
pub mod surface_integral;
#[cfg(test)]
pub(crate) mod test_laws;
