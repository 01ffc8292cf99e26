//! Adhesion of a sphere on a flat, which the models leave out: load and distance below which it governs the contact.
//!
//! B. V. Derjaguin, V. M. Muller & Yu. P. Toporov, J. Colloid Interface Sci. 53, 314 (1975), doi 10.1016/0021-9797(75)90018-1:
//! pull-off force 2πwR; K. L. Johnson, K. Kendall & A. D. Roberts, Proc. R. Soc. A 324, 301 (1971), doi 10.1098/rspa.1971.0141:
//! three quarters of that.

use std::f64::consts::PI;

/// Energy of adhesion of contaminated metals, J/m²; of clean ones it is of the order of 1.
pub const CONTAMINATED_METALS: f64 = 0.05;

/// Distance between atoms of metals, m.
pub const ATOMIC_SPACING: f64 = 0.3e-9;

/// 2πwR, N: tensile force that separates a sphere of `radius` R (m) from a flat, by the `energy` of adhesion w (J/m²).
///
/// ```
/// use tables::closed_forms::adhesion::{CONTAMINATED_METALS, pull_off_force};
///
/// assert!((pull_off_force(CONTAMINATED_METALS, 1e-6) - 0.31e-6).abs() < 0.01e-6);
/// ```
pub fn pull_off_force(energy: f64, radius: f64) -> f64 {
    2.0 * PI * energy * radius
}
