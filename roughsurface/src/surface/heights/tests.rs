//! One battery for every distribution, and the errors of the section `heights`.

use super::*;
use gauss_quad::GaussLegendre;
use rand::SeedableRng;
use std::path::Path;

fn all() -> Vec<(&'static str, Box<dyn Heights>)> {
    vec![
        ("gaussian", Box::new(Gaussian::new(2e-6))),
        ("exponential", Box::new(Exponential::new(2e-6))),
        ("uniform", Box::new(Uniform::new(2e-6))),
        ("inverted-chi-squared", Box::new(InvertedChiSquared::new(2e-6, 8.0))),
        ("truncated-gaussian", Box::new(TruncatedGaussian::new(2e-6, -5e-6, 1e-6).unwrap())),
        ("weibull", Box::new(Weibull::new(2e-6, 2.5))),
        ("lognormal", Box::new(LogNormal::new(2e-6, 0.5))),
        ("histogram", Box::new(two_humps())),
    ]
}

/// Unequal bins, a gap between two humps and empty ends; the places that the battery looks at
/// are no edges.
fn two_humps() -> Histogram {
    let std = 1.0 / TWO_HUMPS_STD * 2e-6;
    let edges = [-4.0, -2.5, -1.9, -0.6, 0.0, 0.5, 1.0, 2.5, 3.0].map(|edge| edge * std);
    Histogram::new(edges.to_vec(), &[0.0, 2.0, 5.0, 1.0, 0.0, 3.0, 4.0, 0.0]).unwrap()
}

/// Standard deviation of those bins in the unit of their edges: (2, 5, 1, 3, 4)/15 about
/// −2.2, −1.25, −0.3, 0.75, 1.75 with widths 0.6, 1.3, 0.6, 0.5, 1.5, by hand.
const TWO_HUMPS_STD: f64 = 1.481_755_715_359_316_6;

/// Moments of the density by brute force: many panels over ±30 standard deviations, cut where the
/// density jumps.
fn moments(heights: &dyn Heights) -> (f64, f64, f64) {
    let rule = GaussLegendre::new(20).unwrap();
    let std = heights.standard_deviation();
    let (low, high) = heights.support();
    let (low, high) = (low.max(-30.0 * std), high.min(60.0 * std));
    let mut panels: Vec<(f64, f64)> = Vec::new();
    let mut pending = vec![(low, high)];
    while let Some((from, to)) = pending.pop() {
        match heights.step_between(from, to) {
            Some(step) => pending.extend([(from, step), (step, to)]),
            None => {
                let width = (to - from) / 2000.0;
                let start = |panel: i32| from + f64::from(panel) * width;
                panels.extend((0..2000).map(|panel| (start(panel), start(panel + 1))));
            }
        }
    }
    let integral = |power: i32| -> f64 {
        let density = |z: f64| (z / std).powi(power) * heights.ln_density(z).exp();
        panels.iter().map(|&(from, to)| rule.integrate(from, to, density)).sum()
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

/// No distribution without an example in this battery; a sample has no density.
#[test]
fn every_distribution_is_tested() {
    let tested: Vec<&str> = all().iter().map(|(name, _)| *name).collect();
    for entry in DISTRIBUTIONS.iter().filter(|entry| entry.name != "sample") {
        assert!(tested.iter().any(|name| name.starts_with(entry.name)), "{}: {tested:?}", entry.name);
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
    let heights = Empirical::new(vec![1.0, 4.0, 2.0, 3.0]).unwrap();
    assert_eq!(heights.tail(2.5), 0.5);
    assert_eq!(heights.tail(0.0), 1.0);
    assert!(Empirical::new(vec![1.0, 1.0]).is_none());
    // The variance of forty equal heights is not zero: their mean is rounded.
    assert!(Empirical::new(vec![1e-7; 40]).is_none());
}

/// What is read of a file with that text.
fn read<T>(text: &str, read: fn(&Path) -> Result<T, String>) -> Result<T, String> {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(&file, text).unwrap();
    read(file.path())
}

#[test]
fn pairs_of_positions_and_heights_are_no_sample() {
    let read = |text: &str| read(text, Empirical::read);
    let message = read("# x z\n0 1e-7\n1e-6 2e-7\n\n2e-6 3e-7\n").unwrap_err();
    assert!(message.contains("has two numbers in every line"), "{message}");
    let matrix =
        |lines: usize, numbers: usize| format!("{}\n", "1e-7 2e-7 ".repeat(numbers / 2)).repeat(lines);
    let message = read(&matrix(16, 16)).unwrap_err();
    assert!(message.contains("has 16 numbers in every line, as of a map of heights"), "{message}");
    for (lines, numbers) in [(15, 16), (16, 14)] {
        read(&matrix(lines, numbers)).unwrap();
    }
    for heights in [
        "1e-7 2e-7\n3e-7 4e-7\n",
        "1e-7\n2e-7\n",
        "1e-7 2e-7",
        "1e-7 2e-7\n3e-7\n",
        "1e-7 2e-7 3e-7\n1e-7 4e-7 5e-7\n",
    ] {
        read(heights).unwrap();
    }
}

#[test]
fn histograms_are_read_with_the_upper_edge_last() {
    let read = |text: &str| read(text, Histogram::read);
    let heights = read("# edge, count\n-1e-6, 3\n0, 1\n\n1e-6\n").unwrap();
    assert_eq!(heights.support(), (-1e-6, 1e-6));
    assert_eq!((heights.tail(0.0), heights.tail(0.5e-6)), (0.25, 0.125));
    for (text, what) in [
        ("0 1\n1e-6\n2e-6 3\n", "line 3: \"2e-6 3\" is not the lower edge"),
        ("0 many\n1\n", "line 1: \"0 many\""),
        ("0 1\n1 2\n", "must hold ascending edges"),
        ("0 1\n1 -2\n2\n", "must hold ascending edges"),
        ("0 0\n1\n", "must hold ascending edges"),
    ] {
        let message = read(text).unwrap_err();
        assert!(message.contains(what), "{message}");
    }
}

#[test]
fn errors_name_key_value_and_what_is_allowed() {
    let keys = |distribution: &str, std: Option<f64>, shape: Option<f64>| HeightsKeys {
        distribution: distribution.into(),
        std,
        shape,
        ..Default::default()
    };
    let message = |keys: HeightsKeys| build(&keys, Path::new(".")).unwrap_err();
    assert_eq!(message(keys("gaussian", None, None)), "std: is missing; the gaussian distribution takes std");
    assert_eq!(
        message(keys("gaussian", Some(-1e-6), None)),
        "std = -1e-6: must be a positive length in metres"
    );
    assert_eq!(message(keys("weibull", Some(1e-6), Some(0.5))), "shape = 0.5: must lie between 1 and 50");
}
