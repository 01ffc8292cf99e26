//! What each number may be off by, and why: mesh, sectors, steps, solver.
//!
//! Every run has companions on a mesh half as fine, which cost little: one as it is, and one each
//! with another N_θ, with increments twice as large and with a solver less exact. The difference
//! between the run and the first tells the error of the mesh, given the order of convergence. The
//! differences among the companions are the errors of the other three sources.

use tables::quantity::Quantity;

use crate::scalars::Scalars;

/// Where an error comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorSource {
    /// Elements on the meridian.
    Mesh,
    /// N_θ.
    Sectors,
    /// Increments of press and slide, which are also the steps in time.
    Steps,
    /// Residual of equilibrium, and of the coupling with heat and contact edge.
    Solver,
}

impl ErrorSource {
    pub const ALL: [ErrorSource; 4] =
        [ErrorSource::Mesh, ErrorSource::Sectors, ErrorSource::Steps, ErrorSource::Solver];

    pub fn name(self) -> &'static str {
        match self {
            ErrorSource::Mesh => "mesh",
            ErrorSource::Sectors => "sectors",
            ErrorSource::Steps => "steps",
            ErrorSource::Solver => "solver",
        }
    }
}

const QUANTITIES: usize = Quantity::ALL.len();

/// Estimated absolute errors of all quantities, SI, by source.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorBudget {
    parts: [[f64; QUANTITIES]; 4],
}

impl Default for ErrorBudget {
    fn default() -> Self {
        Self { parts: [[0.0; QUANTITIES]; 4] }
    }
}

/// Parts of the error of the worst of the quantities that the accuracy is asked of, relative to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelativeParts {
    pub mesh: f64,
    pub sectors: f64,
    pub steps: f64,
    pub solver: f64,
}

impl RelativeParts {
    pub fn total(&self) -> f64 {
        self.mesh + self.sectors + self.steps + self.solver
    }
}

/// Quantities that the asked accuracy is about.
pub const CONTROLLED: [Quantity; 5] =
    [Quantity::Mu, Quantity::MuStatic, Quantity::Friction, Quantity::Load, Quantity::Area];

/// The companions of a run, all on the coarse mesh.
pub struct Companions<'a> {
    pub coarse: &'a Scalars,
    pub other_sectors: &'a Scalars,
    pub longer_steps: &'a Scalars,
    pub looser_solver: &'a Scalars,
}

impl ErrorBudget {
    /// `refinement` is the ratio of n_c between the run and its companions.
    pub fn new(fine: &Scalars, companions: &Companions<'_>, refinement: f64) -> Self {
        let Companions { coarse, other_sectors, longer_steps, looser_solver } = *companions;
        let difference = |a: &Scalars, b: &Scalars, factor: f64| {
            Quantity::ALL.map(|q| factor * (a.value(q) - b.value(q)).abs())
        };
        let mut parts = [
            difference(fine, coarse, mesh_factor(refinement)),
            difference(coarse, other_sectors, 1.0),
            difference(coarse, longer_steps, 1.0),
            difference(coarse, looser_solver, 1.0),
        ];
        for quantity in Quantity::ALL {
            parts[ErrorSource::Steps as usize][quantity as usize] += fine.bracket(quantity);
        }
        Self { parts }
    }

    /// The mesh's part anew, from a run with `refinement` times the n_c of `coarse`.
    pub fn set_mesh(&mut self, fine: &Scalars, coarse: &Scalars, refinement: f64) {
        let factor = mesh_factor(refinement);
        self.parts[ErrorSource::Mesh as usize] =
            Quantity::ALL.map(|q| factor * (fine.value(q) - coarse.value(q)).abs());
    }

    /// After a refinement by which a source's error should have fallen.
    pub fn scale(&mut self, source: ErrorSource, factor: f64) {
        for part in &mut self.parts[source as usize] {
            *part *= factor;
        }
    }

    /// Nothing is known: errors as large as the values.
    pub fn unknown(fine: &Scalars) -> Self {
        let mut budget = Self::default();
        budget.parts[ErrorSource::Mesh as usize] = Quantity::ALL.map(|q| fine.value(q).abs());
        budget
    }

    pub fn part(&self, source: ErrorSource, quantity: Quantity) -> f64 {
        self.parts[source as usize][quantity as usize]
    }

    pub fn total(&self, quantity: Quantity) -> f64 {
        ErrorSource::ALL.iter().map(|&source| self.part(source, quantity)).sum()
    }

    /// The worst of the controlled quantities, and the parts of its error relative to its value.
    pub fn worst(&self, values: &Scalars) -> (Quantity, RelativeParts) {
        let relative = |quantity: Quantity| {
            let value = values.value(quantity).abs();
            let of = |source| if value > 0.0 { self.part(source, quantity) / value } else { 0.0 };
            RelativeParts {
                mesh: of(ErrorSource::Mesh),
                sectors: of(ErrorSource::Sectors),
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

/// Order at which results converge with the elements: that beside the square-root edge of elastic
/// contact, where the load is off by 2.2 and 0.7 % at 8 and 16 elements per radius.
const ORDER: f64 = 1.5;

/// Error of the finer of two runs over their difference.
fn mesh_factor(refinement: f64) -> f64 {
    1.0 / (refinement.powf(ORDER) - 1.0).max(0.5)
}
