//! Sliding inception: the first state in which less than 1 % of the contact area sticks, or the tangential stiffness
//! dQ/ds is below 1 % of its first value, whichever comes first.
//!
//! Friction and load are those of the largest Q up to that state: where heat reduces the strength of the interface before the last
//! points slip, Q has fallen by then, by an amount that depends on the increments. By the first criterion slip and G are those of
//! full mobilisation of the shear strength ([`super::mobilisation`]): an error of the slip appears in G up to 6.6 times, and the
//! slip at which the last points stick depends on mesh and angles. If Q falls faster than the contact unloads elastically,
//! −dQ/ds > dQ/ds(0), the contact slips as a whole (Scholz 1998, doi:10.1038/34097); slip and G are then those of the largest Q.
//!
//! dQ/ds is the secant over a share of the slip ([`STIFFNESS_SPAN`]): in the short increments of the
//! inception bracket Q is not smooth, as single points begin to slip.

mod peak;

use super::energy_release::energy_release;
use super::mobilisation::slip_of_full_mobilisation;
use super::state::{NO_STICK, SlideState};
use crate::scene::fitted_constants::sliding_inception::STIFFNESS_SPAN;
use peak::{falls_at_once, peak, rising};

/// Sliding has begun when dQ/ds is below this share of its first value.
const STIFFNESS_SHARE: f64 = 0.01;
/// Other thresholds; the spread is a part of the error.
const OTHER_STIFFNESS_SHARES: [f64; 3] = [0.1, 0.05, 0.02];

/// Stick area fraction by which is judged whether a contact sticks again.
const STICKS_AGAIN: f64 = 0.1;

/// Share of friction by which a fall faster than the elastic unloading is noticed.
const SUDDEN: f64 = 0.05;

/// The criterion of sliding inception that was met first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InceptionCriterion {
    /// Less than 1 % of the contact area sticks.
    FullSlip,
    /// dQ/ds fell below 1 % of its initial value.
    Stiffness,
    /// The contact slips as a whole: friction falls faster than the contact unloads elastically, −dQ/ds > dQ/ds(0).
    AtOnce,
    /// No sliding inception up to the end of the slide.
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
        _ => None,
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
/// area falls permanently.
pub fn stick_slip(history: &[SlideState]) -> Option<[f64; 2]> {
    let mut motion =
        history.iter().take_while(|state| state.step == 0).skip_while(|state| !state.is_along_motion());
    let sticks = |state: &SlideState| state.stick_fraction > STICKS_AGAIN;
    let first = motion.find(|state| !sticks(state))?;
    let last = motion.filter(|state| sticks(state)).last()?;
    Some([first.slip, last.slip])
}

/// First step of the programme after the first in which friction falls faster with slip than the contact unloads elastically, by
/// more than [`SUDDEN`] of itself and other than with the slip rate, as where heat reduces the strength of the interface at a higher
/// slip rate. The contact then slips as a whole (Scholz 1998, doi:10.1038/34097), by an amount that quasi-statics does not determine.
pub fn sudden_fall(history: &[SlideState]) -> Option<usize> {
    let [start, first, ..] = history else { return None };
    let stiffness = (first.friction - start.friction) / (first.slip - start.slip);
    // Heat changes friction with the root of time, so that any step begins with a fast fall, by little.
    let mut fallen = 0.0;
    let is_sudden = |pair: &&[SlideState]| {
        let friction = [0, 1].map(|n| pair[n].friction / (1.0 + pair[n].rate_strengthening));
        let (slip, fall) = (pair[1].slip - pair[0].slip, friction[0] - friction[1]);
        let resists = pair[0].friction * slip > 0.0;
        let is_fast = pair[1].step > 0 && resists && fall * slip.signum() > stiffness * slip.abs();
        fallen = if is_fast { fallen + fall.abs() / friction[0].abs() } else { 0.0 };
        fallen > SUDDEN
    };
    history.windows(2).find(is_sudden).map(|pair| pair[1].step)
}

