//! Against the closed forms of verification: F_n of Gaussian heights, exponential
//! heights, Kogut–Etsion asperities.

use super::*;
use crate::integral::test_laws::{PowerLaw, STEEL, asperity};
use crate::surface::heights::{
    Empirical, Exponential, Gaussian, Histogram, LogNormal, TruncatedGaussian, Uniform, Weibull,
};
use tables::closed_forms::closed_form;

const STD: f64 = 1e-6;

/// ∫ (z−h)^n φ(z) dz of standard heights, through the load integral.
fn moment(heights: &dyn Heights, exponent: f64, h: f64, critical: f64) -> f64 {
    let law = PowerLaw { load: (1.0, exponent), critical, ..PowerLaw::hertz() };
    let state = HeightIntegral::new(asperity(&law), heights, 1.0, 1e-13).at(h * STD).unwrap();
    state.pressure.value * (critical / STD).powf(exponent)
}

fn assert_close(value: f64, reference: f64, relative: f64, what: &str) {
    assert!(
        (value - reference).abs() <= relative * reference.abs(),
        "{what}: {value:.15e} against {reference:.15e}"
    );
}

/// h and F_0, F_{1/2}, F_1, F_{3/2}, F_2, F_{5/2} of standard Gaussian heights.
fn gaussian() -> Vec<(f64, [f64; 6])> {
    let lines = include_str!("gaussian_moments.csv").lines().filter(|line| !line.starts_with('#'));
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        (numbers[0], numbers[1..].try_into().unwrap())
    };
    lines.map(row).collect()
}

#[test]
fn gaussian_moments_to_twelve_digits() {
    let heights = Gaussian::new(STD);
    for (h, row) in gaussian() {
        assert_close(heights.tail(h * STD), row[0], 2e-14, "F0");
        for (reference, exponent) in row[1..].iter().zip([0.5, 1.0, 1.5, 2.0, 2.5]) {
            // The result does not depend on the unit of interference: heights wide and narrow against it.
            for critical in [1e-12, 1e-7, 3e-3] {
                let value = moment(&heights, exponent, h, critical);
                assert_close(value, *reference, 1e-12, &format!("F{exponent}({h})"));
            }
        }
    }
}

#[test]
fn exponential_moments_are_gamma_functions() {
    let heights = Exponential::new(STD);
    for exponent in [0.5, 1.0, 1.5, 2.0, 2.5] {
        for h in [0.0, 1.0, 5.0, 30.0] {
            let reference = libm::tgamma(exponent + 1.0) * f64::exp(-h);
            let value = moment(&heights, exponent, h, 1e-7);
            assert_close(value, reference, 1e-12, &format!("F{exponent}({h})"));
        }
    }
}

