//! Speed against error: one scene on a sequence of meshes, its errors relative to the extrapolated limit. Uses
//! simulate like any caller. Chapter "Speed against error" of the book.

mod figure;
mod report_file;
mod words;

use std::time::Instant;

use tables::law::Estimate;
use tables::quantity::{Quantity, Scalars};

pub use figure::{PANELS, figure};
pub use report_file::{TITLE, write};
pub use words::{in_words, table};

use crate::scene::{Kinematics, Scene};
use crate::simulate::accuracy::error_budget::CONTROLLED;
use crate::simulate::outcome::{Account, MAIN, Outcome};
use crate::simulate::{SimulationError, Watch, find_what_is_open, press, simulate, slide_refined};

/// Quantities whose convergence is shown.
pub const SHOWN: [Quantity; 7] = MAIN;
/// n_c of the finest mesh is a multiple of this: the others are 1/4, 1/3, 1/2 and 2/3 of it.
pub const DIVISOR: usize = 12;
/// Default of the finest n_c.
pub const FINEST: usize = 24;

/// One run with its cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Whether its resolution is what the scene chooses, and not one of the sweep.
    pub chosen: bool,
    pub elements_per_radius: usize,
    pub sectors: usize,
    pub steps: usize,
    /// Wall-clock time with auxiliary runs, s.
    pub wall_time: f64,
    /// Processor time of all threads, s.
    pub cpu_time: f64,
    /// Values with their estimated errors.
    pub scalars: Scalars,
}

/// Limit that a quantity converges to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    pub value: f64,
    /// Uncertainty of the limit: its distance from the finest run.
    pub uncertainty: f64,
    /// Order in the element size that the runs at n/4, n/2 and n show, if they do.
    pub order: Option<f64>,
}

/// The sweep, coarsest first, the chosen resolution last.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// Relative, of the scene.
    pub accuracy: f64,
    /// Initial, K: errors of temperatures are relative to their rise.
    pub temperature: f64,
    pub runs: Vec<Run>,
    /// Limits in the order of [`SHOWN`].
    pub limits: Vec<Limit>,
}

impl Convergence {
    /// Runs the scene on meshes up to `finest` elements per radius, a multiple of [`DIVISOR`], and
    /// at its chosen resolution.
    ///
    /// ```no_run
    /// use asperity::studies::convergence::{Convergence, FINEST, in_words};
    ///
    /// let scene = asperity::read_scene("scene.toml".as_ref(), &[])?;
    /// println!("{}", in_words(&Convergence::sweep(&scene, FINEST, &asperity::Unwatched)?));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sweep(scene: &Scene, finest: usize, watch: &dyn Watch) -> Result<Self, SimulationError> {
        if let Some((found, _)) = find_what_is_open(scene, watch)? {
            return Self::sweep(&found, finest, watch);
        }
        let mut runs = Vec::new();
        let (chosen, account) = timed(true, || simulate(scene, watch))?;
        for share in [3, 4, 6, 8, 12] {
            let mut scene = scene.clone();
            scene.model.kinematics =
                if account.finite_strain { Kinematics::Finite } else { Kinematics::Small };
            scene.numerics.elements_per_radius = Some(finest * share / DIVISOR);
            // No refinement: increments are to be the same on all meshes.
            let slide = || slide_refined(&press(&scene, watch)?, scene.loading.slip_rate, 0, watch);
            runs.push(timed(false, slide)?.0);
        }
        let limits =
            SHOWN.map(|quantity| limit([0, 2, 4].map(|level: usize| runs[level].scalars[quantity].value)));
        runs.push(chosen);
        let (accuracy, temperature) = (scene.numerics.accuracy, scene.loading.temperature);
        Ok(Self { accuracy, temperature, runs, limits: limits.to_vec() })
    }

    pub fn limit(&self, quantity: Quantity) -> Limit {
        let position = SHOWN.iter().position(|known| *known == quantity).expect("one of those shown");
        self.limits[position]
    }

    /// |value − limit| and its estimate, relative to the limit (of a temperature: to its rise).
    pub fn errors(&self, run: &Run, quantity: Quantity) -> (f64, f64) {
        let limit = self.limit(quantity).value;
        let scale = match quantity.is_temperature() {
            true => (limit - self.temperature).abs(),
            false => limit.abs(),
        };
        let Estimate { value, error } = run.scalars[quantity];
        // Without heat a temperature has no rise, and no error.
        let relative = |error: f64| if error == 0.0 { 0.0 } else { error / scale };
        (relative((value - limit).abs()), relative(error))
    }

    /// Largest error of the quantities controlled by the accuracy, over its allowance.
    pub fn worst_error(&self, run: &Run) -> f64 {
        CONTROLLED
            .iter()
            .map(|&quantity| self.errors(run, quantity).0 / quantity.allowance())
            // A value that is no number has no bound.
            .fold(0.0, |largest: f64, error| if error.is_nan() { f64::INFINITY } else { largest.max(error) })
    }

    /// The run as the scene chooses it.
    pub fn chosen(&self) -> &Run {
        self.runs.last().expect("the chosen resolution is always run")
    }
}

/// Richardson's limit of values on meshes n/4, n/2 and n.
fn limit([first, second, third]: [f64; 3]) -> Limit {
    /// Order of a square-root edge; taken where the values show no order.
    const EXPECTED: f64 = 1.5;
    const ORDERS: (f64, f64) = (0.5, 3.0);
    let order = ((second - first) / (third - second)).log2();
    let shown = (ORDERS.0..=ORDERS.1).contains(&order).then_some(order);
    let change = (third - second) / (2f64.powf(shown.unwrap_or(EXPECTED)) - 1.0);
    Limit { value: third + change, uncertainty: change.abs(), order: shown }
}

fn timed(
    chosen: bool,
    work: impl FnOnce() -> Result<Outcome, SimulationError>,
) -> Result<(Run, Account), SimulationError> {
    let (begun, cpu) = (Instant::now(), cpu_time());
    let Outcome { account, scalars, .. } = work()?;
    let (wall_time, cpu_time) = (begun.elapsed().as_secs_f64(), cpu_time() - cpu);
    let Account { elements_per_radius, sectors, steps, .. } = account;
    Ok((Run { chosen, elements_per_radius, sectors, steps, wall_time, cpu_time, scalars }, account))
}

/// Processor time of all threads of the process so far, s.
fn cpu_time() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limit_of_a_sequence_of_known_order_is_exact() {
        for order in [1.0, 1.5, 2.0] {
            let at = |n: f64| 3.0 + 0.2 * n.powf(-order);
            let limit = limit([at(1.0), at(2.0), at(4.0)]);
            assert!((limit.value - 3.0).abs() < 1e-12);
            assert!((limit.order.unwrap() - order).abs() < 1e-9);
        }
    }

    #[test]
    fn a_sequence_that_shows_no_order_has_none() {
        assert_eq!(limit([1.0, 1.1, 1.05]).order, None);
        let constant = limit([298.0; 3]);
        assert_eq!((constant.value, constant.uncertainty, constant.order), (298.0, 0.0, None));
    }
}
