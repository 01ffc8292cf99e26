//! One slide at one resolution, from its press to its end or failure.

use std::sync::Arc;
use std::time::Instant;

use super::conditions::Conditions;
use super::messages::RunProgress;
use super::pressed::{Pressed, PressedMesh, press_error};
use super::run::Run;
use super::{SimulationError, Watch};
use crate::discretisation::collocation::Collocation;
use crate::heat::conduction::Conduction;
use crate::loading::body_fields::BodyFields;
use crate::loading::problem::Discretisation;
use crate::loading::recording::Recorder;
use crate::loading::slide::increments::inception_width;
use crate::loading::slide::{Motion, MotionInProgress, Slide, SlideFailure};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::steady::{LONGEST, SteadyState, has_gone_far_enough, has_to_go_on};
use crate::simulate::values::Values;
use crate::solver::timings::{Kernel, Timings};

impl Conditions<'_> {
    /// A slide from its press.
    pub(super) fn slide(
        &self,
        resolution: &Resolution,
        press: Arc<PressedMesh>,
        progress: Option<RunProgress>,
        watch: &dyn Watch,
    ) -> Result<Run, SimulationError> {
        let Pressed { problem, recording, .. } = self.pressed;
        let started = Instant::now();
        let discretisation =
            Discretisation::new(problem, press.size, Collocation::full(resolution.sectors), &|| {
                watch.cancelled()
            })
            .map_err(|e| press_error(e.into()))?;
        let mut slide = self.start(&press, &discretisation, resolution)?;
        slide.mechanics.timings.since(Kernel::Setup, started);
        if let Some(partition) = self.expected_partition() {
            slide.history[0].heat_partition = partition;
        }
        // Each mesh slides as far in units of its own contact radius.
        let radius = press.contact.radius(&press.contact.committed);
        slide.recorder = Recorder::new(recording, radius, &slide.history[0]);
        slide.mechanics.most_iterations = progress.map_or(usize::MAX, |progress| progress.most_iterations);
        slide.record_fields();
        let programme = self.programme.iter();
        let motions: Vec<Motion> = programme.map(|step| Motion::new(step, radius, &problem.units)).collect();
        let end = slide.run(&motions, &|| watch.cancelled(), |done, history| {
            if let Some(progress) = progress {
                let detail = progress.describe(&problem.units, history);
                watch.progress("slide", progress.at(done), &detail);
            }
        });
        slide.record_fields();
        let mesh = &discretisation.mesh;
        let values = Values::new(problem, &press.increments, &slide.history);
        let mut values = values.with_expected_rise(self.expected_rise());
        let effort = slide.mechanics.effort;
        values.residual = press.effort.residual + effort.residual;
        let mut run = Run {
            resolution: *resolution,
            values,
            steady: None,
            effort,
            timings: Timings::default(),
            history: slide.history.clone(),
            snapshots: std::mem::take(&mut slide.recorder.contact),
            body: BodyFields::new(mesh, std::mem::take(&mut slide.recorder.bodies), &problem.units),
            unknowns: mesh.field_length(3),
            cutbacks: slide.cutbacks,
            contact: slide.mechanics.contact.clone(),
            counterface: slide.heat.as_ref().and_then(|heat| heat.counterface.clone()),
            failure: None,
            press,
        };
        match end {
            Ok(Some(motion)) if progress.is_some_and(|progress| progress.goes_on) => {
                run.steady = self.go_on(&mut slide, motion, radius, watch);
            }
            end => run.failure = end.err(),
        }
        if run.failure.is_some() {
            run.values.forget_steady_friction();
        }
        run.timings = slide.mechanics.timings;
        run.timings.add(Kernel::Rest, started.elapsed().as_secs_f64() - run.timings.total());
        run.timings.add(Kernel::Press, run.press.seconds);
        Ok(run)
    }

    /// Goes on with the last motion, if it slides and its steady friction is not known, until it is; `radius` is that of the
    /// contact after the press. An increment that fails in the shortest length ends it.
    fn go_on(
        &self,
        slide: &mut Slide<'_>,
        motion: MotionInProgress,
        radius: f64,
        watch: &dyn Watch,
    ) -> Option<SteadyState> {
        let accuracy = self.pressed.numerics.accuracy;
        let end = slide.history.len() - 1;
        if !self.pressed.problem.interface.law.has_friction() || !slide.is_sliding() {
            return None;
        }
        if !has_to_go_on(&slide.history, accuracy) {
            return None;
        }
        slide.recorder = Recorder::default();
        let ended = slide.go_on(motion, LONGEST * radius, &|| watch.cancelled(), |history| {
            has_gone_far_enough(history, accuracy)
        });
        let outgrew = matches!(ended, Err(SlideFailure::OutgrewMesh { .. }));
        SteadyState::of_longer_slide(&slide.history, end, (radius, outgrew), accuracy)
    }

    /// The pressed state revolved to all angles.
    fn start(
        &self,
        press: &PressedMesh,
        discretisation: &Discretisation,
        resolution: &Resolution,
    ) -> Result<Slide<'_>, SimulationError> {
        let Pressed { problem, .. } = self.pressed;
        let mesh = &discretisation.mesh;
        let pressed = (&press.body, &press.contact, &press.displacement[..]);
        let mechanics = discretisation.revolve(problem, pressed, resolution.tolerance);
        let heat = match self.heat.is_coupled() {
            false => None,
            true => {
                let conduction = Conduction::new(mesh, problem.heat_capacity, self.thermal_sublayers)
                    .map_err(|e| press_error(e.into()))?;
                let conduction = conduction.with_properties(problem.thermal_properties.clone());
                Some(conduction.with_counterface(problem.counterface.clone()))
            }
        };
        let mut slide = Slide::new(problem, mechanics, heat, resolution.increment_growth);
        slide.inception_width = inception_width(self.softening_at_inception());
        slide.shears_without_limit = self.pressed.shears_without_limit;
        Ok(slide)
    }
}
