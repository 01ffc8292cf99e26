//! Friction that heats and so weakens the contact: steady sliding, and the first moments.
//!
//! Problem: elastic sphere, τ = τ₀(1 − T/ΔT_m) (T the rise), all frictional heat into the sphere,
//! which is a half space to the contact. L = τ₀Va/(kΔT_m), Fo = κt/a².
//!
//! Sources. Steady: τ₀(1 − T/ΔT_m) with the T of the flux τV on a disc (H. S. Carslaw &
//! J. C. Jaeger, *Conduction of Heat in Solids* (1959), §8.2), solved ring by ring with 6 digits.
//! Start: J. R. Rice, J. Geophys. Res. 111, B05311 (2006), doi 10.1029/2005JB004006, slip on a
//! plane: τ/τ₀ = exp(s) erfc(√s), here s = L²Fo.
//!
//! Parameters: ν = 0.499, ω₀ = 10⁻⁴ ω_c and f_τ = 0.005, so that even the softened body stays
//! elastic; the flat slides 2000 times as far as gross slip takes; the heat capacity is what gives
//! the wanted Fo at the end.

use asperity::scene::{FrictionLaw, Softening, Switch};
use asperity::simulate::outcome::Outcome;
use tables::quantity::Quantity;
use tests::{Hertz, Mesh, assert_close, last, mesh, plain_material, richardson, run, scene};

/// ΔT_m, K.
const RANGE: f64 = 1000.0;

/// Outcome and τ₀ (Pa) of a slide at softening number L that ends at Fo.
fn slide(softening: f64, fourier: f64, mesh: Mesh) -> (Outcome, f64) {
    let mut scene = scene(plain_material(0.499), FrictionLaw::ShearStrength, 1e-4, mesh);
    scene.material.softening =
        Softening::JohnsonCook { reference: 298.0, melting: 298.0 + RANGE, exponent: 1.0 };
    scene.interface.strength_factor = 0.005;
    scene.model.heat = Switch::On;
    let strength = scene.interface.strength_factor * scene.material.yield_strength / 3f64.sqrt();
    let hertz = Hertz::of(&scene);
    let (a, k) = (hertz.contact_radius, scene.material.thermal_conductivity);
    let gross = strength / (2.0 * hertz.tangential_modulus);
    scene.loading.slip_distance = 2000.0 * gross;
    scene.loading.slip_rate = softening * k * RANGE / (strength * a);
    let time = scene.loading.slip_distance * a / scene.loading.slip_rate;
    scene.material.density = 1.0;
    scene.material.specific_heat = k * time / (fourier * a * a);
    let outcome = run(&scene);
    assert_eq!(last(&outcome)[Quantity::PlasticStrainMax], 0.0);
    (outcome, strength)
}

/// At Fo = 10⁶ what is left of the approach to the steady state, 1/(2√(πFo)), is 0.03 %.
#[test]
fn steady_sliding() {
    // L, Q/Q₀, largest rise over ΔT_m.
    for (softening, friction, rise) in
        [(0.1, 0.92184, 0.09171), (1.0, 0.54326, 0.52052), (10.0, 0.10933, 0.93195)]
    {
        let [coarse, fine] = [6, 12].map(|n| {
            let (outcome, strength) = slide(softening, 1e6, mesh(n, 4));
            let end = last(&outcome);
            (
                end[Quantity::Friction] / (end[Quantity::Area] * strength),
                (end[Quantity::TemperatureMax] - 298.0) / RANGE,
            )
        });
        // Measured off by 0.09, 0.55, 1.01 % at n_c = 8 (L = 0.1, 1, 10) and by 0.04, 0.22, 0.42 % at 16.
        assert_close(&format!("Q/Q0 at L = {softening}"), fine.0, friction, 0.012);
        // Order 1.5, from the square-root edge of the pressure.
        let limit = richardson(coarse.0, fine.0, 1.5);
        assert_close("its limit", limit, friction, 0.002);
        assert_close("T_max", fine.1, rise, 0.01);
    }
}

/// At the centre the contact is a plane until Fo ~ 0.05; the thermal layer of 0.1 a has two
/// layers of elements at n_c = 8, which leave 0.6 %.
#[test]
fn first_moments() {
    // s = L²Fo, exp(s) erfc(√s).
    for (s, reference) in [(0.1, 0.723578), (1.0, 0.427584)] {
        let fourier: f64 = 0.01;
        let (outcome, strength) = slide((s / fourier).sqrt(), fourier, mesh(8, 4));
        let centre = outcome.snapshots.last().unwrap().shear[0] / strength;
        assert_close(&format!("tau/tau0 at s = {s}"), centre, reference, 0.01);
    }
}
