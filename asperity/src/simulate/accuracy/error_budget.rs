//! Error estimates by source: mesh, collocation angles, increments, solver, model.
//!
//! Every run has auxiliary runs on a mesh half as fine: one unchanged, and one each with another N_θ, with increments
//! twice as large and with a larger solver tolerance; a run refined by itself has a further one, on the mesh half as
//! fine as its own. The difference between the run and that on the mesh half as fine, by the order of convergence (1.5
//! for the square-root edge of the pressure), bounds its mesh error; the differences among the auxiliary runs bound the
//! errors of the other three sources, less where the run is finer than they are. A bound ±d is taken as the standard
//! uncertainty d/√3 of a rectangular distribution. One difference of two meshes may be small by chance; the mesh has a
//! standard uncertainty of its own beside it, the scatter of such runs about their limits. All of this is a function of the
//! values of the runs: [`estimate`].
//!
//! The sources are taken as independent: their standard uncertainties u add as squares, and the reported error is the half-width
//! k u of a 95 % interval (JCGM 100:2008, Guide to the expression of uncertainty in measurement, 4.3.7, 5.1.2 and 6.2.1).
//! The accuracy of a scene is asked of the reported errors. `asperity effectivity` compares them with true errors.

use tables::quantity::{COVERAGE_FACTOR, OF_BOUND, Quantity};

use crate::scene::fitted_constants::error_estimates::ORDER;
use crate::simulate::accuracy::modelling_error::ModellingError;
use crate::simulate::accuracy::resolution::{RelativeParts, Resolution};
use crate::simulate::accuracy::scatter::scatter;
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
    pub const ALL: [ErrorSource; 5] = [
        ErrorSource::Mesh,
        ErrorSource::Collocation,
        ErrorSource::Steps,
        ErrorSource::Solver,
        ErrorSource::Model,
    ];

    pub fn name(self) -> &'static str {
        match self {
            ErrorSource::Mesh => "mesh",
            ErrorSource::Collocation => "sectors",
            ErrorSource::Steps => "steps",
            ErrorSource::Solver => "solver",
            ErrorSource::Model => "model",
        }
    }
}

const QUANTITIES: usize = Quantity::SCALARS.len();

/// Standard uncertainties of all quantities, SI, by source.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorBudget {
    parts: [[f64; QUANTITIES]; 5],
    /// By the width of the inception bracket, by the threshold of the stiffness, and of the steady value by the length of
    /// the slide: with the increments.
    brackets: [f64; QUANTITIES],
}

