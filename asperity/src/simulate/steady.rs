//! Steady friction: the value that μ tends to as the slide goes on.
//!
//! The contact is a heat source at rest in the asperity. Its temperature rise approaches that of the steady state as
//! 1/√t (Carslaw & Jaeger 1959, section 10.4), and so does the strength of the interface:
//!
//! μ(s) = μ_∞ + c/√s,   μ_∞ = 2μ(s) − μ(s/4)
//!
//! While heat has not yet diffused through the contact, Fo = κt/a² < 4 at s, the rise grows as √t at most, and a change by
//! Δμ from s/4 to s is one by up to 2Δμ/√Fo from s to the steady state. Friction that falls ends between its present
//! value and zero.
//!
//! Most slides end before they are steady. The first auxiliary run therefore goes on beyond its end until the uncertainty by
//! its length is small beside the accuracy; μ_∞ is then of least squares over the last states. Where the contact outgrows the
//! mesh before, a run with more room goes on too. The steady friction of all runs is their own friction at the end of the
//! slide times the ratio of both in the run that went on. The other scalars are those at the end of the slide.

use std::f64::consts::PI;

use tables::quantity::{COVERAGE_FACTOR, Estimate};

use crate::loading::inception::between;
use crate::loading::state::SlideState;

/// Longest slide in which the steady state is sought, over the contact radius after the press.
pub const LONGEST: f64 = 1000.0;
/// Share of the accuracy up to which the uncertainty by the length of a slide does not matter.
const SHARE_OF_ACCURACY: f64 = 0.5;
/// Uncertainty of the change of friction to the steady state on the coarse mesh, over that change.
const OF_COARSE_MESH: f64 = 0.1;
/// Relative uncertainty of the steady friction that is worth a further run.
const WORTH_A_RUN: f64 = 0.1;
/// First slip of the states of a fit, over the last.
const WINDOW: f64 = 1.0 / 16.0;
/// Least Fourier number at which the uncertainty of a fit holds: before, it depends on √t over more than its window.
const LEAST_FOURIER: f64 = 0.1;

/// μ_∞ of a slide up to its last state. The uncertainty is the change from there to the steady state, and the difference
/// to the value of a slide half as long: thermal expansion changes friction with the logarithm of slip,
/// which the two cover for a tenfold slip.
pub fn steady_friction(history: &[SlideState]) -> Estimate {
    let Some(last) = history.last() else { return Estimate::UNKNOWN };
    let mu = |slip: f64| between(history, slip).mu();
    let tends_to = |slip: f64| 2.0 * mu(slip) - mu(0.25 * slip);
    let value = tends_to(last.slip);
    bounded(last, mu(last.slip), value, [value - tends_to(0.5 * last.slip), 0.0])
}

/// The states of the last step of the programme that slides, with slip and time from its start.
pub fn last_slip(history: &[SlideState]) -> Vec<SlideState> {
    let moved = |&n: &usize| history[n].slip != history[n - 1].slip;
    let step = (1..history.len()).rev().find(moved).map_or(0, |n| history[n].step);
    let start = history.iter().rposition(|state| state.step < step).unwrap_or(0);
    let (slip, time) = (history[start].slip, history[start].time);
    let within = history[start..].iter().take_while(|state| state.step <= step);
    within.map(|&i| SlideState { slip: (i.slip - slip).abs(), time: i.time - time, ..i }).collect()
}

/// Whether a slide has to go on for its steady friction to be known to a share of the `accuracy`.
pub fn has_to_go_on(history: &[SlideState], accuracy: f64) -> bool {
    let latest = last_slip(history);
    !is_known(steady_friction(&latest), &latest, accuracy)
}

/// Whether a slide has gone on far enough: its steady friction is known, now and at half of its slip.
pub fn has_gone_far_enough(history: &[SlideState], accuracy: f64) -> bool {
    let latest = last_slip(history);
    let slip = latest.last().map_or(0.0, |last| last.slip);
    let half = latest.iter().take_while(|state| state.slip <= 0.5 * slip).count();
    let is_known_of = |states| fitted_friction(states).is_some_and(|found| is_known(found, states, accuracy));
    is_known_of(&latest) && is_known_of(&latest[..half])
}

