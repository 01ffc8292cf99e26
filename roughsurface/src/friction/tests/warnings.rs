//! Limits of validity that a prediction names.

use super::*;
use crate::integral::law_source::{LawSource, SceneConstants};
use std::f64::consts::PI;
use tables::closed_forms::hertz::{contact_modulus, hertz_load};

#[test]
fn large_real_areas_are_warned_of_with_the_key_that_helps() {
    let law = closed_form("jackson-green", &STEEL).unwrap();
    let surface = surface(Gaussian::new(3e-8));
    let warned = |pressure, interaction| {
        let nominal_size = Some(1e-4);
        let query = Query { interaction, nominal_size, ..query(NormalLoading::Pressure(vec![pressure])) };
        let found = of_query(law.as_ref(), &surface, &query).unwrap();
        let area = found.friction[0][0].sliding.area_fraction.value;
        let named = |warning: &Warning| match warning {
            Warning::AsperitiesInteract { .. } => "interact",
            Warning::ContactsMerge { .. } => "merge",
            _ => "",
        };
        (area, found.warnings.iter().map(named).collect::<String>())
    };
    let pressures = [1e7, 5e7, 3e8];
    let without = pressures.map(|pressure| warned(pressure, Interaction::None));
    assert!(without[0].0 < 0.05 && (0.05..0.1).contains(&without[1].0) && without[2].0 > 0.1, "{without:?}");
    assert_eq!(without.map(|found| found.1), ["", "interact", "merge"]);
    let moved = pressures.map(|pressure| warned(pressure, Interaction::MeanPressure).1);
    assert_eq!(moved, ["", "", "merge"]);
}

#[test]
fn an_interface_stronger_than_the_pressure_is_warned_of() {
    let law = closed_form("hertz", &STEEL).unwrap();
    let critical = law.critical_interference(1e-4);
    // Friction is 0.4039/ψ.
    for (psi, is_strong) in [(0.3, true), (0.5, false)] {
        let surface = surface(Exponential::new(critical * psi * psi));
        let found = predicted(law.as_ref(), &surface, &[1e3], &[1.0], LoadingControl::Load).unwrap();
        let strong = matching!(found.warnings, Warning::StrongInterface { friction, .. } => *friction).next();
        let friction = found.friction[0][0].mu_static.value;
        assert_eq!(strong, is_strong.then_some(friction));
    }
}

/// The mean load of a contact under exponential heights is (4/3) E* √R s^{3/2} Γ(5/2) at any pressure (Hertz).
#[test]
fn contacts_pressed_by_adhesion_are_warned_of() {
    let law = closed_form("hertz", &STEEL).unwrap();
    let (radius, of_gamma) = (1e-4, 0.75 * PI.sqrt());
    let pull_off = 2.0 * PI * 0.05 * radius;
    let unit = hertz_load(contact_modulus(STEEL.youngs_modulus, STEEL.poisson_ratio), radius, 1.0) * of_gamma;
    for (factor, is_warned) in [(0.99, true), (1.01, false)] {
        let surface = surface(Exponential::new((factor * pull_off / unit).powf(2.0 / 3.0)));
        let found = predicted(law.as_ref(), &surface, &[1e3], &[1.0], LoadingControl::Load).unwrap();
        let load = matching!(found.warnings, Warning::Adhesion { load, .. } => *load).next();
        assert_eq!(load.is_some(), is_warned, "{load:?}");
        assert!(load.is_none_or(|load| (load / pull_off - factor).abs() < 1e-3), "{load:?} {pull_off}");
    }
}

#[test]
fn contacts_that_hardly_slide_are_warned_of() {
    // Friction grows over 0.1 µm; contacts are some 10 µm large.
    let history = |_: f64, slip: f64, _: f64| (slip / 1e-7).min(1.0);
    let law = PowerLaw { inception: 1e-7, history, last_slip: 20.0, ..PowerLaw::hertz() };
    let surface = surface(Gaussian::new(1e-6));
    let found = |life: f64| {
        let contact_life = ContactLife::Diameters(life);
        let query = Query { contact_life, ..query(NormalLoading::Pressure(vec![1e6])) };
        of_query(&law, &surface, &query).unwrap()
    };
    let lives = |found: &Prediction| {
        let mut shares =
            matching!(found.warnings, Warning::ShortLife { life, inception, .. } => inception / life);
        (shares.next(), found.friction[0][0].sliding.mu.value)
    };
    let (none, sliding) = lives(&found(1.0));
    assert_eq!(none, None);
    let (share, mu) = lives(&found(0.002));
    assert!(share.is_some_and(|share| share > 0.2) && mu < 0.95 * sliding, "{share:?} {mu} {sliding}");
}

