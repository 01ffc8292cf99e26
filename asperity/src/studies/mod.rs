//! Studies of the program: the reference suite, the robustness suite, convergence of a scene, effectivity of the error
//! estimates, repeated fits of constants, and the kernels for benchmarks.
//!
//! The studies call the public simulation; `effectivity`, `calibration` and `benchmark` also use single runs and presses of
//! the rooms below. Chapters "Verification", "Effectivity of the error estimates", "Limits" and "Speed against error" of
//! the book.

pub mod benchmark;
pub mod calibration;
pub mod convergence;
pub mod effectivity;
pub mod robustness;
pub mod verification;
