//! True errors against their estimates.

use std::collections::HashMap;

use tables::quantity::Quantity;

use super::{Record, Role, WORKING_ELEMENTS, scenes};
use crate::loading::problem::Problem;
use crate::scene::Scene;
use crate::simulate::accuracy::error_budget::{AuxiliaryRuns, CONTROLLED, ErrorSource, RunValues, estimate};
use crate::simulate::accuracy::modelling_error::ModellingError;
use crate::simulate::accuracy::resolution::Resolution;
use crate::simulate::outcome::MAIN;
use crate::simulate::values::Values;

/// Quantities that are judged.
pub const JUDGED: [Quantity; 7] = MAIN;
/// Ratios of true to estimated error at which an estimate is effective.
pub const EFFECTIVE: (f64, f64) = (0.2, 1.5);
/// Relative to the value (to the rise, for temperatures): below this neither an error nor an
/// estimate matters.
pub const NEGLIGIBLE: f64 = 5e-4;

/// One quantity of one scene.
///
/// ```
/// use asperity::studies::effectivity::Judged;
/// use tables::quantity::Quantity;
///
/// // By mesh, angles, increments, solver and model: the mesh errs by 2 % of the value, 3 % are estimated.
/// let judged = Judged {
///     quantity: Quantity::Mu,
///     value: 0.3,
///     scale: 0.3,
///     parts: [0.006, 0.0, 0.0, 0.0, 0.0],
///     estimates: [0.008, 0.0, 0.001, 0.0, 0.0],
/// };
/// assert!((judged.ratio() - 2.0 / 3.0).abs() < 1e-12 && judged.is_effective());
/// // Ten times the true error is no more informative than none.
/// assert!(!Judged { estimates: [0.06, 0.0, 0.0, 0.0, 0.0], ..judged }.is_effective());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    pub quantity: Quantity,
    /// At the working resolution, SI.
    pub value: f64,
    /// What errors are relative to: the value, or the rise of temperature.
    pub scale: f64,
    /// Value − reference by source, in the order of [`ErrorSource::ALL`].
    pub parts: [f64; 5],
    /// Estimated, by source.
    pub estimates: [f64; 5],
}

impl Judged {
    /// Value − reference.
    pub fn error(&self) -> f64 {
        self.parts.iter().sum()
    }

    pub fn estimate(&self) -> f64 {
        self.estimates.iter().sum()
    }

    /// |true error|/estimate.
    pub fn ratio(&self) -> f64 {
        self.error().abs() / self.estimate()
    }

    /// Neither too large nor too small, or both too small to matter.
    pub fn is_effective(&self) -> bool {
        let small = self.error().abs().max(self.estimate()) <= NEGLIGIBLE * self.scale;
        small || (EFFECTIVE.0..=EFFECTIVE.1).contains(&self.ratio())
    }
}

/// One scene with all its runs.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneReport {
    /// Position in [`scenes::SCENES`].
    pub scene: usize,
    pub judged: Vec<Judged>,
}

impl SceneReport {
    /// Largest relative true error over the largest relative estimate among the quantities that an accuracy is asked
    /// of. The two need not be of the same quantity.
    pub fn worst_ratio(&self) -> f64 {
        let largest = |of: fn(&Judged) -> f64| {
            let asked = self.judged.iter().filter(|judged| CONTROLLED.contains(&judged.quantity));
            asked.map(|judged| of(judged) / judged.scale).fold(0.0, f64::max)
        };
        largest(|judged| judged.error().abs()) / largest(Judged::estimate)
    }
}

/// Statistics of one quantity over all scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityReport {
    pub quantity: Quantity,
    /// Mean of the relative true errors: the bias of the values.
    pub bias: f64,
    /// Mean of their sizes.
    pub size: f64,
    /// Share of effective estimates.
    pub share: f64,
    /// Share of true errors no larger than the estimate.
    pub covered: f64,
    /// Least, median and largest ratio of true error to estimate.
    pub ratios: [f64; 3],
}

/// The study.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    pub scenes: Vec<SceneReport>,
    /// Scenes that lack a run, with the reason.
    pub missing: Vec<(usize, String)>,
}

/// Error over the change by a refinement, at an order.
fn of_limit(refinement: f64, order: f64) -> f64 {
    1.0 / (1.0 - refinement.powf(-order))
}

impl Report {
    /// Of the records of a journal.
    pub fn new(records: &[Record]) -> Self {
        let mut report = Self { scenes: Vec::new(), missing: Vec::new() };
        for (position, &(preset, interference, slip_rate)) in scenes::SCENES.iter().enumerate() {
            let scene = scenes::scene(preset, interference, slip_rate, WORKING_ELEMENTS);
            let problem = Problem::new(&scene);
            let runs: HashMap<Role, Values> = records
                .iter()
                .filter(|record| record.scene == position)
                .filter_map(|record| {
                    let sample = record.sample.as_ref()?;
                    Some((record.role, Values::new(&problem, &sample.press, &sample.history)))
                })
                .collect();
            match Role::ALL.into_iter().find(|role| !runs.contains_key(role)) {
                None => {
                    let judged = judge(&runs, &scene);
                    report.scenes.push(SceneReport { scene: position, judged });
                }
                Some(role) => {
                    let record = records.iter().find(|r| r.scene == position && r.role == role);
                    let reason = record.and_then(|r| r.failure.clone()).unwrap_or_else(|| "not run".into());
                    report.missing.push((position, format!("{role:?}: {reason}")));
                }
            }
        }
        report
    }

