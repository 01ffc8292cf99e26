//! The runs of one slip rate: the main run beside its auxiliary runs, with the presses that they need.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::conditions::Conditions;
use super::early::EarlyMain;
use super::ladder::Ladder;
use super::messages::{Note, RunProgress};
use super::pressed::{Pressed, PressedMesh, add_presses};
use super::run::Run;
use super::{SimulationError, Watch};
use crate::discretisation::threads::is_alone;
use crate::loading::slide::SlideFailure;
use crate::simulate::accuracy::error_budget::{AuxiliaryValues, ErrorBudget, RunValues, estimate};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::steady::SteadyState;

/// Shares of the progress of a slide at the end of the auxiliary runs and of the main run; then it may be
/// repeated more finely.
const AUXILIARY: f64 = 0.25;
const MAIN: f64 = 0.7;
/// Iterations of a finer run, over those expected, beyond which it ends, and the run before is the result.
const FURTHER_WORK: f64 = 2.0;

/// Iterations of a finer run beyond which it ends: those of the run `before` with increments of another growth.
/// Finer runs that arrive take up to 1.3 times those.
fn most_iterations(before: usize, growth_before: f64, growth: f64) -> usize {
    (FURTHER_WORK * growth_before / growth * before as f64) as usize
}

/// Values of all auxiliary runs; none where one did not finish.
fn auxiliary_values(runs: &[Run]) -> Option<AuxiliaryValues<'_>> {
    let [coarse, other_sectors, longer_steps, looser @ ..] = runs else { return None };
    runs.iter().all(|run| run.failure.is_none()).then_some(AuxiliaryValues {
        coarse: &coarse.values,
        other_sectors: &other_sectors.values,
        longer_steps: &longer_steps.values,
        looser_solver: looser.first().map(|run| &run.values),
    })
}

/// What follows the auxiliary runs.
enum Next {
    Main(Resolution),
    /// One of them has outgrown its mesh.
    Wider,
    /// The runs were stopped, or one could not begin.
    Failed(SimulationError),
}

/// Makes the runs of one slip rate.
pub(super) struct Runner<'a> {
    pub pressed: &'a Pressed,
    pub conditions: Conditions<'a>,
    pub watch: &'a dyn Watch,
    /// The presses of `pressed`, and those that this slip rate alone needs.
    presses: Mutex<Vec<Arc<PressedMesh>>>,
}

impl<'a> Runner<'a> {
    pub fn new(pressed: &'a Pressed, slip_rate: f64, watch: &'a dyn Watch) -> Result<Self, SimulationError> {
        let conditions = Conditions::new(pressed, slip_rate)?;
        Ok(Self { pressed, conditions, watch, presses: Mutex::new(pressed.meshes.clone()) })
    }

    /// The runs of the first resolution. Where a contact outgrows its mesh, all is repeated on wider ones as long as
    /// there is room; where that cannot begin, the runs before are the result.
    pub fn ladder(&self) -> Result<Ladder, SimulationError> {
        let mut ladder = self.runs_from(self.pressed.resolution)?;
        let mut notes = Vec::new();
        while let Some((radius_ratio, wider)) =
            self.wider(&ladder.start, ladder.auxiliary.iter().chain(&ladder.main))
        {
            match self.runs_from(wider) {
                Ok(mut wider) => {
                    wider.given_up += ladder.time_of_slides();
                    ladder = wider;
                }
                Err(error) => {
                    ladder.obstacle = Some(error);
                    break;
                }
            }
            notes.push(Note::Remeshed { radius_ratio, room: wider.growth_zone });
        }
        ladder.notes = notes;
        Ok(ladder)
    }