fn is_known(steady: Estimate, history: &[SlideState], accuracy: f64) -> bool {
    let now = history.last().map_or(0.0, SlideState::mu);
    steady.error <= SHARE_OF_ACCURACY * accuracy * now.abs()
}

/// Steady friction by a slide that went on beyond its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyState {
    /// μ_∞ over the friction at the end of the slide.
    pub ratio: Estimate,
    /// Slip to which the slide went on, over the contact radius after the press.
    pub slip: f64,
    /// Slip from which on friction was within the accuracy of μ_∞; infinite where it was not by the end.
    pub level: f64,
    /// Whether the contact outgrew its mesh there.
    outgrew_mesh: bool,
}

impl SteadyState {
    /// Steady state of a slide that went on beyond the slip of its state `end`, with the contact `radius` after the press and
    /// whether it outgrew its mesh, and the `accuracy` of friction; none where heat has not diffused through the contact. As on
    /// the coarse mesh of the auxiliary runs, a share of the change to the steady state is uncertain.
    pub fn of_longer_slide(
        history: &[SlideState],
        end: usize,
        (radius, outgrew_mesh): (f64, bool),
        accuracy: f64,
    ) -> Option<Self> {
        let latest = last_slip(history);
        let end = latest[end + latest.len() - history.len()].slip;
        let steady = fitted_friction(&latest)?;
        let is_off = |state: &&SlideState| (state.mu() / steady.value - 1.0).abs() > accuracy;
        let last_off = latest.iter().rposition(|state| is_off(&state));
        let level =
            latest.get(last_off.map_or(0, |n| n + 1)).map_or(f64::INFINITY, |state| state.slip / radius);
        let ratio = steady.over(Line::through(&latest, (0.25 * end, 4.0 * end), end)?.at(NOW));
        let error = ratio.error + OF_COARSE_MESH * (ratio.value - 1.0).abs();
        let slip = latest.last()?.slip / radius;
        ratio.value.is_finite().then_some(Self {
            ratio: Estimate { error, ..ratio },
            slip,
            level,
            outgrew_mesh,
        })
    }

    /// Whether it is so uncertain that a slide with more room for its contact to grow is worth its time.
    pub fn lacks_room(&self) -> bool {
        self.outgrew_mesh && self.ratio.error > WORTH_A_RUN && self.slip < 0.5 * LONGEST
    }
}

/// μ_∞ by least squares over the states of the last part of a slide, whose friction scatters as the contact edge passes
/// from ring to ring.
fn fitted_friction(history: &[SlideState]) -> Option<Estimate> {
    let last = history.last()?;
    let of = |end: f64| Line::through(history, (WINDOW * end, end), end);
    let (line, half) = (of(last.slip)?, of(0.5 * last.slip)?);
    let steady = line.at(STEADY);
    let others = [steady.value - half.at(STEADY).value, steady.error];
    let found = bounded(last, line.at(NOW).value, steady.value, others);
    fourier_number(last).is_none_or(|fourier| fourier >= LEAST_FOURIER).then_some(found)
}

/// √(end/s) of the steady state and of the end of a slide.
const STEADY: f64 = 0.0;
const NOW: f64 = 1.0;

/// μ as a linear function of x = √(end/s), by least squares.
struct Line {
    /// Means of x and μ.
    middle: (f64, f64),
    slope: f64,
    /// Mean square of x − its mean.
    width: f64,
    /// Variance of the mean of μ by the scatter of the states.
    variance: f64,
}

