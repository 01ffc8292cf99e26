//! Sliding inception: the first state in which less than 1 % of the contact area sticks, or the tangential stiffness
//! dQ/ds is below 1 % of its first value, whichever comes first.
//!
//! Friction and load are those of that state. By the first criterion slip and G are those of full mobilisation of the
//! shear strength ([`super::mobilisation`]): an error of the slip appears in G up to 6.6 times, and the slip at which the last
//! points stick depends on mesh and angles.
//!
//! dQ/ds is the secant over a share of the slip ([`STIFFNESS_SPAN`]): in the short increments of the
//! inception bracket Q is not smooth, as single points begin to slip.

use super::energy_release::energy_release;
use super::mobilisation::slip_of_full_mobilisation;
use super::state::{NO_STICK, SlideState};
use crate::scene::fitted_constants::sliding_inception::STIFFNESS_SPAN;

/// Sliding has begun when dQ/ds is below this share of its first value.
const STIFFNESS_SHARE: f64 = 0.01;
/// Other thresholds; the spread is a part of the error.
const OTHER_STIFFNESS_SHARES: [f64; 3] = [0.1, 0.05, 0.02];

/// Stick area fraction by which is judged whether a contact sticks again.
const STICKS_AGAIN: f64 = 0.1;

/// Which of the two criteria of sliding inception was met first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InceptionCriterion {
    /// Less than 1 % of the contact area sticks.
    FullSlip,
    /// dQ/ds fell below 1 % of its initial value.
    Stiffness,
    /// Neither, up to the end of the slide.
    #[default]
    None,
}

/// Sliding inception, dimensionless.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inception {
    pub criterion: InceptionCriterion,
    pub slip: f64,
    pub friction: f64,
    pub load: f64,
    /// (work of the flat − change of elastic energy)/A.
    pub energy_release: f64,
    /// Uncertainty of friction between the two states around inception; of slip and G, 0 at full mobilisation.
    pub friction_bracket: f64,
    pub slip_bracket: f64,
    pub energy_bracket: f64,
}

/// Sliding inception of a slide.
pub fn inception(history: &[SlideState]) -> Inception {
    let first = inception_at(history, STIFFNESS_SHARE);
    let mobilised = match first.criterion {
        InceptionCriterion::FullSlip => slip_of_full_mobilisation(history),
        InceptionCriterion::Stiffness | InceptionCriterion::None => None,
    };
    let found = match mobilised {
        Some(slip) => {
            let energy_release = energy_release(history).value(slip);
            Inception { slip, energy_release, slip_bracket: 0.0, energy_bracket: 0.0, ..first }
        }
        None => first,
    };
    found.with_stick_slip(history)
}

/// Slips in the first motion between which the contact alternately sticks and slips: heat takes its strength faster than its
/// elasticity unloads it, or the interface hardens as it slips. Increments then decide when sliding begins. None if the stick
/// area falls for good.
pub fn stick_slip(history: &[SlideState]) -> Option<[f64; 2]> {
    let mut motion =
        history.iter().take_while(|state| state.step == 0).skip_while(|state| !state.is_along_motion());
    let sticks = |state: &SlideState| state.stick_fraction > STICKS_AGAIN;
    let first = motion.find(|state| !sticks(state))?;
    let last = motion.filter(|state| sticks(state)).last()?;
    Some([first.slip, last.slip])
}

/// Where the stick area fraction falls below [`NO_STICK`], or the secant stiffness over the last
/// [`STIFFNESS_SPAN`] of the slip falls below this share of the first; both interpolated between states.
pub fn inception_at(history: &[SlideState], stiffness_share: f64) -> Inception {
    let secant = |from: &SlideState, to: &SlideState| (to.friction - from.friction) / (to.slip - from.slip);
    // Slip in the middle of the span, and the stiffness.
    let mut stiffness = (0.0, if history.len() > 1 { secant(&history[0], &history[1]) } else { 0.0 });
    let first = stiffness.1;
    for n in 1..history.len() {
        let (before, now) = (history[n - 1], history[n]);
        if now.slides() && now.friction > 0.0 {
            let fallen = before.stick_fraction - now.stick_fraction;
            let share = if fallen > 0.0 { (before.stick_fraction - NO_STICK) / fallen } else { 1.0 };
            let slip = before.slip + share.clamp(0.0, 1.0) * (now.slip - before.slip);
            return Inception::at(history, slip, n, InceptionCriterion::FullSlip);
        }
        let far_enough = |from: &&SlideState| from.slip <= (1.0 - STIFFNESS_SPAN) * now.slip;
        let from = history[..n].iter().rfind(far_enough).unwrap_or(&history[0]);
        let spanned = (0.5 * (from.slip + now.slip), secant(from, &now));
        if spanned.1 < stiffness_share * first {
            let share = (stiffness.1 - stiffness_share * first) / (stiffness.1 - spanned.1);
            let slip = stiffness.0 + share.clamp(0.0, 1.0) * (spanned.0 - stiffness.0);
            return Inception::at(history, slip, n, InceptionCriterion::Stiffness);
        }
        stiffness = spanned;
    }
    let last = history.len() - 1;
    Inception::at(history, history[last].slip, last, InceptionCriterion::None)
}

