//! Finite surfaces against the integral over the distribution of their heights.

use super::*;
use crate::integral::law_source::LawSource;
use crate::integral::test_laws::{PowerLaw, STEEL, query, surface};
use crate::sampling::scatter::Scatter;
use crate::surface::heights::{Empirical, Exponential, Gaussian};
use crate::surface::query::ContactLife;
use crate::surface::radii::Radii;
use tables::closed_forms::closed_form;
use tables::law::Estimate;

/// Of a quantity under one pressure or separation; there is one slip rate.
fn scatter(samples: &Samples, row: usize, of: impl Fn(&SampledState) -> f64) -> Scatter {
    Scatter::of(samples.states[row].iter().map(of))
}

fn sampled(law: &dyn AsperityLaw, surface: &Surface, query: &Query, sampling: &Sampling) -> Samples {
    sample(law, surface, query, sampling, &Settings::default(), &|_, _| ()).unwrap()
}

fn samples(asperities: usize) -> Samples {
    let law = PowerLaw::hertz();
    let surface = surface(Exponential::new(1e-6));
    let query = query(NormalLoading::Pressure(vec![1e6, 1e8]));
    let sampling = Sampling { asperities, realizations: 300, seed: 7, slip: Some(1.0) };
    sampled(&law, &surface, &query, &sampling)
}

#[test]
fn large_surfaces_approach_the_integral_and_small_ones_scatter() {
    // A quarter of the summits touch. Exponential heights: μ = Q₀ (σ/ω_c) / (P₀ Γ(5/2) (σ/ω_c)^{3/2}) at any load.
    let exact = 1e-4 / (1e-3 * libm::tgamma(2.5) * 10f64.sqrt());
    let (small, large) = (samples(50), samples(2000));
    let mu = scatter(&large, 1, |one| one.state.mu.value);
    for samples in [&small, &large] {
        let infinite = samples.infinite[1].expect("there is an equilibrium").state.mu.value;
        assert!((infinite / exact - 1.0).abs() < 1e-4, "{infinite} {exact}");
    }
    // A ratio of sums is biased by the order of 1/n, 0.1 % here, on top of the scatter.
    assert!((mu.mean - exact).abs() < 2.0 * mu.mean_error + 2e-3 * exact, "{mu:?} {exact}");
    let scattered = scatter(&small, 1, |one| one.state.mu.value);
    // Scatter falls as 1/√n: by 6.3 from 50 to 2000, give or take its own uncertainty.
    let ratio = scattered.standard_deviation / mu.standard_deviation;
    assert!(ratio > 4.0 && ratio < 10.0, "{ratio}");
    assert!(scattered.lower < exact && exact < scattered.upper);
}

