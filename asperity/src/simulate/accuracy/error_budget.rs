//! Error estimates by source: mesh, collocation angles, increments, solver, model.
//!
//! Every run has auxiliary runs on a mesh half as fine: one unchanged, and one each with another N_θ, with increments
//! twice as large and with a larger solver tolerance; a run refined by itself has a further one, on the mesh half as
//! fine as its own. The mesh error follows from the difference between the run and that on the mesh half as fine by the
//! order of convergence, 1.5 for the square-root edge of the pressure; quantities that depend on the position of that
//! edge also have a lower bound of the error, since two meshes may misplace it by the same amount. The differences
//! among the auxiliary runs are the errors of the other three sources, less where the run is finer than they are. All
//! of this is a function of the values of the runs: [`estimate`].
//!
//! The accuracy of a scene is compared with the estimates. The reported errors are half-widths of 95 % intervals, the
//! estimates times a coverage factor. `asperity effectivity` compares them with true errors.

use tables::quantity::Quantity;

use crate::discretisation::mesh::EDGE_SIZE;
use crate::scene::fitted_constants::error_estimates::{
    COVERAGE_FACTOR, EDGE_OF_ENERGY, EDGE_OF_LOAD, EDGE_OF_SPACING, ORDER,
};
use crate::simulate::accuracy::modelling_error::ModellingError;
use crate::simulate::accuracy::resolution::{RelativeParts, Resolution};
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
    /// Modelling error: negligible heat, finite strain.
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

/// Absolute errors of all quantities, SI, by source.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorBudget {
    parts: [[f64; QUANTITIES]; 5],
    /// Uncertainty by the width of the inception bracket, by the threshold of the stiffness, and of the steady value by
    /// the length of the slide: a part of the error of the increments.
    brackets: [f64; QUANTITIES],
}

impl Default for ErrorBudget {
    fn default() -> Self {
        Self { parts: [[0.0; QUANTITIES]; 5], brackets: [0.0; QUANTITIES] }
    }
}

/// Quantities controlled by the accuracy of the scene.
pub const CONTROLLED: [Quantity; 5] =
    [Quantity::Mu, Quantity::MuStatic, Quantity::Friction, Quantity::Load, Quantity::Area];

/// The auxiliary runs of a main run, all on the coarse mesh.
pub struct AuxiliaryRuns<'a> {
    pub coarse: &'a Values,
    pub other_sectors: &'a Values,
    pub longer_steps: &'a Values,
    pub looser_solver: &'a Values,
}

/// A finished run: its resolution and its values.
#[derive(Clone, Copy)]
pub struct RunValues<'a> {
    pub resolution: &'a Resolution,
    pub values: &'a Values,
}

