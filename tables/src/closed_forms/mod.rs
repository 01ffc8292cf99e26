//! Closed forms of the literature for one spherical asperity on a rigid flat.
//!
//! One module per model, with plain functions in the units of the paper; [`closed_form`]
//! wraps them as an [`AsperityLaw`](crate::law::AsperityLaw). They are the references of the
//! tests, the comparison models of `roughsurface`, and the elastic limit of a table below its first interference.
//!
//! Depends on `law`. Chapter "Rough surfaces" of the book, "Closed forms".

pub mod adhesion;
pub mod brizmer;
pub mod chang_etsion_bogy;
mod crossings;
mod elastic_plastic;
pub mod hertz;
pub mod jackson_green;
pub mod kogut_etsion;
mod model;
pub mod partial_slip;
pub mod shear_limit;

pub use elastic_plastic::{ElasticPlastic, STEEL};
pub use model::{ClosedForm, NAMES, UnknownClosedForm, closed_form};