impl Inception {
    /// Of a run without a slide or without friction.
    pub fn none(history: &[SlideState]) -> Self {
        let load = history.last().map_or(0.0, |state| state.load);
        Self { load, ..Self::default() }
    }

    /// Those by other thresholds of the stiffness, if it is the stiffness that decides.
    pub fn by_other_thresholds(&self, history: &[SlideState]) -> Vec<Inception> {
        match self.criterion {
            InceptionCriterion::Stiffness => {
                OTHER_STIFFNESS_SHARES.map(|share| inception_at(history, share)).into()
            }
            InceptionCriterion::FullSlip | InceptionCriterion::None => Vec::new(),
        }
    }

    /// With the uncertainties of a contact that alternately sticks and slips.
    fn with_stick_slip(self, history: &[SlideState]) -> Self {
        let Some([first, last]) = stick_slip(history) else { return self };
        let within = history.iter().filter(|state| (first..=last).contains(&state.slip));
        let release = energy_release(history);
        let distance = |value: f64, other: f64| (value - other).abs();
        let of_ends =
            |value: f64, at: &dyn Fn(f64) -> f64| distance(value, at(first)).max(distance(value, at(last)));
        Self {
            friction_bracket: within
                .map(|state| distance(self.friction, state.friction))
                .fold(self.friction_bracket, f64::max),
            slip_bracket: of_ends(self.slip, &|slip| slip).max(self.slip_bracket),
            energy_bracket: of_ends(self.energy_release, &|slip| release.value(slip))
                .max(self.energy_bracket),
            ..self
        }
    }

    /// At `slip`, somewhere between the states n − 1 and n.
    fn at(history: &[SlideState], slip: f64, n: usize, criterion: InceptionCriterion) -> Self {
        let state = between(history, slip);
        let (low, high) = (history[n.saturating_sub(1)], history[n]);
        let width = high.slip - low.slip;
        let share = match criterion {
            InceptionCriterion::FullSlip if width > 0.0 => uncertainty(&history[..=n], slip) / width,
            _ => 0.5,
        };
        let release = energy_release(&history[..=n]);
        Self {
            criterion,
            slip,
            friction: state.friction,
            load: state.load,
            energy_release: release.value(slip),
            friction_bracket: share * (high.friction - low.friction).abs(),
            slip_bracket: share * width,
            energy_bracket: share * (release.value(high.slip) - release.value(low.slip)).abs(),
        }
    }
}

/// Of the slip at which the stick area vanishes between the last two states: the difference from that which the two states
/// before it extrapolate to, at least a tenth of the interval and at most half of it. The stick area of a growing front is
/// nearly linear in the slip, so that both agree to second order.
fn uncertainty(history: &[SlideState], slip: f64) -> f64 {
    let [.., low, high] = history else { return 0.0 };
    let half = 0.5 * (high.slip - low.slip);
    let [.., earlier, _, _] = history else { return half };
    let fall = (earlier.stick_fraction - low.stick_fraction) / (low.slip - earlier.slip);
    if fall <= 0.0 {
        return half;
    }
    let extrapolated = low.slip + (low.stick_fraction - NO_STICK) / fall;
    (extrapolated.clamp(low.slip, high.slip) - slip).abs().clamp(0.2 * half, half)
}

/// History interpolated linearly in slip.
pub fn between(history: &[SlideState], slip: f64) -> SlideState {
    if history.len() < 2 {
        return history[0];
    }
    let after = history.partition_point(|i| i.slip < slip).clamp(1, history.len() - 1);
    let (a, b) = (history[after - 1], history[after]);
    let t = ((slip - a.slip) / (b.slip - a.slip)).clamp(0.0, 1.0);
    let mix = |x: f64, y: f64| x + t * (y - x);
    SlideState {
        slip,
        friction: mix(a.friction, b.friction),
        load: mix(a.load, b.load),
        area: mix(a.area, b.area),
        work: mix(a.work, b.work),
        elastic: mix(a.elastic, b.elastic),
        ..a
    }
}