impl Line {
    /// Through the states of full slip, at least four, with slips in a range.
    fn through(history: &[SlideState], (from, to): (f64, f64), end: f64) -> Option<Self> {
        let is_meant = |state: &&SlideState| state.slides() && (from..=to).contains(&state.slip);
        let states = history.iter().filter(is_meant);
        let points: Vec<_> = states.map(|state| ((end / state.slip).sqrt(), state.mu())).collect();
        let n = points.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
        let (x, y) = (mean(&|point| point.0), mean(&|point| point.1));
        let width = mean(&|point| (point.0 - x).powi(2));
        let slope = mean(&|point| (point.0 - x) * (point.1 - y)) / width;
        let residual = mean(&|point| (point.1 - y - slope * (point.0 - x)).powi(2));
        (points.len() >= 4).then_some(Self { middle: (x, y), slope, width, variance: residual / (n - 2.0) })
    }

    /// Value with the half-width of its 95 % interval by the scatter of the states.
    fn at(&self, x: f64) -> Estimate {
        let from_middle = x - self.middle.0;
        let uncertainty = (self.variance * (1.0 + from_middle * from_middle / self.width)).sqrt();
        Estimate { value: self.middle.1 + self.slope * from_middle, error: COVERAGE_FACTOR * uncertainty }
    }
}

/// κt/a² at a state; none without heat, where friction does not depend on time.
fn fourier_number(state: &SlideState) -> Option<f64> {
    (state.area > 0.0 && state.heat_in != 0.0)
        .then(|| PI * state.time / state.area)
        .filter(|&fourier| fourier > 0.0)
}

/// The steady value to which friction tends from that in the state `last`, with its uncertainty by the change to come and
/// by other causes.
fn bounded(last: &SlideState, now: f64, value: f64, [length, scatter]: [f64; 2]) -> Estimate {
    let early = fourier_number(last).map_or(1.0, |fourier| (2.0 / fourier.sqrt()).max(1.0));
    let found = Estimate::with_errors(value, [early * (value - now), length, scatter]);
    match value / now {
        share if share < 0.0 => Estimate { value: 0.5 * now, error: 0.5 * now.abs() },
        share if share < 1.0 => {
            Estimate { error: found.error.min(value.abs().max((now - value).abs())), ..found }
        }
        _ => found,
    }
}

#[cfg(test)]
mod tests {
    use tables::quantity::Quantity;

    use super::*;
    use crate::scene::tests::of_preset;
    use crate::simulate::{Unwatched, simulate};

    /// μ of a slip, at slips that grow by a tenth.
    fn slide(end: f64, mu: impl Fn(f64) -> f64) -> Vec<SlideState> {
        let slips = (0..).map(|n| 1e-3 * 1.1f64.powi(n)).take_while(|slip| *slip < end).chain([end]);
        slips
            .map(|slip| SlideState { slip, load: 2.0, friction: 2.0 * mu(slip), ..SlideState::default() })
            .collect()
    }

    /// With heat, at a Fourier number at its end.
    fn heated(mut history: Vec<SlideState>, fourier: f64) -> Vec<SlideState> {
        let end = history.last().unwrap().slip;
        for state in &mut history {
            (state.area, state.heat_in, state.time) = (PI, 1.0, fourier * state.slip / end);
        }
        history
    }

    #[test]
    fn friction_of_a_source_at_rest_is_extrapolated() {
        let found = steady_friction(&slide(20.0, |slip| 0.1 + 0.05 / slip.sqrt()));
        // Linear between states a tenth apart: up to 3/32 of 0.01 of the transient part.
        assert!((found.value - 0.1).abs() < 1e-4, "{found:?}");
        assert!((found.error - 0.05 / 20f64.sqrt()).abs() < 3e-4, "{found:?}");
    }

    /// Before heat has diffused through the contact.
    #[test]
    fn friction_that_falls_with_the_square_root_of_slip_is_not_steady() {
        let history = slide(2.0, |slip| 0.3 - 0.01 * (slip / 2.0).sqrt());
        // Up to Fo = 1 it falls to 0.2.
        let found = steady_friction(&heated(history, 0.01));
        assert!((found.value - 0.2).abs() < found.error, "{found:?}");
    }