impl Default for ErrorBudget {
    fn default() -> Self {
        Self { parts: [[0.0; QUANTITIES]; 5], brackets: [0.0; QUANTITIES] }
    }
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
    auxiliary: [&Values; 4],
    [run, coarse]: [RunValues<'_>; 2],
    modelling_error: &ModellingError,
    interference: f64,
) -> ErrorBudget {
    let mut budget = ErrorBudget::other_than_mesh(auxiliary, start).refined(start, run.resolution);
    budget.set_mesh(run, coarse, interference);
    budget.add_residual(run.values);
    budget.set_model(modelling_error, run.values);
    budget
}

impl ErrorBudget {
    /// All but the mesh's part, of a run at the resolution `start`.
    pub fn other_than_mesh(auxiliary: [&Values; 4], start: &Resolution) -> Self {
        let [coarse, other_sectors, longer_steps, looser_solver] = auxiliary;
        let difference = |other: &Values, share: f64| {
            Quantity::SCALARS.map(|q| OF_BOUND * share * (coarse.value(q) - other.value(q)).abs())
        };
        let sectors = sectors_share(start.sectors, start.coarse().other_sectors().sectors);
        Self {
            parts: [
                [0.0; QUANTITIES],
                difference(other_sectors, sectors),
                // First order in the increments.
                difference(longer_steps, 1.0),
                difference(looser_solver, 1.0),
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
        self.brackets = Quantity::SCALARS.map(|quantity| OF_BOUND * fine.bracket(quantity));
    }

    /// After a refinement in sectors and increments: second order in θ at least, first in the
    /// increments.
    fn refined(mut self, from: &Resolution, to: &Resolution) -> Self {
        let sectors = (from.sectors as f64 / to.sectors as f64).powi(2);
        let steps = to.growth / from.growth;
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

    /// The model's part.
    fn set_model(&mut self, modelling_error: &ModellingError, values: &Values) {
        self.parts[ErrorSource::Model as usize] = Quantity::SCALARS
            .map(|quantity| OF_BOUND * modelling_error.share(quantity) * values.magnitude(quantity));
    }

    /// Of runs that did not all finish: unknown, but for quantities with a `known` reported error.
    pub fn unknown(known: impl Fn(Quantity) -> Option<f64>) -> Self {
        let known = Quantity::SCALARS.map(|q| known(q).map_or(f64::NAN, |error| error / COVERAGE_FACTOR));
        let others = known.map(|error| if error.is_nan() { f64::NAN } else { 0.0 });
        Self { parts: [known, others, others, others, others], ..Self::default() }
    }

    /// Of the reported error; of an unfinished run all of a known one is the mesh's.
    pub fn part(&self, source: ErrorSource, quantity: Quantity) -> f64 {
        let bracket = if source == ErrorSource::Steps { self.brackets[quantity as usize] } else { 0.0 };
        COVERAGE_FACTOR * self.parts[source as usize][quantity as usize].hypot(bracket)
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

/// Error of the finer of two runs over their difference.
fn mesh_share(refinement: f64) -> f64 {
    1.0 / (refinement.powf(ORDER) - 1.0).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Numerics;
    use crate::scene::fitted_constants::localised_shear;

    fn numerics() -> Numerics {
        Numerics { accuracy: 0.02, elements_per_radius: None, sectors: None }
    }

    /// 3 + 2 n^-1.5 on n elements, and first order in the increments of the press: both bounds, and the scatter.
    #[test]
    fn errors_of_a_press_of_known_orders_are_found() {
        let run = Resolution::choose(&numerics());
        let coarser = run.coarse();
        let longer = coarser.longer_steps();
        let part = |r: &Resolution| {
            [2.0 * (r.elements_per_radius as f64).powf(-1.5), 0.4 / r.press_increments() as f64]
        };
        let of = |r: &Resolution| 3.0 + part(r).iter().sum::<f64>();
        let scatter = 0.003;
        let found = of_press([&run, &coarser, &longer].map(of), &run, &coarser, scatter);
        let [mesh, _] = part(&run);
        let steps = part(&longer)[1] - part(&coarser)[1];
        let exact = 4.0 * ((mesh * mesh + steps * steps) / 3.0 + (scatter * of(&run)).powi(2));
        assert!((found * found / exact - 1.0).abs() < 1e-9, "{found}");
    }

    /// 3 + 2 n^-1.5 + 0.4 g + 0.5/N_θ² with n elements, slip increments g and N_θ angles: each part of the error is
    /// found, of a main run and of a finer one.
    #[test]
    fn errors_of_runs_of_known_orders_are_found() {
        let parts = |r: &Resolution| {
            let (elements, angles) = (r.elements_per_radius as f64, r.sectors as f64);
            [2.0 * elements.powf(-1.5), 0.5 / angles.powi(2), 0.4 * r.growth]
        };
        let values = |r: &Resolution| Values::all(3.0 + parts(r).iter().sum::<f64>());
        let start = Resolution::choose(&numerics());
        let auxiliary = start.auxiliary().map(|r| values(&r));
        let mesh = start.finer_mesh(2);
        let angles = Resolution { sectors: 2 * mesh.sectors, ..mesh };
        let runs = [start, mesh, angles].map(|resolution| (resolution, values(&resolution)));
        for (resolution, values_here) in &runs {
            let coarser = resolution.coarse();
            let pair = [
                RunValues { resolution, values: values_here },
                RunValues { resolution: &coarser, values: &values(&coarser) },
            ];
            let budget = estimate(&start, auxiliary.each_ref(), pair, &ModellingError::default(), 1.0);
            let exact = parts(resolution);
            let sources = [ErrorSource::Mesh, ErrorSource::Collocation, ErrorSource::Steps];
            for (source, exact) in sources.into_iter().zip(exact) {
                // The heat partition has no scatter.
                let found = budget.part(source, Quantity::HeatPartition);
                assert!((found / exact - 2.0 / 3f64.sqrt()).abs() < 1e-9, "{source:?}: {found} {exact}");
            }
            let total = 2.0 * (exact.iter().map(|part| part * part).sum::<f64>() / 3.0).sqrt();
            assert!((budget.total(Quantity::HeatPartition) / total - 1.0).abs() < 1e-9);
            assert_eq!(budget.part(ErrorSource::Model, Quantity::HeatPartition), 0.0);
        }
    }

    #[test]
    fn what_is_known_of_an_unfinished_run_is_the_meshs() {
        let known = |quantity| (quantity == Quantity::LoadPress).then_some(0.3);
        let budget = ErrorBudget::unknown(known);
        let mesh = budget.part(ErrorSource::Mesh, Quantity::LoadPress);
        assert!((mesh - 0.3).abs() < 1e-15 && (budget.total(Quantity::LoadPress) - 0.3).abs() < 1e-15);
        assert!(budget.total(Quantity::Mu).is_nan());
        assert!(ErrorSource::ALL.iter().all(|source| budget.part(*source, Quantity::Mu).is_nan()));
    }

    /// The uncertainty of sliding inception is in the reported error, and asks for no refinement.
    #[test]
    fn brackets_are_reported() {
        let values = Values::all(2.0);
        let mut budget = ErrorBudget::default();
        budget.brackets[Quantity::MuStatic as usize] = 0.1;
        assert!((budget.relative(Quantity::MuStatic, &values) - 0.1).abs() < 1e-12);
        assert_eq!(budget.worst(&values).1, RelativeParts::default());
    }

    /// Equal values on all runs: what is left is the scatter of the quantity at its interference.
    #[test]
    fn meshes_that_agree_leave_the_scatter() {
        let start = Resolution::choose(&numerics());
        let coarser = start.coarse();
        let values = Values::all(2.0);
        let pair = [&start, &coarser].map(|resolution| RunValues { resolution, values: &values });
        for interference in [0.2, 20.0] {
            let budget = estimate(&start, [&values; 4], pair, &ModellingError::default(), interference);
            for quantity in [Quantity::Mu, Quantity::EnergyRelease] {
                let exact = 2.0 * scatter(quantity, interference, start.elements_per_radius);
                assert!((budget.relative(quantity, &values) / exact - 1.0).abs() < 1e-12);
                assert!((budget.total(quantity) / (2.0 * exact) - 1.0).abs() < 1e-12);
            }
            // Of G a multiple is allowed.
            let (worst, parts) = budget.worst(&values);
            let of = |quantity| budget.relative(quantity, &values) / quantity.allowance();
            assert!(CONTROLLED.iter().all(|&quantity| of(quantity) <= of(worst)));
            assert!((parts.total() / of(worst) - 1.0).abs() < 1e-12);
        }
    }

    /// What no finer mesh removes is in the error, and asks for no refinement.
    #[test]
    fn localised_shear_is_no_reason_for_a_finer_mesh() {
        let values = Values::all(2.0);
        let mut budget = ErrorBudget::default();
        let bounds = Some(&localised_shear::ON_PLATEAU);
        budget.set_model(&ModellingError { localised_shear: bounds, ..Default::default() }, &values);
        let exact = 2.0 / 3f64.sqrt() * localised_shear::ON_PLATEAU.energy;
        assert!((budget.relative(Quantity::EnergyRelease, &values) / exact - 1.0).abs() < 1e-12);
        assert_eq!(budget.worst(&values).1, RelativeParts::default());
    }

    /// 3 + 2 n^-1.5 on every mesh in the range of n_c: the estimate is exact whichever of the two meshes is the finer.
    #[test]
    fn every_mesh_has_an_auxiliary_one() {
        let value = |elements: usize| 3.0 + 2.0 * (elements as f64).powf(-1.5);
        for elements in [4, 5, 6, 7, 8, 12, 48] {
            let run = Resolution::choose(&Numerics { elements_per_radius: Some(elements), ..numerics() });
            let other = run.coarse();
            let refinement = elements as f64 / other.elements_per_radius as f64;
            let change = (value(elements) - value(other.elements_per_radius)).abs();
            let ratio = mesh_share(refinement) * change / (value(elements) - 3.0);
            assert!((ratio - 1.0).abs() < 1e-9, "{elements}: {ratio}");
        }
    }
}
