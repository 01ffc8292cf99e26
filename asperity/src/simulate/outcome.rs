//! Outcome of a simulation. SI units; forces, areas and energies of the whole asperity.

use tables::quantity::{History, Quantity, Scalars, State};

use crate::loading::inception::inception_at;
use crate::loading::state::SlideState;
use crate::scene::Scene;
use crate::simulate::accuracy::error_budget::CONTROLLED;

pub use crate::interface::contact::Status as ContactStatus;
pub use crate::loading::body_fields::{BodyFields, BodySnapshot};
pub use crate::loading::inception::InceptionCriterion;
pub use crate::loading::recording::Snapshot;
pub use crate::simulate::accuracy::error_budget::{ErrorBudget, ErrorSource};
pub use crate::simulate::messages::{Note, Warning};
pub use crate::solver::timings::{Kernel, Timings};

/// Quantities by which a run is judged: those that the accuracy controls and the temperature; the others follow from them, or
/// are of the press alone.
pub const MAIN: [Quantity; 7] = {
    let [mu, mu_static, friction, load, area, energy] = CONTROLLED;
    [mu, mu_static, friction, load, area, energy, Quantity::TemperatureMax]
};

/// Grid of the snapshots.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactGrid {
    /// rad, 0 to π.
    pub theta: Vec<f64>,
    /// m.
    pub r: Vec<f64>,
}

/// Choices of the run and its cost.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Account {
    pub elements_per_radius: usize,
    pub sectors: usize,
    pub unknowns: usize,
    pub heat: bool,
    /// Finite strain, not small.
    pub finite_strain: bool,
    pub steps: usize,
    pub cutbacks: usize,
    /// Newton iterations of press and slide.
    pub newton_iterations: usize,
    /// Newton iterations of the press alone.
    pub press_newton_iterations: usize,
    pub krylov_iterations: usize,
    /// Newton iterations whose full step was too long or too short.
    pub line_searches: usize,
    /// s.
    pub wall_time: f64,
    /// Time of the run by part of the computation; without that of the output, which is not done then.
    #[serde(skip)]
    pub timings: Timings,
    /// Notes on what was chosen or left out and why.
    #[serde(skip)]
    pub notes: Vec<Note>,
    /// Limitations of the results.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

impl Account {
    /// Adds the notes about the scene, and its remarks before the warnings of the run; what a remark says with its remedy, no
    /// warning repeats.
    pub fn add_scene(&mut self, scene: &Scene) {
        let remarks = scene.remarks();
        if !remarks.is_empty() {
            // Its condition is among those of a remark.
            self.warnings.retain(|warning| *warning != Warning::EqualStrength { plateau: f64::INFINITY });
        }
        self.warnings.splice(0..0, remarks.into_iter().map(Warning::Scene));
        self.notes.push(Note::of_scene(scene));
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// ω₀/ω_c.
    pub interference: f64,
    /// ω_c, m.
    pub critical_interference: f64,
    /// Values with their errors.
    pub scalars: Scalars,
    pub inception: InceptionCriterion,
    /// Whether μ is steady at the end of the slide.
    pub steady: bool,
    /// The errors by source.
    pub budget: ErrorBudget,
    /// One row for each increment, [`Quantity::PRESS_HISTORIES`].
    pub press: History,
    /// One row for the start and one for each increment, [`Quantity::RUN_HISTORIES`].
    pub slide: History,
    /// Highest rise of the surface of a conducting counterface within the contact at the end of the slide, K.
    pub counterface_rise: Option<f64>,
    pub grid: ContactGrid,
    pub snapshots: Vec<Snapshot>,
    /// If recorded.
    pub body: Option<BodyFields>,
    pub account: Account,
}

impl Outcome {
    /// Q/P of the largest friction until the tangential stiffness dQ/ds has fallen to `share` of its first value, or the last
    /// contact point begins to slip, if that is earlier; nothing if the slide ends before.
    ///
    /// Where the stiffness decides, `mu_static` is that of a share of 0.01. Results of others in full stick have thresholds of their own.
    pub fn friction_at_stiffness(&self, share: f64) -> Option<f64> {
        let state = |state: State<'_>| SlideState {
            slip: state[Quantity::Slip],
            friction: state[Quantity::Friction],
            load: state[Quantity::Load],
            stick_fraction: state[Quantity::StickFraction],
            ..SlideState::default()
        };
        let history: Vec<SlideState> = self.slide.states().map(state).collect();
        let inception = inception_at(&history, share);
        (inception.criterion != InceptionCriterion::None).then(|| inception.friction / inception.load)
    }
}
