//! Correction of discretisation errors of known sign: the slip at sliding inception, G and static friction are too small or
//! too large on average, by an amount that depends on the interference. Reported values contain it (JCGM 100:2008, 3.2.4); what remains
//! has either sign and is in the error estimates.

use tables::functions::interpolate;
use tables::quantity::Quantity;

use crate::loading::inception::InceptionCriterion;
use crate::scene::fitted_constants::error_estimates::{AtEach, ELEMENTS, INTERFERENCES, ORDER};
use crate::scene::fitted_constants::mean_errors::{
    ENERGY, INCEPTION_SLIP, MeanError, SECTORS, STATIC_FRICTION,
};
use crate::simulate::accuracy::resolution::Resolution;

/// The mean error of a quantity; none of those that scatter about their limit, nor where not all of the contact slips.
fn mean_error(quantity: Quantity, inception: InceptionCriterion) -> Option<MeanError> {
    match (inception, quantity) {
        (InceptionCriterion::FullSlip, Quantity::EnergyRelease) => Some(ENERGY),
        (InceptionCriterion::FullSlip, Quantity::InceptionSlip) => Some(INCEPTION_SLIP),
        (InceptionCriterion::FullSlip, Quantity::MuStatic) => Some(STATIC_FRICTION),
        _ => None,
    }
}

/// Whether the values of a quantity are corrected.
pub fn is_corrected(quantity: Quantity, inception: InceptionCriterion) -> bool {
    mean_error(quantity, inception).is_some()
}

/// What a value of a run lacks, relative to it, at ω₀/ω_c: in the mesh by the order of convergence, on meshes coarser than
/// [`ELEMENTS`] as on these; in the angles of second order.
pub fn correction(
    quantity: Quantity,
    inception: InceptionCriterion,
    interference: f64,
    resolution: &Resolution,
) -> f64 {
    let Some(MeanError { mesh, angles }) = mean_error(quantity, inception) else { return 0.0 };
    let at = |values: AtEach| interpolate(&INTERFERENCES.map(f64::ln), &values, interference.ln()).0;
    let elements = ELEMENTS.max(resolution.elements_per_radius as f64);
    let sectors = SECTORS.max(resolution.sectors as f64);
    at(mesh) * (ELEMENTS / elements).powf(ORDER) + at(angles) * (SECTORS / sectors).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Numerics;

    fn on(elements: usize, sectors: usize) -> Resolution {
        let (elements_per_radius, sectors) = (Some(elements), Some(sectors));
        Resolution::choose(&Numerics { accuracy: 0.02, elements_per_radius, sectors })
    }

    #[test]
    fn corrections_vanish_by_the_orders_of_convergence() {
        let [mesh, angles] = [ENERGY.mesh[1], ENERGY.angles[1]];
        for (elements, sectors, exact) in [
            (10, 4, mesh + angles),
            (6, 4, mesh + angles),
            (40, 4, mesh / 8.0 + angles),
            (10, 8, mesh + angles / 4.0),
        ] {
            let found = correction(
                Quantity::EnergyRelease,
                InceptionCriterion::FullSlip,
                1.0,
                &on(elements, sectors),
            );
            assert!((found - exact).abs() < 1e-12, "{elements} {sectors}: {found}");
        }
    }

    /// Linear in the logarithm of the interference, constant beyond the data.
    #[test]
    fn corrections_follow_the_interference() {
        let at = |interference| {
            correction(Quantity::InceptionSlip, InceptionCriterion::FullSlip, interference, &on(10, 1000))
        };
        let [first, _, at_10, at_100, last] = INCEPTION_SLIP.mesh;
        let rounding = 1e-6;
        assert!((at(1000f64.sqrt()) - 0.5 * (at_10 + at_100)).abs() < rounding);
        assert!((at(2e4) - last).abs() < rounding && (at(0.01) - first).abs() < rounding);
    }

    #[test]
    fn only_values_of_full_mobilisation_are_corrected() {
        let of = |quantity, inception| correction(quantity, inception, 30.0, &on(10, 4));
        assert!(of(Quantity::EnergyRelease, InceptionCriterion::FullSlip) > 0.01);
        for quantity in [Quantity::EnergyRelease, Quantity::MuStatic] {
            assert_eq!(of(quantity, InceptionCriterion::Stiffness), 0.0);
        }
        assert_eq!(of(Quantity::Mu, InceptionCriterion::FullSlip), 0.0);
    }
}
