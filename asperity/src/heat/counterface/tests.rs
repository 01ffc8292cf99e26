//! The half-space against closed forms of disc sources, at rest and moving.

use super::*;

/// Mean rise after `fourier` = κt/a² under a uniform flux, over q a/k, at V a/(2κ) = `peclet`, in increments that grow.
fn mean_rise(peclet: f64, fourier: f64) -> f64 {
    // κ = a = k = 1.
    let mut half_space = HalfSpace::new(1.0, 1.0);
    let (mut time, mut dt) = (0.0, 1e-4 * fourier.min(1.0));
    let mut rise = 0.0;
    while time < fourier * (1.0 - 1e-12) {
        let step = dt.min(fourier - time);
        let response = half_space.step(step, 2.0 * peclet * step, 1.0);
        rise = response.free(1, 1.0) + response.own();
        half_space.try_fluxes(&response, [1.0, 1.0]);
        half_space.commit();
        time += step;
        dt *= 1.3;
    }
    rise
}

/// (2q a/k) ∫ J₁(λ)² erf(λ√Fo) dλ/λ²: Carslaw & Jaeger 1959, §10.5.
#[test]
fn stationary_disc_follows_carslaw_and_jaeger() {
    for (fourier, exact) in [
        (0.001, 0.035046),
        (0.01, 0.106480),
        (0.1, 0.293981),
        (1.0, 0.587630),
        (10.0, 0.760354),
        (100.0, 0.820640),
    ] {
        let rise = mean_rise(0.0, fourier);
        println!("Fo = {fourier}: {rise} {exact}");
        assert!((rise / exact - 1.0).abs() < 2e-5, "Fo = {fourier}: {rise} {exact}");
    }
}

/// The steady mean of a moving disc, (1/π) ∫ O(ρ) exp(−Pe ρ) I₀(Pe ρ) dρ from Carslaw & Jaeger 1959, §10.7, and the fit
/// 1.22/√(π(0.6575 + Pe)) of Tian & Kennedy 1994 (doi:10.1115/1.2927035), good to a few per cent.
#[test]
fn moving_disc_follows_the_steady_solution_at_any_peclet_number() {
    for (peclet, exact) in [
        (0.1f64, 0.802024),
        (1.0, 0.555414),
        (2.0, 0.435326),
        (10.0, 0.212839),
        (50.0, 0.096932),
        (500.0, 0.030778),
    ] {
        // The heat that is older contributes exp(−V²t/4κ), V²t/κ = 4e4.
        let rise = mean_rise(peclet, 1e4 / (peclet * peclet) + 40.0 / peclet);
        println!("Pe = {peclet}: {rise} {exact}");
        assert!((rise / exact - 1.0).abs() < 2e-4, "Pe = {peclet}: {rise} {exact}");
        let fit = 1.22 / (std::f64::consts::PI * (0.6575 + peclet)).sqrt();
        assert!((rise / fit - 1.0).abs() < 0.04, "Pe = {peclet}: {rise} {fit}");
    }
}
