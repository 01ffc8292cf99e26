//! Predictions against closed forms: Greenwood–Williamson surfaces of power laws and elastic spheres.

mod held;
mod warnings;

use super::rate_law::NoFit;
use super::warning::Warning;
use super::*;
use crate::integral::test_laws::{PowerLaw, STEEL, query, surface};
use crate::surface::heights::{Empirical, Exponential, Gaussian, Uniform};
use crate::surface::query::{ContactLife, Interaction, LoadingControl, NormalLoading, Query, Surface};
use tables::closed_forms::{closed_form, hertz};
use tables::law::{AsperityLaw, Estimate};

fn predicted(
    law: &dyn AsperityLaw,
    surface: &Surface,
    pressures: &[f64],
    slip_rates: &[f64],
    control: LoadingControl,
) -> Result<Prediction, PredictionError> {
    let query = Query {
        slip_rates: slip_rates.to_vec(),
        control,
        // Friction without the sticking of young contacts.
        contact_life: ContactLife::Steady,
        ..query(NormalLoading::Pressure(pressures.to_vec()))
    };
    of_query(law, surface, &query)
}

fn of_query(law: &dyn AsperityLaw, surface: &Surface, query: &Query) -> Result<Prediction, PredictionError> {
    predict(law, surface, query, &Settings::default(), &|_, _| ())
}

/// Friction that weakens to half within some contact radii, as heat softens asperities.
fn weakening(load_growth: f64, relative_error: f64) -> PowerLaw {
    PowerLaw {
        history: |_, slip, radius| {
            let rise = (slip / (2e-3 * radius)).min(1.0);
            rise * (0.5 + 0.5 * (-slip / (0.02 * radius)).exp())
        },
        load_growth,
        relative_error,
        ..PowerLaw::hertz()
    }
}

#[test]
fn elastic_asperities_of_constant_strength_obey_amontons() {
    // μ = [2/(√(3π) C)]/ψ with ψ = √(σ/ω_c): 0.4039/ψ at ν = 0.3.
    let law = closed_form("hertz", &STEEL).unwrap();
    let critical = law.critical_interference(1e-4);
    let psi: f64 = 0.5;
    let surface = surface(Exponential::new(critical * psi * psi));
    let found = predicted(law.as_ref(), &surface, &[1e2, 1e3, 1e4], &[1.0], LoadingControl::Load).unwrap();
    let c = hertz::yield_coefficient(0.3);
    let exact = 2.0 / ((3.0 * std::f64::consts::PI).sqrt() * c * psi);
    for row in &found.friction {
        let mu = row[0].sliding.mu;
        assert!((mu.value - exact).abs() < 1e-6 * exact, "{} {exact}", mu.value);
        assert!((mu.value - 0.4039 / psi).abs() < 1e-4 / psi);
        assert!(mu.error < 1e-5);
        // Static friction of a surface that slowly reaches its final value is within a
        // few per cent of it.
        assert!((row[0].mu_static.value / exact - 1.0).abs() < 0.03);
        assert!(row[0].weakening_energy.value.is_nan());
    }
    // Γ(5/2, 4)/Γ(5/2) of the load is above first yield, where elastic spheres end.
    let [Warning::BeyondFormulae { share, count: 3, of: 3, without_friction: false, .. }] =
        &found.warnings[..]
    else {
        panic!("{:?}", found.warnings)
    };
    assert!((share - (1.0 - statrs::function::gamma::gamma_lr(2.5, 4.0))).abs() < 1e-6, "{share}");
    assert_eq!(found.rate_laws[0].chosen, Err(NoFit::TooFewSlipRates(3)));
}

#[test]
fn static_friction_of_the_surface_is_not_that_of_its_asperities() {
    // Each asperity slips at its own displacement and weakens to half within a few
    // contact radii: their peaks do not add up.
    let surface = surface(Gaussian::new(1e-6));
    let of = |law: PowerLaw| predicted(&law, &surface, &[1e6], &[1.0], LoadingControl::Load).unwrap();
    let (found, bound) = (of(weakening(0.0, 0.0)), of(PowerLaw::hertz()));
    let (found, bound) = (&found.friction[0][0], &bound.friction[0][0]);
    let ratio = found.mu_static.value / bound.sliding.mu.value;
    assert!(ratio < 0.97 && ratio > 0.7, "{ratio}");
    assert!((found.sliding.mu.value / bound.sliding.mu.value - 0.5).abs() < 1e-6);
    assert!(found.weakening_energy.value > 0.0);
}