/// Errors of a main run, from it, a run on its coarse mesh, and the auxiliary runs of the resolution `start`.
pub fn estimate(
    start: &Resolution,
    auxiliary: &AuxiliaryRuns<'_>,
    [run, coarse]: [RunValues<'_>; 2],
    modelling_error: &ModellingError,
) -> ErrorBudget {
    let mut budget = ErrorBudget::other_than_mesh(auxiliary, start).refined(start, run.resolution);
    budget.set_mesh(run, coarse);
    budget.add_residual(run.values);
    budget.set_model(modelling_error, run.values);
    budget
}

impl ErrorBudget {
    /// All but the mesh's part, of a run at the resolution `start`.
    pub fn other_than_mesh(auxiliary: &AuxiliaryRuns<'_>, start: &Resolution) -> Self {
        let AuxiliaryRuns { coarse, other_sectors, longer_steps, looser_solver } = *auxiliary;
        let difference = |other: &Values, share: &dyn Fn(Quantity) -> f64| {
            Quantity::SCALARS.map(|q| share(q) * (coarse.value(q) - other.value(q)).abs())
        };
        let sectors = sectors_share(start.sectors, start.coarse().other_sectors().sectors);
        Self {
            parts: [
                [0.0; QUANTITIES],
                difference(other_sectors, &|_| sectors),
                // First order in the increments.
                difference(longer_steps, &|_| 1.0),
                difference(looser_solver, &|_| 1.0),
                [0.0; QUANTITIES],
            ],
            ..Self::default()
        }
    }

    /// The mesh's part, from a run and one on a coarser mesh with as many sectors.
    fn set_mesh(&mut self, run: RunValues<'_>, coarser: RunValues<'_>) {
        let (fine, coarse) = (run.values, coarser.values);
        let elements = run.resolution.elements_per_radius as f64;
        let refinement = elements / coarser.resolution.elements_per_radius as f64;
        self.parts[ErrorSource::Mesh as usize] = Quantity::SCALARS.map(|quantity| {
            let floor = edge_floor(quantity, elements) * fine.magnitude(quantity);
            mesh_share(refinement) * (fine.value(quantity) - coarse.value(quantity)).abs() + floor
        });
        self.brackets = Quantity::SCALARS.map(|quantity| fine.bracket(quantity));
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
                values.residual * values.magnitude(quantity);
        }
    }

    /// The model's part.
    fn set_model(&mut self, modelling_error: &ModellingError, values: &Values) {
        self.parts[ErrorSource::Model as usize] =
            Quantity::SCALARS.map(|quantity| modelling_error.share(quantity) * values.magnitude(quantity));
    }

    /// Unknown errors: as large as the values.
    pub fn unknown(values: &Values, modelling_error: &ModellingError) -> Self {
        let mut budget = Self::default();
        budget.parts[ErrorSource::Mesh as usize] =
            Quantity::SCALARS.map(|q| values.value(q).abs() / COVERAGE_FACTOR);
        budget.set_model(modelling_error, values);
        budget
    }

    /// Of the reported error.
    pub fn part(&self, source: ErrorSource, quantity: Quantity) -> f64 {
        let bracket = if source == ErrorSource::Steps { self.brackets[quantity as usize] } else { 0.0 };
        COVERAGE_FACTOR * (self.parts[source as usize][quantity as usize] + bracket)
    }

    /// The reported error: the half-width of a 95 % interval.
    pub fn total(&self, quantity: Quantity) -> f64 {
        ErrorSource::ALL.iter().map(|&source| self.part(source, quantity)).sum()
    }

    /// The worst of the controlled quantities, and the parts of its estimate relative to its value that a finer resolution
    /// reduces.
    pub fn worst(&self, values: &Values) -> (Quantity, RelativeParts) {
        let relative = |quantity: Quantity| {
            let value = values.value(quantity).abs();
            let part = |source: ErrorSource| self.parts[source as usize][quantity as usize];
            let of = |source| if value > 0.0 { part(source) / value } else { 0.0 };
            RelativeParts {
                mesh: of(ErrorSource::Mesh),
                sectors: of(ErrorSource::Collocation),
                steps: of(ErrorSource::Steps),
                solver: of(ErrorSource::Solver),
                model: of(ErrorSource::Model),
            }
        };
        CONTROLLED
            .map(|quantity| (quantity, relative(quantity)))
            .into_iter()
            .max_by(|a, b| a.1.total().total_cmp(&b.1.total()))
            .expect("not empty")
    }
}

/// Reported errors of a number of the press from mesh and increments, from its values on the mesh, on a coarser
/// one, and on that in increments twice as large; `power` of the contact radius it depends on.
pub fn of_press(
    [fine, coarse, longer_steps]: [f64; 3],
    run: &Resolution,
    coarser: &Resolution,
    power: f64,
) -> [f64; 2] {
    let elements = run.elements_per_radius as f64;
    let mesh = mesh_share(elements / coarser.elements_per_radius as f64) * (fine - coarse).abs();
    let steps = (coarse - longer_steps).abs();
    [mesh + power * edge_share(elements) * fine.abs(), steps].map(|part| COVERAGE_FACTOR * part)
}

/// Uncertainty of the contact radius after the press, relative, as the edge lies between two rings of
/// nodes: a share of the ring spacing.
pub fn edge_share(elements_per_radius: f64) -> f64 {
    EDGE_OF_SPACING * EDGE_SIZE / elements_per_radius
}

