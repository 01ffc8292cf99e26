use tables::closed_forms::partial_slip::constant_shear;

use super::*;

/// A contact of unit load and area.
fn contact(slip: f64, friction: f64, stick_fraction: f64) -> SlideState {
    SlideState { slip, friction, stick_fraction, load: 1.0, area: 1.0, ..SlideState::default() }
}

/// Q = 1 − e^−s, that sticks throughout, in increments of a fiftieth of the slip but at least 0.02, and short ones
/// around s = 3, in which Q falls once by a little.
fn stepwise() -> Vec<SlideState> {
    let mut slips = vec![0.0];
    while *slips.last().expect("not empty") < 10.0 {
        let slip: f64 = *slips.last().expect("not empty");
        let increment = if (2.8..3.2).contains(&slip) { 0.01 } else { (0.02 * slip).max(0.02) };
        slips.push(slip + increment);
    }
    let fallen = slips.iter().position(|&slip| slip > 3.0).expect("goes on past it");
    let state = |(n, &slip): (usize, &f64)| {
        contact(slip, 1.0 - (-slip).exp() - if n == fallen { 1e-3 } else { 0.0 }, 1.0)
    };
    slips.iter().enumerate().map(state).collect()
}

/// Savkoor's contact of unit strength, radius and slip δ_s, which sticks at the edge for longer than in its middle: slip
/// and G are those of the closed form, ∫Q ds = 1 − 4/(3π), friction that of the last point.
#[test]
fn slip_and_energy_are_those_of_full_mobilisation() {
    let mut history: Vec<SlideState> = Vec::new();
    for slip in [0.0, 0.05, 0.1, 0.15, 0.2, 0.26, 0.34, 0.44, 0.57, 0.72, 0.86, 0.93, 0.98, 1.1, 1.2, 1.21] {
        let friction = constant_shear::force_fraction(slip);
        let before = history.last().copied().unwrap_or_default();
        let work = before.work + 0.25 * (slip - before.slip) * (friction + before.friction);
        let stick_fraction = (1.0 - slip / 1.2).max(0.0);
        let state = contact(slip, friction, stick_fraction);
        history.push(SlideState { load: 2.0, work, mobilised: friction, ..state });
    }
    let found = inception(&history);
    assert_eq!((found.criterion, found.friction), (InceptionCriterion::FullSlip, 1.0));
    assert!((found.slip - 1.0).abs() < 1e-3, "{found:?}");
    let exact = constant_shear::energies_at_gross_slip().0;
    assert!((found.energy_release / exact - 1.0).abs() < 3e-3, "{found:?} {exact}");
    assert_eq!((found.slip_bracket, found.energy_bracket), (0.0, 0.0));
}

/// Of a stick area that falls linearly a tenth of the interval remains, of one that falls all at once half of it.
#[test]
fn inception_is_as_sure_as_the_stick_area_is_smooth() {
    let slides = |fraction: fn(f64) -> f64| {
        let at = |slip: f64| SlideState { work: slip * slip, ..contact(slip, slip, fraction(slip)) };
        inception(&[0.0, 0.4, 0.8, 0.95, 0.995].map(at))
    };
    let smooth = slides(|slip| 1.0 - slip);
    assert_eq!(smooth.criterion, InceptionCriterion::FullSlip);
    assert!((smooth.slip - 0.99).abs() < 1e-12, "{smooth:?}");
    assert!((smooth.slip_bracket - 0.0045).abs() < 1e-12, "{smooth:?}");
    // G = 2 s².
    let change = 2.0 * (0.995f64.powi(2) - 0.95f64.powi(2));
    assert!((smooth.energy_bracket - 0.1 * change).abs() < 1e-12, "{smooth:?}");
    // The friction is the slip.
    assert_eq!(smooth.friction_bracket, smooth.slip_bracket);
    let sudden = slides(|slip| if slip < 0.96 { 1.0 } else { 0.0 });
    assert!((sudden.slip_bracket - 0.0225).abs() < 1e-3, "{sudden:?}");
}

