//! The closed form against the radial return, its limit in small steps, and exact derivatives.

use super::*;
use crate::material::tests::steel;
use crate::scene::{Material, Rate, Softening};

const LAWS: [Hardening; 3] = [
    Hardening::None,
    Hardening::Linear { modulus: 5e9 },
    Hardening::JohnsonCook { modulus: 500e6, exponent: 0.3 },
];

fn solid(hardening: Hardening) -> Solid {
    let softening = Softening::None;
    Solid::new(&Material { yield_strength: 500e6, softening, ..steel(hardening) }, 298.0)
}

/// Without and with a strength that grows with the strain rate.
fn solids(hardening: &Hardening) -> [Solid; 2] {
    let plain = solid(hardening.clone());
    let rate = Rate::JohnsonCook { coefficient: 0.05, reference: 1.0 };
    [plain.clone(), Solid { rate, ..plain }]
}

/// Of every step, s: strains of 0.01 are at a thousand times the reference rate.
const TIME_STEP: f64 = 1e-5;

type Tensor = [f64; TENSOR];

/// Stress and equivalent plastic strain of one point, at f(T)/f(T₀).
#[derive(Clone, Copy, Debug)]
struct Point {
    stress: Tensor,
    strain: f64,
    softening: f64,
}

fn inner(a: &Tensor, b: &Tensor) -> f64 {
    (0..TENSOR).map(|i| if i < 3 { a[i] * b[i] } else { 2.0 * a[i] * b[i] }).sum()
}

fn plus(a: &Tensor, share: f64, b: &Tensor) -> Tensor {
    std::array::from_fn(|i| a[i] + share * b[i])
}

fn distance(a: &Tensor, b: &Tensor) -> f64 {
    let apart = plus(a, -1.0, b);
    inner(&apart, &apart).sqrt()
}

/// The path 2GΔe = `change` in a number of equal steps; `step` gives the state at the end of each.
fn walk(from: Point, change: &Tensor, steps: usize, step: impl Fn(Point, &Tensor) -> Point) -> Point {
    (0..steps).fold(from, |point, _| {
        let elastic = plus(&point.stress, 1.0 / steps as f64, change);
        step(point, &elastic)
    })
}

fn q(s: &Tensor) -> f64 {
    (1.5 * inner(s, s)).sqrt()
}

fn trial(solid: &Solid, point: Point) -> Trial<1> {
    Trial {
        flowing: [true],
        strain: [point.strain],
        strength: [solid.hardened(point.strain).0],
        softening: [point.softening],
        guess: [0.0],
        time_step: TIME_STEP,
    }
}

fn flow(solid: &Solid, point: Point, elastic: &Tensor) -> Flow<1> {
    solid.flow(&StrainPath {
        trial: trial(solid, point),
        start: &point.stress.map(|s| [s]),
        elastic: &elastic.map(|s| [s]),
    })
}

fn closed_form(solid: &Solid) -> impl Fn(Point, &Tensor) -> Point {
    |point, elastic| {
        if q(elastic) <= point.softening * solid.hardened(point.strain).0 {
            return Point { stress: *elastic, ..point };
        }
        let end = flow(solid, point, elastic);
        let stress = end.direction.map(|[n]| end.radius[0] * n);
        Point { stress, strain: point.strain + end.increment[0], ..point }
    }
}

/// Backward Euler, whose limit in small steps is the law.
fn radial_return(solid: &Solid) -> impl Fn(Point, &Tensor) -> Point {
    |point, elastic| {
        if q(elastic) <= point.softening * solid.hardened(point.strain).0 {
            return Point { stress: *elastic, ..point };
        }
        let end = solid.return_map(&trial(solid, point), &[q(elastic)]);
        let kept = point.softening * end.strength[0] / q(elastic);
        Point { stress: elastic.map(|s| kept * s), strain: point.strain + end.increment[0], ..point }
    }
}

const VIRGIN: Point = Point { stress: [0.0; TENSOR], strain: 0.0, softening: 1.0 };
/// To five times the strain of first yield, and on across it.
const PRESS: Tensor = [1.1, 1.3, -2.4, 0.0, 0.2, 0.9];
const SLIDE: Tensor = [-0.3, 0.1, 0.2, 0.4, 0.7, 1.2];

#[test]
fn a_proportional_path_ends_where_the_radial_return_does() {
    for solid in LAWS.iter().flat_map(solids) {
        let by_path = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
        let by_return = walk(VIRGIN, &PRESS, 1, radial_return(&solid));
        assert!(by_path.strain > 1e-3);
        assert!((by_path.strain / by_return.strain - 1.0).abs() < 1e-12);
        assert!(distance(&by_path.stress, &by_return.stress) < 1e-12);
    }
}

/// For a yield surface of constant size the solution is exact: a path may be divided anywhere. From the virgin
/// state, from yield, and from yield back through the elastic inside.
#[test]
fn without_hardening_one_step_is_as_good_as_many() {
    let solid = solid(Hardening::None);
    let yielded = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
    for (from, change) in [(VIRGIN, SLIDE), (yielded, SLIDE), (yielded, PRESS.map(|s| -0.6 * s))] {
        let change = plus(&change, 0.3, &SLIDE);
        let [one, many] = [1, 7].map(|steps| walk(from, &change, steps, closed_form(&solid)));
        assert!(one.strain > from.strain);
        assert!(distance(&one.stress, &many.stress) < 1e-12, "{one:?} {many:?}");
        assert!((one.strain - many.strain).abs() < 1e-12);
    }
}

