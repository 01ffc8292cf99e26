//! The first run at the resolution that its companions ask for.

use std::sync::Arc;

use super::pressed::PressedMesh;
use super::task::{Run, Slid, Task};
use super::{Probe, SimulationError};
use crate::loading::slide::SlideFailure;
use crate::simulate::accuracy::error_budget::{AuxiliaryRuns, ErrorBudget};
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::scalars::Scalars;

/// A run and its companions on the coarse mesh.
pub(super) struct FirstRun {
    pub companions: Vec<Run>,
    pub resolution: Resolution,
    pub mesh: Arc<PressedMesh>,
    pub fine: Slid,
    pub scalars: Scalars,
    /// Nothing where a run did not finish.
    pub budget: Option<ErrorBudget>,
    pub notes: Vec<String>,
}

/// Places of the companions.
const COARSE: usize = 0;
const OTHER_SECTORS: usize = 1;

impl Task<'_> {
    /// The companions come first: they cost little, and tell how many sectors and increments the run
    /// needs; only its mesh is a guess.
    ///
    /// Where a contact outgrows its mesh, all is repeated on wider ones as long as there is room.
    /// `probe` is the first of the companions, if that was made.
    pub(super) fn first_run(
        &self,
        mut probe: Option<Probe>,
        progress: impl Fn(f64, &str) + Sync,
    ) -> Result<FirstRun, SimulationError> {
        /// Share of the companions in the progress.
        const COMPANIONS: f64 = 0.35;
        let mut start = self.pressed.resolution;
        let mut notes = Vec::new();
        loop {
            if let Some(wider) = self.wider(&start, probe.iter().map(|probe| &probe.slid), &mut notes) {
                (start, probe) = (wider, None);
                continue;
            }
            let companions = self.companions(&start, probe.take(), |done, standing| {
                progress(COMPANIONS * done, &format!("coarse mesh: {standing}"));
            })?;
            let slides = companions.iter().map(|(_, slid)| slid);
            if let Some(wider) = self.wider(&start, slides.clone(), &mut notes) {
                start = wider;
                continue;
            }
            let cancelled = |slid: &Slid| matches!(slid.failure, Some(SlideFailure::Cancelled));
            if slides.clone().any(cancelled) {
                return Ok(self.coarse_alone(companions, start.coarse(), notes));
            }
            let complete = slides.clone().all(|slid| slid.failure.is_none());
            let scalars: Vec<_> = companions.iter().map(|(mesh, slid)| self.scalars(mesh, slid)).collect();
            let coarser = start.coarse();
            let mut resolution = start;
            let mut budget = None;
            if let ([coarse, other_sectors, longer_steps, looser_solver], true) = (&scalars[..], complete) {
                let companions = AuxiliaryRuns { coarse, other_sectors, longer_steps, looser_solver };
                let beside_mesh = ErrorBudget::beside_mesh(&companions, &start, &coarser);
                let (_, parts) = beside_mesh.worst(coarse);
                resolution = start.refine_beside_mesh(&self.pressed.scene.numerics, &parts);
                budget = Some(beside_mesh.refined(&start, &resolution));
            }
            let slid = self.slide(&resolution, |done, standing| {
                progress(COMPANIONS + (1.0 - COMPANIONS) * done, standing);
            });
            let (mesh, fine) = match slid {
                Err(SimulationError::Cancelled { .. }) => {
                    return Ok(self.coarse_alone(companions, coarser, notes));
                }
                slid => slid?,
            };
            if let Some(wider) = self.wider(&start, [&fine].into_iter(), &mut notes) {
                start = wider;
                continue;
            }
            let fine_scalars = self.scalars(&mesh, &fine);
            let alike = if resolution.sectors == start.sectors { COARSE } else { OTHER_SECTORS };
            match &mut budget {
                Some(budget) if fine.failure.is_none() => {
                    budget.set_mesh(&fine_scalars, &scalars[alike], &resolution, &coarser);
                }
                _ => budget = None,
            }
            return Ok(FirstRun { companions, resolution, mesh, fine, scalars: fine_scalars, budget, notes });
        }
    }

    /// Stopped before there was a fine run: the coarse one is what there is.
    fn coarse_alone(&self, mut companions: Vec<Run>, resolution: Resolution, notes: Vec<String>) -> FirstRun {
        let (mesh, fine) = companions.swap_remove(COARSE);
        let scalars = self.scalars(&mesh, &fine);
        let fine = Slid { failure: Some(SlideFailure::Cancelled), ..fine };
        FirstRun { companions, resolution, mesh, fine, scalars, budget: None, notes }
    }

    /// A resolution with more room, where one of the slides has outgrown its mesh and the hemisphere
    /// has that room; what is done about it is added to `notes`.
    fn wider<'s>(
        &self,
        resolution: &Resolution,
        slides: impl Iterator<Item = &'s Slid>,
        notes: &mut Vec<String>,
    ) -> Option<Resolution> {
        let growth = slides.filter_map(Slid::outgrown).fold(0.0, f64::max);
        let wider = resolution.wider();
        if growth == 0.0 || !self.fits(&wider) {
            return None;
        }
        notes.push(format!(
            "repeated: the contact grew to {growth:.2} times its radius after the press, past the fine mesh, \
             which now has room for {:.2} times",
            wider.growth_zone
        ));
        Some(wider)
    }
}