/// Ten contacts on a nominal area.
#[test]
fn a_small_nominal_area_with_few_contacts_is_warned_of() {
    let law = PowerLaw::hertz();
    let surface = surface(Gaussian::new(1e-6));
    let found = |side: f64| {
        let query = Query { nominal_size: Some(side), ..query(NormalLoading::Pressure(vec![1e6])) };
        let found = of_query(&law, &surface, &query).unwrap();
        let count = matching!(found.warnings, Warning::SmallArea { count, .. } => *count).next();
        (found.friction[0][0].sliding.contact_density.value * side * side, count)
    };
    let (of_a_metre, none) = found(1.0);
    let side = (10.0 / of_a_metre).sqrt();
    assert_eq!(none, None);
    assert_eq!(found(1.01 * side).1, None);
    let (count, said) = found(0.99 * side);
    assert!((said.unwrap() / count - 1.0).abs() < 1e-12, "{said:?} {count}");
}

/// The mean rise over the length that is named is a fifth of that of the contacts.
#[test]
fn a_nominal_contact_that_warms_like_its_contacts_is_warned_of() {
    let steel = LawSource::open("steel-4340", None, None, false).unwrap();
    // √(44.5·7850·475).
    let effusivity = steel.scene.effusivity.unwrap();
    assert!((effusivity / 12881.4 - 1.0).abs() < 1e-5, "{effusivity}");
    let surface = surface(Gaussian::new(1e-6));
    let found = |pressure: f64, slip_rate: f64, nominal_size| {
        let loading = NormalLoading::Pressure(vec![pressure]);
        let query = Query { slip_rates: vec![slip_rate], nominal_size, ..query(loading) };
        let settings = Settings { scene: steel.scene, ..Settings::default() };
        let found = predict(steel.law.as_ref(), &surface, &query, &settings, &|_, _| ()).unwrap();
        let length = matching!(found.warnings, Warning::NominalHeating { length, .. } => *length).next();
        let cell = &found.friction[0][0];
        let rise = cell.contacts.temperature_mean.unwrap().value - 298.0;
        // The mean over the length of the rise 2 q √(t/π)/e after the time t.
        let flux = cell.sliding.shear.value * slip_rate;
        let after = |length: f64| 2.0 * flux * (length / slip_rate / PI).sqrt() / effusivity;
        let mean = |length: f64| {
            (0..1000).map(|n| after((f64::from(n) + 0.5) / 1000.0 * length)).sum::<f64>() / 1000.0
        };
        (length, length.map(|length| mean(length) / rise), mean(0.01) / rise)
    };
    let (length, share, _) = found(2e7, 10.0, None);
    assert!(length.is_some_and(|length| length < 0.01), "{length:?}");
    assert!((share.unwrap() - 0.2).abs() < 1e-5, "{share:?}");
    let (none, _, of_a_centimetre) = found(2e6, 10.0, None);
    assert!(none.is_none() && of_a_centimetre < 0.2, "{none:?} {of_a_centimetre}");
    // A nominal area of known size.
    assert!(found(2e7, 10.0, Some(1e-6)).0.is_none());
    assert!(found(2e6, 10.0, Some(1.0)).0.is_some());
    // So slow that both rises are a few kelvin.
    assert!(found(2e6, 0.01, Some(1.0)).0.is_none());
}

#[test]
fn fast_inceptions_and_uncertain_steady_friction_draw_warnings() {
    let steady = Some(Estimate { value: 0.4, error: 0.1 });
    let law = PowerLaw { last_slip: 20.0, steady, ..PowerLaw::hertz() };
    let surface = surface(Gaussian::new(1e-6));
    let query = Query { slip_rates: vec![0.5, 1.0], ..query(NormalLoading::Pressure(vec![1e6])) };
    let scene = SceneConstants { inception_time: Some(4e-8), ..SceneConstants::default() };
    let settings = Settings { scene, ..Settings::default() };
    let found = predict(&law, &surface, &query, &settings, &|_, _| ()).unwrap();
    // A mean shear stress of 1e8 Pa: 8 at 0.5 m/s, 4 at 1 m/s.
    let fast: Vec<(f64, f64)> =
        matching!(found.warnings, Warning::FastInception { at, time } => (at.slip_rate, *time)).collect();
    assert!(fast.len() == 1 && fast[0].0 == 1.0 && (fast[0].1 - 4.0).abs() < 1e-6, "{fast:?}");
    let uncertain: Vec<f64> =
        matching!(found.warnings, Warning::SteadyUncertain { error, .. } => *error).collect();
    assert!(
        uncertain.len() == 2 && uncertain.iter().all(|error| (error - 0.25).abs() < 0.01),
        "{uncertain:?}"
    );
}
