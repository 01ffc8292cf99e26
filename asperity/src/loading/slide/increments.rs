//! Step control: lengths of the increments of a slide, their predictor, and the bracket of sliding
//! inception.
//!
//! An increment is at most a share of the slip so far, in proportion to Γ (`increment_growth`), and while the stick area falls
//! at most a share of the way to where it will vanish: in a long increment the points that begin to slip are not as hot as at
//! its end, and the others stick too long. The increment in which sliding begins is halved until the states before and after
//! inception are close; then the increments before it are taken up again.

use crate::loading::press::extrapolate;

/// First increment in units of the characteristic length of the motion, for [`REFERENCE_GROWTH`].
const FIRST_INCREMENT: f64 = 0.05;
/// Number of increments at least, for [`REFERENCE_GROWTH`]. With 12 instead of 24 of them μ changes by at most
/// 0.48 % in slides between 10 and 100 ω_c.
const LEAST_INCREMENTS: f64 = 16.0;
/// Γ that the numbers above are for.
const REFERENCE_GROWTH: f64 = 0.15;
/// Largest increment over the slip so far, over Γ, while points stick. With this, [`FIRST_INCREMENT`] and [`APPROACH`] G is
/// 0.5 % (mean size; nine of ten 1.2 %) from its value in increments a quarter as long, in the 85 slides of the study of
/// effectivity.
const WHILE_STICKING: f64 = 0.7;
/// Largest part of the way to sliding inception, as the fall of the stick area foretells it, that an increment takes, for
/// a Γ of twice [`REFERENCE_GROWTH`]. Without it the reported error of G of aluminium at 0.19 ω_c and 3 m/s on 30 elements
/// per contact radius is 2.9 % in place of 1.0 %, and G 0.2 % smaller.
const APPROACH: f64 = 0.5;
/// Largest increment over the slip so far, over Γ, once the contact slides. The effect is less than 0.08 % on friction and
/// 0.02 % on the temperature rise in slides between 0.1 and 100 ω_c.
const WHILE_SLIDING: f64 = 2.0;
/// Width of the increment in which sliding begins, relative to the slip, of an interface that does not soften before. In
/// shorter ones the last points slip so fast that their temperature peaks even where conduction is fast (Fo = 1e6).
pub const INCEPTION_WIDTH: f64 = 0.01;
/// Largest width of that increment.
const WIDEST_INCEPTION: f64 = 0.05;
/// Shortest increment, in units of the characteristic length of the motion.
const SHORTEST: f64 = 1e-6;

/// Predictor of a step, extrapolated from the last states.
#[derive(Clone, Debug)]
pub struct Predictor {
    pub displacement: Vec<f64>,
    pub interference: f64,
    /// Position of the contact edge at each angle, see [`crate::interface::contact::Contact::edges`].
    pub edges: Vec<f64>,
    /// Elevation of the flat at each contact point, see [`crate::interface::contact::PointState`].
    pub elevation: Vec<[f64; 2]>,
}

impl Predictor {
    /// Linear extrapolation of two states to the slip `next`.
    pub fn between((before, slip_before): (&Self, f64), (now, slip): (&Self, f64), next: f64) -> Self {
        let on = |before: &[f64], now: &[f64]| extrapolate(before, now, slip_before, slip, next);
        Self {
            displacement: on(&before.displacement, &now.displacement),
            interference: on(&[before.interference], &[now.interference])[0],
            edges: on(&before.edges, &now.edges),
            elevation: on(before.elevation.as_flattened(), now.elevation.as_flattened())
                .as_chunks()
                .0
                .to_vec(),
        }
    }
}

/// Upper end of the bracket of sliding inception: a state in which the contact slides.
#[derive(Debug)]
pub struct InceptionBracket {
    pub slip: f64,
    pub predictor: Predictor,
}

/// Width of the increment in which sliding begins, relative to the slip, for an interface that is expected to lose the
/// share `softening` of its strength before: the last points slip together as it softens.
pub fn inception_width(softening: f64) -> f64 {
    (0.5 * softening).clamp(INCEPTION_WIDTH, WIDEST_INCEPTION)
}

/// Chooses the increments of one slide.
#[derive(Debug)]
pub struct StepControl {
    distance: f64,
    /// Characteristic length of the motion, in a hold a time (`Slide::scale`).
    scale: f64,
    increment_growth: f64,
    /// Shortest increment while the contact sticks, but for the bracket of sliding inception.
    least: f64,
    /// Shortest increment in which sliding inception is bracketed.
    finest: f64,
    /// Width of the increment in which sliding begins, relative to the slip.
    inception_width: f64,
    /// The next increment.
    advance: f64,
    /// The last increment attempted.
    attempted: f64,
    /// Increment taken up again after sliding inception.
    usual: f64,
    bracket: Option<InceptionBracket>,
    /// Slip and stick area fraction of the last state.
    before: (f64, f64),
}