/// μ of one cell with a history from 1 to 1/e within two contact radii, and the warnings.
fn of_life(contact_life: ContactLife, steady: Option<Estimate>) -> (Friction, Vec<Warning>) {
    let history = |_: f64, slip: f64, radius: f64| (-0.5 * slip / radius).exp();
    let law = PowerLaw { history, last_slip: 2.0, steady, ..PowerLaw::hertz() };
    let query = Query { contact_life, ..query(NormalLoading::Pressure(vec![1e6])) };
    let surface = surface(Gaussian::new(1e-6));
    let mut found = of_query(&law, &surface, &query).unwrap();
    (found.friction.remove(0).remove(0), found.warnings)
}

#[test]
fn sliding_friction_is_the_mean_over_the_life_of_the_contacts() {
    let steady = Some(Estimate { value: 0.03, error: 0.001 });
    let (diameter, warnings) = of_life(ContactLife::default(), steady);
    assert!(warnings.is_empty(), "{warnings:?}");
    let (young, _) = of_life(ContactLife::Diameters(1e-9), steady);
    let ratio = diameter.sliding.mu.value / young.sliding.mu.value;
    assert!((ratio - (1.0 - (-1.0f64).exp())).abs() < 1e-6, "{ratio}");
    assert!((diameter.mu_steady.value - 0.03).abs() < 1e-6, "{:?}", diameter.mu_steady);
    assert!((diameter.mu_steady.error - 0.001).abs() < 1e-6, "{:?}", diameter.mu_steady);

    let (lasting, warnings) = of_life(ContactLife::Steady, steady);
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(lasting.sliding.mu, lasting.mu_steady);
}

#[test]
fn friction_of_contacts_older_than_the_table_is_unknown_without_its_steady_friction() {
    let (diameter, warnings) = of_life(ContactLife::default(), None);
    assert!(diameter.sliding.mu.value > 0.0 && diameter.mu_steady.value.is_nan());
    assert_eq!(warnings, [Warning::NoSteadyFriction]);
    let (long, warnings) = of_life(ContactLife::Diameters(4.0), None);
    assert!(long.sliding.mu.value.is_nan() && long.mu_static.value > 0.0);
    let [Warning::Unsteady { share, known: false, .. }, Warning::NoSteadyFriction] = &warnings[..] else {
        panic!("{warnings:?}")
    };
    assert!((share - 0.75).abs() < 1e-6, "{share}");

    // A steady friction that is known to 30 % only.
    let (long, warnings) = of_life(ContactLife::Steady, Some(Estimate { value: 0.03, error: 0.009 }));
    assert!((long.sliding.mu.error - 0.009).abs() < 1e-6);
    assert!(matches!(warnings[..], [Warning::Unsteady { known: true, .. }]), "{warnings:?}");

    // One below zero, as of a table with early slides, keeps its error.
    let (below, _) = of_life(ContactLife::Steady, Some(Estimate { value: -0.03, error: 0.009 }));
    assert!((below.sliding.mu.value + 0.03).abs() < 1e-6, "{:?}", below.sliding.mu);
    assert!((below.sliding.mu.error - 0.009).abs() < 1e-6, "{:?}", below.sliding.mu);
}

#[test]
fn held_load_closes_the_gap_that_a_held_separation_keeps() {
    // The load does not change with slip here, so load and displacement control agree.
    let law = PowerLaw::hertz();
    let surface = surface(Gaussian::new(1e-6));
    let load = predicted(&law, &surface, &[1e6], &[1.0], LoadingControl::Load).unwrap();
    let separation = predicted(&law, &surface, &[1e6], &[1.0], LoadingControl::Separation).unwrap();
    let (load, separation) = (&load.friction[0][0], &separation.friction[0][0]);
    assert!((load.sliding.mu.value - separation.sliding.mu.value).abs() < 1e-6);
    assert!((separation.sliding.pressure.value - 1e6).abs() < 2.0);
    assert_eq!(load.sliding.pressure.value, 1e6);
}

#[test]
fn errors_of_the_law_reach_every_result() {
    let law = PowerLaw { relative_error: 0.02, ..PowerLaw::hertz() };
    let surface = surface(Exponential::new(1e-6));
    let found = predicted(&law, &surface, &[1e6], &[1.0], LoadingControl::Load).unwrap();
    let sliding = found.friction[0][0].sliding;
    // Q and P wrong by 2 % in opposite directions; μ does not depend on separation here.
    assert!((sliding.mu.error / sliding.mu.value - 0.04).abs() < 1e-4);
    // p falls by e per σ: 2 % of p is 2 % of σ; the area is 2 % wrong and moves 2 % with it.
    assert!((sliding.separation.error / 1e-6 - 0.02).abs() < 1e-4);
    assert!((sliding.area_fraction.error / sliding.area_fraction.value - 0.04).abs() < 1e-4);
    assert!((sliding.contact_density.error / sliding.contact_density.value - 0.02).abs() < 1e-4);
}

