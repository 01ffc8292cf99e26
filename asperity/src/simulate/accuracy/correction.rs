//! Correction of discretisation errors of known sign: means that depend on the interference, of the slip at sliding inception
//! and G, of static friction, of load, and of area and friction of slides. Reported values and histories contain it (JCGM
//! 100:2008, 3.2.4); energies, fields, and area and radius of the pressed contact, in which slips are counted, do not. What
//! remains has either sign and is in the error estimates; above 300 ω_c that of sliding inception is larger, see the residuals
//! of `mean_errors`.

use tables::quantity::Quantity;

use crate::loading::inception::InceptionCriterion;
use crate::scene::FrictionLaw;
use crate::scene::fitted_constants::error_estimates::{AtEach, ELEMENTS, ORDER, at_interference};
use crate::scene::fitted_constants::mean_errors::{
    AREA, ENERGY, INCEPTION_SLIP, LOAD, MeanError, SECTORS, STATIC_FRICTION, at_high_peclet_number,
};
use crate::simulate::accuracy::resolution::Resolution;

/// The mean errors of a quantity, as factors with these powers. Those of load and area are of interfaces without a law in the
/// pressure, whose friction is a sum of both; that of the area is of slides under the shear strength. None of quantities that
/// scatter about their limit.
fn mean_errors(
    quantity: Quantity,
    inception: InceptionCriterion,
    law: &FrictionLaw,
) -> &'static [(MeanError, f64)] {
    use Quantity::*;
    let is_full_slip = inception == InceptionCriterion::FullSlip;
    let is_strength = law.is_strength();
    match quantity {
        EnergyRelease if is_full_slip => &[(ENERGY, 1.0)],
        InceptionSlip if is_full_slip => &[(INCEPTION_SLIP, 1.0)],
        MuStatic if is_full_slip && is_strength => &[(STATIC_FRICTION, 1.0)],
        FrictionStatic if is_full_slip && is_strength => &[(STATIC_FRICTION, 1.0), (LOAD, 1.0)],
        Load | LoadPress if !law.depends_on_pressure() => &[(LOAD, 1.0)],
        Area | Friction | FrictionStatic if is_strength => &[(AREA, 1.0)],
        Mu | MuStatic | MuMean | MuPeak | MuSteady if is_strength => &[(AREA, 1.0), (LOAD, -1.0)],
        Mu | MuStatic | MuMean | MuPeak | MuSteady if !law.depends_on_pressure() => &[(LOAD, -1.0)],
        _ => &[],
    }
}

/// The further mean errors of sliding inception at high Péclet numbers.
fn mean_error_at_high_peclet_number(
    quantity: Quantity,
    inception: InceptionCriterion,
    law: &FrictionLaw,
) -> Option<MeanError> {
    use at_high_peclet_number::{ENERGY, INCEPTION_SLIP, STATIC_FRICTION};
    let error = match quantity {
        Quantity::EnergyRelease => ENERGY,
        Quantity::InceptionSlip => INCEPTION_SLIP,
        Quantity::MuStatic | Quantity::FrictionStatic => STATIC_FRICTION,
        _ => return None,
    };
    (inception == InceptionCriterion::FullSlip && law.is_strength()).then_some(error)
}

/// Whether the values of a quantity are corrected.
pub fn is_corrected(quantity: Quantity, inception: InceptionCriterion, law: &FrictionLaw) -> bool {
    !mean_errors(quantity, inception, law).is_empty()
}

/// Factors that correct the values of a run, its scalars as its histories.
#[derive(Clone, Copy, Debug)]
pub struct Correction<'a> {
    pub inception: InceptionCriterion,
    pub law: &'a FrictionLaw,
    /// Whether the contact has slid; the area of a pressed one is that of the mesh.
    pub has_slid: bool,
    /// ω₀/ω_c.
    pub interference: f64,
    /// Va/κ of the first step, with the contact radius after the press; 0 where heat does not soften the interface.
    pub peclet: f64,
    pub resolution: Resolution,
}