    /// The auxiliary runs of a resolution, and the main run with the sectors and increments that they require. If they are
    /// stopped, the result is the run that has come furthest.
    fn runs_from(&self, start: Resolution) -> Result<Ladder, SimulationError> {
        let progress = |from| RunProgress::new("", (from, MAIN));
        let early = EarlyMain::new(self.watch);
        let (auxiliary, begun) = rayon::join(
            || {
                let mut end = early.while_auxiliary();
                let runs = self.auxiliary_runs(start, &early.of_auxiliary());
                end.useful = matches!(runs, Ok((_, Next::Main(resolution))) if resolution == start);
                runs
            },
            || (is_alone() && early.begins()).then(|| self.run(&start, progress(0.0), &early)),
        );
        let (auxiliary, next) = auxiliary?;
        let time = |run: Option<Result<Run, _>>| run.and_then(Result::ok).map_or(0.0, |run| run.slide_time());
        let (main, given_up) = match (next, begun) {
            (Next::Main(resolution), Some(main)) if resolution == start => (Some(main), 0.0),
            (Next::Main(resolution), begun) => {
                let given_up = time(begun);
                (Some(self.run(&resolution, progress(AUXILIARY), self.watch)), given_up)
            }
            (Next::Failed(SimulationError::Cancelled { .. }), Some(Ok(mut main)))
                if main.is_ahead_of(&auxiliary[0]) =>
            {
                main.failure.get_or_insert(SlideFailure::Cancelled);
                (Some(Ok(main)), 0.0)
            }
            (Next::Failed(error), begun) => (Some(Err(error)), time(begun)),
            (Next::Wider, begun) => (None, time(begun)),
        };
        let mut ladder = match main.transpose() {
            Ok(Some(main)) => Ladder::new(start, main, auxiliary),
            other => Ladder::of_auxiliary(start, auxiliary, other.err()),
        };
        ladder.given_up = given_up;
        Ok(ladder)
    }

    /// The auxiliary runs of a resolution, and what follows.
    fn auxiliary_runs(
        &self,
        start: Resolution,
        watch: &dyn Watch,
    ) -> Result<(Vec<Run>, Next), SimulationError> {
        let [coarse, others @ ..] = start.auxiliary();
        let middle = 0.5 * AUXILIARY;
        let progress = |span, goes_on| RunProgress { goes_on, ..RunProgress::new("coarse mesh: ", span) };
        let mut runs = self.run_all(&[coarse], progress((0.0, middle), true), watch)?;
        // Without the first of them errors are unknown, and the others are not needed.
        if runs[0].failure.is_none() {
            match self.run_all(&others, progress((middle, AUXILIARY), false), watch) {
                Ok(others) => runs.extend(others),
                Err(error) => return Ok((runs, Next::Failed(error))),
            }
        }
        let budget = auxiliary_values(&runs).map(|values| ErrorBudget::other_than_mesh(values, &start));
        if budget.is_some_and(|budget| budget.steps_matter(&runs[0].values, &self.pressed.numerics)) {
            match self.run(&coarse.looser_solver(), progress((AUXILIARY, AUXILIARY), false), watch) {
                Ok(looser) => runs.push(looser),
                Err(error) => return Ok((runs, Next::Failed(error))),
            }
        }
        let next = if runs.iter().any(Run::is_cancelled) {
            Next::Failed(SimulationError::Cancelled { partial: None })
        } else if self.wider(&start, runs.iter()).is_some() {
            Next::Wider
        } else {
            Next::Main(self.main_resolution(&start, &runs))
        };
        Ok((runs, next))
    }

    /// Errors of the finest main run; none where a run did not finish.
    pub fn judge(&self, ladder: &Ladder) -> Option<ErrorBudget> {
        let run = ladder.result();
        let is_judged = run.failure.is_none() && ladder.has_main_run();
        let auxiliary = auxiliary_values(&ladder.auxiliary).filter(|_| is_judged)?;
        // That of the coarse mesh with as many sectors, if there is one.
        let [coarse, other_sectors, ..] = &ladder.auxiliary[..] else { return None };
        let has_as_many = other_sectors.resolution.sectors == run.resolution.sectors;
        let alike = if has_as_many { other_sectors } else { coarse };
        let pair = [run, ladder.coarse.as_ref().unwrap_or(alike)]
            .map(|run| RunValues { resolution: &run.resolution, values: &run.values });
        let modelling_error = self.conditions.modelling_error(run);
        let loading = &self.pressed.scene.loading;
        Some(estimate(
            &ladder.start,
            auxiliary,
            pair,
            &modelling_error,
            loading.interference,
            loading.control,
        ))
    }

    /// The resolution of the main run: that of the start, with more sectors and shorter increments where
    /// the auxiliary runs require them.
    fn main_resolution(&self, start: &Resolution, auxiliary: &[Run]) -> Resolution {
        let Some(values) = auxiliary_values(auxiliary) else { return *start };
        let (_, parts) = ErrorBudget::other_than_mesh(values, start).worst(values.coarse);
        start.refine_other_than_mesh(&self.pressed.numerics, &parts)
    }

