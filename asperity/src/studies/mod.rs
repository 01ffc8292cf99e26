//! Studies of the program by itself: the reference suite, the robustness suite, convergence of a scene, effectivity of
//! the error estimates, repeated fits of constants, and the kernels for benchmarks.
//!
//! Callers of the simulation like any user's program; `effectivity`, `calibration` and `benchmark` also use single runs and
//! presses of the rooms below. Book: "Verification", "Errors", "Estimated and true errors", "Speed against error".

pub mod benchmark;
pub mod calibration;
pub mod convergence;
pub mod effectivity;
pub mod robustness;
pub mod verification;