impl StepControl {
    pub fn new(distance: f64, scale: f64, increment_growth: f64, inception_width: f64) -> Self {
        let least = FIRST_INCREMENT * increment_growth / REFERENCE_GROWTH * scale;
        let advance = least.min(distance / LEAST_INCREMENTS);
        let finest = (0.1 * least).min(0.1 * advance);
        let (attempted, usual) = (advance, advance);
        Self {
            distance,
            scale,
            increment_growth,
            least,
            finest,
            inception_width,
            advance,
            attempted,
            usual,
            bracket: None,
            before: (0.0, 1.0),
        }
    }

    /// Whether an increment of length `increment` to the slip `slip` is too wide to hold sliding inception.
    pub fn is_wide(&self, increment: f64, slip: f64) -> bool {
        increment > (self.inception_width * slip).max(self.finest) * (1.0 + 1e-9)
    }

    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Goes on to another distance.
    pub fn extend(&mut self, distance: f64) {
        self.distance = distance;
    }

    pub fn bracket(&self) -> Option<&InceptionBracket> {
        self.bracket.as_ref()
    }

    /// Slip at the end of the next increment, at most `stop`; the last two are of one length.
    pub fn next(&mut self, slip: f64, stop: Option<f64>) -> f64 {
        let (left, advance) = (self.distance - slip, self.advance);
        self.attempted =
            if left < 1.5 * advance { if left <= advance { left } else { 0.5 * left } } else { advance };
        let next = if left <= self.attempted { self.distance } else { slip + self.attempted };
        match stop.filter(|stop| *stop < next) {
            Some(stop) => {
                self.attempted = stop - slip;
                stop
            }
            None => next,
        }
    }

    /// The increment to `slip` was taken.
    pub fn taken(&mut self, slip: f64, stick_fraction: f64, slides: bool) {
        let approach = self.approach(slip, stick_fraction);
        self.before = (slip, stick_fraction);
        self.bracket.take_if(|bracket| bracket.slip <= slip);
        self.advance = match &self.bracket {
            Some(bracket) => self.bisect(slip, bracket),
            None => {
                let growth = self.increment_growth * if slides { WHILE_SLIDING } else { WHILE_STICKING };
                let most = (growth * slip)
                    .max(self.least)
                    .min(self.distance / LEAST_INCREMENTS * self.increment_growth / REFERENCE_GROWTH);
                let usual = (2.0 * self.advance.max(self.usual)).min(most);
                if slides { usual } else { usual.min(approach) }
            }
        };
    }

    /// Length of an increment that stops short of sliding inception.
    fn approach(&self, slip: f64, stick_fraction: f64) -> f64 {
        let (slip_before, fraction_before) = self.before;
        let fallen = fraction_before - stick_fraction;
        if fallen <= 0.0 {
            return f64::INFINITY;
        }
        let left = stick_fraction * (slip - slip_before) / fallen;
        let part = (APPROACH * self.increment_growth / (2.0 * REFERENCE_GROWTH)).min(1.0);
        (part * left).max(self.inception_width * slip).max(self.finest)
    }

    /// The contact slides at the end of the increment from `slip`.
    pub fn past_inception(&mut self, slip: f64, bracket: InceptionBracket) {
        if self.bracket.is_none() {
            self.usual = 0.5 * self.attempted;
        }
        self.advance = self.bisect(slip, &bracket);
        self.bracket = Some(bracket);
    }

    /// Halves the increment after a failure; false if it is already at its lower limit.
    pub fn cut_back(&mut self) -> bool {
        self.usual = 0.0;
        self.advance = 0.5 * self.attempted;
        self.advance >= SHORTEST * self.scale
    }

    /// Half of the way to the bracket's end, or all of it once that is narrow enough.
    fn bisect(&self, slip: f64, bracket: &InceptionBracket) -> f64 {
        let left = bracket.slip - slip;
        if self.is_wide(left, bracket.slip) { 0.5 * left } else { left }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stick area that falls linearly to 0 at the slip 1, in increments of the default accuracy and of a quarter of their
    /// growth: each stops short of inception by half (seven eighths) of the way at least, until that is 1 % of the slip.
    #[test]
    fn inception_is_approached_from_stick() {
        for (growth, part, most) in [(0.3, 0.5, 22), (0.075, 0.125, 85)] {
            let mut control = StepControl::new(20.0, 1.0, growth, INCEPTION_WIDTH);
            let (mut slip, mut count) = (0.0, 0);
            loop {
                let next = control.next(slip, None);
                count += 1;
                // The first increment has no fall before it.
                let limit = (part * (1.0 - slip)).max(INCEPTION_WIDTH * slip).max(control.finest);
                assert!(count == 1 || next - slip <= limit * (1.0 + 1e-9), "{growth}: {slip} to {next}");
                slip = next;
                if slip >= 1.0 {
                    break;
                }
                control.taken(slip, 1.0 - slip, false);
            }
            assert!(slip < 1.0 + INCEPTION_WIDTH && count <= most, "{growth}: {count} to {slip}");
            control.taken(slip, 0.0, true);
            assert!(control.next(slip, None) - slip > 1.5 * INCEPTION_WIDTH);
        }
    }
}