/// Name, value of the integral, and value of a drawn surface.
type Expected = (&'static str, f64, fn(&SampledState) -> f64);

#[test]
fn finite_surfaces_agree_with_the_integral_within_their_confidence_intervals() {
    // At constant separation pressure, friction stress, area and number are means over the
    // asperities: their averages over surfaces of any size are those of the integral.
    let law = closed_form("jackson-green", &STEEL).unwrap();
    for radii in [Radii::from(1e-4), Radii::counted(&[3e-5, 1e-4, 2e-4], &[1.0, 2.0, 1.0]).unwrap()] {
        let surface = Surface {
            asperity_density: 1e10,
            asperity_radius: radii,
            heights: Box::new(Gaussian::new(0.3e-6)),
        };
        let query = query(NormalLoading::Separation(vec![0.0, 0.5e-6]));
        let sampling = Sampling { asperities: 500, realizations: 400, seed: 11, slip: Some(1e-8) };
        let samples = sampled(law.as_ref(), &surface, &query, &sampling);
        let asperities = Asperities::new(law.as_ref(), &surface, 1.0).unwrap().map(|one| one.after(1e-8));
        let mut integral = SurfaceIntegral::new(&asperities, surface.heights.as_ref(), 1e10, 1e-9);
        for (row, &separation) in query.loading.values().iter().enumerate() {
            let state = integral.at(separation).unwrap();
            let expected: [Expected; 4] = [
                ("pressure", state.pressure.value, |one| one.state.pressure.value),
                ("friction stress", state.shear.value, |one| one.state.shear.value),
                ("area", state.area_fraction.value, |one| one.state.area_fraction.value),
                ("contacts", state.contact_density / 1e10 * 500.0, |one| one.contacts),
            ];
            for (name, exact, of) in expected {
                let scatter = scatter(&samples, row, of);
                // The intervals hold 95 %: of sixteen, none is expected beyond 1.5 times one.
                let off = (scatter.mean - exact).abs() / scatter.mean_error;
                assert!(off < 1.5, "{name} at {separation:e}: {off} intervals");
                // The scatter is small enough for a meaningful comparison.
                assert!(scatter.mean_error < 0.1 * exact, "{name}");
            }
        }
    }
}

/// As draws of two heights from two often are.
#[test]
fn surfaces_whose_summits_are_of_one_height_slide() {
    let surface = surface(Empirical::new(vec![0.0, 1e-7]).unwrap());
    let query = query(NormalLoading::Pressure(vec![1e6]));
    let sampling = Sampling { asperities: 2, realizations: 20, seed: 3, slip: Some(1.0) };
    let law = PowerLaw::hertz();
    let found = sampled(&law, &surface, &query, &sampling);
    let contacts: Vec<f64> = found.states[0].iter().map(|one| one.contacts).collect();
    assert!(contacts.contains(&2.0), "{contacts:?}");
    assert!(found.states[0].iter().all(|one| one.state.mu.value > 0.0));
}

#[test]
fn samples_that_rest_on_unsteady_friction_say_so() {
    let surface = surface(Exponential::new(1e-6));
    let query = Query { contact_life: ContactLife::Steady, ..query(NormalLoading::Pressure(vec![1e6])) };
    let sampling = Sampling { asperities: 100, realizations: 5, seed: 1, slip: None };
    for (error, said) in [(0.01, false), (0.1, true)] {
        let law =
            PowerLaw { last_slip: 20.0, steady: Some(Estimate { value: 0.4, error }), ..PowerLaw::hertz() };
        let found = sampled(&law, &surface, &query, &sampling);
        assert_eq!(found.warnings.iter().any(|one| matches!(one, Warning::Unsteady { .. })), said);
    }
}

#[test]
fn samples_of_slides_that_end_in_stick_say_so() {
    let surface = surface(Exponential::new(1e-6));
    let query = query(NormalLoading::Pressure(vec![1e6]));
    let sampling = Sampling { asperities: 100, realizations: 5, seed: 1, slip: Some(1e-3) };
    for stuck_above in [2.0, f64::INFINITY] {
        let law = PowerLaw { last_slip: 0.01, stuck_above, ..PowerLaw::hertz() };
        let found = sampled(&law, &surface, &query, &sampling);
        let said = found.warnings.iter().any(|one| matches!(one, Warning::SamplesNotSliding { .. }));
        assert_eq!(said, stuck_above == 2.0, "{:?}", found.warnings);
    }
}

/// Intervals of groups of five surfaces against the mean of all, which is forty times as certain.
#[test]
fn intervals_hold_the_friction_of_surfaces_with_several_contacts() {
    const GROUP: usize = 5;
    const GROUPS: usize = 1600;
    let law = closed_form("jackson-green", &STEEL).unwrap();
    let surface = surface(Gaussian::new(1e-6));
    let held = |asperities: usize, pressure: f64| {
        let query = query(NormalLoading::Pressure(vec![pressure]));
        let sampling = Sampling { asperities, realizations: GROUPS * GROUP, seed: 5, slip: Some(1e-6) };
        let samples = sampled(law.as_ref(), &surface, &query, &sampling);
        let mu: Vec<f64> = samples.states[0].iter().map(|one| one.state.mu.value).collect();
        let mean = Scatter::of(mu.iter().copied()).mean;
        let groups = mu.chunks(GROUP).map(|group| Scatter::of(group.iter().copied()));
        let held = groups.filter(|group| (group.mean - mean).abs() <= group.mean_error).count();
        let said = samples.warnings.iter().any(|one| matches!(one, Warning::SamplesWithFewContacts { .. }));
        (held as f64 / GROUPS as f64, scatter(&samples, 0, |one| one.contacts).mean, said)
    };
    // The standard deviation of a share of 1600 groups is 0.007.
    let (share, contacts, said) = held(3000, 1e7);
    assert!((10.0..20.0).contains(&contacts) && (0.88..0.97).contains(&share) && !said, "{share} {contacts}");
    // Nearly all surfaces touch on one summit, with one coefficient of friction.
    let (share, contacts, said) = held(300, 1e5);
    assert!(contacts < 1.1 && share < 0.5 && said, "{share} {contacts}");
}

/// As a prediction of the same surface does: contacts that live for a millionth of a diameter stick.
#[test]
fn samples_warn_of_what_a_prediction_warns_of() {
    let surface = surface(Exponential::new(1e-7));
    let law = LawSource::open("steel-4340", None, None, false).unwrap().law;
    let life = ContactLife::Diameters(1e-6);
    let query = Query { contact_life: life, ..query(NormalLoading::Pressure(vec![1e6])) };
    for (slip, said) in [(None, true), (Some(1e-6), false)] {
        let sampling = Sampling { asperities: 3000, realizations: 3, seed: 1, slip };
        let found = sampled(law.as_ref(), &surface, &query, &sampling);
        let is_said = found.warnings.iter().any(|one| matches!(one, Warning::ShortLife { .. }));
        assert_eq!(is_said, said, "{:?}", found.warnings);
    }
}