#[cfg(test)]
mod tests {
    use tables::closed_forms::partial_slip::constant_shear;

    use super::*;

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
            let friction = 1.0 - (-slip).exp() - if n == fallen { 1e-3 } else { 0.0 };
            SlideState { slip, friction, load: 1.0, area: 1.0, stick_fraction: 1.0, ..SlideState::default() }
        };
        slips.iter().enumerate().map(state).collect()
    }

    /// Savkoor's contact of unit strength, radius and slip δ_s, which sticks at the edge for longer than in its middle: slip
    /// and G are those of the closed form, ∫Q ds = 1 − 4/(3π), friction that of the last point.
    #[test]
    fn slip_and_energy_are_those_of_full_mobilisation() {
        let mut history: Vec<SlideState> = Vec::new();
        for slip in
            [0.0, 0.05, 0.1, 0.15, 0.2, 0.26, 0.34, 0.44, 0.57, 0.72, 0.86, 0.93, 0.98, 1.1, 1.2, 1.21]
        {
            let friction = constant_shear::force_fraction(slip);
            let before = history.last().copied().unwrap_or_default();
            let work = before.work + 0.25 * (slip - before.slip) * (friction + before.friction);
            let stick_fraction = (1.0 - slip / 1.2).max(0.0);
            let state = SlideState { slip, friction, work, stick_fraction, ..SlideState::default() };
            history.push(SlideState { load: 2.0, area: 1.0, mobilised: friction, ..state });
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
            let at = |slip: f64| {
                let work = slip * slip;
                SlideState {
                    slip,
                    friction: slip,
                    work,
                    area: 1.0,
                    stick_fraction: fraction(slip),
                    ..SlideState::default()
                }
            };
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

    /// A contact whose stick area falls, recovers and falls again: any of the slips between may be its inception.
    #[test]
    fn a_contact_that_sticks_again_is_uncertain_by_the_slips_between() {
        let history = |fractions: [f64; 8]| -> Vec<SlideState> {
            let slips = [0.0, 0.3, 0.6, 0.9, 1.0, 1.1, 1.2, 1.5];
            let at = |(slip, stick_fraction): (f64, f64)| {
                let mobilised = 1.0 - stick_fraction;
                let (friction, work) = (mobilised, 0.25 * slip);
                SlideState {
                    slip,
                    friction,
                    work,
                    stick_fraction,
                    mobilised,
                    load: 1.0,
                    area: 1.0,
                    ..Default::default()
                }
            };
            slips.into_iter().zip(fractions).map(at).collect()
        };
        let steady = history([1.0, 0.7, 0.4, 0.1, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(stick_slip(&steady), None);
        let again = history([1.0, 0.7, 0.4, 0.05, 0.0, 0.3, 0.0, 0.0]);
        assert_eq!(stick_slip(&again), Some([0.9, 1.1]));
        let found = inception(&again);
        assert_eq!(found.criterion, InceptionCriterion::FullSlip);
        assert_eq!(found.slip_bracket, (found.slip - 0.9).abs().max((found.slip - 1.1).abs()));
        // Friction is interpolated to a stick area of 1 %, 0.99, and falls to 0.7.
        assert!((found.friction_bracket - 0.29).abs() < 1e-12, "{found:?}");
        // What sticks after another motion has begun is another inception.
        let mut stopped = again;
        stopped[5..].iter_mut().for_each(|state| state.step = 1);
        assert_eq!(stick_slip(&stopped), None);
    }

    /// All points slip radially in the first increment, and stick again before they slide.
    #[test]
    fn slip_of_the_tractions_of_the_press_is_no_inception() {
        let at = |(slip, stick_fraction, transverse): (f64, f64, f64)| SlideState {
            slip,
            friction: slip,
            load: 1.0,
            area: 1.0,
            stick_fraction,
            transverse,
            ..SlideState::default()
        };
        let history =
            [(0.0, 1.0, 1.0), (0.01, 0.0, 0.95), (0.4, 0.4, 0.6), (0.9, 0.11, 0.1), (1.0, 0.0, 0.01)].map(at);
        let found = inception(&history);
        assert_eq!(found.criterion, InceptionCriterion::FullSlip);
        assert!((found.slip - (0.9 + 0.1 / 1.1)).abs() < 1e-12, "{found:?}");
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
}
