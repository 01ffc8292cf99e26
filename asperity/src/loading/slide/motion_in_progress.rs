//! A motion of the flat in progress: its increments one after the other.

use super::increments::{InceptionBracket, Predictor, StepControl};
use super::{Advance, Attempt, MOST_FAILURES, Slide, SlideFailure};
use crate::loading::state::SlideState;
use crate::solver::StopRequest;

/// The present motion, so far as it is done.
#[derive(Debug)]
pub struct MotionInProgress {
    /// Step of the programme.
    step: usize,
    /// Displacement of the flat at its start.
    start: f64,
    /// Slip of the motions before.
    path: f64,
    control: StepControl,
    /// The state before the last increment, and what was done by then.
    before: (Predictor, f64),
    /// Distance, or time of a hold.
    done: f64,
    /// Increments that failed after one that was taken.
    failures: usize,
    /// Whether the last one was taken.
    taken: bool,
}

impl MotionInProgress {
    pub fn has_arrived(&self) -> bool {
        self.done >= self.control.distance() * (1.0 - 1e-9)
    }

    /// Share of the motion that is done.
    pub fn share(&self) -> f64 {
        self.done / self.control.distance()
    }
}

impl Slide<'_> {
    /// The present motion before its first increment, as the step `step` of the programme, after slip along `path`.
    pub(super) fn begin(&self, step: usize, path: f64) -> MotionInProgress {
        MotionInProgress {
            step,
            start: self.last().slip,
            path,
            control: self.step_control(),
            before: (self.predictor(), 0.0),
            done: 0.0,
            failures: 0,
            taken: true,
        }
    }

    /// Whether the present motion is a slip in which the contact slides.
    pub fn is_sliding(&self) -> bool {
        self.motion.direction() != 0.0 && self.last().slides()
    }

    /// Goes on with the last motion, up to `distance` in all, until the history `is_enough`, which is asked after each
    /// increment, or increments fail again and again.
    pub fn go_on(
        &mut self,
        mut motion: MotionInProgress,
        distance: f64,
        stop: &StopRequest,
        is_enough: impl Fn(&[SlideState]) -> bool,
    ) -> Result<(), SlideFailure> {
        /// Slides that can go on need no more.
        const MOST_CUTBACKS: usize = 5;
        motion.control.extend(distance);
        let most = self.cutbacks + MOST_CUTBACKS;
        while !motion.has_arrived() && self.cutbacks < most && !is_enough(&self.history) {
            self.attempt(&mut motion, stop)?;
        }
        Ok(())
    }

    /// Attempts the next increment; after a failure it will be a shorter one.
    pub(super) fn attempt(
        &mut self,
        motion: &mut MotionInProgress,
        stop: &StopRequest,
    ) -> Result<(), SlideFailure> {
        if stop() {
            return Err(SlideFailure::Cancelled);
        }
        let (present, done) = (self.motion, motion.done);
        let slides = present.direction() != 0.0;
        let stop_at = self.recorder.next_slip().filter(|_| slides).map(|slip| slip - motion.path);
        let next = motion.control.next(done, stop_at);
        let committed = self.predictor();
        let contact_fraction = self.mechanics.contact.contact_fraction.clone();
        let to = motion.start + present.direction() * next;
        let guess = match motion.control.bracket() {
            // What changes in a hold decays: extrapolated over ever longer increments, what the solver's tolerance leaves
            // would grow.
            None if !slides => committed.clone(),
            // Nothing to extrapolate from at the start and after a hold or a reversal, where the contact sticks.
            None if done == 0.0 && !self.has_begun => self.sticking(to).unwrap_or_else(|_| committed.clone()),
            None => Predictor::between((&motion.before.0, motion.before.1), (&committed, done), next),
            Some(end) => Predictor::between((&committed, done), (&end.predictor, end.slip), next),
        };
        let advance = Advance {
            to,
            dt: present.time(next - done),
            seconds: present.seconds(next - done, &self.problem.units),
            slip_rate: self.slip_rate_after(next),
            wide: slides && motion.control.is_wide(next - done, next),
        };
        let attempt = self.step(motion.step, advance, guess, stop);
        let taken_before = std::mem::replace(&mut motion.taken, attempt.is_ok());
        match attempt {
            Ok(Attempt::Taken) => {
                (motion.before, motion.done) = ((committed, done), next);
                motion.control.taken(next, self.last().stick_fraction, self.has_begun || !slides);
                let now = self.history.last().expect("stepped");
                if self.recorder.is_due(motion.path + if slides { next } else { 0.0 }, now) {
                    self.record_fields();
                }
            }
            Ok(Attempt::PastInception(predictor)) => {
                self.mechanics.restore(committed.displacement, contact_fraction);
                motion.control.past_inception(done, InceptionBracket { slip: next, predictor });
            }
            Err(failure) => {
                self.mechanics.restore(committed.displacement, contact_fraction);
                motion.failures += usize::from(taken_before);
                self.cut_back(motion, failure)?;
            }
        }
        Ok(())
    }

    /// Shortens the next increment after a failed one.
    fn cut_back(&mut self, motion: &mut MotionInProgress, failure: SlideFailure) -> Result<(), SlideFailure> {
        if !failure.allows_cut_back() {
            return Err(failure);
        }
        self.cutbacks += 1;
        let distorted = self.distorted();
        if distorted.is_some() && self.shears_without_limit || !motion.control.cut_back() {
            return Err(distorted.unwrap_or(failure));
        }
        match motion.failures {
            failures if failures < MOST_FAILURES => Ok(()),
            failures => Err(SlideFailure::Discontinuous { failures, last: failure.into() }),
        }
    }
}
