//! Equilibrium of body and contact.
//!
//! - `harmonic`: Cholesky factors of axisymmetric operators, harmonic by harmonic, with the Schur complement of
//!   the contact; triangular sweeps; also the direct solver of heat conduction;
//! - `preconditioner`: the elastic body with the contact stiffness, inverted;
//! - `newton`: Newton's method with line search, conjugate gradients for its linear systems;
//! - `timings`: time by kernel.
//!
//! Depends on `crate::interface`, `crate::discretisation` and the rooms below them. Chapters "Equilibrium" and
//! "Harmonic solver" of the book.

pub(crate) mod harmonic;
pub(crate) mod newton;
pub(crate) mod preconditioner;
pub mod timings;

/// Whether the computation is to end. Evaluated in every loop whose single pass takes less than a second, in
/// parallel.
pub type StopRequest<'a> = dyn Fn() -> bool + Sync + 'a;