    /// The contact radius over that after the press at which one of the runs left its mesh, and a resolution with more room, if
    /// the hemisphere has it.
    fn wider<'r>(
        &self,
        resolution: &Resolution,
        runs: impl Iterator<Item = &'r Run>,
    ) -> Option<(f64, Resolution)> {
        let radius_ratio = runs.filter_map(Run::outgrown).fold(0.0, f64::max);
        let wider = resolution.wider();
        (radius_ratio > 0.0 && self.conditions.fits(&wider)).then_some((radius_ratio, wider))
    }

    fn presses(&self) -> MutexGuard<'_, Vec<Arc<PressedMesh>>> {
        self.presses.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Time spent on presses other than that of the run, s.
    pub fn other_presses(&self, run: &Run) -> f64 {
        self.presses().iter().filter(|press| !Arc::ptr_eq(press, &run.press)).map(|press| press.seconds).sum()
    }

    /// Runs side by side; progress is that of the first, and none of the others goes on.
    fn run_all(
        &self,
        plan: &[Resolution],
        progress: RunProgress,
        watch: &dyn Watch,
    ) -> Result<Vec<Run>, SimulationError> {
        let presses = self.presses_of(plan, watch)?;
        let progress_of = |i: usize| (i == 0).then_some(progress);
        let runs = plan.par_iter().zip(presses).enumerate();
        runs.map(|(i, (resolution, press))| self.conditions.slide(resolution, press, progress_of(i), watch))
            .collect()
    }

    /// A main run finer than the one `before`, and one on its coarse mesh.
    pub fn finer(&self, resolution: &Resolution, before: &Run) -> Result<[Run; 2], SimulationError> {
        self.watch.progress("slide", MAIN, "finer");
        let growth = [&before.resolution, resolution].map(|resolution| resolution.increment_growth);
        let most_iterations = most_iterations(before.effort.iterations(), growth[0], growth[1]);
        let progress = RunProgress { most_iterations, ..RunProgress::new("finer: ", (MAIN, 1.0)) };
        let runs = self.run_all(&[*resolution, resolution.coarse()], progress, self.watch)?;
        Ok(runs.try_into().unwrap_or_else(|_| unreachable!("as many runs as planned")))
    }

    /// One run.
    pub fn run(
        &self,
        resolution: &Resolution,
        progress: RunProgress,
        watch: &dyn Watch,
    ) -> Result<Run, SimulationError> {
        let mut runs = self.run_all(std::slice::from_ref(resolution), progress, watch)?;
        Ok(runs.pop().expect("one run was planned"))
    }

    /// One run; on wider meshes as long as its contact outgrows them and there is room.
    pub fn run_with_room(
        &self,
        resolution: &Resolution,
        progress: RunProgress,
    ) -> Result<Run, SimulationError> {
        let mut run = self.run(resolution, progress, self.watch)?;
        loop {
            let wider = run.resolution.wider();
            if run.is_cancelled() || !run.lacks_room() || !self.conditions.fits(&wider) {
                return Ok(run);
            }
            match self.run(&wider, progress, self.watch) {
                Ok(wider) => run = wider,
                Err(error @ SimulationError::Cancelled { .. }) => return Err(error),
                // The run before is the result.
                Err(_) => return Ok(run),
            }
        }
    }

    /// The presses that slides at the resolutions of a plan start from.
    fn presses_of(
        &self,
        plan: &[Resolution],
        watch: &dyn Watch,
    ) -> Result<Vec<Arc<PressedMesh>>, SimulationError> {
        let plan: Vec<_> = plan.iter().map(|resolution| self.conditions.at_surface(resolution)).collect();
        let Pressed { problem, contact_radius, .. } = self.pressed;
        let mut presses = self.presses().clone();
        let known = presses.len();
        add_presses(&mut presses, problem, &plan, *contact_radius, watch)?;
        self.presses().extend_from_slice(&presses[known..]);
        let of = |resolution: &Resolution| presses.iter().find(|press| press.serves(resolution)).cloned();
        Ok(plan.iter().map(|resolution| of(resolution).expect("pressed before")).collect())
    }

    /// The steady state that the coarse mesh tells, with more room where its contact outgrew it before.
    pub fn steady_state(&self, ladder: &mut Ladder) -> Result<Option<SteadyState>, SimulationError> {
        let coarse = ladder.auxiliary.first().filter(|_| ladder.result().failure.is_none());
        let Some((steady, wider)) = coarse.and_then(|run| Some((run.steady?, run.resolution.wider()))) else {
            return Ok(None);
        };
        if !steady.lacks_room() || !self.conditions.fits(&wider) {
            return Ok(Some(steady));
        }
        let progress = RunProgress { goes_on: true, ..RunProgress::new("wider mesh: ", (1.0, 1.0)) };
        let found = match self.run(&wider, progress, self.watch) {
            Ok(run) if run.is_cancelled() => return Err(SimulationError::Cancelled { partial: None }),
            Err(error @ SimulationError::Cancelled { .. }) => return Err(error),
            Ok(run) => {
                ladder.given_up += run.slide_time();
                run.steady
            }
            Err(_) => None,
        };
        Ok(found.filter(|found| found.ratio.error < steady.ratio.error).or(Some(steady)))
    }
}