/// Against the limit of the radial return, of which each step is wrong to first order; with hardening the
/// closed form is wrong to second order, and much less from the first step on.
#[test]
fn steps_converge_to_the_limit_of_the_radial_return() {
    for law in LAWS {
        let solid = solid(law.clone());
        let from = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
        let at = |steps| walk(from, &SLIDE, steps, radial_return(&solid));
        // Error a/n + b/n².
        let (n, half, fourth) = (at(16384), at(8192), at(4096));
        let limit: Tensor =
            std::array::from_fn(|i| (8.0 * n.stress[i] - 6.0 * half.stress[i] + fourth.stress[i]) / 3.0);
        let error = |point: Point| distance(&point.stress, &limit);
        let closed = |steps| error(walk(from, &SLIDE, steps, closed_form(&solid)));
        let of_return = error(at(1));
        assert!(of_return > 0.02, "{of_return}");
        match law {
            Hardening::None => assert!(closed(1) < 1e-9, "{}", closed(1)),
            _ => {
                assert!(closed(1) < 0.05 * of_return, "{law:?}: {} {of_return}", closed(1));
                let ratio = closed(8) / closed(16);
                assert!((3.0..5.0).contains(&ratio), "{law:?}: {ratio}");
            }
        }
    }
}

/// A strength that falls in the step, as one that melts: on the yield surface of the end, continuous, and without
/// anything that is not a number.
#[test]
fn softening_pulls_the_stress_along() {
    for law in LAWS {
        let solid = solid(law);
        let yielded = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
        for softening in [0.999, 0.8, 1e-9, 0.0] {
            let hot = Point { softening, ..yielded };
            for change in [[0.0; TENSOR], SLIDE.map(|s| 1e-9 * s), SLIDE, PRESS.map(|s| -1e-4 * s)] {
                let elastic = plus(&hot.stress, 1.0, &change);
                let end = flow(&solid, hot, &elastic);
                let strength = softening * solid.hardened(hot.strain + end.increment[0]).0;
                let stress = end.direction.map(|[n]| end.radius[0] * n);
                assert!((q(&stress) - strength).abs() < 1e-12, "{softening} {change:?}");
                let direction = end.direction.map(|[n]| n);
                assert!((inner(&direction, &direction) - 1.0).abs() < 1e-9, "{softening} {change:?}");
                assert!((0.0..=1.0).contains(&end.across[0]) && end.increment[0] >= 0.0);
            }
            // The rotation is that of a yield surface that shrinks continuously.
            let many = 1000;
            let slowly = (1..=many).fold(yielded, |point, n| {
                let share = n as f64 / many as f64;
                let point = Point { softening: 1.0 + share * (softening - 1.0), ..point };
                walk(point, &SLIDE.map(|s| s / many as f64), 1, closed_form(&solid))
            });
            let at_once = walk(hot, &SLIDE, 1, closed_form(&solid));
            let of_return = walk(hot, &SLIDE, 1, radial_return(&solid));
            let error = |point: Point| distance(&point.stress, &slowly.stress);
            if softening >= 0.8 {
                assert!(error(at_once) < 0.2 * error(of_return), "{} {}", error(at_once), error(of_return));
            }
        }
    }
}

/// The derivative along the stress on a proportional path, 2GH/(3G + H) over 2G, also where the strain rate changes with
/// the increment.
#[test]
fn derivative_along_the_stress() {
    for solid in LAWS.iter().flat_map(solids) {
        let end = flow(&solid, VIRGIN, &PRESS);
        let at = |h: f64| flow(&solid, VIRGIN, &PRESS.map(|s| s * (1.0 + h))).radius[0];
        let derivative = (at(1e-5) - at(-1e-5)) / (2e-5 * inner(&PRESS, &PRESS).sqrt());
        let expected = end.slope[0] / (3.0 * solid.moduli.shear + end.slope[0]);
        assert!((derivative - expected).abs() < 1e-8, "{derivative} {expected}");
        let strength = solid.hardened(end.increment[0]).0;
        assert!((end.strength[0] / strength - 1.0).abs() < 1e-12);
        let rated = solid.rate.factor(end.increment[0] / TIME_STEP);
        assert!((end.radius[0] / (TO_RADIUS * rated * strength) - 1.0).abs() < 1e-12);
    }
}

/// From the virgin state the derivative across the stress is exact; otherwise it is so in short steps.
#[test]
fn derivative_across_the_stress() {
    for solid in LAWS.iter().flat_map(solids) {
        let yielded = walk(VIRGIN, &PRESS, 1, closed_form(&solid));
        for (from, change) in [(VIRGIN, PRESS), (yielded, SLIDE)] {
            let elastic = plus(&from.stress, 1.0, &change);
            // Across the plane of stress and path.
            let mut across = [0.3, -0.2, -0.1, 0.5, 0.4, -0.3];
            let s = from.stress;
            let bend = plus(&s, -inner(&s, &change) / inner(&change, &change), &change);
            for along in [change, bend] {
                let square = inner(&along, &along);
                if square > 1e-20 {
                    across = plus(&across, -inner(&across, &along) / square, &along);
                }
            }
            let h = 1e-6;
            let [plus_h, minus_h] = [h, -h].map(|h| {
                let point = closed_form(&solid)(from, &plus(&elastic, h, &across));
                point.stress
            });
            let derivative = plus(&plus_h, -1.0, &minus_h).map(|s| s / (2.0 * h));
            let expected = flow(&solid, from, &elastic).across[0];
            assert!(expected < 0.9);
            let apart = distance(&derivative, &across.map(|a| expected * a));
            assert!(apart < 1e-7, "{apart} {expected}");
        }
    }
}