/// A contact whose stick area falls, recovers and falls again: any of the slips between may be its inception, unless its
/// friction stays below that of the first.
#[test]
fn a_contact_that_sticks_again_is_uncertain_by_the_slips_between() {
    let history = |fractions: [f64; 8], later: f64| -> Vec<SlideState> {
        let slips = [0.0, 0.3, 0.6, 0.9, 1.0, 1.1, 1.2, 1.5];
        let at = |(slip, stick_fraction): (f64, f64)| {
            let mobilised = 1.0 - stick_fraction;
            let (friction, work) = (if slip > 1.0 { later } else { mobilised }, 0.25 * slip);
            SlideState { work, mobilised, ..contact(slip, friction, stick_fraction) }
        };
        slips.into_iter().zip(fractions).map(at).collect()
    };
    let steady = history([1.0, 0.7, 0.4, 0.1, 0.0, 0.0, 0.0, 0.0], 1.0);
    assert_eq!(stick_slip(&steady), None);
    let sticks_again = |later| history([1.0, 0.7, 0.4, 0.05, 0.0, 0.3, 0.0, 0.0], later);
    let again = sticks_again(1.2);
    assert_eq!(stick_slip(&again), Some([0.9, 1.1]));
    let found = inception(&again);
    assert_eq!(found.criterion, InceptionCriterion::FullSlip);
    assert_eq!(found.slip_bracket, (found.slip - 0.9).abs().max((found.slip - 1.1).abs()));
    // Friction is interpolated to a stick area of 1 %, 0.99, and grows to 1.2.
    assert!((found.friction_bracket - 0.21).abs() < 1e-12, "{found:?}");
    let weaker = sticks_again(0.7);
    assert_eq!(stick_slip(&weaker), Some([0.9, 1.1]));
    assert_eq!(inception(&weaker), inception(&weaker[..5]));
    // As the renewed stick ends, friction is above that of the first slip.
    let mut after = weaker;
    after[6].friction = 1.2;
    assert!((inception(&after).friction_bracket - 0.21).abs() < 1e-12);
    // Above it by less than the uncertainty of that.
    after[6].friction = 1.0;
    assert_eq!(inception(&after), inception(&after[..5]));
    // What sticks after another motion has begun is another inception.
    let mut stopped = again;
    stopped[5..].iter_mut().for_each(|state| state.step = 1);
    assert_eq!(stick_slip(&stopped), None);
}

/// A contact with Q = s and G = s²/2 up to s = 0.9, and then these slips, frictions and stick area fractions.
fn sticking_until(later: &[(f64, f64, f64)]) -> Vec<SlideState> {
    let at = |&(slip, friction, stick_fraction): &(f64, f64, f64)| SlideState {
        work: 0.25 * slip * slip,
        load: 2.0 - slip,
        mobilised: 1.0 - 0.1 * stick_fraction.powf(1.5),
        ..contact(slip, friction, stick_fraction)
    };
    let first = [(0.0, 0.0, 1.0), (0.4, 0.4, 0.6), (0.6, 0.6, 0.4), (0.9, 0.9, 0.06)];
    first.iter().chain(later).map(at).collect()
}

/// Friction that falls before the last points slip: static friction is the largest until then. If it falls faster than the
/// contact unloads elastically, here by 1 per slip, slip and G are those of the largest friction, too, and uncertain by half of
/// the increment after it; otherwise they are those of full mobilisation.
#[test]
fn static_friction_is_the_largest_until_the_contact_slips() {
    use InceptionCriterion::{AtOnce, FullSlip};
    for (later, criterion, width) in [
        (&[(1.0, 0.81, 0.0)][..], FullSlip, 0.1),
        (&[(1.0, 0.79, 0.0)], AtOnce, 0.1),
        // dQ/ds has fallen below 1 % while 5 % of the area sticks.
        (&[(1.0, 0.59, 0.05)], AtOnce, 0.1),
        // The fall begins slowly.
        (&[(0.91, 0.895, 0.04), (0.92, 0.8, 0.0)], AtOnce, 0.01),
        // An increment too short for a slope.
        (&[(0.901, 0.898, 0.05), (1.0, 0.89, 0.0)], FullSlip, 0.001),
    ] {
        let found = inception(&sticking_until(later));
        assert_eq!((found.criterion, found.friction, found.load), (criterion, 0.9, 1.1), "{later:?}");
        assert!((found.friction_bracket - 0.5 * width).abs() < 1e-12, "{found:?}");
        assert_eq!(found.slip == 0.9, criterion == AtOnce, "{found:?}");
    }
    let found = inception(&sticking_until(&[(1.0, 0.79, 0.0)]));
    assert!((found.slip_bracket - 0.05).abs() < 1e-12, "{found:?}");
    assert!((found.energy_release - 0.5 * 0.81).abs() < 1e-12, "{found:?}");
    assert!((found.energy_bracket - 0.05 * 0.5 * (0.81 - 0.36) / 0.3).abs() < 1e-12, "{found:?}");
    // A curve that saturates and falls by little: friction is that of the slip at which the stiffness is lost.
    let mut saturating = stepwise();
    let found = inception(&saturating);
    let after = saturating.iter().position(|state| state.slip > found.slip + 0.1).expect("goes on");
    saturating[after].friction = saturating[after - 1].friction - 1e-3;
    let fallen = inception(&saturating[..=after]);
    assert!((fallen.friction - found.friction).abs() < 2e-3, "{fallen:?} {found:?}");
    // A slide that ends within the fall has not begun to slide.
    let found = inception(&sticking_until(&[(0.91, 0.85, 0.05)]));
    assert_eq!((found.criterion, found.slip, found.friction), (InceptionCriterion::None, 0.91, 0.85));
}