impl Correction<'_> {
    /// The corrected value over that of the run.
    pub fn factor(&self, quantity: Quantity) -> f64 {
        if quantity == Quantity::Area && !self.has_slid {
            return 1.0;
        }
        let errors = mean_errors(quantity, self.inception, self.law);
        let factor: f64 =
            errors.iter().map(|(error, power)| (1.0 + self.lacks(error)).powf(*power)).product();
        match mean_error_at_high_peclet_number(quantity, self.inception, self.law) {
            Some(error) => {
                let checked = self.interference.min(at_high_peclet_number::DEEPEST);
                let lacks = Self { interference: checked, ..*self }.lacks(&error);
                factor * (1.0 + (self.peclet / at_high_peclet_number::FULL).min(1.0) * lacks)
            }
            None => factor,
        }
    }

    /// Part that a value of the run lacks, relative to it: in the mesh by the order of convergence, on meshes coarser than
    /// [`ELEMENTS`] as on these; in the angles of second order.
    fn lacks(&self, MeanError { mesh, angles }: &MeanError) -> f64 {
        let at = |values: &AtEach| at_interference(values, self.interference);
        let elements = ELEMENTS.max(self.resolution.elements_per_radius as f64);
        let sectors = SECTORS.max(self.resolution.sectors as f64);
        at(mesh) * (ELEMENTS / elements).powf(ORDER) + at(angles) * (SECTORS / sectors).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Numerics;
    use crate::scene::tests::of_preset;
    use crate::simulate::{Unwatched, press, simulate};

    use Quantity::*;

    /// At ω₀/ω_c on elements per contact radius and sectors.
    fn correction(law: &FrictionLaw, interference: f64, on: (usize, usize)) -> Correction<'_> {
        let (elements_per_radius, sectors) = (Some(on.0), Some(on.1));
        let resolution = Resolution::choose(&Numerics { accuracy: 0.02, elements_per_radius, sectors });
        let inception = InceptionCriterion::FullSlip;
        Correction { inception, law, has_slid: true, interference, peclet: 0.0, resolution }
    }

    /// Relative change of a value.
    fn change(quantity: Quantity, law: &FrictionLaw, interference: f64, on: (usize, usize)) -> f64 {
        correction(law, interference, on).factor(quantity) - 1.0
    }

    const STRENGTH: FrictionLaw = FrictionLaw::ShearStrength;
    const COULOMB: FrictionLaw = FrictionLaw::Coulomb { friction: 0.2, cap: false };
    const COARSE: (usize, usize) = (10, 4);

    #[test]
    fn corrections_vanish_by_the_orders_of_convergence() {
        let [mesh, angles] = [ENERGY.mesh[1], ENERGY.angles[1]];
        for (elements, sectors, exact) in [
            (10, 4, mesh + angles),
            (6, 4, mesh + angles),
            (40, 4, mesh / 8.0 + angles),
            (10, 8, mesh + angles / 4.0),
        ] {
            let found = change(EnergyRelease, &STRENGTH, 1.0, (elements, sectors));
            assert!((found - exact).abs() < 1e-12, "{elements} {sectors}: {found}");
        }
    }

    /// Linear in the logarithm of the interference, constant beyond the data.
    #[test]
    fn corrections_follow_the_interference() {
        let at = |interference| change(InceptionSlip, &STRENGTH, interference, (10, 1000));
        let [first, _, at_10, at_100, last] = INCEPTION_SLIP.mesh;
        let rounding = 1e-6;
        assert!((at(1000f64.sqrt()) - 0.5 * (at_10 + at_100)).abs() < rounding);
        assert!((at(2e4) - last).abs() < rounding && (at(0.01) - first).abs() < rounding);
    }

    /// Q = μP and Q_s = μ_s P hold of corrected values as of those of the run, under a law in the pressure Q = τ_0 A + αP.
    #[test]
    fn corrected_values_fit_together() {
        let full_slip = InceptionCriterion::FullSlip;
        for (law, inception) in [
            (STRENGTH, full_slip),
            (STRENGTH, InceptionCriterion::None),
            (FrictionLaw::FullStick, InceptionCriterion::Stiffness),
            (COULOMB, full_slip),
        ] {
            let correction = Correction { inception, ..correction(&law, 200.0, COARSE) };
            let of = |quantity| correction.factor(quantity);
            for (force, coefficient) in [(Friction, Mu), (FrictionStatic, MuStatic)] {
                let product = of(coefficient) * of(Load);
                assert!((of(force) / product - 1.0).abs() < 1e-14, "{law:?} {force:?}");
            }
            assert_eq!(of(Load), of(LoadPress));
            assert_eq!(of(Load) < 0.995, law != COULOMB, "{law:?}");
            let [friction, area] = [of(Friction), of(Area)];
            assert_eq!(friction, area, "{law:?}");
            // A slide without full slip has one friction coefficient at its end.
            assert!(inception == full_slip || of(MuStatic) == of(Mu));
            // The units of slip and area are those of the mesh.
            assert_eq!([of(ContactRadius), of(AreaPress)], [1.0, 1.0]);
        }
    }

    #[test]
    fn energy_and_slip_of_inception_are_corrected_at_full_mobilisation() {
        for quantity in [EnergyRelease, InceptionSlip] {
            assert!(is_corrected(quantity, InceptionCriterion::FullSlip, &STRENGTH));
            assert!(!is_corrected(quantity, InceptionCriterion::Stiffness, &STRENGTH), "{quantity:?}");
        }
    }

    /// In proportion to small Péclet numbers, and constant at large ones; nothing but sliding inception of deep contacts.
    #[test]
    fn inception_at_high_peclet_numbers_is_corrected_further() {
        let of = |quantity, interference, peclet| {
            let at = |peclet| Correction { peclet, ..correction(&STRENGTH, interference, COARSE) };
            at(peclet).factor(quantity) / at(0.0).factor(quantity) - 1.0
        };
        let exact = 0.5
            * (at_high_peclet_number::STATIC_FRICTION.mesh[4]
                + at_high_peclet_number::STATIC_FRICTION.angles[4]);
        for quantity in [MuStatic, FrictionStatic] {
            for (peclet, share) in [(50.0, 0.5), (100.0, 1.0), (1e3, 1.0)] {
                assert!(
                    (of(quantity, 1000.0, peclet) - share * exact).abs() < 1e-12,
                    "{quantity:?} {peclet}"
                );
            }
        }
        assert!(of(InceptionSlip, 1000.0, 100.0) > 0.1 && of(EnergyRelease, 1000.0, 100.0) > 0.05);
        assert_eq!(of(MuStatic, 2000.0, 100.0), of(MuStatic, 5000.0, 100.0));
        for (quantity, interference) in [(Mu, 1000.0), (Load, 1000.0), (MuStatic, 100.0)] {
            assert_eq!(of(quantity, interference, 100.0), 0.0, "{quantity:?}");
        }
    }

    /// A friction coefficient that is put in has no error of the mesh.
    #[test]
    fn friction_coefficients_of_an_interface_with_a_strength_are_corrected() {
        for quantity in [Mu, MuStatic, MuMean, MuSteady] {
            assert!(change(quantity, &STRENGTH, 200.0, COARSE) > 0.002, "{quantity:?}");
            assert_eq!(change(quantity, &COULOMB, 200.0, COARSE), 0.0, "{quantity:?}");
        }
    }

    /// Copper at 200 ω_c, whose load lacks −0.6 %.
    #[test]
    fn histories_are_corrected_as_scalars_are() {
        let elements = ["numerics.elements_per_radius=6", "numerics.sectors=4"];
        let slide = ["loading.interference=200", "loading.slip_distance=0.3"];
        let scene = of_preset("copper", &[slide, elements].concat());
        let outcome = simulate(&scene, &Unwatched).unwrap();
        // Sums over one angle and over all of them.
        let close = |found: f64, exact: f64| (found / exact - 1.0).abs() < 1e-12;
        for quantity in [Mu, Friction, Load, Area] {
            let last = outcome.slide.last(quantity).unwrap();
            assert!(close(last, outcome.scalars[quantity].value), "{quantity:?}: {last}");
        }
        for (of_press, of_slide) in [(LoadPress, Load), (AreaPress, Area)] {
            let pressed = outcome.press.last(of_press).unwrap();
            assert!(close(pressed, outcome.scalars[of_press].value), "{of_press:?}");
            assert!(close(outcome.slide.column(of_slide)[0], pressed), "{of_slide:?}");
        }
        let [mu, friction, load] = [Mu, Friction, Load].map(|quantity| outcome.scalars[quantity].value);
        assert!(close(friction / load, mu));
        let pressed = press(&scene, &Unwatched).unwrap();
        let [mesh, reported] = [pressed.contact().load.value, pressed.reported_load()];
        assert!(close(outcome.scalars[LoadPress].value, reported));
        assert!((0.992..0.995).contains(&(reported / mesh)), "{}", reported / mesh);
    }
}