    /// The part of the study with the scenes at the given positions.
    pub fn part(&self, positions: std::ops::Range<usize>) -> Self {
        let is_in = |scene: usize| positions.contains(&scene);
        Self {
            scenes: self.scenes.iter().filter(|scene| is_in(scene.scene)).cloned().collect(),
            missing: self.missing.iter().filter(|missing| is_in(missing.0)).cloned().collect(),
        }
    }

    pub fn all(&self) -> impl Iterator<Item = &Judged> {
        self.scenes.iter().flat_map(|scene| &scene.judged)
    }

    /// Share of effective estimates among all.
    pub fn share(&self) -> f64 {
        share(self.all())
    }

    /// Number of scenes whose worst error is neither too large nor too small for their worst estimate.
    pub fn effective_scenes(&self) -> usize {
        let effective = |scene: &&SceneReport| (EFFECTIVE.0..=EFFECTIVE.1).contains(&scene.worst_ratio());
        self.scenes.iter().filter(effective).count()
    }

    /// Share of true errors that are at most 1.5 times the estimate: the coverage.
    pub fn covered(&self) -> f64 {
        let (mut covered, mut all) = (0u32, 0u32);
        for judged in self.all() {
            all += 1;
            covered += u32::from(judged.is_effective() || judged.ratio() <= EFFECTIVE.1);
        }
        f64::from(covered) / f64::from(all.max(1))
    }

    pub fn of(&self, quantity: Quantity) -> QuantityReport {
        let chosen = || self.all().filter(move |judged| judged.quantity == quantity);
        let mut ratios: Vec<f64> = chosen().map(Judged::ratio).filter(|ratio| ratio.is_finite()).collect();
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let last = ratios.len().saturating_sub(1) as f64;
            ratios.get((share * last).round() as usize).copied().unwrap_or(f64::NAN)
        };
        let mean = |of: fn(&Judged) -> f64| chosen().map(of).sum::<f64>() / chosen().count().max(1) as f64;
        QuantityReport {
            quantity,
            bias: mean(|judged| judged.error() / judged.scale),
            size: mean(|judged| judged.error().abs() / judged.scale),
            share: share(chosen()),
            covered: mean(|judged| f64::from(u8::from(judged.error().abs() <= judged.estimate()))),
            ratios: [at(0.0), at(0.5), at(1.0)],
        }
    }
}

fn share<'a>(judged: impl Iterator<Item = &'a Judged>) -> f64 {
    let (mut effective, mut all) = (0u32, 0u32);
    for judged in judged {
        all += 1;
        effective += u32::from(judged.is_effective());
    }
    f64::from(effective) / f64::from(all.max(1))
}

fn judge(runs: &HashMap<Role, Values>, scene: &Scene) -> Vec<Judged> {
    let auxiliary = AuxiliaryRuns {
        coarse: &runs[&Role::Coarse],
        other_sectors: &runs[&Role::CoarseSectors],
        longer_steps: &runs[&Role::CoarseSteps],
        looser_solver: &runs[&Role::CoarseSolver],
    };
    let working = &runs[&Role::Working];
    let resolution = Resolution::choose(&scene.numerics);
    let start = scene.loading.temperature;
    let runs_of_mesh = [
        RunValues { resolution: &resolution, values: working },
        RunValues { resolution: &resolution.coarse(), values: auxiliary.coarse },
    ];
    let budget = estimate(&resolution, &auxiliary, runs_of_mesh, &ModellingError::default());
    let of = |quantity: Quantity| {
        let here = working.value(quantity);
        let against = |role: Role| here - runs[&role].value(quantity);
        Judged {
            quantity,
            value: here,
            scale: if quantity.is_temperature() { (here - start).max(1.0) } else { here.abs() },
            parts: [
                against(Role::FourTimesElements) * of_limit(4.0, 1.5),
                against(Role::MoreSectors),
                against(Role::QuarterSteps) * of_limit(4.0, 1.0),
                0.0,
                0.0,
            ],
            estimates: ErrorSource::ALL.map(|source| budget.part(source, quantity)),
        }
    };
    JUDGED.into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_error_of_a_scene_is_over_its_worst_estimate() {
        let judged = |quantity, error: f64, estimate: f64| Judged {
            quantity,
            value: 2.0,
            scale: 2.0,
            parts: [2.0 * error, 0.0, 0.0, 0.0, 0.0],
            estimates: [0.0, 2.0 * estimate, 0.0, 0.0, 0.0],
        };
        let scene = SceneReport {
            scene: 0,
            judged: vec![
                judged(Quantity::Mu, -0.03, 0.01),
                judged(Quantity::Load, 0.001, 0.04),
                // It is not controlled by the accuracy.
                judged(Quantity::EnergyRelease, 0.5, 0.1),
            ],
        };
        assert!((scene.worst_ratio() - 0.75).abs() < 1e-12);
        let report = Report { scenes: vec![scene], missing: Vec::new() };
        assert_eq!((report.effective_scenes(), report.share()), (1, 0.0));
        let [load, mu] = [Quantity::Load, Quantity::Mu].map(|quantity| report.of(quantity));
        assert_eq!((load.covered, mu.covered), (1.0, 0.0));
        assert!((load.bias - 0.001).abs() < 1e-15 && (mu.bias + 0.03).abs() < 1e-15 && mu.size == -mu.bias);
    }
}
