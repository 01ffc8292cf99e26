//! One battery for every distribution, and the errors of the section `heights`.

use super::*;
use gauss_quad::GaussLegendre;
use rand::SeedableRng;

fn all() -> Vec<(&'static str, Box<dyn Heights>)> {
    vec![
        ("gaussian", Box::new(Gaussian::new(2e-6))),
        ("exponential", Box::new(Exponential::new(2e-6))),
        ("uniform", Box::new(Uniform::new(2e-6))),
        ("truncated-gaussian", Box::new(TruncatedGaussian::new(2e-6, -5e-6, 1e-6).unwrap())),
        ("weibull", Box::new(Weibull::new(2e-6, 2.5))),
        ("lognormal", Box::new(LogNormal::new(2e-6, 0.5))),
    ]
}

/// Moments of the density by brute force: many panels over ±30 standard deviations.
fn moments(heights: &dyn Heights) -> (f64, f64, f64) {
    let rule = GaussLegendre::new(20).unwrap();
    let std = heights.standard_deviation();
    let (low, high) = heights.support();
    let (low, high) = (low.max(-30.0 * std), high.min(60.0 * std));
    let panels = 2000;
    let width = (high - low) / panels as f64;
    let integral = |power: i32| -> f64 {
        (0..panels)
            .map(|panel| {
                let from = low + panel as f64 * width;
                rule.integrate(from, from + width, |z| (z / std).powi(power) * heights.ln_density(z).exp())
            })
            .sum()
    };
    (integral(0), integral(1), integral(2))
}

#[test]
fn densities_are_normalised_and_have_the_stated_spread() {
    for (name, heights) in all() {
        let (zeroth, first, second) = moments(heights.as_ref());
        assert!((zeroth - 1.0).abs() < 1e-9, "{name}: {zeroth}");
        let variance = second - first * first;
        assert!((variance - 1.0).abs() < 1e-7, "{name}: {variance}");
    }
}

#[test]
fn tails_fall_by_the_density() {
    for (name, heights) in all() {
        let std = heights.standard_deviation();
        for place in [-1.1, -0.3, 0.2, 0.7, 1.3] {
            let (z, step) = (place * std, 1e-4 * std);
            let slope = (heights.tail(z - step) - heights.tail(z + step)) / (2.0 * step);
            let density = heights.ln_density(z).exp();
            // Central differences: third derivative times step squared, a few 1e-8.
            assert!((slope - density).abs() * std < 1e-6, "{name} at {place}: {slope:e} against {density:e}");
        }
    }
}

#[test]
fn the_mode_is_the_largest_density() {
    for (name, heights) in all() {
        let std = heights.standard_deviation();
        let peak = heights.ln_density(heights.mode());
        for place in -40..40 {
            let density = heights.ln_density(0.1 * f64::from(place) * std);
            assert!(density <= peak + 1e-12, "{name} at {place}");
        }
    }
}

#[test]
fn drawn_heights_follow_the_tail() {
    for (name, heights) in all() {
        let mut random = Random::seed_from_u64(1);
        let count = 20_000;
        let median = {
            let mut drawn: Vec<f64> = (0..count).map(|_| heights.draw(&mut random)).collect();
            drawn.sort_by(f64::total_cmp);
            drawn[count / 2]
        };
        // Four standard errors of a share of one half.
        let allowed = 4.0 * 0.5 / (count as f64).sqrt();
        assert!((heights.tail(median) - 0.5).abs() < allowed, "{name}");
    }
}

#[test]
fn a_measured_set_counts_its_summits() {
    let heights = Sample::new(vec![1.0, 4.0, 2.0, 3.0]).unwrap();
    assert_eq!(heights.tail(2.5), 0.5);
    assert_eq!(heights.tail(0.0), 1.0);
    assert!(Sample::new(vec![1.0, 1.0]).is_none());
}

#[test]
fn errors_name_key_value_and_what_is_allowed() {
    let keys = |distribution: &str, std: Option<f64>, shape: Option<f64>| HeightsKeys {
        distribution: distribution.into(),
        std,
        shape,
        ..Default::default()
    };
    let message = |keys: HeightsKeys| build(&keys, Path::new(".")).unwrap_err().to_string();
    assert_eq!(
        message(keys("gausian", Some(1e-6), None)),
        "distribution = \"gausian\": must be one of gaussian, exponential, uniform, \
         truncated-gaussian, weibull, lognormal, sample (did you mean \"gaussian\"?)"
    );
    assert_eq!(message(keys("gaussian", None, None)), "std: is missing; the gaussian distribution takes std");
    assert_eq!(
        message(keys("gaussian", Some(-1e-6), None)),
        "std = -1e-6: must be a positive length in metres"
    );
    assert_eq!(message(keys("weibull", Some(1e-6), Some(0.5))), "shape = 0.5: must lie between 1 and 50");
}
