//! What a simulation yields. SI units; forces, areas and energies of the whole asperity.

use tables::law::Estimate;

pub use crate::interface::contact::Status as ContactStatus;
pub use crate::loading::inception::InceptionCriterion;
pub use crate::loading::body_fields::{BodyFields, BodySnapshot};
pub use crate::simulate::accuracy::error_budget::{ErrorBudget, ErrorSource};
pub use crate::simulate::messages::{Note, Warning};
pub use crate::solver::timings::{Kernel, Timings};

/// One increment of the press.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressStep {
    /// ω/ω_c.
    pub interference: f64,
    /// P, N.
    pub load: f64,
    /// A, m².
    pub area: f64,
}

/// One increment of the slide. Energies are totals since the start of the slide, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlideStep {
    pub slip: f64,
    /// ω/ω_c; changes where the load is held.
    pub interference: f64,
    pub time: f64,
    /// Q, N.
    pub friction: f64,
    /// P, N.
    pub load: f64,
    /// Q/P.
    pub mu: f64,
    pub area: f64,
    /// Share of the contact area that sticks.
    pub stick_fraction: f64,
    pub temperature_max: f64,
    /// Mean over the contact, K.
    pub temperature_mean: f64,
    pub plastic_strain_max: f64,
    /// Work of the flat on the asperity.
    pub work: f64,
    /// Change of the stored elastic energy, with that of the normal contact springs.
    pub energy_elastic: f64,
    pub dissipation_plastic: f64,
    pub dissipation_friction: f64,
    /// Work done through thermal expansion: ∫σ:dε_th.
    pub work_thermal_expansion: f64,
    /// Elastic energy given up as the elastic moduli fall with temperature.
    pub energy_moduli_softening: f64,
    /// Frictional and plastic heat that entered the body.
    pub heat_in: f64,
    /// ∫ρc(T − T₀).
    pub heat_stored: f64,
    /// Heat that left through the base and the gap.
    pub heat_out: f64,
}

/// Scalars of a run; errors are absolute.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    pub mu: Estimate,
    pub mu_static: Estimate,
    pub mu_peak: Estimate,
    pub mu_mean: Estimate,
    pub friction: Estimate,
    pub friction_static: Estimate,
    pub load: Estimate,
    /// P at the end of the press.
    pub load_press: Estimate,
    pub area: Estimate,
    pub area_press: Estimate,
    /// a₀, m.
    pub contact_radius: Estimate,
    /// Energy released from full stick to full slip per contact area, J/m².
    pub energy_release: Estimate,
    /// ∫(τ̄ − τ̄_end) ds from the peak of τ̄ = Q/A to the end, J/m².
    pub energy_weakening: Estimate,
    pub temperature_max: Estimate,
    pub temperature_mean: Estimate,
    /// Slip at sliding inception, m.
    pub inception_slip: Estimate,
    pub inception: InceptionCriterion,
    /// Whether μ has levelled off at the end of the slide.
    pub levelled: bool,
}

/// Fields over the contact plane at one instant, over (theta, r) in row-major order.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    pub slip: f64,
    pub status: Vec<ContactStatus>,
    pub pressure: Vec<f64>,
    pub shear: Vec<f64>,
    pub temperature: Vec<f64>,
    pub slip_distance: Vec<f64>,
}

/// Grid of the snapshots.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactGrid {
    /// rad, 0 to π.
    pub theta: Vec<f64>,
    /// m.
    pub r: Vec<f64>,
}

/// What was chosen for the run and what it cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    pub elements_per_radius: usize,
    pub sectors: usize,
    pub unknowns: usize,
    pub heat: bool,
    /// Finite strain, not small.
    pub finite_strain: bool,
    pub steps: usize,
    pub cutbacks: usize,
    pub newton_iterations: usize,
    pub krylov_iterations: usize,
    /// s.
    pub wall_time: f64,
    /// Where the time went; without that of the output, which is not done then.
    pub timings: Timings,
    /// What was chosen or left out and why.
    pub notes: Vec<Note>,
    /// What the reader must know before trusting the numbers.
    pub warnings: Vec<Warning>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// ω_c, m.
    pub critical_interference: f64,
    pub press: Vec<PressStep>,
    pub slide: Vec<SlideStep>,
    pub summary: Summary,
    pub budget: ErrorBudget,
    pub grid: ContactGrid,
    pub snapshots: Vec<Snapshot>,
    /// If they were asked for.
    pub body: Option<BodyFields>,
    pub account: Account,
}
