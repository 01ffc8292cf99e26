//! Error estimates by source: mesh, collocation angles, increments, solver, model.
//!
//! Every run has auxiliary runs on a mesh half as fine: one unchanged, one with another N_θ, and one in increments twice as
//! large with a larger solver tolerance; where the effect of these two matters, one with that tolerance alone. A run refined by itself has a further one, on the mesh half as
//! fine as its own. The difference between the run and that on the mesh half as fine, by the order of convergence (1.5
//! for the square-root edge of the pressure), bounds its mesh error; the differences among the auxiliary runs bound the
//! errors of the other three sources, less where the run is finer than they are; that of the angles falls with the elements, too. A bound ±d is taken as the standard
//! uncertainty d/√3 of a rectangular distribution. One difference of two meshes may be small by chance; the mesh has a
//! standard uncertainty of its own beside it, the scatter of such runs about their limits. All of this is a function of the
//! values of the runs: [`estimate`].
//!
//! The sources are taken as independent: their standard uncertainties u add as squares, and the reported error is the half-width
//! k u of a 95 % interval (JCGM 100:2008, Guide to the expression of uncertainty in measurement, 4.3.7, 5.1.2 and 6.2.1).
//! The accuracy of a scene is asked of the reported errors. `asperity effectivity` compares them with true errors.

use tables::quantity::{COVERAGE_FACTOR, OF_BOUND, Quantity};

use crate::scene::fitted_constants::error_estimates::ORDER;
use crate::scene::{Control, Numerics};
use crate::simulate::accuracy::modelling_error::ModellingError;
use crate::simulate::accuracy::resolution::{MOST_OF_STEPS, RelativeParts, Resolution};
use crate::simulate::accuracy::scatter::{of_deep_inception, scatter};
use crate::simulate::values::Values;

/// Where an error comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorSource {
    /// Elements on the meridian.
    Mesh,
    /// N_θ.
    Collocation,
    /// Increments of press and slide, which are also the steps in time.
    Steps,
    /// Residual of equilibrium, and of the coupling with heat and contact edge.
    Solver,
    /// Modelling error: negligible heat, finite strain, localised shear, press and size of an elastic counterface, smooth
    /// flux into one that conducts.
    Model,
}

impl ErrorSource {
    pub const ALL: [Self; 5] = [Self::Mesh, Self::Collocation, Self::Steps, Self::Solver, Self::Model];

    pub fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::Collocation => "sectors",
            Self::Steps => "steps",
            Self::Solver => "solver",
            Self::Model => "model",
        }
    }
}

const QUANTITIES: usize = Quantity::SCALARS.len();

/// Standard uncertainties of all quantities, SI, by source.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ErrorBudget {
    parts: [[f64; QUANTITIES]; 5],
    /// Errors by the width of the inception bracket, by the threshold of the stiffness, of inception in deep contacts, and of the
    /// steady value by the length of the slide: with the increments.
    brackets: [f64; QUANTITIES],
}

/// Quantities controlled by the accuracy of the scene.
pub const CONTROLLED: [Quantity; 6] = [
    Quantity::Mu,
    Quantity::MuStatic,
    Quantity::Friction,
    Quantity::Load,
    Quantity::Area,
    Quantity::EnergyRelease,
];

/// Values of the auxiliary runs.
#[derive(Clone, Copy)]
pub struct AuxiliaryValues<'a> {
    pub coarse: &'a Values,
    pub other_sectors: &'a Values,
    /// Values in longer increments, solved less exactly.
    pub longer_steps: &'a Values,
    /// Solved less exactly alone, where that matters.
    pub looser_solver: Option<&'a Values>,
}

/// A finished run: its resolution and its values.
#[derive(Clone, Copy)]
pub struct RunValues<'a> {
    pub resolution: &'a Resolution,
    pub values: &'a Values,
}

