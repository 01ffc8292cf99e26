use super::*;
use crate::integral::test_laws::{PowerLaw, asperity};

/// Friction of a contact of unit interference over that of the law without a history, averaged over `diameters`.
fn aged(history: fn(f64, f64, f64) -> f64, diameters: f64) -> Estimate {
    let law = PowerLaw { history, ..PowerLaw::hertz() };
    let found = asperity(&law).of_all_ages(ContactLife::Diameters(diameters)).response(1.0).unwrap();
    assert!((found.load.value / law.load.0 - 1.0).abs() < 1e-14);
    found.friction.scaled(1.0 / law.friction.0)
}

#[test]
fn a_known_history_has_its_mean_over_age() {
    // x = s/a: ∫₀^{2L} (0.4 + 0.3 e^{−x}) dx/2L, and of 0.6 − 0.1√x.
    for life in [0.01, 0.5, 1.0, 4.0f64] {
        let exponential = 0.4 + 0.3 * -(-2.0 * life).exp_m1() / (2.0 * life);
        let found = aged(|_, slip, radius| 0.4 + 0.3 * (-slip / radius).exp(), life);
        assert!((found.value - exponential).abs() < 1e-9, "{life}: {found:?} {exponential}");
        let root = 0.6 - 0.1 * 2.0 / 3.0 * (2.0 * life).sqrt();
        let found = aged(|_, slip, radius| 0.6 - 0.1 * (slip / radius).sqrt(), life);
        assert!((found.value - root).abs() < 1e-9 && found.error < 1e-6, "{life}: {found:?} {root}");
    }
}

#[test]
fn errors_of_all_ages_are_those_of_the_law() {
    // Independent errors of 1 % of load and friction at every age.
    let law = PowerLaw { relative_error: 0.01, ..PowerLaw::hertz() };
    let mean = asperity(&law).of_all_ages(ContactLife::Diameters(1.0)).response(2.0).unwrap();
    assert!((mean.coefficient_error - 0.02).abs() < 1e-12, "{mean:?}");
    assert!((mean.friction.error / mean.friction.value - 0.01).abs() < 1e-12, "{mean:?}");
}

#[test]
fn contacts_older_than_the_histories_have_steady_friction() {
    let history = |_: f64, slip: f64, radius: f64| 0.2 + 0.4 * (-slip / radius).exp();
    let steady = Some(Estimate { value: 0.02, error: 0.001 });
    let law = PowerLaw { history, last_slip: 2.0, steady, ..PowerLaw::hertz() };
    let response = |life| asperity(&law).of_all_ages(life).response(1.0).unwrap();
    // P = 1 mN at ω_c.
    let lasting = response(ContactLife::Steady);
    assert!((lasting.friction.value - 2e-5).abs() < 1e-19, "{lasting:?}");
    assert!((lasting.coefficient_error - 0.05).abs() < 1e-12, "{lasting:?}");
    // A life of 8 a: a quarter of the ages within the histories, and the end of these has the weight 2/3 in the rest.
    let (young, mean) = (response(ContactLife::Diameters(1.0)), response(ContactLife::Diameters(4.0)));
    let last = 1e-4 * (0.2 + 0.4 * f64::exp(-2.0));
    let exact = 0.25 * young.friction.value + 0.75 * (2.0 * last + 2e-5) / 3.0;
    assert!((mean.friction.value - exact).abs() < 1e-12 * exact, "{mean:?} {exact}");

    let unsteady = |law: &PowerLaw, life| {
        let asperity = asperity(law).of_all_ages(life).with(Additional::UnsteadyLoad);
        let load = asperity.additional(1.0, &asperity.response(1.0).unwrap()).unwrap().value;
        (load / 1e-3, asperity.has_friction_of_all_ages())
    };
    let uncertain = PowerLaw { steady: steady.map(|mu| Estimate { error: 0.01, ..mu }), ..law.clone() };
    let silent = PowerLaw { steady: None, ..law.clone() };
    for (law, life, share, known) in [
        (&law, 4.0, 0.0, true),
        (&uncertain, 4.0, 0.75, true),
        (&silent, 4.0, 0.75, false),
        (&silent, 1.0, 0.0, true),
    ] {
        assert_eq!(unsteady(law, ContactLife::Diameters(life)), (share, known));
    }
    assert_eq!(unsteady(&silent, ContactLife::Steady), (1.0, false));
}

/// μ = 0.02 + 0.4/√(s/a) to any age, and as a history that ends at 2 a with its steady value.
#[test]
fn friction_beyond_the_histories_approaches_its_steady_value() {
    let history = |_: f64, slip: f64, radius: f64| 0.02 + 0.4 / (slip / radius).sqrt();
    let whole = PowerLaw { history, ..PowerLaw::hertz() };
    let steady = Some(Estimate::exact(0.02 * whole.friction.0 / whole.load.0));
    let short = PowerLaw { last_slip: 2.0, steady, ..whole.clone() };
    for diameters in [1.5, 4.0, 20.0] {
        let of = |law| asperity(law).of_all_ages(ContactLife::Diameters(diameters)).response(1.0).unwrap();
        let (whole, short) = (of(&whole), of(&short));
        let difference = (whole.friction.value - short.friction.value).abs();
        assert!(difference < 3e-3 * whole.friction.value, "{diameters}: {short:?} {whole:?}");
        assert!(short.coefficient_error > whole.coefficient_error, "{diameters}: {short:?}");
    }
}

#[test]
fn a_step_of_the_history_counts_by_the_share_of_its_ages() {
    // Full friction over the first half of the slip, half of it later: the step lies between two of 21 points.
    let found = aged(|_, slip, radius| if slip < radius { 1.0 } else { 0.5 }, 1.0);
    assert!((found.value - 0.75).abs() <= found.error && found.error < 0.1, "{found:?}");
}

#[test]
fn short_lives_have_early_friction_and_long_ones_late_friction() {
    let history = |_: f64, slip: f64, radius: f64| 0.2 + 0.4 * (-slip / radius).exp();
    assert!((aged(history, 1e-6).value - 0.6).abs() < 1e-5);
    assert!((aged(history, 1e4).value - 0.2).abs() < 1e-3);
}