/// Sliding inception where the stick area fraction falls below [`NO_STICK`], or the secant stiffness over the last
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
    /// Result for a run without a slide or without friction.
    pub fn none(history: &[SlideState]) -> Self {
        let load = history.last().map_or(0.0, |state| state.load);
        Self { load, ..Self::default() }
    }

    /// Sliding inception by other thresholds of the stiffness, if it is the stiffness that decides.
    pub fn by_other_thresholds(&self, history: &[SlideState]) -> Vec<Inception> {
        match self.criterion {
            InceptionCriterion::Stiffness => {
                OTHER_STIFFNESS_SHARES.map(|share| inception_at(history, share)).into()
            }
            _ => Vec::new(),
        }
    }

    /// This inception with the uncertainties of a contact that sticks again and then has more friction than before.
    fn with_stick_slip(self, history: &[SlideState]) -> Self {
        let Some([first, last]) = stick_slip(history) else { return self };
        let until = history.iter().position(|state| state.slip > last && state.slides());
        let again = history[..until.map_or(history.len(), |n| n + 1)]
            .iter()
            .skip_while(|state| state.slip < first || state.stick_fraction <= STICKS_AGAIN);
        let largest = again.map(|state| state.friction).fold(f64::NEG_INFINITY, f64::max);
        if largest <= self.friction + self.friction_bracket {
            return self;
        }
        let release = energy_release(history);
        let distance = |value: f64, other: f64| (value - other).abs();
        let of_ends =
            |value: f64, at: &dyn Fn(f64) -> f64| distance(value, at(first)).max(distance(value, at(last)));
        Self {
            friction_bracket: (largest - self.friction).max(self.friction_bracket),
            slip_bracket: of_ends(self.slip, &|slip| slip).max(self.slip_bracket),
            energy_bracket: of_ends(self.energy_release, &|slip| release.value(slip))
                .max(self.energy_bracket),
            ..self
        }
    }

    /// Inception at `slip`, somewhere between the states n − 1 and n.
    fn at(history: &[SlideState], slip: f64, n: usize, criterion: InceptionCriterion) -> Self {
        let state = between(history, slip);
        let (low, high) = (history[n.saturating_sub(1)], history[n]);
        let width = high.slip - low.slip;
        let share = match criterion {
            InceptionCriterion::FullSlip if width > 0.0 => uncertainty(&history[..=n], slip) / width,
            _ => 0.5,
        };
        let release = energy_release(&history[..=n]);
        let found = Self {
            criterion,
            slip,
            friction: state.friction,
            load: state.load,
            energy_release: release.value(slip),
            friction_bracket: share * (high.friction - low.friction).abs(),
            slip_bracket: share * width,
            energy_bracket: share * (release.value(high.slip) - release.value(low.slip)).abs(),
        };
        if criterion == InceptionCriterion::None {
            return found;
        }
        peak(&history[..=n], slip, found.friction).map_or(found, |peak| found.at_peak(&history[..=n], peak))
    }

    /// This inception with friction and load of the largest friction, state number `peak`; with its slip and G if the contact
    /// then slips as a whole. What they would grow by until the next state, as before, is the width of their uncertainty.
    fn at_peak(self, history: &[SlideState], peak: usize) -> Self {
        let (before, state, after) = (rising(history, peak), history[peak], history[peak + 1]);
        let share = 0.5 * (after.slip - state.slip) / (state.slip - before.slip);
        let friction_bracket = share * (state.friction - before.friction).max(0.0);
        let found = Self { friction: state.friction, load: state.load, friction_bracket, ..self };
        if !falls_at_once(history, peak) {
            return found;
        }
        let release = energy_release(&history[..=peak]);
        let [earlier, energy_release] = [before, state].map(|state| release.value(state.slip));
        Self {
            criterion: InceptionCriterion::AtOnce,
            slip: state.slip,
            energy_release,
            slip_bracket: 0.5 * (after.slip - state.slip),
            energy_bracket: share * (energy_release - earlier).abs(),
            ..found
        }
    }
}

/// Uncertainty of the slip at which the stick area vanishes between the last two states: the difference from that which the two
/// states before it extrapolate to, at least a tenth of the interval and at most half of it. The stick area of a growing front is
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
mod tests;