/// Uncertainties of a main run, from it, a run on its coarse mesh, and those at [`Resolution::auxiliary`] of `start`;
/// `interference` is ω₀/ω_c.
pub fn estimate(
    start: &Resolution,
    auxiliary: AuxiliaryValues<'_>,
    [run, coarse]: [RunValues<'_>; 2],
    modelling_error: &ModellingError,
    interference: f64,
    control: Control,
) -> ErrorBudget {
    let mut budget = ErrorBudget::other_than_mesh(auxiliary, start).refined(start, run.resolution);
    budget.set_mesh(run, coarse, interference);
    budget.set_brackets(run.values, of_deep_inception(interference, control));
    budget.add_residual(run.values);
    budget.set_model(modelling_error, run.values);
    budget
}

impl ErrorBudget {
    /// All but the mesh's part, of a run at the resolution `start`.
    pub fn other_than_mesh(auxiliary: AuxiliaryValues<'_>, start: &Resolution) -> Self {
        let difference = |with: &Values, share: f64| {
            Quantity::SCALARS.map(|q| OF_BOUND * share * (auxiliary.coarse.value(q) - with.value(q)).abs())
        };
        let other = start.coarse().other_sectors();
        let sectors = sectors_share(start.sectors, other.sectors) * elements_ratio(&other, start);
        Self {
            parts: [
                [0.0; QUANTITIES],
                difference(auxiliary.other_sectors, sectors),
                // First order in the increments.
                difference(auxiliary.longer_steps, 1.0),
                auxiliary.looser_solver.map_or([0.0; QUANTITIES], |looser| difference(looser, 1.0)),
                [0.0; QUANTITIES],
            ],
            ..Self::default()
        }
    }

    /// The mesh's part, from a run and one on a coarser mesh with as many sectors.
    fn set_mesh(&mut self, run: RunValues<'_>, coarser: RunValues<'_>, interference: f64) {
        let (fine, coarse) = (run.values, coarser.values);
        let elements = run.resolution.elements_per_radius;
        let refinement = elements as f64 / coarser.resolution.elements_per_radius as f64;
        self.parts[ErrorSource::Mesh as usize] = Quantity::SCALARS.map(|quantity| {
            let pair = [fine.value(quantity), coarse.value(quantity)];
            let scatter = scatter(quantity, interference, elements) * fine.magnitude(quantity);
            mesh_uncertainty(pair, refinement, scatter)
        });
    }

    /// Sets the errors by the bracket of inception of a run, and the relative uncertainty `deep` of `G` and the slip at
    /// inception.
    fn set_brackets(&mut self, values: &Values, deep: f64) {
        self.brackets = Quantity::SCALARS.map(|quantity| {
            let is_of_inception = [Quantity::EnergyRelease, Quantity::InceptionSlip].contains(&quantity);
            let deep = if is_of_inception { deep * values.magnitude(quantity) } else { 0.0 };
            (OF_BOUND * values.bracket(quantity)).hypot(deep)
        });
    }

    /// Expected budget after a refinement: second order in θ at least, and first in the elements; first in the increments.
    fn refined(mut self, from: &Resolution, to: &Resolution) -> Self {
        let sectors = (from.sectors as f64 / to.sectors as f64).powi(2) * elements_ratio(from, to);
        let steps = to.increment_growth / from.increment_growth;
        for (source, factor) in [(ErrorSource::Collocation, sectors), (ErrorSource::Steps, steps)] {
            self.parts[source as usize].iter_mut().for_each(|part| *part *= factor);
        }
        self
    }

    /// Residuals of stagnant steps, in the solver's part: relative to √(Pω), they change P by no larger a share.
    fn add_residual(&mut self, values: &Values) {
        for quantity in Quantity::SCALARS {
            self.parts[ErrorSource::Solver as usize][quantity as usize] +=
                OF_BOUND * values.residual * values.magnitude(quantity);
        }
    }

    /// Sets the part of the modelling error.
    fn set_model(&mut self, modelling_error: &ModellingError, values: &Values) {
        self.parts[ErrorSource::Model as usize] = Quantity::SCALARS
            .map(|quantity| OF_BOUND * modelling_error.share(quantity) * values.magnitude(quantity));
    }

    /// Error budget of runs that did not all finish: unknown, but for quantities with a `known` reported error.
    pub fn unknown(known: impl Fn(Quantity) -> Option<f64>) -> Self {
        let known = Quantity::SCALARS.map(|q| known(q).map_or(f64::NAN, |error| error / COVERAGE_FACTOR));
        let others = known.map(|error| if error.is_nan() { f64::NAN } else { 0.0 });
        Self { parts: [known, others, others, others, others], ..Self::default() }
    }

    /// Part of a source in the reported error; of an unfinished run all of a known one is the mesh's.
    pub fn part(&self, source: ErrorSource, quantity: Quantity) -> f64 {
        let bracket = if source == ErrorSource::Steps { self.brackets[quantity as usize] } else { 0.0 };
        COVERAGE_FACTOR * self.parts[source as usize][quantity as usize].hypot(bracket)
    }

    /// Part of the reported error that no finer resolution reduces.
    pub fn lasting(&self, quantity: Quantity) -> f64 {
        let model = self.parts[ErrorSource::Model as usize][quantity as usize];
        COVERAGE_FACTOR * model.hypot(self.brackets[quantity as usize])
    }

    /// Error budget of values that are multiplied by a factor.
    pub fn scaled(mut self, factor: impl Fn(Quantity) -> f64) -> Self {
        for quantity in Quantity::SCALARS {
            let parts = self.parts.iter_mut().chain([&mut self.brackets]);
            parts.for_each(|part| part[quantity as usize] *= factor(quantity));
        }
        self
    }

    /// The reported error: the half-width of a 95 % interval.
    pub fn total(&self, quantity: Quantity) -> f64 {
        let parts = ErrorSource::ALL.map(|source| self.part(source, quantity));
        parts.iter().map(|part| part * part).sum::<f64>().sqrt()
    }

    /// The reported error relative to the value.
    pub fn relative(&self, quantity: Quantity, values: &Values) -> f64 {
        let value = values.value(quantity).abs();
        if value > 0.0 { self.total(quantity) / value } else { 0.0 }
    }

    /// Whether the longer increments and the larger tolerance of an auxiliary run change a controlled quantity so much that it
    /// matters which of them does.
    pub fn steps_matter(&self, values: &Values, numerics: &Numerics) -> bool {
        CONTROLLED.iter().any(|&quantity| {
            let steps = COVERAGE_FACTOR * self.parts[ErrorSource::Steps as usize][quantity as usize];
            steps > MOST_OF_STEPS * numerics.accuracy * quantity.allowance() * values.value(quantity).abs()
        })
    }

    /// The worst of the controlled quantities, and the parts of its reported error relative to its value that a finer
    /// resolution reduces, over the multiple of the accuracy that is allowed.
    pub fn worst(&self, values: &Values) -> (Quantity, RelativeParts) {
        let relative = |quantity: Quantity| {
            let value = quantity.allowance() * values.value(quantity).abs();
            let part = |source: ErrorSource| COVERAGE_FACTOR * self.parts[source as usize][quantity as usize];
            let of = |source| if value > 0.0 { part(source) / value } else { 0.0 };
            RelativeParts {
                mesh: of(ErrorSource::Mesh),
                sectors: of(ErrorSource::Collocation),
                steps: of(ErrorSource::Steps),
                solver: of(ErrorSource::Solver),
            }
        };
        CONTROLLED
            .map(|quantity| (quantity, relative(quantity)))
            .into_iter()
            .max_by(|a, b| a.1.total().total_cmp(&b.1.total()))
            .expect("not empty")
    }
}

/// Reported error of a number of the press with the relative `scatter`, from its values on the mesh, on a coarser one, and on
/// that in increments twice as large.
pub fn of_press(
    [fine, coarse, longer_steps]: [f64; 3],
    run: &Resolution,
    coarser: &Resolution,
    scatter: f64,
) -> f64 {
    let refinement = run.elements_per_radius as f64 / coarser.elements_per_radius as f64;
    let mesh = mesh_uncertainty([fine, coarse], refinement, scatter * fine.abs());
    let steps = OF_BOUND * (coarse - longer_steps).abs();
    COVERAGE_FACTOR * mesh.hypot(steps)
}

/// Standard uncertainty of the finer of two values by the mesh: the bound from their difference and the scatter.
fn mesh_uncertainty([fine, coarse]: [f64; 2], refinement: f64, scatter: f64) -> f64 {
    (OF_BOUND * mesh_share(refinement) * (fine - coarse).abs()).hypot(scatter)
}

/// Error with N_θ sectors over the difference to that with others: second order.
fn sectors_share(sectors: usize, others: usize) -> f64 {
    1.0 / ((sectors as f64 / others as f64).powi(2) - 1.0).abs().max(0.5)
}

/// Effect of the sectors on one mesh over that on another: where the edge is between two rings differs from angle to angle, and
/// that averages out with more of them.
fn elements_ratio(coarse: &Resolution, fine: &Resolution) -> f64 {
    coarse.elements_per_radius as f64 / fine.elements_per_radius as f64
}

/// Error of the finer of two runs over their difference.
fn mesh_share(refinement: f64) -> f64 {
    1.0 / (refinement.powf(ORDER) - 1.0).abs()
}

#[cfg(test)]
mod tests;
