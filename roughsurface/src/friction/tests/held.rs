//! Rows on their own, and what is held during the slide.

use super::*;
use crate::friction::quantities::QUANTITIES;

fn held(law: &PowerLaw, loading: NormalLoading, control: LoadingControl) -> Vec<Friction> {
    let surface = surface(Gaussian::new(1e-6));
    let query = Query { control, ..query(loading) };
    of_query(law, &surface, &query).unwrap().friction.concat()
}

#[test]
fn a_pressure_has_the_same_results_whatever_others_are_asked() {
    let law = weakening(0.0, 0.01);
    for control in [LoadingControl::Load, LoadingControl::Separation] {
        let of = |pressures: &[f64]| held(&law, NormalLoading::Pressure(pressures.to_vec()), control);
        let (alone, beside) = (of(&[1e6]).remove(0), of(&[1e4, 1e6, 1e9]).remove(1));
        for quantity in &QUANTITIES {
            let [one, other] = [&alone, &beside].map(|cell| quantity.estimate(cell));
            let same = |a: f64, b: f64, off: f64| a.to_bits() == b.to_bits() || (a / b - 1.0).abs() < off;
            // The panels of an integral may have been halved for another row, and its error estimated from them.
            let agree = same(one.value, other.value, 1e-10) && same(one.error, other.error, 1e-4);
            assert!(agree, "{} {one:?} {other:?}", quantity.name);
        }
        // Histories are read at common slips, after the end of a row not at all.
        let known = beside.mu_history.iter().filter(|mu| mu.value >= 0.0).count();
        assert!(known > 100 && known < beside.mu_history.len() - 10, "{known}");
    }
}

#[test]
fn weakening_at_a_held_separation_is_that_of_the_friction_coefficient() {
    // Load and friction of each asperity double during the slide: friction stress grows while friction weakens.
    let pressure = || NormalLoading::Pressure(vec![1e6]);
    let steady = &held(&weakening(0.0, 0.0), pressure(), LoadingControl::Separation)[0];
    let growing = &held(&weakening(1.0, 0.0), pressure(), LoadingControl::Separation)[0];
    assert!((growing.sliding.pressure.value / 1e6 - 2.0).abs() < 0.2, "{:?}", growing.sliding.pressure);
    let [energy, grown] = [steady, growing].map(|cell| cell.weakening_energy.value);
    let [distance, of_growing] = [steady, growing].map(|cell| cell.weakening_distance.value);
    assert!(energy > 0.0 && (grown / energy - 1.0).abs() < 1e-6, "{energy:e} {grown:e}");
    assert!((of_growing / distance - 1.0).abs() < 1e-6);
    // Where load and separation are constant both hold the same.
    let load = &held(&weakening(0.0, 0.0), pressure(), LoadingControl::Load)[0];
    assert!((load.weakening_energy.value / energy - 1.0).abs() < 1e-4);
}

#[test]
fn the_surface_before_sliding_has_the_same_errors_whatever_is_held() {
    let law = weakening(0.3, 0.02);
    let before_sliding = |loading: &NormalLoading, control| held(&law, loading.clone(), control)[0].pressed;
    for loading in [NormalLoading::Pressure(vec![1e6]), NormalLoading::Separation(vec![2e-6])] {
        let [load, separation] = [LoadingControl::Load, LoadingControl::Separation]
            .map(|control| before_sliding(&loading, control))
            .map(|state| [state.pressure, state.separation, state.area_fraction, state.contact_density]);
        assert_eq!(load, separation);
    }
    // Of exponential heights p and A fall by e per σ: a load wrong by 2 % is a separation wrong by 2 % of σ, which moves the
    // area by 2 %. The loads before and in the slide are wrong alike.
    let surface = surface(Exponential::new(1e-6));
    let law = PowerLaw { relative_error: 0.02, ..PowerLaw::hertz() };
    let held = predicted(&law, &surface, &[1e6], &[1.0], LoadingControl::Separation).unwrap();
    let sliding = held.friction[0][0].sliding;
    let relative = |estimate: Estimate| estimate.error / estimate.value;
    assert!((sliding.separation.error / 1e-6 - 0.02).abs() < 1e-4);
    assert!((relative(sliding.area_fraction) - 0.04).abs() < 1e-4);
    assert!((relative(sliding.contact_density) - 0.02).abs() < 1e-4);
    assert!(relative(sliding.pressure) < 1e-4, "{:?}", sliding.pressure);
    // Of a given separation the pressure is uncertain instead, and with it the friction stress under that load.
    let loading = NormalLoading::Separation(vec![2e-6]);
    let query = Query { control: LoadingControl::Load, ..query(loading) };
    let cell = &of_query(&law, &surface, &query).unwrap().friction[0][0];
    assert!((relative(cell.pressed.pressure) - 0.02).abs() < 1e-4 && cell.pressed.separation.error == 0.0);
    assert!((relative(cell.sliding.pressure) - 0.02).abs() < 1e-4);
    assert!((relative(cell.sliding.shear) - relative(cell.sliding.mu) - 0.02).abs() < 1e-4);
}
