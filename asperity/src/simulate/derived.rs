//! Scalars of a run that follow from others.

use std::f64::consts::PI;

use tables::closed_forms::partial_slip;
use tables::quantity::{Estimate, Quantity};

use crate::loading::inception::InceptionCriterion;
use crate::scene::{Material, Scene};
use crate::simulate::fracture::fracture_energy;
use crate::simulate::outcome::Outcome;

/// Name, unit, long name and value.
pub type Derived = (&'static str, &'static str, &'static str, Estimate);

/// The scalars of the list, then those that follow from them.
pub fn all_scalars(scene: &Scene, outcome: &Outcome) -> impl Iterator<Item = Derived> {
    let of_list = outcome.scalars.iter().map(|(quantity, estimate)| {
        let entry = quantity.descriptor();
        (entry.name, entry.units, entry.long_name, estimate)
    });
    of_list.chain(of_run(scene, outcome))
}

/// G_IIc and G/G_IIc, the relative time of sliding inception of a slide with friction, and the highest temperature of a
/// counterface that conducts.
pub fn of_run(scene: &Scene, outcome: &Outcome) -> Vec<Derived> {
    let of = |quantity| outcome.scalars[quantity];
    let mut derived = Vec::new();
    let law = fracture_energy(&scene.material);
    let name = match (&scene.material.fracture, law.radius_exponent) {
        (Some(_), 0) => "shear fracture energy of the material",
        (Some(_), _) => "shear fracture energy estimated from the tensile test at the contact radius",
        (None, _) => "shear fracture energy estimated from the hardening at the contact radius",
    };
    let (energy, radius) = (of(Quantity::EnergyRelease), of(Quantity::ContactRadius));
    let ratio = law.ratio(energy, radius);
    derived.push(("G_IIc", "J m-2", name, law.at(radius)));
    derived.push(("G_ratio", "1", "energy released over the shear fracture energy, G/G_IIc", ratio));
    let slip_rate = scene.loading.first_slip_rate();
    let time = inception_time(scene, slip_rate, of(Quantity::FrictionStatic), of(Quantity::ContactRadius));
    let time = time.filter(|_| outcome.inception != InceptionCriterion::None);
    let name = "time of sliding inception over that of a shear wave across the contact radius";
    derived.extend(time.map(|time| ("inception_time", "1", name, time)));
    let name = "highest temperature of the counterface within the contact at the end of the slide";
    let highest = counterface_temperature(scene, outcome);
    derived.extend(highest.map(|highest| ("temperature_max_counterface", "K", name, highest)));
    derived
}

/// Highest temperature of the surface of a conducting counterface within the contact at the end of the slide, K. Its error is
/// that of the mean rise and the difference from the highest of the asperity then: without a resistance between them both are
/// the same, with one it is too large. None without heat or contact.
fn counterface_temperature(scene: &Scene, outcome: &Outcome) -> Option<Estimate> {
    let value = scene.loading.temperature + outcome.counterface_rise?;
    let asperity = outcome.slide.last(Quantity::TemperatureMax)?;
    let of_mean = outcome.scalars[Quantity::TemperatureMean].error;
    Some(Estimate { value, error: (value - asperity).hypot(of_mean) })
}

/// Time of sliding inception at `slip_rate` (m/s) over that of a shear wave across the contact radius, from Q at sliding
/// inception (N) and that radius (m). Without friction or at V = 0 there is none.
pub(super) fn inception_time(
    scene: &Scene,
    slip_rate: f64,
    friction: Estimate,
    contact_radius: Estimate,
) -> Option<Estimate> {
    if !(slip_rate > 0.0 && friction.value > 0.0) {
        return None;
    }
    let (radius, error) = (contact_radius.value, contact_radius.error);
    let area = Estimate { value: PI * radius * radius, error: 2.0 * PI * radius * error };
    let Material { poisson_ratio, density, .. } = scene.material;
    let youngs_modulus = scene.material.youngs_modulus.value;
    // An elastic counterface is displaced as well.
    let compliance = youngs_modulus / scene.with_combined_modulus().material.youngs_modulus.value;
    let time = partial_slip::inception_time(youngs_modulus, poisson_ratio, density);
    Some(friction.over(area).scaled(compliance * time / slip_rate))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::FractureData;
    use crate::simulate::fake;

    /// Worked by hand: K_IIc = 50 MPa√m, E = 205 GPa, ν = 0.29 give 11.17 kJ/m²; σ_u = 1000 MPa,
    /// ε_u = 0.1 and a = 20 µm give π·(1.1e9)²·2e-5/205e9 = 370.9 J/m².
    #[test]
    fn recipes_give_the_numbers_worked_by_hand() {
        let mut scene = fake::scene(4.0, 1.0);
        let outcome = fake::outcome(&scene);
        let radius = outcome.scalars[Quantity::ContactRadius];
        assert!((radius.value - 2e-5).abs() < 1e-18);
        let mut energy = |data| {
            scene.material.fracture = Some(data);
            let derived = of_run(&scene, &outcome);
            let (critical, ratio) = (derived[0].3, derived[1].3);
            let exact = outcome.scalars[Quantity::EnergyRelease].value / critical.value;
            assert!((ratio.value / exact - 1.0).abs() < 1e-14);
            (critical.value, ratio.error / ratio.value)
        };
        // The fake's errors are 1 % of each value.
        let (given, error) = energy(FractureData::Energy { shear_fracture_energy: 500.0 });
        assert!(given == 500.0 && (error - 0.01).abs() < 1e-12);
        let (toughness, _) = energy(FractureData::Toughness { fracture_toughness_mode_ii: 50e6 });
        assert!((toughness / 11169.5 - 1.0).abs() < 1e-5, "{toughness}");
        let (tensile, error) =
            energy(FractureData::Tensile { tensile_strength: 1e9, uniform_elongation: 0.1 });
        assert!((tensile / 370.86 - 1.0).abs() < 1e-4, "{tensile}");
        assert!((error - 0.02).abs() < 1e-12);
    }

    /// Also where the contact does not warm.
    #[test]
    fn an_unknown_error_of_the_contact_is_one_of_the_counterface() {
        let scene = fake::scene(4.0, 1.0);
        let mut outcome = fake::outcome(&scene);
        outcome.counterface_rise = Some(5.0);
        for rise in [0.0, 3.0] {
            let value = scene.loading.temperature + rise;
            outcome.scalars[Quantity::TemperatureMean] = Estimate { value, error: f64::NAN };
            let highest = counterface_temperature(&scene, &outcome).unwrap();
            assert!(highest.value.is_finite() && highest.error.is_nan(), "{highest:?}");
        }
    }

    /// Worked by hand: E = 120 GPa, ν = 0.3 and 9000 kg/m³ give G = 46.154 GPa and c_s = 2264.55 m/s; 50 MPa on a radius of
    /// 10 µm is a force of 15.708 mN; 0.85·5e7/(9000·2264.55·10) = 0.208528.
    #[test]
    fn the_time_of_inception_is_the_one_worked_by_hand() {
        let mut scene = fake::scene(4.0, 10.0);
        scene.material.youngs_modulus = 120e9.into();
        scene.material.poisson_ratio = 0.3;
        scene.material.density = 9000.0;
        let friction = Estimate::exact(PI * 1e-10 * 5e7);
        let radius = Estimate { value: 1e-5, error: 1e-7 };
        let found = inception_time(&scene, 10.0, friction, radius).unwrap();
        assert!((found.value - 0.208528).abs() < 1e-6, "{found:?}");
        assert!((found.error / found.value - 0.02).abs() < 1e-12, "{found:?}");
        assert_eq!(inception_time(&scene, 10.0, Estimate::default(), radius), None);
        assert_eq!(inception_time(&scene, 0.0, friction, radius), None);
    }
}
