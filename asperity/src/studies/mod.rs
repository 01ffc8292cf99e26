pub mod benchmark;
pub mod convergence;
pub mod effectivity;
pub mod robustness;
pub mod verification;
