//! True errors against the reported ones.

use std::collections::HashMap;

use tables::quantity::Quantity;

use super::{ELEMENTS, Record, Reported, Role, STEPS, scenes};
use crate::loading::problem::Problem;
use crate::simulate::values::Values;

/// Relative to the value (to the rise, for temperatures): a true error below this counts as covered, as neither the
/// error nor the estimate matters.
pub const NEGLIGIBLE: f64 = 5e-4;

/// One quantity of one scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    pub quantity: Quantity,
    /// Reported value, SI.
    pub value: f64,
    /// Scale that errors are relative to: the value, or the rise of temperature.
    pub scale: f64,
    pub reference: f64,
    /// The reported error.
    pub stated: f64,
}

impl Judged {
    /// Value − reference.
    pub fn error(&self) -> f64 {
        self.value - self.reference
    }

    /// |true error|/reported error.
    pub fn ratio(&self) -> f64 {
        self.error().abs() / self.stated
    }

    /// Whether the interval reaches the reference, or the error is too small to matter.
    pub fn is_covered(&self) -> bool {
        self.error().abs() <= self.stated.max(NEGLIGIBLE * self.scale)
    }
}

/// One scene with all its runs.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneReport {
    /// Position of the scene, see [`scenes::study_scene`].
    pub scene: usize,
    /// Without the quantities that its run does not determine.
    pub judged: Vec<Judged>,
}

/// Statistics of one quantity over all scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityReport {
    /// Mean of the relative true errors: the bias of the values.
    pub bias: f64,
    /// Mean of their sizes.
    pub size: f64,
    /// Median of their sizes, and the size that nine of ten do not exceed.
    pub sizes: [f64; 2],
    /// Median of the reported errors, relative.
    pub stated: f64,
    /// Share of true errors that the reported ones cover.
    pub covered: f64,
    /// Median, 95th percentile and largest ratio of true to reported error.
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
fn of_limit(refinement: usize, order: f64) -> f64 {
    1.0 / (1.0 - (refinement as f64).powf(-order))
}

/// The value that a share of them does not exceed.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1) as f64;
    values.get((share * last).round() as usize).copied().unwrap_or(f64::NAN)
}

impl Report {
    /// Report of the records of a journal.
    pub fn new(records: &[Record]) -> Self {
        let mut report = Self { scenes: Vec::new(), missing: Vec::new() };
        for scene in 0..scenes::COUNT {
            let of_scene: HashMap<Role, &Record> =
                records.iter().filter(|record| record.scene == scene).map(|r| (r.role, r)).collect();
            match judge(scene, &of_scene) {
                Ok(judged) => report.scenes.push(SceneReport { scene, judged }),
                Err(role) => {
                    let failure = of_scene.get(&role).and_then(|record| record.failure.clone());
                    let reason = failure.unwrap_or_else(|| "not run".into());
                    report.missing.push((scene, format!("{role:?}: {reason}")));
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

    /// Share of all true errors that the reported ones cover.
    pub fn covered(&self) -> f64 {
        let all = || self.scenes.iter().flat_map(|scene| &scene.judged);
        all().filter(|judged| judged.is_covered()).count() as f64 / all().count().max(1) as f64
    }

    pub fn of(&self, quantity: Quantity) -> QuantityReport {
        let all = self.scenes.iter().flat_map(|scene| &scene.judged);
        let chosen: Vec<&Judged> = all.filter(|judged| judged.quantity == quantity).collect();
        let of = |of: fn(&Judged) -> f64| -> Vec<f64> { chosen.iter().map(|judged| of(judged)).collect() };
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let size: fn(&Judged) -> f64 = |judged| judged.error().abs() / judged.scale;
        let ratios: Vec<f64> = of(Judged::ratio).into_iter().filter(|ratio| ratio.is_finite()).collect();
        QuantityReport {
            bias: mean(of(|judged| judged.error() / judged.scale)),
            size: mean(of(size)),
            sizes: [0.5, 0.9].map(|share| quantile(of(size), share)),
            stated: quantile(of(|judged| judged.stated / judged.scale), 0.5),
            covered: mean(of(|judged| f64::from(u8::from(judged.is_covered())))),
            ratios: [0.5, 0.95, 1.0].map(|share| quantile(ratios.clone(), share)),
        }
    }
}

/// The quantities of a scene from its runs; or the run that is missing.
fn judge(scene: usize, records: &HashMap<Role, &Record>) -> Result<Vec<Judged>, Role> {
    let study = scenes::study_scene(scene);
    let scene = study.scene();
    let problem = Problem::new(&scene);
    let values = |role: Role| {
        let run = records.get(&role).and_then(|record| record.run_history.as_ref()).ok_or(role)?;
        Ok(Values::new(&problem, &run.press, &run.slide))
    };
    let reported: &Reported =
        records.get(&Role::Reported).and_then(|record| record.reported.as_ref()).ok_or(Role::Reported)?;
    let base = values(Role::Base)?;
    let finer = [
        (values(Role::MoreElements)?, of_limit(ELEMENTS, 1.5)),
        (values(Role::MoreSectors)?, 1.0),
        (values(Role::ShorterSteps)?, of_limit(STEPS, 1.0)),
    ];
    let of = |(n, &quantity): (usize, &Quantity)| {
        let here = base.value(quantity);
        let change: f64 = finer.iter().map(|(finer, factor)| factor * (finer.value(quantity) - here)).sum();
        let value = reported.values[n];
        let start = if quantity.is_temperature() { scene.loading.temperature } else { 0.0 };
        let scale = if quantity.is_temperature() { (value - start).max(1.0) } else { value.abs() };
        Judged { quantity, value, scale, reference: here + change, stated: reported.errors[n] }
    };
    let determined = |judged: &Judged| judged.value.is_finite() && judged.stated.is_finite();
    Ok(study.judged().iter().enumerate().map(of).filter(determined).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_cover_a_share_of_the_true_errors() {
        let judged = |quantity, error: f64, stated: f64| Judged {
            quantity,
            value: 2.0,
            scale: 2.0,
            reference: 2.0 - 2.0 * error,
            stated: 2.0 * stated,
        };
        let judged = vec![
            judged(Quantity::Mu, -0.03, 0.01),
            judged(Quantity::Mu, 0.01, 0.02),
            judged(Quantity::Load, 0.001, 0.04),
            // Neither matters.
            judged(Quantity::Load, 4e-4, 1e-5),
        ];
        let report = Report { scenes: vec![SceneReport { scene: 0, judged }], missing: Vec::new() };
        let [load, mu] = [Quantity::Load, Quantity::Mu].map(|quantity| report.of(quantity));
        assert_eq!((report.covered(), load.covered, mu.covered), (0.75, 1.0, 0.5));
        assert!((mu.bias + 0.01).abs() < 1e-12 && (mu.size - 0.02).abs() < 1e-12, "{mu:?}");
        assert!(
            (mu.ratios[2] - 3.0).abs() < 1e-12 && (load.sizes[1] - 0.001).abs() < 1e-12,
            "{mu:?} {load:?}"
        );
    }
}