#[test]
fn contacts_too_large_for_their_asperities_are_refused_unless_extrapolation_is_asked() {
    let law = PowerLaw { limit: 20.0, ..PowerLaw::hertz() };
    let surface = surface(Gaussian::new(1e-6));
    let error = predicted(&law, &surface, &[1e3, 1e8], &[1.0], LoadingControl::Load).unwrap_err();
    let message = error.to_string();
    assert!(
        message.starts_with("at 1e8 Pa and 1 m/s ") && message.contains("(from 20 omega_c on)"),
        "{message}"
    );
    let query = query(NormalLoading::Separation(vec![0.0]));
    let settings = Settings { extrapolate: true, ..Settings::default() };
    let found = predict(&law, &surface, &query, &settings, &|_, _| ()).unwrap();
    let cell = &found.friction[0][0];
    assert!(cell.outside_table > 0.01);
    assert!(found.warnings[0].to_string().contains("extrapolated"), "{:?}", found.warnings);
}

/// A sample of summits in which one is far above the others.
#[test]
fn few_heights_of_a_sample_in_contact_are_named() {
    let heights = (0..40).map(|i| if i == 0 { 5e-6 } else { 1e-8 * f64::from(i) }).collect();
    let surface = surface(Empirical::new(heights).unwrap());
    let few = |separation: f64| {
        let query = query(NormalLoading::Separation(vec![separation]));
        let found = of_query(&PowerLaw::hertz(), &surface, &query).unwrap();
        matching!(found.warnings, Warning::FewContacts { count, .. } => *count).next()
    };
    assert!(few(1e-6).is_some_and(|count| (count - 1.0).abs() < 1e-9), "{:?}", few(1e-6));
    assert_eq!(few(0.0), None);
}

#[test]
fn flash_heating_of_the_asperities_is_that_of_the_surface() {
    let law = PowerLaw {
        history: |rate, _, _| 0.25 + 0.75 / (1.0 + (rate / 0.2f64).powi(8)).powf(0.125),
        ..PowerLaw::hertz()
    };
    let surface = surface(Exponential::new(1e-6));
    let rates = [0.01, 0.05, 0.2, 0.5, 2.0];
    let found = predicted(&law, &surface, &[1e6], &rates, LoadingControl::Load).unwrap();
    let fitted = found.rate_laws[0].flash_heating.unwrap();
    assert!((fitted.velocity.value - 0.2).abs() < 1e-5);
    assert!((fitted.plateau.value / fitted.mu_0.value - 0.25).abs() < 1e-5);
}

#[test]
fn rates_outside_the_table_and_empty_gaps_are_refused() {
    let law = PowerLaw::hertz();
    let surface = surface(Uniform::new(1e-6));
    let error = predicted(&law, &surface, &[1e6], &[1e3], LoadingControl::Load).unwrap_err();
    assert!(error.to_string().contains("outside the table"));
    let query = query(NormalLoading::Separation(vec![2e-6]));
    let error = of_query(&law, &surface, &query).unwrap_err();
    assert_eq!(error.to_string(), "a separation of 2e-6 m leaves no asperity in contact");
}

#[test]
fn the_mean_pressure_moves_the_plane_and_leaves_friction_at_a_pressure() {
    let law = closed_form("jackson-green", &STEEL).unwrap();
    let surface = surface(Gaussian::new(3e-8));
    let predicted = |loading: &NormalLoading, control, nominal_size: Option<f64>| {
        let interaction = nominal_size.map_or(Interaction::None, |_| Interaction::MeanPressure);
        let query = Query { control, interaction, nominal_size, ..query(loading.clone()) };
        of_query(law.as_ref(), &surface, &query).unwrap()
    };
    let cell = |prediction: &Prediction| prediction.friction[0][0].clone();
    let (size, pressure) = (1e-4, 2e7);
    let loading = NormalLoading::Pressure(vec![pressure]);
    let classical = cell(&predicted(&loading, LoadingControl::Load, None));
    let moved = cell(&predicted(&loading, LoadingControl::Load, Some(size)));
    let bits = |cell: &Friction| {
        let state = &cell.sliding;
        [state.mu, state.area_fraction, cell.mu_static].map(|estimate| estimate.value.to_bits())
    };
    assert_eq!(bits(&classical), bits(&moved));
    // 0.946 p L/E*: the potential of a uniform square.
    let displacement = 0.946_40 * pressure * size / STEEL.contact_modulus();
    assert!((moved.pressed.displacement.value / displacement - 1.0).abs() < 1e-5);
    let nearer = classical.pressed.separation.value - moved.pressed.separation.value;
    assert!((nearer / displacement - 1.0).abs() < 1e-5, "{nearer:e}");

    // The separation that was found has the pressure that was given, whatever is held.
    let loading = NormalLoading::Separation(vec![moved.pressed.separation.value]);
    let held = cell(&predicted(&loading, LoadingControl::Separation, Some(size)));
    assert!((held.pressed.pressure.value / pressure - 1.0).abs() < 1e-5);
    let alone = cell(&predicted(&loading, LoadingControl::Separation, None));
    assert!(alone.pressed.pressure.value > 1.1 * pressure);
    // A small nominal area is stiff: the classical result.
    let small = cell(&predicted(&loading, LoadingControl::Separation, Some(1e-30)));
    assert_eq!(bits(&alone), bits(&small));
    assert_eq!(alone.pressed.pressure.value.to_bits(), small.pressed.pressure.value.to_bits());
}

