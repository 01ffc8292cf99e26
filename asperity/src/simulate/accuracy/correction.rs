//! Correction of discretisation errors of known sign: the slip at sliding inception, G and static friction are too small or
//! too large on average, by an amount that depends on the interference. Reported values contain it (JCGM 100:2008, 3.2.4).
//! What remains has either sign and is in the error estimates; above 300 ω_c it is larger, see the residuals of `mean_errors`.

use tables::functions::interpolate;
use tables::quantity::Quantity;

use crate::loading::inception::InceptionCriterion;
use crate::scene::FrictionLaw;
use crate::scene::fitted_constants::error_estimates::{AtEach, ELEMENTS, INTERFERENCES, ORDER};
use crate::scene::fitted_constants::mean_errors::{
    ENERGY, INCEPTION_SLIP, MeanError, SECTORS, STATIC_FRICTION,
};
use crate::simulate::accuracy::resolution::Resolution;

/// The mean error of a quantity; none of those that scatter about their limit, nor where not all of the contact slips, nor of a
/// static friction that a law in the pressure sets.
fn mean_error(quantity: Quantity, inception: InceptionCriterion, law: &FrictionLaw) -> Option<MeanError> {
    match quantity {
        _ if inception != InceptionCriterion::FullSlip => None,
        Quantity::EnergyRelease => Some(ENERGY),
        Quantity::InceptionSlip => Some(INCEPTION_SLIP),
        Quantity::MuStatic if *law == FrictionLaw::ShearStrength => Some(STATIC_FRICTION),
        _ => None,
    }
}

/// Whether the values of a quantity are corrected.
pub fn is_corrected(quantity: Quantity, inception: InceptionCriterion, law: &FrictionLaw) -> bool {
    mean_error(quantity, inception, law).is_some()
}

/// What a value of a run lacks, relative to it, at ω₀/ω_c: in the mesh by the order of convergence, on meshes coarser than
/// [`ELEMENTS`] as on these; in the angles of second order.
pub fn correction(
    quantity: Quantity,
    (inception, law): (InceptionCriterion, &FrictionLaw),
    interference: f64,
    resolution: &Resolution,
) -> f64 {
    let Some(MeanError { mesh, angles }) = mean_error(quantity, inception, law) else { return 0.0 };
    let at = |values: AtEach| interpolate(&INTERFERENCES.map(f64::ln), &values, interference.ln()).0;
    let elements = ELEMENTS.max(resolution.elements_per_radius as f64);
    let sectors = SECTORS.max(resolution.sectors as f64);
    at(mesh) * (ELEMENTS / elements).powf(ORDER) + at(angles) * (SECTORS / sectors).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Numerics;

    const FULL_SLIP: (InceptionCriterion, &FrictionLaw) =
        (InceptionCriterion::FullSlip, &FrictionLaw::ShearStrength);

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
            let found = correction(Quantity::EnergyRelease, FULL_SLIP, 1.0, &on(elements, sectors));
            assert!((found - exact).abs() < 1e-12, "{elements} {sectors}: {found}");
        }
    }

    /// Linear in the logarithm of the interference, constant beyond the data.
    #[test]
    fn corrections_follow_the_interference() {
        let at = |interference| correction(Quantity::InceptionSlip, FULL_SLIP, interference, &on(10, 1000));
        let [first, _, at_10, at_100, last] = INCEPTION_SLIP.mesh;
        let rounding = 1e-6;
        assert!((at(1000f64.sqrt()) - 0.5 * (at_10 + at_100)).abs() < rounding);
        assert!((at(2e4) - last).abs() < rounding && (at(0.01) - first).abs() < rounding);
    }

    #[test]
    fn only_values_of_full_mobilisation_are_corrected() {
        let of = |quantity, inception| correction(quantity, (inception, FULL_SLIP.1), 30.0, &on(10, 4));
        assert!(of(Quantity::EnergyRelease, InceptionCriterion::FullSlip) > 0.01);
        for quantity in [Quantity::EnergyRelease, Quantity::MuStatic] {
            assert_eq!(of(quantity, InceptionCriterion::Stiffness), 0.0);
        }
        assert_eq!(of(Quantity::Mu, InceptionCriterion::FullSlip), 0.0);
    }

    /// Of an interface with a shear strength alone: a friction coefficient that is put in has no error of the mesh.
    #[test]
    fn static_friction_of_deep_contacts_is_corrected() {
        let of = |law, interference| {
            let inception = (InceptionCriterion::FullSlip, &law);
            correction(Quantity::MuStatic, inception, interference, &on(10, 4))
        };
        let MeanError { mesh, angles } = STATIC_FRICTION;
        for (interference, place) in [(10.0, 2), (100.0, 3), (1e4, 4)] {
            let found = of(FrictionLaw::ShearStrength, interference);
            assert!((found - mesh[place] - angles[place]).abs() < 1e-12, "{interference}: {found}");
            assert_eq!(of(FrictionLaw::Coulomb { friction: 0.2, cap: false }, interference), 0.0);
        }
        assert!(of(FrictionLaw::ShearStrength, 1e4) > 0.01);
    }
}