/// Of a quantity, relative: the place of the edge is as uncertain after the slide as after the press.
fn edge_floor(quantity: Quantity, elements_per_radius: f64) -> f64 {
    use Quantity::*;
    let edge = edge_share(elements_per_radius);
    match quantity {
        // Friction is strength times area.
        Mu | MuStatic | MuPeak | MuMean | MuSteady | Friction | FrictionStatic | Area | AreaPress => {
            2.0 * edge
        }
        // The rise is proportional to the radius of the source.
        ContactRadius | InceptionSlip | EnergyWeakening | TemperatureMax | TemperatureMean => edge,
        // An error of the slip at inception appears in G one (plastic contacts) to 6.6 times (elastic ones).
        EnergyRelease => EDGE_OF_ENERGY * edge,
        // The pressure vanishes at the edge.
        Load => EDGE_OF_LOAD * edge,
        _ => 0.0,
    }
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

    fn numerics() -> Numerics {
        Numerics { accuracy: 0.02, elements_per_radius: None, sectors: None }
    }

    /// 3 + 2 n^-1.5 on n elements, and first order in the increments of the press.
    #[test]
    fn errors_of_a_press_of_known_orders_are_found() {
        let run = Resolution::choose(&numerics());
        let coarser = run.coarse();
        let value =
            |elements: usize, increments: f64| 3.0 + 2.0 * (elements as f64).powf(-1.5) + 0.4 / increments;
        let of = |r: &Resolution| value(r.elements_per_radius, r.press_increments as f64);
        let longer = coarser.longer_steps();
        let [_, steps] = of_press([of(&run), of(&coarser), of(&longer)], &run, &coarser, 0.0);
        let change = 0.4 / longer.press_increments as f64 - 0.4 / coarser.press_increments as f64;
        assert!((steps - COVERAGE_FACTOR * change).abs() < 1e-12);
        let elements = |r: &Resolution| value(r.elements_per_radius, f64::INFINITY);
        let values = [elements(&run), elements(&coarser), elements(&coarser)];
        let [mesh, steps] = of_press(values, &run, &coarser, 0.0);
        assert_eq!(steps, 0.0);
        assert!((mesh / (values[0] - 3.0) - COVERAGE_FACTOR).abs() < 1e-9, "{mesh}");
        // The place of the edge adds its own to what depends on the radius.
        let [with_edge, _] = of_press(values, &run, &coarser, 2.0);
        let edge = 2.0 * edge_share(run.elements_per_radius as f64) * values[0];
        assert!((with_edge - mesh - COVERAGE_FACTOR * edge).abs() < 1e-12);
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
        let [coarse, other_sectors, longer_steps, looser_solver] = start.auxiliary().map(|r| values(&r));
        let auxiliary = AuxiliaryRuns {
            coarse: &coarse,
            other_sectors: &other_sectors,
            longer_steps: &longer_steps,
            looser_solver: &looser_solver,
        };
        let mesh = start.finer_mesh(2);
        let angles = Resolution { sectors: 2 * mesh.sectors, ..mesh };
        let runs = [start, mesh, angles].map(|resolution| (resolution, values(&resolution)));
        for (resolution, values_here) in &runs {
            let coarser = resolution.coarse();
            let pair = [
                RunValues { resolution, values: values_here },
                RunValues { resolution: &coarser, values: &values(&coarser) },
            ];
            let budget = estimate(&start, &auxiliary, pair, &ModellingError::default());
            let exact = parts(resolution);
            let sources = [ErrorSource::Mesh, ErrorSource::Collocation, ErrorSource::Steps];
            for (source, exact) in sources.into_iter().zip(exact) {
                // The load of the press has no part by the place of the edge.
                let found = budget.part(source, Quantity::LoadPress);
                assert!((found / exact - COVERAGE_FACTOR).abs() < 1e-9, "{source:?}: {found} {exact}");
            }
            assert_eq!(budget.part(ErrorSource::Model, Quantity::LoadPress), 0.0);
        }
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

    #[test]
    fn a_run_is_refined_in_what_it_lacks() {
        let run = Resolution::choose(&numerics());
        let with = |mesh: f64, sectors: f64, steps: f64| {
            run.refine(&numerics(), &RelativeParts { mesh, sectors, steps, ..Default::default() })
        };
        assert!(with(0.01, 0.005, 0.004).is_none());
        let finer = with(0.04, 0.0, 0.0).unwrap();
        assert!(finer.elements_per_radius as f64 >= run.elements_per_radius as f64 * 2f64.powf(1.0 / 1.5));
        assert_eq!((finer.sectors, finer.growth), (run.sectors, run.growth));
        let finer = with(0.0, 0.03, 0.0).unwrap();
        assert_eq!((finer.sectors, finer.elements_per_radius), (2 * run.sectors, run.elements_per_radius));
        let finer = with(0.0, 0.0, 0.03).unwrap();
        assert_eq!((finer.growth, finer.sectors), (0.5 * run.growth, run.sectors));
        // What the scene fixes stays.
        let fixed = Numerics { elements_per_radius: Some(8), ..numerics() };
        let run = Resolution::choose(&fixed);
        let parts = RelativeParts { mesh: 0.04, ..Default::default() };
        assert!(run.refine(&fixed, &parts).is_none());
    }
}