#[test]
fn moments_of_skewed_and_truncated_heights_in_closed_form() {
    // With the flat below the lowest summit, F_n is a moment of the distribution.
    for exponent in [0.5, 1.0, 1.5, 2.0, 2.5] {
        let shape = 1.7;
        let gamma = |x: f64| libm::tgamma(1.0 + x / shape);
        let weibull = Weibull::new(STD, shape);
        let length = 1.0 / (gamma(2.0) - gamma(1.0).powi(2)).sqrt();
        let reference = length.powf(exponent) * gamma(exponent);
        assert_close(moment(&weibull, exponent, 0.0, 1e-7), reference, 1e-12, "Weibull");

        // Up to the largest shape of a surface file.
        for spread in [0.01, 0.8, 2.0f64] {
            let log_normal = LogNormal::new(STD, spread);
            let variance = spread * spread;
            let median = 1.0 / (variance.exp() * variance.exp_m1()).sqrt();
            let reference = median.powf(exponent) * (0.5 * exponent * exponent * variance).exp();
            let what = format!("log-normal of {spread}, {exponent}");
            assert_close(moment(&log_normal, exponent, 0.0, 1e-7), reference, 1e-11, &what);
        }
    }
    // Mean of a Gaussian cut at a and b above a flat at h < a: [φ(a) − φ(b)]/Z − h.
    let (a, b) = (-0.5f64, 1.5f64);
    let density = |x: f64| (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt();
    let share = |x: f64| 0.5 * libm::erfc(x / 2f64.sqrt());
    let mean = (density(a) - density(b)) / (share(a) - share(b));
    let cut = TruncatedGaussian::new(STD, a * STD, b * STD).unwrap();
    for h in [-3.0, -0.5] {
        assert_close(moment(&cut, 1.0, h, 1e-7), mean - h, 1e-12, "truncated");
    }
}

#[test]
fn ten_digits_at_gross_slip_and_at_the_end_of_a_slide() {
    // Integrals at the given tolerance against ones at a thousandth of it.
    let heights = Gaussian::new(0.05e-6);
    for name in ["jackson-green", "brizmer", "kogut-etsion"] {
        let law = closed_form(name, &STEEL).unwrap();
        for slip in [1e-10, 1e-9, 1e-8] {
            let asperity = asperity(law.as_ref()).after(slip);
            let at = |tolerance: f64| {
                HeightIntegral::new(asperity.clone(), &heights, 1e10, tolerance).at(0.1e-6).unwrap()
            };
            let (asked, sharp) = (at(1e-10), at(1e-13));
            assert_close(asked.shear.value, sharp.shear.value, 1e-10, name);
            assert_close(asked.pressure.value, sharp.pressure.value, 1e-10, name);
            assert!(asked.shear.quadrature_error <= 1.1e-10 * asked.shear.value, "{name}");
        }
    }
}

#[test]
fn every_distribution_obeys_the_recursion() {
    // F_n' = −n F_{n−1} holds for any density.
    let distributions: [&dyn Heights; 6] = [
        &Gaussian::new(STD),
        &Exponential::new(STD),
        &Uniform::new(STD),
        &TruncatedGaussian::new(STD, -1.5 * STD, 2.5 * STD).unwrap(),
        &Weibull::new(STD, 1.7),
        &LogNormal::new(STD, 0.8),
    ];
    for heights in distributions {
        for exponent in [1.5, 2.0, 2.5] {
            for h in [-2.3, -0.4, 0.3, 1.1] {
                let step = 1e-3;
                let at = |h: f64| moment(heights, exponent, h, 1e-7);
                // Fourth-order differences: the error is about step⁴.
                let slope = (8.0 * (at(h + step) - at(h - step)) - (at(h + 2.0 * step) - at(h - 2.0 * step)))
                    / (12.0 * step);
                let reference = -exponent * moment(heights, exponent - 1.0, h, 1e-7);
                assert_close(slope, reference, 1e-8, &format!("{heights:?} n = {exponent}, h = {h}"));
            }
        }
    }
}

#[test]
fn uniform_heights_integrate_powers_exactly() {
    let heights = Uniform::new(STD);
    let edge = 3f64.sqrt();
    for h in [-4.0, -1.0, 0.0, 1.5] {
        let power = |place: f64| (place - h).max(0.0).powf(2.5) / 2.5;
        let reference = (power(edge) - power(-edge)) / (2.0 * edge);
        assert_close(moment(&heights, 1.5, h, 1e-7), reference, 1e-12, "uniform");
    }
    assert_eq!(moment(&heights, 1.5, 2.0, 1e-7), 0.0);
}

/// Lower incomplete gamma function, for the exact Kogut–Etsion sums.
fn incomplete_gamma(a: f64, x: f64) -> f64 {
    let regularized = if x > 0.0 { statrs::function::gamma::gamma_lr(a, x.min(f64::MAX)) } else { 0.0 };
    libm::tgamma(a) * regularized
}

#[test]
fn kogut_etsion_asperities_with_exponential_heights() {
    let law = closed_form("constant-shear", &STEEL).unwrap();
    let radius = 1e-4;
    // p₀/σ_Y of first yield, exact and after Chang et al., 2.8 (0.454 + 0.41ν), in units of which Kogut & Etsion write.
    let (exact_yield, of_authors) = (1.61279656f64, 2.8 * (0.454 + 0.41 * 0.3));
    let in_exact = (of_authors / exact_yield).powi(2);
    let critical = in_exact * law.critical_interference(radius);
    // P ∝ ω^{3/2} and A ∝ ω below first yield.
    let quarter = law.response(radius, 0.25 * in_exact, 1.0, 1.0).unwrap();
    let (unit_load, unit_area) = (8.0 * quarter.load.value, 4.0 * quarter.area.value);
    let breaks = [0.0, 1.0, 6.0, 110.0, f64::INFINITY];
    let load_of =
        |coefficient: f64| [(1.0, 1.5), (1.03, 1.425), (1.40, 1.263), (3.0 * 2.8 / coefficient, 1.0)];
    let load = load_of(of_authors);
    let area = [(1.0, 1.0), (0.93, 1.136), (0.94, 1.146), (2.0, 1.0)];
    for (psi, published_mu) in [(0.5, 0.80375), (1.0, 0.42963), (8.0, 0.21443)] {
        let psi: f64 = psi;
        let exact = |pieces: &[(f64, f64); 4]| -> f64 {
            (0..4)
                .map(|i| {
                    let (k, n) = pieces[i];
                    let at = |y: f64| incomplete_gamma(n + 1.0, y / (psi * psi));
                    k * psi.powf(2.0 * n) * (at(breaks[i + 1]) - at(breaks[i]))
                })
                .sum()
        };
        // Five published digits, for the exact first yield: μ = (√3/2)/C · S_A/S_P.
        let ratio =
            |coefficient: f64| 0.75f64.sqrt() / coefficient * exact(&area) / exact(&load_of(coefficient));
        assert_close(ratio(exact_yield), published_mu, 2e-5, "reference");
        let heights = Exponential::new(critical * psi * psi);
        let mut integral = HeightIntegral::new(asperity(law.as_ref()).after(1.0), &heights, 1.0, 1e-12);
        let mut first: Option<f64> = None;
        for h in [0.0, 0.7, 3.0, 12.0] {
            let state = integral.at(h * heights.standard_deviation()).unwrap();
            let mu = state.friction_coefficient().value;
            // Amontons: the same at every load.
            let first = *first.get_or_insert(mu);
            assert_close(mu, first, 1e-10, "mu against load");
            assert_close(mu, ratio(of_authors), 1e-8, "mu");
            let load_sum = state.pressure.value * h.exp() / unit_load;
            assert_close(load_sum, exact(&load), 1e-8, "S_P");
            let area_sum = state.area_fraction.value * h.exp() / unit_area;
            assert_close(area_sum, exact(&area), 1e-8, "S_A");
        }
    }
}

#[test]
fn load_beyond_the_largest_contact_is_counted_and_continued() {
    // Exponential heights: the share of the load beyond x = ω_limit/σ is
    // ∫_x^∞ s·(x^½) e^{-s} ds over the same plus γ(5/2, x), P continued in proportion to ω.
    let law = PowerLaw { limit: 20.0, ..PowerLaw::hertz() };
    let heights = Exponential::new(STD);
    let x: f64 = 20.0 * law.critical / STD;
    let beyond = x.sqrt() * (1.0 + x) * (-x).exp();
    let share = beyond / (beyond + incomplete_gamma(2.5, x));
    let state = HeightIntegral::new(asperity(&law), &heights, 1.0, 1e-12).at(STD).unwrap();
    assert_close(state.outside, share, 1e-10, "share");
    assert_eq!(state.outside, state.beyond);
}

#[test]
fn a_large_measured_set_approaches_its_parent() {
    // Quantiles of exponential heights: a midpoint rule in the tail, with an end error of order 1/n.
    let count = 20_000;
    let quantiles = (0..count).map(|i| -STD * ((f64::from(i) + 0.5) / f64::from(count)).ln());
    let sample = Empirical::new(quantiles.collect()).unwrap();
    let law = PowerLaw::hertz();
    let at =
        |heights: &dyn Heights| HeightIntegral::new(asperity(&law), heights, 1.0, 1e-12).at(STD).unwrap();
    let (exact, summed) = (at(&Exponential::new(STD)), at(&sample));
    assert_close(summed.pressure.value, exact.pressure.value, 1e-3, "load");
    assert_close(summed.contact_density, exact.contact_density, 1e-3, "number");
}

#[test]
fn bins_are_integrated_one_by_one() {
    // Hertzian load of heights spread evenly from a to b over a flat at d < a is
    // [(b−d)^{5/2} − (a−d)^{5/2}]/(5/2)/(b−a); a gap in between, and two bins of 1:3.
    let edges = [0.0, 1.0, 2.0, 2.5].map(|edge| edge * STD);
    let heights = Histogram::new(edges.to_vec(), &[1.0, 0.0, 3.0]).unwrap();
    let spread = |from: f64, to: f64, d: f64| {
        let power = |z: f64| (z - d).max(0.0).powf(2.5);
        (power(to) - power(from)) / 2.5 / (to - from)
    };
    for d in [-7.3, -0.2, 0.0, 0.4, 1.3, 2.1, 2.499] {
        let exact = 0.25 * spread(0.0, 1.0, d) + 0.75 * spread(2.0, 2.5, d);
        for critical in [0.1 * STD, 3.0 * STD] {
            assert_close(moment(&heights, 1.5, d, critical), exact, 1e-12, &format!("at {d}"));
        }
    }
}
