//! The counterface as a half-space under a disc source.
//!
//! At rest H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in Solids* (1959), §10.5; moving X. Tian & F. E. Kennedy, *Maximum and
//! average flash temperatures in sliding contacts*, J. Tribol. 116, 167 (1994), doi 10.1115/1.2927035, and the integral of moving
//! point sources (Carslaw & Jaeger §10.7) that their formula fits, over Pe = Va/(2κ). Displacement of the surface: J. R. Barber,
//! Int. J. Mech. Sci. 14, 377 (1972), `examples/peers/counterface_expansion.py`. Properties that vary with temperature: finite
//! differences in depth, `examples/peers/counterface_properties.py`.

use std::f64::consts::PI;

use super::{Reference, Row, Tolerance};
use crate::heat::counterface::{HalfSpace, Profile};
use crate::heat::properties::ThermalProperties;
use crate::scene::curve::Curve;

pub const AT_REST: &str = "Carslaw & Jaeger 1959, sec. 10.5";
const MOVING: &str = "Carslaw & Jaeger 1959, sec. 10.7, integrated over the disc";
const EXPANSION: &str = "Barber 1972, integrated over the disc";
const FIT: &str = "Tian & Kennedy 1994, doi 10.1115/1.2927035";
const DIFFERENCES: &str = "examples/peers/counterface_properties.py";

/// Mean and highest rise over qa/k after Fo = κt/a² at Pe, and mean height of the surface over (1 + ν)αqa²/k.
fn heated(peclet: f64, fourier: f64) -> (f64, f64, f64) {
    // In increments that grow by 0.3.
    let mut half_space = HalfSpace::new(1.0, 1.0).with_expansion(1.0);
    let uniform = Profile::new(1.0, 0.0, 0.0);
    let (mut time, mut dt, mut rise, mut height) = (0.0, 1e-4 * fourier.min(1.0), 0.0, 0.0);
    while time < fourier * (1.0 - 1e-12) {
        let step = dt.min(fourier - time);
        let response = half_space.step(step, 2.0 * peclet * step, 1.0);
        rise = (response.free(1, uniform) + response.own * uniform).x;
        half_space.try_fluxes(response, [uniform; 2]);
        time += step;
        if time >= fourier * (1.0 - 1e-12) {
            height = half_space.height_tried().map_or(0.0, |height| height.x);
        }
        half_space.commit();
        dt *= 1.3;
    }
    (rise, half_space.highest_rise(1.0), height)
}

/// A disc that moves at Pe = 5·10⁵ under a uniform flux, with k/k₀ = 1 + b_k θ and c/c₀ = 1 + b_c θ: mean potential.
pub fn varying() -> Vec<Row> {
    let growing = |b: f64| Curve::new(vec![0.0, 10.0], vec![1.0, 1.0 + 10.0 * b]);
    let flux = Profile::new(0.9, 0.0, 0.0);
    let speed: f64 = 1e6;
    let row = |(conductivity, heat, expected): (f64, f64, f64)| {
        let properties = ThermalProperties::new(&growing(heat), &growing(conductivity));
        let mut half_space = HalfSpace::new(1.0, 1.0).with_properties(Some(properties));
        let fluxes = [flux * speed.sqrt(); 2];
        let (mut potential, mut dt) = (0.0, 1e-3 / speed);
        for _ in 0..60 {
            // The diffusivity is that of the trial before.
            for _ in 0..4 {
                let step = half_space.step(dt, speed * dt, 1.0);
                potential = step.potential(&fluxes);
                half_space.try_fluxes(step, fluxes);
            }
            half_space.commit();
            dt *= 1.15;
        }
        let name = format!(
            "mean Kirchhoff potential of a counterface that moves fast, k/k0 = 1 + {conductivity} theta, c/c0 = 1 + {heat} theta"
        );
        let reference = Reference::exact(expected, DIFFERENCES).known_to(2e-4);
        Row::new(name, potential, reference, Tolerance::relative(0.01, "diffusivity of the mean potential"))
    };
    [
        (0.5, 0.0, 0.9503),
        (1.0, 0.0, 1.0094),
        (0.0, 0.5, 0.8078),
        (0.0, 1.0, 0.7603),
        (0.5, 0.25, 0.9096),
        (1.0, 0.5, 0.9320),
    ]
    .map(row)
    .into()
}

/// Rises and height of the surface at constant properties.
pub fn constant() -> Vec<Row> {
    let exact = Tolerance::relative(2e-4, "quadrature");
    let at_a_point = Tolerance::relative(1e-3, "quadrature; places");
    let row = |name: String, computed, value, source, tolerance| {
        Row::new(name, computed, Reference::exact(value, source), tolerance)
    };
    let mut rows = Vec::new();
    // In the middle: 2√Fo [1/√π − ierfc(1/(2√Fo))].
    for (fourier, mean, highest) in [
        (0.001, 0.035046, 0.035682),
        (0.01, 0.106480, 0.112838),
        (0.1, 0.293981, 0.352882),
        (1.0, 0.587630, 0.729097),
        (100.0, 0.820640, 0.971802),
    ] {
        let name = |which| format!("{which} rise of the counterface at rest over qa/k, Fo = {fourier}");
        let (rise, most, _) = heated(0.0, fourier);
        rows.push(row(name("mean"), rise, mean, AT_REST, exact));
        rows.push(row(name("highest"), most, highest, AT_REST, at_a_point));
    }
    for (peclet, mean, highest) in [
        (0.1, 0.802024, 0.954464),
        (0.5, 0.663341, 0.828761),
        (2.0, 0.435326, 0.616614),
        (10.0, 0.212839, 0.338382),
        (100.0, 0.068698, 0.112151),
        (500.0, 0.030778, 0.050392),
    ] {
        // The neglected earlier heat is of relative order exp(−Pe²Fo).
        let (rise, most, _) = heated(peclet, 20.0 / (peclet * peclet) + 20.0 / peclet);
        let name = |which| format!("steady {which} rise of the moving counterface over qa/k, Pe = {peclet}");
        rows.push(row(name("mean"), rise, mean, MOVING, exact));
        let fit = 1.22 / (PI * (0.6575 + peclet)).sqrt();
        let of_fit = |error| Tolerance::relative(error, "error of the fit");
        rows.push(row(name("mean"), rise, fit, FIT, of_fit(0.04)));
        rows.push(row(name("highest"), most, highest, MOVING, at_a_point));
        let fit = 2.0 / (PI * (1.273 + peclet)).sqrt();
        rows.push(row(name("highest"), most, fit, FIT, of_fit(0.03)));
    }
    // By erfc(k√t) J₀(kVt), integrated over the wave numbers of the disc and the time.
    for (peclet, fourier, height) in [
        (0.0, 1.0, 0.46703),
        (2.0, 0.5, 0.25712),
        (10.0, 0.1, 0.06993),
        (10.0, 2.0, 0.07464),
        (100.0, 0.02, 0.00814),
    ] {
        let name = format!(
            "mean height of the counterface over (1 + nu) alpha q a2/k, Pe = {peclet}, Fo = {fourier}"
        );
        let tolerance = Tolerance::relative(5e-3, "quadrature");
        rows.push(row(name, heated(peclet, fourier).2, height, EXPANSION, tolerance));
    }
    rows
}