#[cfg(test)]
mod tests {
    use tables::quantity::Quantity;

    use crate::scene::Scene;
    use crate::scene::tests::of_preset;
    use crate::simulate::messages::Warning;
    use crate::simulate::outcome::ErrorSource;
    use crate::simulate::{SimulationError, Unwatched, press, simulate, slide};

    /// Copper on 6 elements, the auxiliary runs on 4.
    fn coarse_scene(accuracy: &str) -> Scene {
        let mesh = ["numerics.elements_per_radius=6", "numerics.sectors=4"];
        let loading = ["loading.interference=5", "loading.slip_rate=0", "loading.slip_distance=0.2"];
        of_preset("copper", &[&[accuracy], &mesh[..], &loading].concat())
    }

    /// Increments of half the growth are twice as many.
    #[test]
    fn a_finer_run_may_take_twice_the_work_expected() {
        assert_eq!(super::most_iterations(500, 0.3, 0.3), 1000);
        assert_eq!(super::most_iterations(500, 0.3, 0.15), 2000);
    }

    /// Where the main run cannot begin, the finished auxiliary run is the result, and the error says so.
    #[test]
    fn a_main_run_that_cannot_begin_leaves_the_auxiliary_run() {
        for accuracy in ["numerics.accuracy=0.5", "numerics.accuracy=0.001"] {
            let scene = coarse_scene(accuracy);
            let mut pressed = press(&scene, &Unwatched).unwrap();
            // The fine mesh is to be pressed again, and no mesh can be laid out for a contact as large as the asperity.
            pressed.meshes.remove(1);
            pressed.contact_radius = 1.0;
            let error = slide(&pressed, 0.0, &Unwatched).unwrap_err();
            let text = error.to_string();
            assert!(text.starts_with("the press did not converge at the mesh of the main run: "), "{text}");
            let saved =
                "the run before, complete, with 4 elements per contact radius and 4 sectors; numerics.";
            assert!(text.contains(saved), "{text}");
            let SimulationError::NotConverged { partial: Some(outcome), .. } = error else {
                panic!("{text}")
            };
            assert_eq!((outcome.account.elements_per_radius, outcome.account.sectors), (4, 4));
            assert!(outcome.steady || outcome.slide.len() > 10, "{}", outcome.slide.len());
            let is_unknown = outcome.scalars.iter().all(|(_, estimate)| estimate.error.is_nan());
            assert!(is_unknown, "{:?}", outcome.scalars);
            let no_main_run = Warning::NoMainRun { elements_per_radius: 4, sectors: 4 };
            for warning in [Warning::ErrorsUnknown, no_main_run] {
                assert!(outcome.account.warnings.contains(&warning), "{:?}", outcome.account);
            }
        }
    }

    /// The longer increments change friction by some 0.1 %.
    #[test]
    fn the_tolerance_is_told_apart_where_increments_matter() {
        let parts_at = |accuracy: &str| {
            let budget = simulate(&coarse_scene(accuracy), &Unwatched).unwrap().budget;
            [ErrorSource::Steps, ErrorSource::Solver].map(|source| budget.part(source, Quantity::Friction))
        };
        let [steps, solver] = parts_at("numerics.accuracy=0.2");
        assert!(steps > 0.0 && solver == 0.0, "{steps} {solver}");
        let [steps, solver] = parts_at("numerics.accuracy=0.001");
        assert!(solver > 0.0 && solver < 0.1 * steps, "{steps} {solver}");
    }
}