#[test]
fn static_friction_of_slides_that_end_in_stick_is_unknown() {
    // Friction rises with the slip to the end of the slide at a hundredth of the contact radius.
    let history = |_: f64, slip: f64, radius: f64| slip / (0.01 * radius);
    let law = PowerLaw { history, last_slip: 0.01, stuck_above: 2.0, ..PowerLaw::hertz() };
    let surface = surface(Exponential::new(1e-6));
    let of = |law: &PowerLaw| predicted(law, &surface, &[1e6], &[1.0], LoadingControl::Load).unwrap();
    let found = of(&law);
    let cell = &found.friction[0][0];
    assert!(cell.mu_static.value.is_nan() && cell.inception_slip.value.is_nan(), "{:?}", cell.mu_static);
    assert!(cell.mu_history[1].value > 0.0 && cell.mu_history.last().unwrap().value.is_nan());
    // P ∝ x^{3/2}, mean of x = ω/ω_c 10.
    let share = 1.0 - statrs::function::gamma::gamma_lr(2.5, 0.2);
    let warned = matching!(found.warnings, Warning::NotSliding { share, .. } => *share).next().unwrap();
    assert!((warned / share - 1.0).abs() < 1e-3, "{warned} {share}");
    let sliding = of(&PowerLaw { stuck_above: f64::INFINITY, ..law });
    assert!(sliding.friction[0][0].mu_static.value > 0.0);
}

#[test]
fn inception_is_as_uncertain_as_that_of_the_contacts() {
    let history = |_: f64, slip: f64, radius: f64| (slip / (2e-3 * radius)).min(1.0);
    let surface = surface(Gaussian::new(1e-6));
    for (inception_error, expected) in [(0.0, 0.02), (0.06, 0.06)] {
        let law =
            PowerLaw { history, inception: 1e-9, inception_error, relative_error: 0.01, ..PowerLaw::hertz() };
        let found = predicted(&law, &surface, &[1e6], &[1.0], LoadingControl::Load).unwrap();
        let slip = found.friction[0][0].inception_slip;
        // That of μ, 1 % of Q and of P, and of the grid of slips.
        assert!(
            slip.error >= 0.999_999 * expected * slip.value && slip.error < 0.07 * slip.value,
            "{slip:?}"
        );
    }
}

#[test]
fn results_are_unknown_only_where_their_contacts_have_none() {
    let steady = Some(Estimate { value: 0.4, error: 0.01 });
    let temperature = |interference: f64| 300.0 + 100.0 * interference;
    let law = PowerLaw { temperature, mean_rise: Some(0.5), last_slip: 20.0, steady, ..PowerLaw::hertz() };
    let law = PowerLaw { missing: (0.5, 2.0), ..law };
    // All summits are pressed by 9 to 11 ω_c, or by 0.9 to 1.1 ω_c.
    let surface = surface(Uniform::new(0.5e-7));
    let at = |separation: f64| {
        let query = query(NormalLoading::Separation(vec![separation]));
        of_query(&law, &surface, &query).map(|found| found.friction[0][0].clone())
    };
    let deep = at(-10e-7).unwrap();
    assert!((deep.mu_steady.value - 0.4).abs() < 1e-6, "{:?}", deep.mu_steady);
    let mean = deep.contacts.temperature_mean.unwrap().value;
    assert!((mean - 800.0).abs() < 10.0, "{mean}");
    assert!(at(-1e-7).is_err());
}