/// All points slip radially in the first increment, and stick again before they slide.
#[test]
fn slip_of_the_tractions_of_the_press_is_no_inception() {
    let at = |(slip, stick_fraction, transverse): (f64, f64, f64)| SlideState {
        transverse,
        ..contact(slip, slip, stick_fraction)
    };
    let history =
        [(0.0, 1.0, 1.0), (0.01, 0.0, 0.95), (0.4, 0.4, 0.6), (0.9, 0.11, 0.1), (1.0, 0.0, 0.01)].map(at);
    let found = inception(&history);
    assert_eq!(found.criterion, InceptionCriterion::FullSlip);
    assert!((found.slip - (0.9 + 0.1 / 1.1)).abs() < 1e-12, "{found:?}");
    // A small fall is none at once, though the first increment had hardly any friction.
    let mut falls = history;
    (falls[1].friction, falls[4].friction) = (0.0, 0.89);
    let found = inception(&falls);
    assert_eq!((found.criterion, found.friction), (InceptionCriterion::FullSlip, 0.9));
}

#[test]
fn sliding_begins_where_the_stiffness_has_fallen_for_good() {
    let history = stepwise();
    let steps_back = history.windows(2).filter(|pair| pair[1].friction < pair[0].friction).count();
    assert_eq!(steps_back, 1);
    let found = inception(&history);
    assert_eq!(found.criterion, InceptionCriterion::Stiffness);
    // e^−s is a hundredth of what it is in the middle of the first increment; the secant over a fifth of the slip
    // is that in its middle up to (0.22·5.2)²/24 = 5.5 % (the span ends at 5.2), so the slip up to 0.055.
    let exact = 100f64.ln() + 0.01;
    assert!((found.slip - exact).abs() < 0.055, "{} for {exact}", found.slip);
}

/// The stiffness falls to 10, 5 and 2 % of e^−0.01, that in the middle of the first increment, at −ln 0.1 and so on.
#[test]
fn other_thresholds_are_passed_earlier() {
    let history = stepwise();
    let others = inception(&history).by_other_thresholds(&history);
    for (found, share) in others.iter().zip(OTHER_STIFFNESS_SHARES) {
        let exact = 0.01 - share.ln();
        assert!((found.slip - exact).abs() < 0.055, "{share}: {} for {exact}", found.slip);
    }
    assert_eq!(others.len(), OTHER_STIFFNESS_SHARES.len());
    let without_stick = |state: &SlideState| SlideState { stick_fraction: 0.0, ..*state };
    let slipping: Vec<_> = history.iter().map(without_stick).collect();
    assert!(inception(&slipping).by_other_thresholds(&slipping).is_empty());
}

/// In the second step Q falls by a tenth within a tenth of the elastic slip, over two increments; slower, by less, in the first
/// step or at a reversal of the motion no fall is noticed.
#[test]
fn a_sudden_fall_of_a_later_step_is_noticed() {
    let at = |(step, slip, friction): (usize, f64, f64)| SlideState { step, ..contact(slip, friction, 0.0) };
    let history = |fall: [(f64, f64); 2], step: usize| {
        let [one, other] = fall;
        [(0, 0.0, 0.0), (0, 0.1, 0.1), (0, 2.0, 1.0), (step, one.0, one.1), (step, other.0, other.1)].map(at)
    };
    assert_eq!(sudden_fall(&history([(2.005, 0.96), (2.01, 0.9)], 1)), Some(1));
    assert_eq!(sudden_fall(&history([(2.005, 0.96), (2.01, 0.9)], 0)), None);
    assert_eq!(sudden_fall(&history([(2.005, 0.97), (2.01, 0.96)], 1)), None);
    assert_eq!(sudden_fall(&history([(2.5, 0.9), (3.0, 0.8)], 1)), None);
    assert_eq!(sudden_fall(&history([(1.995, 0.96), (1.0, -0.9)], 1)), None);
    // As the slip rate falls.
    let mut slower = history([(2.005, 0.96), (2.01, 0.9)], 1);
    let strengthening = [0.0, 0.2, 0.2, 0.15, 0.08];
    slower.iter_mut().zip(strengthening).for_each(|(state, value)| state.rate_strengthening = value);
    assert_eq!(sudden_fall(&slower), None);
    // After the reversal friction resists the other way, and falls there.
    let back = [(0, 0.0, 0.0), (0, 0.1, 0.1), (0, 2.0, 1.0), (1, 0.0, -1.0), (2, -0.01, -0.9)].map(at);
    assert_eq!(sudden_fall(&back), Some(2));
}