    /// It cannot fall below zero, nor rise again; also after a reversal.
    #[test]
    fn friction_that_falls_ends_between_its_present_value_and_zero() {
        for direction in [1.0, -1.0] {
            let of = |fall: f64| {
                let history = slide(2.0, |slip| direction * (0.3 - fall * (slip / 2.0).sqrt()));
                steady_friction(&heated(history, 1e-4))
            };
            // 2 × 0.2 − 0.25 and 2 × 0.12 − 0.21; then half of the present value.
            for (fall, value, error, tolerance) in
                [(0.1, 0.15, 0.15, 1e-3), (0.18, 0.03, 0.09, 1e-3), (0.25, 0.025, 0.025, 1e-12)]
            {
                let found = of(fall);
                let off = (found.value - direction * value).abs().max((found.error - error).abs());
                assert!(off < tolerance, "{found:?}");
            }
        }
    }

    /// In the middle of a disc source at rest (Carslaw & Jaeger 1959, section 10.5); over the steady rise.
    fn rise_over_steady(fourier: f64) -> f64 {
        let x = 0.5 / fourier.sqrt();
        let ierfc = (-x * x).exp() / PI.sqrt() - x * libm::erfc(x);
        2.0 * fourier.sqrt() * (1.0 / PI.sqrt() - ierfc)
    }

    /// Also where friction scatters, as that of a contact whose edge passes from ring to ring.
    #[test]
    fn the_steady_friction_of_a_disc_source_is_within_the_uncertainty_of_the_fit() {
        let mut errors = Vec::new();
        for (fourier, scatter) in
            [(0.1, 0.0), (0.25, 0.0), (1.0, 0.0), (4.0, 0.0), (64.0, 0.0), (1.0, 0.005), (64.0, 0.005)]
        {
            let end = 100.0;
            let history = slide(end, |slip| {
                let sign = if (slip.ln() / 1.1f64.ln()).round() % 2.0 == 0.0 { 1.0 } else { -1.0 };
                (0.3 - 0.15 * rise_over_steady(fourier * slip.max(1e-9) / end)) * (1.0 + sign * scatter)
            });
            let found = fitted_friction(&heated(history, fourier)).unwrap();
            assert!((found.value - 0.15).abs() < found.error, "Fo = {fourier}: {found:?}");
            errors.push(found.error);
        }
        assert!(errors[1..5].is_sorted_by(|a, b| a > b) && errors[4] < 0.04 * 0.15, "{errors:?}");
        assert!(errors[6] > errors[4] && errors[6] < 0.05 * 0.15, "{errors:?}");
    }

    #[test]
    fn steady_friction_of_a_short_slide_is_that_of_a_long_one() {
        let of = |slip_distance: &str| {
            let changes = [
                slip_distance,
                "loading.interference=16",
                "loading.slip_rate=10",
                "counterface.preset=steel-4340",
                "counterface.elastic=false",
                "numerics.accuracy=0.05",
            ];
            simulate(&of_preset("steel-4340", &changes), &Unwatched).unwrap().scalars
        };
        let [short, long] = ["loading.slip_distance=2", "loading.slip_distance=200"].map(of);
        let [steady, present] = [short[Quantity::MuSteady], short[Quantity::Mu]];
        let later = long[Quantity::Mu];
        assert!((steady.value - later.value).abs() < steady.error + later.error, "{steady:?} {later:?}");
        // What friction falls by in between.
        assert!(present.value - later.value > 1.5 * steady.error, "{present:?} {steady:?} {later:?}");
    }

    #[test]
    fn a_steady_slide_has_no_uncertainty() {
        let found = steady_friction(&slide(2.0, |_| 0.3));
        assert!((found.value - 0.3).abs() < 1e-15 && found.error < 1e-15);
    }

    #[test]
    fn friction_that_falls_with_the_logarithm_of_slip_is_covered_for_a_tenfold_slip() {
        let mu = |slip: f64| 0.3 - 0.02 * (1.0 + slip).ln();
        let found = steady_friction(&slide(20.0, mu));
        assert!((found.value - mu(200.0)).abs() < found.error, "{found:?}, {}", mu(200.0));
    }
}
