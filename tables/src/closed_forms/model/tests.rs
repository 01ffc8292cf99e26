use super::*;
use crate::closed_forms::STEEL;

fn sliding(name: &str, interference: f64) -> Response {
    let law = closed_form(name, &STEEL).unwrap();
    law.response(1e-4, interference, 1.0, 1e-3).unwrap()
}

fn friction_coefficient(name: &str, interference: f64) -> f64 {
    let state = sliding(name, interference);
    state.friction.value / state.load.value
}

#[test]
fn constant_shear_friction_of_the_elastic_sphere() {
    for omega in [0.01, 0.3, 1.0] {
        let mu = friction_coefficient("hertz", omega);
        assert!((mu * omega.sqrt() - 0.5370).abs() < 1e-4, "{omega}: {mu}");
    }
}

#[test]
fn constant_shear_friction_of_the_plastic_sphere() {
    for (omega, mu) in [(2.0, 0.397), (10.0, 0.275), (50.0, 0.228), (109.9, 0.208)] {
        let here = friction_coefficient("constant-shear", omega);
        assert!((here / mu - 1.0).abs() < 0.015, "{omega}: {here}");
    }
}

#[test]
fn heat_aside_the_models_disagree_as_published() {
    // Once it has yielded, a sphere of Chang et al. has no friction and one of Kogut &
    // Etsion little; in full stick friction exceeds the shear strength of the body.
    let at = |name| friction_coefficient(name, 5.0);
    assert_eq!(at("chang-etsion-bogy"), 0.0);
    assert!(at("kogut-etsion") < 0.2 && at("constant-shear") > 0.28);
    assert!((at("cohen") / at("brizmer") - 1.0).abs() < 0.045);
    assert!(at("cohen") > at("constant-shear"));
    // In their own units of first yield the form of Cohen et al.: 0.26 coth(0.27 ω*^0.46).
    let law = ClosedForm::new("cohen", &STEEL).unwrap();
    let own: f64 = 5.0 / law.units.0;
    assert!((at("cohen") * (0.27 * own.powf(0.46)).tanh() / 0.26 - 1.0).abs() < 1e-12);
}

#[test]
fn every_law_is_linear_elastic_at_small_interference_and_scales_with_radius() {
    for name in NAMES {
        let law = closed_form(name, &STEEL).unwrap();
        let small = law.response(1e-4, 1e-3, 1.0, 1e-3).unwrap();
        let omega = 1e-3 * law.critical_interference(1e-4);
        let hertz = hertz::hertz_load(STEEL.contact_modulus(), 1e-4, omega);
        assert!((small.load.value / hertz - 1.0).abs() < 0.03, "{name}");

        let slip = 3e-10;
        let one = law.response(1e-4, 8.0, 1.0, slip).unwrap();
        let ten = law.response(1e-3, 8.0, 1.0, 10.0 * slip).unwrap();
        for (a, b) in [(one.load, ten.load), (one.friction, ten.friction), (one.area, ten.area)] {
            assert!((100.0 * a.value - b.value).abs() <= 1e-9 * b.value, "{name}");
        }
    }
}

#[test]
fn friction_rises_with_slip_from_zero_with_the_stick_stiffness() {
    let law = closed_form("jackson-green", &STEEL).unwrap();
    let slip = 1e-13;
    let state = law.response(1e-4, 5.0, 0.0, slip).unwrap();
    let contact_radius = (state.area.value / std::f64::consts::PI).sqrt();
    let stiffness = 8.0 * STEEL.tangential_modulus() * contact_radius;
    assert!((state.friction.value / (slip * stiffness) - 1.0).abs() < 1e-4);
    let rest = law.response(1e-4, 5.0, 0.0, 0.0).unwrap();
    assert_eq!(rest.friction.value, 0.0);
}

#[test]
fn gross_slip_is_a_break() {
    for name in NAMES {
        let law = ClosedForm::new(name, &STEEL).unwrap();
        for interference in [0.02, 0.7, 30.0] {
            let sliding = law.sliding(1e-4, interference);
            if sliding.strength == 0.0 {
                continue;
            }
            let breaks = law.breaks_after(1e-4, sliding.gross_slip);
            assert!(
                breaks.iter().any(|place| (place / interference - 1.0).abs() < 1e-6),
                "{name} at {interference}: {breaks:?}"
            );
        }
    }
}

#[test]
fn nothing_without_contact() {
    for name in NAMES {
        let law = closed_form(name, &STEEL).unwrap();
        let state = law.response(1e-4, 0.0, 1.0, 0.0).unwrap();
        assert_eq!((state.load.value, state.area.value), (0.0, 0.0));
    }
}

#[test]
fn units_of_first_yield_are_those_of_the_authors() {
    // Kogut & Etsion, Chang et al.: KH with K = 0.454 + 0.41ν and H = 2.8 σ_Y.
    let ratio: f64 = 2.8 * (0.454 + 0.41 * 0.3) / hertz::yield_coefficient(0.3);
    for name in ["kogut-etsion", "constant-shear", "chang-etsion-bogy"] {
        let law = ClosedForm::new(name, &STEEL).unwrap();
        assert!((law.units.0 / ratio.powi(2) - 1.0).abs() < 1e-12, "{name}: {:?}", law.units);
    }
    // Friction of 2003 at 3 of their ω_c: −0.007·27 + 0.085·9 − 0.389·3 + 0.822.
    assert!((friction_coefficient("kogut-etsion", 3.0 * ratio.powi(2)) - 0.231).abs() < 1e-12);
}

#[test]
fn every_model_ends_where_it_was_published_and_within_the_sphere() {
    for name in NAMES {
        let law = ClosedForm::new(name, &STEEL).unwrap();
        let largest = sliding(name, law.contact_limit());
        let contact_radius = (largest.area.value / std::f64::consts::PI).sqrt();
        assert!((contact_radius / 0.4e-4 - 1.0).abs() < 1e-9, "{name}: {contact_radius:e}");
        let limit = law.interference_limit() / law.units.0;
        let expected = match name {
            "hertz" | "chang-etsion-bogy" => 1.0,
            "kogut-etsion" => 6.0,
            "brizmer" | "cohen" => 150.0,
            _ => law.contact_limit() / law.units.0,
        };
        assert!((limit / expected - 1.0).abs() < 1e-12, "{name}: {limit}");
        assert_eq!(law.above_range() == AboveRange::NoFriction, name == "kogut-etsion");
    }
}
