//! The half-space against closed forms.

use super::*;

/// A disc at rest that is heated in one long increment, Fo = 10⁶: 8/(3π) qa/k less 1/(2√(πFo)) (Carslaw & Jaeger 1959,
/// §10.5).
#[test]
fn long_increments_heat_as_short_ones_do() {
    let half_space = HalfSpace::new(1.0, 1.0);
    let fourier: f64 = 1e6;
    let length = fourier / (1.0 - FIRST_PART);
    for slip in [0.0, 1e-4 * length] {
        let rise = half_space.step(length, slip, 1.0).own[(0, 0)];
        let expected = 8.0 / (3.0 * std::f64::consts::PI) - 0.5 / (std::f64::consts::PI * fourier).sqrt();
        assert!((rise / expected - 1.0).abs() < 2e-4, "{rise} {expected}");
    }
}

/// An increment with a uniform flux over the unit disc.
fn heat(half_space: &mut HalfSpace, dt: f64, slip: f64, flux: f64) {
    let step = half_space.step(dt, slip, 1.0);
    half_space.try_fluxes(step, [Profile::new(flux, 0.0, 0.0); 2]);
    half_space.commit();
}

/// Steady sliding at Pe = 10 in either direction, then a hold: the mirror image has the same highest rise, before the hold
/// that of Carslaw & Jaeger 1959, §10.7 (0.338382 qa/k).
#[test]
fn the_highest_rise_is_found_downstream_in_either_direction() {
    let after = |direction: f64, hold: f64| {
        let mut half_space = HalfSpace::new(1.0, 1.0);
        let mut dt = 1e-4;
        for _ in 0..35 {
            heat(&mut half_space, dt, direction * 20.0 * dt, 1.0);
            dt *= 1.3;
        }
        heat(&mut half_space, hold, 0.0, 0.0);
        half_space.highest_rise(1.0)
    };
    assert!((after(1.0, 1e-9) / 0.338382 - 1.0).abs() < 2e-3, "{}", after(1.0, 1e-9));
    for hold in [1e-9, 1e-3] {
        let [forwards, backwards] = [1.0, -1.0].map(|direction| after(direction, hold));
        assert!((forwards / backwards - 1.0).abs() < 1e-12, "{forwards} {backwards}");
    }
}

/// What a half-space took up long ago neither warms it nor changes its response, even where the time since then is so long that
/// adding the increment does not change it.
#[test]
fn a_short_increment_after_a_long_hold_is_as_the_first_one() {
    let after = |hold: f64| {
        let mut half_space = HalfSpace::new(1.0, 1.0);
        heat(&mut half_space, 1e-3, 0.1, 1.0);
        heat(&mut half_space, hold, 0.0, 0.0);
        half_space.step(1e-6, 1e-7, 1.0)
    };
    let first = HalfSpace::new(1.0, 1.0).step(1e-6, 1e-7, 1.0);
    for hold in [1e6, 1e12, 1e18] {
        let step = after(hold);
        assert_eq!(step.own, first.own);
        assert_eq!(step.first, first.first);
        // Heat of a point source, 2Q/(e (4πt)^(3/2)) with Q = π·1e-3, less than that once the increment is below rounding.
        let expected = 1e-3 / (4.0 * std::f64::consts::PI.sqrt()) * hold.powf(-1.5);
        let tolerance = if hold < 1e9 { 1e-3 } else { 1.0 };
        assert!((step.free[0].x / expected - 1.0).abs() <= tolerance, "{hold} {}", step.free[0]);
    }
}

/// Uniform heat on the unit disc of a half-space with (1 + ν)α = 1 and κ = k = 1: at first the surface rises by 2qt and, of a
/// moving body, by 2q over the time that has passed since it entered the disc, on average 8/(3πV) and by 1/V per radius; at
/// last the curvature is that of steady heat, w = w₀ − qr²/4 (J. R. Barber 1972).
#[test]
fn the_surface_rises_with_the_heat_below_it() {
    let raised = |speed: f64, time: f64| {
        let mut half_space = HalfSpace::new(1.0, 1.0).with_expansion(1.0);
        let (mut now, mut dt) = (0.0, time / 1e4);
        while now + dt < time {
            heat(&mut half_space, dt, speed * dt, 1.0);
            now += dt;
            dt *= 1.2;
        }
        dt = time - now;
        let step = half_space.step(dt, speed * dt, 1.0);
        half_space.try_fluxes(step, [Profile::new(1.0, 0.0, 0.0); 2]);
        half_space.height_tried().unwrap()
    };
    let early = raised(0.0, 1e-7) / 2e-7;
    assert!((early.x - 1.0).abs() < 5e-3, "{early}");
    let steady = raised(0.0, 1e4);
    assert!((8.0 * steady.z + 1.0).abs() < 5e-3, "{steady}");
    let speed = 1e5;
    let moving = raised(speed, 3.0 / speed) * speed / 2.0;
    let expected = Profile::new(8.0 / (3.0 * std::f64::consts::PI), 1.0, 0.0);
    assert!((moving - expected).rows(0, 2).amax() < 1e-2, "{moving}");
}
